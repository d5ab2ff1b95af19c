// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/apply_journal.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>

#include "porttool/read/git_repository.h"
#include "porttool/read/replace_file.h"
#include "porttool/read/source_files.h"
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

}  // namespace

ApplyJournal::ApplyJournal(const std::string& root, Disk& disk) : disk_(disk) {
    const GitRepository repository(root);
    if (repository.error().empty()) path_ = join_path(repository.own_folder(), "porttool/apply");
}

void ApplyJournal::begin(const std::vector<TreePath>& files) {
    if (path_.empty() || files.size() < 2) return;
    std::string text = std::to_string(::getpid()) + '\0';
    for (const TreePath& file : files) text += file.root + '\0' + file.path + '\0';
    (void)disk_.write(path_, text);  // where that cannot be, the files still can
}

void ApplyJournal::end() {
    if (!path_.empty() && disk_.exists(path_)) (void)disk_.write(path_, "");
}

std::string ApplyJournal::take_interrupted() {
    if (path_.empty() || !disk_.exists(path_)) return {};
    const std::vector<std::string> fields = fields_of(disk_.read(path_, kLargestFile).bytes);
    if (fields.size() < 3 || !is_gone(fields[0])) return {};
    std::vector<TreePath> files;
    std::string out = "an earlier sync --apply was killed while it wrote; some of these files have its text, some not:";
    for (size_t i = 1; i + 1 < fields.size(); i += 2) {
        files.push_back({fields[i], fields[i + 1]});
        out += "\n    " + terminal_text(fields[i + 1]);
    }
    sweep_beside(files);
    end();
    return out +
           "\nSee what came with: git status; take it back with: git checkout and git clean, or go on with sync\n";
}

}  // namespace porttool
