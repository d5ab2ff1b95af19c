// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/propose.h"

#include <algorithm>
#include <functional>
#include <optional>
#include <unordered_map>

#include "porttool/compare/compare_pair.h"
#include "porttool/judge/settle.h"
#include "porttool/language/words.h"
#include "porttool/normal/unit_state.h"
#include "porttool/read/lock_lines.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/block_ends.h"
#include "porttool/sync/call_carrier.h"
#include "porttool/sync/declaration_carrier.h"
#include "porttool/sync/file_text.h"
#include "porttool/sync/include_carrier.h"
#include "porttool/sync/knowledge.h"
#include "porttool/sync/known_words.h"
#include "porttool/sync/local_manner.h"
#include "porttool/sync/new_units.h"
#include "porttool/sync/rescan.h"
#include "porttool/sync/scopes.h"
#include "porttool/sync/transplant.h"
#include "porttool/sync/unit_raiser.h"
#include "porttool/sync/unit_remover.h"

namespace porttool {
namespace {

constexpr size_t kMostWords = 5000;  ///< of a unit; a longer one is a person's

bool is_gone(const JudgedPair& pair) { return pair.unit.source == nullptr || pair.unit.target == nullptr; }

class Proposer {
public:
    Proposer(const CheckedProject& checked, WriteSide write, const Disk& disk, const EarlierFiles& earlier,
             Knowledge& knowledge)
        : checked_(checked),
          write_(write),
          lines_(checked.lock),
          earlier_(earlier),
          knowledge_(knowledge),
          drafts_(checked, disk),
          record_(checked, disk, drafts_),
          new_units_(checked, earlier_, knowledge_, drafts_, record_, brought_),
          remover_(checked, knowledge_, drafts_, record_),
          raiser_(checked, knowledge_, drafts_),
          earlier_texts_(earlier_),
          includes_(checked, earlier_texts_, knowledge_, drafts_),
          declarations_(earlier_texts_, knowledge_, drafts_),
          calls_(checked, knowledge_, drafts_) {
        for (const JudgedPair& pair : checked.judgement.pairs)
            for (const Side side : kBothSides) ++counterparts_[side][pair.id[side]];
        knowledge_.set_fresh({});
    }

    /// `keeps_back`: pairs of structs whose new fields nothing else may use.
    SyncResult run(const std::vector<size_t>& pairs, const std::set<size_t>& keeps_back) {
        for (const size_t i : pairs) {
            const JudgedPair& pair = checked_.judgement.pairs[i];
            if (!keeps_back.contains(i)) note_brought(pair);
            for (const Side side : kBothSides)
                if (pair.unit[side] != nullptr) earlier_texts_.expect(side, pair.unit[side]->file);
        }
        for (const size_t i : pairs) result_.proposals.push_back(propose_pair(checked_.judgement.pairs[i]));
        calls_.tell(pairs, result_.proposals);
        result_.files_with_partial = drafts_.files();
        return std::move(result_);
    }

private:
    /// Names that an edit brings in: what other edits of the same run may use.
    void note_brought(const JudgedPair& pair) {
        for (const Side side : kBothSides) brought_.merge(new_members(pair, side));
    }

    /// The fields and methods that a struct has gained on one side. Their types are known otherwise, or not.
    std::set<std::string, std::less<>> new_members(const JudgedPair& pair, Side side) const {
        std::set<std::string, std::less<>> out, old;
        const UnitState* unit = pair.unit[side];
        const LockedPair* line = lines_.find(pair.id.source, pair.id.target);
        if (unit == nullptr || line == nullptr || unit->kind != UnitKind::Struct) return out;
        const Fingerprints& prints = side == Side::Source ? line->source_prints : line->target_prints;
        if (prints.written == unit->prints.written) return out;
        const NormalText before = text_behind(checked_, prints.written);
        for (const std::string_view word : before.words()) old.emplace(word);
        const Words words = unit->text.words();
        for (size_t i = 1; i + 1 < words.size(); ++i) {
            const std::string_view next = words[i + 1], last = words[i - 1];
            const bool field = next == ";" || next == "," || next == "[" || next == "=" || next == ":";
            const bool method = next == "(" && (is_word_token(last) || last == "*" || last == "&");
            if ((field || method) && is_word_token(words[i]) && !old.contains(words[i])) out.emplace(words[i]);
        }
        return out;
    }

