// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What a pull request may try on the gate that checks it (docs/security.md). The oracle is the disk: a secret that must
// not show in any output, and files that must not change.
#include <sys/stat.h>

#include <functional>

#include "porttool/read/git_repository.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/source_files.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::hostile_change_test {
namespace {
namespace fs = std::filesystem;

const std::string kSource =
    "__device__ float f(float x) {\n    return x * 2.0f;\n}\n__device__ float g(float x) {\n    float y = x + 1.0f;\n  "
    "  return y * 3.0f;\n}\n";
const std::string kTarget =
    "float f(float x) {\n    return x * 2.0f;\n}\nfloat g(float x) {\n    float y = x + 1.0f;\n    return y * "
    "3.0f;\n}\n";
const std::string kSecret = "ghs_TheTokenOfTheCheckout";

class HostileChange : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        if (IsSkipped()) return;
        outside = root.string() + "_outside";
        fs::remove_all(outside);
        fs::create_directories(outside);
        std::ofstream(outside / "0123456789abcdef") << kSecret;
        std::ofstream(outside / "notes.txt") << "precious";
        std::ofstream(outside / "secret.cu") << "float " << kSecret << "(float x) { return x * 7.0f; }\n";
        write("src/k.cu", kSource);
        write("port/k.cpp", kTarget);
        ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
        commit("start");
        std::ofstream(root / ".git" / "config", std::ios::app)
            << "[http]\n\textraheader = AUTHORIZATION: basic " << kSecret << "\n";
    }
    void TearDown() override {
        fs::remove_all(outside);
        TemporaryRepository::TearDown();
    }
    void edit_both() {
        write("src/k.cu", replaced(kSource, "3.0f", "4.0f"));
        write("port/k.cpp", replaced(kTarget, "3.0f", "5.0f"));
    }
    void link(const fs::path& target, const std::string& name) const {
        fs::remove_all(root / name);
        fs::create_symlink(target, root / name);
    }
    /// No command in any format shows the secret or harms what lies outside; each ends with a code of ours.
    void expect_harmless(bool all = true) {
        std::vector<std::vector<std::string>> commands = {
            {"check"},
            {"check", "--format", "json"},
            {"check", "--format", "markdown"},
            {"check", "--format", "sarif"},
            {"check", "--base", "main", "--format", "json"},
            {"check", "--base", "main", "--trusted-map"},
            {"explain", "src/k.cu:g"},
            {"scan", root.string(), "--format", "json"},
            {"map", "--format", "json"},
            {"report", "--format", "html"},
            {"review", "--format", "json"},
            {"sync", "--all"},
            {"sync", "--all", "--base", "main", "--format", "json"},
            {"sync", "--all", "--apply", "--partial", "--force"},
            {"audit", "--format", "json"},
            {"history", "--format", "json"},
            {"effort", "--from", "main", "--to", "HEAD"},
            {"accept", "src/k.cu:g"},
            {"ignore", "src/k.cu:f", "--reason", "x"},
            {"accept", "--all", "--force"},
            {"init", "--force"},
            {"init", "--force", "--source", "src/*", "--target", "port/*"}};
        if (!all) commands = {{"check", "--format", "json"}, {"report", "--format", "html"}, {"init", "--force"}};
        for (const auto& command : commands) {
            const CommandRun got = porttool(command);
            EXPECT_TRUE(got.exit_code >= 0 && got.exit_code <= 2) << command[0];
            EXPECT_EQ((got.out + got.err).find(kSecret), std::string::npos) << command[0] << "\n" << got.out << got.err;
            EXPECT_TRUE(got.exit_code < 2 || got.out.empty()) << command[0];
        }
        EXPECT_EQ(read_text(outside / "0123456789abcdef"), kSecret);
        EXPECT_EQ(read_text(outside / "notes.txt"), "precious");
        EXPECT_EQ(std::distance(fs::directory_iterator(outside), fs::directory_iterator()), 3);
        EXPECT_NE(read_text(root / ".git" / "config").find(kSecret), std::string::npos);
    }

    fs::path outside;
};

TEST_F(HostileChange, ALinkedBaseFolderIsRefused) {
    for (const bool within : {false, true}) {
        if (within) fs::create_directories(root / "other");
        link(within ? fs::path("other") : outside, "portmap.base");
        for (const auto& command : std::vector<std::vector<std::string>>{
                 {"check"}, {"accept", "--all"}, {"ignore", "src/k.cu:f", "--reason", "x"}, {"init", "--force"}}) {
            const CommandRun got = porttool(command);
            EXPECT_EQ(got.exit_code, 2) << command[0];
            EXPECT_NE(got.err.find("portmap.base: is a link"), std::string::npos) << got.err;
        }
    }
    expect_harmless();
}

TEST_F(HostileChange, PrintsThatArePathsAreRefused) {
    const std::string good = read_text(root / "portmap.lock");
    const std::string print = read_lock(good).lock.pairs.at(0).source_prints.written.text();
    for (const std::string& path : {std::string("../.git/config"), (outside / "notes.txt").string(),
                                    std::string("../../") + outside.filename().string() + "/notes.txt",
                                    std::string("."), std::string("0123456789abcde/")}) {
        write("portmap.lock", replaced(good, print, path));
        const CommandRun got = porttool({"check", "--format", "markdown"});
        EXPECT_EQ(got.exit_code, 2) << path;
        EXPECT_NE(got.err.find("is no fingerprint"), std::string::npos) << got.err;
    }
    expect_harmless();
}

TEST_F(HostileChange, LinkedOrForgedBaseTextsAreNotShown) {
    const auto texts = [&] {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(root / "portmap.base"))
            names.push_back("portmap.base/" + entry.path().filename().string());
        return names;
    };
    edit_both();
    for (const fs::path& target : {fs::path("../.git/config"), outside / "0123456789abcdef"}) {
        for (const std::string& name : texts()) link(target, name);
        const auto got = nlohmann::json::parse(porttool({"check", "--format", "json"}).out);
        EXPECT_EQ(got["verdict"], "drift") << "an edit whose earlier text is not known stays loud";
    }
    // A text that makes the two edits look alike, under the name of another.
    for (const std::string& name : texts()) {
        fs::remove(root / name);
        write(name, "float @ ( float x ) {\nreturn x ;\n}\n");
    }
    EXPECT_EQ(porttool({"check"}).exit_code, 1);
    expect_harmless();
}

TEST_F(HostileChange, SourcesMapAndLockThatLeadOutAreNotRead) {
    struct Row {
        const char* file;
        fs::path target;
        int exit_code;
    };
    const std::vector<Row> rows = {
        {"src/k.cu", outside / "secret.cu", 1},
        {"src/k.cu", "../.git/config", 1},
        {"src/k.cu", "../../" + outside.filename().string() + "/secret.cu", 1},
        {"port/k.cpp", outside / "secret.cu", 1},
        {"src", outside, 1},
        {"src", ".git", 1},
        {"src/sub", outside, 0},
        {"src/new.cu", outside / "secret.cu", 0},
        {"src/new.cu", "/proc/self/environ", 0},
        {"src/.gitignore", outside / "notes.txt", 0},
        {"portmap.toml", outside / "notes.txt", 2},
        {"portmap.toml", ".git/config", 2},
        {"portmap.lock", outside / "notes.txt", 2},
        {"portmap.lock", ".git/config", 2},
        {"portmap.lock", outside / "new", 2},
    };
    for (const Row& row : rows) {
        link(row.target, row.file);
        const CommandRun got = porttool({"check"});
        EXPECT_EQ(got.exit_code, row.exit_code) << row.file << " -> " << row.target << "\n" << got.out << got.err;
        const bool is_source = std::string(row.file) != "src/.gitignore" && std::string(row.file) != "src/sub";
        if (is_source) {
            EXPECT_TRUE((got.out + got.err).find("and is not followed") != std::string::npos ||
                        (got.out + got.err).find("lies in .git") != std::string::npos)
                << row.file << " is named\n"
                << got.out << got.err;
        }
        expect_harmless(false);
        git("checkout -q -f main && git -C '" + root.string() + "' clean -qfd");
    }
}

TEST_F(HostileChange, GlobsOfAMapStayBeneathTheRoot) {
    const std::string map = read_text(root / "portmap.toml");
    const std::string up = "../" + outside.filename().string();
    for (const std::string& glob :
         {std::string("../**"), up + "/*.cu", "src/../" + up + "/*.cu",
          "{src,../" + outside.filename().string() + "}/*.cu", outside.string() + "/*.cu", std::string("/etc/*"),
          std::string("../"), std::string(".."), std::string("src/../../**/*.cu"), std::string(".git/config"),
          std::string(".git/*"), std::string("{.git/config,src/*}")}) {
        write("portmap.toml", replaced(map, "\"src/*\"", "\"" + glob + "\", \"src/*\""));
        const CommandRun got = porttool({"check"});
        EXPECT_TRUE(got.exit_code == 2 || got.out.find("lies in .git") != std::string::npos)
            << glob << got.out << got.err;
        EXPECT_EQ((got.out + got.err).find(kSecret), std::string::npos) << glob;
    }
    write("portmap.toml", map);
    const CommandRun own = porttool({"map", "--source", up + "/*.cu", "--target", "port/*", "--format", "json"});
    EXPECT_EQ(own.exit_code, 0) << "globs of the command line are the user's own: " << own.err;
    EXPECT_NE(own.out.find(kSecret), std::string::npos);
    fs::remove(root / "portmap.toml");
    EXPECT_EQ(porttool({"init", "--force", "--source", up + "/*.cu", "--target", "port/*"}).exit_code, 2);
    EXPECT_FALSE(fs::exists(root / "portmap.toml"));
}

