// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/lock_store.h"

#include <fmt/format.h>

#include <cerrno>
#include <optional>
#include <set>
#include <vector>

#include "porttool/read/git_repository.h"
#include "porttool/read/lock_upgrade.h"
#include "porttool/read/refusals.h"
#include "porttool/read/source_files.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

constexpr const char* kBase = "portmap.base";

std::string folder_of_map(const Project& project) {
    return project.map_path.substr(0, project.map_path.find_last_of('/') + 1);
}

TreePath base_folder(const Project& project) { return beside_map(project, kBase, Links::None); }

TreePath base_file(const Project& project, Print print) {
    return beside_map(project, kBase + ("/" + print.text()), Links::None);
}

/// A folder of porttool's own: a link in its place would have us read and remove elsewhere.
void require_own_base(const Project& project, const Disk& disk) {
    const FileKind kind = disk.kind(base_folder(project));
    if (kind == FileKind::None || kind == FileKind::Folder) return;
    throw CannotDo(terminal_text(folder_of_map(project)) + kBase +
                   ": is a link, or no folder; porttool keeps its texts in a folder of its own\nRemove it, and restore "
                   "the folder from git, or run: porttool init --force");
}

/// A file of portmap.base/ as it is. A checkout may have given its lines the ends of another system.
std::string read_base(const Project& project, const Disk& disk, Print print) {
    if (!print.is_known()) return {};
    FileText file = disk.read(base_file(project, print), kLargestFile);
    std::erase(file.bytes, '\r');
    return file.error.empty() ? std::move(file.bytes) : std::string();
}

std::set<Print> prints_of(const LockFile& lock) {
    std::set<Print> out;
    for (const LockedPair& pair : lock.pairs)
        for (const Print print : {pair.source_prints.written, pair.target_prints.written}) out.insert(print);
    return out;
}

/// The texts behind prints, as far as they are known.
std::map<Print, const NormalText*> texts_behind(const std::set<Print>& prints, const NewRecord& record) {
    std::map<Print, const NormalText*> out;
    for (const auto* side : {&record.states.source, &record.states.target})
        for (const auto& [id, state] : *side)
            if (prints.contains(state.prints.written)) out.emplace(state.prints.written, &state.text.get());
    for (const auto& [print, text] : record.texts)
        if (prints.contains(print)) out.emplace(print, &text.get());
    return out;
}

}  // namespace

std::string lock_path(const Project& project) { return folder_of_map(project) + "portmap.lock"; }

RecordedLock load_lock(const Project& project, const Disk& disk, const States& today) {
    FileText file = disk.read(beside_map(project, "portmap.lock"), kLargestFile);
    if (file.error == cannot_be_read(EACCES))
        throw CannotDo(terminal_text(lock_path(project)) + " " + file.error + "; make it readable: chmod u+r");
    if (!file.error.empty() && disk.kind(beside_map(project, "portmap.lock")) != FileKind::None)
        throw CannotDo(terminal_text(lock_path(project)) + " " + file.error +
                       "; restore it from git, or remove it and run: porttool init");
    if (!file.error.empty())
        throw CannotDo("no portmap.lock beside " + terminal_text(project.map_path) +
                       "; record the present state of its pairs with: porttool init");
    RecordedLock out = lock_of_today(project, disk, read_lock(file.bytes), today);
    out.written = std::move(file.bytes);
    return out;
}

RecordedLock lock_of_today(const Project& project, const Disk& disk, ReadLock read, const States& today) {
    require_own_base(project, disk);
    if (!read.error.empty()) throw CannotDo(read.error);
    if (!is_outdated(read.lock)) return {std::move(read.lock), "", {}};
    UpgradedLock upgrade = upgraded(std::move(read.lock), [&](Print print) { return read_base(project, disk, print); },
                                    {&today.source, &today.target});
    if (!upgrade.error.empty()) throw CannotDo(upgrade.error);
    return {std::move(upgrade.lock), "", std::move(upgrade.texts)};
}

