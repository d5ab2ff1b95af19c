// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/common_texts.h"

#include <algorithm>

#include "porttool/audit/components.h"
#include "porttool/audit/essence.h"
#include "porttool/compare/meaning.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/directive_end.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/prelude.h"
#include "porttool/normal/statements.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// Without preprocessor lines, of which those within a unit declare nothing: locals are told of the rest. All of it
/// where no word tells the end of one.
Words without_directives(const Words& words) {
    Words out;
    for (size_t i = 0; i < words.size();) {
        const size_t end = words[i] == "#" ? directive_end(words, i) : i + 1;
        if (end <= i) return words;
        if (words[i] != "#") out.push_back(words[i]);
        i = end;
    }
    return out;
}

/// What stands before a name, as a type does before what it declares, and what is cast to.
void add_types(const Words& words, std::set<std::string>& out) {
    const auto may_be = [](std::string_view word) {
        return is_word_token(word) && !word_is(word, kKeyword) && !word_is(word, kNoType) && !is_type_word(word) &&
               !is_one_of(word, {"return", "new", "delete", "throw", "defined", "else", "case", "goto", "typename"});
    };
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        const bool declares = may_be(words[i]) && may_be(words[i + 1]) && words[i + 1] != "operator" &&
                              !(i > 0 && is_one_of(words[i - 1], {"#", ".", "->", "ifdef", "ifndef", "undef"}));
        if (declares) out.insert(folded(words[i]));
        const bool casts = is_one_of(words[i], {"static_cast", "reinterpret_cast"}) && words[i + 1] == "<";
        for (size_t k = i + 2; casts && k < words.size() && words[k] != ">"; ++k)
            if (may_be(words[k])) out.insert(folded(words[k]));
    }
}

}  // namespace

CommonTexts::CommonTexts(const BySide<SideOfPair>& pair, const Dialect& dialect) : pair_(pair), dialect_(dialect) {
    for (const Side side : kBothSides) languages_[side] = language_of_path(pair[side].unit->file);
    read_meaning();
    for (const Side side : kBothSides)
        for (const Words* words : {&now_[side], &past_[side]}) add_types(*words, types_);
    for (const Side side : kBothSides)
        for (const std::string& local : locals_of(side)) types_.erase(local);
    for (const Side side : kBothSides) {
        own_names[side] = locals_of(side);
        read_side(side);
    }
    learn_parameters();
    learn_names();
    for (const Side side : kBothSides) join_components(side);
    for (const Side side : kBothSides) {
        for (const auto& words : sides[side].words) unit_words[side].insert(words.begin(), words.end());
        read_past(side);
    }
    for (const Side side : kBothSides) find_new_locals(side);
    for (const Side side : kBothSides) find_held_values(side);
}

void CommonTexts::read_meaning() {
    for (const Side side : kBothSides) {
        const UnitLineage& lineage = *pair_[side].lineage;
        const auto add = [&](const WrittenStatement& statement) {
            for (std::string& word : words_of_statement(statement)) past_words_[side].push_back(std::move(word));
        };
        for (const StatementLineage& line : lineage.statements())
            for (const LineageStep& step : line.steps) add(step.before);
        for (const RemovedStatement& one : lineage.removed()) add(one.text);
        past_[side] = Words(past_words_[side].begin(), past_words_[side].end());
        now_[side] = without_prelude(pair_[side].unit->text.words());
    }
    meaning_.emplace(PairTexts{past_.source, now_.source, past_.target, now_.target}, dialect_, languages_);
}

std::vector<std::string> CommonTexts::translated(const WrittenStatement& statement, Side side, bool in_body) const {
    const std::vector<std::string> owned = words_of_statement(statement);
    std::vector<std::string> out =
        essence_of(meaning_->translate(Words(owned.begin(), owned.end()), side, in_body), dialect_);
    for (std::string& word : out)
        if (const auto known = names_[side].find(word); known != names_[side].end()) word = known->second;
    return out;
}

void CommonTexts::read_side(Side side) {
    ReadSide& out = sides[side];
    out.written = pair_[side].lineage->today();
    for (size_t i = 0; i < out.written.size(); ++i) {
        out.words.push_back(translated(out.written[i], side, i > 0));
        out.weighed.push_back(weigher_.weighed(out.words.back()));
    }
}

