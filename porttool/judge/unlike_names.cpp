// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/unlike_names.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "porttool/compare/casts.h"
#include "porttool/compare/edits.h"
#include "porttool/compare/numbered_text.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/prelude.h"
#include "porttool/read/map_file.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

using NewWordsOfText = std::set<std::string_view>;

NewWordsOfText words_that_came(const Words& before, const Words& now) {
    const NewWordsOfText then(before.begin(), before.end());
    NewWordsOfText out;
    for (const std::string_view word : now)
        if (is_word_token(word) && !then.contains(word)) out.insert(word);
    return out;
}

/// A name and a member of it: `t`, `w` of `t . w`.
using MemberUse = std::pair<std::string_view, std::string_view>;

std::set<MemberUse> members_of(const Words& text) {
    std::set<MemberUse> out;
    for (size_t i = 1; i + 1 < text.size(); ++i) {
        const bool reaches = text[i] == "." || text[i] == "->";
        const bool is_call = i + 2 < text.size() && text[i + 2] == "(";
        if (reaches && !is_call && is_word_token(text[i - 1]) && is_word_token(text[i + 1]))
            out.emplace(text[i - 1], text[i + 1]);
    }
    return out;
}

/// The type that a text declares a name with: the word before it, but for what marks pointers and constants.
std::string_view type_of(const Words& text, std::string_view name) {
    for (size_t i = 1; i + 1 < text.size(); ++i) {
        if (text[i] != name || !is_one_of(text[i + 1], {"=", ";", ",", ")", "[", "{"})) continue;
        size_t at = i - 1;
        while (at > 0 && is_one_of(text[at], {"*", "&", "const", "restrict"})) --at;
        if (is_word_token(text[at]) && !is_type_word(text[at]) && !word_is(text[at], kKeyword)) return text[at];
    }
    return {};
}

/// The number type of a field in a struct's text, in the common vocabulary; "" if it has none such, or is more than
/// one number.
std::string field_type(const Words& text, std::string_view field, const Dialect& dialect) {
    const Words plain = with_one_word_types(text);
    size_t first = 0;
    for (size_t i = 0; i + 1 < plain.size(); ++i) {
        if (is_one_of(plain[i], {";", "{", "}"})) first = i + 1;
        if (plain[i] != field || !is_one_of(plain[i + 1], {";", ",", "="})) continue;
        std::string out;
        for (size_t k = first; k < i; ++k) {
            if (is_one_of(plain[k], {"*", "&", "<", "(", "["})) return {};
            if (is_type_word(plain[k])) out = common_word(plain[k], dialect);
        }
        return out;
    }
    return {};
}

/// True of the sentences of texts that have one statement, each, which the other does not have.
bool is_of_one_statement(const std::vector<std::string>& differences) {
    const size_t n = differences.size();
    if (n == 3) return differences[0].find(" where the port has ") != std::string::npos;
    return n == 2 && differences[0].starts_with("the source gained") && differences[1].starts_with("the port gained");
}

}  // namespace

/// The texts of a pair, and what came into both, or into each.
struct UnlikeNames::Texts {
    BySide<NormalText> recorded;
    BySide<Words> before, now;
    BySide<Language> languages;
    BySide<NewWordsOfText> came;
};

void UnlikeNames::judge(JudgedPair& pair, const LockedPair* line) {
    if (line == nullptr || !facts_.files) return;
    Texts texts;
    for (const Side side : kBothSides) {
        const Print recorded = (side == Side::Source ? line->source_prints : line->target_prints).written;
        const UnitState* unit = pair.unit[side];
        const bool is_code = unit != nullptr && (unit->kind == UnitKind::Function || unit->kind == UnitKind::Kernel);
        if (!is_code || recorded == unit->prints.written) return;
        texts.recorded[side] = facts_.base_text(recorded);
        if (texts.recorded[side].size() == 0) return;
        texts.before[side] = texts.recorded[side].words();
        texts.now[side] = unit->text.words();
        texts.languages[side] = language_of_path(unit->file);
        texts.came[side] = words_that_came(texts.before[side], texts.now[side]);
    }
    if (texts.came.source.empty() && texts.came.target.empty()) return;
    tell_functions(pair, texts);
    tell_members(pair, texts);
    tell_types(pair, texts);
}

/// The unit of that name which no pair watches, if it is the only one of the side.
const UnitState* UnlikeNames::sole_unit(Side side, std::string_view name, bool is_struct) {
    const std::vector<const UnitState*>* units = own_names_.of(side, name);
    if (units == nullptr || units->size() != 1) return nullptr;
    const UnitState& unit = *units->front();
    const bool fits = is_struct ? unit.kind == UnitKind::Struct : unit.kind == UnitKind::Function;
    return fits && !watched_.contains(side, unit.id) ? &unit : nullptr;
}

