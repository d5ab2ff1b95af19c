// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The command sync: what it prints, writes, runs and refuses. What it proposes is tested in sync_edit_test.cpp.
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <sstream>
#include <thread>

#include "porttool/sync/apply_journal.h"
#include "porttool/sync/bounded_command.h"
#include "porttool/sync/verify.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing {
namespace {

const std::string kTwoUnits =
    "__device__ float shade(float a, float b) {\n    float c = a * b;\n    return c * 0.5f;\n}\n"
    "__device__ float fade(float a, float b) {\n    float d = a - b;\n    return d * 3.0f;\n}\n";
const std::string kTwoPorts =
    "float shade(float a, float b) {\n    float c = a * b;\n    return c * 0.5;\n}\n"
    "float fade(float a, float b) {\n    float d = a - b;\n    return d * 3.0;\n}\n";

class SyncCommand : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        if (IsSkipped()) return;
        cache = root.string() + "_cache";
        std::filesystem::remove_all(cache);
        ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
        write("src/k.cu", kTwoUnits);
        write("port/k.comp", kTwoPorts);
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        commit("one");
    }
    void TearDown() override {
        std::filesystem::remove_all(cache);
        ::unsetenv("XDG_CACHE_HOME");
        TemporaryRepository::TearDown();
    }

    void edit(const std::string& path, const std::string& from, const std::string& to) const {
        write(path, replaced(read_text(root / path), from, to));
    }
    void edit_source() const { edit("src/k.cu", "c * 0.5f", "c * 0.25f"); }
    std::string port() const { return read_text(root / "port/k.comp"); }
    /// The JSON of a run that may leave something.
    nlohmann::json sync(std::vector<std::string> arguments, int exit_code) {
        arguments.insert(arguments.begin(), {"sync", "--format", "json"});
        const CommandRun got = porttool(arguments);
        EXPECT_EQ(got.exit_code, exit_code) << got.out << got.err;
        return got.exit_code == 2 ? nlohmann::json() : nlohmann::json::parse(got.out);
    }
    /// What is wrong, for a command line that must fail and write nothing.
    std::string error_of(std::vector<std::string> arguments) {
        const std::string before = port();
        arguments.insert(arguments.begin(), "sync");
        const CommandRun got = porttool(arguments);
        EXPECT_EQ(got.exit_code, 2) << got.out;
        EXPECT_EQ(got.out, "");
        EXPECT_LE(std::count(got.err.begin(), got.err.end(), '\n'), 3) << got.err;
        EXPECT_EQ(port(), before);
        return got.err;
    }

    std::filesystem::path cache;
};

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

const std::string kOnePorted = replaced(kTwoPorts, "c * 0.5", "c * 0.25");

TEST_F(SyncCommand, FilesOfOnePathInTwoCheckoutsAreToldApart) {
    const std::string other = root.string() + "_other";
    std::filesystem::remove_all(other);
    const auto put = [](const std::filesystem::path& path, const std::string& text) {
        std::filesystem::create_directories(path.parent_path());
        std::ofstream(path) << text;
    };
    put(other + "/k.cu", kTwoPorts);
    write("k.cu", kTwoUnits);
    write("portmap.toml", "version = 1\n[sides]\nsource = [\"*.cu\"]\ntarget = [\"*.cu\"]\ntarget_root = \"../" +
                              std::filesystem::path(other).filename().string() + "\"\n");
    ASSERT_EQ(porttool({"map", "--write", "0.5"}).exit_code, 0);
    ASSERT_EQ(porttool({"init", "--force"}).exit_code, 0);
    commit("apart");
    ASSERT_EQ(std::system(("cd '" + other +
                           "' && git init -q . && git config user.email a@b && git config user.name a"
                           " && git add -A && git commit -qm one")
                              .c_str()),
              0);
    const auto uri_of_fix = [&] {
        const nlohmann::json log = nlohmann::json::parse(porttool({"check", "--format", "sarif"}).out);
        const nlohmann::json& fix = log["runs"][0]["results"][0]["fixes"][0]["artifactChanges"];
        EXPECT_EQ(fix.size(), 1u);
        return fix[0]["artifactLocation"]["uri"].get<std::string>();
    };

    put(other + "/k.cu", kOnePorted);  // the port runs ahead: the source is written
    EXPECT_EQ(uri_of_fix(), "k.cu");
    EXPECT_EQ(sync({"--to", "source", "--apply"}, 0)["proposals"][0]["state"], "proposed");
    EXPECT_EQ(read_text(root / "k.cu"), replaced(kTwoUnits, "c * 0.5f", "c * 0.25f"));
    EXPECT_EQ(read_text(other + "/k.cu"), kOnePorted);
    EXPECT_EQ(porttool({"check"}).exit_code, 0);

    put(other + "/k.cu", kTwoPorts);
    ASSERT_EQ(porttool({"accept", "--all", "--force"}).exit_code, 0);
    write("k.cu", kTwoUnits);  // one edit on each side, of two pairs: both files are written
    ASSERT_EQ(porttool({"accept", "--all", "--force"}).exit_code, 0);
    commit("again");
    edit("k.cu", "c * 0.5f", "c * 0.25f");
    EXPECT_EQ(uri_of_fix(), "../" + std::filesystem::path(other).filename().string() + "/k.cu");
    put(other + "/k.cu", replaced(kTwoPorts, "d * 3.0", "d * 4.0"));
    sync({"--apply", "--force"}, 0);
    EXPECT_EQ(read_text(root / "k.cu"), replaced(replaced(kTwoUnits, "c * 0.5f", "c * 0.25f"), "d * 3.0f", "d * 4.0f"));
    EXPECT_EQ(read_text(other + "/k.cu"), replaced(kOnePorted, "d * 3.0", "d * 4.0"));
    EXPECT_EQ(porttool({"check"}).exit_code, 0);
    std::filesystem::remove_all(other);
}

