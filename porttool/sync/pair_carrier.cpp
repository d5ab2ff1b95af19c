// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/pair_carrier.h"

#include <algorithm>
#include <optional>

#include "porttool/compare/alignment.h"
#include "porttool/compare/own_parts.h"
#include "porttool/compare/runtime_calls.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/block_ends.h"
#include "porttool/sync/call_sites.h"
#include "porttool/sync/device_wait.h"
#include "porttool/sync/file_text.h"
#include "porttool/sync/local_manner.h"
#include "porttool/sync/port_gate.h"
#include "porttool/sync/rescan.h"
#include "porttool/sync/scopes.h"
#include "porttool/sync/told_places.h"
#include "porttool/sync/transplant.h"
#include "porttool/sync/withdrawn.h"

namespace porttool {
namespace {

/// True if one side has a block in braces whose counterpart has none.
bool has_other_braces(const Transplant& found, const UnitWords& is, const AlignedText& now, const UnitWords& there,
                      const AlignedText& port) {
    for (size_t c = 0; c < found.stands_for.size(); ++c) {
        const size_t other = found.stands_for[c];
        if (other != Alignment::kNone && now.clauses[c].opens && port.clauses[other].opens &&
            is.is_added(now.clauses[c].end - 1) != there.is_added(port.clauses[other].end - 1))
            return true;
    }
    return false;
}

void declare_constants(const AlignedText& text, const UnitWords& words, const std::vector<uint32_t>& tokens,
                       Transplant& found) {
    for (ClausesAdded& one : found.added)
        for (ClauseAdded& clause : one.clauses) {
            const size_t first = text.clauses[clause.source].first;
            if (clause.is_wait || words.is_added(first) || clause.words.empty()) continue;
            if (clause.words.front().text == "const") continue;
            if (std::find(tokens.begin(), tokens.end(), words.tokens[first]) != tokens.end())
                clause.words.insert(clause.words.begin(), {"const", CarriedWord::kNoSource});
        }
}

/// What is left in the same words at several places, or since nothing tells how the port says the same words, is one
/// item with all its lines: what answers one answers all of them.
class RepeatedReasons {
public:
    /// Puts an item among those that are left, or its line to the one that says so.
    void add(LeftItem item, Side to, std::vector<LeftItem>& left) {
        const size_t why = item.message.rfind("; nothing tells how the port says `");
        const std::string reason = why == std::string::npos ? item.message : item.message.substr(why);
        const auto [told, is_new] = by_reason_.try_emplace(reason, Told{left.size(), {}});
        if (is_new)
            left.push_back(std::move(item));
        else
            told->second.lines.insert(to == Side::Source ? item.source_line : item.target_line);
    }