TEST_F(HostileChange, ATargetRootIsTheDeclaredWayOut) {
    write("../" + outside.filename().string() + "/k.cpp", kTarget);
    const std::string map = replaced(read_text(root / "portmap.toml"), "[sides]",
                                     "[sides]\ntarget_root = \"../" + outside.filename().string() + "\"");
    std::string flat = map;
    while (flat.find("port/k.cpp") != std::string::npos) flat = replaced(flat, "port/k.cpp", "k.cpp");
    write("portmap.toml", replaced(flat, "port/*", "k.cpp"));
    EXPECT_EQ(porttool({"init", "--force"}).exit_code, 0);
    EXPECT_EQ(porttool({"check"}).exit_code, 0);
    write("portmap.toml", replaced(flat, "port/*", "../" + root.filename().string() + "/port/*"));
    EXPECT_EQ(porttool({"check"}).exit_code, 2) << "but its globs stay beneath it";
}

TEST_F(HostileChange, ATargetRootLeadsNeitherIntoGitNorOutBehindALinkAndElsewhereToSourcesOnly) {
    const auto with_root = [&](const std::string& target_root, const std::string& glob, const std::string& id) {
        git("checkout -q -f main");
        std::string map =
            replaced(read_text(root / "portmap.toml"), "[sides]", "[sides]\ntarget_root = \"" + target_root + "\"");
        std::string lock = read_text(root / "portmap.lock");
        map = replaced(replaced(map, "\"port/*\"", "\"" + glob + "\""), "\"port/k.cpp:f\"", "\"" + id + "\"");
        write("portmap.toml", replaced(map, "\"port/k.cpp:g\"", "\"" + id + "2\""));
        write("portmap.lock", replaced(lock, "port/k.cpp:f", id));
    };
    const std::string here = root.filename().string();
    for (const std::string& spelling :
         {std::string(".git"), std::string("./.git"), std::string("x/../.git"), "../" + here + "/.git",
          (root / ".git").string(), std::string(".git/.."), std::string(".git/hooks")}) {
        if (spelling == ".git/..") continue;  // that is the root
        with_root(spelling, "config", "config:@file");
        EXPECT_EQ(porttool({"check"}).exit_code, 2) << spelling;
        expect_harmless(false);
    }
    link("../../" + here + "/.git", "aside");
    with_root("aside", "config", "config:@file");
    EXPECT_EQ(porttool({"check"}).exit_code, 2);
    expect_harmless(false);
    // Without a change of the map: the folder that it names becomes a link.
    git("checkout -q -f main && git -C '" + root.string() + "' clean -qfd");
    fs::remove_all(root / "port");
    link(outside, "port");
    with_root("port", "*", "secret.cu:" + kSecret);
    fs::remove_all(root / "port");
    link(outside, "port");
    EXPECT_EQ(porttool({"check"}).exit_code, 2);
    expect_harmless(false);
    git("checkout -q -f main && git -C '" + root.string() + "' clean -qfd");
    // The whole disk is no checkout.
    link("/", "disk");
    for (const std::string& disk_root :
         {std::string("/"), std::string("//"), std::string("../../../../../../../.."), "../" + here + "/disk"}) {
        with_root(disk_root, "**", "etc/passwd:@file");
        link("/", "disk");
        const CommandRun got = porttool({"check"});
        EXPECT_EQ(got.exit_code, 2) << disk_root;
        EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << got.err;
        fs::remove(root / "disk");
    }
    // Another checkout, or what says so: sources only.
    for (const char* name : {"notes.txt", "0123456789abcdef"}) {
        with_root(outside.string(), name, std::string(name) + ":@file");
        EXPECT_EQ(porttool({"check"}).exit_code, 2) << name;
        EXPECT_EQ(porttool({"report", "--format", "html"}).out.find("precious"), std::string::npos);
        with_root(outside.string(), "*.*", std::string(name) + ":@file");
        EXPECT_EQ(porttool({"report", "--format", "html"}).out.find("precious"), std::string::npos);
    }
}

TEST_F(HostileChange, IgnoringWhatGitTracksHidesNothing) {
    write("src/new.cu", "__device__ float fresh(float x) { return x; }\n");
    EXPECT_EQ(porttool({"check"}).exit_code, 1) << "unported";
    write(".gitignore", "new.cu\n*.tmp\n");
    EXPECT_EQ(porttool({"check"}).exit_code, 0) << "ignored, and git does not track it";
    git("add -f src/new.cu .gitignore");
    EXPECT_EQ(porttool({"check"}).exit_code, 1) << "git tracks it";
    EXPECT_EQ(porttool({"check", "--base", "HEAD", "--trusted-map"}).exit_code, 1);
    write(".gitignore", "src/\n");
    EXPECT_EQ(porttool({"check", "--base", "HEAD"}).exit_code, 1) << "a whole folder";
}

TEST_F(HostileChange, ARepositoryThatTheChangeBringsAlongIsNotAsked) {
    // The map in a subfolder, and beside it what looks like a repository of its own.
    for (const char* name : {"src", "port", "portmap.toml", "portmap.lock", "portmap.base"}) {
        fs::create_directories(root / "sub");
        fs::rename(root / name, root / "sub" / name);
    }
    commit("into a subfolder", 2);
    git("checkout -q -b feature");
    write("sub/src/k.cu", replaced(kSource, "3.0f", "4.0f"));
    commit("an edit", 3);
    const std::string folder = (root / "sub").string();
    ASSERT_EQ(porttool({"check", "--base", "main", "--trusted-map"}, folder).exit_code, 1);
    const std::string copy = outside.string() + "_copy";
    fs::remove_all(copy);
    fs::copy(folder, copy, fs::copy_options::recursive);
    const std::string fake =
        "cd '" + copy +
        "' && git init -q -b main . && git config user.email a@b && git config user.name a && git add -A && "
        "git commit -qm fake && git config core.bare false && git config core.worktree .";
    ASSERT_EQ(std::system(fake.c_str()), 0);
    for (const char* name : {"HEAD", "objects", "refs", "config"})
        fs::copy(copy + "/.git/" + name, root / "sub" / name, fs::copy_options::recursive);
    fs::remove_all(copy);
    EXPECT_EQ(porttool({"check", "--base", "main", "--trusted-map"}, folder).exit_code, 1);
}

TEST_F(HostileChange, ACopyElsewhereDoesNotStandForAFileThatCannotBeRead) {
    git("checkout -q -b feature");
    write("src/decoy.cu", kSource);
    write("src/k.cu", std::string("// \0\n", 5) + replaced(kSource, "3.0f", "4.0f"));
    commit("unreadable", 2);
    EXPECT_EQ(porttool({"check", "--base", "main", "--trusted-map"}).exit_code, 1);
    EXPECT_EQ(porttool({"check"}).exit_code, 1);
    git("mv src/k.cu src/k.txt");  // a suffix that no glob takes: followed, and said so
    write("src/k.txt", replaced(kSource, "3.0f", "4.0f"));
    commit("moved out of sight", 3);
    const auto got =
        nlohmann::json::parse(porttool({"check", "--base", "main", "--trusted-map", "--format", "json"}).out);
    std::set<std::string> texts;
    for (const auto& one : got["brought_in"]) texts.insert(one["text"]);
    EXPECT_TRUE(texts.contains("src/k.cu:g is followed to src/decoy.cu:g")) << got["brought_in"].dump(1);
}

TEST_F(HostileChange, WhatNarrowerGlobsLeaveOutWasNotGoneBefore) {
    git("checkout -q -b feature");
    write("src/k.cu", replaced(kSource, "3.0f", "4.0f"));
    write("src/other.cu", "// nothing\n");
    write("portmap.toml", replaced(read_text(root / "portmap.toml"), "\"src/*\"", "\"src/o*\""));
    const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    EXPECT_EQ(got["verdict"], "review") << got["findings"].dump(1);
    EXPECT_EQ(porttool({"check", "--base", "main", "--trusted-map"}).exit_code, 1);
}

