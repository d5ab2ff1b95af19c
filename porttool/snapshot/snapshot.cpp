// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/snapshot.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "porttool/read/git_repository.h"
#include "porttool/read/source_glob.h"
#include "porttool/read/traced_disk.h"
#include "porttool/scan/scan.h"
#include "porttool/snapshot/lock_store.h"
#include "porttool/snapshot/merge_marks.h"
#include "porttool/text/parallel.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

using FilesByPath = std::unordered_map<std::string_view, const ScannedFile*>;  // by path

FilesByPath by_path(const std::vector<ScannedFile>& files) {
    FilesByPath out;
    for (const ScannedFile& file : files) out.emplace(file.path, &file);
    return out;
}

/// Scans files; those that are known with the same text are taken from there, and their paths noted in `same`.
std::vector<ScannedFile> scan_all(const SourceSet& set, const FilesByPath& known, std::set<std::string>& same) {
    std::vector<ScannedFile> files(set.files.size());
    std::vector<char> is_same(set.files.size());
    in_parallel(set.files.size(), set.files.size() >= kFilesWorthThreads, [&](size_t i) {
        const SourceText& source = set.files[i];
        const auto found = known.find(source.path);
        is_same[i] = found != known.end() && found->second->lexed.text == source.text;
        if (is_same[i])
            files[i] = *found->second;
        else
            files[i] = scan_text(source.path, source.text);
    });
    for (size_t i = 0; i < files.size(); ++i)
        if (is_same[i]) same.insert(files[i].path);
    return files;
}

/// Scans files but for those that stand as they stood, which are taken out of `last`; their paths are noted in `same`.
/// `written`: the bytes of files whose scanned text is not all of them (it has no carriage returns), then and now.
std::vector<ScannedFile> scan_again(SourceSet set, std::vector<ScannedFile>& last, std::set<std::string>& same,
                                    std::map<std::string, std::string>& written) {
    std::unordered_map<std::string, ScannedFile*> known;
    for (ScannedFile& file : last) known.emplace(file.path, &file);
    std::vector<ScannedFile> files(set.files.size());
    std::vector<size_t> fresh;
    for (size_t i = 0; i < files.size(); ++i) {
        const SourceText& source = set.files[i];
        const auto then = known.find(source.path);
        const auto bytes = written.find(source.path);
        const bool is_same =
            then != known.end() && (bytes == written.end() ? then->second->lexed.text : bytes->second) == source.text;
        if (is_same) {
            same.insert(source.path);
            files[i] = std::move(*then->second);
        } else {
            fresh.push_back(i);
        }
    }
    in_parallel(fresh.size(), fresh.size() >= kFilesWorthThreads, [&](size_t at) {
        SourceText& source = set.files[fresh[at]];
        files[fresh[at]] = scan_text(source.path, source.text);
        if (files[fresh[at]].lexed.text == source.text) source.text = {};
    });
    std::map<std::string, std::string> written_now;
    for (size_t i = 0; i < files.size(); ++i)
        if (SourceText& source = set.files[i]; !source.text.empty() && files[i].lexed.text != source.text)
            written_now.emplace(std::move(source.path), std::move(source.text));
    written = std::move(written_now);
    return files;
}

const std::vector<std::string>& globs_of(const MapFile& map, Side side) {
    return side == Side::Source ? map.source : map.target;
}

std::string root_of(const Project& project, Side side) {
    return side == Side::Source ? project.root : target_root(project);
}

const char* name_of(Side side) { return side == Side::Source ? "source" : "target"; }

/// A bracket that is never closed stands for itself, as in a shell, which is rarely what was meant.
std::string bracket_hint(const std::string& glob) {
    for (const auto& [open, close] : {std::pair('[', ']'), std::pair('{', '}')})
        if (std::count(glob.begin(), glob.end(), open) > std::count(glob.begin(), glob.end(), close))
            return std::string("; its '") + open + "' is never closed";
    return "; globs are relative to the root, ** crosses folders";
}

/// The files of a side that findings, which are errors, tell of where they are gone: of a port those with pairs. The
/// side whose behaviour counts has no such findings; it, and another checkout, may also just not be there.
std::set<std::string> told_files(const Project& project, Side side) {
    const Side counts = project.map.reference == Reference::Target ? Side::Target : Side::Source;
    const bool are_told = side != counts && !(side == Side::Target && is_elsewhere(project));
    return are_told ? named_files(project.map, side) : std::set<std::string>();
}

