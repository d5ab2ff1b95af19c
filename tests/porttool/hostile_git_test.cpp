// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What git can be made to say: links and submodules in commits, files that no reader has, an index or a repository that
// cannot be read. What is not known of the merge base must never pass for what was not there.
#include <sys/stat.h>

#include <functional>

#include "porttool/read/git_repository.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::hostile_git_test {
namespace {
namespace fs = std::filesystem;

const std::string kSource =
    "__device__ float f(float x) {\n    return x * 2.0f;\n}\n__device__ float g(float x) {\n    float y = sqrt(x) + "
    "1.0f;\n    return y * 3.0f;\n}\n";
const std::string kTarget = replaced(replaced(kSource, "__device__ ", ""), "__device__ ", "");

class HostileGit : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        if (IsSkipped()) return;
        write("src/k.cu", kSource);
        write("port/k.cpp", kTarget);
    }
    void TearDown() override {
        fs::remove_all(beside());
        TemporaryRepository::TearDown();
    }
    fs::path beside() const { return root.string() + "_beside"; }

    /// Records both sides, on main, and goes on in a branch.
    void start() {
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        commit("start");
        git("checkout -q -b feature");
    }
    /// The same without a lock: then the merge base is all there is.
    void start_without_lock() {
        start();
        fs::remove(root / "portmap.lock");
        fs::remove_all(root / "portmap.base");
        commit("no lock", 2);
        git("branch -f main");
    }
    /// Puts a side into a submodule.
    void make_submodule(const std::string& side) {
        fs::remove_all(beside());
        fs::rename(root / side, beside());
        const std::string there = "cd '" + beside().string() + "' && ";
        ASSERT_EQ(std::system((there + "git init -q -b main . && git config user.email a@b && git config user.name a "
                                       "&& git add -A && git commit -qm one")
                                  .c_str()),
                  0);
        git("-c protocol.file.allow=always submodule -q add '" + beside().string() + "' " + side);
    }
    std::vector<int> exit_codes(const std::vector<std::vector<std::string>>& commands) {
        std::vector<int> out;
        for (const auto& command : commands) out.push_back(porttool(command).exit_code);
        return out;
    }
};

const std::vector<std::vector<std::string>> kGates = {
    {"check"}, {"check", "--base", "main"}, {"check", "--base", "main", "--trusted-map"}};
const std::vector<int> kDrift = {1, 1, 1};

TEST_F(HostileGit, ASubmoduleThatTheChangeRemovesWasThereBefore) {
    make_submodule("port");
    start();
    git("rm -qf port");
    commit("gone", 2);
    EXPECT_EQ(exit_codes(kGates), kDrift);
    write("port/other.cpp", "float other(float x) { return x; }\n");
    commit("something else in its place", 3);
    EXPECT_EQ(exit_codes(kGates), kDrift);
    write("port/k.cpp", replaced(kTarget, "3.0f", "9.0f"));
    write("src/k.cu", replaced(kSource, "3.0f", "7.0f"));
    commit("edited files in its place", 4);
    EXPECT_EQ(exit_codes(kGates), kDrift);
}

TEST_F(HostileGit, ASubmoduleOfAnotherRepositoryWasThereBefore) {
    make_submodule("port");
    start();
    git("rm -qf port");
    fs::remove_all(root / ".git/modules");
    write("port/note.txt", "nothing\n");
    make_submodule("port");
    commit("swapped", 2);
    EXPECT_EQ(exit_codes(kGates), kDrift);
}

/// What zlib reads back as `bytes`: at most 64 KiB, not compressed.
std::string stored(const std::string& bytes) {
    uint32_t a = 1, b = 0;
    for (const unsigned char byte : bytes) a = (a + byte) % 65521, b = (b + a) % 65521;
    const auto low_first = [](size_t number) {
        return std::string{static_cast<char>(number & 0xFF), static_cast<char>(number >> 8)};
    };
    std::string out = "\x78\x01\x01" + low_first(bytes.size()) + low_first(~bytes.size() & 0xFFFF) + bytes;
    for (const uint32_t half : {b, a}) out += {static_cast<char>(half >> 8), static_cast<char>(half & 0xFF)};
    return out;
}

// A megabyte of a pack can stand for a commit or a folder of gigabytes, which git reads as a whole. Here one that only
// says that it is so large.
TEST_F(HostileGit, ACommitOrFolderOfHundredsOfMebibytesEndsInALine) {
    start();
    const std::string id(40, 'b');
    fs::create_directories(root / ".git/objects/bb");
    const auto make = [&](const std::string& kind) {
        std::ofstream(root / ".git/objects/bb" / id.substr(2), std::ios::binary)
            << stored(kind + " 999000000" + std::string(1, '\0') + "tree ");
    };
    const auto expect_told = [&](const std::vector<std::vector<std::string>>& commands) {
        for (const auto& command : commands) {
            const CommandRun got = porttool(command);
            EXPECT_EQ(got.exit_code, 2) << command[0];
            EXPECT_EQ(got.out, "") << command[0];
            EXPECT_NE(got.err.find("952 MiB"), std::string::npos) << command[0] << ": " << got.err;
            EXPECT_NE(got.err.find("git cat-file"), std::string::npos) << command[0] << ": " << got.err;
        }
        EXPECT_EQ(exit_codes({{"check"}, {"check", "--staged"}, {"report", "--format", "json"}}),
                  (std::vector<int>{0, 0, 0}));
    };
    make("commit");
    git("update-ref HEAD $(git commit-tree HEAD^{tree} -p " + id + " -m after)");
    expect_told({{"history"},
                 {"audit"},
                 {"effort", "--from", "HEAD~1", "--to", "HEAD"},
                 {"check", "--base", "HEAD~1"},
                 {"check", "--base", "main"},
                 {"report", "--base", "main"},
                 {"sync", "--all", "--base", "main"}});
    git("update-ref HEAD main");
    make("tree");
    git("update-ref HEAD $(git commit-tree $(git ls-tree HEAD | sed 's/tree [0-9a-f]*/tree " + id +
        "/' | git mktree --missing) -p HEAD -m before)");
    git("update-ref HEAD $(git commit-tree main^{tree} -p HEAD -m after)");
    expect_told(
        {{"history"}, {"audit"}, {"effort", "--from", "HEAD~1", "--to", "HEAD"}, {"check", "--base", "HEAD~1"}});
    EXPECT_EQ(porttool({"check", "--base", "main"}).exit_code, 0);
}

