// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/propose.h"

#include <algorithm>
#include <iterator>

#include "porttool/compare/compare_pair.h"
#include "porttool/judge/settle.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/unit_state.h"
#include "porttool/read/lock_lines.h"
#include "porttool/read/map_file.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/call_carrier.h"
#include "porttool/sync/carried_names.h"
#include "porttool/sync/declaration_carrier.h"
#include "porttool/sync/include_carrier.h"
#include "porttool/sync/knowledge.h"
#include "porttool/sync/name_follower.h"
#include "porttool/sync/new_units.h"
#include "porttool/sync/pair_carrier.h"
#include "porttool/sync/port_gate.h"
#include "porttool/sync/unit_raiser.h"
#include "porttool/sync/unit_remover.h"

namespace porttool {
namespace {

constexpr size_t kMostWords = 5000;  ///< of a unit; a longer one is a person's

/// What one run goes through: a proposal has the files of its pair read anew, whatever else in them is edited as well,
/// so that very many edits of one large file take time in the square of its length.
struct RunBudget {
    static constexpr uint64_t kMostBytes = uint64_t{512} << 20;
    uint64_t bytes = 0;
    bool is_spent() const { return bytes > kMostBytes; }
};

bool is_gone(const JudgedPair& pair) { return pair.unit.source == nullptr || pair.unit.target == nullptr; }

std::vector<std::string> all_words(const NormalText& text) {
    std::vector<std::string> out;
    for (const std::string_view word : text.words()) out.emplace_back(word);
    return out;
}

/// True if the other side has all names that an edit gave up: it called its locals so too.
bool has_lost_names(const NormalText& before, const NormalText& now, const NormalText& other) {
    const Words kept = now.words(), there = other.words(), words = before.words();
    const auto is_in = [](const Words& list, std::string_view word) {
        return std::find(list.begin(), list.end(), word) != list.end();
    };
    return std::all_of(words.begin(), words.end(), [&](std::string_view word) {
        return !is_word_token(word) || is_in(kept, word) || is_in(there, word);
    });
}

/// Behind which words of another text stand the most that stand before `at`: of as many the first.
size_t place_behind(const std::vector<std::string>& words, size_t at, const std::vector<std::string>& there) {
    constexpr size_t kMost = 64;
    size_t best = 0, longest = 0;
    for (size_t i = 0; i < there.size(); ++i) {
        size_t same = 0;
        while (same < std::min({kMost, at, i}) && there[i - 1 - same] == words[at - 1 - same]) ++same;
        if (same > longest) longest = same, best = i;
    }
    return best;
}

class Proposer {
public:
    Proposer(const CheckedProject& checked, WriteSide write, const Disk& disk, const EarlierFiles& earlier,
             Knowledge& knowledge, RunBudget& budget)
        : checked_(checked),
          write_(write),
          lines_(checked.lock),
          earlier_(earlier),
          knowledge_(knowledge),
          budget_(budget),
          drafts_(checked, disk),
          record_(checked, disk, drafts_),
          new_units_(checked, earlier_, knowledge_, drafts_, record_, brought_),
          remover_(checked, knowledge_, drafts_, record_),
          raiser_(checked, knowledge_, drafts_),
          earlier_texts_(earlier_),
          includes_(checked, earlier_texts_, knowledge_, drafts_),
          declarations_(earlier_texts_, knowledge_, drafts_),
          calls_(checked, knowledge_, drafts_),
          follower_(checked, knowledge_, drafts_),
          carrier_(knowledge_, drafts_, new_units_, raiser_, earlier_texts_, declarations_, lines_, checked, counts_) {
        for (const JudgedPair& pair : checked.judgement.pairs)
            for (const Side side : kBothSides) ++counts_[side][pair.id[side]];
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
        follower_.run(result_.proposals);
        result_.valueless = calls_.valueless();
        result_.files_with_partial = drafts_.files();
        return std::move(result_);
    }

private:
    /// Names that an edit brings in: what other edits of the same run may use.
    void note_brought(const JudgedPair& pair) {
        for (const Side side : kBothSides) brought_.merge(new_members(checked_, lines_, pair, side));
    }

