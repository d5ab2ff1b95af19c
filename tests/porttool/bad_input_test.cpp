// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What a person gets wrong: exit code 2, one or two lines that name the place, and nothing written.
#include <sys/stat.h>
#include <unistd.h>

#include "porttool/read/bounded_json.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::bad_input_test {
namespace {

const char* kSource = "__device__ float shade(float a, float b) {\n  float c = a * b;\n  return c * 0.5f;\n}\n";
const char* kTarget = "float shade(float a, float b) {\n  float c = a * b;\n  return c * 0.5;\n}\n";

/// The message of a command line that must fail and must leave the disk as it was.
std::string error_of(MemoryDisk disk, std::vector<std::string> arguments) {
    const auto before = disk.files;
    arguments.insert(arguments.begin(), {"-C", "/r"});
    const CommandRun got = run(disk, arguments);
    EXPECT_EQ(got.exit_code, 2) << got.out;
    EXPECT_EQ(got.out, "");
    EXPECT_LE(std::count(got.err.begin(), got.err.end(), '\n'), 3) << got.err;
    EXPECT_EQ(disk.files, before);
    return got.err;
}

bool says(const std::string& message, const std::string& part) { return message.find(part) != std::string::npos; }

// A few bytes a value, forty in memory: what has millions is no message and no evidence.
TEST(BadInput, JsonOfDeepOrVeryManyValues) {
    using nlohmann::json;
    const auto is_read = [](const std::string& text) { return !bounded_json<json>(text, 4).is_discarded(); };
    const auto repeated = [](const std::string& part, size_t times) {
        std::string out;
        for (size_t i = 0; i < times; ++i) out += part;
        return out;
    };
    EXPECT_TRUE(is_read(R"([[[{"a": 1}]]])"));
    EXPECT_FALSE(is_read("[[[[[1]]]]]"));
    EXPECT_FALSE(is_read(R"([[[{"a": [1]}]]])"));
    EXPECT_TRUE(is_read(R"([[{"a": [], "b": {}}], null, true, 1, -1, 1.5, "x"])"));
    EXPECT_FALSE(is_read("[1"));
    EXPECT_FALSE(is_read(std::string(10'000'000, '[')));
    for (const std::string part : {"0,", "[],", "{},", "\"\","}) {
        EXPECT_TRUE(is_read("[" + repeated(part, 300'000) + "0]")) << part;  // in seconds, not hours
        EXPECT_FALSE(is_read("[" + repeated(part, 4'200'000) + "0]")) << part;
    }
}

TEST(BadInput, Globs) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kSource}, {"/r/port/k.comp", kTarget}};
    auto init = [&](const std::string& glob) {
        return error_of(disk, {"init", "--source", glob, "--target", "port/*"});
    };
    EXPECT_TRUE(says(init("no/*"), "'no/*' matches no file"));
    EXPECT_TRUE(says(init("src/[k.cu"), "'[' is never closed"));
    EXPECT_TRUE(says(init("src/{k,l.cu"), "'{' is never closed"));
    EXPECT_TRUE(says(init(""), "empty source glob"));
    EXPECT_TRUE(says(error_of(disk, {"init"}), "init needs --source GLOB"));
}

TEST(BadInput, SidesOfTheSameFiles) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kSource}, {"/r/port/k.comp", kTarget}};
    for (const char* command : {"init", "map", "difftest"}) {
        EXPECT_TRUE(says(error_of(disk, {command, "--source", "src/*", "--target", "src/*"}),
                         "all files of the source are files of the target as well"))
            << command;
        EXPECT_TRUE(says(error_of(disk, {command, "--source", "**", "--target", "port/*"}),
                         "all files of the target are files of the source as well"))
            << command;
    }
    disk.files["/r/src/common.h"] = "constexpr int kSize = 4;\n";  // a header of both sides is no reason
    EXPECT_EQ(run(disk, {"-C", "/r", "map", "--source", "src/*", "--target", "{port/*,src/common.h}"}).exit_code, 0);
}

