// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/run_identity.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "application/sampling/scene_digest.h"

namespace application {
namespace {

std::string on_or_off(bool value) { return value ? "on" : "off"; }

std::string kernels_digest(CoreSession& session) {
    Digest digest;
    for (const render_system::KernelText& kernel : session.kernel_texts()) {
        digest.add(kernel.file);
        digest.add(kernel.text);
    }
    return digest.hex();
}

}  // namespace

std::string RunIdentity::text() const {
    nlohmann::ordered_json json = nlohmann::ordered_json::object();
    for (const auto& [name, value] : entries) json[name] = value;
    return json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

RunIdentity RunIdentity::read(const std::string& text) {
    RunIdentity identity;
    const auto json = nlohmann::ordered_json::parse(text, nullptr, false);
    if (!json.is_object()) return identity;
    for (const auto& [name, value] : json.items()) {
        if (!value.is_string()) return {};
        identity.entries.emplace_back(name, value.get<std::string>());
    }
    return identity;
}

std::string RunIdentity::value(const std::string& name) const {
    for (const auto& [known, value] : entries)
        if (known == name) return value;
    return {};
}

RunIdentity run_identity(const Options& options, CoreSession& session) {
    const render_system::CoreStats stats = session.stats();
    RunIdentity identity;
    identity.entries = {
        {"the program's version", PORTTOOL_VERSION},
        {"the sky (--sky, or that of camera or scene)", sky_digest(session.scene().sky())},
        {"the scene's content", session.scene_content()},
        {"the core", stats.core},
        {"the core's kernels", kernels_digest(session)},
        {"--size", fmt::format("{}x{}", options.width, options.height)},
        {"the view (camera, --look-at, --fov, the lens)", view_digest(session.view())},
        {"--seed", std::to_string(options.seed)},
        {"--max-path-length", std::to_string(options.max_path_length)},
        {"Russian roulette", on_or_off(options.russian_roulette)},
        {"next event estimation", on_or_off(options.next_event_estimation)},
        {"--clamp", options.indirect_limit > 0.0f ? fmt::format("{}", options.indirect_limit) : "none"},
        {"--exact", on_or_off(options.exact)},
    };
    // Another device may round otherwise; the target core has the same bits on every CPU.
    if (stats.core == "source") identity.entries.emplace_back("the device", stats.device);
    return identity;
}

std::string first_difference(const RunIdentity& a, const RunIdentity& b, const std::string& then,
                             const std::string& now) {
    for (const auto& [name, value] : a.entries)
        if (b.value(name) != value) return fmt::format("{} {} {} and {} {}", name, then, value, now, b.value(name));
    return a == b ? "" : "what decides its bits " + then + " other things and " + now + " these";
}

}  // namespace application