    Proposal propose_pair(const JudgedPair& pair) {
        Proposal out;
        out.id = pair.id;
        const auto refuse = [&](std::string why) {
            out.left.push_back({std::move(why), first_line(pair, Side::Source), first_line(pair, Side::Target)});
            return out;
        };
        if (budget_.is_spent())
            return refuse("more edits of large files than one run looks at; apply what is proposed, or name this pair");
        const LockedPair* line = lines_.find(pair.id.source, pair.id.target);
        if (const std::string why = why_unread(pair); !why.empty()) return refuse(why);
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
        BySide<bool> edited{}, touched{};
        for (const Side side : kBothSides) {
            const Change change = classify(*recorded[side], pair.unit[side]->prints);
            edited[side] = is_edit(change);
            touched[side] = change != Change::None;
            before[side] = checked_.judgement.renamed[side].updated(text_behind(checked_, recorded[side]->written));
        }
        const PairComparison found =
            compare_now(pair, *line, before, pair.unit.source->text, pair.unit.source->prints, pair.unit.target->text,
                        pair.unit.target->prints, knowledge_.dialect());
        const auto none_is_due = [&] {
            out.state = ProposalState::Already;
            out.why.emplace_back(found.standing == Standing::InStep ? "in step"
                                 : found.standing == Standing::Idle ? "the edit changes no value"
                                                                    : "both sides changed alike");
            return out;
        };
        const Side changed = touched.source ? Side::Source : Side::Target;
        // A port of several originals has nothing to follow that changes none of its values.
        const Side port = other_side(changed);
        const bool may_follow = found.standing <= Standing::Idle && touched.source != touched.target &&
                                counts_[port].at(pair.id[port]) == 1 &&
                                (found.standing != Standing::InStep ||
                                 has_lost_names(before[changed], pair.unit[changed]->text, pair.unit[port]->text));
        if (may_follow) edited[changed] = true;
        if (found.standing <= Standing::Equivalent && !may_follow) return none_is_due();
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
            return refuse_at_edit(pair, before[from], from, "too long to be carried: more than 5000 words", out);
        const Proposal blank = out;
        for (const Side side : kBothSides)
            if (const ScannedFile* file = knowledge_.file_of(side, pair.unit[side]->file); file != nullptr)
                budget_.bytes += file->lexed.text.size();
        carry_with_new_units(pair, *line, before, from, out);
        if (!may_follow || out.state == ProposalState::Proposed) return out;
        drafts_.take_back();  // a port that is spelled otherwise anyway
        out = blank;
        follower_.note(pair, from);
        return none_is_due();
    }

    /// Left where the edit begins, and where the other side says most of what stands before that.
    Proposal refuse_at_edit(const JudgedPair& pair, const NormalText& before, Side from, std::string why,
                            Proposal& out) {
        LeftItem item{std::move(why), first_line(pair, Side::Source), first_line(pair, Side::Target)};
        const Side to = other_side(from);
        const auto texts = [&](Side side) -> std::pair<const ScannedFile*, const Unit*> {
            const ScannedFile* file = knowledge_.file_of(side, pair.unit[side]->file);
            return {file, file == nullptr ? nullptr : knowledge_.unit_of(*file, pair.unit[side]->id)};
        };
        const auto [file, unit] = texts(from);
        const auto [other, port] = texts(to);
        if (unit != nullptr && port != nullptr) {
            const UnitWords was = words_of_record(before), is = words_of_unit(*file, *unit),
                            there = words_of_unit(*other, *port);
            const auto begins = static_cast<size_t>(
                std::mismatch(is.words.begin(), is.words.end(), was.words.begin(), was.words.end()).first -
                is.words.begin());
            if (begins < is.words.size()) {
                (from == Side::Source ? item.source_line : item.target_line) = line_at(*file, is, begins);
                (from == Side::Source ? item.target_line : item.source_line) =
                    line_at(*other, there, place_behind(is.words, begins, there.words));
            }
        }
        out.left.push_back(std::move(item));
        return out;
    }

    /// Why a unit that was not found may stand where it stood: its file could not be read. "" for none.
    std::string why_unread(const JudgedPair& pair) const {
        const BySide<std::string> path{pair.id.source, target_path(checked_.project.map, pair.id.target)};
        for (const Side side : kBothSides)
            for (const SkippedFile& file : checked_.project.skipped)
                if (pair.unit[side] == nullptr && file.file == split_id(path[side]).first)
                    return std::string("the file of the ") + (side == Side::Source ? "source " : "port ") +
                           file.reason + "; make it readable";
        return {};
    }

    /// What came to be without a counterpart goes as well, if all that used it let it go. Why not; "" where there is
    /// nothing to say.
    std::string remove_port(const JudgedPair& pair, const LockedPair* line, Proposal& out) {
        const Side to = pair.unit.source == nullptr ? Side::Target : Side::Source;
        const bool forward = write_ != (to == Side::Target ? WriteSide::Source : WriteSide::Target);
        if (line == nullptr || pair.unit[to] == nullptr || !forward) return {};
        const Fingerprints& recorded = to == Side::Source ? line->source_prints : line->target_prints;
        if (is_edit(classify(recorded, pair.unit[to]->prints))) return "it changed itself";
        if (counts_[to].at(pair.id[to]) > 1) return "it stands in several pairs";
        if (!checked_.project.skipped.empty())
            return "`" + checked_.project.skipped.front().file + "` could not be read and may use it";
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
            new_units_.port(all_words(pair.unit[from]->text), pair, from, excluded);
            carrier_.carry({pair, line, before, from}, out);
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
        out.left.push_back({"it uses units that came without a port; port these first", first_line(pair, Side::Source),
                            first_line(pair, Side::Target)});
    }