TEST(BadInput, NoMapNamesTheWayWithoutOne) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kSource}};
    for (const char* command : {"map", "audit", "difftest"})
        EXPECT_TRUE(says(error_of(disk, {command}), "name both sides with --source GLOB --target GLOB, or write one"))
            << command;
    EXPECT_TRUE(says(error_of(disk, {"check"}), "or above; write one with: porttool init"));
}

TEST(BadInput, WhatACommandNeedsIsNamedAtOnce) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kSource}};
    const auto needs = [&](std::vector<std::string> arguments, const std::string& what) {
        const std::string command = arguments.front();
        EXPECT_EQ(error_of(disk, arguments), "porttool: " + command + " needs " + what + "\nRun 'porttool " + command +
                                                 " --help' for its options.\n");
    };
    needs({"defer", "src/k.cu:shade"}, "--owner NAME, --until DATE, --reason TEXT");
    needs({"defer", "src/k.cu:shade", "--until", "2999-01-01", "--owner"}, "--owner NAME, --reason TEXT");
    needs({"ignore"}, "ID, --reason TEXT");
    needs({"compare", "a"}, "A B");
    needs({"compare", "a", "b", "c"}, "A B");
    EXPECT_EQ(error_of(disk, {}),
              "porttool: no command given\nRun 'porttool --help' for the commands, and 'porttool COMMAND --help' for "
              "the options of one.\n");
}

TEST(BadInput, OfANewPairTheSideThatIsNoUnitIsNamed) {
    MemoryDisk disk = started(kSource, kTarget);
    EXPECT_TRUE(says(error_of(disk, {"accept", "src/k.cu:shade=port/k.comp:shaed"}),
                     "port/k.comp:shaed: no such unit on the target side; list those of its file with: porttool scan "
                     "port/k.comp"));
    EXPECT_TRUE(says(error_of(disk, {"accept", "src/k.cu:f=port/k.comp:shade"}),
                     "src/k.cu:f: no such unit on the source side"));
    EXPECT_TRUE(says(error_of(disk, {"accept", "a=b"}), "a=b: no such pair or finding"));
}

TEST(BadInput, AFirstMapWithoutPairsSaysThatNothingIsWatched) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kSource}, {"/r/port/k.comp", "float other;\n"}};
    const CommandRun got = run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    EXPECT_TRUE(says(got.out, "Nothing is watched yet: name pairs with porttool accept SOURCE=TARGET")) << got.out;
    EXPECT_FALSE(says(got.out, "recorded, not verified")) << got.out;
}

TEST(BadInput, Pairs) {
    MemoryDisk disk = started(kSource, kTarget);
    std::string& map = disk.files["/r/portmap.toml"];
    const std::string good = map;
    map = good + "[[pair]]\nsource = \"src/k.cu:shade\"\ntarget = \"port/k.comp:shade\"\n";
    std::string message = error_of(disk, {"check"});
    EXPECT_TRUE(says(message, "stands here twice")) << message;
    EXPECT_TRUE(says(message, "portmap.toml:")) << message;
    const std::string target = "target = \"port/k.comp:shade\"";
    map = replaced(good, target, "target = [\"port/k.comp:shade\", \"port/k.comp:shade\"]");
    EXPECT_TRUE(says(error_of(disk, {"check"}), "stands here twice"));
    map = replaced(good, target, "target = []");
    EXPECT_TRUE(says(error_of(disk, {"check"}), "'target' names no unit"));
    map = replaced(good, target, "target = \"\"");
    EXPECT_TRUE(says(error_of(disk, {"check"}), "'target' names no unit"));
    map = replaced(good, "src/*", "");
    EXPECT_TRUE(says(error_of(disk, {"check"}), "empty source glob"));
    map = "";
    message = error_of(disk, {"check"});
    EXPECT_TRUE(says(message, "'version = 1' is missing")) << message;
    for (const char* broken : {"", "version = 1\n[sides\n", "version = 1\n[sides]\nsauce = [\"src/*\"]\n"}) {
        map = broken;
        message = error_of(disk, {"check"});
        EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 1) << "one line: " << message;
    }
    map = good + std::string(17 << 20, '#');
    EXPECT_TRUE(says(error_of(disk, {"check"}), "portmap.toml is 17 MiB, more than the 16 MiB"));
    map = "version = 1\n[sides\n";
    EXPECT_TRUE(says(error_of(disk, {"check"}), "portmap.toml:2:7: no TOML: ")) << message;
    EXPECT_TRUE(says(error_of(disk, {"check"}), "; correct that line"));
}