// A `.git` that came in an archive may hold pipes; nothing waits for them.
TEST_F(HostileGit, PipesInThePlaceOfFilesOfGitAreNotWaitedFor) {
    start();
    for (const std::string name : {"config", "HEAD", "index", "packed-refs", "shallow"}) {
        const fs::path place = root / ".git" / name, kept = root / ".git/kept";
        const bool was_there = fs::exists(place);
        if (was_there) fs::rename(place, kept);
        ASSERT_EQ(::mkfifo(place.c_str(), 0600), 0);
        for (const std::vector<std::string>& command :
             {std::vector<std::string>{"check", "--base", "main"}, {"check", "--staged"}, {"history"}, {"audit"}}) {
            const CommandRun got = porttool(command);
            EXPECT_EQ(got.exit_code, 2) << name << " " << command[0];
            EXPECT_NE(got.err.find(".git/" + name + " is no file"), std::string::npos) << got.err;
        }
        EXPECT_EQ(porttool({"check"}).exit_code, 0) << name;
        fs::remove(place);
        if (was_there) fs::rename(kept, place);
    }
    EXPECT_EQ(exit_codes(kGates), (std::vector<int>{0, 0, 0}));
}

TEST_F(HostileGit, WithoutALockWhatIsNotKnownOfTheBaseIsAnError) {
    make_submodule("src");
    start_without_lock();
    git("rm -qf src");
    fs::remove_all(root / ".git/modules");
    write("src/k.cu", replaced(kSource, "3.0f", "7.0f"));
    commit("files in its place", 3);
    const CommandRun got = porttool({"check", "--base", "main"});
    EXPECT_EQ(got.exit_code, 2) << got.out;
    EXPECT_NE(got.err.find("src/k.cu:f was there cannot be read"), std::string::npos) << got.err;
    EXPECT_NE(got.err.find("git submodule update --init"), std::string::npos) << got.err;
}

TEST_F(HostileGit, AFileThatCouldNotBeReadAtTheBaseWasThere) {
    for (const std::string& bytes :
         {std::string("version https://git-lfs.github.com/spec/v1\noid sha256:") + std::string(64, '0') + "\nsize 1\n",
          std::string("float a;\0", 9), std::string("\xFF\xFE a")}) {
        start();
        git("checkout -q main");
        std::ofstream(root / "port/k.cpp") << bytes;
        commit("as git keeps it", 2);
        git("checkout -q -B feature");
        git("rm -q port/k.cpp");
        commit("gone", 3);
        EXPECT_EQ(exit_codes(kGates), kDrift) << bytes;
        fs::remove_all(root / ".git");
        git("init -q -b main . && git config user.email a@b && git config user.name a");
        for (const char* name : {"portmap.toml", "portmap.lock", "portmap.base"}) fs::remove_all(root / name);
        write("port/k.cpp", kTarget);
    }
}

/// What the commit of the source's repository named of the submodule counts, and not what the submodule's own branches
/// do.
TEST_F(HostileGit, ASubmoduleThatIsTheTargetsRootIsHeldAgainstWhatTheBaseNamed) {
    fs::create_directories(root / "cpu");
    fs::rename(root / "port", root / "cpu/port");
    make_submodule("cpu");
    write("portmap.toml",
          "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\ntarget_root = \"cpu\"\n"
          "reference = \"both\"\n");
    ASSERT_EQ(porttool({"init"}).exit_code, 0);
    commit("start");
    git("branch base && git -C cpu branch base");
    git("checkout -q -b feature");
    EXPECT_EQ(porttool({"check", "--base", "base"}).exit_code, 0);
    write("cpu/port/k.cpp", replaced(kTarget, "3.0f", "9.0f"));
    git("-C cpu -c user.email=a@b -c user.name=a commit -qam edit && git -C cpu branch -f base");
    commit("another commit of the submodule", 2);
    EXPECT_EQ(porttool({"check", "--base", "base"}).exit_code, 1);
    EXPECT_EQ(porttool({"check", "--base", "base", "--trusted-map"}).exit_code, 1);
    // Files, and then another repository, in its place.
    git("rm -qf cpu");
    write("cpu/port/k.cpp", replaced(kTarget, "3.0f", "8.0f"));
    commit("files", 3);
    EXPECT_EQ(porttool({"check", "--base", "base"}).exit_code, 1);
    fs::remove_all(root / ".git/modules");
    git("rm -qrf --cached cpu");
    make_submodule("cpu");
    commit("another repository", 4);
    const CommandRun got = porttool({"check", "--base", "base"});
    EXPECT_EQ(got.exit_code, 2) << "what the base named is in no repository that is here";
    EXPECT_NE(got.err.find("the submodule cpu/ cannot be read"), std::string::npos) << got.err;
}

/// Shell functions that make a small project (`project FOLDER`), edit one side or both, and commit.
const std::string kShell =
    "set -e; git() { command git -c user.name=a -c user.email=a@b -c advice.addEmbeddedRepo=false -c "
    "advice.addIgnoredFile=false \"$@\"; }\n"
    "project() { mkdir -p $1/src; echo 'float f(float x) { return x; }' | tee $1/src/a.cu > $1/src/a.cpp; printf "
    "'version = 1\\n[sides]\\nsource = [\"src/*.cu\"]\\ntarget = [\"src/*.cpp\"]\\n[[pair]]\\nsource = "
    "\"src/a.cu:f\"\\ntarget = \"src/a.cpp:f\"\\n' > $1/portmap.toml; }\n"
    "edit() { for file in \"$@\"; do sed -i 's/return x/return 2.0f * x/' $file; done; }\n"
    "save() { git -C $1 add -A; git -C $1 commit -qm $1 > /dev/null; }\n"
    "made() { git -C $1 init -q -b then; save $1; }\n"
    "moved() { save $1; git -C $1 branch -f then; git -C $1 checkout -q --detach; }\n";

