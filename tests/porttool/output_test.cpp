// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What leaves porttool arrives whole and in its format, whatever the names, the texts and the place.
#include <sys/stat.h>
#include <sys/wait.h>

#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::output_test {
namespace {

using nlohmann::json;

class Output : public TemporaryRepository {
protected:
    /// Runs the program itself through a shell, in the repository.
    CommandRun shell(const std::string& arguments) const {
        const std::string err = (root / ".err").string();
        const int status = std::system(
            ("cd '" + root.string() + "' && '" + program_folder() + "/porttool' " + arguments + " 2> '" + err + "'")
                .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, "", text_of(err)};
    }
    static std::string text_of(const std::filesystem::path& path) {
        std::ifstream stream(path, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }
};

TEST_F(Output, AFullDeviceIsAFailure) {
    if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    write("k.cu", "__device__ float f(float a) { return a; }\n");
    for (const char* command : {"--version", "--help", "scan --help", "scan k.cu", "scan k.cu --format json"}) {
        const CommandRun got = shell(std::string(command) + " > /dev/full");
        EXPECT_EQ(got.exit_code, 2) << command;
        EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << command << ": " << got.err;
        EXPECT_NE(got.err.find("stdout"), std::string::npos) << got.err;
    }
}

TEST_F(Output, ALimitOnTheSizeOfFilesIsAnErrorThatLeavesNothing) {
    write("s/k.cu", "__device__ float f(float a) { return a; }\n");
    write("t/k.cpp", "inline float f(float a) { return a; }\n");
    const auto init = [&](const std::string& before) {
        return std::system(("cd '" + root.string() + "' && " + before + " '" + program_folder() +
                            "/porttool' init --source 's/*' --target 't/*' > /dev/null 2>&1")
                               .c_str());
    };
    const int status = init("ulimit -f 0;");
    ASSERT_TRUE(WIFEXITED(status)) << "a signal ended it";
    EXPECT_EQ(WEXITSTATUS(status), 2);
    for (const auto& entry : std::filesystem::directory_iterator(root))
        EXPECT_FALSE(entry.path().filename().string().starts_with("portmap")) << entry.path();
    EXPECT_EQ(init(""), 0);
}

TEST_F(Output, LittleMemoryIsAnErrorWithALineWhereverItEnds) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "a sanitizer needs more room for addresses than any limit leaves";
#endif
    write("t/k.cpp", "inline float f(float a) { return a; }\n");
    for (int i = 1; i < 5; ++i) {
        write("s/k.cu", "__device__ float f(float a) { return a * " + std::to_string(i) + ".0f; }\n");
        if (i == 1) {
            ASSERT_EQ(porttool({"init", "--source", "s/*", "--target", "t/*"}).exit_code, 0);
        }
        commit("state " + std::to_string(i), i);
    }
    // From what the program needs to be loaded, to what its threads need.
    for (int kibibytes = 42'000; kibibytes < 72'000; kibibytes += 500) {
        const std::string limit = "ulimit -v " + std::to_string(kibibytes) + "; '" + program_folder() + "/porttool' ";
        const auto run = [&](const std::string& command) {
            return std::system(("cd '" + root.string() + "' && (" + limit + command + ") > /dev/null 2> .err").c_str());
        };
        if (run("--version") != 0) continue;
        const int status = run("history");
        ASSERT_TRUE(WIFEXITED(status)) << kibibytes;
        const std::string said = text_of(root / ".err");
        if (WEXITSTATUS(status) == 0) continue;
        EXPECT_EQ(WEXITSTATUS(status), 2) << kibibytes << ": " << said;
        EXPECT_NE(said.find("not enough memory"), std::string::npos) << kibibytes << ": " << said;
    }
}

/// A page is made of nested values, whose destructors ask for memory, too.
TEST_F(Output, LittleMemoryForAPageIsAnErrorWithALine) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "a sanitizer needs more room for addresses than any limit leaves";
#endif
    std::string source, target;
    for (int i = 0; i < 1200; ++i) {
        const std::string function = "float f" + std::to_string(i) + "(float a) { return a * " + std::to_string(i);
        source += "__device__ " + function + ".5f; }\n";
        target += "inline " + function + ".5f; }\n";
    }
    write("s/k.cu", source);
    write("t/k.cpp", target);
    ASSERT_EQ(porttool({"init", "--source", "s/*", "--target", "t/*"}).exit_code, 0);
    for (int kibibytes = 50'000; kibibytes < 70'000; kibibytes += 1000) {
        const std::string limit = "ulimit -v " + std::to_string(kibibytes) + "; '" + program_folder() + "/porttool' ";
        const auto run = [&](const std::string& command) {
            return std::system(("cd '" + root.string() + "' && (" + limit + command + ") > /dev/null 2> .err").c_str());
        };
        if (run("--version") != 0) continue;  // it was not even loaded
        const int status = run("report --format html");
        ASSERT_TRUE(WIFEXITED(status)) << kibibytes;
        if (WEXITSTATUS(status) == 0) continue;
        const std::string said = text_of(root / ".err");
        EXPECT_EQ(WEXITSTATUS(status), 2) << kibibytes << ": " << said;
        EXPECT_NE(said.find("not enough memory"), std::string::npos) << kibibytes << ": " << said;
    }
}