    Proposal propose_pair(const JudgedPair& pair) {
        Proposal out;
        out.id = pair.id;
        const auto refuse = [&](std::string why) {
            out.left.push_back({std::move(why), line_of(pair, Side::Source), line_of(pair, Side::Target)});
            return out;
        };
        const LockedPair* line = lines_.find(pair.id.source, pair.id.target);
        if (is_gone(pair)) {
            const std::string why = remove_port(pair, line, out);
            if (out.state == ProposalState::Proposed) return out;
            return refuse(std::string(pair.unit.source == nullptr ? "the source" : "the port") +
                          " is gone; name the unit that stands for it in portmap.toml" +
                          (why.empty() ? why : ", or remove the other: " + why));
        }
        if (line == nullptr) return refuse("this pair was never recorded as in step, so no edit of it is known");
        const BySide<const Fingerprints*> recorded{&line->source_prints, &line->target_prints};
        BySide<NormalText> before;
        BySide<bool> edited{};
        for (const Side side : kBothSides) {
            edited[side] = is_edit(classify(*recorded[side], pair.unit[side]->prints));
            before[side] = checked_.judgement.renamed[side].updated(text_behind(checked_, recorded[side]->written));
        }
        const PairComparison found = compare(pair, *line, before, pair.unit.source->text, pair.unit.source->prints,
                                             pair.unit.target->text, pair.unit.target->prints);
        if (found.standing <= Standing::Equivalent) {
            out.state = ProposalState::Already;
            out.why.emplace_back(found.standing == Standing::InStep ? "in step"
                                 : found.standing == Standing::Idle ? "the edit changes no value"
                                                                    : "both sides changed alike");
            return out;
        }
        Side to = edited.source ? Side::Target : Side::Source;
        if (edited.source && edited.target && checked_.project.map.reference == Reference::Target) to = Side::Source;
        if (write_ == WriteSide::Source) to = Side::Source;
        if (write_ == WriteSide::Target) to = Side::Target;
        const Side from = to == Side::Target ? Side::Source : Side::Target;
        if (!edited[from]) {
            out.state = ProposalState::Already;
            out.why.emplace_back(from == Side::Source ? "the source did not change" : "the port did not change");
            return out;
        }
        if (before[from].empty())
            return refuse("the text before the edit is not in portmap.base/; restore it from git");
        if (pair.unit[from]->text.size() > kMostWords || pair.unit[to]->text.size() > kMostWords)
            return refuse("too long to be carried: more than 5000 words");
        carry_with_new_units(pair, *line, before, from, out);
        return out;
    }

    /// What came to be without a counterpart goes as well, if all that used it let it go. Why not; "" where there is
    /// nothing to say.
    std::string remove_port(const JudgedPair& pair, const LockedPair* line, Proposal& out) {
        const Side to = pair.unit.source == nullptr ? Side::Target : Side::Source;
        const bool forward = write_ != (to == Side::Target ? WriteSide::Source : WriteSide::Target);
        if (line == nullptr || pair.unit[to] == nullptr || !forward) return {};
        const Fingerprints& recorded = to == Side::Source ? line->source_prints : line->target_prints;
        if (is_edit(classify(recorded, pair.unit[to]->prints))) return "it changed itself";
        if (counterparts_[to].at(pair.id[to]) > 1) return "it stands in several pairs";
        drafts_.begin();
        std::string why = remover_.remove(pair, to, result_.proposals, new_units_);
        if (!why.empty()) return why;
        out.state = ProposalState::Proposed;
        out.is_elsewhere = to == Side::Target && target_root(checked_.project) != checked_.project.root;
        out.patch = drafts_.patch();
        out.record_patch = drafts_.record_patch();
        out.why.emplace_back("what it stood for is gone, and nothing uses it any more");
        return {};
    }

    static uint32_t line_of(const JudgedPair& pair, Side side) {
        return pair.unit[side] == nullptr ? 0 : pair.unit[side]->start_line;
    }

