// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/performance.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "metrics/portability/performance_portability.h"
#include "porttool/text/sink/markdown.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

std::optional<double> rate_at(const json& object, const char* name) {
    if (!object.is_object() || !object.contains(name) || !object[name].is_number()) return std::nullopt;
    const double value = object[name].get<double>();
    return value > 0 ? std::optional(value) : std::nullopt;
}

std::string text_at(const json& object, const char* name) {
    return object.contains(name) && object[name].is_string() ? object[name].get<std::string>() : std::string();
}

template <class T>
ordered_json or_null(const std::optional<T>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

std::string rate_text(const std::optional<double>& rate) {
    return rate ? fmt::format("{:.2f}", *rate) : std::string("not known");
}

}  // namespace

std::optional<double> PlatformSpeed::efficiency() const {
    if (!limit) return std::nullopt;
    return std::min(1.0, achieved / *limit);
}

std::optional<double> Performance::portability() const {
    std::vector<std::optional<double>> efficiencies;
    for (const PlatformSpeed& platform : platforms) {
        if (!platform.limit) return std::nullopt;
        efficiencies.push_back(platform.efficiency());
    }
    if (efficiencies.empty()) return std::nullopt;
    return metrics::performance_portability(efficiencies);
}

ReadSpeed read_speed(const std::string& path, const std::string& text, std::optional<double> limit) {
    ReadSpeed result;
    const json bench = json::parse(text, nullptr, false);
    const json rates = bench.is_object() ? bench.value("mrays_per_s", json()) : json();
    const std::optional<double> achieved = rate_at(rates, "total");
    if (!achieved) {
        result.error = "--bench " + terminal_text(path) + ": " +
                       (bench.is_discarded() ? "no JSON" : "has no rate above 0 at mrays_per_s.total") +
                       "; make it with: pathtracer bench SCENE --format json";
        return result;
    }
    const std::string core = text_at(bench, "core"), device = text_at(bench, "device");
    result.platform.name = core.empty() || device.empty() ? path : core + " core on " + device;
    result.platform.achieved = *achieved;
    result.platform.limit = limit ? limit : rate_at(bench, "embree_limit_mrays_per_s");
    return result;
}

ordered_json performance_json(const Performance& performance) {
    if (performance.platforms.empty()) return nullptr;
    ordered_json platforms = ordered_json::array();
    for (const PlatformSpeed& platform : performance.platforms)
        platforms.push_back({{"name", platform.name},
                             {"achieved_mrays_per_s", platform.achieved},
                             {"limit_mrays_per_s", or_null(platform.limit)},
                             {"efficiency", or_null(platform.efficiency())}});
    return {{"platforms", platforms}, {"performance_portability", or_null(performance.portability())}};
}

std::string performance_markdown(const Performance& performance) {
    if (performance.platforms.empty()) return {};
    std::string out = "\n| platform | Mrays/s | of at most | efficiency |\n| --- | ---: | ---: | ---: |\n";
    for (const PlatformSpeed& platform : performance.platforms) {
        const std::optional<double> efficiency = platform.efficiency();
        out += fmt::format("| {} | {:.2f} | {} | {} |\n", markdown_text(platform.name), platform.achieved,
                           rate_text(platform.limit), efficiency ? fmt::format("{:.2f}", *efficiency) : "not known");
    }
    const std::optional<double> portability = performance.portability();
    return out + "\nPerformance portability (harmonic mean of the efficiencies): " +
           (portability ? fmt::format("{:.2f}", *portability) : "not known; name each limit, --bench FILE=MRAYS") +
           ".\n";
}

}  // namespace porttool
