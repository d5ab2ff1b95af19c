// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "porttool/difftest/bounded_process.h"

namespace porttool {
namespace {

constexpr uint64_t kFar = std::numeric_limits<uint64_t>::max();
constexpr std::chrono::milliseconds kRunTime{20000};

/// Floats in the order of their values, with -0 beside 0.
int64_t rank_of(float value) {
    const auto bits = std::bit_cast<int32_t>(value);
    return bits < 0 ? -1 - static_cast<int64_t>(bits & 0x7fffffff) : bits;
}
uint64_t rank_distance(double a, double b) {
    const auto rank = [](double value) {
        const auto bits = std::bit_cast<int64_t>(value);
        return bits < 0 ? -1 - (bits & std::numeric_limits<int64_t>::max()) : bits;
    };
    const int64_t low = std::min(rank(a), rank(b)), high = std::max(rank(a), rank(b));
    return static_cast<uint64_t>(high) - static_cast<uint64_t>(low);
}

double value_of(uint64_t slot, const Leaf& leaf) {
    if (leaf.kind == NumberKind::Double) return std::bit_cast<double>(slot);
    if (leaf.is_real()) return static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(slot)));
    return static_cast<double>(static_cast<int64_t>(slot));
}

/// Where a number of the table goes in a row of one side, and as what.
struct Slot {
    size_t place;
    bool is_float;
    uint64_t of(uint64_t input) const {
        return is_float ? std::bit_cast<uint32_t>(static_cast<float>(std::bit_cast<double>(input))) : input;
    }
};

}  // namespace

Trial::Trial(const BuiltSide& source, const BuiltSide& target, const LeafMatch& match, Tolerance tolerance,
             std::string folder, TrialMemory& memory, BySide<const BuiltSide*> wide)
    : source_(source),
      target_(target),
      match_(match),
      tolerance_(tolerance),
      folder_(std::move(folder)),
      inputs_(common_inputs(source.leaves, target.leaves, match)),
      is_told_by_bits_(std::all_of(match.out.begin(), match.out.end(),
                                   [&](const BySide<size_t>& place) {
                                       const Leaf& ours = source.leaves.out[place.source];
                                       return !ours.is_real() || ours.kind == target.leaves.out[place.target].kind;
                                   })),
      memory_(memory),
      wide_(wide) {}

std::string Trial::run_side(const BuiltSide& side, const InputTable& table, bool is_target,
                            std::vector<uint64_t>& out) {
    SlotMemory &in = memory_.in, &results_of_run = memory_.out;
    const size_t calls = std::max<size_t>(1, side.calls.size());
    const size_t width = side.calls.empty() ? side.leaves.in.size() : side.calls.front().size();
    const Side which = is_target ? Side::Target : Side::Source;
    const size_t outputs = side.calls.empty() ? side.leaves.out.size() : 1;
    if (!in.resize(records_ * calls * width) || !results_of_run.resize(records_ * calls * (outputs + 1)))
        return "there is no memory for its inputs; give --inputs a smaller number";
    uint64_t* next = in.slots().data();
    std::vector<uint64_t> row(side.leaves.in.size());
    for (const size_t place : match_.marks[which]) row[place] = mark_;
    std::vector<Slot> slots;
    for (size_t i = 0; i < inputs_.size(); ++i) {
        const size_t place = match_.in[i][which];
        const bool is_float = inputs_[i].is_real() && side.leaves.in[place].kind != NumberKind::Double;
        slots.push_back({place, is_float});
    }
    const uint64_t* input = table.data();
    for (size_t record = 0; record < records_; ++record) {
        for (const Slot& slot : slots) {
            row[slot.place] = slot.of(*input);
            ++input;
        }
        if (side.calls.empty()) next = std::copy(row.begin(), row.end(), next);
        for (const std::vector<size_t>& numbers : side.calls)
            for (const size_t place : numbers) *next++ = row[place];
    }
    std::fill(results_of_run.slots().begin(), results_of_run.slots().end(), 1);
    std::string failure = run_slots(side, width, outputs, is_target);
    if (side.calls.empty()) {
        out.assign(results_of_run.slots().begin(), results_of_run.slots().end());
        return failure;
    }
    out.assign(records_ * (calls + 1), 0);
    for (size_t i = 0; i < records_ * calls; ++i) {
        uint64_t* const results = &out[i / calls * (calls + 1)];
        results[0] = std::max(results[0], results_of_run.slots()[2 * i]);
        results[1 + i % calls] = results_of_run.slots()[2 * i + 1];
    }
    return failure;
}

std::string Trial::run_slots(const BuiltSide& side, size_t width, size_t outputs, bool is_target) {
    ProcessLimits limits;
    limits.time = kRunTime;
    const ProcessEnd end = run_process(
        {side.program, "run", std::to_string(side.number), std::to_string(width), std::to_string(outputs + 1),
         memory_.in.path(), memory_.out.path(), std::to_string(memory_.out.slots().size() / (outputs + 1))},
        folder_, limits);
    const char* const which = is_target ? "the target" : "the source";
    if (end.timed_out) return fmt::format("{} ran for more than {} s", which, kRunTime.count() / 1000);
    constexpr int kEndless = 5;  // of harness.h
    endless_ = end.exit_code == kEndless;
    if (endless_) return fmt::format("{} does not come back from many of its inputs", which);
    return end.exit_code == 0 ? std::string() : fmt::format("{} ended with exit code {}", which, end.exit_code);
}