TEST(BadInput, Locks) {
    MemoryDisk disk = started(kSource, kTarget);
    std::string& lock = disk.files["/r/portmap.lock"];
    const std::string good = lock;
    const size_t line = good.find("pair\t");
    std::string other = good.substr(line, good.find('\n', line) - line + 1);
    lock = good + other;
    EXPECT_EQ(run(disk, {"-C", "/r", "check"}).exit_code, 0) << "the same line twice says one thing";
    other[other.size() - 2] = other[other.size() - 2] == '0' ? '1' : '0';
    lock = good + other;
    const std::string message = error_of(disk, {"check"});
    EXPECT_TRUE(says(message, "a second line for 'src/k.cu:shade=port/k.comp:shade'")) << message;
    EXPECT_TRUE(says(message, "as after a merge")) << message;
    disk.files.erase("/r/portmap.lock");
    EXPECT_TRUE(says(error_of(disk, {"check"}), "with: porttool init"));
    ASSERT_EQ(run(disk, {"-C", "/r", "init"}).exit_code, 0) << "and that remedy helps";
    EXPECT_EQ(disk.files["/r/portmap.lock"], good);
    EXPECT_TRUE(says(error_of(disk, {"init"}), "there already"));
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
}

TEST(BadInput, Days) {
    const MemoryDisk disk = started(kSource, kTarget);
    for (const char* day : {"2026-02-31", "2026-13-01", "2026-00-10", "26-01-01", "tomorrow", "2026-1-01x"})
        EXPECT_TRUE(says(error_of(disk, {"defer", "src/k.cu:shade", "--owner", "me", "--until", day, "--reason", "r"}),
                         "expected a date"))
            << day;
}

TEST(BadInput, AFileThatGoesAwayWhileReadingIsNamed) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.errors["/r/src/gone.cu"] = "cannot be read: No such file or directory";  // listed, and then gone
    const auto report = check(disk);
    ASSERT_EQ(report["findings"].size(), 1u);
    EXPECT_EQ(report["findings"][0]["rule"], "unreadable");
    EXPECT_EQ(report["findings"][0]["source"]["file"], "src/gone.cu");
}

TEST(BadInput, TwoTextsOfAMergeAreNoText) {
    const auto merged = [](const std::string& text) {
        return replaced(text, "  float c = a * b;\n",
                        "<<<<<<< HEAD\n  float c = a * b;\n=======\n  float c = a + b;\n>>>>>>> other\n");
    };
    const MemoryDisk disk = started(kSource, kTarget);
    for (const char* file : {"/r/src/k.cu", "/r/port/k.comp"}) {
        MemoryDisk unfinished = disk;
        unfinished.files[file] = merged(unfinished.files[file]);
        for (const auto& command :
             std::vector<std::vector<std::string>>{{"check"}, {"accept", "--all", "--force"}, {"sync"}, {"init"}}) {
            const std::string message = error_of(unfinished, command);
            if (command[0] == "init") continue;  // which there is a lock for
            EXPECT_TRUE(says(message, std::string(file).substr(3) + ":2: holds the marks of a merge")) << message;
        }
        unfinished.files.erase("/r/portmap.toml");
        unfinished.files.erase("/r/portmap.lock");
        EXPECT_TRUE(says(error_of(unfinished, {"init", "--source", "src/*", "--target", "port/*"}), "of a merge"));
    }
    MemoryDisk finished = disk;  // one mark alone is none, nor are all three where no line begins with them
    finished.files["/r/src/k.cu"] += "/*\n=======\n>>>>>>> b\n  <<<<<<< a\n*/\n";
    EXPECT_EQ(run(finished, {"-C", "/r", "check"}).exit_code, 0);
    finished = disk;  // and a file without a pair may hold what it likes
    finished.files["/r/src/other.cu"] =
        merged("__device__ int more(int a, int b) {\n  float c = a * b;\n return a;\n}\n");
    EXPECT_NE(run(finished, {"-C", "/r", "check"}).exit_code, 2);
}

