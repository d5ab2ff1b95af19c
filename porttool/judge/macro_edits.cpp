// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/macro_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "porttool/compare/alignment.h"
#include "porttool/compare/asides.h"
#include "porttool/compare/own_parts.h"
#include "porttool/compare/paired_names.h"
#include "porttool/language/words.h"
#include "porttool/normal/locals.h"
#include "porttool/normal/normal_form.h"
#include "porttool/scan/scan.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// The words of which macros make something else than they did, each with what they make now; "-" for nothing.
std::string difference(std::string_view then, std::string_view now) {
    const auto before = words_with_macros(then), after = words_with_macros(now);
    std::string out;
    const auto add = [&](std::string_view word, std::string_view hash) {
        out += (out.empty() ? "" : " ") + std::string(word) + ":" + std::string(hash);
    };
    for (const auto& [word, hash] : before)
        if (!after.contains(word)) add(word, "-");
    for (const auto& [word, hash] : after)
        if (const auto known = before.find(word); known == before.end() || known->second != hash) add(word, hash);
    return out;
}

/// The same of what files declare of words: what came or went is a matter of where it stands.
std::string declared_difference(std::string_view then, std::string_view now) {
    const auto before = words_with_macros(then), after = words_with_macros(now);
    std::string out;
    for (const auto& [word, hash] : after)
        if (const auto known = before.find(word);
            word.starts_with('=') && known != before.end() && known->second != hash)
            out += (out.empty() ? "" : " ") + std::string(word) + ":" + std::string(hash);
    return out;
}

/// A word of an edit as the text has it.
std::string_view plain_word(std::string_view word) { return word.substr(word.starts_with('=') ? 1 : 0); }

bool is_member(const NormalText& text, size_t i) { return i > 0 && (text[i - 1] == "." || text[i - 1] == "->"); }

/// True if a text says, anywhere, of a word that it is one of its locals; its branches for the compiler may say so
/// twice.
bool declares_word(const NormalText& text, std::string_view word) {
    for (size_t i = 1; i + 1 < text.size(); ++i)
        if (text[i] == word && is_type_word(text[i - 1]) && is_one_of(text[i + 1], {"=", ";", ",", "[", ")"}))
            return true;
    return false;
}

/// True if a text has a word that is neither a local of its own nor a member.
bool uses_word(const NormalText& text, std::string_view word) {
    std::optional<std::vector<size_t>> locals;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != word || is_member(text, i)) continue;
        if (!locals) locals = local_numbers(text.words());
        if (locals->empty()) return !declares_word(text, word);
        if ((*locals)[i] == 0) return true;
    }
    return false;
}

/// The words of a text that are neither locals of its own nor members, as uses_word() has them.
std::set<std::string_view> used_words(const NormalText& text) {
    const std::vector<size_t> locals = local_numbers(text.words());
    std::set<std::string_view> out;
    for (size_t i = 0; i < text.size(); ++i)
        if (is_word_token(text[i]) && !is_member(text, i) && (locals.empty() || locals[i] == 0)) out.insert(text[i]);
    return out;
}

/// The words of a text in normal form.
Words spaced_words(std::string_view text) {
    Words out;
    for (size_t at = text.find_first_not_of(' '); at < text.size(); at = text.find_first_not_of(' ', at)) {
        const size_t end = std::min(text.find(' ', at), text.size());
        out.push_back(text.substr(at, end - at));
        at = end;
    }
    return out;
}

/// What a declaration gives its word, numbers by their values: `1.5` of `const float gain = 1.5f` and of
/// `#define AMPLIFY 1.5`; of a type or a block all that it says.
std::string value_of(std::string_view text) {
    const size_t sign = text.rfind(" = ");
    if (sign != std::string_view::npos) {
        text.remove_prefix(sign + 3);
    } else if (const size_t name = text.find("define "); name != text.npos && text.find_first_not_of("# ") == name) {
        text.remove_prefix(std::min(text.size(), text.find(' ', name + std::string_view("define ").size())));
    }
    std::string out;
    for (const std::string_view word : spaced_words(text))
        out += (out.empty() ? "" : " ") + (is_number_token(word) ? number_value(word) : std::string(word));
    return out;
}

