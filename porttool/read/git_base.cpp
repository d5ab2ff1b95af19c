// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/git_base.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/read/git_links.h"
#include "porttool/read/git_repository.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

/// How to get a revision that is not here. Of a shallow clone all is missing that HEAD~1 and its like are counted from.
std::string fetch_command(const std::string& revision, bool is_shallow) {
    const std::string remote = "origin/";
    if (is_shallow && revision.find_first_of("~^@:") != std::string::npos)
        return "git fetch --unshallow (in CI: fetch-depth: 0)";
    if (revision.starts_with('-')) return "git fetch origin";  // no option to git
    if (revision.starts_with(remote)) return "git fetch origin " + shell_word(revision.substr(remote.size()));
    return "git fetch origin " + shell_word(revision) + ", and then use --base FETCH_HEAD";
}

/// The references that the name in front of a revision may mean, where these are several commits: git takes the first,
/// and so whoever may push a tag `origin/main` would choose what a change is held against.
std::vector<std::string> other_meanings(git_repository* repository, const std::string& revision) {
    const std::string name = revision.substr(0, std::min({revision.find_first_of("~^:"), revision.find("@{")}));
    std::vector<std::string> found;
    std::set<std::string> commits;
    for (const std::string in : {"", "refs/", "refs/tags/", "refs/heads/", "refs/remotes/"}) {
        git_reference* reference = nullptr;
        if (git_reference_lookup(&reference, repository, (in + name).c_str()) != 0) continue;
        const GitOwned<git_reference, git_reference_free> owner(reference);
        git_object* commit = nullptr;
        if (git_reference_peel(&commit, reference, GIT_OBJECT_COMMIT) != 0) {
            tell_refused_object();
            continue;
        }
        const OwnedObject object(commit);
        found.push_back(in + name);
        commits.insert(git_oid_tostr_s(git_object_id(commit)));
    }
    return commits.size() > 1 ? found : std::vector<std::string>();
}

/// True if a commit can be reached from another by what is here. Unlike git, libgit2 takes the parents that a shallow
/// clone left out for an error, and so finds no merge base where that is the oldest commit of the clone.
bool is_reached(git_repository* repository, const git_oid& wanted, const git_oid& from) {
    const auto before = [](const git_oid& a, const git_oid& b) { return git_oid_cmp(&a, &b) < 0; };
    std::set<git_oid, decltype(before)> seen({from}, before);
    std::vector<git_oid> open = {from};
    while (!open.empty()) {
        const git_oid at = open.back();
        open.pop_back();
        if (git_oid_equal(&at, &wanted) != 0) return true;
        const OwnedCommit commit = git_commit_at(repository, at);
        if (!commit) {
            tell_refused_object();
            continue;
        }
        for (unsigned k = 0; k < git_commit_parentcount(commit.get()); ++k)
            if (const git_oid& parent = *git_commit_parent_id(commit.get(), k); seen.insert(parent).second)
                open.push_back(parent);
    }
    return false;
}

MergeBase no_base(std::string error) { return {{}, std::move(error)}; }
MergeBase unknown_revision(std::string error) { return {{}, std::move(error), {}, true}; }

/// That of the repository by itself.
MergeBase own_merge_base(git_repository* repository, const std::string& revision) {
    git_oid head{};
    MergeBase out;
    if (git_reference_name_to_id(&head, repository, "HEAD") != 0)
        return unknown_revision("HEAD names no commit yet; commit once, or check without --base");
    if (const std::vector<std::string> all = other_meanings(repository, revision); !all.empty())
        return no_base("--base " + terminal_text(revision) + ": " +
                       terminal_text(fmt::format("{}", fmt::join(all, " and "))) +
                       " are several commits\nWrite out the one that is meant");
    git_object* found = nullptr;
    const bool is_there = git_revparse_single(&found, repository, (revision + "^{commit}").c_str()) == 0;
    tell_refused_object();
    const bool is_shallow = git_repository_is_shallow(repository) != 0;
    if (!is_there)
        return unknown_revision("--base " + terminal_text(revision) + ": no such revision here\nFetch it first: " +
                                terminal_text(fetch_command(revision, is_shallow)));
    const OwnedObject base(found);
    if (is_shallow && is_reached(repository, *git_object_id(base.get()), head)) {
        out.commit = *git_object_id(base.get());
    } else if (git_merge_base(&out.commit, repository, git_object_id(base.get()), &head) != 0) {
        tell_refused_object();
        return no_base("--base " + terminal_text(revision) +
                       ": no common ancestor with HEAD is here, as in a shallow clone\nFetch the history: git fetch "
                       "--unshallow (in CI: fetch-depth: 0)");
    }
    return out;
}

/// The tree of a commit; none if it is not here.
OwnedTree tree_of_commit(git_repository* repository, const git_oid& id) {
    const OwnedCommit commit = git_commit_at(repository, id);
    return commit ? git_tree_of(commit.get()) : nullptr;
}

/// What a commit has at a path that passes no link.
GitEntry entry_at(git_repository* repository, const git_oid& commit, const std::string& path) {
    const OwnedTree tree = tree_of_commit(repository, commit);
    return tree == nullptr ? GitEntry{} : entries_of_tree(tree.get())(path);
}

/// What the repository around a submodule says of it.
struct AroundModule {
    std::string folder;  ///< the submodule's own
    GitEntry then, now;  ///< at the merge base, and at HEAD
    std::string error = {};
    bool knows_revision = true;  ///< false: `then` says nothing
};