TEST_F(HostileChange, ALineOfTheBaselineExcusesOneUnit) {
    const std::string old = "__device__ float h(float x) {\n    return x - 7.5f;\n}\n";
    write("src/k.cu", kSource + old);
    ASSERT_EQ(porttool({"ignore", "src/k.cu:h", "--reason", "host only"}).exit_code, 0);
    ASSERT_EQ(porttool({"check"}).exit_code, 0);
    commit("a baseline", 2);
    git("checkout -q -b feature");
    const std::string evil = "__device__ float h(int x) {\n    return x * 666.0f;\n}\n";
    write("src/k.cu", evil + kSource + old);
    EXPECT_EQ(porttool({"check"}).exit_code, 1) << "an overload that takes the id";
    EXPECT_EQ(porttool({"check", "--base", "main", "--trusted-map"}).exit_code, 1);
    write("src/k.cu", kSource + replaced(old, "7.5f", "8.5f"));
    EXPECT_EQ(porttool({"check"}).exit_code, 0) << "an edit of what has no port";
    write("src/k.cu", kSource);
    write("src/moved.cu", old);
    EXPECT_EQ(porttool({"check"}).exit_code, 0) << "a move";
    fs::remove(root / "src/moved.cu");
    // The print of another unit in the line: listed, and the unit whose line it was is new then.
    write("src/k.cu", kSource + old + replaced(evil, "h(int", "evil(int"));
    ASSERT_EQ(porttool({"ignore", "src/k.cu:evil", "--reason", "x"}).exit_code, 0);
    const LockFile both = read_lock(read_text(root / "portmap.lock")).lock;
    LockFile forged = both;
    const auto line_of = [](LockFile& lock, const std::string& id) {
        return std::find_if(lock.baseline.begin(), lock.baseline.end(),
                            [&](const LockedUnit& u) { return u.id == id; });
    };
    line_of(forged, "src/k.cu:h")->prints = line_of(forged, "src/k.cu:evil")->prints;
    forged.baseline.erase(line_of(forged, "src/k.cu:evil"));
    write("portmap.lock", lock_text(forged));
    EXPECT_EQ(porttool({"check"}).exit_code, 1);
    const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    ASSERT_EQ(got["brought_in"].size(), 1u) << got["brought_in"].dump(1);
    EXPECT_EQ(got["brought_in"][0]["kind"], "ignore");
    LockFile twice = both;
    twice.baseline.push_back(*line_of(forged, "src/k.cu:h"));
    write("portmap.lock", lock_text(twice));
    EXPECT_EQ(porttool({"check"}).exit_code, 2) << "two lines for one unit";
}

TEST_F(HostileChange, TheCommandThatSyncRunsAndTheBlocksAreListed) {
    const std::string map = read_text(root / "portmap.toml");
    write("portmap.toml", map + "\n[sync]\nverify = \"true\"\n");
    commit("verify");
    git("checkout -qb other");
    write("portmap.toml", map +
                              "\n[sync]\nverify = \"curl x | sh\"\n[[block]]\nname = \"b\"\nsource = "
                              "[\"src/*\"]\ntarget = [\"port/*\"]\n");
    const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    std::set<std::string> texts;
    for (const auto& one : got["brought_in"]) texts.insert(one["text"]);
    EXPECT_TRUE(texts.contains("sync verify = curl x | sh, before true")) << got["brought_in"].dump(1);
    EXPECT_TRUE(texts.contains("block b = source = src/*, target = port/*")) << got["brought_in"].dump(1);
}

TEST_F(HostileChange, EveryKeyOfTheMapIsListed) {
    const std::string map = read_text(root / "portmap.toml");
    git("checkout -qb other");
    write("portmap.toml", map +
                              "\n[cost]\ncoding = 2\nretest = 0.5\n[reuse]\ntranslated = 40\n[spirv]\ninclude = "
                              "[\"a\", \"b\"]\n[[effort]]\nwhat = \"e\"\nlines = 3\nport = { coding = 1.5 }\n");
    const auto texts = [&] {
        std::set<std::string> out;
        const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
        for (const auto& one : got["brought_in"]) {
            EXPECT_EQ(one["kind"], "rule");
            out.insert(one["file"].get<std::string>() + ":" + std::to_string(one["line"].get<int>()) + " " +
                       one["text"].get<std::string>());
        }
        return out;
    };
    const auto at = [&](int line, const std::string& text) {
        return "portmap.toml:" + std::to_string(std::count(map.begin(), map.end(), '\n') + line) + " " + text;
    };
    EXPECT_EQ(texts(), std::set<std::string>({at(3, "cost coding = 2"), at(4, "cost retest = 0.5"),
                                              at(6, "reuse translated = 40"), at(8, "spirv include = a, b"),
                                              at(9, "effort e = lines = 3, port = {coding = 1.5}")}));
    commit("costs", 2);
    git("checkout -q main && git merge -q --ff-only other && git checkout -q other");
    EXPECT_EQ(texts(), std::set<std::string>());
    write("portmap.toml", map +
                              "\n[cost]\ncoding = 3.0\n[reuse]\ntranslated = 40.0\n[spirv]\ninclude = [\"a\", "
                              "\"b\"]\n[[effort]]\nwhat = \"e\"\nlines = 3\nport = { coding = 1.5 }\n");
    EXPECT_EQ(texts(), std::set<std::string>(
                           {at(3, "cost coding = 3, before 2"), "portmap.toml:1 no longer: cost retest = 0.5"}));
}

TEST_F(HostileChange, ColonsInTheNameOfAFileAreNoMove) {
    const std::vector<std::string> names = {"a:b.cu", "src:::k.cu", "c::d.cu"};
    for (const std::string& name : names) {
        const std::string port = "port/" + name.substr(0, 1) + ".cpp";
        fs::remove_all(root / "src");
        fs::remove_all(root / "port");
        write("src/" + name, kSource);
        write(port, kTarget);
        ASSERT_EQ(porttool({"init", "--force", "--source", "src/*", "--target", "port/*"}).exit_code, 0) << name;
        commit(name);
        git("branch -f base");
        EXPECT_TRUE(json({"check", "--base", "base"})["brought_in"].empty()) << name;
        // A recorded file that cannot be read is an error, not a unit that is gone.
        write("src/" + name, std::string("// \0\n", 5) + kSource);
        const CommandRun got = porttool({"check"});
        EXPECT_EQ(got.exit_code, 1) << name << got.out;
        EXPECT_EQ(got.out.find("is gone"), std::string::npos) << got.out;
    }
}

TEST_F(HostileChange, WhatTheTextLeavesOutIsCountedByKind) {
    git("checkout -qb other");
    std::string many = kSource;
    for (int i = 0; i < 40; ++i) many += "// porttool: ignore(source-changed) number " + std::to_string(i) + "\n";
    write("src/k.cu", many);
    write("zzz.toml", "");
    write("src/z.cu", "// porttool: ignore(orphaned) last\n");
    const std::string text = porttool({"check", "--base", "main"}).out;
    const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    EXPECT_EQ(got["brought_in"].size(), 41u);
    EXPECT_NE(text.find("and 21 more (21 suppression); --format json lists all"), std::string::npos) << text;
}