/// Of a difference what is about words of a text; of a text that lost the word its own edit tells.
std::string of_words_in(const NormalText& text, const std::string& difference) {
    std::set<std::string_view> words;
    for (size_t i = 0; i < text.size(); ++i) words.insert(text[i]);
    std::string out;
    for (const auto& [word, hash] : words_with_macros(difference))
        if (word == "*" || words.contains(word))
            out += (out.empty() ? "" : " ") + std::string(word) + ":" + std::string(hash);
    return out;
}

/// True if nothing but what is printed, checked or timed has the words of an edit.
bool are_words_of_asides(const UnitState& unit, std::string_view edit) {
    const Words text = unit.text.words(), rest = without_asides(text);
    const auto has = [](const Words& words, std::string_view word) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    const auto edited = words_with_macros(edit);
    return std::all_of(edited.begin(), edited.end(), [&](const auto& one) {
        return !one.first.ends_with('*') && has(text, plain_word(one.first)) && !has(rest, plain_word(one.first));
    });
}

/// A definition as a message has it.
std::string shown(const WordMacro& macro) {
    constexpr size_t kMost = 80;
    return "`" +
           (macro.text.size() <= kMost ? std::string(macro.text) : std::string(macro.text.substr(0, kMost)) + " ...") +
           "`";
}

/// `#define cudaStreamWait hipStreamWait`: a call of one runtime, told apart from that of another by what it begins
/// with alone.
bool is_alias_of_runtime(std::string_view text) {
    constexpr std::string_view kDefine = "#define ";
    if (!text.starts_with(kDefine)) return false;
    text.remove_prefix(kDefine.size());
    const size_t gap = text.find(' ');
    if (gap == std::string_view::npos) return false;
    const std::string_view name = text.substr(0, gap), means = text.substr(gap + 1);
    size_t same = 0;
    while (same < std::min(name.size(), means.size()) && name[name.size() - 1 - same] == means[means.size() - 1 - same])
        ++same;
    const auto is_lower = [](char c) { return c >= 'a' && c <= 'z'; };
    const auto is_prefix = [&](std::string_view word) {
        return word.size() > same &&
               std::all_of(word.begin(), word.end() - static_cast<std::ptrdiff_t>(same), is_lower);
    };
    const std::string_view rest = name.substr(name.size() - same);
    const auto starts_word = [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; };
    const auto words = std::count_if(rest.begin(), rest.end(), starts_word);
    return words >= 2 && starts_word(rest[0]) && is_prefix(name) && is_prefix(means);
}

}  // namespace

WordMacros& MacroEdits::macros(Side side) {
    if (!macros_[side]) macros_[side].emplace((*facts_.files)[side].macros());
    return *macros_[side];
}

void MacroEdits::judge(JudgedPair& pair, const LockedPair* line) {
    if (line == nullptr || !facts_.files) return;
    BySide<std::string> edits;
    for (const Side side : kBothSides) edits[side] = edit_of(pair, *line, side);
    if (edits.source == edits.target || say_the_same(pair, edits)) edits = {};  // none, or both sides did the same
    BySide<std::string> declared;
    for (const Side side : kBothSides) declared[side] = declared_edit(pair, *line, side);
    const bool both = !declared.source.empty() && !declared.target.empty();
    if (both && values_of(pair, Side::Source, declared.source) == values_of(pair, Side::Target, declared.target) &&
        stand_for_each_other(pair, declared))
        declared = {};
    for (const Side side : kBothSides)
        if (!declared[side].empty()) edits[side] += (edits[side].empty() ? "" : " ") + declared[side];
    for (const Side side : kBothSides)
        if (!edits[side].empty()) tell(pair, side, edits[side]);
    tell_unlike_numbers(pair, *line);
    tell_caught_locals(pair, *line);
}