/// Functions that say something else in so many ways are each side's own; of those that are one but for a statement
/// that one is wrong.
void UnlikeNames::tell_functions(JudgedPair& pair, const Texts& texts) {
    for (const std::string_view word : texts.came.source) {
        if (!texts.came.target.contains(word)) continue;
        const UnitState *here = sole_unit(Side::Source, word, false), *there = sole_unit(Side::Target, word, false);
        if (here == nullptr || there == nullptr) continue;
        const Words none, here_words = without_prelude(here->text.words()),
                          there_words = without_prelude(there->text.words());
        const NumberedText source(here_words), target(there_words);  // which parameter is which counts
        const BySide<Language> languages{language_of_path(here->file), language_of_path(there->file)};
        const PairTexts texts_of_both{none, source.words(), none, target.words()};
        const std::vector<std::string> differences = compare_edits(texts_of_both, dialect_, languages).differences;
        if (is_of_one_statement(differences))
            tell(pair, word, fmt::format("{} and {} differ in a statement", here->id, there->id));
    }
}

/// Members that both sides came to use, of structs of one name.
void UnlikeNames::tell_members(JudgedPair& pair, const Texts& texts) {
    const std::set<MemberUse> before[] = {members_of(texts.before.source), members_of(texts.before.target)};
    const std::set<MemberUse> there = members_of(texts.now.target);
    for (const MemberUse& use : members_of(texts.now.source)) {
        if (!there.contains(use) || before[0].contains(use) || before[1].contains(use)) continue;
        BySide<std::string> types;
        for (const Side side : kBothSides)
            if (const UnitState* unit = sole_unit(side, type_of(texts.now[side], use.first), true))
                types[side] = field_type(unit->text.words(), use.second, dialect_);
        if (!types.source.empty() && !types.target.empty() && types.source != types.target)
            tell(pair, use.second,
                 fmt::format("it is {} in the source and {} in the port", types.source, types.target));
    }
}

/// The number type that a file's `typedef`, `using` or `#define` gives a word; "" for another word.
std::string UnlikeNames::number_type_for(const UnitState& unit, Side side, std::string_view word) {
    if (!words_[side]) words_[side].emplace((*facts_.files)[side].macros());
    for (const char* mark : {"=", ""}) {
        const auto declared = words_[side]->first_seen(unit.file, mark + std::string(word));
        if (!declared) continue;
        std::string type;
        size_t others = 0;
        for (std::string_view rest = declared->text; !rest.empty();) {
            const size_t end = std::min(rest.find_first_of(" ;"), rest.size());
            const std::string_view one = rest.substr(0, end);
            if (is_type_word(one) && one != word)
                type = one;
            else if (!one.empty() && one != word &&
                     !is_one_of(one, {"typedef", "using", "=", "#", "#define", "define"}))
                ++others;
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
        if (others == 0 && !type.empty()) return type;
    }
    return {};
}

/// Words that came for types: the edits are one only if they are with these in their place.
void UnlikeNames::tell_types(JudgedPair& pair, const Texts& texts) {
    std::map<std::string_view, std::string> types;
    for (const Side side : kBothSides)
        for (const std::string_view word : texts.came[side]) {
            const bool is_type = !texts.came[other(side)].contains(word) && !word_is(word, kKeyword);
            if (!is_type) continue;
            if (std::string type = number_type_for(*pair.unit[side], side, word); !type.empty())
                types.emplace(word, std::move(type));
        }
    if (types.empty()) return;
    const auto written = [&](Words text) {
        for (std::string_view& word : text)
            if (const auto type = types.find(word); type != types.end()) word = type->second;
        return text;
    };
    const Words source = written(texts.now.source), target = written(texts.now.target);
    const PairTexts said{texts.before.source, texts.now.source, texts.before.target, texts.now.target};
    if (!compare_edits(said, dialect_, texts.languages).equivalent) return;
    const PairTexts meant{texts.before.source, source, texts.before.target, target};
    if (compare_edits(meant, dialect_, texts.languages).equivalent) return;
    for (const auto& [word, type] : types) tell(pair, word, "it stands for " + type);
}

void UnlikeNames::tell(JudgedPair& pair, std::string_view word, const std::string& how) {
    pair.changed = true;
    pair.equivalent = false;
    findings_.add(Rule::PortDiffers, pair, {},
                  fmt::format("both sides came to use {}, which is another one there: {}", word, how),
                  "unlike " + std::string(word));
}

}  // namespace porttool
