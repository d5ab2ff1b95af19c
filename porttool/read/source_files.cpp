// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/source_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include "porttool/language/language.h"
#include "porttool/read/cannot_do.h"
#include "porttool/read/ignore_rules.h"
#include "porttool/read/source_glob.h"
#include "porttool/read/tracked.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

constexpr uint64_t kUnbounded = std::numeric_limits<uint64_t>::max();

/// What to say of a tree that is no checkout.
CannotDo too_much(const std::string& root, const std::string& what) {
    return CannotDo(terminal_text(root) + ": more than " + what +
                    " for the globs of the map; begin them with smaller folders, or name one by [sides] target_root");
}

/// Walks folders below a root, reading each .gitignore on the way. What lies below `own`, a folder that the user named
/// and that need not lie beneath the root, is opened beneath that.
class Walker {
public:
    Walker(const Disk& disk, const std::string& root, const std::string& own = "", size_t most_entries = kUnbounded)
        : disk_(disk), root_(root), own_(own), most_entries_(most_entries) {}

    /// Calls `visit(path)` for each file below `folder` that is not ignored. `concerns(path)`: false for a folder, or a
    /// link that may stand for one, that is left out with all that lies in it.
    template <class Concerns, class Visit>
    void walk(const std::string& folder, const Concerns& concerns, const Visit& visit) {
        std::vector<std::string> open = {folder == "." ? "" : folder};
        while (!open.empty()) {
            const std::string at = open.back();
            open.pop_back();
            const FolderList list = disk_.list(place_of(at));
            if (list.refused) refused_.push_back({at, list.error});
            if (!list.error.empty()) continue;
            const IgnoreRules& rules = rules_of(at);
            for (const DirectoryEntry& entry : list.entries) {
                const std::string path = at.empty() ? entry.name : at + "/" + entry.name;
                if (entry.name == ".git") continue;
                if (++entries_ > most_entries_)
                    throw too_much(root_, fmt::format("{} files and folders", most_entries_));
                if (entry.is_directory && !concerns(path)) continue;
                if (rules.ignores(path, entry.is_directory)) {
                    ignored_some_ = true;
                    continue;
                }
                if (entry.is_directory)
                    open.push_back(path);
                else
                    visit(path);
                if (entry.is_link && language_of_path(path) == Language::Unknown && concerns(path)) note_way_out(path);
            }
        }
    }

    TreePath place_of(const std::string& path) const {
        if (own_.empty() || (path != own_ && !path.starts_with(own_ + "/"))) return {root_, path};
        return {join_path(root_, own_), path.substr(std::min(own_.size() + 1, path.size()))};
    }

    /// True if a rule hid something.
    bool ignored_some() const { return ignored_some_; }
    /// Folders that lie elsewhere, and links that lead there; they were not looked into.
    const std::vector<SkippedFile>& refused() const { return refused_; }

private:
    /// A link may stand for a folder of sources: where it leads out of the root, nobody shall think that they were
    /// read.
    void note_way_out(const std::string& path) {
        if (const FolderList list = disk_.list(place_of(path)); list.refused) refused_.push_back({path, list.error});
    }

    /// The rules that hold in a folder: its parent's and its own.
    const IgnoreRules& rules_of(const std::string& folder) {
        if (const auto known = rules_.find(folder); known != rules_.end()) return known->second;
        IgnoreRules rules;
        const size_t slash = folder.find_last_of('/');
        if (!folder.empty() && slash != 0) {
            rules = rules_of(slash == std::string::npos ? "" : folder.substr(0, slash));
        } else {
            const FileText exclude = disk_.read(join_path(root_, ".git/info/exclude"), kLargestFile);
            if (exclude.error.empty()) rules.add("", exclude.bytes);
        }
        const FileText own = disk_.read(place_of(folder.empty() ? ".gitignore" : folder + "/.gitignore"), kLargestFile);
        if (own.error.empty()) rules.add(folder, own.bytes);
        return rules_.emplace(folder, std::move(rules)).first->second;
    }

    const Disk& disk_;
    std::string root_, own_;
    size_t most_entries_, entries_ = 0;
    std::map<std::string, IgnoreRules> rules_;
    std::vector<SkippedFile> refused_;
    bool ignored_some_ = false;
};

/// Files by the paths that they are shown with, and where each is opened. The user's own has no root: it is followed
/// wherever it leads.
using FoundFiles = std::map<std::string, TreePath>;