/// A renaming of locals changes what a text says where a macro is called like one of them, or reads one.
void MacroEdits::tell_caught_locals(JudgedPair& pair, const LockedPair& line) {
    for (const Side side : kBothSides) {
        const UnitState* unit = pair.unit[side];
        const Fingerprints& recorded = side == Side::Source ? line.source_prints : line.target_prints;
        if (unit == nullptr || recorded.written == unit->prints.written || recorded.renamed != unit->prints.renamed)
            continue;
        const NormalText text_then = facts_.base_text(recorded.written);
        const Words then = text_then.words(), now = unit->text.words();
        std::map<std::string_view, std::string_view> renamed;  // the names of before by those of now
        for (size_t i = 0; i < now.size() && then.size() == now.size(); ++i)
            if (then[i] != now[i]) renamed.emplace(now[i], then[i]);
        for (const auto& [name, before] : renamed) {
            const std::string_view caught = macro_with(*unit, side, name) ? name : before;
            const auto macro = macro_with(*unit, side, caught);
            if (!macro) continue;
            pair.changed = true;
            pair.equivalent = false;
            findings_.add(side == Side::Source ? Rule::SourceChanged : Rule::TargetChanged, pair, {},
                          fmt::format("{} calls its local {} {} now, and {} is a word of the macro {} ({}:{})",
                                      side == Side::Source ? "the source" : "the port", before, name, caught,
                                      shown(*macro), macro->file, macro->line),
                          "local " + std::string(name));
            break;
        }
    }
}

/// The words that a macro puts in its place, without its parameters and members.
std::vector<std::string_view> MacroEdits::words_of(Side side, const WordMacro& macro) {
    if (!at_place_[side]) {
        auto& units = at_place_[side].emplace();
        for (const auto& [id, unit] : facts_.units(side))
            if (unit.kind == UnitKind::Constant) units.emplace(std::pair(unit.file, unit.start_line), &unit);
    }
    const auto unit = at_place_[side]->find(std::pair(std::string(macro.file), macro.line));
    const Words text = unit != at_place_[side]->end() ? unit->second->text.words() : spaced_words(macro.text);
    size_t at = 0;
    while (at < text.size() && text[at] != "define" && text[at] != "#define") ++at;
    at += 2;  // behind its name
    size_t close = at + 1;
    while (close < text.size() && (is_word_token(text[close]) || text[close] == "," || text[close] == "...")) ++close;
    const bool has_list = at < text.size() && text[at] == "(" && close + 1 < text.size() && text[close] == ")";
    const std::set<std::string_view> parameters(text.begin() + static_cast<std::ptrdiff_t>(has_list ? at + 1 : 0),
                                                text.begin() + static_cast<std::ptrdiff_t>(has_list ? close : 0));
    std::vector<std::string_view> out;
    for (size_t i = has_list ? close + 1 : at; i < text.size(); ++i)
        if (is_word_token(text[i]) && !parameters.contains(text[i]) && !is_one_of(text[i - 1], {".", "->"}))
            out.push_back(text[i]);
    return out;
}

/// A macro of that name, or one that the text uses, by whatever steps, and that reads the name.
std::optional<WordMacro> MacroEdits::macro_with(const UnitState& unit, Side side, std::string_view name) {
    constexpr size_t kMostSteps = 1024;
    if (const auto named = macros(side).first_seen(unit.file, name)) return named;
    std::set<std::string_view> seen;
    std::vector<std::string_view> open;
    for (const std::string_view word : unit.text.words())
        if (is_word_token(word) && seen.insert(word).second) open.push_back(word);
    for (size_t steps = 0; !open.empty() && steps < kMostSteps;) {
        const auto macro = macros(side).first_seen(unit.file, open.back());
        open.pop_back();
        if (!macro) continue;
        ++steps;
        for (const std::string_view word : words_of(side, *macro)) {
            if (word == name) return macro;
            if (is_word_token(word) && seen.insert(word).second) open.push_back(word);
        }
    }
    return std::nullopt;
}