void CommonTexts::read_past(Side side) {
    const UnitLineage& lineage = *pair_[side].lineage;
    for (const StatementLineage& line : lineage.statements())
        for (const LineageStep& step : line.steps)
            if (!step.before.empty()) had_[side].insert(past_of(line.index, step.before, side));
    for (const RemovedStatement& one : lineage.removed()) had_[side].insert(translated(one.text, side, true));
}

std::vector<std::string> CommonTexts::past_of(size_t index, const WrittenStatement& before, Side side) const {
    std::vector<std::string> out = translated(before, side, index > 0);
    if (joined_[side].contains(index))
        if (auto whole = without_component(out)) return *std::move(whole);
    return out;
}

void CommonTexts::join_components(Side side) {
    const auto best = [&](const WeighedWords& one) {
        const auto& others = sides[other(side)].weighed;
        const Nearest near = nearest(one, others);
        return near.any ? likeness(one, others[near.index]) : 0;
    };
    ReadSide& own = sides[side];
    for (const ComponentRun& run : component_runs(own.words)) {
        const WeighedWords whole = weigher_.weighed(run.whole);
        if (best(whole) <= best(own.weighed[run.first])) continue;
        for (size_t i = run.first; i < run.end; ++i) {
            own.words[i] = run.whole;
            own.weighed[i] = whole;
            joined_[side].insert(i);
            if (i > run.first) own.repeats.insert(i);
        }
    }
}

std::vector<std::string> CommonTexts::parameters_of(Side side) const {
    const Words words = without_directives(now_[side]);
    const std::vector<size_t> numbers = local_numbers(words);
    std::vector<std::string> out;
    for (size_t i = 0; i < numbers.size() && words[i] != "{"; ++i)
        if (numbers[i] != 0) out.push_back(folded(words[i]));
    return out;
}

void CommonTexts::find_new_locals(Side side) {
    const std::vector<std::string> parameters = parameters_of(side);
    for (const std::string& name : own_names[side])
        if (std::find(parameters.begin(), parameters.end(), name) == parameters.end() &&
            !unit_words[other(side)].contains(name))
            new_locals_[side].insert(name);
}

void CommonTexts::find_held_values(Side side) {
    const ReadSide& read = sides[side];
    std::map<std::string, size_t> times;
    for (const auto& words : read.words)
        if (words.size() > 2 && words[1] == "=") ++times[words[0]];
    for (size_t i = 1; i < read.words.size(); ++i) {
        const auto& words = read.words[i];
        if (words.size() < 3 || words[1] != "=" || times[words[0]] != 1) continue;
        const bool declares = folded(words_of_statement(read.written[i]).front()) != words[0];
        if (declares) held[side].emplace(words[0], std::vector<std::string>(words.begin() + 2, words.end()));
    }
    for (const auto& words : read.words) said[side].insert(written_out(words, side));
}

std::vector<std::string> CommonTexts::written_out(const std::vector<std::string>& words, Side side) const {
    constexpr size_t kMostWords = 256;
    constexpr int kDeep = 3;  // locals that hold what other locals hold
    std::vector<std::string> out = words;
    for (int turn = 0; turn < kDeep && !held[side].empty(); ++turn) {
        std::vector<std::string> next;
        for (size_t i = 0; i < out.size(); ++i) {
            const bool set = i + 1 < out.size() && (out[i + 1] == "=" || out[i + 1] == "(");
            const bool member = i > 0 && out[i - 1] == ".";
            const auto known = set || member ? held[side].end() : held[side].find(out[i]);
            if (known == held[side].end())
                next.push_back(out[i]);
            else
                next.insert(next.end(), known->second.begin(), known->second.end());
        }
        if (next == out || next.size() > kMostWords) break;
        out = std::move(next);
    }
    std::erase_if(out, [](const std::string& word) { return word == "(" || word == ")"; });
    return out;
}

void CommonTexts::learn_parameters() {
    constexpr float kClearly = 0.1f;
    const std::vector<std::string> here = parameters_of(Side::Source), there = parameters_of(Side::Target);
    if (here.size() != there.size() || here == there) return;
    const float before = alike();
    for (size_t i = 0; i < here.size(); ++i) names_.target[there[i]] = here[i];
    sides.target = {};
    read_side(Side::Target);
    if (alike() >= before + kClearly) return;
    names_.target.clear();
    sides.target = {};
    read_side(Side::Target);
}

