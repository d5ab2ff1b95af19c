// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/audit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "porttool/audit/certainty.h"
#include "porttool/audit/essence.h"
#include "porttool/audit/likely_partners.h"
#include "porttool/audit/lone_items.h"
#include "porttool/audit/past_walk.h"
#include "porttool/audit/port_patch.h"
#include "porttool/audit/stray_edits.h"
#include "porttool/audit/todays_pairs.h"
#include "porttool/compare/paired_names.h"
#include "porttool/snapshot/past.h"
#include "porttool/text/date.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// Where the walk ends.
struct Since {
    std::string hidden;
    int64_t time = 0;
};

Since since_of(const Past& past, const std::string& text) {
    if (text.empty()) return {};
    if (!has_form_of_date(text)) return {find_commit(past, "--since", text).id, 0};
    const auto days = days_between("1970-01-01", text);
    if (!days) throw CannotDo("--since: " + text + " is no day of the calendar");
    return {"", int64_t{86400} * *days};
}

void add_words(const ScannedFile& file, const Dialect& dialect, WordsOfSide& out) {
    std::unordered_set<std::string_view> written;
    for (const Token& token : file.lexed.tokens)
        if (token.kind == TokenKind::Identifier) written.insert(file.lexed.view(token));
    for (const std::string_view word : written) out.insert(plain_word(std::string(word), dialect));
}

UsesOnSide uses_on(const std::vector<ScannedFile>& files, const Dialect& dialect) {
    UsesOnSide out;
    for (const ScannedFile& file : files) {
        WordsOfSide words;
        add_words(file, dialect, words);
        for (const std::string& word : words) ++out[word];
    }
    return out;
}

/// The statements of whole files in the common vocabulary, each file read when it is asked for.
class FileStatements {
public:
    FileStatements(const Project& project, const Dialect& dialect) : dialect_(dialect) {
        for (const auto* files : {&project.source, &project.target})
            for (const ScannedFile& file : *files) files_.emplace(file.path, &file);
    }

    const std::set<std::string>* of(const std::string& path) {
        const auto known = known_.find(path);
        if (known != known_.end()) return &known->second;
        const auto file = files_.find(path);
        if (file == files_.end()) return nullptr;
        std::set<std::string>& out = known_[path];
        for (const Unit& unit : file->second->units) {
            const NormalText text = normal_form(*file->second, unit);
            for (const WrittenStatement& one : written_statements(text.words()))
                out.insert(statement_key(one, dialect_));
        }
        return &out;
    }

    /// The same as essence_of() has them, each once.
    const std::vector<std::vector<std::string>>* essences_of(const std::string& path) {
        const std::set<std::string>* keys = of(path);
        if (keys == nullptr) return nullptr;
        const auto [known, is_new] = essences_.try_emplace(path);
        if (!is_new) return &known->second;
        std::set<std::vector<std::string>> out;
        for (const std::string& key : *keys) out.insert(essence_of(words_of_key(key), dialect_));
        known->second.assign(out.begin(), out.end());
        return &known->second;
    }

    const WordsOfSide* words_of(const std::string& path) {
        const auto known = words_.find(path);
        if (known != words_.end()) return &known->second;
        WordsOfSide& out = words_[path];
        if (const auto file = files_.find(path); file != files_.end()) add_words(*file->second, dialect_, out);
        return &out;
    }

private:
    static std::vector<std::string> words_of_key(const std::string& key) {
        std::vector<std::string> out;
        for (size_t at = 0; at < key.size();) {
            const size_t end = std::min(key.find(' ', at), key.size());
            out.push_back(key.substr(at, end - at));
            at = end + 1;
        }
        return out;
    }

    const Dialect& dialect_;
    std::map<std::string, std::vector<std::vector<std::string>>> essences_;
    std::map<std::string, WordsOfSide> words_;
    std::map<std::string, const ScannedFile*> files_;
    std::map<std::string, std::set<std::string>> known_;
};