class CheckedSubmodule : public HostileGit {
protected:
    void shell(const std::string& script) const {
        ASSERT_EQ(std::system(("cd '" + root.string() + "'\n" + kShell + script).c_str()), 0) << script;
    }
    /// Folders with a project each: two of the repository, two submodules, and one in a submodule of such a one.
    void SetUp() override {
        HostileGit::SetUp();
        shell(
            "for folder in pa pb sub other sub/inner; do project $folder; done\n"
            "for folder in sub/inner sub other; do made $folder; git -C $folder checkout -q --detach; done\n"
            "git -C sub commit -q --allow-empty -m more; git -C sub branch -f then HEAD; ln -s pa link\n"
            "save .; git branch then; git checkout -q -b change");
        fs::rename(root, start());
    }
    void TearDown() override {
        fs::remove_all(start());
        HostileGit::TearDown();
    }
    fs::path start() const { return root.string() + "_start"; }
    /// Makes a change, from the start, and commits it where no file `kept` is there.
    void change(const std::string& script) {
        fs::remove_all(root);
        ASSERT_EQ(std::system(("cp -a '" + start().string() + "' '" + root.string() + "'").c_str()), 0);
        shell(script + "\n[ -f kept ] || save . || true");
    }
    CommandRun check(const std::string& folder, const std::vector<std::string>& more) {
        std::vector<std::string> command = {"check", "--base", "then", "--strict"};
        command.insert(command.end(), more.begin(), more.end());
        return porttool(command, (root / folder).string());
    }
};

/// A change moves a submodule to another commit, or exchanges it: what its own branches are then is the author's
/// choice. The commit that the repository around it named counts.
TEST_F(CheckedSubmodule, IsHeldAgainstWhatTheRepositoryAroundItNamed) {
    struct Row {
        const char *what, *change, *folder;
        int exit_code;
        const char *told, *untold;
    };
    const char *held = "is held against", *gone = "was a submodule at the merge base of then";
    const std::vector<Row> rows = {
        {"nothing", "true", "sub", 0, "", held},
        {"one side, its branch moved along", "edit sub/src/a.cu; moved sub", "sub", 1, held, "cannot"},
        {"one side, seen from below", "edit sub/src/a.cu; moved sub", "sub/src", 1, held, "cannot"},
        {"both sides", "edit sub/src/*; moved sub", "sub", 0, held, "cannot"},
        {"another folder of it", "echo > sub/note.txt; moved sub", "sub", 0, held, "cannot"},
        {"one side, not committed around it", "edit sub/src/a.cu; save sub; touch kept", "sub", 1, "", held},
        {"an older commit",
         "edit sub/src/a.cu; save sub; edit sub/src/a.cpp; moved sub; save .; git branch -f then;"
         "git -C sub checkout -q HEAD~1; git -C sub branch -f then",
         "sub", 1, held, "cannot"},
        {"a submodule in it", "edit sub/inner/src/a.cpp; moved sub/inner; moved sub", "sub/inner", 1, held, "cannot"},
        {"another repository", "rm -rf sub; cp -r other sub; echo > sub/note.txt; moved sub", "sub", 2,
         "is not in the repository that is there now", held},
        {"another repository, in a submodule",
         "rm -rf sub/inner; cp -r other sub/inner; echo > sub/inner/n; "
         "moved sub/inner; moved sub",
         "sub/inner", 2, "is not in the repository that is there now", held},
        {"files", "rm -rf sub; project sub", "sub", 2, gone, held},
        {"files, from below", "rm -rf sub; project sub", "sub/src", 2, gone, held},
        {"gone, but not from the disk", "mv sub s; save .; mv s sub; touch kept", "sub", 2, gone, held},
        {"a link to a folder", "rm -rf sub; ln -s pa sub", "sub", 2, "leads to", held},
        {"a link to another submodule", "rm -rf sub; ln -s other sub", "sub", 2, "leads to", held},
        {"a link in the place of the one around it", "mkdir s; cp -r sub/inner s; rm -rf sub; ln -s s sub", "sub/inner",
         2, "leads to", held},
        {"new", "cp -r other new; edit new/src/a.cu; moved new", "new", 0, "", held},
        {"another submodule", "edit other/src/a.cu; moved other", "sub", 0, "", held},
        {"a repository that no commit has", "echo mine > .gitignore; cp -r other mine; edit mine/src/a.cu; moved mine",
         "mine", 0, "", held},
        {"a revision of the repository around it alone", "git -C sub branch -D then", "sub", 0, held, "cannot"},
        {"the same, one side", "git -C sub branch -D then; edit sub/src/a.cu; save sub", "sub", 1, held, "cannot"},
        {"a revision of the submodule alone", "edit sub/src/a.cu; save sub; git branch -D then", "sub", 1,
         "note: then is a name that the submodule ", held},
    };
    for (const Row& row : rows) {
        SCOPED_TRACE(row.what);
        change(row.change);
        const CommandRun got = check(row.folder, {});
        EXPECT_EQ(got.exit_code, row.exit_code) << got.out << got.err;
        EXPECT_NE(got.err.find(row.told), std::string::npos) << got.err;
        EXPECT_EQ(got.err.find(row.untold), std::string::npos) << got.err;
        EXPECT_EQ(check(row.folder, {"--trusted-map"}).exit_code, row.exit_code);
    }
}

/// A process finds itself where a link led that it was started in, and does not see by which name.
TEST_F(CheckedSubmodule, AProcessThatALinkMayHaveLedHereAsksForTheFolder) {
    struct Row {
        const char *what, *change, *here;
        bool is_told;
    };
    const std::vector<Row> rows = {
        {"nothing", "true", "pb", false},
        {"a link in the place of a folder", "rm -r pa; ln -s pb pa", "pb", true},
        {"the same, seen from below", "rm -r pa; ln -s pb pa", "pb/src", true},
        {"the same, seen from elsewhere", "rm -r pa; ln -s other pa", "pb", false},
        {"a link to the whole", "rm -r pa; ln -s . pa; project .", ".", true},
        {"a link in the place of a submodule", "rm -rf sub; ln -s pb sub", "pb", true},
        {"a link to a submodule", "rm -r pa; ln -s other pa", "other", true},
        {"a link above", "rm -r pa; ln -s pb/src pa", "pb/src", true},
        {"a link further below", "rm -r pa; ln -s pb/src pa", "pb", false},
        {"a link of before", "rm link; ln -s pb link", "pb", false},
        {"a new link", "ln -s pb new", "pb", false},
        {"a link in the place of a file", "rm pa/src/a.cu; ln -s ../../pb/src/a.cu pa/src/a.cu", "pb", false},
    };
    const fs::path before = fs::current_path();
    for (const Row& row : rows) {
        SCOPED_TRACE(row.what);
        change(row.change);
        fs::current_path(root / row.here);
        const CommandRun got = run(disk, {"check", "--base", "then"});
        fs::current_path(before);
        EXPECT_EQ(got.exit_code, row.is_told ? 2 : 0) << got.out << got.err;
        EXPECT_EQ(got.err.find("Name the folder: porttool check -C ") != std::string::npos, row.is_told) << got.err;
        EXPECT_NE(check(row.here, {}).exit_code, 2) << "who names the folder means it";
    }
}

