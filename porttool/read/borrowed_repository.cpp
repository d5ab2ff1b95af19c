// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/borrowed_repository.h"

#include "porttool/read/disk.h"
#include "porttool/read/git_open.h"
#include "porttool/read/source_files.h"

namespace porttool {

std::string borrow_repository(const GitRepository& other, const std::string& folder) {
    const std::optional<GitCommit> head = other.commit("HEAD");
    const auto id = head ? git_oid_of(head->id) : std::nullopt;
    if (!id) return "HEAD names no commit yet; commit once";
    git_repository* made = nullptr;
    if (git_repository_init(&made, folder.c_str(), 0) != 0) return git_last_error();
    git_repository_free(made);
    RealDisk disk;
    const std::string ours = join_path(folder, ".git");
    const std::string objects = join_path(other.own_folder(), "objects") + "\n";
    if (const std::string failure = disk.write(join_path(ours, "objects/info/alternates"), objects); !failure.empty())
        return failure;
    const FileText shallow = disk.read(join_path(other.own_folder(), "shallow"), kLargestFile);
    if (shallow.error.empty()) (void)disk.write(join_path(ours, "shallow"), shallow.bytes);

    const OwnedRepository repository(open_work_tree(ours));
    const OwnedCommit commit = repository ? git_commit_at(repository.get(), *id) : nullptr;
    const OwnedTree tree = commit ? git_tree_of(commit.get()) : nullptr;
    const OwnedIndex index = tree ? git_index_of(repository.get()) : nullptr;
    const bool done = index && git_repository_set_head_detached(repository.get(), &*id) == 0 &&
                      git_index_read_tree(index.get(), tree.get()) == 0 && git_index_write(index.get()) == 0;
    return done ? std::string() : git_last_error();
}

}  // namespace porttool