/// A name that both texts came to use and that is one number here and another one there: an enumerator, a constant.
void MacroEdits::tell_unlike_numbers(JudgedPair& pair, const LockedPair& line) {
    BySide<NormalText> texts_then;
    BySide<std::set<std::string_view>> then;
    for (const Side side : kBothSides) {
        const Print recorded = (side == Side::Source ? line.source_prints : line.target_prints).written;
        if (pair.unit[side] == nullptr || recorded == pair.unit[side]->prints.written) return;
        texts_then[side] = facts_.base_text(recorded);
        const NormalText& text = texts_then[side];
        if (text.size() == 0) return;
        for (size_t i = 0; i < text.size(); ++i) then[side].insert(text[i]);
    }
    const auto used_there = used_words(pair.unit.target->text);
    for (const std::string_view word : used_words(pair.unit.source->text)) {
        if (then.source.contains(word) || then.target.contains(word) || !used_there.contains(word)) continue;
        BySide<std::string> values;
        bool is_watched = true;
        for (const Side side : kBothSides) {
            const auto declared = macros(side).first_seen(pair.unit[side]->file, "=" + std::string(word));
            if (!declared) continue;
            values[side] = value_of(declared->text);
            is_watched = is_watched && is_told_elsewhere(side, *declared);
        }
        if (!is_number_token(values.source) || !is_number_token(values.target) || is_watched) continue;
        if (number_value(values.source) == number_value(values.target)) continue;
        pair.changed = true;
        pair.equivalent = false;
        findings_.add(Rule::PortDiffers, pair, {},
                      fmt::format("both sides came to use {}, which is {} in the source and {} in the port", word,
                                  values.source, values.target),
                      "new word " + std::string(word));
    }
}

/// Held against the text as it was recorded: a unit that was edited to use a macro tells of that by itself.
std::string MacroEdits::now_of(const JudgedPair& pair, const LockedPair& line, Side side) {
    const UnitState& unit = *pair.unit[side];
    const Print print = (side == Side::Source ? line.source_prints : line.target_prints).written;
    return print != unit.prints.written ? macros(side).of(unit.file, facts_.base_text(print))
                                        : macros(side).of(unit.file, unit.text);
}

std::string MacroEdits::edit_of(const JudgedPair& pair, const LockedPair& line, Side side) {
    const std::string& then = line.macros[side];
    const UnitState* unit = pair.unit[side];
    if (then.empty() || unit == nullptr) return {};
    std::string now = without_declared(now_of(pair, line, side)), recorded = without_declared(then);
    // A macro over a keyword is a new unit by itself where units must have a port.
    if (!counts_keywords(then) || is_contract(facts_.map.reference, side)) {
        now = without_keywords(now);
        recorded = without_keywords(recorded);
    }
    if (now == recorded) return {};
    const Print print = (side == Side::Source ? line.source_prints : line.target_prints).written;
    const std::string edit = difference(recorded, now);
    return without_shared(pair, side, print != unit->prints.written ? of_words_in(unit->text, edit) : edit);
}

/// Without macros that are gone from the side where the file that uses them includes the other side's, which has them.
std::string MacroEdits::without_shared(const JudgedPair& pair, Side side, const std::string& edit) {
    const UnitState* there = pair.unit[other(side)];
    if (edit.empty() || there == nullptr) return edit;
    std::string out;
    for (const auto& [word, hash] : words_with_macros(edit)) {
        const auto shared = hash == "-" ? macros(other(side)).first_seen(there->file, word) : std::nullopt;
        if (shared && shared_files_.includes(side, pair.unit[side]->file, shared->file)) continue;
        out += (out.empty() ? "" : " ") + std::string(word) + ":" + std::string(hash);
    }
    return out;
}