/// Files reached through links are those of the merge base and of the index as they are those of the work tree.
TEST_F(HostileGit, LinksInACommitLeadWhereThoseOfAWorkTreeLead) {
    struct Row {
        const char* what;
        std::function<void()> arrange;
        const char* edited;
        bool staged = true;
    };
    const std::vector<Row> rows = {
        {"a folder that is a link",
         [&] {
             fs::rename(root / "src", root / "real");
             fs::create_symlink("real", root / "src");
         },
         "real/k.cu"},
        {"a link to a link",
         [&] {
             fs::rename(root / "src/k.cu", root / "src/real.txt");
             fs::create_symlink("real.txt", root / "src/mid.txt");
             fs::create_symlink("mid.txt", root / "src/k.cu");
         },
         "src/real.txt"},
        {"a link through a link of a folder",
         [&] {
             fs::create_directories(root / "deep/est");
             fs::rename(root / "src/k.cu", root / "deep/est/k.cu");
             fs::create_symlink("deep/est", root / "via");
             fs::create_symlink("../via/../est/k.cu", root / "src/k.cu");
         },
         "deep/est/k.cu"},
        {"a folder through two links, one of them absolute",
         [&] {
             fs::create_directories(root / "a");
             fs::rename(root / "src", root / "a/real");
             fs::create_directory_symlink(fs::canonical(root) / "a", root / "b");
             fs::create_symlink("b/real", root / "src");
         },
         "a/real/k.cu"},
        {"a link beside the file, in a folder that is one",
         [&] {
             fs::rename(root / "src", root / "real");
             fs::rename(root / "real/k.cu", root / "k.txt");
             fs::create_symlink("../k.txt", root / "real/k.cu");
             fs::create_symlink("real", root / "src");
         },
         "k.txt"},
    };
    for (const Row& row : rows) {
        row.arrange();
        start_without_lock();
        EXPECT_EQ(porttool({"check", "--base", "main"}).exit_code, 0) << row.what;
        write(row.edited, replaced(kSource, "3.0f", "7.0f"));
        EXPECT_EQ(porttool({"check", "--base", "main"}).exit_code, 1) << row.what;
        EXPECT_EQ(porttool({"check", "--base", "main", "--trusted-map"}).exit_code, 1) << row.what;
        git("checkout -q main~1 && git checkout -q -B locked");
        write(row.edited, replaced(kSource, "3.0f", "7.0f"));
        EXPECT_EQ(porttool({"check", "--staged"}).exit_code, 0) << row.what;
        git("add -A");
        EXPECT_EQ(porttool({"check", "--staged"}).exit_code, 1) << row.what;
        TearDown();
        SetUp();
    }
}

TEST_F(HostileGit, LinksThatHaveNoEndAreNoFiles) {
    fs::create_symlink("loop.cu", root / "src/loop.cu");
    fs::create_symlink("../../../../../../etc/hostname", root / "src/out.cu");
    std::string far = "../src/k.cu";
    while (far.size() < 4000) far = "../src/" + far;
    for (int i = 0; i < 400; ++i) fs::create_symlink(far, root / ("src/far" + std::to_string(i) + ".cu"));
    commit("links");
    const GitRepository repository(root.string());
    const auto wants = [](const std::string& path) { return path.starts_with("src/"); };
    const GitFiles got = repository.files_at_base("HEAD", wants, {"src"});
    ASSERT_EQ(got.error, "");
    EXPECT_EQ(got.files.size(), 401u);
    EXPECT_EQ(got.files.at("src/far7.cu"), kSource);
    EXPECT_EQ(got.unknown, std::set<std::string>({"src/out.cu"}));
    for (int i = 400; i < 2000; ++i) fs::create_symlink(far, root / ("src/far" + std::to_string(i) + ".cu"));
    commit("more links", 2);
    EXPECT_THROW((void)repository.files_at_base("HEAD", wants, {"src"}), std::exception) << "more steps than are gone";
}

TEST_F(HostileGit, WhereGitCannotSayWhatItTracksNothingIsHiddenSilently) {
    start();
    write(".gitignore", "new.cu\n");
    write("src/new.cu", "__device__ float fresh(float x) { return x; }\n");
    git("add -f -A && git commit -qm new");
    ASSERT_EQ(porttool({"check"}).exit_code, 1) << "unported";
    const auto expect_named = [&](const std::string& what) {
        const CommandRun got = porttool({"check", "--strict"});
        EXPECT_EQ(got.exit_code, 1) << what << got.out;
        EXPECT_NE(got.out.find("[unreadable]"), std::string::npos) << what << got.out;
        EXPECT_NE(got.out.find("whether git tracks them cannot be told"), std::string::npos) << what << got.out;
    };
    git("update-index --split-index");
    expect_named("a split index");
    git("update-index --no-split-index");
    EXPECT_EQ(porttool({"check"}).exit_code, 1);
    const std::string config = read_text(root / ".git/config");
    std::ofstream(root / ".git/config") << replaced(config, "repositoryformatversion = 0",
                                                    "repositoryformatversion = 7");
    expect_named("a repository of a later version");
    std::ofstream(root / ".git/config") << config;
    std::ofstream(root / ".git/index") << "garbage";
    expect_named("a broken index");
}

TEST_F(HostileGit, AWorkTreeElsewhereIsNotThatOfTheRoot) {
    start_without_lock();
    fs::create_directories(beside());
    git("config core.worktree '" + beside().string() + "'");
    write("src/k.cu", replaced(kSource, "3.0f", "7.0f"));
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"check", "--base", "main"}, {"check", "--staged"}}) {
        const CommandRun got = porttool(command);
        EXPECT_EQ(got.exit_code, 2);
        EXPECT_NE(got.err.find("core.worktree"), std::string::npos) << got.err;
    }
}

