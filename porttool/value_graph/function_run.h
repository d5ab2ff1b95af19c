// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/value_graph/machine.h"
#include "porttool/value_graph/steps.h"

namespace porttool {

/// A function run once on values that are not known. Throws Unread.
class FunctionRun {
public:
    /// `function`: its head with the block of its body. The three outlive this.
    FunctionRun(ValueTable& table, const ReadingManner& manner, const Step& function);

    /// The types of its result and its parameters, in their order.
    const std::vector<std::string>& types() const { return types_; }

    /// All that it does, as one value: what it gives back and the world after it.
    Value outcome();

private:
    using Text = Machine::Text;

    /// The statements that are left to run, block by block outwards.
    struct Rest {
        const std::vector<Step>* block;
        size_t at = 0;
        const Rest* outer = nullptr;
    };
    /// How a run ended: the way out ("end" for the end of what was to run), what is given back, and the state.
    struct Result {
        Value way, given;
        MachineState state;
    };
    /// A stretch of a statement's words.
    struct Stretch {
        const Text* words = nullptr;
        size_t first = 0, end = 0;
        bool empty() const { return first == end; }
    };
    struct Loop {
        Stretch init, condition, step;
        const Step* body = nullptr;
        bool body_first = false;  ///< do ... while
    };
    /// A turn of a loop: its condition, the state where that does not hold, and how the body ends where it does.
    struct Turn {
        Value condition;
        MachineState left;
        Result result;
    };

    Result run(Rest here, MachineState state, const Loop* loop);
    Result merged(Value condition, const Result& yes, const Result& no);
    MachineState run_block(const std::vector<Step>& block, const MachineState& state);
    Result given_back(const Text& words, MachineState state);
    Value condition_of(const Step& step, MachineState& state);
    Loop loop_of(const Step& step, Rest& here) const;
    Value run_loop(const Loop& loop, MachineState& state);
    Turn run_turn(const Loop& loop, MachineState state);
    MachineState unknown_start(const MachineState& state, const std::string& name, const std::vector<size_t>& carried);
    std::vector<size_t> carried(const Loop& loop, const MachineState& state, bool& world);
    Value value_at(const Stretch& stretch, MachineState& state);
    void run_at(const Stretch& stretch, MachineState& state);
    Stretch in_parentheses(const Step& step) const;

    ValueTable& table_;
    Machine machine_;
    const Step& function_;
    std::vector<std::string> types_;
    MachineState start_;
    Value end_, returns_, breaks_, nothing_;
    size_t loops_ = 0;  ///< that are open
    size_t ways_ = 0;   ///< choices after which what follows is run once for each way, that are open
    size_t steps_ = 0;  ///< that were run
};

}  // namespace porttool