    PairComparison compare(const JudgedPair& pair, const LockedPair& line, const BySide<NormalText>& before,
                           const NormalText& source, const Fingerprints& source_prints, const NormalText& target,
                           const Fingerprints& target_prints) {
        const auto paired = [&](Side side, const Fingerprints& was, const Fingerprints& prints,
                                const NormalText& text) {
            const UnitState& unit = *pair.unit[side];
            return PairedUnit{unit.id, unit.kind, language_of_path(unit.file), was, prints, before[side], text};
        };
        CompareBudget budget;
        return compare_pair({paired(Side::Source, line.source_prints, source_prints, source),
                             paired(Side::Target, line.target_prints, target_prints, target)},
                            knowledge_.dialect(), budget);
    }

    /// Carries an edit, and before it the new units that it uses; those that the port does not come to use are left
    /// out.
    void carry_with_new_units(const JudgedPair& pair, const LockedPair& line, const BySide<NormalText>& before,
                              Side from, Proposal& out) {
        const Proposal blank = out;
        calls_.begin(pair, from, before[from]);
        std::set<std::string> excluded;
        constexpr int kMostRounds = 4;
        for (int round = 0; round < kMostRounds; ++round) {
            const size_t made = new_units_.count();
            drafts_.begin();
            out = blank;
            new_units_.port(text_words(pair.unit[from]->text), pair, from, excluded);
            carry(pair, line, before, from, out);
            const bool writes = out.state == ProposalState::Proposed || out.state == ProposalState::Partial;
            const std::set<std::string> unused =
                writes ? new_units_.unused(made, ported_words(pair, other_side(from))) : std::set<std::string>();
            if (writes && unused.empty()) {
                declarations_.carry(pair, from, ported_words(pair, other_side(from)));
                includes_.carry(pair, from);
                calls_.carry(pair, from, before[from]);
                if (out.state == ProposalState::Proposed) end_deferral(pair, out);
                out.is_elsewhere = from == Side::Source && target_root(checked_.project) != checked_.project.root;
                out.patch = drafts_.patch();
                out.record_patch = drafts_.record_patch();
                for (std::string& told : new_units_.told(made)) out.why.push_back(std::move(told));
                return;
            }
            drafts_.take_back();
            new_units_.take_back(made);
            if (!writes) return;
            excluded.insert(unused.begin(), unused.end());
        }
        out = blank;
        out.state = ProposalState::Refused;
        out.left.push_back({"it uses units that came without a port; port these first", line_of(pair, Side::Source),
                            line_of(pair, Side::Target)});
    }

    void end_deferral(const JudgedPair& pair, Proposal& out) {
        try {
            record_.end_deferral(pair.id);
        } catch (const CannotDo& error) {
            out.why.emplace_back(std::string("it stays deferred: ") + error.what());
        }
    }

    static std::vector<std::string> text_words(const NormalText& text) {
        std::vector<std::string> out;
        for (const std::string_view word : text.words()) out.emplace_back(word);
        return out;
    }

    /// The port's words as they have become.
    std::vector<std::string> ported_words(const JudgedPair& pair, Side to) {
        const ScannedFile* other = knowledge_.file_of(to, pair.unit[to]->file);
        if (other == nullptr) return {};
        Draft& draft = drafts_.of(to, *other);
        const Unit* port = draft.unit(pair.unit[to]->id);
        return port == nullptr ? std::vector<std::string>() : words_of_unit(draft.scanned, *port).words;
    }