/// A watched unit that nobody edited says something else once its words are a new function's.
TEST_F(HostileGit, ANewUnitUnderANameThatAWatchedUnitUsedBeforeIsNews) {
    start();
    const auto finding_of = [&](const std::string& fresh, const std::string& kernels) -> std::string {
        write("src/k.cu", fresh + kernels);
        const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
        for (const auto& finding : got["findings"])
            if (finding["rule"] == "unported") return finding["level"];
        return "none";
    };
    EXPECT_EQ(finding_of("__device__ float sqrt(float x) { return x * 0.5f; }\n", kSource), "error");
    EXPECT_EQ(finding_of("template <class T> T sqrt(T x) { return x * 3; }\n", kSource), "error");
    EXPECT_EQ(finding_of("constexpr auto sqrt = evil;\n", kSource), "error");
    const std::string helper = "__device__ float twice(float x) { return x + x; }\n";
    EXPECT_EQ(finding_of(helper, replaced(kSource, "y * 3.0f", "twice(y)")), "note") << "told with its user's edit";
    EXPECT_EQ(finding_of(helper, replaced(kSource, "return y", "assert(twice(y) > 1.0f + x); return y")), "error")
        << "whose edit is a note alone";
}

/// The same on the side that need not have counterparts.
TEST_F(HostileGit, ANewFunctionOfThePortUnderANameThatItCalledBeforeIsTold) {
    start();
    const std::string port = read_text(root / "port/k.cpp");
    ASSERT_EQ(porttool({"check", "--base", "main"}).exit_code, 0);
    const auto told = [&](const std::string& fresh, const std::string& kernels) {
        write("port/k.cpp", fresh + kernels);
        const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
        return std::count_if(got["findings"].begin(), got["findings"].end(),
                             [](const auto& finding) { return finding["rule"] == "target-changed"; });
    };
    EXPECT_EQ(told("static float sqrt(float x) { return x * 0.5f; }\n", port), 1);
    EXPECT_EQ(told("template <class T> T sqrt(T x) { return x * 3; }\n", port), 1);
    EXPECT_EQ(told("constexpr auto sqrt = evil;\n", port), 1);
    EXPECT_EQ(told("static float sqrt(float x, int steps) { return x * steps; }\n", port), 0) << "an overload";
    EXPECT_EQ(told("struct Number { float sqrt(float x) { return x; } };\n", port), 0) << "another scope";
    EXPECT_EQ(told("static float cbrt(float x) { return x; }\n", port), 0) << "nobody called it";
    EXPECT_EQ(told("static float half(float x) { return x * 0.5f; }\n", replaced(port, "sqrt(", "half(")), 1)
        << "whose user was edited: told as its edit";
}

/// Whatever else gives a word of an unedited text another meaning: in front of everything, or within the namespace.
TEST_F(HostileGit, ANameOfSeveralCommitsIsNoBase) {
    start();
    write("src/k.cu", replaced(read_text(root / "src/k.cu"), "sqrt(", "cbrt("));
    commit("edit");
    git("update-ref refs/remotes/origin/main main");
    ASSERT_EQ(porttool({"check", "--base", "origin/main"}).exit_code, 1);
    git("tag origin/main main");
    EXPECT_EQ(porttool({"check", "--base", "origin/main"}).exit_code, 1) << "of one commit";
    git("tag -f origin/main HEAD");
    for (const std::string base : {"origin/main", "origin/main~0", "origin/main^{commit}"}) {
        const auto got = porttool({"check", "--base", base});
        EXPECT_EQ(got.exit_code, 2) << base;
        EXPECT_NE(got.err.find("refs/tags/origin/main and refs/remotes/origin/main"), std::string::npos) << got.err;
    }
    EXPECT_EQ(porttool({"check", "--base", "refs/remotes/origin/main"}).exit_code, 1);
}

TEST_F(HostileGit, ASecondDefinitionIsTold) {
    const std::string unit =
        "float weight_of(float cosine, float width) {\n    float w = cosine * width;\n    return w * 0.25f;\n}\n";
    const std::string field = "struct Ray {\n    float from;\n    float to;\n};\n";
    const std::string bias = "const float BIAS = 0.5f;\n";
    const std::string user = "float shade_of(Ray r) {\n    return sqrtf(weight_of(r.from, r.to)) + BIAS;\n}\n";
    const std::string table = "template <> struct Block<4> {\n    static constexpr int qr = 16;\n};\n";
    const std::string host = field + bias + table + unit + user;
    write("src/k.cu", host);
    write("port/k.cpp", "#include \"all.h\"\n" + host);
    write("port/all.h", "#include \"more.h\"\n");
    write("port/more.h", "// more\n");
    start();
    const auto told = [&](const std::string& old, const std::string& now) {
        write("port/k.cpp", "#include \"all.h\"\n" + replaced(host, old, now));
        const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
        return std::count_if(got["findings"].begin(), got["findings"].end(),
                             [](const auto& one) { return one["rule"] == "target-changed"; });
    };
    const auto either = [](const std::string& first, const std::string& second) {
        return "#ifdef NEVER\n" + first + "#else\n" + second + "#endif\n";
    };
    const std::string other = replaced(unit, "0.25f", "0.75f"), less = "#ifndef NEVER\n" + other + "#endif\n";
    EXPECT_EQ(told(unit, either(unit, other)), 1);
    EXPECT_EQ(told(unit, either(other, unit)), 1);
    EXPECT_EQ(told(unit, "#ifdef NEVER\n" + unit + "#endif\n" + less), 1);
    EXPECT_EQ(told(unit, less + "#ifdef NEVER\n" + unit + "#endif\n"), 1);
    EXPECT_EQ(told(unit, "#if LEVEL > 1\n" + unit + "#else\n" + other + "#endif\n"), 1);
    EXPECT_EQ(told(unit, either(unit, replaced(other, "float cosine, float width", "float width, float cosine"))), 1);
    EXPECT_EQ(told(unit, either(unit, "static auto weight_of = [](float a, float b) { return a; };\n")), 1);
    EXPECT_EQ(told(unit, either(unit, "float (*weight_of)(float, float) = rough;\n")), 1);
    EXPECT_EQ(told(user, either(user, replaced(user, "sqrtf", "cbrtf"))), 1) << "that nobody calls";
    EXPECT_EQ(told(user, either(replaced(user, "sqrtf", "cbrtf"), user)), 1) << "nor before";
    EXPECT_EQ(told(user, either("float shade_of(Ray ray) {\n    return 0;\n}\n", user)), 1) << "nor under its names";
    EXPECT_EQ(told(field, either(field, replaced(field, "float to;", "double to;"))), 1);
    EXPECT_EQ(told(bias, either(bias, "const float BIAS = 0.75f;\n")), 1);
    EXPECT_EQ(told(bias, either(bias, "float BIAS = 0.75f;\n")), 1);
    EXPECT_EQ(told(user, "static auto sqrtf = [](float x) { return x; };\n" + user), 1);
    EXPECT_EQ(told(user, "auto sqrtf = [](float x) {\n    return x;\n};\n" + user), 1);
    // What is called in its place.
    EXPECT_EQ(told(unit, "float weight_of(float, float) __asm__(\"rough\");\n" + unit), 1);
    EXPECT_EQ(told(unit, unit + "float weight_of(float, float) __attribute__((alias(\"rough\")));\n"), 1);
    EXPECT_EQ(told(unit, unit + "float weight_of(float, float) __attribute__((ifunc(\"pick\")));\n"), 1);
    EXPECT_EQ(told(unit, "#pragma omp declare variant(rough) match(device={kind(cpu)})\n" + unit), 1);
    // No second ones.
    EXPECT_EQ(told(unit, "float weight_of(float, float);\n" + unit), 0);
    EXPECT_EQ(told(unit, unit + "extern const float BIAS;\nextern float other;\n"), 0);
    EXPECT_EQ(told(unit, "namespace {\nauto helper = [](float x) { return x; };\n}\n" + unit), 0);
    EXPECT_EQ(told(unit + user, user + unit), 0) << "moved";
    EXPECT_EQ(told(table, table + replaced(replaced(table, "<4>", "<8>"), "16", "32")), 0) << "of another argument";
    EXPECT_EQ(told(unit, either(unit, unit)), 0) << "the same";
    // In other files.
    write("port/z.cpp", other);
    EXPECT_EQ(told("", ""), 0) << "a program of its own";
    write("port/z.h", "inline " + other);
    EXPECT_EQ(told("", ""), 0) << "that nobody includes";
    write("port/more.h", "inline " + other);
    EXPECT_EQ(told("", ""), 1);
    EXPECT_EQ(told(unit, "#ifdef NEVER\n" + unit + "#endif\n"), 1);
}

