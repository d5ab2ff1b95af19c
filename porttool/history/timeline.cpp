// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/timeline.h"

#include <algorithm>
#include <deque>
#include <future>
#include <set>

#include "porttool/history/block_replay.h"
#include "porttool/history/churn.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/lock_upgrade.h"
#include "porttool/scan/scan.h"
#include "porttool/text/date.h"

namespace porttool {
namespace {

using Paths = std::set<std::string>;

struct PairPlan {
    PairId id;
    std::string source_path, target_path;
};

class Timeline {
public:
    Timeline(const Past& past, BlobCache& cache, Workplace& place)
        : past_(past),
          place_(place),
          blobs_(past, cache),
          drift_([this](const PairId& id, const BySide<Fingerprints>& before, const BySide<const UnitFacts*>& now) {
              return blobs_.edits(
                  {{id.first, before.source, *now.source}, {id.second, before.target, *now.target}},
                  [this](Print print) {
                      const auto renewed = renewed_.find(print);
                      return renewed != renewed_.end() ? renewed->second : blob_at("portmap.base/" + print.text());
                  },
                  budget_);
          }),
          blocks_(blobs_, cache, map_, files_) {
        if (past.has_map_today) use_map(past.map_today, past.map_name);
    }

    /// Takes in a commit; true if it touched anything that matters here.
    bool step(const GitCommit& commit, const std::vector<GitChange>& changes) {
        Paths touched;
        bool files_came_or_went = false;
        for (const GitChange& change : changes) {
            files_came_or_went |= change.blob.empty() || !tree_.contains(change.path);
            if (change.blob.empty())
                tree_.erase(change.path);
            else
                tree_[change.path] = change.blob;
            if (side_of(change.path)) touched.insert(change.path);
        }
        const bool new_map = read_map_of(commit);
        const bool new_lock = read_lock_now();
        if (!has_map_ || (!new_map && !new_lock && touched.empty())) return false;
        if (new_map) {
            collect_files();
            collect_pairs();
        }
        update_files(touched);
        update_drift(new_map, touched, commit.time);
        plan_blocks(new_map || files_came_or_went || (blocks_.follow_units() && !touched.empty()));
        return true;
    }

    /// All but the figures.
    HistoryPoint point(const GitCommit& commit) const {
        HistoryPoint out;
        out.commit = commit;
        out.pairs = there_.size();
        out.open_pairs = drift_.open_count();
        out.debt = drift_.debt(commit.time);
        return out;
    }

    std::future<BlockFigures> figures() { return blocks_.figures(); }

    bool has_map() const { return has_map_; }
    const MapFile& map() const { return map_; }
    double debt(int64_t time) const { return drift_.debt(time); }
    std::vector<OpenPair> open() const { return drift_.open(); }

private:
    std::string blob_at(const std::string& path) const {
        const auto found = tree_.find(path);
        return found == tree_.end() ? std::string() : found->second;
    }

    bool side_of(const std::string& path) const { return globs_.source.takes(path) || globs_.target.takes(path); }

    void use_map(MapFile map, const std::string& name) {
        require_sides(map, name);
        map_ = std::move(map);
        has_map_ = true;
        globs_ = {SideGlobs(map_.source), SideGlobs(map_.target)};
        blobs_.use_dialect(map_);
    }

    /// Reads the commit's own map if it is another than before; true if the map changed.
    bool read_map_of(const GitCommit& commit) {
        const bool first = std::exchange(fresh_, false);
        const std::string blob = blob_at("portmap.toml");
        if (past_.map_is_given || blob == map_blob_) return first;
        map_blob_ = blob;
        if (blob.empty()) {
            if (past_.has_map_today) use_map(past_.map_today, past_.map_name);
            return past_.has_map_today;
        }
        const std::string name = "portmap.toml at " + commit.id;
        const ReadMap read = read_map(name, read_blob(past_, "portmap.toml", blob));
        try {
            if (!read.error.empty()) throw CannotDo(read.error);
            use_map(read.map, name);
        } catch (const CannotDo& problem) {  // history cannot be mended
            place_.err << "porttool: " << problem.what() << "\nThis commit is read with the map before it\n";
            return first;
        }
        return true;
    }