/// A glob that matches nothing is a mistake, or its files are gone, which must be told.
void require_matches(const std::vector<std::string>& unmatched, const Project& project, Side side) {
    const std::set<std::string> named = told_files(project, side);
    for (const std::string& text : unmatched) {
        const SourceGlob glob(text, root_of(project, side));
        if (std::any_of(named.begin(), named.end(), [&](const std::string& file) { return glob.takes(file); }))
            continue;
        throw CannotDo(std::string(name_of(side)) + " glob '" + terminal_text(text) + "' matches no file that is read" +
                       bracket_hint(text));
    }
}

/// Wants what globs name.
WantsFile wanted(const std::vector<std::string>& globs) {
    return [compiled = std::vector<Glob>(globs.begin(), globs.end())](const std::string& path) {
        return std::any_of(compiled.begin(), compiled.end(), [&](const Glob& glob) { return glob.matches(path); });
    };
}

/// One side as it stands in the work tree.
SourceSet read_side(const Project& project, const Disk& disk, Side side) {
    const std::string root = root_of(project, side);
    const std::vector<std::string>& globs = globs_of(project.map, side);
    const auto tracked = [&] {
        if (const auto* traced = dynamic_cast<const TracedDisk*>(&disk)) traced->asked_git(root, globs);
        return GitRepository(root).tracked_files(wanted(globs));
    };
    std::vector<std::string> unmatched;
    SourceSet out =
        read_globs(disk, root, globs, unmatched,
                   {project.globs_given ? Reach::Anywhere : Reach::Beneath,
                    side == Side::Target && is_elsewhere(project), named_files(project.map, side), tracked});
    require_matches(unmatched, project, side);
    return out;
}

/// The files of both sides as they stand in the work tree; notes what could not be read.
BySide<SourceSet> read_both_sides(Snapshot& snapshot) {
    Project& project = snapshot.project;
    BySide<SourceSet> sets{read_side(project, *snapshot.on_disk, Side::Source),
                           read_side(project, *snapshot.on_disk, Side::Target)};
    const auto& [source, target] = sets;
    project.skipped = source.skipped;
    const auto is_known = [&](const SkippedFile& file) {
        return std::any_of(source.skipped.begin(), source.skipped.end(), [&](const SkippedFile& known) {
            return known.file == file.file && known.reason == file.reason;
        });
    };
    for (const SkippedFile& file : target.skipped)
        if (!project.map.target_root.empty())
            project.skipped.push_back({clean_path(join_path(project.map.target_root, file.file)), file.reason});
        else if (!is_known(file))
            project.skipped.push_back(file);
    return sets;
}

/// Scans both sides. What stands as it did in `last` is taken from there; returns the paths of that.
BySide<std::set<std::string>> scan_work_tree(Snapshot& snapshot, BySide<SourceSet> sets, Project& last) {
    Project& project = snapshot.project;
    BySide<std::set<std::string>> same;
    project.source = scan_again(std::move(sets.source), last.source, same.source, snapshot.written.source);
    project.target = scan_again(std::move(sets.target), last.target, same.target, snapshot.written.target);
    return same;
}

uint64_t bytes_of(const SourceSet& set) {
    uint64_t bytes = 0;
    for (const SourceText& file : set.files) bytes += file.text.size();
    return bytes;
}

/// Where the map, its lock and the texts of that stand in the commits of a project, as seen from its root.
struct RecordPaths {
    std::string map, lock, texts;
    bool in_commits = false;  ///< false: the map is the user's own, elsewhere

    explicit RecordPaths(const Project& project) {
        const TreePath place = beside_map(project, project.map_path.substr(project.map_path.find_last_of('/') + 1));
        map = place.path;
        lock = beside_map(project, "portmap.lock").path;
        texts = beside_map(project, "portmap.base").path + "/";
        in_commits = place.root == project.root;
    }
};

/// Asks git for files of a moment.
GitFiles ask_git(const std::string& root, const Moment& at, const WantsFile& wants,
                 const std::vector<std::string>& folders) {
    const GitRepository git(root, kChecksWithGit);
    if (at.kind == Moment::Kind::Index) return git.files_in_index(wants, folders);
    return git.files_at_base(at.revision, wants, folders);
}

/// The folder of a path, "." for none.
std::string folder_of(const std::string& path) {
    const size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? "." : path.substr(0, slash);
}