/// Attributes of a function's declaration in a header that its file includes.
TEST_F(HostileGit, AnAttributeThatAHeaderAddsIsTold) {
    const std::string unit =
        "float weight_of(float cosine, float width) {\n    float w = cosine * width;\n    return w * 0.25f;\n}\n";
    const std::string user = "float shade_of(float x) {\n    return weight_of(x, 2.0f) + 1.0f;\n}\n";
    const std::string there = "[[gnu::pure]] float shade_of(float x);\nfloat weight_of(float, float);\n";
    write("src/k.cu", "#include \"more.h\"\n" + unit + user);
    write("src/more.h", there);
    write("port/k.cpp", "#include \"more.h\"\n" + unit + user);
    write("port/more.h", there);
    start();
    const std::string head = "float weight_of(float cosine, float width)";
    const auto told = [&](const std::string& header, const std::string& of_source = "") {
        write("port/more.h", header);
        write("src/more.h", there + of_source);
        const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
        return std::count_if(got["findings"].begin(), got["findings"].end(),
                             [](const auto& one) { return one["rule"] == "target-changed" && one["level"] != "note"; });
    };
    const std::string weak = "__attribute__((weak)) " + head + ";\n";
    EXPECT_EQ(told(there + weak), 1);
    EXPECT_EQ(told(there + head + " __attribute__((noinline, optimize(\"fast-math\")));\n"), 1);
    EXPECT_EQ(told(there + "[[gnu::target(\"fma\")]] " + head + ";\n"), 1);
    EXPECT_EQ(told(replaced(there, "float weight_of", "__declspec(noalias) float weight_of")), 1) << "one was there";
    EXPECT_EQ(told(replaced(there, "gnu::pure", "gnu::const")), 1) << "another one";
    EXPECT_EQ(told(there + weak + replaced(weak, "weight_of", "shade_of")), 2);
    // What says nothing new.
    EXPECT_EQ(told(there + head + ";\n"), 0);
    EXPECT_EQ(told(there + "[[nodiscard]] " + head + " __attribute__((noinline, visibility(\"hidden\")));\n"), 0);
    EXPECT_EQ(told(there + "__attribute__((weak)) float of_another(float weight_of);\n"), 0);
    EXPECT_EQ(told(replaced(there, "shade_of(float x)", "shade_of(float y)")), 0) << "a parameter has another name";
    EXPECT_EQ(told("float weight_of(float, float);\n[[gnu::pure]] float shade_of(float x);\n"), 0) << "moved";
    EXPECT_EQ(told(there + "namespace app {\n" + weak + "}\n"), 0) << "another function";
    EXPECT_EQ(told(there + weak, replaced(weak, "float width", "float width_of_lobe")), 0) << "on both sides";
    write("port/z.h", weak);
    EXPECT_EQ(told(there), 0) << "that nobody includes";
}

/// A macro within a body that only says how something is declared.
TEST_F(HostileGit, AMacroThatSaysHowSomethingIsDeclaredIsToldWhereItSaysAnother) {
    const std::string unit =
        "#include \"common.h\"\nKEPT_IN float shade(float albedo) {\n    STORED int n = 0;\n    n = n + 3;\n"
        "    return albedo * 0.5f + float(n);\n}\n";
    const std::string before = "#pragma once\n#define STORED register\n#define KEPT_IN inline\n";
    write("src/s.cu", unit);
    write("src/common.h", before);
    write("port/s.cpp", replaced(unit, "#include \"common.h\"\nKEPT_IN ", "inline "));
    start();
    const auto is_told = [&](const std::string& stored, const std::string& kept_in) {
        write("src/common.h", "#pragma once\n#define STORED " + stored + "\n#define KEPT_IN " + kept_in + "\n");
        return porttool({"check", "--base", "main"}).exit_code == 1;
    };
    EXPECT_TRUE(is_told("static", "inline"));
    EXPECT_TRUE(is_told("static const", "inline"));
    EXPECT_FALSE(is_told("register const", "inline"));
    EXPECT_FALSE(is_told("register", "static inline"));
    EXPECT_FALSE(is_told("register", "__forceinline__"));
    EXPECT_FALSE(is_told("register", "inline"));
}

