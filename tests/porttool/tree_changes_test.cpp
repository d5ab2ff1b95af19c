// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What changed between two commits, against git's own word for it.
#include <fstream>
#include <random>
#include <sstream>

#include "porttool/read/git_repository.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::tree_changes_test {
namespace {

namespace fs = std::filesystem;

class TreeChanges : public TemporaryRepository {
protected:
    /// Path to blob ("" where it is gone), of files alone, as `git diff-tree` has it.
    std::map<std::string, std::string> by_git(const std::string& older, const std::string& newer,
                                              const std::string& folder) {
        const std::string command = "diff-tree -r --no-renames --raw --no-abbrev " + older + " " + newer;
        EXPECT_EQ(std::system(("cd '" + root.string() + "' && git " + command + " > .git/diff.txt").c_str()), 0);
        std::map<std::string, std::string> changes;
        std::ifstream file(root / ".git/diff.txt");
        for (std::string line; std::getline(file, line);) {
            std::istringstream words(line.substr(1, line.find('\t') - 1));
            std::string old_mode, new_mode, old_blob, new_blob;
            words >> old_mode >> new_mode >> old_blob >> new_blob;
            const std::string path = line.substr(line.find('\t') + 1);
            if (!path.starts_with(folder)) continue;
            const bool was = old_mode.starts_with("100"), is = new_mode.starts_with("100");
            if (was || is) changes[path.substr(folder.size())] = is ? new_blob : "";
        }
        return changes;
    }

    /// Files, folders in the place of files and the other way round, links, and a submodule.
    void edit(std::mt19937& random) {
        const auto name = [&] { return std::string(1, "abc"[random() % 3]) + (random() % 3 == 0 ? ".cu" : ""); };
        std::string path = "deep/" + name();
        while (random() % 2 == 0) path += "/" + name();
        if (random() % 2 == 0) path = path.substr(5);
        std::error_code error;
        for (fs::path above = (root / path).parent_path(); above != root; above = above.parent_path())
            if (!fs::is_directory(fs::symlink_status(above, error))) fs::remove(above, error);
        fs::remove_all(root / path, error);
        if (random() % 4 == 0) return;
        fs::create_directories((root / path).parent_path());
        if (random() % 4 == 0)
            fs::create_symlink("somewhere", root / path);
        else
            write(path, std::to_string(random() % 5));
        if (random() % 5 == 0) fs::permissions(root / path, fs::perms::owner_exec, fs::perm_options::add, error);
    }
};

TEST_F(TreeChanges, AreThoseThatGitTells) {
    std::mt19937 random(3);
    write("deep/a", "x");
    commit("0");
    git("tag t0");
    constexpr int kCommits = 25;
    for (int i = 1; i < kCommits; ++i) {
        for (int edits = 0; edits < 5; ++edits) edit(random);
        if (i == 9) git("update-index --add --cacheinfo 160000,$(git rev-parse HEAD),sub");
        write("deep/number", std::to_string(i));
        commit(std::to_string(i));
        git("tag t" + std::to_string(i));
    }
    size_t seen = 0;
    for (const std::string folder : {"", "deep/"}) {
        fs::create_directories(root / folder);
        const GitRepository repository((root / folder).string());
        ASSERT_EQ(repository.error(), "");
        for (int i = 1; i < kCommits; ++i)
            for (const int back : {1, 4}) {
                if (i < back) continue;
                const auto id = [&](int at) { return repository.commit("t" + std::to_string(at))->id; };
                std::map<std::string, std::string> changes;
                for (const GitChange& change :
                     repository.changes(id(i - back), id(i), [](const auto&) { return true; }))
                    EXPECT_TRUE(changes.emplace(change.path, change.blob).second) << change.path;
                EXPECT_EQ(changes, by_git("t" + std::to_string(i - back), "t" + std::to_string(i), folder)) << i;
                seen += changes.size();
            }
    }
    EXPECT_GT(seen, 200u);
}

TEST_F(TreeChanges, FromNothingIsAll) {
    write("a/b", "1");
    write("c", "2");
    commit("0");
    const GitRepository repository(root.string());
    std::vector<std::string> paths;
    for (const GitChange& change :
         repository.changes("", repository.commit("HEAD")->id, [](const std::string& path) { return path != "d"; }))
        paths.push_back(change.path);
    EXPECT_EQ(paths, (std::vector<std::string>{"a/b", "c"}));
}

}  // namespace
}  // namespace porttool::testing::tree_changes_test