void CommonTexts::learn_names() {
    constexpr size_t kMostPairs = 400'000;
    constexpr float kSameStatement = 0.7f;
    constexpr size_t kSure = 3;  // votes; one is enough for what both sides declare for themselves
    const ReadSide &source = sides.source, &target = sides.target;
    if (source.words.size() * target.words.size() > kMostPairs) return;
    std::set<std::string_view> in_source, in_target;
    for (const auto& words : source.words) in_source.insert(words.begin(), words.end());
    for (const auto& words : target.words) in_target.insert(words.begin(), words.end());
    const std::set<std::string>&own_source = own_names.source, &own_target = own_names.target;
    std::map<std::string, std::map<std::string, size_t>> votes;
    for (size_t i = 0; i < target.words.size(); ++i) {
        const Nearest near = nearest(target.weighed[i], source.weighed);
        if (!near.any) continue;
        const std::vector<std::string> left = value_of(source.words[near.index]), right = value_of(target.words[i]);
        if (left.size() != right.size()) continue;
        const float all = target.weighed[i].sum + source.weighed[near.index].sum;
        if (1 - near.distance / all < kSameStatement) continue;
        for (size_t k = 0; k < right.size(); ++k) {
            const std::string &there = right[k], &here = left[k];
            if (here != there && is_word_token(here) && is_word_token(there) && !in_source.contains(there) &&
                !in_target.contains(here))
                votes[there][here] += own_target.contains(there) && own_source.contains(here) ? kSure : 1;
        }
    }
    std::map<std::string, std::string> taken;
    for (const auto& [there, all] : votes) {
        const auto best =
            std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
        if (best->second >= kSure && taken.emplace(best->first, there).second) names_.target[there] = best->first;
    }
    if (names_.target.empty()) return;
    sides.target = {};
    read_side(Side::Target);
}

std::set<std::string> CommonTexts::locals_of(Side side) const {
    const Words words = without_directives(now_[side]);
    const std::vector<size_t> numbers = local_numbers(words);
    std::set<std::string> out;
    for (size_t i = 0; i < numbers.size(); ++i)
        if (numbers[i] != 0) out.insert(folded(words[i]));
    return out;
}

float CommonTexts::alike() const {
    std::map<std::vector<uint32_t>, size_t> there;
    float all = 0, common = 0;
    for (size_t i = 0; i < sides.target.weighed.size(); ++i) {
        if (sides.target.repeats.contains(i)) continue;
        ++there[sides.target.weighed[i].words];
        all += sides.target.weighed[i].sum;
    }
    for (size_t i = 0; i < sides.source.weighed.size(); ++i) {
        if (sides.source.repeats.contains(i)) continue;
        const WeighedWords& one = sides.source.weighed[i];
        all += one.sum;
        if (const auto found = there.find(one.words); found != there.end() && found->second > 0) {
            --found->second;
            common += 2 * one.sum;
        }
    }
    return all > 0 ? common / all : 0;
}

bool CommonTexts::name_thread(const std::vector<std::string>& words) {
    return std::any_of(words.begin(), words.end(), [](const std::string& word) {
        return is_one_of(word, {"localid", "groupid", "globalid", "local_id", "group_id", "global_id"});
    });
}

bool CommonTexts::asks_for_thread(Side side) const {
    return std::any_of(sides[side].words.begin(), sides[side].words.end(), name_thread);
}

bool CommonTexts::uses_new_local(Side side, const std::vector<std::string>& words) const {
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        return held[side].contains(word) && !unit_words[other(side)].contains(word);
    });
}

KnownThere CommonTexts::known_there(Side side) const {
    const SideOfPair& there = pair_[other(side)];
    return {&unit_words[other(side)], there.file_words,   there.uses, pair_[side].uses,
            &own_names[side],         &new_locals_[side], &types_};
}

Nearest nearest(const WeighedWords& one, const std::vector<WeighedWords>& among) {
    Nearest out;
    for (size_t i = 0; i < among.size(); ++i) {
        const float least = std::abs(one.sum - among[i].sum);
        if (out.any && least >= out.distance) continue;
        const float far = distance(one, among[i]);
        if (!out.any || far < out.distance) out = {i, far, true};
    }
    return out;
}

}  // namespace porttool