std::unique_ptr<WriteGuard> guard_lock(const ProjectChoice& choice, Workplace& place) {
    Project project;
    find_map(project, choice, place.disk);
    if (choice.source.empty() && !place.disk.exists(project.map_path)) throw no_map(project);
    TakenGuard taken = place.disk.guard(beside_map(project, "portmap.lock"));
    if (!taken.error.empty()) throw CannotDo(taken.error);
    return std::move(taken.guard);
}

void store_lock(const Project& project, const NewRecord& record, Disk& disk) {
    require_own_base(project, disk);
    if (disk.is_read_only(beside_map(project, "portmap.lock")))
        throw CannotDo(terminal_text(lock_path(project)) +
                       " is read-only; nothing was written. Make it writable: chmod u+w");
    const std::set<Print> needed = prints_of(record.lock);
    std::vector<FileToWrite> files;
    for (const auto& [print, text] : texts_behind(needed, record))
        if (std::string recorded = text->recorded(); read_base(project, disk, print) != recorded)
            files.push_back({base_file(project, print), std::move(recorded)});
    files.push_back({beside_map(project, "portmap.lock"), lock_text(record.lock)});
    if (record.map_text != nullptr) {
        const std::string name = project.map_path.substr(project.map_path.find_last_of('/') + 1);
        files.push_back({beside_map(project, name), *record.map_text});
    }
    const bool makes_folder = disk.kind(base_folder(project)) == FileKind::None;
    if (const std::string failure = disk.write_all(files); !failure.empty()) {
        if (makes_folder) disk.remove(base_folder(project));
        throw CannotDo(failure);
    }
    if (!record.clears) return;
    for (const DirectoryEntry& entry : disk.list(base_folder(project)).entries)
        if (const Print print = Print::read(entry.name); print.is_known() && !needed.contains(print))
            disk.remove(base_file(project, print));
}

namespace {

/// Tells those that a sparse checkout leaves out from those that are gone.
void ask_index(LostTexts& lost, const Project& project) {
    const TreePath folder = base_folder(project);
    if (lost.missing.empty() || folder.root != project.root) return;
    lost.folder = folder.path;
    for (const std::string& name : GitRepository(project.root).left_out_of(folder.path))
        if (const Print print = Print::read(name); lost.missing.erase(print) > 0) lost.left_out.insert(print);
}

}  // namespace

LostTexts missing_texts(const Project& project, const Disk& disk, const LockFile& lock) {
    LostTexts out{prints_of(lock), {}};
    out.missing.erase(Print());
    for (const DirectoryEntry& entry : disk.list(base_folder(project)).entries)
        out.missing.erase(Print::read(entry.name));
    ask_index(out, project);
    return out;
}

LostTexts lost_texts(const Project& project, const Disk& disk, const LockFile& lock) {
    LostTexts out = missing_texts(project, disk, lock);
    uint64_t bytes = 0;
    for (const Print print : prints_of(lock)) {
        if (!print.is_known() || out.missing.contains(print) || out.left_out.contains(print)) continue;
        const std::string recorded = bytes > kMostSourceBytes ? "" : read_base(project, disk, print);
        bytes += recorded.size();
        if (!is_text_of_print(print, recorded)) out.damaged.insert(print);
    }
    return out;
}

std::string told(const LostTexts& lost) {
    std::string out;
    if (!lost.left_out.empty())
        out = fmt::format(
            "warning: {} texts of portmap.base/ are not here, as this is a sparse checkout; to have them, "
            "run: git sparse-checkout add {}\n",
            lost.left_out.size(), terminal_text(shell_word(lost.folder)));
    if (lost.missing.empty() && lost.damaged.empty()) return out;
    out += "warning: ";
    if (!lost.missing.empty())
        out += fmt::format("{} texts are missing in portmap.base/{}", lost.missing.size(),
                           lost.damaged.empty() ? "" : ", ");
    if (!lost.damaged.empty())
        out += fmt::format("{} texts in portmap.base/ are not what their names say (the first is {})",
                           lost.damaged.size(), lost.damaged.begin()->text());
    return out + "; restore them from git, or, while their pairs are in step, run: porttool accept --all\n";
}

NormalText base_text(const Project& project, const Disk& disk, Print print) {
    return text_of_print(print, read_base(project, disk, print), kNormalForm);
}

}  // namespace porttool
