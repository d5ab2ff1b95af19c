// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/left_out_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <unordered_set>

#include "porttool/compare/asides.h"
#include "porttool/compare/lone_edit.h"
#include "porttool/compare/runtime_calls.h"
#include "porttool/language/words.h"
#include "porttool/normal/locals.h"
#include "porttool/scan/macros.h"
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

/// What is asked of a unit's text for each of its words.
struct AskedText {
    std::unordered_set<std::string_view> all;    ///< words
    std::unordered_set<std::string_view> acts;   ///< those that stand outside asides, too
    std::unordered_set<std::string_view> local;  ///< those that name a local somewhere

    explicit AskedText(const Words& text) : all(text.begin(), text.end()) {
        const Words without = without_asides(text);
        acts.insert(without.begin(), without.end());
        const std::vector<size_t> locals = local_numbers(text);
        for (size_t i = 0; i < locals.size(); ++i)
            if (locals[i] != 0) local.insert(text[i]);
    }
};

/// What a comparison takes a word of a text for, if it may leave it out.
std::optional<LeftOutAs> left_out_as(std::string_view word, const AskedText& text, const Dialect& dialect) {
    if (is_one_of(word, {"hipLaunchKernelGGL", "hipLaunchKernel", "cudaLaunchKernel"})) return LeftOutAs::Launch;
    if (!text.all.contains(word) || is_translated(word, dialect)) return LeftOutAs::Word;
    if (says_unused(word)) return LeftOutAs::Unused;
    if (!text.acts.contains(word)) return LeftOutAs::Aside;
    if (says_that_it_checks(word)) return LeftOutAs::Check;
    return text.local.contains(word) ? std::optional(LeftOutAs::Local) : std::nullopt;
}

/// The words that an edit of macros names: `A` and `B` of `source A:17 B:4`.
std::unordered_set<std::string_view> words_of_macro_edit(std::string_view edit) {
    std::unordered_set<std::string_view> out;
    for (size_t end = edit.find(':'); end != std::string_view::npos; end = edit.find(':', end + 1)) {
        const size_t space = edit.rfind(' ', end);
        if (space != std::string_view::npos) out.insert(edit.substr(space + 1, end - space - 1));
    }
    return out;
}

/// `#define KEPT static`: a macro that only says how something is declared, of which MacroEdits tells nothing.
bool only_says_how_declared(const NewWord& said) {
    const uint32_t first = said.said.name_token + 1, end = said.said.tokens.end;
    for (uint32_t at = first; at < end; ++at)
        if (!word_is(said.file->lexed.view(at), kPromise | kHeadPromise | kDropped)) return false;
    return said.said.kind == SaidKind::Macro && first < end;
}

/// True if all arguments of a macro but the first do nothing by themselves: names, members and literals.
bool has_plain_rest(const LexedText& lexed, uint32_t at, uint32_t end) {
    constexpr uint32_t kLongest = 256;  // tokens
    if (at + 1 >= end || lexed.view(at + 1) != "(") return true;
    int depth = 0;
    bool is_first = true;
    for (const uint32_t last = std::min(end, at + kLongest); ++at < last;) {
        const std::string_view word = lexed.view(at);
        if (word == "(" && ++depth == 1) continue;
        if (word == ")" && --depth == 0) return true;
        if (word == "," && depth == 1) is_first = false;
        if (is_first || word == "," || lexed.tokens[at].kind != TokenKind::Punctuator) continue;
        if (!is_one_of(word, {".", "->", "::", "-", "+", "*", "&"})) return false;
    }
    return false;
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
        if (is_asked && !elsewhere.contains(one.text())) out.by_word[one.word()].push_back(&one);
    }
    if (out.by_word.empty()) return out;
    const FilesOfSide& files = (*facts_.files)[side];
    for (size_t i = 0; i < files.size(); ++i) {
        const ScannedFile& file = files.scanned(i);
        for (const Unit& unit : file.units) out.places.emplace(unit_id(file, unit), Place{&file, &unit});
        for (DeclaredWord& one : declared_words(file))
            if (one.kind == SaidKind::Macro) out.macros[word_of(file, one)].push_back({&file, std::move(one)});
    }
    add_names(out);
    return out;
}

/// Which macros the definitions of each name.
void LeftOutWords::add_names(SideWords& words) {
    for (const auto& [word, definitions] : words.macros) {
        std::set<std::string_view> names;
        for (const NewWord& one : definitions)
            for (uint32_t at = one.said.name_token + 1; at < one.said.tokens.end; ++at)
                if (const std::string_view name = one.file->lexed.view(at); name != word && words.macros.contains(name))
                    names.insert(name);
        if (!names.empty()) words.names[word].assign(names.begin(), names.end());
    }
}

void LeftOutWords::judge(const JudgedPair& pair, bool is_told) {
    if (facts_.new_words == nullptr || !facts_.files) return;
    for (const Side side : kBothSides)
        for (const Changed& one : changed_in(pair, side, is_told)) tell(pair, side, one);
}