TEST_F(SyncCommand, JsonHasTheFieldsOfTheContract) {
    edit_source();
    const nlohmann::json got = sync({}, 0);
    EXPECT_TRUE(got["verified"].is_null());
    ASSERT_EQ(got["proposals"].size(), 1u);
    const nlohmann::json& one = got["proposals"][0];
    EXPECT_EQ(one["source"], "src/k.cu:shade");
    EXPECT_EQ(one["target"], "port/k.comp:shade");
    EXPECT_EQ(one["state"], "proposed");
    EXPECT_TRUE(one["patch"].is_string());
    EXPECT_TRUE(one["map_patch"].is_null());
    EXPECT_EQ(one["left"], nlohmann::json::array());
    EXPECT_TRUE(one["why"].is_array());
    EXPECT_EQ(port(), kTwoPorts) << "without --apply nothing is written";
}

TEST_F(SyncCommand, NothingPending) {
    EXPECT_EQ(sync({}, 0)["proposals"].size(), 0u);
    const nlohmann::json one = sync({"src/k.cu:shade"}, 0)["proposals"][0];
    EXPECT_EQ(one["state"], "already");
    EXPECT_TRUE(one["patch"].is_null());
    EXPECT_EQ(porttool({"sync", "--format", "patch"}).out, "");
    EXPECT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
    EXPECT_EQ(port(), kTwoPorts);
}

TEST_F(SyncCommand, WhatNeedsNoPortIsLeftAloneUnlessItIsNamed) {
    edit_source();
    ASSERT_EQ(porttool({"ignore", "src/k.cu:shade", "--reason", "of the device alone"}).exit_code, 0);
    EXPECT_EQ(sync({}, 0)["proposals"].size(), 0u);
    EXPECT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
    EXPECT_EQ(port(), kTwoPorts);
    EXPECT_EQ(sync({"src/k.cu:shade"}, 0)["proposals"][0]["state"], "proposed");
}

TEST_F(SyncCommand, PatchesApplyOneAfterAnother) {
    edit_source();
    edit("src/k.cu", "d * 3.0f", "d * 4.0f");
    const nlohmann::json got = sync({"--all"}, 0);
    ASSERT_EQ(got["proposals"].size(), 2u);
    for (const auto& one : got["proposals"]) {
        ASSERT_TRUE(one["patch"].is_string()) << one;
        write("one.patch", one["patch"]);
        git("apply one.patch");
    }
    EXPECT_EQ(port(), replaced(kOnePorted, "d * 3.0", "d * 4.0"));
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
    git("checkout -q port");
    write("all.patch", porttool({"sync", "--format", "patch"}).out);
    git("apply all.patch");
    EXPECT_EQ(port(), replaced(kOnePorted, "d * 3.0", "d * 4.0"));
}

