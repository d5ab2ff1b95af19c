// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/pair_outcome.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <optional>

#include "porttool/difftest/inputs.h"
#include "porttool/difftest/shrink.h"

namespace porttool {
namespace {

SeenNumber number_of(const Leaf& leaf) {
    SeenNumber out;
    out.path = leaf.path;
    out.is_real = leaf.is_real();
    out.is_single = leaf.kind != NumberKind::Double;
    return out;
}

SeenNumber seen_input(uint64_t number, const Leaf& leaf) {
    SeenNumber out = number_of(leaf);
    if (leaf.is_real())
        out.real = std::bit_cast<double>(number);
    else
        out.whole = static_cast<int64_t>(number);
    return out;
}

SeenNumber seen_result(double value, const Leaf& leaf) {
    SeenNumber out = number_of(leaf);
    out.real = value;
    if (!leaf.is_real()) out.whole = static_cast<int64_t>(value);
    return out;
}

/// True for a difference that says little: at an input that is no finite number, or so large that a result
/// overflows, which two ways to write one formula do at different places.
static bool is_extreme(const Trial& trial, const uint64_t* row, size_t record) {
    constexpr double kLarge = 1e6;
    const double size = size_of_record(row, trial.inputs());
    return std::isinf(size) || (size > kLarge && !trial.is_finite(record, *trial.first_difference(record)));
}

std::optional<Counterexample> counterexample(Trial& trial, const InputTable& table, size_t chosen) {
    const size_t width = trial.inputs().size();
    std::vector<uint64_t> record(table.begin() + static_cast<std::ptrdiff_t>(chosen * width),
                                 table.begin() + static_cast<std::ptrdiff_t>((chosen + 1) * width));
    record = shrunk(trial, std::move(record));
    if (!trial.run(record).empty() || trial.outcome(0) != Outcomes::Differs) return std::nullopt;
    const size_t output = *trial.first_difference(0);
    Counterexample found;
    for (size_t i = 0; i < width; ++i) found.inputs.push_back(seen_input(record[i], trial.inputs()[i]));
    const Leaf& leaf = trial.output(output);
    found.results = {seen_result(trial.source_result(0, output), leaf),
                     seen_result(trial.target_result(0, output), leaf)};
    return found;
}

}  // namespace

size_t tell_outcome(DifftestPair& pair, Trial& trial, const InputTable& table, int ulps) {
    const size_t width = trial.inputs().size();
    size_t differing = 0;
    std::optional<size_t> simplest, extreme;
    int least = 0;
    bool exact = true;
    for (size_t record = 0; record < trial.records(); ++record) {
        const Outcomes outcome = trial.outcome(record);
        if (outcome == Outcomes::OutOfDomain) continue;
        ++pair.inputs;
        exact = exact && trial.distance(record) == 0;
        if (outcome == Outcomes::Same) continue;
        ++differing;
        const uint64_t* const row = table.data() + record * width;
        if (is_extreme(trial, row, record)) {
            if (!extreme) extreme = record;
            continue;
        }
        const int complexity = complexity_of(row, trial.inputs());
        if (simplest && complexity >= least) continue;
        simplest = record;
        least = complexity;
    }
    if ((simplest || extreme) && !trial.repeats(table)) {
        pair.inputs = 0;
        pair.reason = "it gives something else on every call";
        return 0;
    }
    if (pair.inputs == 0) {
        pair.reason = "no input on which both sides give a number";
        return 0;
    }
    pair.tolerance = exact || ulps == 0 ? "bits" : fmt::format("{} ulps", ulps);
    pair.state = simplest ? DifftestState::Differs : DifftestState::Same;
    if (!simplest && extreme)
        pair.reason = "but for inputs that are not finite, or so large that a result overflows, it differs";
    if (simplest || extreme) pair.counterexample = counterexample(trial, table, simplest ? *simplest : *extreme);
    return differing;
}

}  // namespace porttool
