// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/git.h"

#include <git2.h>

#include <filesystem>
#include <memory>

namespace porttool {
namespace {

template <class T, void (*Free)(T*)>
struct Freed {
    void operator()(T* object) const { Free(object); }
};
using Repository = std::unique_ptr<git_repository, Freed<git_repository, git_repository_free>>;
using Object = std::unique_ptr<git_object, Freed<git_object, git_object_free>>;
using Commit = std::unique_ptr<git_commit, Freed<git_commit, git_commit_free>>;
using Tree = std::unique_ptr<git_tree, Freed<git_tree, git_tree_free>>;
using Index = std::unique_ptr<git_index, Freed<git_index, git_index_free>>;
using Blob = std::unique_ptr<git_blob, Freed<git_blob, git_blob_free>>;

std::string last_error() {
    const git_error* error = git_error_last();
    return error != nullptr && error->message != nullptr ? error->message : "no reason given";
}

/// A repository with its work tree's path to the root in question.
struct Opened {
    Repository repository;
    std::string prefix;  ///< "sub/folder/" or ""
    std::string error;
};

Opened open(const std::string& root) {
    git_libgit2_init();
    // Objects are only read: that the work tree belongs to another user (as in CI containers) does no harm.
    git_libgit2_opts(GIT_OPT_SET_OWNER_VALIDATION, 0);
    Opened out;
    git_repository* repository = nullptr;
    if (git_repository_open_ext(&repository, root.c_str(), 0, nullptr) != 0) {
        out.error = root + " is in no git repository that can be read (" + last_error() +
                    ")\nCheck without --base and --staged, or try: git -C '" + root + "' status";
        return out;
    }
    out.repository.reset(repository);
    const char* workdir = git_repository_workdir(repository);
    if (workdir == nullptr) {
        out.error = root + " is a bare repository; porttool needs a work tree: git worktree add";
        return out;
    }
    std::error_code error;
    const auto below = std::filesystem::relative(std::filesystem::canonical(root, error),
                                                 std::filesystem::canonical(workdir, error), error);
    const std::string path = below.generic_string();
    out.prefix = path == "." || path.empty() ? "" : path + "/";
    return out;
}

void add_blob(GitFiles& out, git_repository* repository, const git_oid& id, const std::string& path) {
    git_blob* blob = nullptr;
    if (git_blob_lookup(&blob, repository, &id) != 0) return;
    const Blob owner(blob);
    out.files[path].assign(static_cast<const char*>(git_blob_rawcontent(blob)),
                           static_cast<size_t>(git_blob_rawsize(blob)));
}

struct Walk {
    GitFiles& out;
    git_repository* repository;
    const std::string& prefix;
    const WantsFile& wants;
};

int visit_entry(const char* folder, const git_tree_entry* entry, void* payload) {
    const Walk& walk = *static_cast<Walk*>(payload);
    const std::string path = std::string(folder) + git_tree_entry_name(entry);
    if (git_tree_entry_type(entry) == GIT_OBJECT_TREE) {
        const std::string inside = path + "/";  // skip folders that do not lead to the root or lie below it
        return inside.starts_with(walk.prefix) || walk.prefix.starts_with(inside) ? 0 : 1;
    }
    if (git_tree_entry_type(entry) != GIT_OBJECT_BLOB || !path.starts_with(walk.prefix)) return 0;
    const std::string below = path.substr(walk.prefix.size());
    if (walk.wants(below)) add_blob(walk.out, walk.repository, *git_tree_entry_id(entry), below);
    return 0;
}

}  // namespace

GitFiles files_at_base(const std::string& root, const std::string& revision, const WantsFile& wants) {
    GitFiles out;
    const Opened opened = open(root);
    if (!opened.error.empty()) return {{}, opened.error};
    git_repository* repository = opened.repository.get();
    git_object* found = nullptr;
    if (git_revparse_single(&found, repository, (revision + "^{commit}").c_str()) != 0)
        return {{}, "--base " + revision + ": no such revision here\nFetch it first: git fetch origin " + revision};
    const Object base(found);
    git_oid head{}, merge_base{};
    if (git_reference_name_to_id(&head, repository, "HEAD") != 0)
        return {{}, "HEAD names no commit yet; commit once, or check without --base"};
    if (git_merge_base(&merge_base, repository, git_object_id(base.get()), &head) != 0)
        return {{},
                "--base " + revision +
                    ": no common ancestor with HEAD is here, as in a shallow clone\nFetch the history: git fetch "
                    "--unshallow (in CI: fetch-depth: 0)"};
    git_commit* commit = nullptr;
    if (git_commit_lookup(&commit, repository, &merge_base) != 0)
        return {{}, "the merge base cannot be read: " + last_error()};
    const Commit commit_owner(commit);
    git_tree* tree = nullptr;
    if (git_commit_tree(&tree, commit) != 0) return {{}, "the merge base cannot be read: " + last_error()};
    const Tree tree_owner(tree);
    Walk walk{out, repository, opened.prefix, wants};
    git_tree_walk(tree, GIT_TREEWALK_PRE, visit_entry, &walk);
    return out;
}

GitFiles files_in_index(const std::string& root, const WantsFile& wants) {
    GitFiles out;
    const Opened opened = open(root);
    if (!opened.error.empty()) return {{}, opened.error};
    git_index* index = nullptr;
    if (git_repository_index(&index, opened.repository.get()) != 0)
        return {{}, "the index cannot be read: " + last_error()};
    const Index owner(index);
    for (size_t i = 0; i < git_index_entrycount(index); ++i) {
        const git_index_entry* entry = git_index_get_byindex(index, i);
        const std::string path = entry->path;
        if (!path.starts_with(opened.prefix)) continue;
        const std::string below = path.substr(opened.prefix.size());
        if (wants(below)) add_blob(out, opened.repository.get(), entry->id, below);
    }
    return out;
}

}  // namespace porttool