    void carry(const JudgedPair& pair, const LockedPair& line, const BySide<NormalText>& before, Side from,
               Proposal& out) {
        const Side to = other_side(from);
        const auto refuse = [&](std::string why) {
            out.left.push_back({std::move(why), line_of(pair, Side::Source), line_of(pair, Side::Target)});
        };
        const ScannedFile* file = knowledge_.file_of(from, pair.unit[from]->file);
        const ScannedFile* other = knowledge_.file_of(to, pair.unit[to]->file);
        const Unit* unit = file == nullptr ? nullptr : knowledge_.unit_of(*file, pair.unit[from]->id);
        if (unit == nullptr || other == nullptr) return refuse("a whole file is not carried");
        Draft& draft = drafts_.of(to, *other);
        if (draft.is_linked)
            return refuse("its file " + std::string(kIsLinked) + "; name the file itself in portmap.toml");
        const Unit* port = draft.unit(pair.unit[to]->id);
        if (port == nullptr) return refuse("an edit before this one in the same file has hidden the port");

        const bool record = unit->kind == UnitKind::Struct;
        const UnitWords there = words_of_unit(draft.scanned, *port);
        CalledForms forms;
        forms.add(Words(there.words.begin(), there.words.end()));
        const UnitWords was = in_forms_of(forms, words_of_record(before[from])),
                        is = in_forms_of(forms, words_of_unit(*file, *unit));
        WordKeys keys(knowledge_.dialect());
        const AlignedText old_text = keys.text(was.words, record), new_text = keys.text(is.words, record),
                          port_text = keys.text(there.words, record);
        Alignment edit = align(old_text, new_text, {0.5, false});
        match_block_ends(old_text, new_text, edit);
        match_only_clauses(old_text, new_text, edit);
        const Alignment across = align(old_text, port_text, {});
        if (holds_a_part(pair, from, across))
            return refuse(
                "this is one of several ports and holds a part of it alone; whether the edit is in that part is not "
                "told");
        Examples examples;
        examples.learn(old_text, port_text, across);
        examples.learn_patterns(old_text, port_text, across);
        std::set<std::string, std::less<>> from_elsewhere = new_units_.brought();
        from_elsewhere.merge(new_members(pair, from));
        const auto& declared = declarations_.brings(pair, from);
        from_elsewhere.insert(declared.begin(), declared.end());
        std::set<std::string, std::less<>> brought = from_elsewhere, lone;
        const std::map<std::string, std::string, std::less<>> unported = new_units_.unported(from);
        for (const auto& [name, why] : unported) lone.insert(name);
        std::set<std::string> locals = declared_behind_macro(is.words);
        for (std::string& name : local_names(*file, *unit)) locals.insert(std::move(name));
        for (const std::string& name : locals)
            if (std::find(was.words.begin(), was.words.end(), name) == was.words.end()) {
                // A name that the port has for something else cannot be taken.
                if (std::find(there.words.begin(), there.words.end(), name) == there.words.end())
                    brought.insert(name);
                else
                    lone.insert(name);
            }
        for (const std::string& name : declared_twice(was.words))
            if (examples.is_said_variously(name)) lone.insert(name);
        const KnownWords& known = knowledge_.known_words(from, *file, *other);
        const UnitNames& names = knowledge_.unit_names(from);
        const LearnedBeside beside = knowledge_.learned_beside(from, file->path, other->path);
        const bool is_method = port->name.size() > port->namespace_length + leaf_of(port->name).size() + 2;
        const bool on_host = !runs_on_device(*file, *unit);
        const auto written = [&](size_t i) {
            return is.words[i] == "@" || is.is_added(i) ? is.words[i] : std::string(file->lexed.view(is.tokens[i]));
        };
        const std::set<size_t> paragraphs = paragraphs_of(*file, is);
        const EditTexts texts{
            old_text,  new_text, port_text, edit, across, knowledge_.hands_back(from), knowledge_.hands_back(to),
            paragraphs};
        Transplant found;
        // What uses a new name can only be carried with what declares it.
        std::map<size_t, std::string> first_reasons;  // later ones may only be that a name is not declared any more
        do {
            for (const LeftOver& left : found.left) first_reasons.try_emplace(left.source_word, left.message);
            found = transplant(texts, EditTranslator(examples, beside, names, lone, known, brought, on_host), written,
                               is_method);
        } while (lose_undeclared(is.words, found, from_elsewhere, brought, lone));
        for (const LeftOver& left : found.left) {
            const uint32_t here = line_at(*file, is, left.source_word),
                           else_where = line_at(draft.scanned, there, left.target_word);
            const auto reason = first_reasons.find(left.source_word);
            const std::string& message = reason == first_reasons.end() ? left.message : reason->second;
            out.left.push_back(
                {message, from == Side::Source ? here : else_where, from == Side::Source ? else_where : here});
        }
        for (const auto& [name, why] : unported)
            if (const auto call = std::find(is.words.begin(), is.words.end(), name);
                call != is.words.end() && std::count(is.words.begin(), is.words.end(), name) !=
                                              std::count(was.words.begin(), was.words.end(), name)) {
                const uint32_t call_line = line_at(*file, is, static_cast<size_t>(call - is.words.begin()));
                const uint32_t place = pair.unit[to]->start_line;
                out.left.push_back({"it uses `" + name + "`, which came without a port; port that, too" +
                                        (why.empty() ? why : ": " + why),
                                    from == Side::Source ? call_line : place,
                                    from == Side::Source ? place : call_line});
            }
        // Where more is left than carried, a part of the port would only be in the way.
        constexpr size_t kFew = 2;
        if (found.left.size() > std::max(kFew, found.size())) return;
        if (found.empty()) {
            if (!out.left.empty()) return;
            if (found.already == 0)
                return refuse(
                    "what the edit changed has no counterpart in the port's language; look whether it needs one");
            out.state = ProposalState::Already;
            out.why.emplace_back("the port has it already");
            return;
        }
        std::set<std::string> used = words_brought(found);
        for (const std::string& name : locals) used.erase(name);
        for (const std::string& word : there.words) used.erase(word);
        const UnitRaiser::Raised raised = raiser_.raise(to, draft, pair.unit[to]->id, used);
        if (!raised.failure.empty()) return refuse(raised.failure);
        if (raised.any) {
            out.left.clear();
            return carry(pair, line, before, from, out);  // in the text as it is now
        }
        declare_constants(new_text, is, constants_of(*file, *unit, *other), found);
        if (has_other_braces(found, is, new_text, there, port_text))
            found.braces = edit_of_braces(pair, from, was, old_text, is, new_text, edit);
        const std::vector<TextEdit> edits = rewrite_unit(found, {*file, is, new_text.clauses},
                                                         {draft.scanned, there, port_text.clauses}, draft.indent());
        finish(pair, line, before, to, draft, edits, out);
    }

