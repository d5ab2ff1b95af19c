// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/left_out_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "porttool/compare/asides.h"
#include "porttool/compare/lone_edit.h"
#include "porttool/compare/runtime_calls.h"
#include "porttool/language/words.h"
#include "porttool/normal/locals.h"
#include "porttool/scan/scan.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using SaidKind = DeclaredWord::Kind;

/// True for words that a comparison leaves out, or takes for others, wherever they stand.
bool is_translated(std::string_view word, const Dialect& dialect) {
    return dialect.meaning(word) != nullptr || word_is(word, ~Roles{0}) ||
           is_one_of(word, {"static_cast", "reinterpret_cast", "const_cast"});
}

/// What a comparison takes a word of a text for, if it may leave it out. `without`: the text without asides.
std::optional<LeftOutAs> left_out_as(std::string_view word, const Words& text, const Words& without,
                                     const Dialect& dialect) {
    const auto has = [&](const Words& words) { return std::find(words.begin(), words.end(), word) != words.end(); };
    if (is_one_of(word, {"hipLaunchKernelGGL", "hipLaunchKernel", "cudaLaunchKernel"})) return LeftOutAs::Launch;
    if (!has(text) || is_translated(word, dialect)) return LeftOutAs::Word;
    if (says_unused(word)) return LeftOutAs::Unused;
    if (!has(without)) return LeftOutAs::Aside;
    if (says_that_it_checks(word)) return LeftOutAs::Check;
    const std::vector<size_t> locals = local_numbers(text);
    for (size_t i = 0; i < locals.size(); ++i)
        if (text[i] == word && locals[i] != 0) return LeftOutAs::Local;
    return std::nullopt;
}

}  // namespace

LeftOutWords::SideWords& LeftOutWords::words(Side side) {
    if (words_[side]) return *words_[side];
    SideWords& out = words_[side].emplace();
    std::set<std::string> elsewhere;  // what both sides say alike
    for (const NewWord& one : (*facts_.new_words)[other(side)].words) elsewhere.insert(one.text());
    for (const NewWord& one : (*facts_.new_words)[side].words) {
        const bool is_asked =
            one.said.kind == SaidKind::Macro || one.said.kind == SaidKind::Type || one.said.kind == SaidKind::Brought;
        if (is_asked && !elsewhere.contains(one.text())) out.by_word.emplace(one.word(), &one);
    }
    if (out.by_word.empty()) return out;
    const FilesOfSide& files = (*facts_.files)[side];
    for (size_t i = 0; i < files.size(); ++i) {
        const ScannedFile& file = files.scanned(i);
        for (const Unit& unit : file.units) out.places.emplace(unit_id(file, unit), Place{&file, &unit});
    }
    return out;
}

void LeftOutWords::judge(const JudgedPair& pair, bool is_told) {
    if (facts_.new_words == nullptr || !facts_.files) return;
    for (const Side side : kBothSides)
        for (const NewWord* one : changed_in(pair, side, is_told)) tell(pair, side, *one);
}

/// What is said of words that the unit has as it is written. `is_told`: so is the edit of the pair; then a word of a
/// head that nothing is known of is told with it.
std::vector<const NewWord*> LeftOutWords::changed_in(const JudgedPair& pair, Side side, bool is_told) {
    const UnitState* user = pair.unit[side];
    std::vector<const NewWord*> out;
    if (user == nullptr || words(side).by_word.empty()) return out;
    const SideWords& all = words(side);
    const auto place = all.places.find(user->id);
    if (place == all.places.end()) return out;
    const auto& [file, unit] = place->second;
    std::optional<Words> text, without;
    const NormalText& normal = user->text;
    const auto is_own = [&](const NewWord& said) {
        return said.file == file && said.said.name_token >= unit->tokens.first &&
               said.said.name_token < unit->tokens.end;
    };
    for (uint32_t at = unit->tokens.first; at < unit->tokens.end; ++at) {
        const bool in_body = unit->body.first < unit->body.end && at >= unit->body.first;
        const auto [first, last] = all.by_word.equal_range(file->lexed.view(at));
        for (auto one = first; one != last; ++one) {
            const NewWord& said = *one->second;
            if (std::find(out.begin(), out.end(), &said) != out.end() || is_own(said) || !is_seen(side, said, *user))
                continue;
            const std::string_view word = said.word();
            if (pair.macro_edit.find(" " + std::string(word) + ":") != std::string::npos) continue;
            if (!text) text = normal.words(), without = without_asides(*text);
            std::optional<LeftOutAs> as = left_out_as(word, *text, *without, dialect_);
            if (!as && !in_body && !is_told && unit->kind != UnitKind::Constant) as = LeftOutAs::Word;
            const bool can_be = as && (*as == LeftOutAs::Word || said.said.kind == SaidKind::Macro);
            if (can_be && !is_harmless(said, *as, in_body, dialect_)) out.push_back(&said);
        }
    }
    return out;
}

bool LeftOutWords::is_seen(Side side, const NewWord& said, const UnitState& user) {
    const bool anywhere = said.said.kind == SaidKind::Macro && is_header(said.file->path);
    if (said.file->path == user.file || anywhere) return true;
    if (!includes_[side]) includes_[side].emplace((*facts_.files)[side].macros());
    return includes_[side]->sees(user.file, said.file->path);
}

void LeftOutWords::tell(const JudgedPair& pair, Side side, const NewWord& said) {
    const std::string told_as =
        fmt::format("{} left out {} {}", side == Side::Source ? "source" : "target", said.word(), said.text());
    if (told_.has_told(told_as)) {
        return;
    }
    Finding& finding =
        findings_.add(side == Side::Source ? Rule::SourceChanged : Rule::TargetChanged, pair, {}, "", told_as);
    finding.message = fmt::format(
        "{} says something else: its word {}, which the comparison does not see, is `{}` now "
        "({}:{})",
        side == Side::Source ? "the source" : "the port", said.word(), said.text(), said.file->path, said.line());
    finding.remedy = "Give it another name; if it is meant so, run: porttool ignore " +
                     argument(pair.id.source + "=" + pair.id.target, finding) + " --reason TEXT";
    finding.details.push_back("+ " + said.text());
    told_.tell(told_as, finding);
}

void LeftOutWords::tell_how_many() {
    told_.tell_how_many(findings_,
                        [](const std::string&, size_t more) { return "; so is that of " + more_pairs(more); });
}

}  // namespace porttool