TEST_F(Output, WhatIsRecordedIsSaidWhereTheAnswerCannotBe) {
    if (!std::filesystem::is_character_file("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
    write("s/k.cu", "__device__ float f(float a) { return a; }\n");
    write("t/k.cpp", "inline float f(float a) { return a; }\n");
    ASSERT_EQ(porttool({"init", "--source", "s/*", "--target", "t/*"}).exit_code, 0);
    int number = 2;
    for (const char* sink : {"> /dev/full", "-o /dev/full", ">&-", "<&- >&-"}) {
        write("s/k.cu", "__device__ float f(float a) { return a * " + std::to_string(++number) + ".0f; }\n");
        const CommandRun got = shell(std::string("accept --all --force ") + sink);
        EXPECT_EQ(got.exit_code, 2) << sink;
        EXPECT_EQ(std::count(got.err.begin(), got.err.end(), '\n'), 1) << sink << ": " << got.err;
        EXPECT_NE(got.err.find("portmap.lock is written"), std::string::npos) << sink << ": " << got.err;
        EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0) << sink;
    }
    // No file that is opened gets the number of a closed stream, and with it what is said.
    ASSERT_EQ(
        std::system(
            ("cd '" + root.string() + "' && '" + program_folder() + "/porttool' accept nobody 2>&- >&-").c_str()) >>
            8,
        2);
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
}

TEST_F(Output, ADashIsStdout) {
    write("k.cu", "__device__ float f(float a) { return a; }\n");
    const CommandRun got = porttool({"scan", "k.cu", "-o", "-"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    EXPECT_EQ(got.out, porttool({"scan", "k.cu"}).out);
    EXPECT_FALSE(std::filesystem::exists(root / "-"));
}

TEST_F(Output, AMissingFolderIsNamedNotMade) {
    write("k.cu", "__device__ float f(float a) { return a; }\n");
    const CommandRun got = porttool({"scan", "k.cu", "-o", "nope/deeper/x.json"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("nope/deeper"), std::string::npos) << got.err;
    EXPECT_FALSE(std::filesystem::exists(root / "nope"));
}

TEST_F(Output, WhatCannotBeWrittenToIsToldWithWhatHelps) {
    write("k.cu", "__device__ float f(float a) { return a; }\n");
    std::filesystem::create_directory(root / "folder");
    ASSERT_EQ(::mkfifo((root / "pipe").c_str(), 0600), 0);
    std::vector<std::pair<std::string, std::string>> sinks = {
        {"folder", "-o folder is a folder; name a file in it"},
        {"folder/", "-o folder/ is a folder; name a file in it"},
        {".", "-o . is a folder; name a file in it"},
        {"nope/x", "-o nope/x: there is no folder " + (root / "nope").string() + "; make it first"},
        {"k.cu/x", "-o k.cu/x: there is no folder " + (root / "k.cu").string() + "; make it first"},
        {"pipe", "-o pipe: is a pipe that nobody reads; name another file"}};
    if (std::filesystem::is_character_file("/dev/full"))
        sinks.emplace_back("/dev/full", "-o /dev/full: cannot be written: No space left on device; name another file");
    for (const auto& [sink, said] : sinks) {
        const CommandRun got = porttool({"scan", "k.cu", "-o", sink});
        EXPECT_EQ(got.exit_code, 2) << sink;
        EXPECT_EQ(got.out, "") << sink;
        EXPECT_EQ(got.err, "porttool: " + said + "\n");
    }
}

TEST_F(Output, AFileThatIsReplacedKeepsItsPermissions) {
    write("k.cu", "__device__ float f(float a) { return a; }\n");
    write("out.txt", "earlier");
    for (const mode_t mode : {0600u, 0664u, 0755u}) {
        ASSERT_EQ(::chmod((root / "out.txt").c_str(), mode), 0);
        ASSERT_EQ(porttool({"scan", "k.cu", "-o", "out.txt"}).exit_code, 0);
        struct stat after {};
        ASSERT_EQ(::stat((root / "out.txt").c_str(), &after), 0);
        EXPECT_EQ(after.st_mode & 07777, mode);
        EXPECT_NE(text_of(root / "out.txt").find("k.cu:f"), std::string::npos);
    }
}

const char* kCuda = "__device__ float shade(float a) { float b = a * 2.0f; return b + 1.0f; }\n";
const char* kGlsl = "float shade(float a) { float b = a * 2.0; return b + 1.0; }\n";

TEST(Names, OddFileNamesSurviveTheMapAndTheLock) {
    for (const std::string name : {"new\nline", "quo\"te", "back\\slash", "bell\x07", "del\x7f", "tab\there", "100%09",
                                   "carriage\rreturn", "a'b", "ümlaut", "#hash", "%"}) {
        MemoryDisk disk;
        const std::string source = "src/" + name + ".cu", target = "port/" + name + ".comp";
        disk.files = {{"/r/" + source, kCuda}, {"/r/" + target, kGlsl}};
        const CommandRun made = run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
        ASSERT_EQ(made.exit_code, 0) << name << ": " << made.err;
        const CommandRun clean = run(disk, {"-C", "/r", "check", "--format", "json"});
        ASSERT_EQ(clean.exit_code, 0) << name << ": " << clean.err;
        const json summary = json::parse(clean.out)["summary"];
        EXPECT_EQ(summary["pairs"], 1) << name;
        EXPECT_EQ(summary["in_step"], 1) << name;
        disk.files["/r/" + source] = replaced(kCuda, "2.0f", "3.0f");
        const json drifted = json::parse(run(disk, {"-C", "/r", "check", "--format", "json"}).out);
        ASSERT_EQ(drifted["findings"].size(), 1u) << name;
        EXPECT_EQ(drifted["findings"][0]["source"]["file"], source) << name;
        const CommandRun deferred = run(disk, {"-C", "/r", "defer", source + ":shade", "--owner", "me", "--until",
                                               "2999-01-01", "--reason", "50 % done,\ttab"});
        ASSERT_EQ(deferred.exit_code, 0) << name << ": " << deferred.err;
        EXPECT_EQ(json::parse(run(disk, {"-C", "/r", "check", "--format", "json"}).out)["summary"]["deferred"], 1)
            << name;
    }
}

TEST(Names, AGlobWithAnOddNameIsReadBack) {
    MemoryDisk disk;
    disk.files = {{"/r/src/a\n\"b.cu", kCuda}, {"/r/port/k.comp", kGlsl}};
    ASSERT_EQ(run(disk, {"-C", "/r", "init", "--source", "src/a\n\"b.cu", "--target", "port/*"}).exit_code, 0);
    const CommandRun clean = run(disk, {"-C", "/r", "check"});
    EXPECT_EQ(clean.exit_code, 0) << clean.err;
}

TEST(Names, WhatIsNotUtf8IsSkippedAndNamed) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kCuda}, {"/r/src/\xE9t\xE9.cu", kCuda}, {"/r/port/k.comp", kGlsl}};
    const CommandRun made = run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.err.find("the name is not UTF-8"), std::string::npos) << made.err;
    const CommandRun clean = run(disk, {"-C", "/r", "check", "--format", "json"});
    ASSERT_EQ(clean.exit_code, 0) << clean.err;
    EXPECT_EQ(json::parse(clean.out)["summary"]["in_step"], 1);
    EXPECT_NE(run(disk, {"-C", "/r", "scan", "src"}).out.find("the name is not UTF-8"), std::string::npos);
}