TEST_F(SyncCommand, AnIdOfEitherSideChoosesThePair) {
    edit_source();
    edit("src/k.cu", "d * 3.0f", "d * 4.0f");
    for (const char* id : {"src/k.cu:fade", "port/k.comp:fade", "src/k.cu:fade=port/k.comp:fade"}) {
        const nlohmann::json got = sync({id}, 0);
        ASSERT_EQ(got["proposals"].size(), 1u) << id;
        EXPECT_EQ(got["proposals"][0]["source"], "src/k.cu:fade");
    }
}

TEST_F(SyncCommand, WrongCommandLines) {
    edit_source();
    write("src/k.cu", read_text(root / "src/k.cu") + "__device__ float lone(float a) { return a; }\n");
    EXPECT_TRUE(holds(error_of({"src/k.cu:shaed"}), "did you mean 'src/k.cu:shade'?"));
    EXPECT_TRUE(holds(error_of({"src/k.cu:lone"}), "no pair has this unit"));
    EXPECT_TRUE(holds(error_of({"--all", "src/k.cu:shade"}), "leave out the ids"));
    EXPECT_TRUE(holds(error_of({"--to", "both"}), "--to"));
    EXPECT_TRUE(holds(error_of({"--format", "html"}), "known are text, json, patch"));
    EXPECT_TRUE(holds(error_of({"--force"}), "--apply"));
    EXPECT_TRUE(holds(error_of({"--partial"}), "--apply"));
    EXPECT_TRUE(holds(error_of({"--verify-timeout", "5m"}), "--verify"));
    EXPECT_TRUE(holds(error_of({"--verify"}), "put verify ="));
    EXPECT_TRUE(holds(error_of({"--verify", "src/k.cu:shade"}), "put ids before --verify"));
    for (const char* time : {"0", "-5", "5x", "m", "99999999999999999999"})
        EXPECT_TRUE(holds(error_of({"--verify=true", std::string("--verify-timeout=") + time}), "expected a time"))
            << time;
}

TEST_F(SyncCommand, ApplyWritesWhatIsProposed) {
    edit_source();
    const CommandRun got = porttool({"sync", "--apply"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    EXPECT_EQ(port(), kOnePorted);
    EXPECT_TRUE(holds(got.err, "wrote port/k.comp")) << got.err;
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
    EXPECT_EQ(porttool({"sync", "--apply"}).exit_code, 0) << "nothing is due any more";
    EXPECT_EQ(port(), kOnePorted);
}

TEST_F(SyncCommand, ApplyKeepsWhatNoCommitHolds) {
    edit_source();
    write("port/k.comp", kTwoPorts + "// a note\n");
    EXPECT_TRUE(holds(error_of({"--apply"}), "not committed"));
    git("add port");
    EXPECT_TRUE(holds(error_of({"--apply"}), "not committed")) << "nor does the index count";
    EXPECT_EQ(porttool({"sync", "--apply", "--force"}).exit_code, 0);
    EXPECT_EQ(port(), kOnePorted + "// a note\n");
}

TEST_F(SyncCommand, NothingIsProposedWrittenOrTriedThroughALink) {
    std::filesystem::create_directory(root / "real");
    std::filesystem::rename(root / "port/k.comp", root / "real/k.comp");
    std::filesystem::create_symlink("../real/k.comp", root / "port/k.comp");
    commit("a link");
    write("real/k.comp", kTwoPorts + "// a note that no commit has\n");
    edit_source();
    const std::string before = port();
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{},
                                                      {"--apply"},
                                                      {"--apply", "--force"},
                                                      {"--apply", "--partial"},
                                                      {"--verify", "touch '" + cache.string() + "x'"}}) {
        const nlohmann::json got = sync(arguments, 1);
        ASSERT_EQ(got["proposals"].size(), 1u);
        EXPECT_EQ(got["proposals"][0]["state"], "refused");
        EXPECT_TRUE(got["proposals"][0]["patch"].is_null());
        EXPECT_TRUE(holds(got["proposals"][0]["left"][0]["message"], "its file is a link, or lies behind one"));
        EXPECT_TRUE(got["verified"].is_null());
        EXPECT_EQ(port(), before);
    }
    // A folder that is a link.
    std::filesystem::remove(root / "port/k.comp");
    std::filesystem::create_directory_symlink("../real", root / "port/in");
    write("portmap.toml",
          "version = 1\n[sides]\nsource = [\"src/k.cu\"]\ntarget = [\"port/in/k.comp\"]\n[[pair]]\nsource = "
          "\"src/k.cu:shade\"\ntarget = \"port/in/k.comp:shade\"\n");
    write("src/k.cu", kTwoUnits);
    ASSERT_EQ(porttool({"init", "--force"}).exit_code, 0);
    edit_source();
    EXPECT_EQ(sync({"--apply"}, 1)["proposals"][0]["state"], "refused");
    EXPECT_FALSE(std::filesystem::exists(cache.string() + "x"));
}

