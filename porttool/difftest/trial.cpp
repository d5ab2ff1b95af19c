// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <limits>

#include "porttool/difftest/bounded_process.h"

namespace porttool {
namespace {

constexpr uint64_t kFar = std::numeric_limits<uint64_t>::max();
constexpr std::chrono::milliseconds kRunTime{20000};

bool write_slots(const std::string& path, const std::vector<uint64_t>& slots) {
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    if (file == nullptr) return false;
    const bool whole = std::fwrite(slots.data(), sizeof(uint64_t), slots.size(), file) == slots.size();
    return (std::fclose(file) == 0) && whole;
}

bool read_slots(const std::string& path, std::vector<uint64_t>& slots) {
    std::FILE* const file = std::fopen(path.c_str(), "rb");
    if (file == nullptr) return false;
    const bool whole = std::fread(slots.data(), sizeof(uint64_t), slots.size(), file) == slots.size();
    std::fclose(file);
    return whole;
}

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

}  // namespace

Trial::Trial(const BuiltSide& source, const BuiltSide& target, const LeafMatch& match, Tolerance tolerance,
             std::string folder, BySide<const BuiltSide*> wide)
    : source_(source),
      target_(target),
      match_(match),
      tolerance_(tolerance),
      folder_(std::move(folder)),
      inputs_(common_inputs(source.leaves, target.leaves, match)),
      wide_(wide) {}

std::string Trial::run_side(const BuiltSide& side, const InputTable& table, bool is_target,
                            std::vector<uint64_t>& out) {
    std::vector<uint64_t> slots(std::max<size_t>(1, table.size()));
    for (size_t row = 0; row < records_; ++row)
        for (size_t i = 0; i < inputs_.size(); ++i) {
            const size_t place = is_target ? match_.in[i] : i;
            slots[row * inputs_.size() + place] =
                slot_of(table[row * inputs_.size() + i], inputs_[i], side.leaves.in[place]);
        }
    if (side.calls.empty()) return run_slots(side, slots, inputs_.size(), side.leaves.out.size(), is_target, out);
    const size_t calls = side.calls.size();
    std::vector<uint64_t> parts, results;
    for (size_t row = 0; row < records_; ++row)
        for (const std::vector<size_t>& numbers : side.calls)
            for (const size_t place : numbers) parts.push_back(slots[row * inputs_.size() + place]);
    std::string failure = run_slots(side, parts, side.calls.front().size(), 1, is_target, results);
    out.assign(records_ * (calls + 1), 0);
    for (size_t i = 0; i < records_ * calls; ++i) {
        uint64_t* const row = &out[i / calls * (calls + 1)];
        row[0] = std::max(row[0], results[2 * i]);
        row[1 + i % calls] = results[2 * i + 1];
    }
    return failure;
}

std::string Trial::run_slots(const BuiltSide& side, const std::vector<uint64_t>& slots, size_t width, size_t outputs,
                             bool is_target, std::vector<uint64_t>& out) {
    const size_t out_width = outputs + 1;
    out.assign(records_ * std::max<size_t>(1, side.calls.size()) * out_width, 1);
    const std::string in_path = folder_ + "/in" + std::to_string(side.number),
                      out_path = folder_ + "/out" + std::to_string(side.number);
    if (!write_slots(in_path, slots) || !write_slots(out_path, out))
        return "its inputs cannot be written: is the disk full?";
    ProcessLimits limits;
    limits.time = kRunTime;
    const ProcessEnd end = run_process({side.program, "run", std::to_string(side.number), std::to_string(width),
                                        std::to_string(out_width), in_path, out_path},
                                       folder_, limits);
    const bool read = read_slots(out_path, out);
    (void)std::remove(in_path.c_str());
    (void)std::remove(out_path.c_str());
    const char* const which = is_target ? "the target" : "the source";
    if (end.timed_out) return fmt::format("{} ran for more than {} s", which, kRunTime.count() / 1000);
    constexpr int kEndless = 5;  // of harness.h
    endless_ = end.exit_code == kEndless;
    if (endless_) return fmt::format("{} does not come back from many of its inputs", which);
    if (end.exit_code != 0) return fmt::format("{} ended with exit code {}", which, end.exit_code);
    return read ? std::string() : "its outputs cannot be read";
}

std::string Trial::run(const InputTable& table) {
    records_ = inputs_.empty() ? 1 : table.size() / inputs_.size();
    std::string failure = run_side(source_, table, false, source_out_);
    if (failure.empty()) failure = run_side(target_, table, true, target_out_);
    for (const Side side : kBothSides)
        if (failure.empty() && wide_[side] != nullptr &&
            !run_side(*wide_[side], table, side == Side::Target, wide_out_[side]).empty())
            wide_[side] = nullptr;
    return failure;
}

bool Trial::repeats(const InputTable& table) {
    const std::vector<uint64_t> source = source_out_, target = target_out_;
    return run(table).empty() && source == source_out_ && target == target_out_;
}

uint64_t Trial::distance_at(size_t record, size_t output) const {
    const Leaf &ours = source_.leaves.out[output], &theirs = target_.leaves.out[match_.out[output]];
    const uint64_t a = source_row(record)[1 + output], b = target_row(record)[1 + match_.out[output]];
    if (!ours.is_real()) return a == b ? 0 : kFar;
    if (a == b && ours.kind == theirs.kind) return 0;
    const double x = value_of(a, ours), y = value_of(b, theirs);
    if (std::isnan(x) || std::isnan(y)) return std::isnan(x) && std::isnan(y) ? 0 : kFar;
    if (ours.kind == NumberKind::Double && theirs.kind == NumberKind::Double) return rank_distance(x, y);
    const int64_t p = rank_of(static_cast<float>(x)), q = rank_of(static_cast<float>(y));
    return static_cast<uint64_t>(std::max(p, q) - std::min(p, q));
}

uint64_t Trial::distance(size_t record) const {
    uint64_t most = 0;
    for (size_t i = 0; i < output_count(); ++i) most = std::max(most, distance_at(record, i));
    return most;
}

std::optional<double> Trial::wide_result(Side side, size_t record, size_t output) const {
    if (wide_[side] == nullptr) return std::nullopt;
    const std::vector<Leaf>& leaves = wide_[side]->leaves.out;
    const size_t place = side == Side::Source ? output : match_.out[output];
    const uint64_t* const row = &wide_out_[side][record * (leaves.size() + 1)];
    if (row[0] != 0 || !leaves[place].is_real()) return std::nullopt;
    const double value = value_of(row[1 + place], leaves[place]);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

bool Trial::is_rounding(size_t record, size_t output) const {
    if (!source_.leaves.out[output].is_real() || !is_finite(record, output)) return false;
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
    for (size_t i = 0; i < output_count(); ++i)
        if (distance_at(record, i) > static_cast<uint64_t>(tolerance_.ulps) && !is_rounding(record, i)) return i;
    return std::nullopt;
}

Outcomes Trial::outcome(size_t record) const {
    if (source_row(record)[0] != 0 || target_row(record)[0] != 0) return Outcomes::OutOfDomain;
    if (first_difference(record)) return Outcomes::Differs;
    for (size_t i = 0; i < output_count(); ++i)
        if (!source_.leaves.out[i].is_real() || !std::isnan(source_result(record, i))) return Outcomes::Same;
    return Outcomes::OutOfDomain;
}

bool Trial::is_finite(size_t record, size_t output) const {
    return std::isfinite(source_result(record, output)) && std::isfinite(target_result(record, output));
}

double Trial::source_result(size_t record, size_t output) const {
    return value_of(source_row(record)[1 + output], source_.leaves.out[output]);
}

double Trial::target_result(size_t record, size_t output) const {
    const size_t place = match_.out[output];
    return value_of(target_row(record)[1 + place], target_.leaves.out[place]);
}

}  // namespace porttool
