// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/past_walk.h"

#include <algorithm>
#include <array>
#include <deque>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "porttool/audit/likeness.h"
#include "porttool/history/in_turn.h"
#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

using FilePtr = std::shared_ptr<const ScannedFile>;

/// The version of each file that was scanned last: what a commit made is what the next older one left.
class LastScanned {
public:
    FilePtr find(const std::string& path, const std::string& blob) {
        const std::lock_guard lock(mutex_);
        const auto found = files_.find(path);
        return found != files_.end() && found->second.first == blob ? found->second.second : nullptr;
    }
    void put(const std::string& path, const std::string& blob, FilePtr file) {
        constexpr size_t kMost = size_t{24} << 20U;  // bytes of text; what is scanned is several times as large
        const std::lock_guard lock(mutex_);
        auto& known = files_[path];
        if (known.second) bytes_ -= known.second->lexed.text.size();
        bytes_ += file->lexed.text.size();
        known = {blob, std::move(file)};
        if (bytes_ <= kMost) return;
        files_.clear();
        bytes_ = 0;
    }

private:
    std::mutex mutex_;
    std::unordered_map<std::string, std::pair<std::string, FilePtr>> files_;
    size_t bytes_ = 0;  ///< of their texts
};

/// Reads versions of files and holds them against each other; one for each thread.
class VersionReader {
public:
    VersionReader(const std::string& root, const Dialect& dialect, LastScanned& last)
        : git_(root), dialect_(dialect), last_(last) {}

    const GitRepository& git() const { return git_; }

    FilePtr scanned(const std::string& path, const std::string& blob) {
        if (blob.empty()) return nullptr;
        if (FilePtr known = last_.find(path, blob)) return known;
        const auto text = git_.find_blob(blob);
        if (!text || !unreadable_reason(*text).empty()) return nullptr;
        return std::make_shared<const ScannedFile>(scan_text(path, *text));
    }

    FileEdit edit(const std::string& old_path, const std::string& before, const std::string& path,
                  const std::string& now) {
        const FilePtr new_file = scanned(path, now), old_file = scanned(old_path, before);
        if (old_file) last_.put(old_path, before, old_file);
        if (!new_file || !old_file) return {};
        return file_edit(old_file.get(), new_file.get(), dialect_);
    }

private:
    GitRepository git_;
    const Dialect& dialect_;
    LastScanned& last_;
};

using LinesOfFile = std::vector<uint64_t>;  ///< each different one once, as a number, in their order

/// The lines of versions of files, as long as one commit is read.
class LinesOfVersions {
public:
    /// Nothing where the version cannot be read.
    const LinesOfFile* of(const GitRepository& git, const std::string& blob) {
        const auto [known, is_new] = known_.try_emplace(blob);
        if (is_new)
            if (const auto text = git.find_blob(blob); text && unreadable_reason(*text).empty())
                known->second = lines_of(*text);
        return known->second ? &*known->second : nullptr;
    }
    void clear() { known_.clear(); }

private:
    static LinesOfFile lines_of(std::string_view text) {
        LinesOfFile out;
        for (size_t at = 0; at < text.size();) {
            const size_t end = std::min(text.find('\n', at), text.size());
            std::string_view line = text.substr(at, end - at);
            while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
            if (line.size() > 3) out.push_back(std::hash<std::string_view>()(line));
            at = end + 1;
        }
        std::sort(out.begin(), out.end());
        out.erase(std::unique(out.begin(), out.end()), out.end());
        return out;
    }

    std::unordered_map<std::string, std::optional<LinesOfFile>> known_;  ///< by blob
};

/// The share of the lines of the smaller file that both have.
double shared_lines(const LinesOfFile& a, const LinesOfFile& b) {
    LinesOfFile common;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    const size_t least = std::min(a.size(), b.size());
    return least == 0 ? 0 : static_cast<double>(common.size()) / static_cast<double>(least);
}

/// The files that a commit took away, for those that it brought in.
class FilesGone {
public:
    FilesGone() = default;
    explicit FilesGone(const std::vector<GitChange>& all) {
        std::unordered_set<std::string_view> came;  // what went to one of these is that under its new name
        for (const GitChange& one : all)
            if (one.before.empty()) came.insert(one.blob);
        for (const GitChange& one : all) {
            if (!one.blob.empty()) continue;
            by_blob_.emplace(one.before, &one);
            if (came.contains(one.before)) continue;
            by_name_[name_of(one.path)].push_back(&one);
            by_suffix_[suffix_of(one.path)].push_back(&one);
            if (rest_.size() < kMostTried) rest_.push_back(&one);
        }
    }

