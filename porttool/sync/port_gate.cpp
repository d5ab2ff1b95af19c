// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/port_gate.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "porttool/compare/alike_spots.h"
#include "porttool/compare/clauses.h"
#include "porttool/compare/grouping.h"
#include "porttool/compare/learned_words.h"
#include "porttool/compare/own_words.h"
#include "porttool/compare/settled_edits.h"
#include "porttool/compare/switch_cases.h"
#include "porttool/language/words.h"
#include "porttool/normal/prelude.h"
#include "porttool/normal/unit_state.h"
#include "porttool/sync/scopes.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

bool are_functions(const JudgedPair& pair) {
    return std::all_of(kBothSides.begin(), kBothSides.end(), [&](Side side) {
        return pair.unit[side]->kind == UnitKind::Function || pair.unit[side]->kind == UnitKind::Kernel;
    });
}

}  // namespace

EditedBodies::EditedBodies(const BySide<NormalText>& before, const NormalText& source, const NormalText& target) {
    const Words old_source = before.source.words(), old_target = before.target.words(), new_source = source.words(),
                new_target = target.words();
    same_preludes =
        prelude_of(old_source) == prelude_of(new_source) && prelude_of(old_target) == prelude_of(new_target);
    source_before = without_prelude(old_source);
    source_now = without_prelude(new_source);
    target_before = without_prelude(old_target);
    target_now = without_prelude(new_target);
}

PairComparison compare_now(const JudgedPair& pair, const LockedPair& line, const BySide<NormalText>& before,
                           const NormalText& source, const Fingerprints& source_prints, const NormalText& target,
                           const Fingerprints& target_prints, const Dialect& dialect) {
    const auto paired = [&](Side side, const Fingerprints& was, const Fingerprints& prints, const NormalText& text) {
        const UnitState& unit = *pair.unit[side];
        return PairedUnit{unit.id, unit.kind, language_of_path(unit.file), was, prints, before[side], text};
    };
    CompareBudget budget;
    return compare_pair({paired(Side::Source, line.source_prints, source_prints, source),
                         paired(Side::Target, line.target_prints, target_prints, target)},
                        dialect, budget);
}

bool is_only_noted(const JudgedPair& pair, const EditedBodies& bodies, const Dialect& dialect) {
    if (!are_functions(pair)) return false;
    const PairTexts texts = bodies.texts();
    if (only_adds_labels_of_other(texts.source_before, texts.source_now, texts.target_now) &&
        only_adds_labels_of_other(texts.target_before, texts.target_now, texts.source_now))
        return true;
    const auto language = [&](Side side) { return language_of_path(pair.unit[side]->file); };
    return bodies.same_preludes &&
           edits_leave_no_difference(texts, dialect, {language(Side::Source), language(Side::Target)});
}

bool is_edited_in_same_words(const JudgedPair& pair, const EditedBodies& bodies, const Dialect& dialect,
                             bool in_place) {
    if (!are_functions(pair) || !bodies.same_preludes) return false;
    const PairTexts texts = bodies.texts();
    if (edits_spot_by_spot(texts, dialect) ||
        (in_place && edits_in_own_words(texts, dialect) && grouping_of_edits(texts, dialect) == Grouping::Alike))
        return true;
    const LearnedWords said = in_words_of_target(texts, dialect, {pair.id.source, pair.id.target});
    return edits_spot_by_spot({said.before, said.now, texts.target_before, texts.target_now}, dialect);
}

std::string what_differs(const PairComparison& found) {
    if (!found.missing.empty()) return found.missing.front();
    if (!found.values.empty()) return found.values;
    return found.not_compared.empty() ? "the two edits are not the same" : found.not_compared;
}

std::set<std::string> names_lost(const ScannedFile& file, const std::vector<std::string>& was,
                                 const std::vector<std::string>& is) {
    const auto is_of_file = [&](const std::string& name) {
        return std::any_of(file.units.begin(), file.units.end(),
                           [&](const Unit& unit) { return leaf_of(unit.name) == name; }) ||
               std::any_of(file.variables.begin(), file.variables.end(),
                           [&](const FileVariable& variable) { return file.lexed.view(variable.name_token) == name; });
    };
    std::set<std::string> lost = lost_names(was, is);
    std::erase_if(lost, is_of_file);
    return lost;
}