void add_files(MemoryDisk& disk, const std::string& root, GitFiles files) {
    if (!files.error.empty()) throw CannotDo(files.error);
    for (auto& [path, bytes] : files.files) disk.files[join_path(root, path)] = std::move(bytes);
    for (auto& [path, reason] : files.unreadable) disk.errors[join_path(root, path)] = std::move(reason);
}

/// What the repository of the source had at the merge base in the place where the target's root is: a folder, or the
/// commit that it named of a submodule. None if it had nothing there.
std::optional<GitFiles> target_of_own_repository(const Snapshot& snapshot, const std::string& root,
                                                 const SideGlobs& target) {
    const GitRepository own(snapshot.project.root, kChecksWithGit);
    if (!own.error().empty()) return std::nullopt;
    std::error_code error;
    const std::string place =
        std::filesystem::relative(std::filesystem::weakly_canonical(root, error), own.work_tree(), error)
            .generic_string();
    if (place.empty() || place == "." || place == ".." || place.starts_with("../")) return std::nullopt;
    const std::string before = place + "/";
    std::vector<std::string> folders;
    for (const std::string& folder : target.folders()) folders.push_back(clean_path(before + folder));
    const auto wants = [&](const std::string& path) {
        return path.starts_with(before) && target.takes(path.substr(before.size()));
    };
    GitFiles all = GitRepository(own.work_tree()).files_at_base(snapshot.at.revision, wants, folders);
    if (all.error.empty() && all.files.empty() && all.unreadable.empty() && all.unknown.empty()) return std::nullopt;
    GitFiles out;
    out.error = std::move(all.error);
    for (auto& [path, bytes] : all.files) out.files[path.substr(before.size())] = std::move(bytes);
    for (auto& [path, reason] : all.unreadable) out.unreadable[path.substr(before.size())] = std::move(reason);
    for (const std::string& path : all.unknown)
        out.unknown.insert(path.starts_with(before) ? path.substr(before.size()) : "");
    return out;
}

/// The target side of another checkout: its HEAD where it knows no such revision.
void add_other_checkout(Snapshot& snapshot) {
    const std::string root = target_root(snapshot.project);
    SideGlobs target;
    target.add(snapshot.project.map.target);
    const bool at_base = snapshot.at.kind == Moment::Kind::MergeBase;
    if (std::optional<GitFiles> own = at_base ? target_of_own_repository(snapshot, root, target) : std::nullopt) {
        snapshot.unknown.target = own->unknown;
        return add_files(snapshot.git, root, std::move(*own));
    }
    const WantsFile wants = [&](const std::string& path) { return target.takes(path); };
    GitFiles files = ask_git(root, snapshot.at, wants, target.folders());
    if (at_base) {
        if (!files.error.empty()) {
            files = ask_git(root, {Moment::Kind::MergeBase, "HEAD"}, wants, target.folders());
            snapshot.note += (snapshot.note.empty() ? "--base " : "\n--base ") + terminal_text(snapshot.at.revision) +
                             " names nothing in " + terminal_text(root) + "; its HEAD is taken for the port as it was";
        }
        if (!files.error.empty()) throw CannotDo("target_root: " + files.error);
    }
    snapshot.unknown.target = files.unknown;
    add_files(snapshot.git, root, std::move(files));
}

/// What git has of both sides, the map and the lock; of an index also the texts behind that.
void fetch(Snapshot& snapshot) {
    const Project& project = snapshot.project;
    SideGlobs sides;
    sides.add(project.map.source);
    if (project.map.target_root.empty()) sides.add(project.map.target);
    const RecordPaths record(project);
    const bool texts = snapshot.at.kind == Moment::Kind::Index;
    const auto wants = [&](const std::string& path) {
        if (sides.takes(path)) return true;
        return record.in_commits &&
               (path == record.map || path == record.lock || (texts && path.starts_with(record.texts)));
    };
    std::vector<std::string> folders = sides.folders();
    // Of the folder with the map only these two are wanted, not what lies below: its files are looked at in any case.
    if (record.in_commits) folders.push_back(record.map);
    GitFiles files = ask_git(project.root, snapshot.at, wants, folders);
    snapshot.unknown = {files.unknown, files.unknown};
    snapshot.note = files.note;
    add_files(snapshot.git, project.root, std::move(files));
    if (!project.map.target_root.empty()) add_other_checkout(snapshot);
}

