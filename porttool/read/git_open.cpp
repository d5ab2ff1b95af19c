// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/git_open.h"

#include <filesystem>

#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

std::string git_last_error() {
    const git_error* error = git_error_last();
    return error != nullptr && error->message != nullptr ? terminal_text(error->message) : "no reason given";
}

OpenedGit open_git(const std::string& root, const std::string& remedy) {
    git_libgit2_init();
    // Objects are only read: that the work tree belongs to another user (as in CI containers) does no harm.
    git_libgit2_opts(GIT_OPT_SET_OWNER_VALIDATION, 0);
    OpenedGit out;
    git_repository* repository = nullptr;
    if (git_repository_open_ext(&repository, root.c_str(), 0, nullptr) != 0) {
        out.error = terminal_text(root) + " is in no git repository that can be read (" + git_last_error() + ")\n" +
                    remedy + ": git -C " + terminal_text(shell_quoted(root)) + " status";
        return out;
    }
    out.repository.reset(repository);
    const char* workdir = git_repository_workdir(repository);
    if (workdir == nullptr) {
        out.error = terminal_text(root) + " is a bare repository; porttool needs a work tree: git worktree add";
        return out;
    }
    std::error_code error;
    const auto below = std::filesystem::relative(std::filesystem::canonical(root, error),
                                                 std::filesystem::canonical(workdir, error), error);
    const std::string path = below.generic_string();
    out.prefix = path == "." || path.empty() ? "" : path + "/";
    return out;
}

}  // namespace porttool