    /// The one with the same bytes; nothing for none.
    const GitChange* same_as(const GitChange& change) const {
        const auto found = by_blob_.find(change.blob);
        return found == by_blob_.end() ? nullptr : found->second;
    }

    /// A few that the file may have been: first those of its name, then those of its suffix.
    std::vector<const GitChange*> likely(const GitChange& change) const {
        std::vector<const GitChange*> out;
        const auto take = [&](const std::vector<const GitChange*>& some) {
            for (const GitChange* one : some) {
                if (out.size() == kMostTried) return;
                if (std::find(out.begin(), out.end(), one) == out.end()) out.push_back(one);
            }
        };
        if (const auto found = by_name_.find(name_of(change.path)); found != by_name_.end()) take(found->second);
        if (const auto found = by_suffix_.find(suffix_of(change.path)); found != by_suffix_.end()) take(found->second);
        take(rest_);
        return out;
    }

private:
    using Files = std::vector<const GitChange*>;
    static constexpr size_t kMostTried = 8;

    static std::string_view name_of(std::string_view path) { return path.substr(path.find_last_of('/') + 1); }
    static std::string_view suffix_of(std::string_view path) { return path.substr(path.find_last_of('.') + 1); }

    std::unordered_map<std::string_view, const GitChange*> by_blob_;
    std::unordered_map<std::string_view, Files> by_name_, by_suffix_;
    Files rest_;
};

/// Where a followed unit stood at the moment that the walk has come to: by path and name, the ids that it has today.
using Places = std::unordered_map<std::string, std::map<std::string, std::vector<std::string>>>;

class PastWalk {
public:
    PastWalk(const std::string& root, const Dialect& dialect, Lineages& lineages)
        : dialect_(dialect),
          lineages_(lineages),
          changes_git_(root),
          own_(root, dialect, last_),
          readers_{VersionReader(root, dialect, last_), VersionReader(root, dialect, last_)} {
        for (const auto& [id, lineage] : lineages) {
            const auto [path, name] = split_id(id);
            places_[path][name].push_back(id);
        }
    }

    WalkedPast run(const std::string& head, const std::string& hidden, int64_t since) {
        GitSteps steps = own_.git().steps(head, hidden);
        std::erase_if(steps.steps, [&](const GitStep& step) { return step.commit.time < since; });
        out_.cut = steps.cut;
        out_.steps = std::move(steps.steps);
        out_.units.assign(out_.steps.size(), 0);
        for (size_t i = 0; i < out_.steps.size(); ++i) {
            while (listed_ < out_.steps.size() && listing_.size() < kChangesAhead) list_next();
            while (begun_ < listed_ && ahead_.size() < kCommitsAhead) begin_next();
            take_in(static_cast<uint32_t>(i));
        }
        return std::move(out_);
    }

private:
    /// An edit of a file by a commit that is being read.
    struct Coming {
        std::string path;
        GitChange change;
        std::future<FileEdit> edit;
    };
    struct CommitAhead {
        std::vector<GitChange> changes;
        std::vector<Coming> coming;
    };
    using Lister = InTurn<std::vector<GitChange>>;
    static constexpr size_t kChangesAhead = Lister::kMostWaiting, kCommitsAhead = 12;

    void list_next() {
        const GitStep& step = out_.steps[listed_++];
        const bool merge = step.parents > 1;
        listing_.push_back(lister_.add([this, merge, parent = step.parent, id = step.commit.id] {
            if (merge) return std::vector<GitChange>();
            return changes_git_.changes(
                parent, id, [](const std::string& path) { return language_of_path(path) != Language::Unknown; });
        }));
    }

    /// Begins to read what a commit did to files that are followed by now.
    void begin_next() {
        CommitAhead next;
        next.changes = listing_.front().get();
        listing_.pop_front();
        ++begun_;
        for (const GitChange& change : next.changes) {
            if (change.blob.empty() || change.before.empty() || !places_.contains(change.path)) continue;
            Coming coming{change.path, change, {}};
            VersionReader& reader = readers_[turn_];
            coming.edit = threads_[turn_].add(
                [&reader, change] { return reader.edit(change.path, change.before, change.path, change.blob); });
            turn_ = (turn_ + 1) % readers_.size();
            next.coming.push_back(std::move(coming));
        }
        ahead_.push_back(std::move(next));
    }

