// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "porttool/difftest/inputs.h"
#include "porttool/difftest/slot_memory.h"
#include "porttool/scan/side.h"

namespace porttool {

/// One side, built: the program that has it, its number there, and what it takes and gives.
struct BuiltSide {
    std::string program;
    int number = 0;
    Leaves leaves;
    /// Where it is called once a component of a vector: for each call, which of `leaves.in` its numbers are.
    std::vector<std::vector<size_t>> calls = {};
};

/// How alike two results must be.
struct Tolerance {
    int ulps = 0;  ///< 0: to the bit
};

/// What trials that follow each other use again: memory that is new is filled with zeros first, page by page.
struct TrialMemory {
    InputTable table;    ///< of whoever runs the trial
    SlotMemory in, out;  ///< of the run that is under way
    BySide<std::vector<uint64_t>> results;
};

/// What became of one record on both sides.
enum class Outcomes : uint8_t {
    Same,  ///< within the tolerance
    Differs,
    OutOfDomain,  ///< a side did not come back, or every number is NaN on both
};

/// Both sides of a pair, ready to run on the same inputs.
class Trial {
public:
    /// All must outlive it. `memory`: no other trial's meanwhile. `folder`: for its files. `wide`: a side with doubles
    /// for floats, or nullptr: where the other side is no further from its results than this one is, the two differ in
    /// how they round alone.
    Trial(const BuiltSide& source, const BuiltSide& target, const LeafMatch& match, Tolerance tolerance,
          std::string folder, TrialMemory& memory, BySide<const BuiltSide*> wide = {nullptr, nullptr});

    const std::vector<Leaf>& inputs() const { return inputs_; }

    /// Runs both on every record of a table. "" or why that failed; outcomes() then has what became of each record.
    std::string run(const InputTable& table);
    /// The same with the marks that one side alone keeps set. How many records differ, or nothing where that failed.
    std::optional<size_t> run_with_marks(const InputTable& table);
    /// True where both sides give the same again on the table that they ran on last.
    bool repeats(const InputTable& table);
    /// True where the last run ended because a side did not come back from too many of its inputs.
    bool is_endless() const { return endless_; }
    size_t records() const { return records_; }
    Outcomes outcome(size_t record) const;
    /// Where record's results first differ: the place among the outputs.
    std::optional<size_t> first_difference(size_t record) const;
    /// What the source calls an output.
    const Leaf& output(size_t output) const { return source_.leaves.out[match_.out[output].source]; }
    /// A result of either side as a double; whole numbers of 64 bits lose digits.
    double source_result(size_t record, size_t output) const;
    double target_result(size_t record, size_t output) const;
    /// True where both results of an output are numbers of finite size.
    bool is_finite(size_t record, size_t output) const;
    /// How far apart the results of a record are at most, in ulps; 0 for equal bits.
    uint64_t distance(size_t record) const;
    size_t output_count() const { return match_.out.size(); }

private:
    std::string run_side(const BuiltSide& side, const InputTable& table, bool is_target, std::vector<uint64_t>& out);
    /// Runs a side on the memory's `in`, rows of `width` slots, into its `out`.
    std::string run_slots(const BuiltSide& side, size_t width, size_t outputs, bool is_target);
    /// True where all numbers that are compared are the same on both sides, as they nearly always are.
    bool has_same_bits(size_t record) const;
    uint64_t distance_at(size_t record, size_t output) const;
    bool is_rounding(size_t record, size_t output) const;
    std::optional<double> wide_result(Side side, size_t record, size_t output) const;
    const uint64_t* source_row(size_t record) const {
        return &memory_.results.source[record * (source_.leaves.out.size() + 1)];
    }
    const uint64_t* target_row(size_t record) const {
        return &memory_.results.target[record * (target_.leaves.out.size() + 1)];
    }

    const BuiltSide &source_, &target_;
    const LeafMatch& match_;
    Tolerance tolerance_;
    std::string folder_;
    std::vector<Leaf> inputs_;
    bool is_told_by_bits_;  ///< that each output is of one kind on both sides
    size_t records_ = 0;
    bool endless_ = false;
    uint64_t mark_ = 0;  ///< what the marks that one side alone keeps are
    TrialMemory& memory_;
    BySide<const BuiltSide*> wide_;
    BySide<std::vector<uint64_t>> wide_out_;
};

}  // namespace porttool