TEST_F(HostileGit, ANewMeaningOfAWordIsTold) {
    const std::string device =
        "struct Vec {\n    float x, y;\n};\ntypedef float real;\n"
        "__device__ float helper(float v) {\n    return v * 0.25f;\n}\n"
        "__device__ Vec operator+(Vec a, Vec b) {\n    return make_vec(a.x + b.x, a.y + b.y);\n}\n"
        "namespace app {\n__device__ real f(real x) {\n    return sqrtf(x) * 2.0f;\n}\n"
        "__device__ float g(float x) {\n    float y = helper(x) + 1.0f;\n    return y;\n}\n"
        "__device__ Vec add(Vec a, Vec b) {\n    Vec c = a + b;\n    return c;\n}\n}\n";
    std::string host = device;
    while (host.find("__device__ ") != std::string::npos) host = replaced(host, "__device__ ", "");
    write("src/k.cu", device);
    write("port/k.cpp", host);
    write("port/aside.cpp", "namespace known {\nfloat root(float v) {\n    return v;\n}\n}\n");
    start();
    const std::string fast = "namespace fast {\nfloat sqrtf(float v) {\n    return v;\n}\n}\n";
    struct Row {
        std::string first, within;  ///< what is new before everything, and within the namespace
        bool port = true;           ///< it is told of the port
        bool source = false;        ///< ... of the source, too: it is no unit
    };
    const std::vector<Row> rows = {
        {fast + "using namespace fast;\n", "", true, true},
        {fast, "using namespace fast;\n", true, true},
        {fast, "using fast::sqrtf;\n", true, true},
        {fast, "", false},
        {"", "inline " + fast, true, true},
        {"", "namespace {\nfloat sqrtf(float v) {\n    return v;\n}\n}\n"},
        {"", "namespace known {\nfloat cbrtf(float v) {\n    return v;\n}\n}\n", false},
        {"", "using namespace std;\nusing std::cbrtf;\n", false},
        {"struct Root {\n    float operator()(float v) const {\n        return v;\n    }\n};\nstatic const Root "
         "sqrtf;\n",
         "", true, true},
        {"static const auto sqrtf = [](float v) { return v; };\n", ""},
        {"float (*sqrtf)(float) = &rough;\n", "", true, true},
        {"extern \"C\" float sqrtf(float) __asm__(\"rough\");\n", "", true, true},
        {"#pragma redefine_extname sqrtf rough\n", "", true, true},
        {"#pragma pop_macro(\"sqrtf\")\n", "", true, true},
        {"using sqrtf = double;\n", "", true, true},
        {"", "typedef double real;\n", true, true},
        {"", "using real = double;\n", true, true},
        {"typedef double whole;\nstatic float x, y, v;\nextern int unknown(float sqrtf);\nstruct Vec;\n", "", false},
        {"", "struct Vec {\n    double x, y;\n};\n"},
        {"", "float helper(float v) {\n    return v;\n}\n"},
        {"float helper(float& v) {\n    return v;\n}\n", ""},
        {"float helper(double v) {\n    return v;\n}\n", ""},
        {"template <class T> T helper(T v) {\n    return v;\n}\n", ""},
        {"float helper(float v, float w = 1.0f) {\n    return v;\n}\n", ""},
        {"Vec helper(Vec v) {\n    return v;\n}\n", "", false},
        {"float helper(float v, float w) {\n    return v;\n}\n", "", false},
        {"Vec operator+(const Vec& a, const Vec& b) {\n    return a;\n}\n", ""},
        {"Mat operator+(Mat a, Mat b) {\n    return a;\n}\n", "", false},
        {"Vec operator-(Vec a, Vec b) {\n    return a;\n}\n", "", false},
    };
    const auto told = [&](const char* file, const std::string& text, const std::string& head, const Row& row,
                          const char* rule) {
        write(file, row.first + replaced(text, head, head + row.within));
        const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
        return std::any_of(got["findings"].begin(), got["findings"].end(),
                           [&](const auto& one) { return one["rule"] == rule; });
    };
    for (const Row& row : rows) {
        EXPECT_EQ(told("port/k.cpp", host, "namespace app {\n", row, "target-changed"), row.port)
            << row.first << row.within;
        write("port/k.cpp", host);
        EXPECT_EQ(told("src/k.cu", device, "namespace app {\n", row, "source-changed"), row.source)
            << row.first << row.within;
        write("src/k.cu", device);
    }
    // Within the struct.
    for (const std::string member :
         {"Vec() : x(1), y(1) {\n    }\n", "Vec(const Vec& o) : x(o.y), y(o.x) {\n    }\n",
          "Vec& operator=(const Vec& o) {\n        return *this;\n    }\n",
          "operator float() const {\n        return x;\n    }\n",
          "friend Vec operator+(Vec& a, Vec& b) {\n        return a;\n    }\n", "~Vec() {\n    }\n"})
        EXPECT_TRUE(told("port/k.cpp", replaced(host, "x, y;\n", "x, y;\n    " + member), "namespace app {\n", {},
                         "target-changed"))
            << member;
    EXPECT_FALSE(told("port/k.cpp",
                      replaced(host, "x, y;\n", "x, y;\n    float length() const {\n        return x;\n    }\n"),
                      "namespace app {\n", {}, "target-changed"));
    // The same on both sides.
    write("src/k.cu", replaced(device, "typedef float real", "typedef double real"));
    EXPECT_FALSE(told("port/k.cpp", replaced(host, "typedef float real", "typedef double real"), "namespace app {\n",
                      {}, "target-changed"));
}

/// A unit whose words a comparison leaves out or takes for others, in a project whose header says what they are.
struct LeftOutRow {
    std::string from, to;  ///< the edit of the unit, if any
    std::string header;    ///< what the header says more
    bool is_told;
};