/// Whether Python reads every text as UTF-8, and as XML those that begin like it. Texts are apart by NUL bytes.
bool python_reads(const std::vector<std::string>& texts) {
    const auto file = std::filesystem::temp_directory_path() / ("porttool_output_" + std::to_string(::getpid()));
    std::ofstream stream(file, std::ios::binary);
    for (const std::string& text : texts) stream << text << '\0';
    stream.close();
    const std::string program =
        "import sys, xml.dom.minidom\n"
        "for text in sys.stdin.buffer.read().split(b\"\\0\"):\n"
        "    text.decode(\"utf-8\")\n"
        "    if text.startswith(b\"<?xml\"): xml.dom.minidom.parseString(text)\n";
    const int status = std::system(("python3 -c '" + program + "' < '" + file.string() + "'").c_str());
    std::filesystem::remove(file);
    return status == 0;
}

TEST(Texts, EveryFormatIsUtf8AndWellFormedWhateverTheSourceHolds) {
    if (std::system("python3 --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "python3 is not installed";
    ASSERT_FALSE(python_reads({"ok", "caf\xE9"}));
    ASSERT_FALSE(python_reads({"ok", "<?xml version=\"1.0\"?><a>\x01</a>"}));
    std::vector<std::string> texts;
    for (const std::string odd : {"x\xE9", "\xC3", "\xED\xA0\x80", "\xF5\x80\x80\x80", "\xC0\xAF", "\xEF\xBF\xBE",
                                  "\x01\x0B\x1F", "\x1B[31m"}) {
        const std::string plain = "__device__ int f(int a) { log(\"y\"); return a + g(a) * 4; }\n";
        const std::string source = replaced(plain, "\"y\"", "\"" + odd + "\"");
        MemoryDisk disk = started(source, replaced(source, "__device__ ", ""));
        disk.files["/r/src/k.cu"] = plain;
        for (const char* format : {"text", "json", "sarif", "junit", "github", "gitlab", "markdown", "html"}) {
            const CommandRun got = run(disk, {"-C", "/r", "check", "--format", format});
            ASSERT_EQ(got.exit_code, 1) << format << got.err;
            texts.push_back(got.out);
            for (const char c : got.out) ASSERT_TRUE(static_cast<unsigned char>(c) >= 32 || c == '\n') << format;
            const bool traced =
                got.out.find("\xEF\xBF\xBD") != std::string::npos || got.out.find("\\u{") != std::string::npos ||
                got.out.find("\\u00") != std::string::npos || got.out.find("\\ufffe") != std::string::npos;
            EXPECT_TRUE(traced) << "lost without a trace in " << format << "\n" << got.out;
        }
        texts.push_back(run(disk, {"-C", "/r", "explain", "src/k.cu:f"}).out);
    }
    EXPECT_TRUE(python_reads(texts));
}

TEST(Texts, MarkdownEscapesNothingInsideCode) {
    const std::string source = "__device__ int f(int a) { int b = a + 1; return b + g(a); }\n";
    const std::string target = replaced(source, "__device__ ", "");
    MemoryDisk disk = started(source, target);
    disk.files["/r/src/k.cu"] = replaced(source, "return b", "if (b < max_depth * 2) b = 0; return b");
    disk.files["/r/port/k.comp"] = replaced(target, "a + 1", "a + 5");
    const std::string text = run(disk, {"-C", "/r", "check", "--format", "markdown"}).out;
    std::string spans;
    for (size_t first = text.find('`'); first != std::string::npos;) {
        const size_t last = text.find('`', first + 1);
        if (last == std::string::npos) break;
        spans += text.substr(first, last - first + 1);
        first = text.find('`', last + 1);
    }
    EXPECT_NE(spans.find("max_depth * 2"), std::string::npos) << text;
    EXPECT_EQ(spans.find('\\'), std::string::npos) << text;
}

TEST_F(Output, AnnotationsNameFilesFromTheRootOfTheRepository) {
    write("x/y/s/a.cu", kCuda);
    write("x/y/t/a.comp", kGlsl);
    const std::string folder = (root / "x/y").string();
    ASSERT_EQ(porttool({"init", "--source", "s/*", "--target", "t/*"}, folder).exit_code, 0);
    write("x/y/s/a.cu", replaced(kCuda, "2.0f", "3.0f"));
    const std::string github = porttool({"check", "--format", "github"}, folder).out;
    EXPECT_TRUE(github.starts_with("::error file=x/y/s/a.cu,")) << github;
    const auto gitlab = nlohmann::json::parse(porttool({"check", "--format", "gitlab"}, folder).out);
    EXPECT_EQ(gitlab[0]["location"]["path"], "x/y/s/a.cu");
    const auto sarif =
        nlohmann::json::parse(porttool({"check", "--format", "sarif"}, folder).out)["runs"][0]["results"][0];
    EXPECT_EQ(sarif["locations"][0]["physicalLocation"]["artifactLocation"]["uri"], "x/y/s/a.cu");
    EXPECT_EQ(sarif["relatedLocations"][0]["physicalLocation"]["artifactLocation"]["uri"], "x/y/t/a.comp");
    EXPECT_EQ(
        nlohmann::json::parse(porttool({"check", "--format", "json"}, folder).out)["findings"][0]["source"]["file"],
        "s/a.cu");
}

TEST(Sizes, AFileAboveTheLimitIsSkippedWithTheReason) {
    constexpr size_t kLimit = 16 * 1024 * 1024;
    MemoryDisk disk;
    disk.files = {{"/r/in.cu", "int a;" + std::string(kLimit - 6, '\n')},
                  {"/r/over.cu", "int a;" + std::string(kLimit - 5, '\n')}};
    const json got = json::parse(run(disk, {"-C", "/r", "scan", "in.cu", "over.cu", "--format", "json"}).out);
    ASSERT_EQ(got["skipped"].size(), 1u);
    EXPECT_EQ(got["skipped"][0]["file"], "over.cu");
    EXPECT_NE(got["skipped"][0]["reason"].get<std::string>().find("16 MiB"), std::string::npos);
}

}  // namespace
}  // namespace porttool::testing::output_test