    void take_in(uint32_t commit) {
        CommitAhead now = std::move(ahead_.front());
        ahead_.pop_front();
        elsewhere_of_ = nullptr;
        gone_of_ = nullptr;
        went_of_ = nullptr;
        std::vector<Change> edits;
        std::set<std::string> done;
        for (Coming& coming : now.coming) {
            edits.push_back({coming.path, coming.path, coming.edit.get()});
            done.insert(coming.path);
        }
        for (const GitChange& change : now.changes) {
            if (change.blob.empty() || done.contains(change.path) || !places_.contains(change.path)) continue;
            if (!change.before.empty())
                edits.push_back(
                    {change.path, change.path, own_.edit(change.path, change.before, change.path, change.blob)});
            else if (!follow_file(change, now.changes, edits))
                for (const auto& [name, ids] : places_.at(change.path)) begin(ids, commit);
        }
        std::set<std::string> touched;
        for (const Change& edit : edits) apply(edit, commit, touched);
        for (Change& edit : edits) follow_units(edit, edits, now.changes, commit, touched);
        for (const Change& edit : edits)
            if (edit.old_path != edit.path) move_file(edit);
        out_.units[commit] = static_cast<uint32_t>(touched.size());
        lines_.clear();
    }

    /// The edit of a file, which may have had another name before.
    struct Change {
        std::string old_path, path;
        FileEdit edit;
    };

    void apply(const Change& change, uint32_t commit, std::set<std::string>& touched) {
        const auto here = places_.find(change.path);
        if (here == places_.end()) return;
        for (const UnitEdit& edit : change.edit.edits) {
            const auto found = here->second.find(edit.now_name);
            if (found == here->second.end()) continue;
            for (const std::string& id : found->second) add(id, edit, commit, touched);
        }
    }

    void begin(const std::vector<std::string>& ids, uint32_t commit) {
        for (const std::string& id : ids) lineages_.at(id).begin(commit);
    }

    void add(const std::string& id, const UnitEdit& edit, uint32_t commit, std::set<std::string>& touched) {
        UnitLineage& lineage = lineages_.at(id);
        lineage.add(edit, commit);
        if (edit.counts() && lineage.paired()) touched.insert(id);
    }

    /// A file that is new here: the one that went in the same commit, where it is that one under a new name. False
    /// where none did.
    bool follow_file(const GitChange& change, const std::vector<GitChange>& all, std::vector<Change>& out) {
        if (gone_of_ != &all) {
            gone_of_ = &all;
            gone_ = FilesGone(all);
        }
        if (const GitChange* same = gone_.same_as(change)) {
            out.push_back({same->path, change.path, {}});
            return true;
        }
        const LinesOfFile* now = lines_.of(own_.git(), change.blob);
        if (now == nullptr) return true;
        const GitChange* best = nullptr;
        double most = 0.5;
        for (const GitChange* one : gone_.likely(change))
            if (const LinesOfFile* before = lines_.of(own_.git(), one->before)) {
                const double share = shared_lines(*before, *now);
                if (share > most) {
                    most = share;
                    best = one;
                }
            }
        if (best == nullptr) return false;
        out.push_back({best->path, change.path, own_.edit(best->path, best->before, change.path, change.blob)});
        return true;
    }

    /// Units that are new in their file: those that went from it, or from another, in the same commit.
    void follow_units(Change& change, std::vector<Change>& edits, const std::vector<GitChange>& all, uint32_t commit,
                      std::set<std::string>& touched) {
        for (const LoneVersion& came : change.edit.came) {
            const auto here = places_.find(change.path);
            if (here == places_.end()) return;
            const auto followed = here->second.find(came.name);
            if (followed == here->second.end()) continue;
            std::string from_path;
            const LoneVersion* from = origin(came, change, edits, all, from_path);
            if (from == nullptr) {
                begin(followed->second, commit);
                continue;
            }
            UnitEdit edit = unit_edit(from->text, came.text, came.kind, language_of_path(change.path), dialect_);
            const std::vector<std::string> ids = followed->second;
            for (const std::string& id : ids) add(id, edit, commit, touched);
            here->second.erase(followed);
            auto& there = places_[from_path][from->name];
            there.insert(there.end(), ids.begin(), ids.end());
        }
    }

    /// The units of that name, whatever their scope, which went in this commit.
    const std::vector<std::pair<const Change*, const LoneVersion*>>& namesakes_that_went(
        const LoneVersion& came, const std::vector<Change>& edits) {
        if (went_of_ != &edits) {
            went_of_ = &edits;
            went_by_leaf_.clear();
            for (const Change& one : edits)
                for (const LoneVersion& went : one.edit.went)
                    went_by_leaf_[std::string(leaf_of(went.name))].emplace_back(&one, &went);
        }
        return went_by_leaf_[std::string(leaf_of(came.name))];
    }