/// None where a work tree lies in no other, or is no submodule of it.
std::optional<AroundModule> around_module(git_repository* repository, const std::string& revision) {
    const char* work_tree = git_repository_workdir(repository);
    if (work_tree == nullptr) return std::nullopt;
    const std::filesystem::path own = std::filesystem::path(work_tree).parent_path();  // without the slash at its end
    if (own == own.parent_path()) return std::nullopt;
    const OpenedGit around = open_git(own.parent_path().string(), kChecksWithGit);
    if (around.repository == nullptr || !around.error.empty()) return std::nullopt;
    const std::string path = around.prefix + own.filename().string();
    AroundModule out{own.string(), {}, {}};
    git_oid head{};
    if (git_reference_name_to_id(&head, around.repository.get(), "HEAD") != 0) return std::nullopt;
    out.now = entry_at(around.repository.get(), head, path);
    const MergeBase base = merge_base_with(around.repository.get(), revision);
    if (base.error.empty()) {
        out.then = entry_at(around.repository.get(), base.commit, path);
    } else if (!base.is_unknown && out.now.kind == GitEntry::Kind::Submodule) {
        out.error = "in the repository around " + terminal_text(out.folder) + ": " + base.error;
        return out;
    } else if (out.now.kind == GitEntry::Kind::Submodule) {
        out.knows_revision = false;
        return out;
    }
    return out.then.kind == GitEntry::Kind::Submodule ? std::optional(std::move(out)) : std::nullopt;
}

std::string short_id(const git_oid& id) { return std::string(git_oid_tostr_s(&id)).substr(0, 12); }

/// The commit that the repository around a submodule named of it.
MergeBase base_of_module(git_repository* repository, const AroundModule& around, const std::string& revision) {
    const std::string module = terminal_text(around.folder), commit = short_id(around.then.id);
    if (around.now.kind != GitEntry::Kind::Submodule)
        return no_base(module + " was a submodule at the merge base of " + terminal_text(revision) +
                       ", and the repository around it has none there now\nPut it back, or check that repository");
    if (tree_of_commit(repository, around.then.id) == nullptr)
        return no_base("the submodule " + module + " was at commit " + commit + " at the merge base of " +
                       terminal_text(revision) +
                       ", which is not in the repository that is there now\nFetch it: git -C " +
                       terminal_text(shell_quoted(around.folder)) + " fetch origin " +
                       git_oid_tostr_s(&around.then.id) + "; a repository that has it not is another one");
    MergeBase out{around.then.id};
    out.note = "note: " + module + " is held against " + commit +
               ", which the repository around it names at the merge base of " + terminal_text(revision);
    return out;
}

}  // namespace

MergeBase merge_base_with(git_repository* repository, const std::string& revision) {
    const std::optional<AroundModule> around = around_module(repository, revision);
    if (around && !around->error.empty()) return no_base(around->error);
    if (around && !around->knows_revision) {
        MergeBase own = own_merge_base(repository, revision);
        if (own.error.empty())
            own.note = "note: " + terminal_text(revision) + " is a name that the submodule " +
                       terminal_text(around->folder) +
                       " knows and the repository around it does not, so that another commit or repository in its "
                       "place is not seen; give --base a revision that both know, or check the repository around it";
        return own;
    }
    if (around && (around->now.kind != GitEntry::Kind::Submodule || !git_oid_equal(&around->then.id, &around->now.id)))
        return base_of_module(repository, *around, revision);
    MergeBase own = own_merge_base(repository, revision);
    return around && own.is_unknown ? base_of_module(repository, *around, revision) : own;
}

FolderAtBase GitRepository::folder_at_base(const std::string& revision, const std::string& path,
                                           const std::string& mark) const {
    if (!error_.empty()) return {error_};
    git_repository* repository = handle_->repository();
    const MergeBase base = merge_base_with(repository, revision);
    if (!base.error.empty()) return {base.error};
    const OwnedTree tree = tree_of_commit(repository, base.commit);
    if (tree == nullptr) return {git_last_error()};
    const GitEntryAt at = entries_of_tree(tree.get());
    EntryCount entries("the merge base");
    const auto place_of = [&](const std::string& one) {
        return follow_git_links(repository, at, entries, folder() + one);
    };
    const GitPlace place = place_of(path);
    FolderAtBase out;
    out.is_there = place.entry.kind == GitEntry::Kind::Folder;
    out.path = place.path;
    std::string one = path;
    while (true) {
        const std::string before = one.empty() ? "" : one + "/";
        if (place_of(before + mark).entry.kind == GitEntry::Kind::File) out.marked.insert(one);
        if (const GitPlace here = place_of(one); here.entry.kind == GitEntry::Kind::Submodule)
            out.module = {one, here.path};
        if (one.empty()) return out;
        const size_t slash = one.find_last_of('/');
        one.erase(slash == std::string::npos ? 0 : slash);
    }
}

std::vector<std::string> GitRepository::links_for_folders(const std::string& revision) const {
    std::vector<std::string> out;
    const OwnedIndex index = error_.empty() ? git_index_of(handle_->repository()) : nullptr;
    if (!index) return out;
    std::vector<std::string> links;
    for (size_t i = 0; i < git_index_entrycount(index.get()); ++i)
        if (const git_index_entry* entry = git_index_get_byindex(index.get(), i); entry->mode == GIT_FILEMODE_LINK)
            links.emplace_back(entry->path);
    if (links.empty()) return out;
    const MergeBase base = merge_base_with(handle_->repository(), revision);
    const OwnedTree tree = base.error.empty() ? tree_of_commit(handle_->repository(), base.commit) : nullptr;
    if (tree == nullptr) return out;
    const GitEntryAt at = entries_of_tree(tree.get());
    for (std::string& link : links)
        if (const auto kind = at(link).kind; kind == GitEntry::Kind::Folder || kind == GitEntry::Kind::Submodule)
            out.push_back(std::move(link));
    return out;
}

}  // namespace porttool