    /// True if one side has a block in braces whose counterpart has none.
    static bool has_other_braces(const Transplant& found, const UnitWords& is, const AlignedText& now,
                                 const UnitWords& there, const AlignedText& port) {
        for (size_t c = 0; c < found.stands_for.size(); ++c) {
            const size_t other = found.stands_for[c];
            if (other != Alignment::kNone && now.clauses[c].opens && port.clauses[other].opens &&
                is.is_added(now.clauses[c].end - 1) != there.is_added(port.clauses[other].end - 1))
                return true;
        }
        return false;
    }

    /// Which blocks the edit gave braces, or took them from; none where the text before, as a file, is not known.
    BraceEdits edit_of_braces(const JudgedPair& pair, Side from, const UnitWords& was, const AlignedText& before,
                              const UnitWords& is, const AlignedText& now, const Alignment& edit) {
        const std::string* text = earlier_texts_.of(from, pair.unit[from]->file);
        if (text == nullptr) return {};
        const ScannedFile file = scan_text(pair.unit[from]->file, *text);
        const Unit* unit = unit_named(file, pair.unit[from]->id);
        if (unit == nullptr) return {};
        const UnitWords earlier = words_of_unit(file, *unit);
        // A record has no blanks in strings.
        const auto same = [](const std::string& a, const std::string& b) {
            return a == b || (a.starts_with('"') && b.starts_with('"'));
        };
        const bool is_before =
            std::equal(earlier.words.begin(), earlier.words.end(), was.words.begin(), was.words.end(), same);
        return is_before ? brace_edits(earlier, before, is, now, edit) : BraceEdits();
    }

    /// The words that come into the port, but for members.
    static std::set<std::string> words_brought(const Transplant& found) {
        std::set<std::string> out;
        const auto add = [&](const std::vector<CarriedWord>& words) {
            for (size_t i = 0; i < words.size(); ++i)
                if (i == 0 || (words[i - 1].text != "." && words[i - 1].text != "->")) out.insert(words[i].text);
        };
        for (const WordsReplaced& one : found.replaced) add(one.words);
        for (const ClausesAdded& one : found.added)
            for (const ClauseAdded& clause : one.clauses) add(clause.words);
        return out;
    }