/// What is declared otherwise of words that the text has, as it had them when it was recorded, and that is told by no
/// finding of its own.
std::string MacroEdits::declared_edit(const JudgedPair& pair, const LockedPair& line, Side side) {
    const std::string& then = line.macros[side];
    const UnitState* unit = pair.unit[side];
    if (!counts_declared(then) || unit == nullptr) return {};
    const bool is_code = unit->kind == UnitKind::Function || unit->kind == UnitKind::Kernel;
    const std::string now = now_of(pair, line, side);
    if (!is_code || now == then) return {};
    const std::string changed = declared_difference(then, now);
    std::string out;
    for (const auto& [word, hash] : words_with_macros(changed)) {
        const auto declared = macros(side).first_seen(unit->file, word);
        const bool is_one = word != "=*";
        const bool is_used = is_one && (uses_word(unit->text, plain_word(word)) || leads_to(*unit, side, word));
        if (is_one && (!declared || !is_used || is_told_elsewhere(side, *declared))) continue;
        out += (out.empty() ? "" : " ") + std::string(word) + ":" + std::string(hash);
    }
    return out;
}

/// True if a word that the text uses is declared by another one, by whatever steps.
bool MacroEdits::leads_to(const UnitState& unit, Side side, std::string_view word) {
    std::set<std::string_view> names;
    for (size_t i = 0; i < unit.text.size(); ++i)
        if (is_word_token(unit.text[i])) names.insert(unit.text[i]);
    return std::any_of(names.begin(), names.end(), [&](std::string_view name) {
        return macros(side).leads_to(name, plain_word(word)) && uses_word(unit.text, name);
    });
}

/// True for what lies in a unit that a pair names, which that pair tells of; and, with a merge base, for types, of
/// which NewNames tells.
bool MacroEdits::is_told_elsewhere(Side side, const WordMacro& declared) {
    const bool is_type = declared.text.starts_with("typedef ") || declared.text.starts_with("using ");
    if (is_type) return facts_.at_base[side] != nullptr;
    if (!declaring_[side]) {
        auto& units = declaring_[side].emplace();
        for (const auto& [id, unit] : facts_.units(side))
            if (unit.kind == UnitKind::Constant || unit.kind == UnitKind::Struct) units.emplace(unit.file, &unit);
    }
    const auto [first, last] = declaring_[side]->equal_range(declared.file);
    return std::any_of(first, last, [&](const auto& one) {
        const UnitState& unit = *one.second;
        return unit.start_line <= declared.line && declared.line <= unit.end_line && watched_.contains(side, unit.id);
    });
}

/// What the words of an edit are given now.
std::multiset<std::string> MacroEdits::values_of(const JudgedPair& pair, Side side, const std::string& edit) {
    std::multiset<std::string> out;
    for (const auto& [word, hash] : words_with_macros(edit))
        if (const auto declared = macros(side).first_seen(pair.unit[side]->file, word))
            out.insert(value_of(declared->text));
    return out;
}

/// True if the macros that both sides changed mean the same now, each in names with a part of its own: `clear_cuda(x)`
/// of `CLEAR_CUDA` and `clear_hip(x)` of `CLEAR_HIP`. A macro that is gone means nothing.
bool MacroEdits::say_the_same(const JudgedPair& pair, const BySide<std::string>& edits) {
    BySide<std::multiset<std::string>> values;
    for (const Side side : kBothSides) {
        const size_t words = words_with_macros(edits[side]).size();
        values[side] = values_of(pair, side, edits[side]);
        if (words == 0 || values[side].size() != words) return false;
    }
    const std::string source = fmt::format("{}", fmt::join(values.source, " ; ")),
                      target = fmt::format("{}", fmt::join(values.target, " ; "));
    const OwnParts parts = own_parts({{pair.id.source}, {pair.id.target}});
    return with_parts_there(spaced_words(source), spaced_words(target), parts) == spaced_words(target) &&
           stand_for_each_other(pair, edits);
}