class Auditor {
public:
    Auditor(const AuditChoice& choice, Workplace& place)
        : choice_(choice), place_(place), today_(todays_pairs(choice, place)) {}

    Audit run() {
        GitRepository git(today_.snapshot.project.root);
        if (!git.error().empty()) throw CannotDo(git.error());
        const auto head = git.commit("HEAD");
        if (!head) throw CannotDo("HEAD names no commit yet; commit once, then there is a history");
        Past past;
        past.root = today_.snapshot.project.root;
        past.git = std::make_unique<GitRepository>(past.root);
        const Since since = since_of(past, choice_.since);
        const Dialect dialect = dialect_of_edits(today_.snapshot.project.map);
        Lineages lineages = followed();
        const WalkedPast walked = walk_past(past.root, head->id, since.hidden, since.time, dialect, lineages);
        Audit out;
        out.pairs = today_.pairs.size();
        out.commits = walked.steps.size();
        out.shallow = walked.cut;
        out.squashed = walked.steps.size() == 1 && walked.steps.front().parents == 0;
        out.unedited =
            std::all_of(lineages.begin(), lineages.end(), [](const auto& one) { return one.second.edits().empty(); });
        std::vector<FoundEdit> found = read_pairs(lineages, dialect);
        const Habits habits = habits_of(found, differing_, today_.pairs.size());
        out.items = ranked(std::move(found), walked, today_, habits, alike_);
        if (choice_.since.empty()) add_todays(items_of_today(differing_, today_, habits), out.items);
        if (choice_.since.empty())
            for (AuditItem& item : items_of_lone_texts(lineages, today_)) out.items.push_back(std::move(item));
        std::stable_sort(out.items.begin(), out.items.end(),
                         [](const AuditItem& a, const AuditItem& b) { return a.certainty > b.certainty; });
        out.found = out.items.size();
        if (choice_.limit <= kFew && out.pairs > kFewPairs) drop_unlikely(out.items);
        const size_t before = out.items.size();
        add_patches(out.items);
        out.found -= before - out.items.size();  // what needs no port is no item
        if (out.items.size() > choice_.limit) out.items.resize(choice_.limit);
        if (choice_.runs) add_witnesses(out.items);
        return out;
    }

private:
    /// Of a place of which both a commit and today's texts tell the surer item stays, as long as it is shown.
    static void add_todays(std::vector<AuditItem> todays, std::vector<AuditItem>& items) {
        std::map<std::pair<std::string, std::string>, std::vector<size_t>> of_pair;
        for (size_t i = 0; i < items.size(); ++i) of_pair[{items[i].id.source, items[i].id.target}].push_back(i);
        std::set<size_t> dropped;
        for (AuditItem& item : todays) {
            const MissingPlace& place = item.places.front();
            const std::string said = place.now.empty() ? place.there : place.now;
            const auto tells = [&](const MissingPlace& one) { return one.now == said || one.there == said; };
            bool stays = true;
            const auto pair = of_pair.find({item.id.source, item.id.target});
            for (const size_t i : pair == of_pair.end() ? std::vector<size_t>() : pair->second) {
                AuditItem& past = items[i];
                if (std::none_of(past.places.begin(), past.places.end(), tells)) continue;
                if (past.certainty >= kLikelyItem || past.certainty >= item.certainty) {
                    stays = false;
                    break;
                }
                item.why.push_back("its place was edited in " + past.commit->id.substr(0, kShownId));
                if (std::all_of(past.places.begin(), past.places.end(), tells)) dropped.insert(i);
            }
            if (stays) items.push_back(std::move(item));
        }
        size_t at = 0;
        std::erase_if(items, [&](const AuditItem&) { return dropped.contains(at++); });
    }

