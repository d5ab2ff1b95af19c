// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/apply.h"

#include "porttool/read/git_repository.h"
#include "porttool/sync/apply_journal.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

constexpr const char* kNoneWritten = "; nothing was written";

std::string shown(const TreePath& place) { return terminal_text(place.path); }

/// Throws unless the file is what the proposals were made for, and may be written.
void require_writable(const WrittenFile& file, const Disk& disk) {
    if (disk.is_read_only(file.place))
        throw CannotDo(shown(file.place) + " is read-only" + kNoneWritten + ". Make it writable: chmod u+w");
    const FileText there = disk.read(file.place, kLargestFile);
    const bool is_new = file.before.empty() && disk.kind(file.place) == FileKind::None;
    if (!is_new && (!there.error.empty() || there.bytes != file.before))
        throw CannotDo(shown(file.place) + (there.error.empty() ? " changed meanwhile" : " " + there.error) +
                       kNoneWritten + ". Run sync again");
}

/// Throws where a file that stands there holds what no commit does, and would be lost.
void require_committed(const WrittenFile& file, const Disk& disk) {
    if (disk.kind(file.place) == FileKind::None) return;
    const size_t slash = file.place.path.find_last_of('/');
    const std::string folder = slash == std::string::npos ? std::string() : file.place.path.substr(0, slash);
    const GitRepository repository(join_path(file.place.root, folder));  // that of a submodule, in one
    if (!repository.error().empty())
        throw CannotDo(shown(file.place) + " is in no git repository, so that its text could be lost" + kNoneWritten +
                       ". To write all the same, add --force");
    if (!repository.is_as_committed(file.place.path.substr(slash + 1)))
        throw CannotDo(shown(file.place) + " has changes that are not committed" + kNoneWritten +
                       ". Commit them, or add --force");
}

}  // namespace

std::vector<WrittenFile> written_files(const ProposedFiles& files, const Project& project) {
    std::vector<WrittenFile> out;
    for (const auto& [place, file] : files)
        out.push_back({{place.is_elsewhere ? target_root(project) : project.root, place.path}, file.before, file.now});
    return out;
}

void require_no_links(const std::vector<WrittenFile>& files, const Disk& disk) {
    for (const WrittenFile& file : files)
        if (lies_behind_link(file.place, disk))
            throw CannotDo(shown(file.place) + " " + kIsLinked + kNoneWritten +
                           ". Name the file itself in portmap.toml");
}

void require_applicable(const std::vector<WrittenFile>& files, bool force, const Disk& disk) {
    require_no_links(files, disk);
    for (const WrittenFile& file : files) {
        require_writable(file, disk);
        if (!force) require_committed(file, disk);
    }
}

void apply(const std::vector<WrittenFile>& files, const std::string& root, bool force, Disk& disk) {
    require_applicable(files, force, disk);
    std::vector<FileToWrite> all;
    for (const WrittenFile& file : files) all.push_back({file.place, file.now});
    ApplyJournal journal(root, disk);
    journal.begin(files);
    const std::string failure = disk.write_all(all);
    journal.end();
    if (!failure.empty()) throw CannotDo(failure + kNoneWritten);
}

}  // namespace porttool