TEST_F(SyncCommand, LinesOfAPatchAreNoCommands) {
    write("port/k.comp", replaced(kTwoPorts, "{\n", "{\n::error file=a::merge this\n\t::stop-commands::x\n"));
    ASSERT_EQ(porttool({"init", "--force", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    edit_source();
    for (const char* format : {"text", "explain"}) {
        const CommandRun got =
            format == std::string("text") ? porttool({"sync"}) : porttool({"explain", "src/k.cu:shade"});
        EXPECT_TRUE(holds(got.out, "u{3a}:error")) << got.out;
        std::istringstream lines(got.out);
        for (std::string line; std::getline(lines, line);) {
            const size_t first = line.find_first_not_of(" \t");
            EXPECT_FALSE(first != std::string::npos && line.compare(first, 2, "::") == 0) << line;
        }
    }
}

TEST_F(SyncCommand, ApplyOutsideOfGitNeedsForce) {
    edit_source();
    std::filesystem::remove_all(root / ".git");
    EXPECT_TRUE(holds(error_of({"--apply"}), "no git repository"));
    EXPECT_EQ(porttool({"sync", "--apply", "--force"}).exit_code, 0);
    EXPECT_EQ(port(), kOnePorted);
}

TEST_F(SyncCommand, ApplyLeavesAReadOnlyFile) {
    edit_source();
    ::chmod((root / "port/k.comp").c_str(), 0444);
    EXPECT_TRUE(holds(error_of({"--apply"}), "port/k.comp is read-only"));
    EXPECT_TRUE(holds(error_of({"--apply", "--force"}), "port/k.comp is read-only"));
    EXPECT_EQ(sync({}, 0)["proposals"][0]["state"], "proposed") << "a patch can still be had";
}

/// A disk whose second write fails.
TEST(SyncWrites, AllFilesOrNone) {
    class FullDisk final : public Disk {
    public:
        explicit FullDisk(MemoryDisk& below) : below_(below) {}
        FileText read(const std::string& path, uint64_t limit) const override { return below_.read(path, limit); }
        FileText read(const TreePath& path, uint64_t limit) const override { return below_.read(path, limit); }
        FolderList list(const TreePath& path) const override { return below_.list(path); }
        FileKind kind(const TreePath& path) const override { return below_.kind(path); }
        bool is_directory(const std::string& path) const override { return below_.is_directory(path); }
        bool exists(const std::string& path) const override { return below_.exists(path); }
        std::string write(const std::string& path, const std::string& bytes) override {
            return below_.write(path, bytes);
        }
        std::string write(const TreePath& path, const std::string& bytes) override {
            return path.path == "port/l.comp" ? "cannot be written: No space left on device"
                                              : below_.write(path, bytes);
        }
        std::string remove(const TreePath& path) override { return below_.remove(path); }
        TakenGuard guard(const TreePath& path) override { return below_.guard(path); }

    private:
        MemoryDisk& below_;
    };
    MemoryDisk disk;
    const std::string f = "float f(float a) {\n    return a * 2.0;\n}\n", g = replaced(f, "f(", "g(");
    disk.files = {{"/r/src/k.c", f}, {"/r/src/l.c", g}, {"/r/port/k.comp", f}, {"/r/port/l.comp", g}};
    ASSERT_EQ(run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    for (const char* path : {"/r/src/k.c", "/r/src/l.c"}) disk.files[path] = replaced(disk.files[path], "2.0", "3.0");
    const auto before = disk.files;
    FullDisk full(disk);
    const CommandRun got = run(full, {"-C", "/r", "sync", "--apply", "--force"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_TRUE(holds(got.err, "port/l.comp: cannot be written: No space left on device; nothing was written"))
        << got.err;
    EXPECT_EQ(disk.files, before);
    EXPECT_EQ(run(disk, {"-C", "/r", "sync", "--apply", "--force"}).exit_code, 0);
    EXPECT_EQ(disk.files["/r/port/l.comp"], replaced(g, "2.0", "3.0"));
}

TEST_F(SyncCommand, TheRealDiskWritesAllFilesOrNone) {
    write("a", "1");
    std::filesystem::create_directories(root / "c");
    const std::string failure =
        disk.write_all({{{root.string(), "a"}, "2"}, {{root.string(), "b"}, "2"}, {{root.string(), "c"}, "2"}});
    EXPECT_TRUE(holds(failure, "/c: cannot be written")) << failure;
    EXPECT_EQ(read_text(root / "a"), "1");
    size_t others = 0;
    for (const auto& entry : std::filesystem::directory_iterator(root))
        others += holds(entry.path().filename().string(), "porttool-") || entry.path().filename() == "b";
    EXPECT_EQ(others, 0u);
    EXPECT_EQ(disk.write_all({{{root.string(), "a"}, "2"}, {{root.string(), "new/b"}, "2"}}), "");
    EXPECT_EQ(read_text(root / "a") + read_text(root / "new/b"), "22");
}

TEST_F(SyncCommand, TellsOfAnApplyThatWasKilled) {
    edit_source();
    // A process that is no more: a child that has ended, and was waited for.
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    const std::string number = std::to_string(child), end(1, '\0');
    write(".git/porttool/apply", number + end + root.string() + end + "port/k.comp" + end + "1" + end + "2" + end +
                                     root.string() + end + "portmap.lock" + end + "1" + end + "2" + end);
    write("port/k.comp.porttool-" + number + ".1", "half");
    const CommandRun got = porttool({"sync"});
    EXPECT_TRUE(holds(got.err,
                      "was killed while it wrote; some of these files have its text, some not:\n"
                      "    port/k.comp\n    portmap.lock\n"))
        << got.err;
    EXPECT_FALSE(std::filesystem::exists(root / ("port/k.comp.porttool-" + number + ".1")));
    EXPECT_EQ(porttool({"sync"}).err, "") << "it is told once";

    // A `.git` may come in an archive: a note of files elsewhere, or one behind a link, is none of ours.
    const std::filesystem::path outside = root.string() + "_outside", left = outside / ("a.porttool-" + number + ".1");
    std::filesystem::create_directories(outside);
    std::ofstream(outside / "a") << "precious";
    std::ofstream(left) << "planted";
    const std::string print = std::to_string(hash_text("precious")), planted = std::to_string(hash_text("planted"));
    write(".git/porttool/apply", number + end + outside.string() + end + "a" + end + print + end + planted + end +
                                     root.string() + end + "port/k.comp" + end + "1" + end +
                                     std::to_string(hash_text(port())) + end);
    EXPECT_EQ(porttool({"sync"}).err, "");
    EXPECT_EQ(read_text(outside / "a") + read_text(left), "preciousplanted");
    std::filesystem::remove_all(root / ".git/porttool");
    std::filesystem::create_directory_symlink(outside, root / ".git/porttool");
    EXPECT_EQ(porttool({"history"}).exit_code, 0);
    EXPECT_EQ(porttool({"sync"}).exit_code, 0);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(outside), std::filesystem::directory_iterator()), 2);
    std::filesystem::remove_all(outside);
    std::filesystem::remove(root / ".git/porttool");
    EXPECT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
    EXPECT_EQ(port(), kOnePorted);
    EXPECT_EQ(porttool({"sync"}).err, "");
}

TEST_F(SyncCommand, WhatCannotBeReadIsNotGone) {
    for (const std::string path : {"port/k.comp", "src/k.cu"}) {
        const std::string text = read_text(root / path);
        std::filesystem::remove(root / path);
        std::filesystem::create_directory(root / path);
        for (const nlohmann::json& one : sync({}, 1)["proposals"]) {
            EXPECT_EQ(one["state"], "refused") << one.dump(1);
            EXPECT_TRUE(holds(one["left"][0]["message"], "is not a regular file; make it readable")) << one.dump(1);
        }
        std::filesystem::remove(root / path);
        write(path, text);
    }
    // Nor does a port go that a file may use which cannot be read.
    write("src/k.cu", "");
    write("port/user.comp", std::string("\0\0shade", 7));
    for (const nlohmann::json& one : sync({}, 1)["proposals"])
        EXPECT_TRUE(holds(one["left"][0]["message"], "`port/user.comp` could not be read and may use it"));
}

TEST_F(SyncCommand, AnApplyThatWasKilledIsFinishedByTheNextRun) {
    write("src/l.cu", replaced(replaced(kTwoUnits, "shade(", "glow("), "fade(", "dim("));
    write("port/l.comp", replaced(replaced(kTwoPorts, "shade(", "glow("), "fade(", "dim("));
    ASSERT_EQ(porttool({"init", "--force", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    commit("two files");
    // Writes as sync does, and dies when one of the two has its text.
    const auto killed = [&] {
        const pid_t child = ::fork();
        if (child == 0) {
            std::vector<WrittenFile> files;
            for (const char* path : {"port/k.comp", "port/l.comp"}) {
                const std::string before = read_text(root / path);
                files.push_back({{root.string(), path}, before, replaced(before, "c * 0.5", "c * 0.25")});
                write(std::string(path) + ".porttool-" + std::to_string(::getpid()) + ".1", files.back().now);
            }
            ApplyJournal(root.string(), disk).begin(files);
            write("port/k.comp", files.front().now);
            std::filesystem::remove(root / ("port/k.comp.porttool-" + std::to_string(::getpid()) + ".1"));
            ::_exit(0);
        }
        ::waitpid(child, nullptr, 0);
    };
    for (const char* path : {"src/k.cu", "src/l.cu"}) edit(path, "c * 0.5f", "c * 0.25f");
    killed();
    EXPECT_TRUE(holds(porttool({"sync"}).err, "what it had left is written now:\n    port/k.comp\n    port/l.comp\n"));
    EXPECT_TRUE(holds(port(), "c * 0.25;"));
    EXPECT_TRUE(holds(read_text(root / "port/l.comp"), "c * 0.25;"));
    EXPECT_EQ(porttool({"check"}).exit_code, 0);

    // What somebody wrote since is not written over.
    git("checkout port");
    killed();
    write("port/l.comp", kTwoPorts);
    EXPECT_TRUE(holds(porttool({"sync"}).err, "some of these files have its text, some not"));
    EXPECT_EQ(read_text(root / "port/l.comp"), kTwoPorts);
}

TEST_F(SyncCommand, VerifyRunsOnACopyWithThePatches) {
    edit_source();
    const nlohmann::json got =
        sync({"--verify", "cat port/k.comp src/k.cu; pwd; git rev-parse HEAD; git status --short; exit 0"}, 0);
    const nlohmann::json& verified = got["verified"];
    EXPECT_EQ(verified["exit_code"], 0);
    EXPECT_TRUE(verified["command"].get<std::string>().starts_with("cat port/k.comp"));
    EXPECT_LT(verified["seconds"].get<double>(), 5);
    const std::string tail = verified["output_tail"];
    EXPECT_TRUE(holds(tail, "return c * 0.25;")) << tail;
    EXPECT_TRUE(holds(tail, "return c * 0.25f;")) << "with what is not committed: " << tail;
    EXPECT_TRUE(holds(tail, " M port/k.comp\n M src/k.cu\n")) << tail;
    EXPECT_TRUE(holds(tail, std::filesystem::canonical(cache).string())) << tail;
    EXPECT_EQ(port(), kTwoPorts);
    EXPECT_EQ(std::system(("test -z \"$(git -C '" + root.string() + "' worktree list | tail -n +2)\"").c_str()), 0);
}

TEST_F(SyncCommand, VerifyKeepsWhatWasBuilt) {
    edit_source();
    write("gone.txt", "1");
    git("add gone.txt");
    sync({"--verify", "cp port/k.comp built; stat -c %Y.%y src/k.cu > stamp; echo x >> src/k.cu"}, 0);
    git("rm -qf gone.txt");
    edit("src/k.cu", "c * 0.25f", "c * 0.125f");
    const std::string tail =
        sync({"--verify", "cat built; tail -1 src/k.cu; ls gone.txt; cat port/k.comp"}, 0)["verified"]["output_tail"];
    EXPECT_TRUE(holds(tail, "c * 0.25;")) << "the file of the run before is there: " << tail;
    EXPECT_TRUE(holds(tail, "c * 0.125;")) << tail;
    EXPECT_FALSE(holds(tail, "x\n")) << "a tracked file is as the user has it: " << tail;
    EXPECT_TRUE(holds(tail, "No such file")) << tail;
}

TEST_F(SyncCommand, VerifyLeavesFilesThatStayedTheSame) {
    edit_source();
    const std::string stamp = "stat -c %y port/k.comp src/k.cu portmap.toml";
    const auto first = sync({"--verify", stamp}, 0)["verified"]["output_tail"];
    EXPECT_EQ(sync({"--verify", stamp}, 0)["verified"]["output_tail"], first) << "else a build would begin anew";
}

TEST_F(SyncCommand, AFailedVerificationIsNeverApplied) {
    edit_source();
    const nlohmann::json got = sync({"--apply", "--force", "--verify", "echo broken >&2; exit 3"}, 1);
    EXPECT_EQ(got["verified"]["exit_code"], 3);
    EXPECT_EQ(got["verified"]["output_tail"], "broken\n");
    EXPECT_EQ(got["proposals"][0]["state"], "partial");
    ASSERT_EQ(got["proposals"][0]["left"].size(), 1u);
    EXPECT_TRUE(holds(got["proposals"][0]["left"][0]["message"], "exit code 3"));
    EXPECT_EQ(port(), kTwoPorts);
    EXPECT_EQ(sync({"--apply", "--partial", "--verify", "false"}, 1)["verified"]["exit_code"], 1);
    EXPECT_EQ(port(), kTwoPorts) << "--partial does not change that";
    EXPECT_EQ(sync({"--apply", "--verify", "true"}, 0)["verified"]["exit_code"], 0);
    EXPECT_EQ(port(), kOnePorted);
}

TEST_F(SyncCommand, AVerificationThatHangsIsStopped) {
    edit_source();
    const auto start = std::chrono::steady_clock::now();
    const std::string mark = (root / "late").string();
    const nlohmann::json got = sync(
        {"--apply", "--verify-timeout", "1", "--verify", "(sleep 1.7; touch '" + mark + "') & echo on; sleep 60"}, 1);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(3));
    EXPECT_EQ(got["verified"]["exit_code"], 124);
    EXPECT_EQ(got["verified"]["output_tail"], "on\n");
    EXPECT_TRUE(holds(got["proposals"][0]["left"][0]["message"], "--verify-timeout"));
    EXPECT_EQ(port(), kTwoPorts);
    std::this_thread::sleep_for(std::chrono::milliseconds(1000));
    EXPECT_FALSE(std::filesystem::exists(mark)) << "what it had started has ended, too";
}

// Each proposal has the files of its pair read anew: thousands of edits of one large file would take hours.
TEST_F(SyncCommand, MoreThanOneRunLooksAtIsSaidSo) {
    constexpr int kEdits = 20;
    const std::string padding = "/*" + std::string(size_t{15} << 20, '-') + "*/\n";
    const auto text = [&](const std::string& head, const std::string& factor) {
        std::string out = padding;
        for (int i = 0; i < kEdits; ++i)
            out += head + "float f" + std::to_string(i) + "(float x) {\n    return x * " + factor + ";\n}\n";
        return out;
    };
    write("src/k.cu", text("__device__ ", "0.5f"));
    write("port/k.comp", text("", "0.5"));
    ASSERT_EQ(porttool({"init", "--force", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    write("src/k.cu", text("__device__ ", "0.25f"));
    const nlohmann::json proposals = sync({}, 1)["proposals"];
    size_t proposed = 0, refused = 0;
    for (const nlohmann::json& one : proposals) {
        proposed += one["state"] == "proposed" ? 1 : 0;
        if (one["state"] != "refused") continue;
        ++refused;
        EXPECT_TRUE(holds(one["left"][0]["message"], "more edits of large files than one run looks at")) << one;
    }
    EXPECT_EQ(proposed, 18u);  // half a GiB and a little
    EXPECT_EQ(proposed + refused, static_cast<size_t>(kEdits));
    EXPECT_EQ(sync({"src/k.cu:f19"}, 0)["proposals"][0]["state"], "proposed");
}

// What prints faster than it can be read must not keep the clock from being looked at; nor what has left the group.
TEST_F(SyncCommand, AVerificationThatPrintsWithoutEndIsStopped) {
    edit_source();
    const auto start = std::chrono::steady_clock::now();
    const nlohmann::json got =
        sync({"--verify-timeout", "1", "--verify", "setsid timeout 8 yes & for i in 1 2 3 4; do yes & done; wait"}, 1);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    EXPECT_EQ(got["verified"]["exit_code"], 124);
    EXPECT_LE(got["verified"]["output_tail"].get<std::string>().size(), 8192u);
}

TEST_F(SyncCommand, OnlyTheCommandLineMakesTheMapsCommandRun) {
    write("portmap.toml",
          read_text(root / "portmap.toml") + "\n[sync]\nverify = \"touch '" + (root / "ran").string() + "'\"\n");
    edit_source();
    sync({}, 0);
    EXPECT_EQ(porttool({"check"}).exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(root / "ran"));
    sync({"--verify", "true"}, 0);
    EXPECT_FALSE(std::filesystem::exists(root / "ran")) << "another command was given";
    const nlohmann::json got = sync({"--verify"}, 0);
    EXPECT_TRUE(std::filesystem::exists(root / "ran"));
    EXPECT_TRUE(got["verified"]["command"].get<std::string>().starts_with("touch "));
    write("portmap.toml", replaced(read_text(root / "portmap.toml"), "verify =", "verfiy ="));
    EXPECT_TRUE(holds(error_of({"--verify"}), "unknown key 'verfiy' in [sync]; did you mean 'verify'?"));
}

TEST_F(SyncCommand, NothingDueRunsNothing) {
    EXPECT_TRUE(sync({"--verify", "touch '" + (root / "ran").string() + "'"}, 0)["verified"].is_null());
    EXPECT_FALSE(std::filesystem::exists(root / "ran"));
}

TEST_F(SyncCommand, TheCopyLiesOutsideOfTheRepository) {
    edit_source();
    ::setenv("XDG_CACHE_HOME", (root / "cache").c_str(), 1);
    EXPECT_TRUE(holds(error_of({"--verify", "true"}), "Set XDG_CACHE_HOME to a folder outside"));
    EXPECT_FALSE(std::filesystem::exists(root / "cache")) << "nothing is made before that is known";
    // What is committed may be a link that leads out again.
    const std::filesystem::path victim = root.string() + "_victim";
    std::filesystem::create_directory(victim);
    std::filesystem::permissions(victim, std::filesystem::perms::owner_all | std::filesystem::perms::others_read);
    std::filesystem::create_directory(root / "cache");
    std::filesystem::create_symlink(victim, root / "cache/porttool");
    EXPECT_TRUE(holds(error_of({"--verify", "true"}), "Set XDG_CACHE_HOME to a folder outside"));
    EXPECT_TRUE(std::filesystem::is_empty(victim));
    EXPECT_NE(std::filesystem::status(victim).permissions() & std::filesystem::perms::others_read,
              std::filesystem::perms::none);
    std::filesystem::remove_all(victim);
    std::filesystem::remove_all(root / "cache");
    std::filesystem::remove_all(root / ".git");
    ::setenv("XDG_CACHE_HOME", cache.c_str(), 1);
    EXPECT_TRUE(holds(error_of({"--verify", "true"}), "in no git repository"));
}

TEST(BoundedCommand, KeepsTheEndOfALongOutput) {
    const CommandEnd end =
        run_bounded("i=0; while [ $i -lt 20000 ]; do echo line $i; i=$((i+1)); done; echo last >&2; exit 7", "/",
                    std::chrono::seconds(30));
    EXPECT_EQ(end.exit_code, 7);
    EXPECT_LE(end.output_tail.size(), 8192u);
    EXPECT_TRUE(end.output_tail.starts_with("line ")) << "whole lines";
    EXPECT_TRUE(end.output_tail.ends_with("line 19999\nlast\n"));
}

TEST(BoundedCommand, EndsWithItsShell) {
    const auto start = std::chrono::steady_clock::now();
    const CommandEnd end = run_bounded("sleep 30 & exit 0", "/", std::chrono::seconds(20));
    EXPECT_EQ(end.exit_code, 0);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
    EXPECT_EQ(run_bounded("kill -SEGV $$", "/", std::chrono::seconds(20)).exit_code, 128 + SIGSEGV);
    EXPECT_EQ(run_bounded("cat; exit 5", "/", std::chrono::seconds(20)).exit_code, 5) << "nothing is on its stdin";
}

TEST(BoundedCommand, Durations) {
    using std::chrono::seconds;
    EXPECT_EQ(parse_duration("90"), seconds(90));
    EXPECT_EQ(parse_duration("90s"), seconds(90));
    EXPECT_EQ(parse_duration("5m"), seconds(300));
    EXPECT_EQ(parse_duration("2h"), seconds(7200));
    for (const char* text : {"", "0", "0m", "-1", "1.5m", "5 m", "m", "5ms", "+5"})
        EXPECT_FALSE(parse_duration(text)) << text;
}

}  // namespace
}  // namespace porttool::testing