    void name_lines(std::vector<LeftItem>& left) const {
        constexpr size_t kMost = 8;
        for (const auto& [reason, told] : by_reason_) {
            std::string lines;
            size_t named = 0;
            for (const uint32_t line : told.lines)
                if (named++ < kMost) lines += (lines.empty() ? "" : ", ") + std::to_string(line);
            if (named > kMost) lines += " and " + std::to_string(named - kMost) + " more";
            if (named > 0) left[told.place].message += " (and so beside line " + lines + " of the port)";
        }
    }

private:
    struct Told {
        size_t place;
        std::set<uint32_t> lines;
    };
    std::map<std::string, Told> by_reason_;
};

/// True if the port gets a wait of its own.
bool has_wait(const Transplant& found) {
    return std::any_of(found.added.begin(), found.added.end(), [](const ClausesAdded& one) {
        return std::any_of(one.clauses.begin(), one.clauses.end(),
                           [](const ClauseAdded& clause) { return clause.is_wait; });
    });
}

/// What the names of both units and their paths have of their own.
OwnParts parts_of_pair(const ScannedFile& file, const Unit& unit, const ScannedFile& other, const Unit& port) {
    return own_parts({{unit.name, file.path}, {port.name, other.path}});
}

/// The name of the class that a unit is a method of; "" for none.
std::string_view class_of(const Unit& unit) {
    const size_t leaf = leaf_of(unit.name).size();
    const std::string_view name = unit.name;
    if (name.size() <= unit.namespace_length + leaf + 2) return {};
    return name.substr(0, name.size() - leaf - 2);
}

bool has_word(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// The names of a clause but for what it calls, by their common numbers.
std::set<uint32_t> values_named(const AlignedText& text, const Clause& clause) {
    std::set<uint32_t> out;
    for (size_t i = clause.first; i < clause.end; ++i)
        if (is_word_token(text.words[i]) && (i + 1 == clause.end || text.words[i + 1] != "("))
            out.insert(text.common[i]);
    return out;
}

/// True for one more argument, or one fewer: what the others are does not count.
bool changes_list(const WordsReplaced& one, const AlignedText& target) {
    if (one.first == one.end)
        return !one.words.empty() && (one.words.front().text == "," || one.words.back().text == ",");
    return one.words.empty() && (target.words[one.first] == "," || target.words[one.end - 1] == ",");
}

/// True if a statement of the port in which words change names other values than the source's did: `z = turned * s`
/// for `z = z * s` is not what a new `z *= s` stands for.
bool changes_other_values(const Transplant& found, const AlignedText& before, const AlignedText& target,
                          const Alignment& across) {
    return std::any_of(found.replaced.begin(), found.replaced.end(), [&](const WordsReplaced& one) {
        if (changes_list(one, target)) return false;
        for (size_t c = 0; c < before.clauses.size(); ++c) {
            if (across.clause_of[c] == Alignment::kNone) continue;
            const Clause& there = target.clauses[across.clause_of[c]];
            if (one.first >= there.first && one.first < there.end)
                return values_named(before, before.clauses[c]) != values_named(target, there);
        }
        return true;
    });
}

/// True for a name that looks at what calls of a run time give back, and at nothing else, where the port calls none
/// that gives a status: it needs no port.
bool only_looks_at_status(const std::vector<std::string>& words, const std::string& name,
                          const std::vector<std::string>& there) {
    if (!says_that_it_checks(name) ||
        std::any_of(there.begin(), there.end(), [](const std::string& word) { return is_runtime_call(word); }))
        return false;
    for (size_t i = 0; i < words.size(); ++i)
        if (words[i] == name && (i + 2 >= words.size() || words[i + 1] != "(" || !is_runtime_call(words[i + 2])))
            return false;
    return true;
}

/// True if a `#` of a unit begins no directive, since it begins no line.
bool has_stray_directive(const ScannedFile& file, const Unit& unit) {
    for (uint32_t i = unit.tokens.first; i < unit.tokens.end; ++i)
        if (file.lexed.view(i) == "#" && (file.lexed.tokens[i].flags & kInDirective) == 0) return true;
    return false;
}

/// How a text writes its numbers, by their normal form: as it does most often.
std::map<std::string, std::string> written_numbers(const ScannedFile& file, const UnitWords& text) {
    std::map<std::string, std::map<std::string, size_t>> times;
    for (size_t i = 0; i < text.words.size(); ++i)
        if (is_number_token(text.words[i]) && !text.is_added(i))
            ++times[text.words[i]][std::string(file.lexed.view(text.tokens[i]))];
    std::map<std::string, std::string> out;
    for (const auto& [number, written] : times)
        out[number] = std::max_element(written.begin(), written.end(), [](const auto& a, const auto& b) {
                          return a.second < b.second;
                      })->first;
    return out;
}

void leave_at_heads(const PairEdit& edit, std::string why, Proposal& out) {
    out.left.push_back({std::move(why), first_line(edit.pair, Side::Source), first_line(edit.pair, Side::Target)});
}

/// `here`: the line on the side that changed.
LeftItem left_at(Side from, std::string why, uint32_t here, uint32_t there) {
    return from == Side::Source ? LeftItem{std::move(why), here, there} : LeftItem{std::move(why), there, here};
}

}  // namespace

/// Both units in their files.
struct PairCarrier::Places {
    const ScannedFile &file, &other;
    const Unit& unit;
    Draft& draft;
    const Unit& port;
};

/// The source's unit before and now and the port's, as words, and side by side.
struct PairCarrier::Texts : Places {
    CalledForms forms;  ///< of the port
    UnitWords there, was, is;
    AlignedText old_text, new_text, port_text;
    Alignment edit, across;
    std::vector<LaunchPair> launches;
    Examples examples;