/// What git has of both sides; globs that match nothing there are no mistake.
BySide<SourceSet> sides_from_git(Snapshot& snapshot) {
    BySide<SourceSet> sets;
    fetch(snapshot);
    Project& project = snapshot.project;
    project.skipped.clear();
    for (const Side side : kBothSides) {
        std::vector<std::string> unmatched;
        SourceSet& set = sets[side];
        set = read_globs(snapshot.git, root_of(project, side), globs_of(project.map, side), unmatched);
        project.skipped.insert(project.skipped.end(), set.skipped.begin(), set.skipped.end());
        for (const SkippedFile& file : set.skipped) snapshot.unknown[side].insert(file.file);
        if (snapshot.at.kind == Moment::Kind::Index && set.files.empty() && told_files(project, side).empty())
            throw CannotDo(std::string("--staged: the index holds no file of the ") + name_of(side) +
                           " side\nStage them with: git add; or check without --staged");
    }
    return sets;
}

/// Scans them. Returns the files that are as `known` has them.
BySide<std::set<std::string>> scan_beside(Snapshot& snapshot, const BySide<SourceSet>& sets, const Snapshot& known) {
    BySide<std::set<std::string>> same;
    for (const Side side : kBothSides) {
        const bool is_source = side == Side::Source;
        const FilesByPath there = by_path(is_source ? known.project.source : known.project.target);
        (is_source ? snapshot.project.source : snapshot.project.target) = scan_all(sets[side], there, same[side]);
    }
    return same;
}

/// Files of a side by their facts; those that are as `known` has them are shared with it.
KnownSide know_beside(std::vector<SourceText> files, const KnownSide& known, const std::set<std::string>& named,
                      FactsStore& facts) {
    std::unordered_map<std::string_view, const std::shared_ptr<const KnownFile>*> there;
    for (const auto& file : known) there.emplace(file->path(), &file);
    KnownSide side(files.size());
    std::vector<SourceText> others;
    for (size_t i = 0; i < files.size(); ++i) {
        const auto found = there.find(files[i].path);
        if (found != there.end() && (*found->second)->bytes() == files[i].text)
            side[i] = *found->second;
        else
            others.push_back(std::move(files[i]));
    }
    KnownSide fresh = facts.know(std::move(others), named);
    for (auto next = fresh.begin(); auto& file : side)
        if (file == nullptr) file = std::move(*next++);
    return side;
}

BySide<SourceSet> sides_at(Snapshot& snapshot) {
    return snapshot.at.kind == Moment::Kind::WorkTree ? read_both_sides(snapshot) : sides_from_git(snapshot);
}

void refuse_open_merges(const Snapshot& snapshot) { require_finished_merges(snapshot.project.map, snapshot.files()); }

/// Facts of a large file of tiny units take ten times its text, beside all else that is known of it. Where one such
/// file is much of all there is, they would hardly spare a scan: it is the file that was edited.
bool are_worth_facts(const BySide<SourceSet>& sets, uint64_t least_bytes) {
    constexpr uint64_t kLeastOfLarge = 1u << 20, kMostOfAll = 4;
    uint64_t largest = 0;
    for (const Side side : kBothSides)
        for (const SourceText& file : sets[side].files) largest = std::max<uint64_t>(largest, file.text.size());
    const uint64_t all = bytes_of(sets.source) + bytes_of(sets.target);
    return all >= least_bytes && (largest < kLeastOfLarge || largest <= all / kMostOfAll);
}

}  // namespace

FilesOfSide Snapshot::files(Side side) const {
    if (known) return FilesOfSide((*known)[side]);
    return FilesOfSide(side == Side::Source ? project.source : project.target);
}

const Disk& Snapshot::disk() const {
    const bool of_work_tree =
        at.kind == Moment::Kind::WorkTree || (at.kind == Moment::Kind::Index && !git.exists(lock_path(project)));
    return of_work_tree ? *on_disk : git;
}

Project without_files(const Project& project) {
    Project out;
    out.root = project.root;
    out.map_path = project.map_path;
    out.map_name = project.map_name;
    out.has_map = project.has_map;
    out.globs_given = project.globs_given;
    out.map_text = project.map_text;
    out.map = project.map;
    return out;
}

std::string map_in_commits(const Project& project) {
    const RecordPaths record(project);
    return record.in_commits ? record.map : std::string();
}