    /// The tokens that begin a new declaration which the port's file would make a constant.
    std::vector<uint32_t> constants_of(const ScannedFile& file, const Unit& unit, const ScannedFile& other) {
        return knowledge_.makes_constants(file, other) ? constant_locals(file, unit, false) : std::vector<uint32_t>();
    }

    static void declare_constants(const AlignedText& text, const UnitWords& words, const std::vector<uint32_t>& tokens,
                                  Transplant& found) {
        for (ClausesAdded& one : found.added)
            for (ClauseAdded& clause : one.clauses) {
                const size_t first = text.clauses[clause.source].first;
                if (words.is_added(first) || clause.words.empty() || clause.words.front().text == "const") continue;
                if (std::find(tokens.begin(), tokens.end(), words.tokens[first]) != tokens.end())
                    clause.words.insert(clause.words.begin(), {"const", CarriedWord::kNoSource});
            }
    }

    /// True for one of several counterparts that has less than most of the unit.
    bool holds_a_part(const JudgedPair& pair, Side from, const Alignment& across) const {
        if (counterparts_[from].at(pair.id[from]) < 2) return false;
        const auto found = std::count_if(across.clause_of.begin(), across.clause_of.end(),
                                         [](size_t there) { return there != Alignment::kNone; });
        constexpr double kMost = 0.8;
        return static_cast<double>(found) < kMost * static_cast<double>(across.clause_of.size());
    }

    /// Names that a text declares in more than one block: which of them a word is, nothing here tells.
    static std::set<std::string> declared_twice(const std::vector<std::string>& words) {
        std::set<std::string> once, out;
        for (size_t i = 1; i + 1 < words.size(); ++i) {
            const std::string &last = words[i - 1], &next = words[i + 1];
            const bool typed = is_word_token(last) && (!word_is(last, kKeyword) || is_type_word(last));
            if (!typed || !is_word_token(words[i]) || (next != "=" && next != ";" && next != "[")) continue;
            if (!once.insert(words[i]).second) out.insert(words[i]);
        }
        return out;
    }

    /// Makes names strange that the edit declares where that was not carried. False if there is none.
    static bool lose_undeclared(const std::vector<std::string>& words, const Transplant& found,
                                const std::set<std::string, std::less<>>& from_elsewhere,
                                std::set<std::string, std::less<>>& brought, std::set<std::string, std::less<>>& lone) {
        if (found.left.empty()) return false;
        std::set<size_t> carried;
        for (const WordsReplaced& one : found.replaced)
            for (const CarriedWord& word : one.words) carried.insert(word.from);
        for (const ClausesAdded& one : found.added)
            for (const ClauseAdded& clause : one.clauses)
                for (const CarriedWord& word : clause.words) carried.insert(word.from);
        bool any = false;
        for (auto name = brought.begin(); name != brought.end();) {
            const auto first = std::find(words.begin(), words.end(), *name);
            const bool is_lost = !from_elsewhere.contains(*name) && first != words.end() &&
                                 !carried.contains(static_cast<size_t>(first - words.begin()));
            if (is_lost) lone.insert(*name);
            any |= is_lost;
            name = is_lost ? brought.erase(name) : std::next(name);
        }
        return any;
    }

    /// The words of a unit that an empty line stands before.
    static std::set<size_t> paragraphs_of(const ScannedFile& file, const UnitWords& words) {
        std::set<size_t> out;
        const LexedText& lexed = file.lexed;
        for (size_t i = 1; i < words.size(); ++i) {
            if (words.is_added(i) || words.is_added(i - 1)) continue;
            const Token &last = lexed.tokens[words.tokens[i - 1]], &token = lexed.tokens[words.tokens[i]];
            for (uint32_t line = last.line + 1; line < token.line; ++line)
                if (is_blank_line(lexed, line)) out.insert(i);
        }
        return out;
    }

    static bool is_blank_line(const LexedText& lexed, uint32_t line) {
        const size_t first = lexed.line_starts[line - 1];
        return lexed.text.find_first_not_of(" \t\r", first) == lexed.line_starts[line] - 1;
    }