    /// What no commit tells of stays where there is nothing else.
    static void drop_unlikely(std::vector<AuditItem>& items) {
        const bool any = std::any_of(items.begin(), items.end(), [](const AuditItem& one) { return one.commit; });
        if (any)
            std::erase_if(
                items, [](const AuditItem& one) { return one.certainty < (one.commit ? kLikelyItem : kLikelyToday); });
    }

    /// Of as many items as are shown; those that need no port, as `sync` says, go.
    void add_patches(std::vector<AuditItem>& items) {
        PortPatches& patches = patches_.emplace(today_, place_.disk);
        size_t kept = 0;
        for (size_t i = 0; i < items.size(); ++i) {
            const bool shown = kept < std::min(choice_.limit, kMostPatches);
            if (shown && !patches.add_to(items[i])) continue;
            if (kept != i) items[kept] = std::move(items[i]);
            ++kept;
        }
        items.resize(kept);
    }

    /// Runs both sides of each item's pair. An input on which they differ makes an item more certain; that none was
    /// found, less.
    void add_witnesses(std::vector<AuditItem>& items) {
        std::vector<PairIds> all, asked;
        for (const TodaysPair& pair : today_.pairs) all.emplace_back(pair.id.source, pair.id.target);
        for (const AuditItem& item : items) {
            const PairIds pair{item.id.source, item.id.target};
            if (pair.first.empty() || pair.second.empty()) continue;  // one text alone tells of it
            const UnitKind kind = patches_->states().source.at(pair.first).kind;
            if ((kind == UnitKind::Function || kind == UnitKind::Kernel) &&
                std::find(asked.begin(), asked.end(), pair) == asked.end())
                asked.push_back(pair);
        }
        if (asked.empty()) return;
        DifftestSettings settings;
        settings.defines = patches_->project().map.defines;
        const DifftestResult result = difftest(patches_->project(), all, asked, settings, place_.disk);
        for (const std::string& file : result.unread)
            place_.err << "warning: " << terminal_text(file) << "; what a build defines there is not known\n";
        for (AuditItem& item : items)
            for (const DifftestPair& ran : result.pairs)
                if (ran.source == item.id.source && ran.target == item.id.target) take_witness(ran, item);
        std::stable_sort(items.begin(), items.end(),
                         [](const AuditItem& a, const AuditItem& b) { return a.certainty > b.certainty; });
    }

    Lineages followed() const {
        Lineages out;
        for (const TodaysPair& pair : today_.pairs)
            for (const Side side : kBothSides) {
                const UnitState& unit = today_.unit(pair, side);
                if (!out.contains(unit.id)) out.emplace(unit.id, UnitLineage(written_statements(unit.text.words())));
            }
        for (const Side side : kBothSides)
            for (const auto& [id, unit] : today_.snapshot.states[side])
                if ((unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel) && !out.contains(id))
                    out.emplace(id, UnitLineage(written_statements(unit.text.words()), false));
        return out;
    }

    std::vector<FoundEdit> read_pairs(const Lineages& lineages, const Dialect& dialect) {
        FileStatements statements(today_.snapshot.project, dialect);
        const Project& project = today_.snapshot.project;
        const States& states = today_.snapshot.states;
        const BySide<FunctionsOfSide> functions{FunctionsOfSide(states.source, dialect),
                                                FunctionsOfSide(states.target, dialect)};
        const BySide<UsesOnSide> words{uses_on(project.source, dialect), uses_on(project.target, dialect)};
        std::map<std::string, std::set<uint32_t>> file_edits;  // the commits that edited each file's units
        for (const auto& [id, lineage] : lineages)
            for (const auto& [commit, places] : lineage.edits()) file_edits[split_id(id).first].insert(commit);
        std::vector<FoundEdit> out;
        const auto sides_of = [&](const BySide<std::string>& id) {
            BySide<SideOfPair> pair;
            for (const Side side : kBothSides) {
                const UnitState& unit = states[side].at(id[side]);
                pair[side] = {&unit,
                              &lineages.at(unit.id),
                              statements.of(unit.file),
                              statements.essences_of(unit.file),
                              statements.words_of(unit.file),
                              &words[side],
                              &functions[side]};
            }
            return pair;
        };
        for (size_t i = 0; i < today_.pairs.size(); ++i) {
            PairReading reading = read_pair(sides_of(today_.pairs[i].id), dialect);
            alike_.push_back(reading.alike);
            if (!reading.differs.empty()) differing_.push_back({i, reading.alike, std::move(reading.differs)});
            for (MissingPlace& slip : reading.slips) differing_.push_back({i, reading.alike, {std::move(slip)}, true});
            for (MissingEdit& edit : reading.missing) {
                const auto there = file_edits.find(today_.unit(today_.pairs[i], other(edit.side)).file);
                const bool both = there != file_edits.end() && there->second.contains(edit.commit);
                out.push_back({i, reading.alike, std::move(edit), both});
            }
        }
        add_strays(lineages, words, dialect, out);
        add_partners([&](const BySide<std::string>& id) { return read_slips(sides_of(id), dialect); });
        return out;
    }

