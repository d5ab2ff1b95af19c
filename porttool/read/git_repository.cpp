// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/git_repository.h"

#include <algorithm>
#include <cstring>
#include <queue>
#include <unordered_map>

#include "porttool/read/git_open.h"

namespace porttool {
namespace {

std::string text_of(const git_oid& id) {
    std::string text(GIT_OID_HEXSZ, '0');
    git_oid_fmt(text.data(), &id);
    return text;
}

/// The beginning of what a commit says, whose author may have said megabytes.
std::string beginning_of(const char* message) {
    constexpr size_t kLongest = 4096;
    return message == nullptr ? std::string() : std::string(message, ::strnlen(message, kLongest));
}

OwnedCommit lookup(git_repository* repository, const std::string& text) {
    const auto id = git_oid_of(text);
    OwnedCommit commit = id ? git_commit_at(repository, *id) : nullptr;
    if (id && !commit) tell_refused_object();
    return commit;
}

OwnedTree tree_of(git_repository* repository, const std::string& commit_id) {
    const OwnedCommit commit = lookup(repository, commit_id);
    OwnedTree tree = commit ? git_tree_of(commit.get()) : nullptr;
    if (commit && !tree) tell_refused_object();
    return tree;
}

GitCommit described(git_commit* commit) {
    return {text_of(*git_commit_id(commit)), git_commit_time(commit), beginning_of(git_commit_summary(commit))};
}

OwnedTree tree_at(git_repository* repository, const git_oid& id) {
    OwnedTree tree = git_tree_at(repository, id);
    if (!tree) tell_refused_object();
    return tree;
}

/// The tree of a folder ("sub/folder/") within another; nothing where it has none.
OwnedTree folder_of(git_repository* repository, const git_tree* tree, const std::string& folder) {
    git_tree_entry* entry = nullptr;
    if (tree == nullptr || git_tree_entry_bypath(&entry, tree, folder.substr(0, folder.size() - 1).c_str()) != 0) {
        tell_refused_object();
        return nullptr;
    }
    const GitOwned<git_tree_entry, git_tree_entry_free> owner(entry);
    return git_tree_entry_type(entry) == GIT_OBJECT_TREE ? tree_at(repository, *git_tree_entry_id(entry)) : nullptr;
}

/// What differs between two trees. Folders that are equal are not looked into, so that a commit of a large tree costs
/// what it changes (a diff of libgit2 costs several times as much).
class TreeComparison {
public:
    TreeComparison(git_repository* repository, const std::string& commit, const WantsFile& wants)
        : repository_(repository), wants_(wants), entries_("commit " + commit) {}

    std::vector<GitChange> out;

    /// Either may be nothing. `path`: of the folder, "" or with a slash at its end.
    void compare(const git_tree* before, const git_tree* now, const std::string& path) {
        if (path.size() > kLongestGitPath) return;
        const size_t before_count = before == nullptr ? 0 : git_tree_entrycount(before);
        const size_t now_count = now == nullptr ? 0 : git_tree_entrycount(now);
        entries_.add(before_count + now_count);
        for (size_t i = 0, k = 0; i < before_count || k < now_count;) {
            const git_tree_entry* old_one = i < before_count ? git_tree_entry_byindex(before, i) : nullptr;
            const git_tree_entry* new_one = k < now_count ? git_tree_entry_byindex(now, k) : nullptr;
            int order = old_one == nullptr ? 1 : -1;
            if (old_one != nullptr && new_one != nullptr) order = git_tree_entry_cmp(old_one, new_one);
            if (order > 0) old_one = nullptr;
            if (order < 0) new_one = nullptr;
            i += old_one != nullptr ? 1 : 0;
            k += new_one != nullptr ? 1 : 0;
            if (order != 0 || !is_same(old_one, new_one)) note(old_one, new_one, path);
        }
    }

private:
    static bool is_same(const git_tree_entry* a, const git_tree_entry* b) {
        return git_oid_equal(git_tree_entry_id(a), git_tree_entry_id(b)) != 0 &&
               git_tree_entry_filemode(a) == git_tree_entry_filemode(b);
    }

