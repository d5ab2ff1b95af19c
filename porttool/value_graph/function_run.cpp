// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/value_graph/function_run.h"

#include <algorithm>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_text.h"

namespace porttool {
namespace {

constexpr size_t kMostSteps = 1'500, kMostLoops = 6, kMostWays = 200;

std::string_view first_word(const Step& step) {
    return step.words.empty() ? std::string_view() : std::string_view(step.words[0]);
}

bool is_loop(const Step& step) { return is_one_of(first_word(step), {"for", "while", "do"}); }

/// After the bracket that closes the one at `open`.
size_t after_closing(const std::vector<std::string>& words, size_t open) {
    int depth = 0;
    for (size_t i = open; i < words.size(); ++i) {
        depth += words[i] == "(" ? 1 : words[i] == ")" ? -1 : 0;
        if (depth == 0) return i + 1;
    }
    throw Unread();
}

/// True if a return stands in the block.
bool returns(const std::vector<Step>& block) {
    return std::any_of(block.begin(), block.end(), [](const Step& step) {
        return is_one_of(first_word(step), {"return", "discard"}) || returns(step.block);
    });
}

}  // namespace

FunctionRun::FunctionRun(ValueTable& table, const ReadingManner& manner, const Step& function)
    : table_(table),
      machine_(table, manner),
      function_(function),
      end_(table.node("end")),
      returns_(table.node("returns")),
      breaks_(table.node("breaks")),
      nothing_(table.node("nothing")) {
    const Text& words = function.words;
    const auto name = static_cast<size_t>(std::find(words.begin(), words.end(), "@") - words.begin());
    if (!function.has_block || name == 0 || name + 1 >= words.size() || words[name + 1] != "(") throw Unread();
    const size_t after = after_closing(words, name + 1);
    for (size_t i = after; i < words.size(); ++i)
        if (!is_one_of(words[i], {"const", "override", "final", "noexcept"})) throw Unread();
    size_t type = name;  // qualifiers and template parameters stand before it
    while (type > 0 && (words[type - 1] == "*" || words[type - 1] == "&" || words[type - 1] == "const")) --type;
    if (type == 0 || !is_word_token(words[type - 1])) throw Unread();
    for (--type; type > 1 && words[type - 1] == "::"; type -= 2) {
    }
    Text result(words.begin() + static_cast<std::ptrdiff_t>(type), words.begin() + static_cast<std::ptrdiff_t>(name));
    if (std::find(result.begin(), result.end(), "&") != result.end()) throw Unread();
    types_.push_back(machine_.type_name(result, 0, result.size()));
    start_.world = table_.node("world");
    const std::vector<std::string> parameters = machine_.declare_parameters(words, name + 2, after - 1, start_);
    types_.insert(types_.end(), parameters.begin(), parameters.end());
}

Value FunctionRun::outcome() {
    const Result result = run({&function_.block}, start_, nullptr);
    return table_.node("outcome", {result.given, result.state.world});
}

FunctionRun::Result FunctionRun::merged(Value condition, const Result& yes, const Result& no) {
    return {table_.choice(condition, yes.way, no.way), table_.choice(condition, yes.given, no.given),
            chosen(table_, condition, yes.state, no.state)};
}

MachineState FunctionRun::run_block(const std::vector<Step>& block, const MachineState& state) {
    return run({&block}, state, nullptr).state;
}

FunctionRun::Result FunctionRun::given_back(const Text& words, MachineState state) {
    if (words[0] == "discard") return {returns_, table_.node("discarded"), std::move(state)};
    if (words.size() == 1) return {returns_, nothing_, std::move(state)};
    const Value value = machine_.value_of(words, 1, words.size(), state);
    return {returns_, table_.converted(value, types_[0]), std::move(state)};
}

FunctionRun::Stretch FunctionRun::in_parentheses(const Step& step) const {
    if (step.words.size() < 3 || step.words[1] != "(" || after_closing(step.words, 1) != step.words.size())
        throw Unread();
    return {&step.words, 2, step.words.size() - 1};
}

Value FunctionRun::value_at(const Stretch& stretch, MachineState& state) {
    return machine_.value_of(*stretch.words, stretch.first, stretch.end, state);
}

void FunctionRun::run_at(const Stretch& stretch, MachineState& state) {
    if (!stretch.empty()) machine_.run_plain(*stretch.words, stretch.first, stretch.end, state);
}

Value FunctionRun::condition_of(const Step& step, MachineState& state) { return value_at(in_parentheses(step), state); }

FunctionRun::Result FunctionRun::run(Rest here, MachineState state, const Loop* loop) {
    for (;;) {
        if (here.at == here.block->size()) {
            if (here.outer != nullptr) {
                here = *here.outer;
                continue;
            }
            if (loop != nullptr) run_at(loop->step, state);
            return {end_, nothing_, std::move(state)};
        }
        if (++steps_ > kMostSteps) throw Unread();
        const Step& step = (*here.block)[here.at++];
        const std::string_view word = first_word(step);
        if (word == "return" || word == "discard") return given_back(step.words, std::move(state));
        if (word == "break" || word == "continue") {
            if (loop == nullptr) throw Unread();
            if (word == "continue") run_at(loop->step, state);
            return {word == "break" ? breaks_ : end_, nothing_, std::move(state)};
        }
        if (word == "if") {
            const bool has_else = here.at < here.block->size() && first_word((*here.block)[here.at]) == "else";
            const Step* other = has_else ? &(*here.block)[here.at++] : nullptr;
            if (other != nullptr && other->words.size() != 1) throw Unread();
            const Value condition = condition_of(step, state);
            if (step.leaves || (other != nullptr && other->leaves)) {
                if (++ways_ > kMostWays) throw Unread();
                const Rest rest = here;
                const Result yes = run({&step.block, 0, &rest}, state, loop);
                const Result no =
                    other != nullptr ? run({&other->block, 0, &rest}, state, loop) : run(rest, state, loop);
                --ways_;
                return merged(condition, yes, no);
            }
            const MachineState no = other != nullptr ? run_block(other->block, state) : state;
            state = chosen(table_, condition, run_block(step.block, state), no);
            continue;
        }
        if (is_loop(step)) {
            const Loop inner = loop_of(step, here);
            const Value node = run_loop(inner, state);
            if (!returns(inner.body->block)) continue;
            const Result left{returns_, table_.node("given by", {node}), state};
            return merged(table_.node("returned", {node}), left, run(here, state, loop));
        }
        if (step.has_block || word.empty()) throw Unread();
        machine_.run_plain(step.words, 0, step.words.size(), state);
    }
}

FunctionRun::Loop FunctionRun::loop_of(const Step& step, Rest& here) const {
    Loop loop;
    loop.body = &step;
    if (!step.has_block) throw Unread();
    if (first_word(step) == "do") {
        const bool closed = here.at < here.block->size() && first_word((*here.block)[here.at]) == "while";
        if (!closed || step.words.size() != 1) throw Unread();
        const Step& tail = (*here.block)[here.at++];
        if (tail.has_block) throw Unread();
        loop.condition = in_parentheses(tail);
        loop.body_first = true;
        return loop;
    }
    const Stretch inside = in_parentheses(step);
    if (first_word(step) == "while") {
        loop.condition = inside;
        return loop;
    }
    std::vector<size_t> ends;
    for (size_t i = inside.first; i < inside.end; ++i)
        if (step.words[i] == ";") ends.push_back(i);
    if (ends.size() != 2) throw Unread();
    loop.init = {&step.words, inside.first, ends[0]};
    loop.condition = {&step.words, ends[0] + 1, ends[1]};
    loop.step = {&step.words, ends[1] + 1, inside.end};
    return loop;
}

FunctionRun::Turn FunctionRun::run_turn(const Loop& loop, MachineState state) {
    const Value always = table_.node("true", {}, "bool");
    if (loop.body_first) {
        Result result = run({&loop.body->block}, std::move(state), &loop);
        MachineState after = result.state;
        const Value condition = value_at(loop.condition, after);
        return {condition, after, std::move(result)};
    }
    const Value condition = loop.condition.empty() ? always : value_at(loop.condition, state);
    MachineState left = state;
    return {condition, std::move(left), run({&loop.body->block}, std::move(state), &loop)};
}

/// The state at the begin of a turn: what the loop carries from turn to turn is not known.
MachineState FunctionRun::unknown_start(const MachineState& state, const std::string& name,
                                        const std::vector<size_t>& carried) {
    MachineState out = state;
    for (size_t k = 0; k < carried.size(); ++k) {
        const LocalKind& kind = machine_.kind(carried[k]);
        out.locals[carried[k]] = table_.node(name + std::to_string(k), {}, kind.array ? "" : kind.type);
    }
    return out;
}

/// The locals that a turn may change, and whether it may change the world: with nothing known of any, what comes out as
/// it went in is not changed.
std::vector<size_t> FunctionRun::carried(const Loop& loop, const MachineState& state, bool& world) {
    std::vector<size_t> all;
    for (const auto& [local, value] : state.locals)
        if (!machine_.kind(local).cell) all.push_back(local);
    MachineState start = unknown_start(state, "probe " + std::to_string(loops_) + " ", all);
    start.world = table_.node("probe of the world " + std::to_string(loops_));
    const Turn turn = run_turn(loop, start);
    world = turn.left.world != start.world || turn.result.state.world != start.world;
    std::vector<size_t> out;
    for (const size_t local : all)
        if (turn.left.locals.at(local) != start.locals.at(local) ||
            turn.result.state.locals.at(local) != start.locals.at(local))
            out.push_back(local);
    return out;
}

/// Runs a loop: one node says what a turn does to what it carries, and what holds it up. Returns that node.
Value FunctionRun::run_loop(const Loop& loop, MachineState& state) {
    if (++loops_ > kMostLoops) throw Unread();
    run_at(loop.init, state);
    bool world = false;
    const std::vector<size_t> locals = carried(loop, state, world);
    MachineState start = unknown_start(state, "carried " + std::to_string(loops_) + " ", locals);
    const Value unknown_world = table_.node("carried world " + std::to_string(loops_));
    if (world) start.world = unknown_world;
    const Turn turn = run_turn(loop, start);
    std::vector<Value> parts = {turn.condition, turn.result.way, turn.result.given,
                                state.world,    turn.left.world, turn.result.state.world};
    for (const size_t local : locals)
        for (const Value value :
             {state.locals.at(local), turn.left.locals.at(local), turn.result.state.locals.at(local)})
            parts.push_back(value);
    const Value node = table_.node(loop.body_first ? "do" : "loop", std::move(parts));
    for (size_t k = 0; k < locals.size(); ++k) {
        const LocalKind& kind = machine_.kind(locals[k]);
        state.locals[locals[k]] =
            table_.node("after", {node, table_.node(std::to_string(k))}, kind.array ? "" : kind.type);
    }
    if (world) state.world = table_.node("world after", {node});
    --loops_;
    return node;
}

}  // namespace porttool