    /// What their likeness can be by their lengths.
    static float most_likeness(const LoneVersion& a, const LoneVersion& b) {
        const size_t least = std::min(a.words.size(), b.words.size()), most = std::max(a.words.size(), b.words.size());
        return most == 0 ? 0 : 2.0f * static_cast<float>(least) / static_cast<float>(least + most);
    }

    const LoneVersion* origin(const LoneVersion& came, const Change& change, std::vector<Change>& edits,
                              const std::vector<GitChange>& all, std::string& from_path) {
        const LoneVersion* best = nullptr;
        float most = 0.6f;
        const auto look = [&](std::span<const LoneVersion> went, const std::string& path) {
            for (const LoneVersion& one : went) {
                if (one.kind != came.kind) continue;
                const bool same_name = leaf_of(one.name) == leaf_of(came.name);
                const float bonus = same_name ? 0.2f : 0.0f;
                if (most_likeness(one, came) + bonus <= most) continue;
                const float like = text_likeness(one, came) + bonus;
                if (like > most) {
                    most = like;
                    best = &one;
                    from_path = path;
                }
            }
        };
        look(change.edit.went, change.old_path);
        if (best != nullptr) return best;
        for (const auto& [one, went] : namesakes_that_went(came, edits))
            if (one != &change) look({went, 1}, one->old_path);
        if (most >= 1.0f) return best;  // none of another name can be more alike
        for (const Change& one : edits)
            if (&one != &change) look(one.edit.went, one.old_path);
        if (best != nullptr) return best;
        look_into_others(all, edits);
        for (const auto& [path, went] : went_elsewhere_) look(went, path);
        return best;
    }

    /// What went from files that nobody follows yet, in this commit.
    void look_into_others(const std::vector<GitChange>& all, const std::vector<Change>& edits) {
        constexpr size_t kMostFiles = 24;
        if (all.empty() || elsewhere_of_ == &all) return;
        elsewhere_of_ = &all;
        went_elsewhere_.clear();
        if (all.size() > kMostFiles) return;
        for (const GitChange& one : all) {
            const bool known =
                std::any_of(edits.begin(), edits.end(), [&](const Change& edit) { return edit.old_path == one.path; });
            if (known || one.before.empty()) continue;
            const FilePtr before = own_.scanned(one.path, one.before), now = own_.scanned(one.path, one.blob);
            if (before) went_elsewhere_[one.path] = file_edit(before.get(), now.get(), dialect_).went;
        }
    }

    /// From here on back the file has its old name. What came with this commit stays where it is.
    void move_file(const Change& change) {
        const auto here = places_.find(change.path);
        if (here == places_.end()) return;
        auto units = std::move(here->second);
        places_.erase(here);
        auto& there = places_[change.old_path];
        for (auto& [name, ids] : units) {
            auto& known = there[name];
            for (std::string& id : ids)
                if (std::find(known.begin(), known.end(), id) == known.end()) known.push_back(std::move(id));
        }
    }

    const Dialect& dialect_;
    Lineages& lineages_;
    LastScanned last_;
    LinesOfVersions lines_;
    Places places_;
    WalkedPast out_;
    size_t listed_ = 0, begun_ = 0, turn_ = 0;
    const std::vector<GitChange>* elsewhere_of_ = nullptr;
    const std::vector<GitChange>* gone_of_ = nullptr;
    FilesGone gone_;
    const std::vector<Change>* went_of_ = nullptr;
    std::unordered_map<std::string, std::vector<std::pair<const Change*, const LoneVersion*>>> went_by_leaf_;
    std::map<std::string, std::vector<LoneVersion>> went_elsewhere_;
    GitRepository changes_git_;  ///< of the lister's thread
    VersionReader own_;
    std::array<VersionReader, 2> readers_;
    std::deque<std::future<std::vector<GitChange>>> listing_;
    std::deque<CommitAhead> ahead_;
    Lister lister_;
    std::array<InTurn<FileEdit>, 2> threads_;
};

}  // namespace

WalkedPast walk_past(const std::string& root, const std::string& head, const std::string& hidden, int64_t since,
                     const Dialect& dialect, Lineages& lineages) {
    return PastWalk(root, dialect, lineages).run(head, hidden, since);
}

}  // namespace porttool