    static uint32_t line_at(const ScannedFile& file, const UnitWords& words, size_t word) {
        while (word < words.size() && words.is_added(word)) ++word;
        return word < words.size() ? file.lexed.tokens[words.tokens[word]].line : 0;
    }

    /// Makes the new text, and holds it to the gate before anybody sees it.
    void finish(const JudgedPair& pair, const LockedPair& line, const BySide<NormalText>& before, Side to, Draft& draft,
                const std::vector<TextEdit>& edits, Proposal& out) {
        const auto refuse = [&](std::string why) {
            out.state = ProposalState::Refused;
            out.left.push_back({std::move(why), line_of(pair, Side::Source), line_of(pair, Side::Target)});
        };
        const Unit& port = *draft.unit(pair.unit[to]->id);
        const std::vector<std::string> old_words = words_of_unit(draft.scanned, port).words;
        const auto place = static_cast<size_t>(&port - draft.scanned.units.data());
        const std::optional<RescannedLines> alone =
            draft.has_scanned_text() ? rescan_unit(draft.scanned, place, edits) : std::nullopt;
        std::string now;
        ScannedFile whole;  // scanned anew only where the unit alone does not tell
        if (!alone) {
            std::optional<std::string> edited = edit_file(draft.bytes, draft.scanned.lexed.text, edits);
            if (!edited) return refuse("the port's line goes on behind a backslash there");
            now = std::move(*edited);
            whole = scan_text(draft.scanned.path, now);
        }
        const ScannedFile& scanned = alone ? draft.scanned : whole;
        const Unit* unit = alone ? &port : unit_named(scanned, pair.unit[to]->id);
        if (!alone && (unit == nullptr || scanned.balanced != draft.scanned.balanced ||
                       !others_stayed(draft.scanned, scanned, port)))
            return refuse("the port made of this edit could not be read back");
        leave_out_of_scope(pair, scanned, old_words, words_of_unit(scanned, *unit).words, out);
        const UnitState state = unit_state(scanned, *unit);
        const bool to_target = to == Side::Target;
        const PairComparison found = compare(pair, line, before, to_target ? pair.unit.source->text : state.text,
                                             to_target ? pair.unit.source->prints : state.prints,
                                             to_target ? state.text : pair.unit.target->text,
                                             to_target ? state.prints : pair.unit.target->prints);
        out.state = out.left.empty() ? ProposalState::Proposed : ProposalState::Partial;
        if (out.left.empty() && found.standing > Standing::Equivalent) {
            out.state = ProposalState::Partial;
            out.left.push_back({"check would still ask about it: " + reason(found), line_of(pair, Side::Source),
                                line_of(pair, Side::Target)});
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

    /// Names that the port would use where neither it nor its file declares them any more.
    static void leave_out_of_scope(const JudgedPair& pair, const ScannedFile& file, const std::vector<std::string>& was,
                                   const std::vector<std::string>& is, Proposal& out) {
        const auto is_of_file = [&](const std::string& name) {
            return std::any_of(file.units.begin(), file.units.end(),
                               [&](const Unit& unit) { return leaf_of(unit.name) == name; }) ||
                   std::any_of(file.variables.begin(), file.variables.end(), [&](const FileVariable& variable) {
                       return file.lexed.view(variable.name_token) == name;
                   });
        };
        std::set<std::string> lost = lost_names(was, is);
        std::erase_if(lost, is_of_file);
        for (const std::string& name : lost)
            out.left.push_back({"the port would use `" + name + "` where it does not declare it",
                                line_of(pair, Side::Source), line_of(pair, Side::Target)});
    }

    /// True if all units but one are as they were.
    static bool others_stayed(const ScannedFile& before, const ScannedFile& now, const Unit& edited_before) {
        std::map<std::string_view, std::string_view> texts;
        const auto text_of = [](const ScannedFile& file, const Unit& unit) {
            const Token &first = file.lexed.tokens[unit.tokens.first], &last = file.lexed.tokens[unit.tokens.end - 1];
            return std::string_view(file.lexed.text).substr(first.offset, last.offset + last.length - first.offset);
        };
        for (const Unit& unit : now.units) texts[unit.name] = text_of(now, unit);
        return std::all_of(before.units.begin(), before.units.end(), [&](const Unit& unit) {
            // What holds the edited unit, as its class, changed with it.
            if (unit.tokens.first <= edited_before.tokens.first && edited_before.tokens.end <= unit.tokens.end)
                return true;
            const auto found = texts.find(unit.name);
            return found != texts.end() && found->second == text_of(before, unit);
        });
    }

    static std::string reason(const PairComparison& found) {
        if (!found.missing.empty()) return found.missing.front();
        if (!found.values.empty()) return found.values;
        return found.not_compared.empty() ? "the two edits are not the same" : found.not_compared;
    }

    const CheckedProject& checked_;
    WriteSide write_;
    LinesByPair lines_;
    std::set<std::string, std::less<>> brought_;
    const EarlierFiles& earlier_;
    Knowledge& knowledge_;
    Drafts drafts_;
    RecordDraft record_;
    NewUnits new_units_;
    UnitRemover remover_;
    UnitRaiser raiser_;
    EarlierTexts earlier_texts_;
    IncludeCarrier includes_;
    DeclarationCarrier declarations_;
    CallCarrier calls_;
    BySide<std::unordered_map<std::string_view, size_t>> counterparts_;  ///< how many, by id
    SyncResult result_;
};

}  // namespace

std::string whole_patch(const Proposal& proposal) {
    return proposal.is_elsewhere ? proposal.patch : proposal.patch + proposal.record_patch;
}

std::string map_patch(const Proposal& proposal) {
    return proposal.is_elsewhere ? proposal.record_patch : std::string();
}

bool SyncResult::any_left() const {
    return std::any_of(proposals.begin(), proposals.end(), [](const Proposal& p) {
        return p.state == ProposalState::Partial || p.state == ProposalState::Refused;
    });
}

namespace {

/// Proposes, and again where a struct turns out to get no port: what uses its new fields then has none either.
SyncResult propose_all(const CheckedProject& checked, const std::vector<size_t>& pairs, WriteSide write,
                       const Disk& disk, const EarlierFiles& earlier, Knowledge& knowledge) {
    std::set<size_t> kept_back;
    constexpr int kMostRounds = 4;  // then no struct is counted on
    for (int round = 0;; ++round) {
        SyncResult out = Proposer(checked, write, disk, earlier, knowledge).run(pairs, kept_back);
        const size_t known = kept_back.size();
        for (size_t i = 0; i < pairs.size(); ++i) {
            const JudgedPair& pair = checked.judgement.pairs[pairs[i]];
            const bool is_whole =
                out.proposals[i].state == ProposalState::Proposed || out.proposals[i].state == ProposalState::Already;
            const UnitState* unit = pair.unit.source != nullptr ? pair.unit.source : pair.unit.target;
            const bool is_last = round == kMostRounds;
            if ((!is_whole || is_last) && unit != nullptr && unit->kind == UnitKind::Struct) kept_back.insert(pairs[i]);
        }
        if (kept_back.size() == known) return out;
    }
}

}  // namespace

SyncResult propose(const CheckedProject& checked, const std::vector<size_t>& pairs, WriteSide write, const Disk& disk,
                   const std::string& commit) {
    std::vector<size_t> whole = pairs;
    // Whether anything still uses what is to go shows once all else is done.
    std::stable_partition(whole.begin(), whole.end(), [&](size_t i) { return !is_gone(checked.judgement.pairs[i]); });
    const EarlierFiles earlier(checked, commit);
    Knowledge knowledge(checked);  // what the texts tell is the same in each round
    SyncResult out = propose_all(checked, whole, write, disk, earlier, knowledge);
    SyncResult last = out;
    // What leans on a partial proposal may be none without it.
    for (;;) {
        std::vector<size_t> next;
        for (size_t i = 0; i < whole.size(); ++i)
            if (last.proposals[i].state != ProposalState::Partial) next.push_back(whole[i]);
        if (next.size() == whole.size()) break;
        whole = std::move(next);
        last = propose_all(checked, whole, write, disk, earlier, knowledge);
    }
    out.files = std::move(last.files_with_partial);
    return out;
}

}  // namespace porttool
