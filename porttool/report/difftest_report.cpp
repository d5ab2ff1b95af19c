// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/difftest_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

std::string_view difftest_state(DifftestState state) {
    constexpr std::array<std::string_view, 3> kNames = {"same", "differs", "not_run"};
    return kNames.at(static_cast<size_t>(state));
}

/// A number as C writes it: to the last bit, in hexadecimal where decimal digits would be many.
std::string seen_text(const SeenNumber& number) {
    if (!number.is_real) return std::to_string(number.whole);
    if (std::isnan(number.real)) return "nan";
    if (std::isinf(number.real)) return number.real < 0 ? "-inf" : "inf";
    const std::string plain =
        number.is_single ? fmt::format("{}", static_cast<float>(number.real)) : fmt::format("{}", number.real);
    constexpr size_t kShort = 6;
    if (plain.size() <= kShort) return number.real == 0 && std::signbit(number.real) ? "-0.0" : plain;
    return fmt::format("{:a}", number.real);
}

nlohmann::ordered_json seen_json(const SeenNumber& number) {
    if (!number.is_real) return number.whole;
    if (!std::isfinite(number.real)) return seen_text(number);
    return number.real;
}

std::string seen_inputs(const Counterexample& one) {
    std::string out;
    constexpr size_t kMost = 12;
    size_t shown = 0, zeros = 0;
    for (const SeenNumber& input : one.inputs) {
        const bool zero = input.is_real ? input.real == 0 && !std::signbit(input.real) : input.whole == 0;
        if ((zero && one.inputs.size() > 4) || shown == kMost) {
            ++zeros;
            continue;
        }
        out += (out.empty() ? "" : ", ") + terminal_text(input.path) + " = " + seen_text(input);
        ++shown;
    }
    if (zeros > 0 && shown < kMost)
        out += out.empty() ? "every number 0" : ", every other number 0";
    else if (zeros > 0)
        out += fmt::format(" and {} more", zeros);
    return out;
}

}  // namespace

std::string difftest_table(const std::vector<DifftestPair>& pairs, bool verbose) {
    std::string out;
    std::array<size_t, 3> counts{};
    std::map<std::string, size_t> reasons;
    for (const DifftestPair& pair : pairs) {
        ++counts.at(static_cast<size_t>(pair.state));
        if (pair.state == DifftestState::NotRun) ++reasons[pair.reason];
        const bool apart = pair.state == DifftestState::Same && pair.counterexample;
        if (pair.state != DifftestState::Differs && !apart) continue;
        out += terminal_text(pair.source) + " differs from " + terminal_text(pair.target);
        if (pair.counterexample) out += counterexample_text(*pair.counterexample);
        out += fmt::format(" (compared {}{})\n", pair.tolerance == "bits" ? "to the bit" : "to " + pair.tolerance,
                           pair.reason.empty() ? "" : "; " + terminal_text(pair.reason));
    }
    if (verbose)
        for (const DifftestPair& pair : pairs)
            if (pair.state != DifftestState::Differs && !pair.counterexample)
                out += fmt::format("{} {} {}\n", difftest_state(pair.state), terminal_text(pair.source),
                                   pair.state == DifftestState::Same
                                       ? fmt::format("{} inputs, {}", pair.inputs, pair.tolerance)
                                       : terminal_text(pair.reason));
    out += fmt::format("{} pairs: {} same, {} differ, {} not run\n", pairs.size(), counts[0], counts[1], counts[2]);
    std::vector<std::pair<size_t, std::string>> sorted;
    for (const auto& [reason, count] : reasons) sorted.emplace_back(count, reason);
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [count, reason] : sorted) out += fmt::format("  {:5} {}\n", count, terminal_text(reason));
    return out;
}

namespace {

nlohmann::ordered_json pairs_json(const std::vector<DifftestPair>& pairs) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    for (const DifftestPair& pair : pairs) {
        nlohmann::ordered_json one;
        one["source"] = pair.source;
        one["target"] = pair.target;
        one["state"] = difftest_state(pair.state);
        one["inputs"] = pair.inputs;
        one["tolerance"] = pair.tolerance;
        one["counterexample"] = nullptr;
        if (pair.counterexample) one["counterexample"] = counterexample_json(*pair.counterexample);
        one["reason"] = pair.reason;
        out.push_back(std::move(one));
    }
    return out;
}

}  // namespace

std::string counterexample_text(const Counterexample& one) {
    const std::string at = seen_inputs(one);
    const std::string& where = one.results.source.path;
    return (at.empty() ? "" : " for " + at) + ": " + (where.empty() ? "" : terminal_text(where) + " is ") +
           seen_text(one.results.source) + ", " + seen_text(one.results.target);
}

nlohmann::ordered_json counterexample_json(const Counterexample& one) {
    nlohmann::ordered_json inputs = nlohmann::ordered_json::object();
    for (const SeenNumber& input : one.inputs) inputs[input.path] = seen_json(input);
    return {{"inputs", inputs},
            {"output", one.results.source.path},
            {"source", seen_json(one.results.source)},
            {"target", seen_json(one.results.target)}};
}

std::string difftest_json(const std::vector<DifftestPair>& pairs) {
    return json_text({{"pairs", pairs_json(pairs)}}, 1) + "\n";
}

std::string difftest_evidence(const DifftestResult& result) {
    nlohmann::ordered_json texts = nlohmann::ordered_json::array();
    for (const auto& [file, print] : result.texts) texts.push_back({{"file", file}, {"fingerprint", print}});
    return json_text({{"version", 1}, {"kind", "difftest"}, {"texts", texts}, {"pairs", pairs_json(result.pairs)}}, 1) +
           "\n";
}

}  // namespace porttool