std::set<std::string> templates_without_arguments(const ScannedFile& file, const std::vector<std::string>& was,
                                                  const std::vector<std::string>& is) {
    const auto times_bare = [](const std::vector<std::string>& words, const std::string& name) {
        size_t times = 0;
        for (size_t i = 0; i < words.size(); ++i)
            times += words[i] == name && (i + 1 == words.size() || words[i + 1] != "<");
        return times;
    };
    std::set<std::string> out;
    for (const Unit& unit : file.units) {
        if (unit.kind != UnitKind::Struct || file.lexed.view(unit.tokens.first) != "template") continue;
        std::string name(leaf_of(unit.name));
        if (times_bare(is, name) > times_bare(was, name)) out.insert(std::move(name));
    }
    return out;
}

std::string gives_back_as_before(const std::vector<std::string>& was, const std::vector<std::string>& is) {
    const auto gives_nothing = [](const std::vector<std::string>& words) {
        for (size_t i = 0; i + 1 < words.size() && words[i] != "("; ++i)
            if (words[i] == "void") return words[i + 1] != "*";
        return false;
    };
    const bool nothing_now = gives_nothing(is);
    if (gives_nothing(was) == nothing_now) return {};
    const std::vector<Clause> clauses = clauses_of(is, false);
    const auto is_in_lambda = [&](size_t c) {
        for (c = clauses[c].inside; c != Clause::kNone && c != 0; c = clauses[c].inside)
            for (size_t i = clauses[c].first; i + 1 < clauses[c].end; ++i)
                if (is[i] == "]" && is_one_of(is[i + 1], {"(", "{", "mutable"})) return true;
        return false;
    };
    bool gives_any = false;
    for (size_t c = 1; c < clauses.size(); ++c) {
        const Clause& clause = clauses[c];
        if (is[clause.first] != "return" || is_in_lambda(c)) continue;
        gives_any = true;
        if ((clause.size() == 2) == nothing_now) continue;
        return nothing_now ? "the port still gives a value back there"
                           : "the port still gives nothing back there, and came to give a value back";
    }
    if (!nothing_now && !gives_any) return "the port came to give a value back, and gives none";
    return {};
}

bool ends_its_directives(const std::vector<std::string>& words) {
    int depth = 0;
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        if (words[i] != "#") continue;
        depth += is_one_of(words[i + 1], {"if", "ifdef", "ifndef"}) ? 1 : words[i + 1] == "endif" ? -1 : 0;
        if (depth < 0) return false;
    }
    return depth == 0;
}

std::string doubled_qualifier(const std::vector<std::string>& was, const std::vector<std::string>& is) {
    const auto doubled = [](const std::vector<std::string>& words) {
        std::map<std::string_view, size_t> out;
        for (size_t i = 0; i + 1 < words.size(); ++i)
            if (words[i] == words[i + 1] && word_is(words[i], kQualifier)) ++out[words[i]];
        return out;
    };
    const std::map<std::string_view, size_t> before = doubled(was);
    for (const auto& [word, times] : doubled(is)) {
        const auto known = before.find(word);
        if (times > (known == before.end() ? 0 : known->second)) return std::string(word);
    }
    return {};
}

bool others_stayed(const ScannedFile& before, const ScannedFile& now, const Unit& edited_before) {
    std::map<std::string_view, std::string_view> texts;
    const auto text_of = [](const ScannedFile& file, const Unit& unit) {
        const Token &first = file.lexed.tokens[unit.tokens.first], &last = file.lexed.tokens[unit.tokens.end - 1];
        return std::string_view(file.lexed.text).substr(first.offset, last.offset + last.length - first.offset);
    };
    for (const Unit& unit : now.units) texts[unit.name] = text_of(now, unit);
    return std::all_of(before.units.begin(), before.units.end(), [&](const Unit& unit) {
        // What holds the edited unit, as its class, changed with it.
        if (unit.tokens.first <= edited_before.tokens.first && edited_before.tokens.end <= unit.tokens.end) return true;
        const auto found = texts.find(unit.name);
        return found != texts.end() && found->second == text_of(before, unit);
    });
}

uint32_t first_line(const JudgedPair& pair, Side side) {
    return pair.unit[side] == nullptr ? 0 : pair.unit[side]->start_line;
}

}  // namespace porttool