TEST_F(HostileGit, AWordThatTheComparisonLeavesOutIsToldWhereItMeansSomethingElse) {
    const std::string unit =
        "#include \"common.h\"\nfloat shade(float albedo, float cosine) {\n    float y = cosine * 2.0f;\n"
        "    register int n = 0;\n    int k = 3;\n    n = n + k;\n    cudaMemcpy(&y, &n, 4, 1);\n"
        "    return albedo * 0.5f + y;\n}\n";
    write("src/s.cu", unit);
    write("src/common.h", "#pragma once\n");
    write("port/s.cpp", replaced(unit, "#include \"common.h\"\n", ""));
    start();
    const std::string call = "cudaMemcpy(&y, &n, 4, 1)", wrapped = "CUDA_CHECK(" + call + ")", k = "int k = 3;";
    const std::string head = "float shade", tail = "cosine) {";
    const std::vector<LeftOutRow> rows = {
        {"", "", "#define register static\n", true},
        {"", "", "#define register const\n", false},
        {"", "", "#define register\n", true},  // as any macro without a body is
        {"int k", "int32_t k", "#define int32_t bool\n", true},
        {"int k", "int32_t k", "#define int32_t int\n", false},
        {"int k", "int32_t k", "typedef bool int32_t;\n", true},
        {"int k", "int32_t k", "typedef signed int int32_t;\n", false},
        {"int k", "std::int32_t k", "namespace std {\nusing int32_t = bool;\n}\n", true},
        {"int k", "std::int32_t k", "namespace std {\nusing int32_t = int;\n}\n", false},
        {call, wrapped, "#define CUDA_CHECK(x)\n", true},
        {call, wrapped, "#define CUDA_CHECK sizeof\n", true},
        {call, wrapped, "#define CUDA_CHECK(x) false && (x)\n", true},
        {call, wrapped, "#define CUDA_CHECK(x) (x)\n", false},
        {call, wrapped, "#define CUDA_CHECK(x) report((x), #x, __FILE__, __LINE__)\n", false},
        {call, wrapped,
         "#define CUDA_CHECK(x) do { cudaError_t e = (x); if (e != cudaSuccess) { fail(e); } } while (0)\n", false},
        {call, wrapped, "#define CUDA_CHECK(x) do { cudaError_t e = (x); n = 7; } while (0)\n", true},
        {call, wrapped, "#define CUDA_CHECK(x) report(x)\n#define report(x) log(x)\n", false},
        {call, wrapped, "#define CUDA_CHECK(x) report(x)\n#define report(x)\n", true},
        {call, wrapped, "#define CUDA_CHECK(x) report(x)\n#define report sizeof\n", true},
        {k, k + "\n    UNUSED(k);", "#define UNUSED ++\n", true},
        {k, k + "\n    UNUSED(k);", "#define UNUSED(x) x *= 3\n", true},
        {k, k + "\n    UNUSED(k);", "#define UNUSED(x) (void)(x)\n", false},
        {k, k + "\n    UNUSED(k);", "#define UNUSED(x) do { (void)x; } while (0)\n", false},
        {tail, "cosine) noexcept {", "#define noexcept { return 1.0f; } static float dead(float a)\n", true},
        {tail, "cosine) noexcept {", "#define noexcept\n", false},
        {head, "inline " + head, "#define inline float shade(float, float) { return 1; } template<int>\n", true},
        {head, "FORCE_INLINE " + head, "#define FORCE_INLINE static inline __attribute__((always_inline))\n", false},
        {head, "FORCE_INLINE " + head, "#define FORCE_INLINE __forceinline__\n", false},
        {head, "FORCE_INLINE " + head, "#define FORCE_INLINE OURS\n#define OURS inline\n", false},
        {head, "FORCE_INLINE " + head, "#define FORCE_INLINE OURS\n#define OURS template <int>\n", true},
        {"", "", "#define static extern\n#define volatile\ntypedef bool int64_t;\n", false},  // nobody has the word
    };
    for (const LeftOutRow& row : rows) {
        write("src/s.cu", row.from.empty() ? unit : replaced(unit, row.from, row.to));
        write("src/common.h", "#pragma once\n" + row.header);
        const CommandRun run = porttool({"check", "--base", "main", "--format", "json"});
        ASSERT_NE(run.exit_code, 2) << row.to << row.header << run.err;
        const auto got = nlohmann::json::parse(run.out);
        const bool is_told = std::any_of(got["findings"].begin(), got["findings"].end(), [](const auto& one) {
            return one["rule"] == "source-changed" && one["level"] == "error";
        });
        EXPECT_EQ(is_told, row.is_told) << row.to << row.header << got["findings"].dump(1);
    }
}

TEST_F(HostileGit, AMacroThatALeftOutOneNamesIsToldWhereItIsAnother) {
    const std::string unit =
        "#include \"common.h\"\nFORCE_INLINE float shade(float albedo, float cosine) {\n    float y = cosine;\n"
        "    CUDA_CHECK(cudaMemcpy(&y, &cosine, 4, 1));\n    CUDART_CHECK(cudaFree(&y), \"no y\");\n"
        "    HIP_CHECK(cudaFree(&y), ++y);\n    return albedo * 0.5f + y;\n}\n";
    const std::string header =
        "#pragma once\n#define OURS inline\n#define FORCE_INLINE OURS\n#define OK 0\n"
        "#define FAIL(e) abort()\n#define SAY(x) report(x)\n"
        "#define CUDA_CHECK(x) do { if (SAY(x) != OK) FAIL(x); } while (0)\n"
        "#define CUDART_CHECK(x, text) (x)\n#define HIP_CHECK(x, n) (x)\n";
    write("src/s.cu", unit);
    write("src/common.h", header);
    write("port/s.cpp", replaced(unit, "#include \"common.h\"\n", ""));
    start();
    const std::vector<std::array<std::string, 3>> rows = {
        {"#define OURS inline\n", "#define OURS static\n", ""},
        {"#define OURS inline\n", "#define OURS template <int>\n", "told"},
        {"#define OK 0\n", "#define OK 1\n", ""},
        {"SAY(x) report(x)", "SAY(x) log(x)", ""},
        {"SAY(x) report(x)", "SAY(x) 0", "told"},
        {"#define OK 0\n", "#define OK 0\n#define report(x) 0\n", "told"},
        {"#define OK 0\n", "#define OK 0\n#define report sizeof\n", "told"},
        {"#define OK 0\n", "#define OK 0\n#define others(x) 0\n", ""},
        {"CUDART_CHECK(x, text) (x)", "CUDART_CHECK(x, text) do { if (x) fail(text); } while (0)", ""},
        {"CUDART_CHECK(x, text) (x)", "CUDART_CHECK(x, text) text(x)", "told"},
        {"CUDART_CHECK(x, text) (x)", "CUDART_CHECK(x, text)", "told"},
        {"HIP_CHECK(x, n) (x)", "HIP_CHECK(x, n) do { if (x) fail(n); } while (0)", "told"},
    };
    for (const auto& [from, to, told] : rows) {
        write("src/common.h", replaced(header, from, to));
        const CommandRun run = porttool({"check", "--base", "main", "--format", "json"});
        ASSERT_NE(run.exit_code, 2) << to << run.err;
        const auto got = nlohmann::json::parse(run.out);
        const bool is_told = std::any_of(got["findings"].begin(), got["findings"].end(), [](const auto& one) {
            return one["rule"] == "source-changed" && one["level"] == "error" &&
                   one["source"]["id"] == "src/s.cu:shade";
        });
        EXPECT_EQ(is_told, !told.empty()) << to << got["findings"].dump(1);
    }
}

}  // namespace
}  // namespace porttool::testing::hostile_git_test