/// False if one word was edited on each side, and the texts laid side by side have another name where it stands.
bool MacroEdits::stand_for_each_other(const JudgedPair& pair, const BySide<std::string>& edits) const {
    BySide<std::vector<std::string>> texts;
    BySide<std::string_view> edited;
    for (const Side side : kBothSides) {
        const auto words = words_with_macros(edits[side]);
        if (words.size() != 1) return true;
        edited[side] = plain_word(words.begin()->first);
        const Words text = pair.unit[side]->text.words();
        texts[side].assign(text.begin(), text.end());
    }
    const Dialect dialect = dialect_of_edits(facts_.map);
    WordKeys keys(dialect);
    const AlignedText a = keys.text(texts.source, false), b = keys.text(texts.target, false);
    const Alignment laid = align(a, b, {});
    bool is_other = false;
    for (size_t i = 0; i < texts.source.size(); ++i) {
        const size_t there = laid.word_of[i];
        if (there == Alignment::kNone) continue;
        const bool here_it_is = texts.source[i] == edited.source, there_it_is = texts.target[there] == edited.target;
        if (here_it_is && there_it_is) return true;
        is_other = is_other || (here_it_is && is_word_token(texts.target[there])) ||
                   (there_it_is && is_word_token(texts.source[i]));
    }
    return !is_other;
}

/// True if the pair has a finding on the edit of that side's own text: one look at it sees both.
bool MacroEdits::is_told_by_edit(const JudgedPair& pair, const Finding& of_macros) const {
    const auto all = findings_.from(0);
    for (size_t i = all.size(); i-- > 0;) {
        const Finding& finding = all[i];
        if (finding.map_source != pair.id.source || finding.map_target != pair.id.target) return false;
        const bool of_text = finding.rule == of_macros.rule || finding.rule == Rule::PortDiffers;
        if (of_text && finding.change && is_open(finding) && finding.level >= of_macros.level) return true;
    }
    return false;
}

void MacroEdits::tell(JudgedPair& pair, Side side, const std::string& edit) {
    const std::string key = (side == Side::Source ? "source " : "target ") + edit;
    pair.macro_edit += (pair.macro_edit.empty() ? "" : ", ") + key;
    const bool was_changed = std::exchange(pair.changed, true);
    const bool is_aside = are_words_of_asides(*pair.unit[side], edit);
    const std::string told_as = key + (is_aside ? " in asides" : "");
    if (told_.has_told(told_as)) {
        if (!was_changed) pair.equivalent = true;  // it is settled with the one that tells
        return;
    }
    pair.equivalent = false;
    const UnitState& unit = *pair.unit[side];
    Finding& finding = findings_.add(side == Side::Source ? Rule::SourceChanged : Rule::TargetChanged, pair, {}, "",
                                     "macros of " + told_as);
    for (const auto& [word, hash] : words_with_macros(edit)) {
        std::string says;
        if (const auto seen = macros(side).first_seen(unit.file, word)) {
            says = fmt::format("{} now ({}:{})", shown(*seen), seen->file, seen->line);
            finding.details.push_back("+ " + std::string(seen->text));
        } else {
            says = "a macro no longer";
            finding.details.push_back("- #define " + std::string(word));
        }
        if (finding.message.empty())
            finding.message =
                fmt::format("{} says something else, unedited: ", side == Side::Source ? "the source" : "the port") +
                (word.ends_with('*') ? "macros changed of more of its words than are kept apart"
                                     : fmt::format("its word {} is {}", plain_word(word), says));
    }
    if (std::all_of(finding.details.begin(), finding.details.end(),
                    [](const std::string& line) { return is_alias_of_runtime(std::string_view(line).substr(2)); })) {
        finding.level = std::min(finding.level, Level::Note);
        finding.message += ", the same call of another runtime";
    }
    if (is_aside) {
        finding.level = std::min(finding.level, Level::Note);
        finding.message += "; but it only decides on what is printed, checked or timed";
    }
    if (finding.details.size() > 1) finding.message += fmt::format(" (and {} more)", finding.details.size() - 1);
    if (is_told_by_edit(pair, finding)) {
        finding.level = std::min(finding.level, Level::Note);
        finding.message += "; told with the edit of the text itself";
        return;  // of pairs whose texts are as they were another tells
    }
    told_.tell(told_as, finding);
}

void MacroEdits::tell_how_many() {
    told_.tell_how_many(findings_, [](const std::string& what, size_t more) {
        return fmt::format("; so {} of {}", what.starts_with("source") ? "does the source" : "does the port",
                           more_pairs(more));
    });
}

}  // namespace porttool