    /// Reads the commit's lock if it is another than before; true if it is. Collects the pairs of which it says
    /// something else.
    bool read_lock_now() {
        relocked_.clear();
        const std::string blob = blob_at("portmap.lock");
        if (blob == lock_blob_) return false;
        lock_blob_ = blob;
        const LockFile before = std::exchange(lock_, blob.empty() ? LockFile() : lock_of(blob));
        std::map<PairId, const LockedPair*> gone = std::exchange(locked_, {});
        for (const LockedPair& pair : lock_.pairs) {
            const PairId id{pair.source, pair.target};
            locked_[id] = &pair;
            const auto old = gone.find(id);
            if (old == gone.end() || old->second->source_prints != pair.source_prints ||
                old->second->target_prints != pair.target_prints)
                relocked_.insert(id);
            if (old != gone.end()) gone.erase(old);
        }
        for (const auto& [id, pair] : gone) relocked_.insert(id);
        for (const LockFile* lock : {&before, &std::as_const(lock_)})
            for (const LedgerEntry& entry : lock->ledger) relocked_.insert({entry.source, entry.target});
        ignored_.clear();
        for (const LedgerEntry& entry : lock_.ledger)
            if (entry.verdict == Verdict::Ignore) ignored_.emplace(PairId{entry.source, entry.target}, &entry);
        return true;
    }

    /// A commit's lock, in prints of today's normal form.
    LockFile lock_of(const std::string& blob) {
        LockFile lock = read_lock(read_blob(past_, "portmap.lock", blob)).lock;
        if (!is_outdated(lock)) return lock;
        const auto text_of = [this](Print print) {
            const std::string base = blob_at("portmap.base/" + print.text());
            if (base.empty()) return std::string();
            std::string text = read_blob(past_, "portmap.base/" + print.text(), base);
            renewed_[prints_of_text(NormalText::read(text)).written] = base;
            return text;
        };
        return upgraded(std::move(lock), text_of, {}).lock;
    }

    /// The files of both sides, after the map changed.
    void collect_files() {
        for (const Side side : kBothSides) {
            files_[side].clear();
            for (const auto& [path, blob] : tree_)
                if (globs_[side].takes(path)) files_[side][path] = blob;
        }
    }

    void update_files(const Paths& touched) {
        for (const std::string& path : touched)
            for (const Side side : kBothSides) {
                files_[side].erase(path);
                const std::string blob = blob_at(path);
                if (!blob.empty() && globs_[side].takes(path)) files_[side][path] = blob;
            }
    }

    /// The pairs of a new map; those that only the old one had are forgotten.
    void collect_pairs() {
        std::set<PairId> gone;
        for (const PairPlan& pair : pairs_) gone.insert(pair.id);
        pairs_.clear();
        for (const MapPair& pair : map_.pairs)
            for (const std::string& target : pair.targets) {
                pairs_.push_back({{pair.source, target}, split_id(pair.source).first, split_id(target).first});
                gone.erase(pairs_.back().id);
            }
        for (const PairId& id : gone) {
            drift_.forget(id);
            there_.erase(id);
        }
    }

    /// Finds out what blocks take, where that may have changed.
    void plan_blocks(bool changed) {
        FilePairs pairs;
        for (const PairPlan& pair : pairs_)
            if (there_.contains(pair.id)) pairs.emplace(pair.source_path, pair.target_path);
        if (!changed && pairs == file_pairs_) return;
        file_pairs_ = std::move(pairs);
        blocks_.plan(file_pairs_);
    }

    const UnitFacts* unit_of(Side side, const std::string& id) {
        const auto [path, name] = split_id(id);
        return files_[side].contains(path) ? blobs_.facts({path, files_[side].at(path)}).find(name) : nullptr;
    }

    bool is_ignored(const PairId& id, const UnitFacts* source, const UnitFacts* target) const {
        const Fingerprints* source_prints = source == nullptr ? nullptr : &source->prints;
        const Fingerprints* target_prints = target == nullptr ? nullptr : &target->prints;
        const auto [first, end] = ignored_.equal_range(id);
        return std::any_of(first, end,
                           [&](const auto& entry) { return entry.second->is_of(source_prints, target_prints); });
    }

    void update_drift(bool all, const Paths& touched, int64_t time) {
        budget_ = CompareBudget();
        for (const PairPlan& pair : pairs_)
            if (all || touched.contains(pair.source_path) || touched.contains(pair.target_path) ||
                relocked_.contains(pair.id))
                update_pair(pair.id, time);
    }

    void update_pair(const PairId& id, int64_t time) {
        PairNow now;
        now.source = unit_of(Side::Source, id.first);
        now.target = unit_of(Side::Target, id.second);
        const auto locked = locked_.find(id);
        if (locked != locked_.end()) {
            now.locked_source = &locked->second->source_prints;
            now.locked_target = &locked->second->target_prints;
        }
        now.ignored = is_ignored(id, now.source, now.target);
        if (now.source != nullptr && now.target != nullptr)
            there_.insert(id);
        else
            there_.erase(id);
        drift_.update(id, now, time);
    }