/// A forge refuses a comment of more than 65,536 characters, and nobody reads a line of a megabyte.
TEST_F(HostileChange, NothingIsTooLongToBeSeen) {
    const std::string map = read_text(root / "portmap.toml"), deep = "\u202e<b>";
    std::string rows = map + "[dialect]\n", sources;
    for (int i = 0; i < 3000; ++i) rows += "\"" + deep + "w" + std::to_string(i) + "\" = \"x\"\n";
    for (int i = 0; i < 3000; ++i)
        sources += "float fresh_" + std::to_string(i) + "(float x) { return x + " + std::to_string(i) + "; }\n";
    git("checkout -qb other");
    write("portmap.toml", rows + "long = \"" + std::string(1'000'000, 'v') + "\"\n");
    write("src/k.cu", kSource + sources);
    const auto size_of = [&](const std::string& format) {
        return porttool({"check", "--base", "main", "--format", format}).out.size();
    };
    EXPECT_LT(size_of("markdown"), 65'536u);
    const std::string comment = porttool({"check", "--base", "main", "--format", "markdown"}).out;
    for (const char* part : {"What this change does to the gate itself:", "| dialect |", "| error |",
                             "dialect); --format", "more; --format json lists all"})
        EXPECT_NE(comment.find(part), std::string::npos) << part;
    write("src/k.cu", kSource);
    EXPECT_LT(size_of("text"), 30'000u);
    const auto whole = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    EXPECT_EQ(whole["brought_in"].size(), 3001u);
    const std::string github = porttool({"check", "--base", "main", "--format", "github"}).out;
    for (size_t at = 0; at < github.size();) {
        const size_t end = std::min(github.find('\n', at), github.size());
        EXPECT_LT(end - at, 4096u);
        at = end + 1;
    }
    write("portmap.toml", map + "[" + std::string(1'000'000, 'k') + "]\nx = 1\n");
    const CommandRun got = porttool({"check"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_LT(got.err.size(), 5000u);
    EXPECT_NE(got.err.find("portmap.toml:"), std::string::npos);
    EXPECT_NE(got.err.find("kkk ... kkk"), std::string::npos) << got.err.substr(0, 100);
}

TEST_F(HostileChange, ALockLineThatGoesIsListed) {
    git("checkout -q -b feature");
    LockFile lock = read_lock(read_text(root / "portmap.lock")).lock;
    std::erase_if(lock.pairs, [](const LockedPair& pair) { return pair.source == "src/k.cu:g"; });
    write("portmap.lock", lock_text(lock));
    commit("forgets", 2);
    auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    ASSERT_EQ(got["brought_in"].size(), 1u);
    EXPECT_EQ(got["brought_in"][0]["text"], "no longer recorded: src/k.cu:g = port/k.cpp:g");
    fs::remove(root / "portmap.lock");
    got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    EXPECT_EQ(got["brought_in"][0]["text"], "the lock is gone");
}

TEST_F(HostileChange, AnAcceptThatGoesWithItsReasonIsListed) {
    write("src/k.cu", replaced(kSource, "2.0f", "2.5f"));
    ASSERT_EQ(porttool({"accept", "src/k.cu:f", "--reason", "the port is right"}).exit_code, 0);
    commit("accepted", 2);
    git("checkout -q -b feature");
    const auto listed = [&] {
        return nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out)["brought_in"];
    };
    EXPECT_EQ(listed().size(), 0u);
    LockFile lock = read_lock(read_text(root / "portmap.lock")).lock;
    ASSERT_EQ(lock.ledger.size(), 1u);
    lock.ledger.clear();
    write("portmap.lock", lock_text(lock));
    ASSERT_EQ(listed().size(), 1u);
    EXPECT_EQ(listed()[0]["kind"], "accept");
    EXPECT_EQ(listed()[0]["text"], "no longer: src/k.cu:f = port/k.cpp:f: the port is right");
    // What records the pair anew takes the reason away: the pair's own row says that.
    write("src/k.cu", replaced(kSource, "2.0f", "4.5f"));
    ASSERT_EQ(porttool({"accept", "src/k.cu:f", "--force"}).exit_code, 0);
    for (const auto& row : listed()) EXPECT_FALSE(row["text"].get<std::string>().starts_with("no longer")) << row;
}

// GCC joins lines behind a backslash with blanks (with a warning), C++14 behind its trigraph; others do not.
TEST_F(HostileChange, CodeIsNotHiddenInWhatOnlySomeCompilersTakeForAComment) {
    for (const char* comment : {"    // see the paper \\ \n", "    // see the paper \\\t \n", "    // what\?\?/\n",
                                "    // what\?\?/ \n", "    /* a *\\ \n/ y = 0; /* b */\n"}) {
        write("src/k.cu", replaced(kSource, "    return y * 3.0f;", comment + std::string("    return y * 3.0f;")));
        EXPECT_EQ(porttool({"check"}).exit_code, 1) << comment;
    }
    for (const char* comment :
         {"    // a path: C:\\x\n", "    // what\?\?\n", "    /* \\ here */\n", "    // a \\\n b\n"}) {
        write("src/k.cu", replaced(kSource, "    return y * 3.0f;", comment + std::string("    return y * 3.0f;")));
        EXPECT_EQ(porttool({"check"}).exit_code, 0) << comment;
    }
}

TEST_F(HostileChange, ATextThatAnotherBranchCameToNeedIsNotMergedAway) {
    git("checkout -q -b a");
    write("src/k.cu", replaced(kSource, "2.0f", "3.5f"));
    write("port/k.cpp", replaced(kTarget, "2.0f", "3.5f"));
    ASSERT_EQ(porttool({"accept", "--all"}).exit_code, 0);
    commit("a", 2);
    git("checkout -q main");
    git("checkout -q -b b");
    const std::string copied = kSource.substr(0, kSource.find("__device__ float g"));
    write("src/c.cu", copied);
    write("port/c.cpp", replaced(copied, "__device__ ", ""));
    write("portmap.toml",
          read_text(root / "portmap.toml") + "\n[[pair]]\nsource = \"src/c.cu:f\"\ntarget = \"port/c.cpp:f\"\n");
    ASSERT_EQ(porttool({"accept", "src/c.cu:f"}).exit_code, 0);
    commit("b", 3);
    git("checkout -q main");
    git("merge -q --no-edit a");
    git("merge -q --no-edit b");
    write("src/c.cu", replaced(copied, "2.0f", "5.0f"));
    write("port/c.cpp", replaced(replaced(copied, "__device__ ", ""), "2.0f", "5.0f"));
    EXPECT_EQ(porttool({"check"}).exit_code, 0) << "the same edit on both sides";
    fs::remove_all(root / "portmap.base");
    const CommandRun lost = porttool({"check"});
    EXPECT_EQ(lost.exit_code, 1);
    EXPECT_NE(lost.err.find("texts are missing in portmap.base/"), std::string::npos) << lost.err;
}

/// What a sparse checkout leaves out is not gone: git has it, and says how to get it.
TEST_F(HostileChange, TextsThatASparseCheckoutLeavesOutAreNoneThatTheChangeRemoved) {
    git("checkout -q -b feature");
    const auto all_of = [&](std::vector<std::string> more) {
        more.insert(more.begin(), "check");
        return porttool(std::move(more));
    };
    for (const char* pattern : {"set src port", "set --no-cone '/*' '!/portmap.base'"}) {
        git(std::string("sparse-checkout ") + pattern);
        ASSERT_FALSE(fs::exists(root / "portmap.base")) << pattern;
        for (const std::vector<std::string>& more : {std::vector<std::string>{"--format", "json"},
                                                     {"--base", "main", "--format", "json"},
                                                     {"--base", "main", "--trusted-map", "--format", "json"}}) {
            const CommandRun got = all_of(more);
            EXPECT_EQ(got.exit_code, 0) << pattern << got.err;
            EXPECT_EQ(
                got.err,
                "warning: 4 texts of portmap.base/ are not here, as this is a sparse checkout; to have them, run: "
                "git sparse-checkout add portmap.base\n");
            EXPECT_EQ(nlohmann::json::parse(got.out)["brought_in"], nlohmann::json::array()) << pattern;
        }
        const std::string source = read_text(root / "src/k.cu"), port = read_text(root / "port/k.cpp");
        write("src/k.cu", replaced(source, "2.0f", "5.0f"));
        EXPECT_EQ(all_of({}).exit_code, 1) << "an edit of one side";
        write("port/k.cpp", replaced(port, "2.0f", "5.0f"));
        EXPECT_EQ(all_of({}).exit_code, 0) << "the same edit on both sides, " << pattern << all_of({}).out;
        write("port/k.cpp", replaced(port, "2.0f", "6.0f"));
        EXPECT_EQ(all_of({}).exit_code, 1) << "another edit";
        git("checkout -q -- src port && git diff --quiet HEAD && git sparse-checkout disable");
    }
    git("sparse-checkout set src port && git sparse-checkout add portmap.base");
    EXPECT_EQ(all_of({}).err, "") << "the command that is told";
    git("sparse-checkout disable");
    // So do files of the sides; what is gone without one is not told so.
    git("sparse-checkout set src portmap.base");
    const CommandRun half = all_of({});
    EXPECT_NE(half.err.find("warning: 1 files of the sides (the first is port/k.cpp) are not here, as this is a sparse "
                            "checkout, and count as gone; to have them, run: git sparse-checkout add port\n"),
              std::string::npos)
        << half.err;
    git("sparse-checkout add port");
    EXPECT_EQ(all_of({}).err, "") << "the command that is told";
    git("sparse-checkout disable");
    fs::remove(root / "port/k.cpp");
    EXPECT_EQ(all_of({}).err.find("sparse"), std::string::npos);
    git("checkout -q -- port");
    // One that the change removed is gone, in a sparse checkout as well.
    fs::remove(root / "portmap.base" /
               read_lock(read_text(root / "portmap.lock")).lock.pairs[0].source_prints.written.text());
    commit("gone", 2);
    git("sparse-checkout set src port");
    const CommandRun got = all_of({"--base", "main", "--format", "json"});
    EXPECT_NE(got.err.find("warning: 3 texts of portmap.base/ are not here"), std::string::npos) << got.err;
    EXPECT_NE(got.err.find("warning: 1 texts are missing in portmap.base/"), std::string::npos) << got.err;
    EXPECT_EQ(nlohmann::json::parse(got.out)["brought_in"].size(), 1u) << got.out;
}

/// A checkout may give all that it writes the ends of another system's lines, and a change may say that it does: what
/// is compared, shown and accepted stays as it was.
TEST_F(HostileChange, TheEndsOfLinesOfACheckoutCountForNothing) {
    write("src/k.cu", replaced(kSource, "3.0f", "4.0f"));
    commit("an edit", 2);
    const std::vector<std::vector<std::string>> commands = {{"check"},
                                                            {"check", "--base", "main~1"},
                                                            {"check", "--base", "main~1", "--trusted-map"},
                                                            {"check", "--staged"},
                                                            {"explain", "src/k.cu:f"},
                                                            {"sync", "--all"}};
    std::vector<std::string> before;
    for (const auto& command : commands) before.push_back(porttool(command).out);
    EXPECT_NE(before[0].find("drift: "), std::string::npos) << before[0];
    struct Row {
        const char *attributes, *changed;  ///< a file that must have other ends of lines by it
    };
    for (const Row& row : std::vector<Row>{{"* text=auto eol=crlf", "portmap.lock"},
                                           {"portmap.base/* text eol=crlf", "portmap.base"},
                                           {"portmap.* text eol=crlf", "portmap.toml"},
                                           {"src/* text eol=crlf", "src/k.cu"},
                                           {"port/* text eol=crlf", "port/k.cpp"}}) {
        write(".gitattributes", row.attributes + std::string("\n"));
        git("checkout -q && rm -rf src port portmap.* && git checkout -q -- src port portmap.toml portmap.lock "
            "portmap.base");
        git(std::string("checkout -q && grep -rq $(printf '\\r') ") + row.changed);
        for (size_t i = 0; i < commands.size(); ++i)
            EXPECT_EQ(porttool(commands[i]).out, before[i]) << row.attributes << ": " << commands[i][0];
    }
}

// A text that is cut is found by the change that cuts it, and not by whoever edits the pair a year later.
TEST_F(HostileChange, TextsThatAChangeCutsOrRemovesAreTold) {
    git("checkout -q -b feature");
    const LockFile lock = read_lock(read_text(root / "portmap.lock")).lock;
    ASSERT_EQ(lock.pairs.size(), 2u);
    ASSERT_EQ(lock.pairs[0].source, "src/k.cu:g");
    const auto place = [](Print print) { return "portmap.base/" + print.text(); };
    const std::string cut = place(lock.pairs[0].source_prints.written),
                      gone = place(lock.pairs[1].target_prints.written);
    const std::string whole = read_text(root / cut);
    const auto brought = [&] {
        const CommandRun got = porttool({"check", "--base", "main", "--format", "json"});
        EXPECT_EQ(got.exit_code, 0) << got.err;
        return std::pair(nlohmann::json::parse(got.out)["brought_in"], got.err);
    };
    EXPECT_EQ(brought(), std::pair(nlohmann::json::array(), std::string()));
    write(cut, whole.substr(0, whole.size() / 2));
    fs::remove(root / gone);
    write("portmap.base/0123456789abcdef", "no line of the lock needs this\n");
    const auto [rows, said] = brought();
    EXPECT_EQ(said,
              "warning: 1 texts are missing in portmap.base/, 1 texts in portmap.base/ are not what their names "
              "say (the first is " +
                  cut.substr(13) +
                  "); restore them from git, or, while their pairs are in "
                  "step, run: porttool accept --all\n");
    ASSERT_EQ(rows.size(), 2u) << rows;
    for (const auto& row : rows) {
        EXPECT_EQ(row["kind"], "accept");
        EXPECT_EQ(row["file"], "portmap.lock");
    }
    EXPECT_EQ(rows[0]["text"],
              cut + ", the text of " + lock.pairs[0].source + " when last in step, is not what its name says");
    EXPECT_EQ(rows[1]["text"], gone + ", the text of " + lock.pairs[1].target + " when last in step, is gone");
    // The ends of lines of another system are no damage.
    write(cut, whole);
    write(gone, "");
    ASSERT_EQ(porttool({"accept", "--all"}).err, "");
    std::string with_returns;
    for (const char c : whole) with_returns += c == '\n' ? "\r\n" : std::string(1, c);
    write(cut, with_returns);
    EXPECT_EQ(brought(), std::pair(nlohmann::json::array(), std::string()));
    // What was cut before is told, and is not of this change.
    write(cut, "");
    git("add -A");
    commit("cut", 2);
    git("branch -f main");
    write("src/k.cu", replaced(kSource, "3.0f", "3.5f"));
    const CommandRun later = porttool({"check", "--base", "main", "--format", "json"});
    EXPECT_NE(later.err.find("1 texts in portmap.base/ are not what"), std::string::npos) << later.err;
    EXPECT_EQ(nlohmann::json::parse(later.out)["brought_in"], nlohmann::json::array());
    // Who writes the lock writes anew what is known; the rest is told.
    const CommandRun other = porttool({"accept", "src/k.cu:f"});
    EXPECT_NE(other.err.find("(the first is " + cut.substr(13) + ")"), std::string::npos) << other.err;
    write("src/k.cu", kSource);
    EXPECT_EQ(porttool({"accept", "src/k.cu:f"}).err, "");
    EXPECT_EQ(read_text(root / cut), whole);
}

// What cannot be put back is not replaced.
TEST_F(HostileChange, ALockOfGigabytesIsNotReadByWhoReplacesIt) {
    const std::string before = read_text(root / "portmap.toml");
    fs::resize_file(root / "portmap.lock", uint64_t{40} << 30);
    const CommandRun got = porttool({"init", "--force"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("portmap.lock: is 40960 MiB"), std::string::npos) << got.err;
    EXPECT_EQ(read_text(root / "portmap.toml"), before);
    fs::remove(root / "portmap.lock");
    EXPECT_EQ(porttool({"init", "--force"}).exit_code, 0);
}

TEST_F(HostileChange, AWordOfTrustInTheLockIsListed) {
    git("checkout -q -b feature");
    const std::string lock = read_text(root / "portmap.lock");
    write("portmap.lock", replaced(lock, "state=recorded", "by=difftest\tstate=verified"));
    commit("trusts itself", 2);
    const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    ASSERT_EQ(got["brought_in"].size(), 1u);
    EXPECT_EQ(got["brought_in"][0]["kind"], "accept");
    EXPECT_NE(got["brought_in"][0]["text"].get<std::string>().find(", verified by difftest"), std::string::npos);
}

TEST_F(HostileChange, MacrosThatAreNotedFirstAreListedOnlyWhereTheyChanged) {
    std::string lock = read_text(root / "portmap.lock");
    for (size_t at = 0; (at = lock.find("-macros=", at)) != std::string::npos;)
        lock.erase(at - 7, lock.find_first_of("\t\n", at) - at + 7);
    write("portmap.lock", lock);
    commit("a lock from before macros were noted");
    git("checkout -q -b change");
    ASSERT_EQ(porttool({"accept", "--all"}).exit_code, 0);
    ASSERT_NE(read_text(root / "portmap.lock"), lock);
    EXPECT_TRUE(json({"check", "--base", "main"})["brought_in"].empty()) << "nothing but what was so all along";
    write("portmap.lock", lock);
    write("src/k.cu", "#define x 0.0f\n" + kSource);
    ASSERT_EQ(porttool({"accept", "--all"}).exit_code, 0);
    const CommandRun open = porttool({"check", "--base", "main", "--format", "json"});
    EXPECT_EQ(nlohmann::json::parse(open.out)["brought_in"].size(), 2) << open.out;
    const CommandRun trusted = porttool({"check", "--base", "main", "--trusted-map"});
    EXPECT_EQ(trusted.exit_code, 1);
    EXPECT_NE(trusted.out.find("its word x is `#define x ...` now"), std::string::npos) << trusted.out;
}

TEST_F(HostileChange, FilesThatCannotBeReadDoNotPassAsGone) {
    const std::vector<std::pair<std::string, std::string>> rows = {
        {std::string("// \0\n", 5) + replaced(kSource, "3.0f", "4.0f"), "binary"},
        {"\xFF\xFE" + kSource, "UTF-16"},
        {"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n", "git lfs pull"},
        {"version https://git-lfs.github.com/spec/v1\r\noid sha256:0\r\nsize 1\r\n", "git lfs pull"},
        {"\nversion https://hawser.github.com/spec/v1\noid sha256:0\nsize 1\n", "git lfs pull"},
        {"version http://git-media.io/v/2\noid sha256:0\nsize 1\n", "git lfs pull"},
    };
    for (const auto& [text, reason] : rows) {
        write("port/k.cpp", text);
        EXPECT_EQ(porttool({"check"}).exit_code, 1) << "the port, too: " << reason;
        write("port/k.cpp", kTarget);
        write("src/k.cu", text);
        const CommandRun got = porttool({"check"});
        EXPECT_EQ(got.exit_code, 1) << reason;
        EXPECT_NE(got.out.find(reason), std::string::npos) << got.out;
        EXPECT_EQ(got.out.find("gone"), std::string::npos) << got.out;
    }
    write("src/k.cu", replaced(kSource, "3.0f", "4.0f"));
    write(".gitignore", "src/k.cu\n");
    EXPECT_EQ(porttool({"check"}).exit_code, 1) << "ignoring a file that the map names does not hide it";
}

TEST_F(HostileChange, WhatAChangeDoesToTheGateIsListed) {
    git("checkout -q -b feature");
    std::string source = replaced(kSource, "2.0f", "2.5f") + "__device__ float h(float x) {\n    return x;\n}\n";
    source = replaced(source, "    float y", "    // porttool: ignore(source-changed) trust me\n    float y = x; y");
    write("src/k.cu", source);
    write("portmap.toml", read_text(root / "portmap.toml") +
                              "[[ignore]]\nid = \"port/**\"\nreason = \"all\"\n[rules]\n\"port-differs\" = "
                              "\"off\"\n[dialect]\n\"vec9\" = \"float9\"\n");
    ASSERT_EQ(porttool({"ignore", "src/k.cu:h", "--reason", "host only"}).exit_code, 0);
    ASSERT_EQ(
        porttool({"defer", "src/k.cu:g", "--owner", "me", "--until", "2099-01-01", "--reason", "later"}).exit_code, 0);
    ASSERT_EQ(porttool({"accept", "src/k.cu:f"}).exit_code, 0);
    commit("silences itself", 2);
    const auto quiet = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    EXPECT_NE(quiet["verdict"], "drift");
    std::map<std::string, std::string> listed;
    for (const auto& one : quiet["brought_in"]) {
        listed[one["kind"].get<std::string>() + " " + one["file"].get<std::string>()] = one["text"];
        EXPECT_GE(one["line"].get<int>(), 1);
    }
    EXPECT_EQ(listed.size(), 7u) << quiet["brought_in"].dump(1);
    EXPECT_EQ(listed["suppression src/k.cu"], "porttool: ignore(source-changed) trust me");
    EXPECT_EQ(listed["accept portmap.lock"], "src/k.cu:f = port/k.cpp:f");
    EXPECT_EQ(listed["defer portmap.lock"], "src/k.cu:g = port/k.cpp:g: later (me, until 2099-01-01)");
    EXPECT_EQ(listed["ignore portmap.lock"], "src/k.cu:h: host only");
    EXPECT_EQ(listed["ignore portmap.toml"], "port/**: all");
    EXPECT_EQ(listed["rule portmap.toml"], "port-differs = off");
    EXPECT_EQ(listed["dialect portmap.toml"], "vec9 = float9");
    for (const char* format : {"text", "markdown", "github"})
        EXPECT_NE(porttool({"check", "--base", "main", "--format", format}).out.find("vec9 = float9"),
                  std::string::npos)
            << format;

    const auto trusted =
        nlohmann::json::parse(porttool({"check", "--base", "main", "--trusted-map", "--format", "json"}).out);
    EXPECT_EQ(trusted["verdict"], "drift");
    EXPECT_EQ(trusted["summary"]["drifted"], 2);
    EXPECT_EQ(trusted["brought_in"], quiet["brought_in"]);
    EXPECT_EQ(porttool({"check", "--trusted-map"}).exit_code, 2);
    EXPECT_TRUE(json({"check"})["brought_in"].empty()) << "without a base there is nothing to compare with";
}

TEST_F(HostileChange, PairsAndSidesThatGoAreListedAndTheTrustedMapStillWatchesThem) {
    git("checkout -q -b feature");
    const std::string map = read_text(root / "portmap.toml");
    const size_t second = map.rfind("\n[[pair]]");
    write("portmap.toml", replaced(map.substr(0, second), "\"port/*\"", "\"port/k.cpp\"") + "\n");
    write("src/k.cu", replaced(kSource, "3.0f", "4.0f"));
    write("portmap.lock", lock_text(LockFile()));
    commit("drops a pair", 2);
    const auto got = nlohmann::json::parse(porttool({"check", "--base", "main", "--format", "json"}).out);
    std::set<std::string> texts;
    for (const auto& one : got["brought_in"])
        texts.insert(one["kind"].get<std::string>() + ": " + one["text"].get<std::string>());
    EXPECT_TRUE(texts.contains("pair: no longer: src/k.cu:g = port/k.cpp:g")) << got["brought_in"].dump(1);
    EXPECT_TRUE(texts.contains("sides: target = port/k.cpp, before port/*")) << got["brought_in"].dump(1);
    EXPECT_EQ(porttool({"check", "--base", "main", "--trusted-map"}).exit_code, 1);
    fs::remove(root / "portmap.toml");
    EXPECT_EQ(porttool({"check", "--base", "main", "--trusted-map"}).exit_code, 2) << "no project without any map";
}

TEST_F(HostileChange, AMapThatIsNewHasNothingTrusted) {
    git("checkout -q --orphan fresh && git -C '" + root.string() +
        "' rm -q -f --cached portmap.toml portmap.lock && git -C '" + root.string() + "' rm -rq --cached portmap.base");
    git("commit -qm 'no map'");
    git("checkout -q -b feature");
    commit("brings the map", 2);
    const auto got = nlohmann::json::parse(porttool({"check", "--base", "fresh", "--format", "json"}).out);
    ASSERT_EQ(got["brought_in"].size(), 2u) << got["brought_in"].dump(1);
    EXPECT_EQ(got["brought_in"][0]["kind"], "accept");
    EXPECT_EQ(got["brought_in"][1]["kind"], "sides");
    const CommandRun trusted = porttool({"check", "--base", "fresh", "--trusted-map"});
    EXPECT_EQ(trusted.exit_code, 2);
    EXPECT_NE(trusted.err.find("no portmap.toml at the merge base of fresh"), std::string::npos) << trusted.err;
}

TEST_F(HostileChange, AFailedInitLeavesNothing) {
    for (const char* name : {"portmap.toml", "portmap.lock", "portmap.base"}) fs::remove_all(root / name);
    for (const char* name : {"portmap.toml", "portmap.lock", "portmap.base"}) {
        if (std::string(name) == "portmap.base")
            write(name, "a file");
        else
            fs::create_directories(root / name / "in the way");
        const CommandRun got = porttool({"init", "--force", "--source", "src/*", "--target", "port/*"});
        EXPECT_EQ(got.exit_code, 2) << name;
        EXPECT_EQ(got.out, "");
        for (const char* other : {"portmap.toml", "portmap.lock", "portmap.base", "portmap.lock.busy"})
            EXPECT_EQ(fs::exists(root / other), std::string(other) == name)
                << other << " with " << name << " in the way";
        fs::remove_all(root / name);
    }
}

// A commit of a few hundred bytes that stands for 100 million files, and is undone by the next: a checkout never shows
// it.
TEST_F(HostileChange, AFolderOfBillionsInACommitEndsInALine) {
    std::ofstream(root / ".git" / "bomb.sh") << R"sh(set -e
tree=$(printf '100644 blob %s\tf.cu\n' $(echo 'float f();' | git hash-object -w --stdin) | git mktree)
for level in 1 2 3 4 5 6 7 8; do
    tree=$(for i in 0 1 2 3 4 5 6 7 8 9; do printf '040000 tree %s\td%s\n' $tree $i; done | git mktree)
done
root=$(git ls-tree HEAD | sed "s/tree [0-9a-f]*\tsrc/tree $( (git ls-tree HEAD:src; printf '040000 tree %s\tbomb\n' $tree) | git mktree)\tsrc/" | git mktree)
git update-ref HEAD $(git commit-tree $root -p HEAD -m bomb)
git update-ref HEAD $(git commit-tree HEAD~1^{tree} -p HEAD -m undone)
git read-tree HEAD
)sh";
    ASSERT_EQ(std::system(("cd '" + root.string() + "' && sh .git/bomb.sh").c_str()), 0);
    EXPECT_EQ(porttool({"check", "--base", "HEAD~2"}).exit_code, 0);
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"history"}, {"audit"}, {"check", "--base", "HEAD~1"}}) {
        const CommandRun got = porttool(command);
        EXPECT_EQ(got.exit_code, 2) << command[0];
        EXPECT_EQ(got.out, "");
        EXPECT_NE(got.err.find("more than 1000000 files and folders"), std::string::npos) << got.err;
    }
}