TEST(BadInput, NoOutputTakesThePlaceOfAnInput) {
    const MemoryDisk disk = started(kSource, kTarget);
    for (const auto& [file, what] : {std::pair("portmap.toml", "is the map"), std::pair("portmap.lock", "is the lock"),
                                     std::pair("src/k.cu", "is a source"), std::pair("port/k.comp", "is a port")}) {
        EXPECT_TRUE(says(error_of(disk, {"check", "-o", file}), what)) << file;
        EXPECT_TRUE(says(error_of(disk, {"difftest", "--evidence", std::string("/r/") + file}), what)) << file;
    }
    EXPECT_TRUE(says(error_of(disk, {"compare", "src/k.cu", "port/k.comp", "-o", "src/k.cu"}), "would be lost"));
    MemoryDisk written = disk;
    EXPECT_EQ(run(written, {"-C", "/r", "check", "-o", "src/k.json"}).exit_code, 0);  // which no side reads
    EXPECT_EQ(run(written, {"-C", "/r", "check", "-o", "src/k.json"}).exit_code, 0);
    EXPECT_TRUE(written.files.contains("/r/src/k.json"));
}

TEST(BadInput, APipeThatNobodyReadsIsNotWaitedFor) {
    const auto folder = std::filesystem::temp_directory_path() / ("porttool_pipe_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    std::ofstream(folder / "k.cu") << kSource;
    RealDisk disk;
    const CommandRun got = run(disk, {"-C", folder.string(), "scan", "k.cu", "-o", "pipe"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_TRUE(says(got.err, "-o pipe: is a pipe that nobody reads")) << got.err;
    std::filesystem::remove_all(folder);
}

TEST(BadInput, AReasonHasWords) {
    const MemoryDisk disk = started(kSource, kTarget);
    EXPECT_TRUE(says(error_of(disk, {"ignore", "src/k.cu:shade", "--reason", " "}), "--reason is empty"));
    EXPECT_TRUE(
        says(error_of(disk, {"defer", "src/k.cu:shade", "--owner", "", "--until", "2999-01-01", "--reason", "b"}),
             "--owner is empty"));
}

TEST(BadInput, LoopsOfLinksPipesAndLargeFilesAreSkippedAndNamed) {
    const auto root = std::filesystem::temp_directory_path() / "porttool_bad_input_test";
    std::filesystem::remove_all(root);
    std::filesystem::create_directories(root / "src");
    std::filesystem::create_directories(root / "port");
    std::ofstream(root / "src/k.cu") << kSource;
    std::ofstream(root / "port/k.comp") << kTarget;
    RealDisk disk;
    ASSERT_EQ(run(disk, {"-C", root.string(), "init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    std::filesystem::create_directory_symlink("../src", root / "src/loop");
    std::filesystem::create_directory_symlink("/usr", root / "src/elsewhere");
    std::filesystem::create_symlink("self.cu", root / "src/self.cu");
    std::filesystem::create_symlink("nowhere.cu", root / "src/dangling.cu");
    ASSERT_EQ(::mkfifo((root / "src/pipe.cu").c_str(), 0600), 0);
    std::ofstream(root / "src/large.cu") << "x";
    std::filesystem::resize_file(root / "src/large.cu", 100'000'000);  // a hole: takes no room
    const CommandRun got = run(disk, {"-C", root.string(), "check", "--format", "json"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    const auto report = nlohmann::json::parse(got.out);
    std::vector<std::string> files;
    for (const auto& finding : report["findings"]) {
        EXPECT_EQ(finding["rule"], "unreadable");
        files.push_back(finding["source"]["file"]);
    }
    EXPECT_EQ(files, (std::vector<std::string>{"src/dangling.cu", "src/elsewhere", "src/large.cu", "src/pipe.cu",
                                               "src/self.cu"}));
    std::filesystem::remove_all(root);
}

}  // namespace
}  // namespace porttool::testing::bad_input_test