SourceSet read_all(const Disk& disk, const FoundFiles& found, const std::string& root = "",
                   uint64_t most_bytes = kUnbounded, const std::set<std::string>& untracked = {}) {
    SourceSet out;
    uint64_t bytes = 0;
    for (const auto& [path, place] : found) {
        FileText file = {"", unreadable_name(path)};
        if (file.error.empty())
            file = place.root.empty() ? disk.read(place.path, kLargestSource) : disk.read(place, kLargestSource);
        // Of what a link leads to the disk has asked.
        if (file.error.empty() && !file.by_link && untracked.contains(path)) file = {"", untracked_text(path)};
        if (file.error.empty()) file.error = unreadable_reason(file.bytes);
        bytes += file.bytes.size();
        if (bytes > most_bytes) throw too_much(root, fmt::format("{} bytes of sources", most_bytes));
        if (file.error.empty())
            out.files.push_back({path, std::move(file.bytes)});
        else
            out.skipped.push_back({path, file.error});
    }
    return out;
}

void add_refused(SourceSet& set, const Walker& walker) {
    for (const SkippedFile& folder : walker.refused())
        if (std::none_of(set.skipped.begin(), set.skipped.end(),
                         [&](const SkippedFile& known) { return known.file == folder.file; }))
            set.skipped.push_back(folder);
}

/// As git-lfs reads one: under the name of today's form or one of before, whatever the ends of its lines.
bool is_lfs_pointer(std::string_view bytes) {
    constexpr std::string_view kKey = "version ", kBlank = " \t\r\n";
    bytes.remove_prefix(std::min(bytes.find_first_not_of(kBlank), bytes.size()));
    if (!bytes.starts_with(kKey)) return false;
    const std::string_view rest = bytes.substr(kKey.size()), form = rest.substr(0, rest.find_first_of("\r\n"));
    return form == "https://git-lfs.github.com/spec/v1" || form == "https://hawser.github.com/spec/v1" ||
           form == "http://git-media.io/v/2";
}

bool is_outside(const std::string& path) { return path.starts_with('/') || path == ".." || path.starts_with("../"); }

}  // namespace

std::string unreadable_name(const std::string& path) {
    return is_utf8(path) ? "" : "the name is not UTF-8; rename it to have it read";
}

std::string unreadable_reason(const std::string& bytes) {
    constexpr uint64_t kMebibyte = 1024 * 1024;
    if (bytes.size() > kLargestSource)
        return "is more than the " + std::to_string(kLargestSource / kMebibyte) + " MiB that are read of one source";
    if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
        return "is UTF-16; save it as UTF-8 to have it scanned";
    if (is_lfs_pointer(bytes)) return "is a pointer of Git LFS, not the file itself; fetch it: git lfs pull";
    const size_t nul = bytes.find('\0');
    if (nul != std::string::npos) return "is binary: byte " + std::to_string(nul) + " is NUL";
    return {};
}

bool leads_out_of(const std::string& root, const std::string& glob) {
    const std::vector<std::string> folders = SourceGlob(glob, root).glob().roots();
    return std::any_of(folders.begin(), folders.end(), is_outside);
}

SourceSet read_paths(const Disk& disk, const std::string& root, const std::vector<std::string>& paths,
                     std::vector<std::string>& missing) {
    FoundFiles found;
    SourceSet out;
    for (const std::string& given : paths) {
        const std::string path = path_below(root, given);
        const std::string full = join_path(root, path);
        if (disk.is_directory(full)) {
            const bool beneath = disk.kind({root, path}) == FileKind::Folder;
            Walker walker(disk, root, beneath ? "" : path);
            const auto all = [](const std::string&) { return true; };
            walker.walk(path, all, [&](const std::string& file) {
                if (language_of_path(file) != Language::Unknown) found.emplace(file, walker.place_of(file));
            });
            add_refused(out, walker);
        } else if (disk.exists(full) || disk.read(full, kLargestFile).error.find("No such file") == std::string::npos) {
            found[path] = {"", full};
        } else {
            missing.push_back(given);
        }
    }
    SourceSet read = read_all(disk, found);
    read.skipped.insert(read.skipped.end(), out.skipped.begin(), out.skipped.end());
    return read;
}

namespace {

/// Reads what globs match, walking each of their folders once.
class GlobReader {
public:
    GlobReader(const Disk& disk, const std::string& root, const std::vector<std::string>& globs, const GlobScope& scope)
        : disk_(disk), root_(root), globs_(globs), scope_(scope) {
        for (const std::string& text : globs) asked_.emplace_back(text, root, scope.sources_only);
    }

    /// Those of the globs that match no file.
    std::vector<std::string> unmatched() {
        std::vector<std::string> out;
        for (size_t i = 0; i < globs_.size(); ++i)
            if (take(asked_[i]) == 0) out.push_back(globs_[i]);
        return out;
    }