// A megabyte of a pack can stand for gigabytes of zeros.
TEST_F(HostileChange, ALargeBlobIsNotRead) {
    constexpr uint64_t kLarge = 65ull << 20;
    std::ofstream(root / "src/large.cu") << "";
    fs::resize_file(root / "src/large.cu", kLarge);
    git("-c core.compression=1 add -A");
    const GitRepository repository(root.string());
    const GitFiles staged = repository.files_in_index([](const std::string&) { return true; });
    EXPECT_EQ(staged.error, "");
    EXPECT_TRUE(staged.files.contains("src/k.cu"));
    EXPECT_FALSE(staged.files.contains("src/large.cu"));
    EXPECT_EQ(staged.unreadable.at("src/large.cu"), "is 65 MiB, more than the 16 MiB that are read of one file");
    git("-c core.compression=1 commit -qm large");
    for (const GitChange& change :
         repository.changes("", repository.commit("HEAD")->id, [](const std::string&) { return true; })) {
        const auto text = repository.find_blob(change.blob);
        ASSERT_TRUE(text.has_value());
        EXPECT_LT(text->size(), kLarge);
        EXPECT_EQ(change.path == "src/large.cu", !unreadable_reason(*text).empty()) << change.path;
    }
    const CommandRun got = porttool({"check", "--staged"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    EXPECT_NE(got.out.find("src/large.cu is 65 MiB"), std::string::npos) << got.out;
}

TEST_F(HostileChange, FoldersNestedDeeperThanAnyPathAreNoFiles) {
    std::string path = "src";
    for (int i = 0; i < 20'000; ++i) path += "/a";
    std::ofstream(root / ".git" / "deep")
        << "commit refs/heads/deep\ncommitter a <a@b> 1 +0000\ndata 4\ndeep\n"
        << "from refs/heads/main^0\nM 100644 inline " << path << "/k.cu\ndata 11\nfloat f();\n\n";
    git("fast-import --quiet < .git/deep && git update-ref HEAD deep");
    for (const std::vector<std::string>& command : {std::vector<std::string>{"history"}, {"check", "--base", "HEAD"}})
        EXPECT_EQ(porttool(command).exit_code, 0) << command[0];
}

TEST_F(HostileChange, OutputDoesNotFollowALinkOutOfTheTree) {
    fs::create_symlink(outside / "notes.txt", root / "a.json");
    fs::create_symlink(outside / "none", root / "b.json");
    fs::create_directory_symlink(outside, root / "c");
    fs::create_symlink("b.json", root / "d.json");
    for (const char* file : {"a.json", "b.json", "c/e.json", "d.json"}) {
        const CommandRun got = porttool({"check", "--format", "json", "-o", file});
        EXPECT_EQ(got.exit_code, 2) << file;
        EXPECT_NE(got.err.find("leads out of"), std::string::npos) << file << got.err;
    }
    EXPECT_EQ(read_text(outside / "notes.txt"), "precious");
    for (const char* file : {"none", "e.json"}) EXPECT_FALSE(fs::exists(outside / file)) << "made there";
}

TEST_F(HostileChange, OutputDoesNotFollowALinkIntoWhatGitKeeps) {
    const fs::path hook = root / ".git" / "hooks" / "pre-commit";
    fs::create_directories(hook.parent_path());
    std::ofstream(hook) << "exit 0";
    fs::create_symlink(".git/hooks/pre-commit", root / "a.txt");
    fs::create_directory_symlink(".git/hooks", root / "hooks");
    fs::create_symlink(".git/none", root / "b.txt");
    for (const char* file : {"a.txt", "hooks/pre-commit", "b.txt"}) {
        const CommandRun got = porttool({"check", "-o", file});
        EXPECT_EQ(got.exit_code, 2) << file;
        EXPECT_NE(got.err.find("leads into git's own folder"), std::string::npos) << file << got.err;
    }
    EXPECT_EQ(read_text(hook), "exit 0");
    EXPECT_FALSE(fs::exists(root / ".git" / "none"));
    // What stays in the tree is followed, and who names git's folder means it.
    fs::create_directory(root / "build");
    fs::create_directory_symlink("build", root / "out");
    for (const char* file : {"out/a.txt", ".git/report.txt"}) EXPECT_EQ(porttool({"check", "-o", file}).exit_code, 0);
}

TEST_F(HostileChange, OutputDoesNotFollowALinkOutOfTheRepositoryAroundTheProject) {
    const fs::path whole = root, part = root / "part";
    fs::create_directories(part / "src");
    for (const char* side : {"a.cu", "a.cpp"}) std::ofstream(part / "src" / side) << "float f(float x) { return x; }";
    std::ofstream(part / "portmap.toml") << "[sides]\nsource = [\"src/*.cu\"]\ntarget = [\"src/*.cpp\"]\n";
    fs::create_symlink(outside / "notes.txt", root / "a.json");
    fs::create_directory_symlink(outside, root / "c");
    const std::string above = whole.string() + "/";
    root = part;
    for (const std::string& file : {above + "a.json", above + "c/e.json"}) {
        const CommandRun got = porttool({"check", "--format", "json", "-o", file});
        EXPECT_EQ(got.exit_code, 2) << file;
        EXPECT_NE(got.err.find("leads out of"), std::string::npos) << file << got.err;
    }
    EXPECT_EQ(read_text(outside / "notes.txt"), "precious");
    EXPECT_FALSE(fs::exists(outside / "e.json"));
    root = whole;
}

TEST_F(HostileChange, AFolderIsJudgedByTheMapThatTheMergeBaseHasForIt) {
    const auto project = [&](const std::string& folder) {
        for (const char* side : {"/src/a.cu", "/src/a.cpp"}) write(folder + side, "float f(float x) { return x; }");
        write(folder + "/portmap.toml",
              "version = 1\n[sides]\nsource = [\"src/*.cu\"]\ntarget = [\"src/*.cpp\"]\n[[pair]]\nsource = "
              "\"src/a.cu:f\"\n"
              "target = \"src/a.cpp:f\"\n");
    };
    for (const char* folder : {"pa", "pb", "part/pc", "other/pc"}) project(folder);
    write("pa/sub/notes.txt", "");
    fs::create_directory_symlink("pa", root / "was_a_link");
    git("add -A && git commit -qm parts && git branch -f then");
    const std::string elsewhere = " leads to ", gone = "is gone, which was there at the merge base of then",
                      is_new = "portmap.toml is new; at the merge base of then the map of ";
    struct Row {
        const char *what, *change, *folder;
        std::string told;  ///< empty: judged
    };
    const std::vector<Row> rows = {
        {"nothing", "true", "pa", ""},
        {"nothing", "true", "pa/sub", ""},
        {"a link of before", "true", "was_a_link", ""},
        {"an edit of the map", "echo '# new' >> pa/portmap.toml", "pa", ""},
        {"a map that is a link within its folder", "cd pa && git mv portmap.toml m.toml && ln -s m.toml portmap.toml",
         "pa", ""},
        {"a folder that is new", "cp -r pa pd", "pd", ""},
        {"another folder's map is gone", "git rm -q pb/portmap.toml", "pa", ""},
        {"a link in another's place", "rm -r pb && ln -s pa pb", "pa", ""},
        {"a link", "rm -r pa && ln -s pb pa", "pa", elsewhere},
        {"a link to the whole", "rm -r pa && ln -s . pa", "pa", elsewhere},
        {"a link out", "rm -r pa && ln -s /tmp pa", "pa", elsewhere},
        {"a link above", "rm -r part && ln -s other part", "part/pc", elsewhere},
        {"a link of before leads elsewhere", "rm was_a_link && ln -s pb was_a_link", "was_a_link", elsewhere},
        {"a map that is gone", "git rm -q pa/portmap.toml", "pa", gone},
        {"a map that is gone, from below", "git rm -q pa/portmap.toml", "pa/sub", gone},
        {"a nearer map", "cp pb/portmap.toml pa/sub && cp -r pb/src pa/sub", "pa/sub", is_new},
        {"a repository of its own",
         "rm -r pa && git clone -q . pa && cp -r pb/* pa && git -C pa add -A && git -C pa "
         "branch -f then origin/then",
         "pa", "pa is a repository of its own"}};
    const fs::path whole = root;
    for (const Row& row : rows) {
        git("checkout -qf then -B change && git clean -qffd");
        ASSERT_EQ(std::system(("cd '" + root.string() + "' && " + row.change).c_str()), 0) << row.what;
        git("-c advice.addEmbeddedRepo=false add -A && git commit -qm change --allow-empty");
        for (const char* more : {"--format=text", "--trusted-map"}) {
            const std::vector<std::string> command = {"check", "--base", "then", more};
            root = whole / row.folder;
            const CommandRun got = porttool(command);
            root = whole;
            const std::string about = std::string(row.what) + " " + more + "\n" + got.out + got.err;
            if (row.told.empty()) {
                EXPECT_TRUE(got.exit_code == 0 || got.err.find("--trusted-map") != std::string::npos) << about;
            } else {
                EXPECT_EQ(got.exit_code, 2) << about;
                EXPECT_NE(got.err.find(row.told), std::string::npos) << about;
            }
        }
    }
}

TEST_F(HostileChange, WhatGitDoesNotTrackIsReadOnlyWhereItsNameIsThatOfASource) {
    const std::string map = read_text(root / "portmap.toml");
    write("other/k.cu", kSource);
    write("other/notes.txt", "some lines\n");
    write("sub/notes.txt", "some lines\n");
    git("-C sub init -q && git -C sub add -A && git -C sub -c user.name=a -c user.email=b commit -qm sub");
    git("-c advice.addEmbeddedRepo=false add -A && git commit -qm more && git branch -f then");
    const auto with = [&](const std::string& glob, const std::string& file) {
        return replaced(map, "source = [\"src/*\"", "source = [\"src/*\", \"" + glob + "\"") +
               "\n[[pair]]\nsource = \"" + file + ":@file\"\ntarget = \"port/k.cpp:f\"\n";
    };
    struct Row {
        const char* what;
        std::function<void()> change;
        bool is_read;
        bool is_local = false;  ///< not committed
    };
    const std::vector<Row> rows = {
        {"a watched source leads to it", [&] { link("../.env", "src/k.cu"); }, false},
        {"a source is new and leads to it", [&] { link("../.env", "src/new.cu"); }, false},
        {"a link leads on to a link to it",
         [&] {
             link("../.env", "other/env");
             link("../other/env", "src/new.cu");
         },
         false},
        {"a pair names it", [&] { write("portmap.toml", with(".env", ".env")); }, false},
        {"a glob takes it", [&] { write("portmap.toml", with("*.*", "src/k.cu")); }, false},
        {"a folder that leads to one with it",
         [&] {
             link("../meta", "src/m");
             write("portmap.toml", with("src/m/config", "src/m/config"));
         },
         false},
        {"the map leads to it", [&] { link(".env", "portmap.toml"); }, false},
        {"the lock leads to it", [&] { link(".env", "portmap.lock"); }, false},
        {"a link to a file that git tracks", [&] { link("../other/k.cu", "src/l.cu"); }, true},
        {"a link to another file that git tracks",
         [&] {
             link("../other/notes.txt", "src/notes.txt");
             write("portmap.toml", with("src/notes.txt", "src/notes.txt"));
         },
         true},
        {"a folder of such files that is a link",
         [&] {
             link("../other", "src/o");
             write("portmap.toml", with("src/o/notes.txt", "src/o/notes.txt"));
         },
         true},
        {"a link into a submodule",
         [&] {
             link("../sub/notes.txt", "src/notes.txt");
             write("portmap.toml", with("src/notes.txt", "src/notes.txt"));
         },
         true},
        {"a file of a submodule", [&] { write("portmap.toml", with("sub/notes.txt", "sub/notes.txt")); }, true},
        {"a file that no commit of a submodule has", [&] { write("portmap.toml", with("sub/.env", "sub/.env")); },
         false},
        {"another checkout, given the name of a submodule",
         [&] {
             link("../meta/config", "src/k.cu");
             git("update-index --add --cacheinfo 160000,$(git rev-parse HEAD),meta");
         },
         false},
        {"a submodule that is at another commit",
         [&] {
             link("../sub/notes.txt", "src/k.cu");
             git("update-index --cacheinfo 160000,$(git rev-parse HEAD),sub && git commit -qm other");
         },
         false, true},
        {"a new source", [&] { write("src/new.cu", kSource); }, true, true},
        {"a link to a new source",
         [&] {
             write("other/new.cu", kSource);
             link("../other/new.cu", "src/new.cu");
         },
         true, true},
        {"a new file that is staged",
         [&] {
             write("src/new.txt", "a line\n");
             write("portmap.toml", with("src/new.txt", "src/new.txt"));
             git("add src/new.txt");
         },
         true, true}};
    for (const Row& row : rows) {
        git("checkout -qf then -B change && git clean -qffd && git -C sub checkout -qf .");
        row.change();
        if (!row.is_local) git("add -A && git commit -qm change");
        write(".env", "API_KEY=" + kSecret + "\nfloat " + kSecret + "(float x) { return x; }\n");
        write("sub/.env", kSecret + "\n");
        write("meta/config", kSecret + "\n");
        bool told = false;
        for (const std::vector<std::string>& command : {std::vector<std::string>{"check", "--format", "json"},
                                                        {"check", "--base", "then", "--format", "markdown"},
                                                        {"check", "--base", "then", "--trusted-map"},
                                                        {"report", "--format", "html"},
                                                        {"sync", "--all"},
                                                        {"explain", "src/k.cu:f"}}) {
            const CommandRun got = porttool(command);
            const std::string all = got.out + got.err;
            EXPECT_EQ(all.find(kSecret), std::string::npos) << row.what << "\n" << command[0] << "\n" << all;
            told |= all.find("is not tracked by git") != std::string::npos;
        }
        EXPECT_EQ(told, !row.is_read) << row.what;
    }
    git("checkout -qf then -B change && git clean -qffd");
    write("notes/.env", "a line\n");
    write("portmap.toml", with("notes/.env", "notes/.env"));
    fs::remove_all(root / ".git");
    EXPECT_EQ(porttool({"check"}).out.find("is not tracked"), std::string::npos) << "without git nothing is tracked";
    git("init -q");
}

/// What is told of a source without a known suffix that git does not track is what helps: the command, run as it
/// stands there, has it read.
TEST_F(HostileChange, TheCommandForAnUntrackedSourceHasItRead) {
    const std::string text = "float h(float x) { return x; }\n";
    for (const std::string name : {"h.inc", "h.def", "h.cpp.in", "h.mm", "with a blank.inc"})
        for (const bool is_ignored : {false, true})
            for (const bool is_recorded : {false, true}) {
                const std::string about =
                    name + (is_ignored ? " ignored" : " new") + (is_recorded ? " recorded" : " not recorded");
                git("checkout -qf main && rm -rf .gitignore src/h.* src/with*");
                for (const std::string& file : {"src/" + name, std::string("port/h.cpp")}) write(file, text);
                write("portmap.toml",
                      replaced(read_text(root / "portmap.toml"), "\"src/*\"", "\"src/*\", \"src/*.*\"") +
                          "\n[[pair]]\nsource = \"src/" + name + ":h\"\ntarget = \"port/h.cpp:h\"\n");
                git("add .");
                if (is_recorded) {
                    EXPECT_EQ(porttool({"accept", "--all", "--force"}).exit_code, 0) << about;
                }
                if (is_ignored) write(".gitignore", "src/" + name + "\n");
                EXPECT_EQ(porttool({"check"}).exit_code, is_recorded ? 0 : 1) << about << ": tracked";
                git("rm -q --cached 'src/" + name + "'");
                const CommandRun got = porttool({"check"});
                EXPECT_EQ(got.exit_code, 1) << about;
                EXPECT_EQ(got.out.find("Remove the [[pair]]"), std::string::npos) << about << got.out;
                EXPECT_EQ(got.out.find("is not there"), std::string::npos) << about << got.out;
                const size_t command = got.out.find("if it is one: git add");
                ASSERT_NE(command, std::string::npos) << about << got.out;
                const size_t begin = got.out.find("git", command) + 4;
                git(got.out.substr(begin, got.out.find(" [", begin) - begin));
                const CommandRun then = porttool({"check"});
                EXPECT_EQ(then.exit_code, is_recorded ? 0 : 1) << about << then.out;
                EXPECT_EQ(then.out.find("is not tracked"), std::string::npos) << about << then.out;
                EXPECT_EQ(then.out.find("[unrecorded]") == std::string::npos, is_recorded) << about << then.out;
            }
}

TEST_F(HostileChange, TheNameAtTheEndOfALinkStaysWithinItsLine) {
    const std::string name = "x\nin_step: 9 pairs, 9 in step";
    for (const char* led : {"portmap.toml", "portmap.lock"}) {
        git("checkout -qf .");
        write(name, "no source\n");
        link(name, led);
        const CommandRun got = porttool({"check"});
        EXPECT_EQ(got.exit_code, 2) << led;
        EXPECT_EQ(("\n" + got.out + got.err).find("\nin_step"), std::string::npos) << led << "\n" << got.out + got.err;
        EXPECT_NE(got.err.find("in_step: 9 pairs"), std::string::npos) << "it is named all the same\n" << got.err;
    }
}

TEST_F(HostileChange, AnotherReasonToIgnoreIsListed) {
    const auto with = [map = read_text(root / "portmap.toml")](const std::string& reason) {
        return map + "\n[[ignore]]\nid = \"src/k.cu:h\"\nreason = \"" + reason + "\"\n";
    };
    write("portmap.toml", with("for the GPU alone"));
    git("add -A && git commit -qm more && git branch -f then");
    write("portmap.toml", with("nobody needs it"));
    const auto got = nlohmann::json::parse(porttool({"check", "--base", "then", "--format", "json"}).out);
    ASSERT_EQ(got["brought_in"].size(), 1u) << got["brought_in"].dump(1);
    EXPECT_EQ(got["brought_in"][0]["text"], "src/k.cu:h: nobody needs it");
}

TEST_F(HostileChange, OutputGoesToWhatTheFileIs) {
    const fs::path shared = fs::exists("/dev/shm")
                                ? fs::path("/dev/shm") / ("porttool_test" + std::to_string(::getpid()) + ".txt")
                                : outside / "x.txt";
    for (int i = 0; i < 2; ++i) ASSERT_EQ(porttool({"check", "-o", shared.string()}).exit_code, 0);
    const std::string once = porttool({"check"}).out;
    EXPECT_EQ(read_text(shared), once) << "a file is replaced wherever it lies";
    write("left.txt.porttool-999999999.1", "half");
    write("left.txt.porttool-" + std::to_string(::getpid()) + ".7", "of a living process");
    write("left.txt.tmp999999999", "the user's own");
    ASSERT_EQ(porttool({"check", "-o", "left.txt"}).exit_code, 0);
    EXPECT_TRUE(fs::exists(root / "left.txt.tmp999999999"));
    EXPECT_FALSE(fs::exists(root / "left.txt.porttool-999999999.1"));
    EXPECT_TRUE(fs::exists(root / ("left.txt.porttool-" + std::to_string(::getpid()) + ".7")));
    fs::create_symlink("left.txt", root / "to.txt");
    ASSERT_EQ(porttool({"check", "-o", "to.txt"}).exit_code, 0);
    EXPECT_TRUE(fs::is_symlink(root / "to.txt"));
    fs::remove(shared);
}

}  // namespace
}  // namespace porttool::testing::hostile_change_test