    static bool is_file(const git_tree_entry* entry) {
        if (entry == nullptr) return false;
        const git_filemode_t mode = git_tree_entry_filemode(entry);
        return mode == GIT_FILEMODE_BLOB || mode == GIT_FILEMODE_BLOB_EXECUTABLE;
    }

    OwnedTree folder(const git_tree_entry* entry) const {
        const bool is_folder = entry != nullptr && git_tree_entry_type(entry) == GIT_OBJECT_TREE;
        return is_folder ? tree_at(repository_, *git_tree_entry_id(entry)) : nullptr;
    }

    void note(const git_tree_entry* before, const git_tree_entry* now, const std::string& path) {
        const std::string name = path + git_tree_entry_name(now != nullptr ? now : before);
        const OwnedTree old_folder = folder(before), new_folder = folder(now);
        if (old_folder || new_folder) {
            compare(old_folder.get(), new_folder.get(), name + "/");
        } else if ((is_file(before) || is_file(now)) && wants_(name)) {
            const auto blob = [](const git_tree_entry* entry) {
                return is_file(entry) ? text_of(*git_tree_entry_id(entry)) : std::string();
            };
            out.push_back({name, blob(now), blob(before)});
        }
    }

    git_repository* repository_;
    const WantsFile& wants_;
    EntryCount entries_;
};

/// A commit that is to be given out once all that were made from it are.
struct Waiting {
    GitStep step;
    std::vector<std::string> parents = {};
};

/// A commit and all that went into it; nothing of an empty id.
std::set<std::string> ancestors_of(git_repository* repository, const std::string& id) {
    std::set<std::string> seen;
    std::vector<std::string> open;
    if (!id.empty()) open.push_back(id);
    while (!open.empty()) {
        const std::string next = std::move(open.back());
        open.pop_back();
        if (!seen.insert(next).second) continue;
        const OwnedCommit commit = lookup(repository, next);
        for (unsigned i = 0; commit && i < git_commit_parentcount(commit.get()); ++i)
            open.push_back(text_of(*git_commit_parent_id(commit.get(), i)));
    }
    return seen;
}

bool is_here(git_repository* repository, const std::string& id) { return lookup(repository, id) != nullptr; }

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

std::string GitRepository::index_file() const {
    return std::string(git_repository_path(handle_->repository())) + "index";
}

bool GitRepository::is_as_committed(const std::string& path) const {
    unsigned flags = 0;
    const std::string within = handle_->opened.prefix + path;
    const bool is_known = git_status_file(&flags, handle_->repository(), within.c_str()) == 0;
    tell_refused_object();
    return is_known && flags == GIT_STATUS_CURRENT;
}

const std::string& GitRepository::folder() const { return handle_->opened.prefix; }

std::optional<GitCommit> GitRepository::commit(const std::string& revision) const {
    git_object* found = nullptr;
    const bool is_there = git_revparse_single(&found, handle_->repository(), (revision + "^{commit}").c_str()) == 0;
    tell_refused_object();
    if (!is_there) return std::nullopt;
    const OwnedObject owner(found);
    const OwnedCommit commit = lookup(handle_->repository(), text_of(*git_object_id(found)));
    if (!commit) return std::nullopt;
    return described(commit.get());
}

bool GitRepository::is_ancestor(const std::string& older, const std::string& newer) const {
    const auto old_id = git_oid_of(older), new_id = git_oid_of(newer);
    if (!old_id || !new_id) return false;
    const bool is_older = older == newer || git_graph_descendant_of(handle_->repository(), &*new_id, &*old_id) == 1;
    tell_refused_object();
    return is_older;
}

size_t GitRepository::commits_between(const std::string& older, const std::string& newer) const {
    const auto old_id = git_oid_of(older), new_id = git_oid_of(newer);
    size_t ahead = 0, behind = 0;
    if (old_id && new_id) git_graph_ahead_behind(&ahead, &behind, handle_->repository(), &*new_id, &*old_id);
    tell_refused_object();
    return ahead;
}

GitChain GitRepository::first_parents(const std::string& newest) const {
    GitChain chain;
    OwnedCommit commit = lookup(handle_->repository(), newest);
    while (commit) {
        chain.commits.push_back(described(commit.get()));
        if (git_commit_parentcount(commit.get()) == 0) break;
        git_commit* parent = nullptr;
        chain.cut = git_commit_parent(&parent, commit.get(), 0) != 0;
        tell_refused_object();
        commit.reset(parent);
    }
    std::reverse(chain.commits.begin(), chain.commits.end());
    return chain;
}

GitSteps GitRepository::steps(const std::string& newest, const std::string& hidden) const {
    git_repository* repository = handle_->repository();
    std::set<std::string> seen = ancestors_of(repository, hidden);
    std::unordered_map<std::string, size_t> children;  // that are not given out yet
    std::unordered_map<std::string, Waiting> found;
    GitSteps out;
    std::vector<std::string> open = {newest};
    while (!open.empty()) {
        const std::string id = std::move(open.back());
        open.pop_back();
        if (!seen.insert(id).second) continue;
        const OwnedCommit commit = lookup(repository, id);
        if (!commit) {
            out.cut = true;
            continue;
        }
        Waiting one;
        one.step = {described(commit.get()), beginning_of(git_commit_message(commit.get())), "",
                    git_commit_parentcount(commit.get())};
        for (unsigned i = 0; i < one.step.parents; ++i) {
            one.parents.push_back(text_of(*git_commit_parent_id(commit.get(), i)));
            ++children[one.parents.back()];
            open.push_back(one.parents.back());
        }
        if (!one.parents.empty()) one.step.parent = one.parents.front();
        found.emplace(id, std::move(one));
    }
    using Dated = std::pair<int64_t, std::string>;
    std::priority_queue<Dated> ready;
    if (found.contains(newest)) ready.emplace(found[newest].step.commit.time, newest);
    while (!ready.empty()) {
        Waiting one = std::move(found[ready.top().second]);
        ready.pop();
        bool here = true;
        for (const std::string& parent : one.parents) {
            const auto known = found.find(parent);
            here = here && (known != found.end() || is_here(repository, parent));
            if (--children[parent] == 0 && known != found.end()) ready.emplace(known->second.step.commit.time, parent);
        }
        if (here) out.steps.push_back(std::move(one.step));
    }
    return out;
}

std::vector<GitChange> GitRepository::changes(const std::string& older, const std::string& newer,
                                              const WantsFile& wants) const {
    git_repository* repository = handle_->repository();
    const OwnedTree now = tree_of(repository, newer);
    if (!now) return {};
    const OwnedTree before = older.empty() ? nullptr : tree_of(repository, older);
    const std::string& prefix = handle_->opened.prefix;
    TreeComparison comparison(repository, newer, wants);
    if (prefix.empty())
        comparison.compare(before.get(), now.get(), "");
    else
        comparison.compare(folder_of(repository, before.get(), prefix).get(),
                           folder_of(repository, now.get(), prefix).get(), "");
    std::sort(comparison.out.begin(), comparison.out.end(),
              [](const GitChange& a, const GitChange& b) { return a.path < b.path; });
    return std::move(comparison.out);
}

std::optional<std::string> GitRepository::find_blob(const std::string& text) const {
    const auto id = git_oid_of(text);
    auto blob = id ? read_git_blob(handle_->repository(), *id) : std::nullopt;
    if (!blob) return std::nullopt;
    if (blob->size > kLargestFile) return std::string(kLargestSource + 1, '\0');
    return std::move(blob->bytes);
}

}  // namespace porttool