std::string Trial::run(const InputTable& table) {
    records_ = inputs_.empty() ? 1 : table.size() / inputs_.size();
    std::string failure = run_side(source_, table, false, memory_.results.source);
    if (failure.empty()) failure = run_side(target_, table, true, memory_.results.target);
    for (const Side side : kBothSides)
        if (failure.empty() && wide_[side] != nullptr &&
            !run_side(*wide_[side], table, side == Side::Target, wide_out_[side]).empty())
            wide_[side] = nullptr;
    return failure;
}

std::optional<size_t> Trial::run_with_marks(const InputTable& table) {
    mark_ = 1;
    const std::string failure = run(table);
    mark_ = 0;
    if (!failure.empty()) return std::nullopt;
    size_t differing = 0;
    for (size_t record = 0; record < records_; ++record)
        if (outcome(record) == Outcomes::Differs) ++differing;
    return differing;
}

bool Trial::repeats(const InputTable& table) {
    const std::vector<uint64_t> source = memory_.results.source, target = memory_.results.target;
    return run(table).empty() && source == memory_.results.source && target == memory_.results.target;
}

bool Trial::has_same_bits(size_t record) const {
    if (!is_told_by_bits_) return false;
    const uint64_t *const ours = source_row(record) + 1, *const theirs = target_row(record) + 1;
    return std::all_of(match_.out.begin(), match_.out.end(),
                       [&](const BySide<size_t>& place) { return ours[place.source] == theirs[place.target]; });
}

uint64_t Trial::distance_at(size_t record, size_t output) const {
    const BySide<size_t>& place = match_.out[output];
    const Leaf &ours = source_.leaves.out[place.source], &theirs = target_.leaves.out[place.target];
    const uint64_t a = source_row(record)[1 + place.source], b = target_row(record)[1 + place.target];
    if (!ours.is_real()) return a == b ? 0 : kFar;
    if (a == b && ours.kind == theirs.kind) return 0;
    const double x = value_of(a, ours), y = value_of(b, theirs);
    if (std::isnan(x) || std::isnan(y)) return std::isnan(x) && std::isnan(y) ? 0 : kFar;
    if (ours.kind == NumberKind::Double && theirs.kind == NumberKind::Double) return rank_distance(x, y);
    const int64_t p = rank_of(static_cast<float>(x)), q = rank_of(static_cast<float>(y));
    return static_cast<uint64_t>(std::max(p, q) - std::min(p, q));
}

uint64_t Trial::distance(size_t record) const {
    if (has_same_bits(record)) return 0;
    uint64_t most = 0;
    for (size_t i = 0; i < output_count(); ++i) most = std::max(most, distance_at(record, i));
    return most;
}

std::optional<double> Trial::wide_result(Side side, size_t record, size_t output) const {
    if (wide_[side] == nullptr) return std::nullopt;
    const std::vector<Leaf>& leaves = wide_[side]->leaves.out;
    const size_t place = match_.out[output][side];
    const uint64_t* const row = &wide_out_[side][record * (leaves.size() + 1)];
    if (row[0] == 1 || !leaves[place].is_real()) return std::nullopt;
    const double value = value_of(row[1 + place], leaves[place]);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool Trial::is_rounding(size_t record, size_t output) const {
    if (!source_.leaves.out[match_.out[output].source].is_real() || !is_finite(record, output)) return false;
    const BySide<double> results = {source_result(record, output), target_result(record, output)};
    constexpr double kSlack = 8;
    for (const Side side : kBothSides) {
        const std::optional<double> truth = wide_result(side, record, output);
        if (!truth) continue;
        const double step = std::ldexp(std::max(std::fabs(*truth), 0x1p-126), -23) * tolerance_.ulps;
        if (std::fabs(results[other(side)] - *truth) <= kSlack * std::fabs(results[side] - *truth) + step) return true;
    }
    return false;
}

std::optional<size_t> Trial::first_difference(size_t record) const {
    if (has_same_bits(record)) return std::nullopt;
    for (size_t i = 0; i < output_count(); ++i)
        if (distance_at(record, i) > static_cast<uint64_t>(tolerance_.ulps) && !is_rounding(record, i)) return i;
    return std::nullopt;
}

Outcomes Trial::outcome(size_t record) const {
    // Sides that asked for many answers are held side by side where they asked for as many.
    if (source_row(record)[0] == 1 || source_row(record)[0] != target_row(record)[0]) return Outcomes::OutOfDomain;
    if (first_difference(record)) return Outcomes::Differs;
    for (size_t i = 0; i < output_count(); ++i)
        if (!source_.leaves.out[match_.out[i].source].is_real() || !std::isnan(source_result(record, i)))
            return Outcomes::Same;
    return Outcomes::OutOfDomain;
}

bool Trial::is_finite(size_t record, size_t output) const {
    return std::isfinite(source_result(record, output)) && std::isfinite(target_result(record, output));
}

double Trial::source_result(size_t record, size_t output) const {
    const size_t place = match_.out[output].source;
    return value_of(source_row(record)[1 + place], source_.leaves.out[place]);
}

double Trial::target_result(size_t record, size_t output) const {
    const size_t place = match_.out[output].target;
    return value_of(target_row(record)[1 + place], target_.leaves.out[place]);
}

}  // namespace porttool