FileText map_text_at(const Project& project, const Moment& at, const Disk& on_disk) {
    const RecordPaths record(project);
    if (at.kind == Moment::Kind::WorkTree) return read_map_text(on_disk, project.root, project.map_path);
    if (!record.in_commits) return {"", "is in no commit"};
    MemoryDisk git;
    add_files(git, project.root,
              ask_git(project.root, at, [&](const std::string& path) { return path == record.map; }, {record.map}));
    return git.read(TreePath{project.root, record.map}, kLargestFile);
}

FileText map_text_of(const Snapshot& snapshot) {
    const RecordPaths record(snapshot.project);
    if (!record.in_commits) return {"", "is in no commit"};
    return snapshot.git.read(TreePath{snapshot.project.root, record.map}, kLargestFile);
}

Snapshot read_snapshot(Project project, const Moment& at, const Disk& on_disk, Depth depth) {
    Snapshot out{std::move(project), {}, at, "", {}, &on_disk};
    Project none;
    scan_work_tree(out, sides_at(out), none);
    out.written = {};
    if (at.kind != Moment::Kind::MergeBase) refuse_open_merges(out);
    if (depth == Depth::Normal) out.states = read_states(out.project);
    return out;
}

Snapshot read_snapshot(Project project, const Moment& at, const Disk& on_disk, FactsStore& facts) {
    Snapshot out{std::move(project), {}, at, "", {}, &on_disk};
    BySide<SourceSet> sets = sides_at(out);
    const bool by_facts = are_worth_facts(sets, facts.least_bytes());
    if (by_facts) {
        const std::set<std::string> named = named_ids(out.project.map);
        KnownSide source = facts.know(std::move(sets.source.files), named);
        KnownSide target = facts.know(std::move(sets.target.files), named);
        out.known.emplace(BySide<KnownSide>{std::move(source), std::move(target)});
    } else {
        Project none;
        scan_work_tree(out, std::move(sets), none);
        out.written = {};
    }
    if (at.kind != Moment::Kind::MergeBase) refuse_open_merges(out);
    out.states = by_facts ? read_states(*out.known) : read_states(out.project);
    return out;
}

Snapshot read_snapshot_again(Project project, Snapshot last, const Disk& on_disk) {
    Snapshot out{std::move(project), {}, {Moment::Kind::WorkTree}, "", {}, &on_disk};
    out.written = std::move(last.written);
    const BySide<std::set<std::string>> same = scan_work_tree(out, read_both_sides(out), last.project);
    refuse_open_merges(out);
    const bool same_pairs = last.project.map_text == out.project.map_text;  // which whole files are units
    out.states = same_pairs ? read_states(out.project, std::move(last.states), same) : read_states(out.project);
    return out;
}

Snapshot read_snapshot_beside(const Snapshot& known, const Moment& at, const Disk& on_disk, FactsStore* facts,
                              const std::function<void(const Snapshot&)>& see_files) {
    Snapshot out{without_files(known.project), {}, at, "", {}, &on_disk};
    BySide<SourceSet> sets = sides_from_git(out);
    if (known.known && facts != nullptr) {
        const std::set<std::string> named = named_ids(out.project.map);
        out.known.emplace();
        for (const Side side : kBothSides)
            (*out.known)[side] = know_beside(std::move(sets[side].files), (*known.known)[side], named, *facts);
        see_files(out);
        out.states = read_states(*out.known);
        return out;
    }
    const BySide<std::set<std::string>> same = scan_beside(out, sets, known);
    see_files(out);
    out.states = read_states(out.project, known.states, same);
    return out;
}

void scan_known_files(Snapshot& snapshot) {
    if (!snapshot.known) return;
    for (const Side side : kBothSides) {
        const KnownSide& known = (*snapshot.known)[side];
        std::vector<ScannedFile> files(known.size());
        in_parallel(known.size(), known.size() >= kFilesWorthThreads,
                    [&](size_t i) { files[i] = scan_text(known[i]->path(), known[i]->bytes()); });
        (side == Side::Source ? snapshot.project.source : snapshot.project.target) = std::move(files);
    }
}

void read_base_texts(Snapshot& snapshot) {
    const RecordPaths record(snapshot.project);
    if (!record.in_commits) return;
    add_files(
        snapshot.git, snapshot.project.root,
        ask_git(snapshot.project.root, snapshot.at,
                [&](const std::string& path) { return path.starts_with(record.texts); }, {folder_of(record.texts)}));
}

}  // namespace porttool
