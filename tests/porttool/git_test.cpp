// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The gate against a revision and on the index, in a repository made for each test.
#include <unistd.h>

#include <cstdlib>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::git_test {
namespace {

class Git : public ::testing::Test {
protected:
    void SetUp() override {
        if (std::system("git --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "git is not installed";
        root = std::filesystem::temp_directory_path() /
               ("porttool_git_test_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::remove_all(root);
        std::filesystem::remove_all(beside("other"));
        write("src/k.cu", source);
        write("port/k.comp", target);
        git("init -q -b main . && git config user.email a@b && git config user.name a");
        git("add -A && git commit -qm one");
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        git("add -A && git commit -qm two && git branch base");
    }
    void TearDown() override {
        std::filesystem::remove_all(root);
        std::filesystem::remove_all(beside("other"));
    }

    /// A folder next to the repository, for a second one.
    std::filesystem::path beside(const std::string& name) const { return root.string() + "_" + name; }
    /// What is wrong, for calls that must fail.
    std::string error_of(std::vector<std::string> options, const std::string& folder = "") {
        options.insert(options.begin(), "check");
        const CommandRun got = porttool(options, folder);
        EXPECT_EQ(got.exit_code, 2) << got.out;
        EXPECT_EQ(got.out, "");
        EXPECT_LE(std::count(got.err.begin(), got.err.end(), '\n'), 2) << got.err;
        return got.err;
    }

    void write(const std::string& path, const std::string& text) const {
        std::filesystem::create_directories((root / path).parent_path());
        std::ofstream(root / path) << text;
    }
    void git(const std::string& arguments) const {
        ASSERT_EQ(std::system(("cd '" + root.string() + "' && git " + arguments + " > /dev/null 2>&1").c_str()), 0)
            << arguments;
    }
    /// Removes what git has of a file or folder at HEAD.
    void lose(const std::string& path) const {
        const std::filesystem::path note = beside("other");
        git("rev-parse HEAD:" + path + " > " + note.string() + " #");
        const std::string id = read_text(note).substr(0, 40);
        ASSERT_TRUE(std::filesystem::remove(root / ".git/objects" / id.substr(0, 2) / id.substr(2))) << path;
    }
    CommandRun porttool(std::vector<std::string> arguments, const std::string& folder = "") {
        arguments.insert(arguments.begin(), {"-C", folder.empty() ? root.string() : folder});
        return run(disk, arguments);
    }
    nlohmann::json check(std::vector<std::string> options, const std::string& folder = "") {
        options.insert(options.begin(), {"check", "--format", "json"});
        const CommandRun got = porttool(options, folder);
        EXPECT_NE(got.exit_code, 2) << got.err;
        return got.exit_code == 2 ? nlohmann::json() : nlohmann::json::parse(got.out);
    }

    const std::string source =
        "__device__ float shade(float a, float b) {\n  float c = a * b;\n  return c * 0.5f;\n}\n";
    const std::string target = "float shade(float a, float b) {\n  float c = a * b;\n  return c * 0.5;\n}\n";
    std::filesystem::path root;
    RealDisk disk;
};

TEST_F(Git, AgainstARevisionTheChangeItselfIsJudged) {
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    git("commit -qam three");
    EXPECT_EQ(check({"--base", "base"})["verdict"], "drift");
    EXPECT_EQ(check({"--base", "HEAD"})["verdict"], "in_step") << "the drift is older than this base";
    EXPECT_EQ(check({})["verdict"], "drift") << "but the lock still knows it";
    write("port/k.comp", replaced(target, "a * b", "a + b"));
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
}

TEST_F(Git, ALineAcceptedSinceTheBaseCounts) {
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    ASSERT_EQ(porttool({"accept", "src/k.cu:shade", "--reason", "GPU only"}).exit_code, 0);
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    write("src/k.cu", replaced(source, "a * b", "a - b"));
    EXPECT_EQ(check({"--base", "base"})["verdict"], "drift");
}

TEST_F(Git, AgainstARevisionTheSameEditBesideAPairIsItsPortsToo) {
    const auto source_now = [&](const std::string& count) {
        return source + "void launch(float* out) {\n  const int n = " + count + ";\n  shade<<<n, 1>>>(out, n);\n}\n";
    };
    const auto port_now = [&](const std::string& count) {
        return replaced(target, "return c * 0.5;", "const int n = " + count + ";\n  return n > 0 ? c * 0.5 : 0.0;");
    };
    const auto levels = [&](const std::string& in_source, const std::string& in_port) {
        write("src/k.cu", source_now(in_source));
        write("port/k.comp", port_now(in_port));
        std::string out;
        const nlohmann::json report = check({"--base", "HEAD"});
        for (const auto& finding : report["findings"])
            out += finding["rule"].get<std::string>() + " " + finding["level"].get<std::string>() + ", ";
        return out;
    };
    write("src/k.cu", source_now("size() - taps"));
    write("port/k.comp", port_now("size() - taps"));
    ASSERT_EQ(porttool({"accept", "--all", "--force"}).exit_code, 0);
    git("add -A");
    git("commit -qm launcher");
    EXPECT_EQ(levels("size() - taps", "size() - taps + 1"), "target-changed warning, ");
    EXPECT_EQ(levels("size() - taps + 1", "size() - taps + 1"), "target-changed note, ");
    EXPECT_EQ(levels("size() - taps - 1", "size() - taps + 1"), "target-changed warning, ");
}

TEST_F(Git, TheLockIsNotNeededAgainstARevision) {
    std::filesystem::remove(root / "portmap.lock");
    std::filesystem::remove_all(root / "portmap.base");
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    write("src/k.cu", source + "__device__ int fresh(int a) { return a * 3; }\n");
    EXPECT_EQ(check({"--base", "base"})["findings"][0]["rule"], "unported");
}

TEST_F(Git, TheIndexStandsInForTheWorkTree) {
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
    git("add -A");
    write("src/k.cu", source);
    EXPECT_EQ(check({"--staged"})["verdict"], "drift");
    EXPECT_EQ(check({})["verdict"], "in_step");
}

TEST_F(Git, WorkTreesSubfoldersAndDetachedHeadsWork) {
    git("worktree add -q ../" + root.filename().string() + "_tree base");
    const std::string tree = root.string() + "_tree";
    EXPECT_EQ(check({"--base", "base"}, tree)["verdict"], "in_step");
    std::filesystem::remove_all(tree);
    git("checkout -q --detach");
    EXPECT_EQ(check({"--base", "base"}, (root / "src").string())["verdict"], "in_step");
}

/// Extensions that tell how a work tree is written, or from where objects come, have no part in reading them.
TEST_F(Git, WhatSparseCheckoutsAndPartialClonesSetIsNoHindrance) {
    git("sparse-checkout set --no-cone '/*'");
    for (const char* extension : {"worktreeConfig true", "partialClone origin", "preciousObjects true"}) {
        git("config core.repositoryformatversion 1");
        git(std::string("config extensions.") + extension);
    }
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
    git("config extensions.objectNames stretched");
    EXPECT_NE(error_of({"--base", "base"}).find("objectnames"), std::string::npos) << "what nobody knows is refused";
}

TEST_F(Git, ABareRepositoryAndALinkToNowhereAreNamedWithARemedy) {
    git("clone -q --bare . '" + beside("other").string() + "'");
    for (const char* name : {"src", "port", "portmap.toml", "portmap.lock", "portmap.base"})
        std::filesystem::copy(root / name, beside("other") / name, std::filesystem::copy_options::recursive);
    EXPECT_NE(error_of({"--base", "HEAD"}, beside("other").string()).find("bare repository"), std::string::npos);
    EXPECT_NE(error_of({"--staged"}, beside("other").string()).find("git worktree add"), std::string::npos);
    EXPECT_EQ(check({}, beside("other").string())["verdict"], "in_step") << "the lock needs no git";
    std::filesystem::remove_all(root / ".git");
    for (const char* text : {"gitdir: /nowhere/at/all\n", ""}) {
        write(".git", text);
        EXPECT_NE(error_of({"--base", "HEAD"}).find("git -C '" + root.string() + "' status"), std::string::npos);
        EXPECT_EQ(porttool({"history"}).exit_code, 2);
        EXPECT_EQ(check({})["verdict"], "in_step");
    }
}

/// Sets a variable of the environment for as long as it lives.
struct Variable {
    Variable(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
    ~Variable() { ::unsetenv(name_); }
    const char* name_;
};

/// Git sets them for its hooks; whose repository is meant, -C says.
TEST_F(Git, VariablesOfAnotherRepositoryAreNotHeeded) {
    const Variable folder("GIT_DIR", "/nowhere/at/all"), tree("GIT_WORK_TREE", "/"), index("GIT_INDEX_FILE", "/none");
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
}

/// `git commit -a` asks its hook about an index that is not yet in place.
TEST_F(Git, InAHookTheIndexOfThatCommitCounts) {
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
    std::ofstream(root / ".git/hooks/pre-commit") << "#!/bin/sh\ncp \"$GIT_INDEX_FILE\" .git/of-hook\n";
    std::filesystem::permissions(root / ".git/hooks/pre-commit", std::filesystem::perms::all);
    git("commit -qam three && git reset -q --soft HEAD~ && git read-tree HEAD");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step") << "nothing is in the usual index";
    const Variable absolute("GIT_INDEX_FILE", (root / ".git/of-hook").string());
    EXPECT_EQ(check({"--staged"})["verdict"], "drift");
    const Variable relative("GIT_INDEX_FILE", ".git/of-hook");
    EXPECT_EQ(check({"--staged"})["verdict"], "drift");
}

TEST_F(Git, WhatGitCannotGiveIsExitCodeTwo) {
    EXPECT_NE(error_of({"--base", "nowhere"}).find("git fetch origin nowhere"), std::string::npos);
    EXPECT_NE(error_of({"--base", "origin/main"}).find("git fetch origin main\n"), std::string::npos);
    EXPECT_NE(error_of({"--base", "HEAD:src"}).find("no such revision"), std::string::npos);
    EXPECT_NE(error_of({"--base", ""}).find("--base"), std::string::npos) << "an empty variable in a CI file";
    git("checkout -q --orphan other && git commit -qm alone");
    EXPECT_NE(error_of({"--base", "base"}).find("fetch-depth: 0"), std::string::npos);
    std::filesystem::remove_all(root / ".git");
    EXPECT_NE(error_of({"--base", "base"}).find("no git repository"), std::string::npos);
    EXPECT_NE(error_of({"--staged"}).find("no git repository"), std::string::npos);
}

TEST_F(Git, AShallowCloneWithoutTheMergeBaseNamesTheRemedyAndTheRemedyHelps) {
    git("commit -q --allow-empty -m three && git checkout -q -b feature base");
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    git("commit -qam four");
    git("clone -q --depth 1 --no-single-branch -b feature 'file://" + root.string() + "' '" + beside("other").string() +
        "'");
    const std::string clone = beside("other").string();
    EXPECT_EQ(check({}, clone)["verdict"], "drift") << "the lock needs no history";
    EXPECT_EQ(check({"--base", "HEAD~1"}, clone)["verdict"], "drift") << "another branch has brought it";
    const std::string missing = error_of({"--base", "HEAD~2"}, clone);
    EXPECT_NE(missing.find("git fetch --unshallow"), std::string::npos) << missing;
    const std::string error = error_of({"--base", "origin/main"}, clone);
    EXPECT_NE(error.find("fetch-depth: 0"), std::string::npos) << error;
    ASSERT_NE(error.find("git fetch --unshallow"), std::string::npos) << error;
    ASSERT_EQ(std::system(("cd '" + clone + "' && git fetch --unshallow > /dev/null 2>&1").c_str()), 0);
    EXPECT_EQ(check({"--base", "origin/main"}, clone)["verdict"], "drift");
    // The oldest commit that is here is enough for itself: a merge commit and its parents in CI.
    std::filesystem::remove_all(clone);
    git("clone -q --depth 2 -b feature 'file://" + root.string() + "' '" + clone + "'");
    EXPECT_EQ(check({"--base", "HEAD~1"}, clone)["verdict"], "drift");
}

TEST_F(Git, BeforeTheFirstCommitOnlyTheIndexHelps) {
    std::filesystem::remove_all(root / ".git");
    git("init -q -b main .");
    EXPECT_NE(error_of({"--base", "main"}).find("HEAD names no commit yet"), std::string::npos);
    EXPECT_NE(error_of({"--staged"}).find("git add"), std::string::npos) << "an empty index is no clean one";
    git("add -A");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
    EXPECT_EQ(check({})["verdict"], "in_step");
}

TEST_F(Git, APortThatIsDeletedIsToldOfTheIndexAsOfTheWorkTree) {
    git("rm -q -r port");
    const auto worktree = check({}), staged = check({"--staged"});
    ASSERT_EQ(worktree["findings"].size(), 1u) << worktree;
    EXPECT_EQ(worktree["findings"][0]["rule"], "dead-link");
    EXPECT_EQ(staged["findings"], worktree["findings"]);
    EXPECT_EQ(staged["verdict"], "drift");
    git("reset -q --hard && git rm -q -r src");
    EXPECT_NE(error_of({"--staged"}).find("the source side"), std::string::npos) << "no finding would tell of that";
}

TEST_F(Git, AConflictInTheIndexIsNotJudged) {
    git("checkout -q -b feature base");
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    git("commit -qam three && git checkout -q main");
    write("src/k.cu", replaced(source, "a * b", "a - b"));
    git("commit -qam four && ! git merge feature");
    const std::string error = error_of({"--staged"});
    EXPECT_NE(error.find("src/k.cu: a merge conflict is not resolved"), std::string::npos) << error;
    EXPECT_NE(error.find("git add 'src/k.cu'"), std::string::npos) << error;
    write("src/k.cu", source);
    git("add src/k.cu");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
}

TEST_F(Git, TheLockThatCountsForTheIndexIsTheStagedOne) {
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    git("add -A");
    ASSERT_EQ(porttool({"accept", "src/k.cu:shade", "--reason", "GPU only"}).exit_code, 0);
    EXPECT_EQ(check({})["verdict"], "in_step");
    EXPECT_EQ(check({"--staged"})["verdict"], "drift") << "the commit would not hold the new lock";
    git("add -A");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
}

TEST_F(Git, SubmodulesWorkFromWithinAndFromAbove) {
    const std::string parent = beside("other").string();
    git("init -q -b main '" + parent + "' && cd '" + parent +
        "' && git config user.email a@b && git config user.name a && git -c protocol.file.allow=always submodule -q "
        "add '" +
        root.string() + "' sub && git add -A && git commit -qm parent");
    const std::string within = parent + "/sub";
    ASSERT_EQ(std::system(("cd '" + within + "' && git config user.email a@b && git config user.name a").c_str()), 0);
    EXPECT_EQ(check({"--base", "HEAD"}, within)["verdict"], "in_step");
    ASSERT_EQ(porttool({"init", "--source", "sub/src/*", "--target", "sub/port/*"}, parent).exit_code, 0);
    ASSERT_EQ(std::system(("cd '" + parent + "' && git add -A && git commit -qm map").c_str()), 0);
    EXPECT_EQ(check({"--base", "HEAD"}, parent)["verdict"], "in_step");
    EXPECT_EQ(check({"--staged"}, parent)["verdict"], "in_step");
    std::ofstream(within + "/src/k.cu") << replaced(source, "a * b", "a + b");
    EXPECT_EQ(check({"--base", "HEAD"}, within)["verdict"], "drift");
    EXPECT_EQ(check({"--base", "HEAD"}, parent)["verdict"], "drift");
    EXPECT_EQ(check({"--staged"}, parent)["verdict"], "in_step");
    ASSERT_EQ(std::system(("cd '" + within + "' && git commit -qam edit && cd .. && git add sub").c_str()), 0);
    EXPECT_EQ(check({"--staged"}, parent)["verdict"], "drift");
}

TEST_F(Git, ARepositoryOfAnotherUserIsRead) {
    if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
    ASSERT_EQ(std::system(("chown -R nobody '" + root.string() + "'").c_str()), 0);
    ASSERT_NE(std::system(("cd '" + root.string() + "' && SUDO_UID= git status > /dev/null 2>&1").c_str()), 0)
        << "git itself refuses";
    write("src/k.cu", replaced(source, "a * b", "a + b"));
    EXPECT_EQ(check({"--base", "base"})["verdict"], "drift");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
}

TEST_F(Git, ALinkToAFileIsReadAsTheFile) {
    std::filesystem::rename(root / "src/k.cu", root / "k.cu");
    std::filesystem::create_symlink("../k.cu", root / "src/k.cu");
    git("add -A && git commit -qm linked");
    EXPECT_EQ(check({"--base", "HEAD"})["verdict"], "in_step");
    write("k.cu", replaced(source, "a * b", "a + b"));
    EXPECT_EQ(check({"--base", "HEAD"})["verdict"], "drift");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
    git("add -A");
    EXPECT_EQ(check({"--staged"})["verdict"], "drift");
}

TEST_F(Git, ATextThatIsNotHereIsNotTakenForNone) {
    lose("src/k.cu");
    EXPECT_NE(error_of({"--base", "base"}).find("src/k.cu"), std::string::npos);
}

TEST_F(Git, OfABaseOnlyWhatTheGlobsNameIsRead) {
    write("docs/guide/page.md", "A page.\n");
    write("src/deep/other.cu", "int other(int a) { return a * 3; }\n");
    write("notes.txt", "Notes.\n");
    git("add -A && git commit -qm three");
    for (const char* path : {"docs/guide/page.md", "docs/guide", "docs", "src/deep/other.cu", "notes.txt"}) lose(path);
    EXPECT_EQ(check({"--base", "HEAD"})["verdict"], "in_step");
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
    lose("port/k.comp");
    EXPECT_NE(error_of({"--base", "HEAD"}).find("port/k.comp"), std::string::npos);
}

TEST_F(Git, AUnitThatWasMovedSinceTheBaseIsHeldAgainstTheLock) {
    // Its old id is not in the map any more, so that the base has nothing to say.
    std::filesystem::rename(root / "src/k.cu", root / "src/moved.cu");
    write("portmap.toml", replaced(read_text(root / "portmap.toml"), "src/k.cu:shade", "src/moved.cu:shade"));
    ASSERT_EQ(porttool({"accept", "--all", "--force"}).exit_code, 0);
    git("add -A && git commit -qm moved");
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    write("src/moved.cu", replaced(source, "a * b", "a + b"));
    EXPECT_EQ(check({"--base", "base"})["verdict"], "drift");
}

/// Nobody mended the map when a commit moved a unit and edited it: that commit was told, those after it are not.
TEST_F(Git, AnEditOlderThanTheBaseIsNotToldAgainUnderAStaleId) {
    std::filesystem::rename(root / "src/k.cu", root / "src/moved.cu");
    write("src/moved.cu", replaced(source, "0.5f", "0.25f"));
    git("add -A && git commit -qm moved");
    EXPECT_EQ(check({"--base", "base"})["verdict"], "drift") << "the edit itself";
    write("src/other.cu", "// nothing\n");
    git("add -A && git commit -qm later");
    const auto later = check({"--base", "HEAD~1"});
    EXPECT_EQ(later["verdict"], "in_step") << later.dump(1);
    for (const auto& finding : later["findings"]) EXPECT_EQ(finding["level"], "note") << finding.dump(1);
    write("src/moved.cu", replaced(replaced(source, "0.5f", "0.25f"), "a * b", "a + b"));
    EXPECT_EQ(check({"--base", "HEAD"})["verdict"], "drift") << "a new edit under the stale id";
    write("port/k.comp", replaced(target, "a * b", "a + b"));
    EXPECT_EQ(check({"--base", "HEAD"})["verdict"], "in_step") << "the new edit was carried over";
}

TEST_F(Git, APortThatWasGoneAtTheBaseIsAnErrorOfTheChangeThatRemovedItAlone) {
    const auto dead_link = [&](const std::string& base) -> std::string {
        const auto report = check({"--base", base});
        for (const auto& finding : report["findings"])
            if (finding["rule"] == "dead-link") return finding["level"];
        return "none";
    };
    write("port/k.comp", "int other(int n) {\n  return n + 1;\n}\n");
    git("commit -qam gone");
    EXPECT_EQ(dead_link("base"), "error");
    EXPECT_EQ(dead_link("HEAD"), "warning");
    // A pair that the change itself names wrongly is one of its errors.
    const std::string map = read_text(root / "portmap.toml"), lock = read_text(root / "portmap.lock");
    write("portmap.toml", replaced(map, "port/k.comp:shade", "port/k.comp:shadow"));
    EXPECT_EQ(dead_link("HEAD"), "error");
    write("portmap.lock", replaced(lock, "port/k.comp:shade", "port/k.comp:shadow"));
    EXPECT_EQ(dead_link("HEAD"), "error");
}

TEST_F(Git, ASourceThatWasGoneAtTheBaseIsANote) {
    const auto orphaned = [&](const std::string& base) -> std::string {
        const auto report = check({"--base", base});
        for (const auto& finding : report["findings"])
            if (finding["rule"] == "orphaned") return finding["level"];
        return "none";
    };
    write("src/k.cu", "__device__ int other(int n) {\n  return n + 1;\n}\n");
    git("commit -qam gone");
    EXPECT_EQ(orphaned("base"), "warning");
    EXPECT_EQ(orphaned("HEAD"), "note");
}

TEST_F(Git, TheTwoSidesMayLieInTwoCheckouts) {
    const std::string other = beside("other").string();
    std::filesystem::create_directories(other);
    std::filesystem::rename(root / "port", other + "/port");
    ASSERT_EQ(std::system(("cd '" + other +
                           "' && git init -q -b main . && git config user.email a@b && git config "
                           "user.name a && git add -A && git commit -qm port && git branch base")
                              .c_str()),
              0);
    write("portmap.toml", "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\ntarget_root = \"../" +
                              std::filesystem::path(other).filename().string() +
                              "\"\n[[pair]]\nsource = \"src/k.cu:shade\"\ntarget = \"port/k.comp:shade\"\n");
    git("add -A && git commit -qm apart && git branch -f base");
    EXPECT_NE(porttool({"map"}).out.find("confirmed"), std::string::npos);
    std::filesystem::remove(root / "portmap.lock");
    ASSERT_EQ(porttool({"init"}).exit_code, 0) << "a map written by hand gets its lock";
    git("add -A && git commit -q --allow-empty -m lock && git branch -f base");
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{}, {"--base", "base"}, {"--staged"}})
        EXPECT_EQ(check(options)["verdict"], "in_step");

    write("src/k.cu", replaced(source, "a * b", "a + b"));
    git("add -A");
    for (const std::vector<std::string>& options :
         std::vector<std::vector<std::string>>{{}, {"--base", "base"}, {"--staged"}}) {
        const auto report = check(options);
        ASSERT_EQ(report["findings"].size(), 1u);
        const auto& port = report["findings"][0]["target"];
        EXPECT_EQ(port["id"], "port/k.comp:shade");
        EXPECT_EQ(port["file"], "../" + std::filesystem::path(other).filename().string() + "/port/k.comp")
            << "a path that leads there from the root";
    }
    EXPECT_NE(porttool({"explain", "port/k.comp:shade"}).out.find("+ float c = a + b"), std::string::npos);

    std::ofstream(other + "/port/k.comp") << replaced(target, "a * b", "a + b");
    EXPECT_EQ(check({})["verdict"], "in_step");
    EXPECT_EQ(check({"--base", "base"})["verdict"], "in_step");
    EXPECT_EQ(check({"--staged"})["verdict"], "drift") << "the port is not staged in its own checkout";
    ASSERT_EQ(std::system(("cd '" + other + "' && git add -A").c_str()), 0);
    EXPECT_EQ(check({"--staged"})["verdict"], "in_step");
    ASSERT_EQ(porttool({"accept", "port/k.comp:shade"}).exit_code, 0);
    EXPECT_TRUE(check({})["findings"].empty());

    git("branch only_here HEAD");
    const CommandRun got = porttool({"check", "--base", "only_here"});
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_NE(got.err.find("its HEAD is taken"), std::string::npos) << got.err;
    std::filesystem::remove_all(other + "/.git");
    EXPECT_NE(error_of({"--base", "base"}).find("target_root"), std::string::npos);
}

TEST_F(Git, ARenamedGlobalConstantIsNoChangeOfCode) {
    write("src/k.cu", "");
    const std::string shader =
        "#version 450\nlayout(std430, binding = 0) buffer Values { float values[]; };\nconst float SCALE = 0.5;\n"
        "void main() {\n  values[0] = values[1] * SCALE;\n}\n";
    write("src/g.comp", shader);
    write("port/g.cpp", "const float SCALE = 0.5f;\nvoid main() {\n  values[0] = values[1] * SCALE;\n}\n");
    write("portmap.toml",
          "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n[[pair]]\nsource = \"src/g.comp:main\"\n"
          "target = \"port/g.cpp:main\"\n");
    ASSERT_EQ(porttool({"init", "--force"}).exit_code, 0);
    git("add -A && git commit -qm shader");
    write("src/g.comp", replaced(replaced(shader, "SCALE", "FACTOR"), "SCALE", "FACTOR"));
    auto level_of_main = [&](const std::vector<std::string>& options) {
        const auto report = check(options);
        for (const auto& finding : report["findings"])
            if (finding["source"].is_object() && finding["source"]["id"] == "src/g.comp:main")
                return finding["level"].get<std::string>();
        return std::string("none");
    };
    EXPECT_EQ(level_of_main({}), "error");
    if (porttool({"check", "--spirv"}).exit_code == 2) GTEST_SKIP() << "this build has no glslang";
    EXPECT_EQ(level_of_main({"--spirv"}), "note");
    EXPECT_EQ(level_of_main({"--spirv", "--base", "HEAD"}), "note");
    git("add -A");
    EXPECT_EQ(level_of_main({"--spirv", "--staged"}), "note");
    std::filesystem::remove_all(root / ".git");
    const CommandRun got = porttool({"check", "--spirv"});
    EXPECT_EQ(got.exit_code, 1);
    EXPECT_NE(got.err.find("no earlier files"), std::string::npos) << got.err;
}

}  // namespace
}  // namespace porttool::testing::git_test
