// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/git_links.h"

#include <deque>
#include <vector>

#include "porttool/read/disk.h"
#include "porttool/read/glob.h"

namespace porttool {
namespace {

using EntryKind = GitEntry::Kind;
using Names = std::deque<std::string>;

constexpr int kMostLinks = 40;  // as in the kernel

EntryKind kind_of(git_filemode_t mode) {
    if (mode == GIT_FILEMODE_LINK) return EntryKind::Link;
    if (mode == GIT_FILEMODE_COMMIT) return EntryKind::Submodule;
    return mode == GIT_FILEMODE_TREE ? EntryKind::Folder : EntryKind::File;
}

Names names_of(const std::string& path) {
    const auto parts = split_path(path);
    return {parts.begin(), parts.end()};
}

/// Goes along a path by single names.
class LinkWalk {
public:
    LinkWalk(git_repository* repository, const GitEntryAt& at, EntryCount& steps)
        : repository_(repository), at_(at), steps_(steps) {}

    GitPlace run(const std::string& path) {
        ahead_ = names_of(path);
        place_.entry.kind = EntryKind::Folder;
        while (!ahead_.empty() && step()) continue;
        for (const std::string& name : behind_) place_.path += (place_.path.empty() ? "" : "/") + name;
        return std::move(place_);
    }

private:
    /// False at the end of what is known.
    bool step() {
        steps_.add(1);
        const std::string name = std::move(ahead_.front());
        ahead_.pop_front();
        if (name == "..") return up();
        behind_.push_back(name);
        std::string path;
        for (const std::string& part : behind_) path += (path.empty() ? "" : "/") + part;
        place_.entry = path.size() > kLongestGitPath ? GitEntry{} : at_(path);
        if (place_.entry.kind == EntryKind::Link) return follow();
        if (place_.entry.kind == EntryKind::Submodule && !ahead_.empty()) return leave();
        return place_.entry.kind == EntryKind::Folder || ahead_.empty() ? true : end();
    }

    bool up() {
        if (behind_.empty()) return leave();
        behind_.pop_back();
        place_.entry = {EntryKind::Folder, {}};
        return true;
    }

    bool follow() {
        place_.by_link = true;
        behind_.pop_back();
        const auto blob = read_git_blob(repository_, place_.entry.id);
        if (!blob || blob->bytes.size() > kLongestGitPath || ++links_ > kMostLinks) return end();
        std::string target = blob->bytes;
        if (target.starts_with('/')) {
            const char* work_tree = git_repository_workdir(repository_);
            if (work_tree == nullptr || !target.starts_with(work_tree)) return leave();
            target.erase(0, std::string_view(work_tree).size());
            behind_.clear();
        }
        const Names names = names_of(target);
        ahead_.insert(ahead_.begin(), names.begin(), names.end());
        place_.entry = {EntryKind::Folder, {}};
        return true;
    }

    bool leave() {
        place_.is_elsewhere = true;
        return end();
    }
    bool end() {
        place_.entry = {};
        return false;
    }

    git_repository* repository_;
    const GitEntryAt& at_;
    EntryCount& steps_;
    GitPlace place_;
    Names ahead_;
    std::vector<std::string> behind_;  ///< the names without a link
    int links_ = 0;
};

}  // namespace

GitEntryAt entries_of_tree(const git_tree* tree) {
    return [tree](const std::string& path) {
        git_tree_entry* entry = nullptr;
        if (git_tree_entry_bypath(&entry, tree, path.c_str()) != 0) {
            tell_refused_object();
            return GitEntry{};
        }
        const GitOwned<git_tree_entry, git_tree_entry_free> owner(entry);
        return GitEntry{kind_of(git_tree_entry_filemode(entry)), *git_tree_entry_id(entry)};
    };
}

GitEntryAt entries_of_index(git_index* index) {
    return [index](const std::string& path) {
        if (const git_index_entry* entry = git_index_get_bypath(index, path.c_str(), 0))
            return GitEntry{kind_of(static_cast<git_filemode_t>(entry->mode)), entry->id};
        size_t first = 0;
        const bool is_folder = git_index_find_prefix(&first, index, (path + "/").c_str()) == 0;
        return GitEntry{is_folder ? EntryKind::Folder : EntryKind::None, {}};
    };
}

GitPlace follow_git_links(git_repository* repository, const GitEntryAt& at, EntryCount& steps,
                          const std::string& path) {
    return LinkWalk(repository, at, steps).run(path);
}

}  // namespace porttool
