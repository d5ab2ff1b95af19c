// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/stand_ins.h"

#include <algorithm>
#include <functional>

#include "porttool/difftest/old_style.h"
#include "porttool/difftest/variable_type.h"

namespace porttool {
namespace {

/// The variables that a function names: what a run does not have.
std::set<std::string, std::less<>> bindings_of(const Definition& one, const Definitions& definitions) {
    const LexedText& lexed = one.file->lexed;
    std::set<std::string, std::less<>> out;
    for (uint32_t i = one.unit->body.first; i < one.unit->body.end; ++i) {
        if (lexed.tokens[i].kind != TokenKind::Identifier) continue;
        if (i > 0 && (lexed.view(i - 1) == "." || lexed.view(i - 1) == "->")) continue;
        for (const Definition* found : definitions.find(*one.file, lexed.view(i)))
            if (found->kind == Definition::Kind::Variable) out.insert(found->name);
    }
    return out;
}

/// What a function gives, as it is written; without what says how it is linked.
std::string type_given_by(const Definition& one) {
    std::string out;
    for (uint32_t i = one.unit->tokens.first; i < one.unit->name_token; ++i) {
        const std::string_view word = one.file->lexed.view(i);
        if (word == "inline" || word == "static" || word == "constexpr" || word.starts_with("__") || word == "const")
            continue;
        out += (out.empty() ? "" : " ") + std::string(word);
    }
    return out;
}

/// True for a function that takes values alone: then an answer can stand for it, or a note of what it was given.
bool can_be_stood_in_for(const Definition& one) {
    const LexedText& lexed = one.file->lexed;
    if (is_old_style(lexed, *one.unit) || has_two_heads(lexed, *one.unit)) return false;
    for (uint32_t i = one.unit->parameters.first; i < one.unit->parameters.end; ++i) {
        const std::string_view word = lexed.view(i);
        if (word == "*" || word == "out" || word == "inout" || word == "[" || word == "&") return false;
    }
    for (uint32_t i = one.unit->tokens.first; i < one.unit->name_token; ++i)
        if (lexed.view(i) == "template") return false;
    return true;
}

/// Finds them, side by side.
class StandInFinder {
public:
    StandInFinder(const Definitions& source, const Definitions& target) : source_(source), target_(target) {}

    BySide<StandIns> run(const std::vector<BySide<const Definition*>>& pairs) {
        supply_variables();
        int number = 0;
        for (const BySide<const Definition*>& pair : pairs) {
            const Definition *ours = pair.source, *theirs = pair.target;
            if (!can_be_stood_in_for(*ours) || !can_be_stood_in_for(*theirs)) continue;
            if (!needs_stand_in(*ours, *theirs)) continue;
            if (stand_ins_.source.functions.contains(ours) || stand_ins_.target.functions.contains(theirs)) continue;
            stand_ins_.source.functions[ours] = stand_ins_.target.functions[theirs] = ++number;
        }
        for (const Side side : kBothSides) supply_by_name(side, number);
        return std::move(stand_ins_);
    }

private:
    /// Variables that both sides have under one name, of a type that a run can make.
    void supply_variables() {
        BySide<std::set<std::string, std::less<>>> single, many;
        for (const Side side : kBothSides)
            for (const Definition* one : definitions(side).all_of(Definition::Kind::Variable)) {
                const VariableType type = type_of_variable(*one);
                if (!type.name.empty()) (type.is_single() ? single : many)[side].insert(one->name);
            }
        const auto supply = [&](const BySide<std::set<std::string, std::less<>>>& found, auto StandIns::*supplied) {
            for (const std::string& name : found.source)
                if (found.target.contains(name))
                    for (const Side side : kBothSides) (stand_ins_[side].*supplied).insert(name);
        };
        supply(single, &StandIns::variables);
        supply(many, &StandIns::arrays);
    }

    /// True where a side reads what is not supplied, or where the two do not read the same.
    bool needs_stand_in(const Definition& source, const Definition& target) const {
        const auto ours = bindings_of(source, source_), theirs = bindings_of(target, target_);
        if (ours != theirs) return true;
        return std::any_of(ours.begin(), ours.end(),
                           [&](const std::string& name) { return !stand_ins_.source.variables.contains(name); });
    }

    /// What a side reads by a function that the other has only by a name that the scan cannot see.
    void supply_by_name(Side side, int& number) {
        for (const Definition* one : definitions(side).all_of(Definition::Kind::Function)) {
            if (one->unit == nullptr || !one->owner.empty() || definitions(other(side)).defines(one->name)) continue;
            if (stand_ins_[side].functions.contains(one) || !can_be_stood_in_for(*one)) continue;
            const auto read = bindings_of(*one, definitions(side));
            if (std::all_of(read.begin(), read.end(),
                            [&](const std::string& name) { return stand_ins_[side].variables.contains(name); }))
                continue;
            const auto [answer, is_new] = stand_ins_[other(side)].named.try_emplace(one->name);
            if (is_new) answer->second = {++number, type_given_by(*one)};
            stand_ins_[side].functions[one] = answer->second.number;
        }
    }

    const Definitions& definitions(Side side) const { return side == Side::Source ? source_ : target_; }

    const Definitions &source_, &target_;
    BySide<StandIns> stand_ins_;
};

}  // namespace

bool gives_nothing(const Definition& function) {
    for (uint32_t i = function.unit->tokens.first; i < function.unit->name_token; ++i)
        if (function.file->lexed.view(i) == "void") return true;
    return false;
}

BySide<StandIns> stand_ins_of(const std::vector<BySide<const Definition*>>& pairs, const Definitions& source,
                              const Definitions& target) {
    return StandInFinder(source, target).run(pairs);
}

}  // namespace porttool
