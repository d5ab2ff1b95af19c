// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/performance.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "metrics/portability/performance_portability.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using nlohmann::json;

std::optional<double> rate_at(const json& object, const char* name) {
    if (!object.is_object() || !object.contains(name) || !object[name].is_number()) return std::nullopt;
    const double value = object[name].get<double>();
    return value > 0 ? std::optional(value) : std::nullopt;
}

std::string text_at(const json& object, const char* name) {
    return object.contains(name) && object[name].is_string() ? object[name].get<std::string>() : std::string();
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

}  // namespace porttool