    void end_deferral(const JudgedPair& pair, Proposal& out) {
        try {
            record_.end_deferral(pair.id);
        } catch (const CannotDo& error) {
            out.why.emplace_back(std::string("it stays deferred: ") + error.what());
        }
    }

    /// The port's words as they have become.
    std::vector<std::string> ported_words(const JudgedPair& pair, Side to) {
        const ScannedFile* other = knowledge_.file_of(to, pair.unit[to]->file);
        if (other == nullptr) return {};
        Draft& draft = drafts_.of(to, *other);
        const Unit* port = draft.unit(pair.unit[to]->id);
        return port == nullptr ? std::vector<std::string>() : words_of_unit(draft.scanned, *port).words;
    }

    const CheckedProject& checked_;
    WriteSide write_;
    LinesByPair lines_;
    std::set<std::string, std::less<>> brought_;
    const EarlierFiles& earlier_;
    Knowledge& knowledge_;
    RunBudget& budget_;
    Drafts drafts_;
    RecordDraft record_;
    NewUnits new_units_;
    UnitRemover remover_;
    UnitRaiser raiser_;
    EarlierTexts earlier_texts_;
    IncludeCarrier includes_;
    DeclarationCarrier declarations_;
    CallCarrier calls_;
    NameFollower follower_;
    PairCounts counts_;
    PairCarrier carrier_;
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

/// Proposes, and again where a struct turns out to get no port, or a function that comes to give a value back: what
/// uses its new fields, or that value, then has none either.
SyncResult propose_all(const CheckedProject& checked, const std::vector<size_t>& pairs, WriteSide write,
                       const Disk& disk, const EarlierFiles& earlier, Knowledge& knowledge, RunBudget& budget) {
    std::set<size_t> kept_back;
    constexpr int kMostRounds = 4;  // then no struct is counted on
    for (int round = 0;; ++round) {
        SyncResult out = Proposer(checked, write, disk, earlier, knowledge, budget).run(pairs, kept_back);
        const size_t known = kept_back.size();
        for (size_t i = 0; i < pairs.size(); ++i) {
            const JudgedPair& pair = checked.judgement.pairs[pairs[i]];
            const bool is_whole =
                out.proposals[i].state == ProposalState::Proposed || out.proposals[i].state == ProposalState::Already;
            const UnitState* unit = pair.unit.source != nullptr ? pair.unit.source : pair.unit.target;
            const bool is_last = round == kMostRounds;
            if ((!is_whole || is_last) && unit != nullptr && has_members(*unit)) kept_back.insert(pairs[i]);
        }
        const bool any_valueless = knowledge.add_valueless(out.valueless);
        if (kept_back.size() == known && !any_valueless) return out;
    }
}

/// Of what is left a person has to do what is sure; of the rest the first where there is nothing else.
void set_apart_unsure(Proposal& proposal) {
    const auto unsure = std::stable_partition(proposal.left.begin(), proposal.left.end(),
                                              [](const LeftItem& item) { return item.is_sure; });
    const auto first = unsure == proposal.left.begin() && unsure != proposal.left.end() ? unsure + 1 : unsure;
    proposal.perhaps.assign(std::make_move_iterator(first), std::make_move_iterator(proposal.left.end()));
    proposal.left.erase(first, proposal.left.end());
}

}  // namespace

SyncResult propose(const CheckedProject& checked, const std::vector<size_t>& pairs, WriteSide write, const Disk& disk,
                   const std::string& commit) {
    std::vector<size_t> whole = pairs;
    // Whether anything still uses what is to go shows once all else is done.
    std::stable_partition(whole.begin(), whole.end(), [&](size_t i) { return !is_gone(checked.judgement.pairs[i]); });
    const EarlierFiles earlier(checked, commit);
    Knowledge knowledge(checked);  // what the texts tell is the same in each round
    RunBudget budget;
    SyncResult out = propose_all(checked, whole, write, disk, earlier, knowledge, budget);
    SyncResult last = out;
    // What leans on a partial proposal may be none without it.
    for (;;) {
        std::vector<size_t> next;
        for (size_t i = 0; i < whole.size(); ++i)
            if (last.proposals[i].state != ProposalState::Partial) next.push_back(whole[i]);
        if (next.size() == whole.size()) break;
        whole = std::move(next);
        last = propose_all(checked, whole, write, disk, earlier, knowledge, budget);
    }
    out.files = std::move(last.files_with_partial);
    for (Proposal& one : out.proposals) set_apart_unsure(one);
    std::stable_partition(out.proposals.begin(), out.proposals.end(),
                          [](const Proposal& one) { return !one.comes_last; });
    return out;
}

}  // namespace porttool