    SourceSet read() {
        const bool some_ignored = std::any_of(walkers_.begin(), walkers_.end(),
                                              [](const auto& walker) { return walker.second.ignored_some(); });
        std::set<std::string> plain = no_sources_by_name();
        const bool asks = scope_.tracked && (some_ignored || !plain.empty());
        const TrackedFiles tracked = asks ? scope_.tracked() : TrackedFiles();
        if (!scope_.tracked || !tracked.is_known) plain.clear();
        std::erase_if(plain,
                      [&](const std::string& file) { return tracked.files.contains(file) || is_of_submodule(file); });
        for (const std::string& file : tracked.files)
            for (const SourceGlob& asked : asked_) take_hidden(asked, file);
        const bool bounded = scope_.reach == Reach::Beneath;
        SourceSet out = read_all(disk_, found_, root_, bounded ? scope_.most_bytes : kUnbounded, plain);
        for (const auto& [own, walker] : walkers_) add_refused(out, walker);
        if (some_ignored && !tracked.error.empty())
            out.skipped.push_back(
                {".gitignore", "hides files here, and whether git tracks them cannot be told: " + tracked.error});
        return out;
    }

private:
    /// Files that a map's globs take, though their names are not those of sources.
    std::set<std::string> no_sources_by_name() const {
        std::set<std::string> out;
        for (const auto& [path, place] : found_)
            if (scope_.reach == Reach::Beneath && language_of_path(path) == Language::Unknown) out.insert(path);
        return out;
    }

    /// True for a file of a work tree within this one, of which this one's index says nothing, that git tracks there.
    bool is_of_submodule(const std::string& path) const {
        for (size_t end = path.find('/'); end != std::string::npos; end = path.find('/', end + 1))
            if (disk_.exists(join_path(root_, path.substr(0, end) + "/.git")))
                return untracked_reason(root_, path).empty();
        return false;
    }

    /// How many files a glob matches.
    size_t take(const SourceGlob& asked) {
        size_t count = 0;
        if (const std::string& path = asked.own_path(); !path.empty()) {
            const TreePath place = scope_.reach == Reach::Beneath ? TreePath{root_, path} : place_of_path(root_, path);
            const FileKind kind = disk_.kind(place);
            if (kind == FileKind::File || kind == FileKind::Other) count += take_file(asked, path, place);
        }
        for (const std::string& folder : asked.glob().roots())
            for (const auto& [file, place] : files_below(folder)) count += take_file(asked, file, place);
        for (const std::string& file : scope_.named) count += take_hidden(asked, file);
        return count;
    }

    size_t take_file(const SourceGlob& asked, const std::string& file, const TreePath& place) {
        if (!asked.takes(file)) return 0;
        found_.emplace(file, place);
        return 1;
    }

    /// A file that no walk has shown, as far as it is there.
    size_t take_hidden(const SourceGlob& asked, const std::string& file) {
        if (found_.contains(file) || !asked.takes(file)) return 0;
        return disk_.kind({root_, file}) == FileKind::None ? 0 : take_file(asked, file, {root_, file});
    }

    const FoundFiles& files_below(const std::string& folder) {
        const auto [files, fresh] = listed_.try_emplace(folder);
        if (!fresh) return files->second;
        const std::string own = scope_.reach == Reach::Anywhere && is_outside(folder) ? folder : "";
        Walker& walker =
            walkers_
                .try_emplace(own, disk_, root_, own, scope_.reach == Reach::Beneath ? scope_.most_entries : kUnbounded)
                .first->second;
        const auto concerns = [&](const std::string& path) {
            return std::any_of(asked_.begin(), asked_.end(), [&](const SourceGlob& asked) {
                return asked.glob().matches(path) || asked.glob().may_match_below(path);
            });
        };
        walker.walk(folder, concerns,
                    [&](const std::string& file) { files->second.emplace(file, walker.place_of(file)); });
        return files->second;
    }

    const Disk& disk_;
    const std::string& root_;
    const std::vector<std::string>& globs_;
    const GlobScope& scope_;
    std::vector<SourceGlob> asked_;
    FoundFiles found_;
    std::map<std::string, FoundFiles> listed_;  ///< by folder
    std::map<std::string, Walker> walkers_;     ///< by the folder that they do not leave, "" for the root
};

}  // namespace

SourceSet read_globs(const Disk& disk, const std::string& root, const std::vector<std::string>& globs,
                     std::vector<std::string>& unmatched, const GlobScope& scope) {
    GlobReader reader(disk, root, globs, scope);
    const std::vector<std::string> idle = reader.unmatched();
    unmatched.insert(unmatched.end(), idle.begin(), idle.end());
    return reader.read();
}

}  // namespace porttool
