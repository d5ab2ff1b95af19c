// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/git_repository.h"

#include <algorithm>

#include "porttool/read/git_open.h"

namespace porttool {
namespace {

using Object = GitOwned<git_object, git_object_free>;
using Commit = GitOwned<git_commit, git_commit_free>;
using Tree = GitOwned<git_tree, git_tree_free>;
using Blob = GitOwned<git_blob, git_blob_free>;
using Diff = GitOwned<git_diff, git_diff_free>;

std::string text_of(const git_oid& id) {
    std::string text(GIT_OID_HEXSZ, '0');
    git_oid_fmt(text.data(), &id);
    return text;
}

Commit lookup(git_repository* repository, const std::string& text) {
    const auto id = git_oid_of(text);
    git_commit* commit = nullptr;
    if (!id || git_commit_lookup(&commit, repository, &*id) != 0) return nullptr;
    return Commit(commit);
}

Tree tree_of(git_repository* repository, const std::string& commit_id) {
    const Commit commit = lookup(repository, commit_id);
    git_tree* tree = nullptr;
    if (!commit || git_commit_tree(&tree, commit.get()) != 0) return nullptr;
    return Tree(tree);
}

GitCommit described(git_commit* commit) {
    const char* summary = git_commit_summary(commit);
    return {text_of(*git_commit_id(commit)), git_commit_time(commit), summary != nullptr ? summary : ""};
}

bool is_file(const git_diff_file& file) {
    return file.mode == GIT_FILEMODE_BLOB || file.mode == GIT_FILEMODE_BLOB_EXECUTABLE;
}

}  // namespace

GitRepository::GitRepository(const std::string& root, const std::string& remedy)
    : handle_(std::make_unique<Handle>(Handle{open_git(root, remedy)})) {
    error_ = handle_->opened.error;
}

GitRepository::~GitRepository() = default;

bool GitRepository::is_shallow() const { return git_repository_is_shallow(handle_->repository()) == 1; }

std::string GitRepository::own_folder() const { return git_repository_commondir(handle_->repository()); }

std::string GitRepository::work_tree() const {
    std::string out = git_repository_workdir(handle_->repository());
    if (out.size() > 1 && out.ends_with('/')) out.pop_back();
    return out;
}

bool GitRepository::is_as_committed(const std::string& path) const {
    unsigned flags = 0;
    const std::string within = handle_->opened.prefix + path;
    return git_status_file(&flags, handle_->repository(), within.c_str()) == 0 && flags == GIT_STATUS_CURRENT;
}

const std::string& GitRepository::folder() const { return handle_->opened.prefix; }

std::optional<GitCommit> GitRepository::commit(const std::string& revision) const {
    git_object* found = nullptr;
    if (git_revparse_single(&found, handle_->repository(), (revision + "^{commit}").c_str()) != 0) return std::nullopt;
    const Object owner(found);
    const Commit commit = lookup(handle_->repository(), text_of(*git_object_id(found)));
    if (!commit) return std::nullopt;
    return described(commit.get());
}

bool GitRepository::is_ancestor(const std::string& older, const std::string& newer) const {
    const auto old_id = git_oid_of(older), new_id = git_oid_of(newer);
    if (!old_id || !new_id) return false;
    return older == newer || git_graph_descendant_of(handle_->repository(), &*new_id, &*old_id) == 1;
}

size_t GitRepository::commits_between(const std::string& older, const std::string& newer) const {
    const auto old_id = git_oid_of(older), new_id = git_oid_of(newer);
    size_t ahead = 0, behind = 0;
    if (old_id && new_id) git_graph_ahead_behind(&ahead, &behind, handle_->repository(), &*new_id, &*old_id);
    return ahead;
}

GitChain GitRepository::first_parents(const std::string& newest) const {
    GitChain chain;
    Commit commit = lookup(handle_->repository(), newest);
    while (commit) {
        chain.commits.push_back(described(commit.get()));
        if (git_commit_parentcount(commit.get()) == 0) break;
        git_commit* parent = nullptr;
        chain.cut = git_commit_parent(&parent, commit.get(), 0) != 0;
        commit.reset(parent);
    }
    std::reverse(chain.commits.begin(), chain.commits.end());
    return chain;
}

std::vector<GitChange> GitRepository::changes(const std::string& older, const std::string& newer,
                                              const WantsFile& wants) const {
    std::vector<GitChange> out;
    git_repository* repository = handle_->repository();
    const Tree before = older.empty() ? nullptr : tree_of(repository, older), now = tree_of(repository, newer);
    if (!now) return out;
    const std::string& prefix = handle_->opened.prefix;
    git_diff_options options = GIT_DIFF_OPTIONS_INIT;
    options.flags = GIT_DIFF_DISABLE_PATHSPEC_MATCH | GIT_DIFF_SKIP_BINARY_CHECK;
    std::string folder = prefix;
    char* pathspec = folder.data();
    if (!prefix.empty()) options.pathspec = {&pathspec, 1};
    git_diff* raw = nullptr;
    if (git_diff_tree_to_tree(&raw, repository, before.get(), now.get(), &options) != 0) return out;
    const Diff diff(raw);
    for (size_t i = 0; i < git_diff_num_deltas(raw); ++i) {
        const git_diff_delta* delta = git_diff_get_delta(raw, i);
        const std::string path = delta->new_file.path != nullptr ? delta->new_file.path : delta->old_file.path;
        if (!path.starts_with(prefix)) continue;
        const std::string below = path.substr(prefix.size());
        if (!wants(below)) continue;
        const bool there = delta->status != GIT_DELTA_DELETED && is_file(delta->new_file);
        if (there || is_file(delta->old_file)) out.push_back({below, there ? text_of(delta->new_file.id) : ""});
    }
    std::sort(out.begin(), out.end(), [](const GitChange& a, const GitChange& b) { return a.path < b.path; });
    return out;
}

std::optional<std::string> GitRepository::find_blob(const std::string& text) const {
    const auto id = git_oid_of(text);
    git_blob* blob = nullptr;
    if (!id || git_blob_lookup(&blob, handle_->repository(), &*id) != 0) return std::nullopt;
    const Blob owner(blob);
    return std::string(static_cast<const char*>(git_blob_rawcontent(blob)),
                       static_cast<size_t>(git_blob_rawsize(blob)));
}

}  // namespace porttool