    const Past& past_;
    Workplace& place_;
    BlobFactsSource blobs_;
    CompareBudget budget_;  ///< of the commit
    DriftReplay drift_;
    std::map<std::string, std::string> tree_;  ///< all files of the commit: path to blob
    bool has_map_ = false, fresh_ = true;
    MapFile map_;
    std::string map_blob_, lock_blob_;
    BySide<SideGlobs> globs_;
    LockFile lock_;
    std::map<Print, std::string> renewed_;  ///< by today's print, the blob with a text that an older lock names
    std::map<PairId, const LockedPair*> locked_;
    std::multimap<PairId, const LedgerEntry*> ignored_;
    std::set<PairId> relocked_;  ///< by this commit
    SideBlobs files_;
    BlockReplay blocks_;
    FilePairs file_pairs_;  ///< as the blocks were planned with
    std::vector<PairPlan> pairs_;
    std::set<PairId> there_;  ///< those of which both sides are there
};

/// What each commit of a chain changed, in their order; read ahead in another thread.
class ChainChanges {
public:
    ChainChanges(const Past& past, const std::vector<GitCommit>& chain) : git_(past.root), chain_(chain) {
        while (begun_ < chain_.size() && ahead_.size() < Reader::kMostWaiting) begin();
    }

    std::vector<GitChange> next() {
        std::vector<GitChange> changes = ahead_.front().get();
        ahead_.pop_front();
        if (begun_ < chain_.size()) begin();
        return changes;
    }

private:
    using Reader = InTurn<std::vector<GitChange>>;

    void begin() {
        const std::string before = begun_ == 0 ? std::string() : chain_[begun_ - 1].id;
        ahead_.push_back(reader_.add([this, before, now = chain_[begun_].id] {
            return git_.changes(before, now, [](const std::string&) { return true; });
        }));
        ++begun_;
    }

    GitRepository git_;  ///< of the other thread
    const std::vector<GitCommit>& chain_;
    size_t begun_ = 0;
    std::deque<std::future<std::vector<GitChange>>> ahead_;
    Reader reader_;
};

/// The place in the chain from which on commits are shown: after the newest one that `since` has, or, for a date, from
/// the first commit of that day on.
size_t first_shown(const Past& past, const std::vector<GitCommit>& chain, const std::string& since) {
    if (since.empty()) return 0;
    if (has_form_of_date(since)) {
        if (!is_date(since)) throw CannotDo("--since: " + since + " is no day of the calendar");
        const auto day = std::find_if(chain.begin(), chain.end(),
                                      [&](const GitCommit& commit) { return day_of(commit.time) >= since; });
        return static_cast<size_t>(day - chain.begin());
    }
    const GitCommit base = find_commit(past, "--since", since);
    size_t low = 0, high = chain.size();  // the ancestors of a commit are the start of the chain
    while (low < high) {
        const size_t middle = (low + high) / 2;
        if (past.git->is_ancestor(chain[middle].id, base.id))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

}  // namespace

History history_of(const Past& past, const std::string& since, BlobCache& cache, Workplace& place) {
    const auto head = past.git->commit("HEAD");
    if (!head) throw CannotDo("HEAD names no commit yet; commit once, then there is a history");
    const GitChain chain = past.git->first_parents(head->id);
    const size_t first = first_shown(past, chain.commits, since);
    History history;
    history.commits = chain.commits.size();
    history.cut = chain.cut;
    history.oldest = chain.commits.front();
    Timeline timeline(past, cache, place);
    ChainChanges changes(past, chain.commits);
    std::vector<std::future<BlockFigures>> figures;
    for (size_t i = 0; i < chain.commits.size(); ++i) {
        const GitCommit& commit = chain.commits[i];
        const double debt_before = timeline.debt(commit.time);
        const bool touched = timeline.step(commit, changes.next());
        const bool last = i + 1 == chain.commits.size();
        if (!timeline.has_map() || !(last || (touched && i >= first))) continue;
        history.points.push_back(timeline.point(commit));
        history.points.back().debt_before = debt_before;
        figures.push_back(timeline.figures());
    }
    ChurnCount churn;
    for (size_t i = 0; i < figures.size(); ++i) {
        BlockFigures found = figures[i].get();
        churn.add(found);
        history.points[i].blocks = std::move(found.blocks);
        history.points[i].totals = std::move(found.totals);
    }
    if (!timeline.has_map())
        throw CannotDo(
            "there is no portmap.toml in the work tree or in any commit of this history\nWrite one with: "
            "porttool init --source GLOB --target GLOB");
    history.churn = churn.of(history.points.back().blocks);
    history.churn_and_likeness = churn_and_likeness(history.churn, history.points.back().blocks);
    history.open = timeline.open();
    history.map = timeline.map();
    return history;
}

}  // namespace porttool