/// The words of the unit, as it is written, that mean something else now. `is_told`: so is the edit of the pair; then a
/// word of a head that nothing is known of is told with it.
std::vector<LeftOutWords::Changed> LeftOutWords::changed_in(const JudgedPair& pair, Side side, bool is_told) {
    const UnitState* user = pair.unit[side];
    std::vector<Changed> out;
    if (user == nullptr || words(side).by_word.empty()) return out;
    const SideWords& all = words(side);
    const auto place = all.places.find(user->id);
    if (place == all.places.end()) return out;
    const auto& [file, unit] = place->second;
    std::optional<AskedText> text;
    const std::unordered_set<std::string_view> told = words_of_macro_edit(pair.macro_edit);
    std::set<Standing> known;
    const auto is_own = [&](const NewWord& said) {
        return said.file == file && said.said.name_token >= unit->tokens.first &&
               said.said.name_token < unit->tokens.end;
    };
    for (uint32_t at = unit->tokens.first; at < unit->tokens.end; ++at) {
        const bool in_body = unit->body.first < unit->body.end && at >= unit->body.first;
        const std::string_view word = file->lexed.view(at);
        if (!all.by_word.contains(word) && !all.names.contains(word)) continue;
        const bool plain = has_plain_rest(file->lexed, at, unit->tokens.end);
        if (!known.insert({word, LeftOutAs::Word, in_body, plain}).second) continue;
        if (!text) text.emplace(user->text.words());
        std::optional<LeftOutAs> as = left_out_as(word, *text, dialect_);
        if (!as && !in_body && !is_told && unit->kind != UnitKind::Constant) as = LeftOutAs::Word;
        if (const auto all_said = all.by_word.find(word); !as && in_body && all_said != all.by_word.end())
            for (const NewWord* one : all_said->second)
                if (only_says_how_declared(*one)) as = LeftOutAs::Word;
        if (!as) continue;
        for (const Said& said : harmful(side, {word, *as, in_body, plain})) {
            if (is_own(*said.what) || !is_seen(side, *said.what, *user)) continue;
            if (told.contains(said.what->word())) continue;
            out.push_back({said, word});
            break;
        }
    }
    return out;
}

/// What is said of a word, and of macros that it leads to, that is harmful where the word stands so. Of each file two,
/// since one may be the unit's own.
const std::vector<LeftOutWords::Said>& LeftOutWords::harmful(Side side, const Standing& standing) {
    constexpr size_t kMost = 64;  // words that are followed, files
    SideWords& all = words(side);
    const auto [entry, is_new] = all.harmful.try_emplace(standing);
    if (!is_new) return entry->second;
    std::vector<std::string_view> open = {standing.word};
    std::set<std::string_view> seen = {standing.word};
    std::map<const ScannedFile*, int> of_file;
    for (size_t i = 0; i < open.size(); ++i) {
        if (const auto said = all.by_word.find(open[i]); said != all.by_word.end())
            for (const NewWord* one : said->second) {
                if (of_file.size() >= kMost && !of_file.contains(one->file)) continue;
                if (of_file[one->file] == 2 || !is_harmful(all, {one, i > 0}, standing)) continue;
                ++of_file[one->file];
                entry->second.push_back({one, i > 0});
            }
        const auto names = all.names.find(open[i]);
        if (names == all.names.end()) continue;
        for (const std::string_view name : names->second)
            if (open.size() < kMost && seen.insert(name).second) open.push_back(name);
    }
    return entry->second;
}

/// True if what is said of a word may change what a text says that has the word so.
bool LeftOutWords::is_harmful(const SideWords& all, const Said& said, const Standing& standing) const {
    const bool is_macro = said.what->said.kind == SaidKind::Macro;
    if ((standing.as != LeftOutAs::Word || said.is_within) && !is_macro) return false;
    const MacrosNamed macros = [&](std::string_view word) -> const std::vector<NewWord>& {
        static const std::vector<NewWord> none;
        const auto found = all.macros.find(word);
        return found == all.macros.end() ? none : found->second;
    };
    if (said.is_within)
        return standing.as != LeftOutAs::Local &&
               !is_harmless_within(*said.what, standing.as, standing.in_body, dialect_, macros);
    if (!is_harmless(*said.what, standing.as, standing.in_body, dialect_, macros)) return true;
    return standing.as == LeftOutAs::Check && !standing.has_plain_rest &&
           is_function_like(said.what->file->lexed, said.what->said.name_token);
}

bool LeftOutWords::is_seen(Side side, const NewWord& said, const UnitState& user) {
    const bool anywhere = said.said.kind == SaidKind::Macro && is_header(said.file->path);
    if (said.file->path == user.file || anywhere) return true;
    if (!includes_[side]) includes_[side].emplace((*facts_.files)[side].macros());
    return includes_[side]->sees(user.file, said.file->path);
}

void LeftOutWords::tell(const JudgedPair& pair, Side side, const Changed& changed) {
    const NewWord& said = *changed.said.what;
    const std::string told_as =
        fmt::format("{} left out {} {}", side == Side::Source ? "source" : "target", said.word(), said.text());
    if (told_.has_told(told_as)) {
        return;
    }
    Finding& finding =
        findings_.add(side == Side::Source ? Rule::SourceChanged : Rule::TargetChanged, pair, {}, "", told_as);
    finding.message =
        fmt::format("{} says something else: its word {}, which the comparison does not see, {} `{}` now ({}:{})",
                    side == Side::Source ? "the source" : "the port", changed.word,
                    changed.said.is_within ? "leads to" : "is", said.text(), said.file->path, said.line());
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
