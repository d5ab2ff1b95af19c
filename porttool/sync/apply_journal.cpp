// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/apply_journal.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "porttool/read/git_repository.h"
#include "porttool/read/replace_file.h"
#include "porttool/read/source_files.h"
#include "porttool/text/fingerprint.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// Fields end with a NUL, which no path has.
std::vector<std::string> fields_of(const std::string& text) {
    std::vector<std::string> out;
    for (size_t at = 0; at < text.size();) {
        const size_t end = text.find('\0', at);
        if (end == std::string::npos) return {};
        out.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    return out;
}

bool is_gone(const std::string& process) {
    const long number = std::strtol(process.c_str(), nullptr, 10);
    return number > 0 && ::kill(static_cast<pid_t>(number), 0) != 0 && errno == ESRCH;
}

constexpr const char* kNoFile = "-";

/// True for the same folder, by whatever name.
bool is_root_of_ours(const std::string& root, const std::vector<std::string>& roots) {
    std::error_code error;
    return std::any_of(roots.begin(), roots.end(), [&](const std::string& one) {
        return one == root || std::filesystem::equivalent(one, root, error);
    });
}

std::string print_of(const std::string& bytes) { return std::to_string(hash_text(bytes)); }

}  // namespace

ApplyJournal::ApplyJournal(const std::string& root, Disk& disk) : disk_(disk) {
    const GitRepository repository(root);
    if (repository.error().empty()) note_ = {repository.own_folder(), "porttool/apply", Links::None};
}

void ApplyJournal::begin(const std::vector<WrittenFile>& files) {
    if (note_.root.empty() || files.size() < 2) return;
    std::string text = std::to_string(::getpid()) + '\0';
    for (const WrittenFile& file : files)
        text +=
            file.place.root + '\0' + file.place.path + '\0' + print_now(file.place) + '\0' + print_of(file.now) + '\0';
    (void)disk_.write(note_, text);  // where that cannot be, the files still can
}

void ApplyJournal::end() {
    if (!note_.root.empty() && disk_.kind(note_) == FileKind::File) (void)disk_.write(note_, "");
}

std::string ApplyJournal::print_now(const TreePath& place) const {
    if (disk_.kind(place) == FileKind::None) return kNoFile;
    const FileText text = disk_.read(place, kLargestFile);
    return text.error.empty() ? print_of(text.bytes) : "?";
}

std::vector<ApplyJournal::Noted> ApplyJournal::noted(const std::vector<std::string>& fields) {
    constexpr size_t kEach = 4;
    std::vector<Noted> out;
    for (size_t i = 1; i + kEach <= fields.size(); i += kEach)
        out.push_back({{fields[i], fields[i + 1]}, fields[i + 2], fields[i + 3]});
    return out;
}

bool ApplyJournal::finish(const std::vector<Noted>& files, int process) {
    std::vector<std::pair<const Noted*, std::string>> rest;  // and what lies beside it
    for (const Noted& file : files) {
        const std::string print = print_now(file.place);
        if (print == file.now) continue;
        const std::string beside = temporary_left(file.place, process);
        const size_t slash = file.place.path.find_last_of('/') + 1;  // 0 for none
        const TreePath there{file.place.root, file.place.path.substr(0, slash) + beside};
        if (print != file.before || beside.empty() || print_now(there) != file.now) return false;
        rest.emplace_back(&file, beside);
    }
    return std::all_of(rest.begin(), rest.end(),
                       [](const auto& one) { return take_temporary(one.first->place, one.second).empty(); });
}

ApplyJournal::Interrupted ApplyJournal::take_interrupted(const std::vector<std::string>& roots) {
    if (note_.root.empty() || disk_.kind(note_) != FileKind::File) return {};
    const std::vector<std::string> fields = fields_of(disk_.read(note_, kLargestFile).bytes);
    const std::vector<Noted> files = fields.empty() ? std::vector<Noted>() : noted(fields);
    const bool is_ours = std::all_of(files.begin(), files.end(),
                                     [&](const Noted& file) { return is_root_of_ours(file.place.root, roots); });
    if (files.empty() || !is_ours || !is_gone(fields[0])) return {};
    const auto is_as_before = [&](const Noted& file) { return print_now(file.place) == file.before; };
    const bool none_written = std::all_of(files.begin(), files.end(), is_as_before);
    const bool finished = !none_written && finish(files, static_cast<int>(std::strtol(fields[0].c_str(), nullptr, 10)));
    std::vector<TreePath> places;
    std::string names;
    for (const Noted& file : files) {
        places.push_back(file.place);
        names += "\n    " + terminal_text(file.place.path);
    }
    sweep_beside(places);
    end();
    if (none_written) return {};
    const std::string killed = "an earlier sync --apply was killed while it wrote; ";
    if (finished) return {killed + "what it had left is written now:" + names + "\n", true};
    return {killed + "some of these files have its text, some not:" + names +
                "\nSee what came with: git status; take it back with: git checkout and git clean, or go on with sync\n",
            false};
}

}  // namespace porttool