    /// What looks like a slip between a function without a pair and the one that most likely holds its other text.
    template <class Read>
    void add_partners(const Read& read) {
        constexpr double kScore = 0.85;
        BySide<std::set<std::string>> paired;
        for (const TodaysPair& pair : today_.pairs)
            for (const Side side : kBothSides)
                if (!pair.stray) paired[side].insert(pair.id[side]);
        for (const BySide<std::string>& id : likely_partners(today_.snapshot.states, paired)) {
            PairReading reading = read(id);
            // What one of them has alone another function may say.
            std::erase_if(reading.slips, [](const MissingPlace& one) { return one.now.empty() || one.there.empty(); });
            if (reading.slips.empty()) continue;
            today_.pairs.push_back({id, kScore, false, true});
            alike_.push_back(reading.alike);
            for (MissingPlace& slip : reading.slips)
                differing_.push_back({today_.pairs.size() - 1, reading.alike, {std::move(slip)}, true});
        }
    }

    /// Each makes a pair of its own, of which little is known.
    void add_strays(const Lineages& lineages, const BySide<UsesOnSide>& words, const Dialect& dialect,
                    std::vector<FoundEdit>& out) {
        constexpr double kScore = 0.6;
        std::set<std::pair<std::string, std::string>> paired;
        for (const TodaysPair& pair : today_.pairs) paired.emplace(pair.id.source, pair.id.target);
        std::map<std::pair<std::string, std::string>, size_t> added;
        for (StrayEdit& stray : stray_edits(today_.snapshot, lineages, words, paired, dialect)) {
            const States& states = today_.snapshot.states;
            if (one_calls_the_other(states.source.at(stray.id.source), states.target.at(stray.id.target))) continue;
            const auto [known, is_new] = added.try_emplace({stray.id.source, stray.id.target}, today_.pairs.size());
            if (is_new) {
                today_.pairs.push_back({stray.id, kScore, false, true});
                alike_.push_back(stray.alike);
            }
            out.push_back({known->second, stray.alike, std::move(stray.edit), false});
        }
    }

    static constexpr size_t kShownId = 10;        ///< digits of a commit
    static constexpr size_t kFew = 20;            ///< whoever asks for no more than that wants what is likely
    static constexpr size_t kFewPairs = 20;       ///< whoever looks at so few looks at all that there is
    static constexpr double kLikelyToday = 0.29;  ///< the same for what no commit tells of: twins, but for one place
    static constexpr size_t kMostPatches = 100;   ///< beyond, nobody reads them, and each takes a while

    const AuditChoice& choice_;
    Workplace& place_;
    TodaysPairs today_;
    std::vector<DifferingPair> differing_;
    std::vector<float> alike_;  ///< of each pair
    std::optional<PortPatches> patches_;
};

}  // namespace

Audit audit(const AuditChoice& choice, Workplace& place) { return Auditor(choice, place).run(); }

}  // namespace porttool
