// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/cores.h"
#include "application/file_output.h"

namespace application {
namespace {

using render_system::CoreRegistry;
using render_system::CoreStats;
using render_system::Status;

uint64_t host_memory_bytes() {
    return static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGE_SIZE));
}

/// What this machine offers one core, or why it cannot run.
Json describe_core(const CoreRegistry& registry, const std::string& id) {
    Json entry = {{"id", id},        {"available", false}, {"device", nullptr}, {"memory_bytes", nullptr},
                  {"file", nullptr}, {"reason", nullptr}};
    if (const auto file = render_system::find_core_module(id); file.ok()) entry["file"] = file->string();
    auto core = registry.CreateCoreAPI(id);
    Status status = core.ok() ? (*core)->Init({}) : core.status;
    if (!status.ok()) {
        entry["reason"] = explain(status);
        return entry;
    }
    const CoreStats stats = (*core)->GetCoreStats();
    entry["available"] = true;
    entry["device"] = stats.device;
    entry["memory_bytes"] = stats.memory_allowed_bytes != 0 ? stats.memory_allowed_bytes : host_memory_bytes();
    return entry;
}

/// The devices behind the cores that can run, each once.
Json devices_of(const Json& cores) {
    Json devices = Json::array();
    for (const Json& core : cores) {
        if (!core["available"].get<bool>()) continue;
        devices.push_back({{"name", core["device"]}, {"core", core["id"]}, {"memory_bytes", core["memory_bytes"]}});
    }
    return devices;
}

std::string info_text(const Json& cores) {
    constexpr uint64_t MEBIBYTE = 1024 * 1024;
    std::string text;
    for (const Json& core : cores) {
        const std::string id = core["id"].get<std::string>();
        if (core["available"].get<bool>()) {
            text += fmt::format("{:<8}{}, {} MiB\n", id, core["device"].get<std::string>(),
                                core["memory_bytes"].get<uint64_t>() / MEBIBYTE);
        } else {
            text += fmt::format("{:<8}cannot run: {}\n", id, core["reason"].get<std::string>());
        }
        if (core["file"].is_string()) text += fmt::format("{:<8}{}\n", "", core["file"].get<std::string>());
    }
    return text;
}

}  // namespace

ExitCode run_info(const Options& options, Console& console) {
    const CoreRegistry registry = make_registry(options);
    Json cores = Json::array();
    // Also the cores whose modules are missing: their absence is an answer too. Not null: it is always there.
    for (const std::string& id : registry.ids())
        if (id != "null") cores.push_back(describe_core(registry, id));
    const Json info = {{"version", PORTTOOL_VERSION}, {"cores", cores}, {"devices", devices_of(cores)}};
    return deliver(options, console, options.format == Format::json ? json_text(info) : info_text(cores));
}

}  // namespace application