    Texts(const Places& places, const PairEdit& one, const CalledForms& called, WordKeys keys)
        : Places(places),
          forms(called),
          there(words_of_unit(draft.scanned, port)),
          was(in_forms_of(forms, words_of_record(one.before[one.from]))),
          is(in_forms_of(forms, words_of_unit(file, unit))),
          old_text(keys.text(was.words, unit.kind == UnitKind::Struct)),
          new_text(keys.text(is.words, unit.kind == UnitKind::Struct)),
          port_text(keys.text(there.words, unit.kind == UnitKind::Struct)),
          edit(align(old_text, new_text, {0.5, false})) {
        join_own_parts(old_text, port_text, parts_of_pair(file, unit, draft.scanned, port));
        across = align(old_text, port_text, {});
        match_block_ends(old_text, new_text, edit);
        match_last_else(old_text, new_text, is, edit);
        match_only_clauses(old_text, new_text, edit);
        match_calls(old_text, new_text, edit);
        launches = paired_launches(old_text, port_text, across);
    }

    ToldPlaces places() const {
        return {
            {line_of_each(file, is), line_of_each(draft.scanned, there)}, old_text, new_text, port_text, edit, across};
    }

    void learn() {
        examples.learn(old_text, port_text, across);
        examples.learn_patterns(old_text, port_text, across);
        examples.learn_name(std::string(leaf_of(unit.name)), std::string(leaf_of(port.name)));
    }
};

void PairCarrier::carry(const PairEdit& edit, Proposal& out) {
    const Side from = edit.from, to = edit.to();
    const ScannedFile* file = knowledge_.file_of(from, edit.pair.unit[from]->file);
    const ScannedFile* other = knowledge_.file_of(to, edit.pair.unit[to]->file);
    const Unit* unit = file == nullptr ? nullptr : knowledge_.unit_of(*file, edit.pair.unit[from]->id);
    if (unit == nullptr || other == nullptr) return leave_at_heads(edit, "a whole file is not carried", out);
    Draft& draft = drafts_.of(to, *other);
    if (draft.is_linked)
        return leave_at_heads(edit, "its file " + std::string(kIsLinked) + "; name the file itself in portmap.toml",
                              out);
    const Unit* port = draft.unit(edit.pair.unit[to]->id);
    if (port == nullptr)
        return leave_at_heads(edit, "an edit before this one in the same file has hidden the port", out);
    CalledForms forms;
    const UnitWords there = words_of_unit(draft.scanned, *port);
    forms.add(Words(there.words.begin(), there.words.end()));
    add_functions_of_vectors(other->language, forms);
    Texts texts({*file, *other, *unit, draft, *port}, edit, forms, WordKeys(knowledge_.dialect()));
    if (holds_a_part(edit, texts.across))
        return leave_at_heads(
            edit,
            "this is one of several ports and holds a part of it alone; whether the edit is in that part is not told",
            out);
    const auto is_macro = [](const UnitWords& text) { return !text.words.empty() && text.words.front() == "#"; };
    if (is_macro(texts.was) != is_macro(texts.is) && is_macro(texts.there) != is_macro(texts.is))
        return leave_at_heads(edit,
                              is_macro(texts.is) ? "the source made a macro of it; look whether the port is to do so"
                                                 : "it is no macro any more; look how the port is to declare it",
                              out);
    texts.learn();
    KnownNames names = names_of(edit, texts);
    Transplant found = transplanted(edit, texts, names, out);
    leave_unported(edit, texts, names, found, out);
    // Where more is left than carried, a part of the port would only be in the way.
    constexpr size_t kFew = 2;
    if (found.left_size() > std::max(kFew, found.size())) return;
    if (!found.empty()) {
        if (write(edit, texts, names, found, out)) return;
        out.left.clear();
        return carry(edit, out);  // in the text as it is now
    }
    if (!out.left.empty()) return;
    if (found.already == 0)
        return leave_at_heads(
            edit, "what the edit changed has no counterpart in the port's language; look whether it needs one", out);
    out.state = ProposalState::Already;
    out.why.emplace_back("the port has it already");
}

/// True for a name of another block, which the port says without it, that a new block declares for itself.
bool PairCarrier::is_declared_anew(const Texts& texts, const std::string& name) {
    return declarations_of(texts.is.words, name).size() > declarations_of(texts.was.words, name).size();
}

PairCarrier::KnownNames PairCarrier::names_of(const PairEdit& edit, const Texts& texts) {
    KnownNames out;
    out.from_elsewhere = new_units_.brought();
    out.from_elsewhere.merge(new_members(checked_, lines_, edit.pair, edit.from));
    const auto& declared = declarations_.brings(edit.pair, edit.from);
    out.from_elsewhere.insert(declared.begin(), declared.end());
    out.brought = out.from_elsewhere;
    out.unported = new_units_.unported(edit.from);
    for (const auto& [name, why] : out.unported) out.lone.insert(name);
    const Words plain = without_directives(texts.is.words);
    for (const auto& [macro, name] : declared_behind_macro(plain)) out.locals.emplace(plain[name]);
    for (std::string& name : local_names(texts.file, texts.unit)) out.locals.insert(std::move(name));
    for (const std::string& name : out.locals)  // a name that the port has for something else cannot be taken
        if (!has_word(texts.was.words, name))
            (has_word(texts.there.words, name) ? out.lone : out.brought).insert(name);
        else if (!has_word(texts.there.words, name) && is_declared_anew(texts, name))
            out.brought.insert(name);
    for (const Directive& one : texts.draft.scanned.lexed.directives)  // which would say something else there
        if (one.kind == DirectiveKind::Define && one.first_token + 2 < one.end_token)
            if (const std::string name(texts.draft.scanned.lexed.view(one.first_token + 2)); out.locals.contains(name))
                out.lone.insert(name);
    for (const std::string& name : declared_twice(texts.was.words))
        if (texts.examples.is_said_variously(name)) out.lone.insert(name);
    return out;
}

Transplant PairCarrier::transplanted(const PairEdit& edit, const Texts& texts, KnownNames& names, Proposal& out) {
    const ScannedFile& file = texts.file;
    const UnitWords& is = texts.is;
    const KnownWords& known = knowledge_.known_words(edit.from, file, texts.other);
    const UnitNames& units = knowledge_.unit_names(edit.from);
    const LearnedBeside beside = knowledge_.learned_beside(edit.from, file.path, texts.other.path);
    const Unit& port = texts.port;
    const bool is_method = !class_of(port).empty();
    UnitSurroundings around{!runs_on_device(file, texts.unit), is_method,
                            is_method && leaf_of(class_of(port)) == leaf_of(class_of(texts.unit)),
                            device_wait(texts.there.words, texts.other), known.scope_of_builtins(texts.there.words)};
    around.pointers = declared_pointers(texts.there.words);
    around.numbers = written_numbers(texts.draft.scanned, texts.there);
    read_earlier_file(edit, texts, around);
    const auto written = [&](size_t i) {
        return is.words[i] == "@" || is.is_added(i) ? is.words[i] : std::string(file.lexed.view(is.tokens[i]));
    };
    const std::set<size_t> paragraphs = paragraphs_of(file, is);
    const EditTexts laid{texts.old_text,
                         texts.new_text,
                         texts.port_text,
                         texts.edit,
                         texts.across,
                         knowledge_.hands_back(edit.from),
                         knowledge_.hands_back(edit.to()),
                         paragraphs,
                         texts.launches};
    Transplant found;
    // What uses a new name can only be carried with what declares it.
    std::map<size_t, std::string> first_reasons;  // later ones may only be that a name is not declared any more
    do {
        for (const LeftOver& left : found.left) first_reasons.try_emplace(left.source_word, left.message);
        found =
            transplant(laid, EditTranslator(texts.examples, beside, units, names.lone, known, names.brought, around),
                       written, is_method);
    } while (lose_undeclared(is.words, found, names.from_elsewhere, names.brought, names.lone));
    RepeatedReasons reasons;
    for (const LeftOver& left : found.left) {
        const auto reason = first_reasons.find(left.source_word);
        LeftItem item =
            left_at(edit.from, reason == first_reasons.end() ? left.message : reason->second,
                    line_at(file, is, left.source_word), line_at(texts.draft.scanned, texts.there, left.target_word));
        item.is_sure = left.is_sure;
        reasons.add(std::move(item), edit.to(), out.left);
    }
    reasons.name_lines(out.left);
    return found;
}

/// What the source's file had before the edit and has not now, and the other way round; nothing where it is not known.
void PairCarrier::read_earlier_file(const PairEdit& edit, const Texts& texts, UnitSurroundings& out) {
    const auto note_real = [&](std::string_view word) {
        if (is_one_of(word, {"float", "double", "half"})) out.reals.emplace(word);
    };
    for (const std::string& word : texts.was.words) note_real(word);
    const std::string* text = earlier_texts_.of(edit.from, texts.file.path);
    if (text == nullptr) return;
    for (const std::string& word : texts.is.words)
        if (is_word_token(word) && !has_word(texts.was.words, word)) out.fresh.insert(word);
    if (out.fresh.empty()) return;
    const ScannedFile file = scan_text(texts.file.path, *text);
    for (const Token& token : file.lexed.tokens) {
        note_real(file.lexed.view(token));
        if (const auto known = out.fresh.find(file.lexed.view(token)); known != out.fresh.end()) out.fresh.erase(known);
    }
    for (const Unit& unit : file.units) out.gone.emplace(leaf_of(unit.name));
    for (const Unit& unit : texts.file.units) out.gone.erase(std::string(leaf_of(unit.name)));
}

/// New units without a port that the edit comes to use.
void PairCarrier::leave_unported(const PairEdit& edit, const Texts& texts, const KnownNames& names,
                                 const Transplant& found, Proposal& out) const {
    const std::vector<std::string>&is = texts.is.words, &was = texts.was.words;
    for (const auto& [name, why] : names.unported) {
        const auto call = std::find(is.begin(), is.end(), name);
        if (call == is.end() || std::count(is.begin(), is.end(), name) == std::count(was.begin(), was.end(), name))
            continue;
        if (only_looks_at_status(is, name, texts.there.words)) continue;
        out.left.push_back(left_at(
            edit.from,
            "it uses `" + name + "`, which came without a port; port that, too" + (why.empty() ? why : ": " + why),
            line_at(texts.file, texts.is, static_cast<size_t>(call - is.begin())),
            texts.places().of("`" + name + "`", found).second));
    }
}

/// False where what the edit uses was lifted above the port first, so that the draft is another one now.
bool PairCarrier::write(const PairEdit& edit, const Texts& texts, const KnownNames& names, Transplant& found,
                        Proposal& out) {
    std::set<std::string> used = words_brought(found);
    for (const std::string& name : names.locals) used.erase(name);
    for (const std::string& word : texts.there.words) used.erase(word);
    const UnitRaiser::Raised raised = raiser_.raise(edit.to(), texts.draft, edit.pair.unit[edit.to()]->id, used);
    if (!raised.failure.empty()) {
        leave_at_heads(edit, raised.failure, out);
        return true;
    }
    if (raised.any) return false;
    declare_constants(texts.new_text, texts.is, constants_of(texts.file, texts.unit, texts.other), found);
    if (leave_values_of_nothing(edit, texts, found, out) && found.empty()) return true;
    if (has_other_braces(found, texts.is, texts.new_text, texts.there, texts.port_text))
        found.braces = edit_of_braces(edit, texts);
    finish(edit, texts, found, out);
    return true;
}

/// Takes back what would take a value of functions that give none in the port, and what came with that; true if any.
bool PairCarrier::leave_values_of_nothing(const PairEdit& edit, const Texts& texts, Transplant& found,
                                          Proposal& out) const {
    const std::vector<std::string>& is = texts.new_text.words;
    const auto asks = [&](size_t first, size_t end) -> std::string {
        for (const Clause& clause : texts.new_text.clauses)
            for (size_t i = std::max(clause.first, size_t{1});
                 clause.first < end && first < clause.end && i < clause.end; ++i)
                if (takes_value(is[i - 1]) && knowledge_.valueless().contains({edit.pair.unit[edit.to()]->id, is[i]}))
                    return is[i];
        return {};
    };
    if (knowledge_.valueless().empty()) return false;
    std::set<std::string> names;
    const auto takes_back = [&](const std::vector<CarriedWord>& words, size_t first, size_t end, size_t there) {
        const std::string name = asks(first, end);
        if (name.empty()) return false;
        for (const CarriedWord& word : words)
            if (is_word_token(word.text) && !has_word(texts.there.words, word.text)) names.insert(word.text);
        out.left.push_back(
            left_at(edit.from, "the source takes the value of `" + name + "`; the port's gives none",
                    line_at(texts.file, texts.is, first),
                    line_at(texts.draft.scanned, texts.there, std::min(there, texts.there.words.size() - 1))));
        return true;
    };
    const size_t size = found.size();
    std::erase_if(found.replaced, [&](const WordsReplaced& one) {
        return takes_back(one.words, one.source_first, std::max(one.source_end, one.source_first + 1), one.first);
    });
    std::erase_if(found.added, [&](const ClausesAdded& one) {
        return std::any_of(one.clauses.begin(), one.clauses.end(), [&](const ClauseAdded& clause) {
            const Clause& made = texts.new_text.clauses[clause.source];
            return takes_back(clause.words, made.first, made.end, one.before);
        });
    });
    if (found.size() == size) return false;
    Transplant less = found;
    if (!names.empty() && withdraw(std::move(names), texts.new_text, texts.port_text, less)) found = std::move(less);
    return true;
}

/// Takes back what leaves names of the port undeclared, or declared twice; false where some would be all the same.
/// `file`: the port's, as it stands.
bool PairCarrier::withdraw_undeclared(const PairEdit& edit, const Texts& texts, const ScannedFile& file,
                                      Transplant& found) {
    constexpr int kMostRounds = 6;
    for (int round = 0; round < kMostRounds && !found.empty(); ++round) {
        const std::optional<std::string> made =
            edit_file(texts.draft.bytes, file.lexed.text, edits_of(texts, file, found));
        if (!made) return false;
        const ScannedFile scanned = scan_text(file.path, *made);
        const Unit* unit = unit_named(scanned, edit.pair.unit[edit.to()]->id);
        if (unit == nullptr) return false;
        const std::vector<std::string> words = words_of_unit(scanned, *unit).words;
        std::set<std::string> names = names_lost(scanned, texts.there.words, words);
        names.merge(names_doubled(texts.there.words, words));
        if (names.empty()) return true;
        if (!withdraw(std::move(names), texts.new_text, texts.port_text, found)) return false;
    }
    return found.empty();
}

std::vector<TextEdit> PairCarrier::edits_of(const Texts& texts, const ScannedFile& file, const Transplant& found) {
    return rewrite_unit(found, {texts.file, texts.is, texts.new_text.clauses},
                        {file, texts.there, texts.port_text.clauses}, texts.draft.indent());
}

/// Makes the new text, and holds it to the gate before anybody sees it.
void PairCarrier::finish(const PairEdit& edit, const Texts& texts, Transplant& found, Proposal& out) {
    Draft& draft = texts.draft;
    const std::vector<TextEdit> edits = edits_of(texts, draft.scanned, found);
    const ToldPlaces places = texts.places();  // of the port as it stands
    const auto leave_where = [&](const std::string& told, std::string why) {
        const auto [here, there] = places.of(told, found);
        out.left.push_back(left_at(edit.from, std::move(why), here, there));
    };
    std::optional<RescannedLines> alone;
    const auto refuse = [&](std::string why) {
        out.state = ProposalState::Refused;
        const auto [here, there] = places.first_edit(found);
        out.left.push_back(left_at(edit.from, std::move(why), here, there));
        if (alone) draft.scanned = scan_text(draft.scanned.path, draft.bytes);  // it holds what is not written
    };
    const JudgedPair& pair = edit.pair;
    const Unit& port = *draft.unit(pair.unit[edit.to()]->id);
    const std::vector<std::string> old_words = words_of_unit(draft.scanned, port).words;
    const auto place = static_cast<size_t>(&port - draft.scanned.units.data());
    if (draft.has_scanned_text()) alone = rescan_unit(draft.scanned, place, edits);
    std::string now;
    ScannedFile whole;  // scanned anew only where the unit alone does not tell
    if (!alone) {
        std::optional<std::string> edited = edit_file(draft.bytes, draft.scanned.lexed.text, edits);
        if (!edited) return refuse("the port's line goes on behind a backslash there");
        now = std::move(*edited);
        whole = scan_text(draft.scanned.path, now);
    }
    const ScannedFile& scanned = alone ? draft.scanned : whole;
    const Unit* unit = alone ? &port : unit_named(scanned, pair.unit[edit.to()]->id);
    if (!alone &&
        (unit == nullptr || scanned.balanced != draft.scanned.balanced || !others_stayed(draft.scanned, scanned, port)))
        return refuse("the port made of this edit could not be read back");
    if (has_stray_directive(scanned, *unit)) return refuse("a directive of the port would stand within a line");
    const std::vector<std::string> new_words = words_of_unit(scanned, *unit).words;
    if (new_words == old_words) return refuse("the port says so already where it would come; look whether that is all");
    if (ends_its_directives(old_words) && !ends_its_directives(new_words))
        return refuse("an `#if` of the port would go without its `#endif`, or the other way round");
    for (const std::string& name : templates_without_arguments(scanned, old_words, new_words))
        leave_where("`" + name + "`", "the port's `" + name + "` is a template, which takes arguments");
    const std::set<std::string> lost = names_lost(scanned, old_words, new_words),
                                doubled = names_doubled(old_words, new_words);
    for (const std::string& name : lost)
        leave_where("`" + name + "`", "the port would use `" + name + "` where it does not declare it");
    for (const std::string& name : doubled)
        leave_where("`" + name + "`", "the port would declare `" + name + "` twice there");
    if (!lost.empty() || !doubled.empty()) {
        Transplant less = found;
        std::optional<ScannedFile> as_it_was;
        if (alone) as_it_was = scan_text(draft.scanned.path, draft.bytes);
        if (withdraw_undeclared(edit, texts, as_it_was ? *as_it_was : draft.scanned, less)) {
            if (as_it_was) draft.scanned = std::move(*as_it_was);
            found = std::move(less);
            if (!found.empty()) return finish(edit, texts, found, out);
            out.state = ProposalState::Refused;
            return;
        }
    }
    if (std::string why = gives_back_as_before(old_words, new_words); !why.empty()) {
        const auto given = std::find(old_words.begin(), old_words.end(), "return");
        out.left.push_back(left_at(
            edit.from, std::move(why), places.first_edit(found).first,
            line_at(draft.scanned, texts.there,
                    given == old_words.end() ? old_words.size() - 1 : static_cast<size_t>(given - old_words.begin()))));
    }
    if (const std::string word = doubled_qualifier(old_words, new_words); !word.empty())
        return refuse("the port would say `" + word + "` twice there");
    const UnitState state = unit_state(scanned, *unit);
    const bool to_target = edit.to() == Side::Target;
    const NormalText &source = to_target ? pair.unit.source->text : state.text,
                     &target = to_target ? state.text : pair.unit.target->text;
    const auto compare = [&](const BySide<NormalText>& before, const NormalText& on_source,
                             const NormalText& on_target) {
        return compare_now(pair, edit.line, before, on_source, to_target ? pair.unit.source->prints : state.prints,
                           on_target, to_target ? state.prints : pair.unit.target->prints, knowledge_.dialect());
    };
    PairComparison compared = compare(edit.before, source, target);
    // Waits that the port does without, or has of its own, are no part of what the edit says.
    if (const DeviceWait wait = device_wait(texts.there.words, texts.other);
        compared.standing > Standing::Equivalent && wait && (wait->empty() || has_wait(found))) {
        const auto plain = [&](const NormalText& text) { return without_waits(text, *wait); };
        compared = compare({plain(edit.before.source), plain(edit.before.target)}, plain(source), plain(target));
    }
    out.state = out.left.empty() ? ProposalState::Proposed : ProposalState::Partial;
    const auto is_asked_about = [&] {
        if (compared.standing <= Standing::Equivalent) return false;
        const EditedBodies bodies(edit.before, source, target);
        return !is_edited_in_same_words(pair, bodies, knowledge_.dialect(), found.added.empty()) &&
               (changes_other_values(found, texts.old_text, texts.port_text, texts.across) ||
                !is_only_noted(pair, bodies, knowledge_.dialect()));
    };
    if (out.left.empty() && is_asked_about()) {
        out.state = ProposalState::Partial;
        leave_where(what_differs(compared), "check would still ask about it: " + what_differs(compared));
    }
    const bool is_same = alone ? std::string_view(draft.bytes).substr(alone->first, alone->end - alone->first) ==
                                     std::string_view(scanned.lexed.text).substr(alone->first, alone->now)
                               : draft.bytes == now;
    if (is_same) return refuse("nothing came of it");
    if (alone)
        drafts_.write_rescanned(draft, *alone);
    else
        drafts_.write(draft, std::move(now), std::move(whole));
}

/// True for one of several counterparts that has less than most of the unit.
bool PairCarrier::holds_a_part(const PairEdit& edit, const Alignment& across) const {
    if (counts_[edit.from].at(edit.pair.id[edit.from]) < 2) return false;
    const auto found = std::count_if(across.clause_of.begin(), across.clause_of.end(),
                                     [](size_t there) { return there != Alignment::kNone; });
    constexpr double kMost = 0.8;
    return static_cast<double>(found) < kMost * static_cast<double>(across.clause_of.size());
}

/// The tokens that begin a new declaration which the port's file would make a constant.
std::vector<uint32_t> PairCarrier::constants_of(const ScannedFile& file, const Unit& unit, const ScannedFile& other) {
    return knowledge_.makes_constants(file, other) ? constant_locals(file, unit, false) : std::vector<uint32_t>();
}

/// Which blocks the edit gave braces, or took them from; none where the text before, as a file, is not known.
BraceEdits PairCarrier::edit_of_braces(const PairEdit& edit, const Texts& texts) {
    const UnitState& unit = *edit.pair.unit[edit.from];
    const std::string* text = earlier_texts_.of(edit.from, unit.file);
    if (text == nullptr) return {};
    const ScannedFile file = scan_text(unit.file, *text);
    const Unit* before = unit_named(file, unit.id);
    if (before == nullptr) return {};
    const UnitWords earlier = in_forms_of(texts.forms, words_of_unit(file, *before));
    // A record has no blanks in strings.
    const auto same = [](const std::string& a, const std::string& b) {
        return a == b || (a.starts_with('"') && b.starts_with('"'));
    };
    const bool is_before =
        std::equal(earlier.words.begin(), earlier.words.end(), texts.was.words.begin(), texts.was.words.end(), same);
    return is_before ? brace_edits(earlier, texts.old_text, texts.is, texts.new_text, texts.edit) : BraceEdits();
}

}  // namespace porttool
