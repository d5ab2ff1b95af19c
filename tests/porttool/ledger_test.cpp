// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What holds for which unit: comments, verdicts, overloads, moves, and what init takes over.
#include <gtest/gtest.h>

#include <cstdlib>

#include "porttool/compare/constant_expression.h"
#include "porttool/read/source_files.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::ledger_test {
namespace {

CommandRun porttool(MemoryDisk& disk, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"-C", "/r"});
    return run(disk, arguments);
}

const char* kTwo = "float f(float a) {\n    return a * 2.0f; }\nfloat g(float a) {\n    return a * 4.0f; }\n";
const char* kTwoPort = "float f(float a) { return a * 2.0; }\nfloat g(float a) { return a * 4.0; }\n";

TEST(Ledger, ACommentBesideCodeBelongsToThatUnitAlone) {
    MemoryDisk disk = started(kTwo, kTwoPort);
    disk.files["/r/src/k.cu"] =
        "float f(float a) {\n    return a * 2.5f; } // porttool: ignore(source-changed) only f\n"
        "float g(float a) {\n    return a * 4.5f; }\n";
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"source-changed"}) << report.dump(1);
    EXPECT_EQ(report["findings"][0]["source"]["id"], "src/k.cu:g");
    EXPECT_EQ(report["summary"]["ignored"], 1);
}

TEST(Ledger, CommentsOnLinesOfTheirOwnBelongToTheNextUnit) {
    MemoryDisk disk = started(kTwo, kTwoPort);
    disk.files["/r/src/k.cu"] =
        "float f(float a) {\n    return a * 2.5f; }\n// porttool: ignore(source-changed) only g\n// and why\n"
        "float g(float a) {\n    return a * 4.5f; }\n";
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"source-changed"}) << report.dump(1);
    EXPECT_EQ(report["findings"][0]["source"]["id"], "src/k.cu:f");
}

TEST(Ledger, ALaterEditOpensADeferralAgain) {
    MemoryDisk disk = started(kTwo, kTwoPort);
    disk.files["/r/src/k.cu"] = replaced(kTwo, "4.0f", "5.0f");
    ASSERT_EQ(
        porttool(disk, {"defer", "src/k.cu:g", "--owner", "me", "--until", "2999-01-01", "--reason", "r"}).exit_code,
        0);
    EXPECT_EQ(check(disk)["summary"]["deferred"], 1);
    disk.files["/r/src/k.cu"] = replaced(kTwo, "4.0f", "-99.0f");
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"});
    disk.files["/r/src/k.cu"] = replaced(kTwo, "4.0f", "5.0f");
    disk.files["/r/port/k.comp"] = replaced(kTwoPort, "4.0", "7.0");
    EXPECT_EQ(rules(check(disk)), Rules{"port-differs"}) << "an edit of the port is an edit";
}

TEST(Ledger, InitTellsOfConstantsThatDifferAndKeepsIt) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", "#define MAX_PATH_LENGTH 8\n#define SAME (1 << 4)\n"},
                  {"/r/port/k.comp", "const int MAX_PATH_LENGTH = 7;\nconst int SAME = 16;\n"}};
    const CommandRun got = porttool(disk, {"init", "--source", "src/*", "--target", "port/*"});
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_NE(got.err.find("the value is '8' in the source and '7' in the port"), std::string::npos) << got.err;
    EXPECT_EQ(got.err.find("SAME"), std::string::npos) << got.err;
    EXPECT_EQ(check(disk)["verdict"], "in_step");
    EXPECT_NE(porttool(disk, {"explain", "src/k.cu:MAX_PATH_LENGTH"}).out.find("accepted at init"), std::string::npos);
    EXPECT_EQ(porttool(disk, {"explain", "src/k.cu:SAME"}).out.find("accepted at init"), std::string::npos);
}

TEST(Ledger, InitTellsAtMostTwentyDifferences) {
    std::string source, target;
    for (int i = 0; i < 25; ++i) {
        source += "#define LIMIT_" + std::to_string(i) + "_OF " + std::to_string(i + 100) + "\n";
        target += "#define LIMIT_" + std::to_string(i) + "_OF " + std::to_string(i + 500) + "\n";
    }
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", source}, {"/r/port/k.comp", target}};
    const CommandRun got = porttool(disk, {"init", "--source", "src/*", "--target", "port/*"});
    EXPECT_NE(got.err.find("and 5 more pairs that differ"), std::string::npos) << got.err;
}

/// Both sides come to the same value, however it is written.
TEST(Ledger, ConstantsAreComparedByValue) {
    const std::vector<std::pair<std::string, std::string>> same = {
        {"#define N (16)", "#define N 16"},
        {"#define N (1 << 4)", "const int N = 16;"},
        {"#define N ((int)9)", "const int N = 9;"},
        {"constexpr int N{9};", "const int N = 9;"},
        {"const float N[2] = {1.f, 3.f};", "const float N[2] = float[2](1.0, 3.0);"},
        {"#define N (~0u)", "const uint N = 0xFFFFFFFFu;"},
        {"const float N = 1;", "const float N = 1.0;"},
        {"#define N (7 / 2 + 10 % 4 - -1)", "#define N 6"},
        {"struct N { float3 o, d, e; };", "struct N { vec3 o; vec3 d; vec3 e; };"},
        {"struct N { unsigned int k; };", "struct N { uint k; };"}};
    for (const auto& [source, target] : same) {
        const bool is_struct = source[0] == 's';
        MemoryDisk disk = started(is_struct ? "struct N { int was; };\n" : "const int N = 77;\n",
                                  is_struct ? "struct N { int was; };\n" : "const int N = 77;\n");
        disk.files["/r/src/k.cu"] = source + "\n";
        disk.files["/r/port/k.comp"] = target + "\n";
        const auto report = check(disk);
        EXPECT_EQ(report["verdict"], "in_step") << source << "\n" << target << "\n" << report.dump(1);
    }
}

TEST(Ledger, ConstantsThatDifferAreShownAsWritten) {
    MemoryDisk disk = started("constexpr int N{7};\n", "const int N = 7;\n");
    disk.files["/r/src/k.cu"] = "constexpr int N{9};\n";
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"constant-differs"});
    EXPECT_EQ(report["findings"][0]["message"], "the value is '9' in the source and '7' in the port");
    disk.files["/r/src/k.cu"] = "constexpr int N = (1 << 4) - OFFSET;\n";
    EXPECT_EQ(check(disk)["findings"][0]["message"],
              "the value is '(1 << 4) - OFFSET' in the source and '7' in the port");
}

TEST(Ledger, ConstantExpressionsThatCannotBeToldHaveNoValue) {
    const Dialect dialect;
    EXPECT_EQ(evaluate_constant(Words{"1", "/", "0"}, dialect), "");
    EXPECT_EQ(evaluate_constant(Words{"N", "+", "1"}, dialect), "");
    EXPECT_EQ(evaluate_constant(Words{"(", "1"}, dialect), "");
    EXPECT_EQ(evaluate_constant(Words{}, dialect), "");
    EXPECT_EQ(evaluate_constant(Words(100000, "("), dialect), "") << "and it comes back at all";
    EXPECT_EQ(evaluate_constant(Words(100000, "-"), dialect), "");
    EXPECT_EQ(evaluate_constant(Words{"2", "+", "3", "*", "4"}, dialect), "14");
    EXPECT_EQ(evaluate_constant(Words{"1", "|", "6", "&", "3", "^", "8"}, dialect), "11");  // 1 | ((6 & 3) ^ 8)
}

std::string overload(const std::string& type, const std::string& number) {
    return "float g(" + type + " a) {\n    float b = float(a) * " + number + ";\n    return b * b;\n}\n";
}

TEST(Ledger, OverloadsAreRecognisedWhenOneIsGone) {
    const std::string all =
        overload("float", "1.5") + overload("int", "2.5") + overload("bool", "3.5") + overload("Foo", "4.5");
    MemoryDisk disk = started(all, all);
    disk.files["/r/src/k.cu"] = overload("int", "2.5") + overload("bool", "3.5") + overload("Foo", "4.5");
    EXPECT_EQ(rules(check(disk)), Rules{"orphaned"});
}

TEST(Ledger, OverloadsAreRecognisedBySignatureWhenEditedAndReordered) {
    const std::string all =
        overload("float", "1.5") + overload("int", "2.5") + overload("bool", "3.5") + overload("Foo", "4.5");
    const std::string other =
        overload("Foo", "4.5") + overload("bool", "3.5") + overload("int", "9.5") + overload("float", "1.5");
    MemoryDisk disk = started(all, all);
    disk.files["/r/src/k.cu"] = other;
    const auto report = check(disk);
    EXPECT_EQ(rules(report), Rules{"source-changed"}) << report.dump(1);
    EXPECT_NE(report["findings"][0]["message"].get<std::string>().find("2.5"), std::string::npos);
    disk.files["/r/port/k.comp"] =
        overload("int", "9.5") + overload("float", "1.5") + overload("Foo", "4.5") + overload("bool", "3.5");
    EXPECT_EQ(check(disk)["verdict"], "in_step");
    disk.files["/r/src/k.cu"] =
        overload("bool", "8.5") + overload("int", "9.5") + overload("float", "1.5") + overload("Foo", "7.5");
    disk.files["/r/port/k.comp"] =
        overload("Foo", "7.5") + overload("int", "9.5") + overload("bool", "8.5") + overload("float", "1.5");
    EXPECT_EQ(check(disk)["verdict"], "in_step") << check(disk).dump(1);
}

TEST(Ledger, SummaryAndVerdictAgreeBesideANote) {
    MemoryDisk disk = started(kTwo, kTwoPort);
    disk.files["/r/src/k.cu"] =
        "// porttool: ignore(source-changed) wanted\n" + replaced(kTwo, "a * 2.0f", "pow(a, 2.0f)");
    const auto report = check(disk);
    EXPECT_EQ(rules(report), Rules{"dialect-hazard"});
    EXPECT_EQ(report["verdict"], "in_step");
    EXPECT_EQ(report["summary"]["drifted"], 0);
    EXPECT_EQ(report["summary"]["ignored"], 1);
}

TEST(Ledger, AnUnportedUnitCanBeExplainedDeferredAndIgnored) {
    MemoryDisk disk = started(kTwo, kTwoPort);
    disk.files["/r/src/k.cu"] = std::string(kTwo) + "int kern(int a) { return a + 3; }\n";
    const std::string print = check(disk)["findings"][0]["fingerprint"];
    for (const std::string& id : {print, std::string("src/k.cu:kern")}) {
        MemoryDisk fresh = disk;
        const CommandRun told = porttool(fresh, {"explain", id});
        EXPECT_EQ(told.exit_code, 0) << told.err;
        EXPECT_NE(told.out.find("kern has no port"), std::string::npos);
        EXPECT_EQ(porttool(fresh, {"defer", id, "--owner", "me", "--until", "2999-01-01", "--reason", "r"}).exit_code,
                  0);
        EXPECT_EQ(check(fresh)["verdict"], "in_step");
        fresh.files["/r/src/k.cu"] = replaced(fresh.files["/r/src/k.cu"], "a + 3", "a + 4");
        EXPECT_EQ(rules(check(fresh)), Rules{"unported"}) << "edited since";
    }
    EXPECT_EQ(porttool(disk, {"ignore", print, "--reason", "host only"}).exit_code, 0);
    EXPECT_EQ(check(disk)["verdict"], "in_step");
    const auto sarif = nlohmann::json::parse(porttool(disk, {"check", "--format", "sarif"}).out);
    const auto& results = sarif["runs"][0]["results"];
    ASSERT_EQ(results.size(), 1u);
    EXPECT_EQ(results[0]["suppressions"][0]["justification"], "host only");
}

const char* kFile =
    "#define MAX_DEPTH 8\nfloat half_of(float a) { return a / 2.0f; }\n"
    "float longer(float a, float b) {\n    float c = a * b + 1.0f;\n    return c * c - a;\n}\n";

TEST(Ledger, AFileThatWasMovedTakesItsShortUnitsAlong) {
    MemoryDisk disk = started(kFile, kFile);
    disk.files["/r/src/moved.cu"] = kFile;
    disk.files.erase("/r/src/k.cu");
    const auto report = check(disk);
    EXPECT_EQ(report["verdict"], "in_step") << report.dump(1);
    EXPECT_EQ(report["summary"]["unported"], 0);
    std::string& map = disk.files["/r/portmap.toml"];
    for (int i = 0; i < 3; ++i) map = replaced(map, "src/k.cu:", "src/moved.cu:");
    EXPECT_TRUE(check(disk)["findings"].empty()) << check(disk).dump(1);
    EXPECT_EQ(porttool(disk, {"accept", "--all"}).exit_code, 0);
    disk.files["/r/src/moved.cu"] = replaced(kFile, "8", "9");
    EXPECT_EQ(rules(check(disk)), Rules{"constant-differs"});
}

TEST(Ledger, ABaselinedUnitWithACommentIsClean) {
    MemoryDisk disk =
        started(std::string(kTwo) + "// porttool: ignore(unported) host\nint host(int a) { return a; }\n", kTwoPort);
    EXPECT_TRUE(check(disk)["findings"].empty()) << check(disk).dump(1);
}

TEST(Ledger, AShortUnitThatMovedUnderItsNameIsFollowed) {
    const std::string pair = "struct Pair {\n    float a;\n    float b;\n};\n";
    MemoryDisk disk = started(kTwo + pair, kTwoPort + pair);
    disk.files["/r/src/k.cu"] = kTwo;
    disk.files["/r/src/pair.cu"] = pair;
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"source-changed"}) << report.dump(1);
    EXPECT_EQ(report["findings"][0]["level"], "note");
    EXPECT_EQ(report["findings"][0]["source"]["id"], "src/pair.cu:Pair");
    disk.files["/r/src/pair.cu"] = replaced(pair, "float b", "float c");
    EXPECT_EQ(rules(check(disk)), (Rules{"orphaned", "unpaired"})) << "another text is another struct";
}

TEST(Ledger, AcceptAllThatLeavesPairsSaysNo) {
    MemoryDisk disk = started(kTwo, kTwoPort);
    disk.files["/r/src/k.cu"] = replaced(kTwo, "4.0f", "5.0f");
    const CommandRun left = porttool(disk, {"accept", "--all"});
    EXPECT_EQ(left.exit_code, 1);
    EXPECT_NE(left.out.find("\n  src/k.cu:g\n"), std::string::npos) << left.out;
    EXPECT_EQ(left.out.find("src/k.cu:f"), std::string::npos) << left.out;
    EXPECT_EQ(porttool(disk, {"accept", "--all", "--force"}).exit_code, 0);
    EXPECT_EQ(porttool(disk, {"accept", "--all"}).exit_code, 0);
}

TEST(Ledger, DaysThatCannotBeAreRefused) {
    MemoryDisk disk = started(kTwo, kTwoPort);
    disk.files["/r/src/k.cu"] = replaced(kTwo, "4.0f", "5.0f");
    const auto before = disk.files;
    const CommandRun past =
        porttool(disk, {"defer", "src/k.cu:g", "--owner", "me", "--until", "2001-01-01", "--reason", "r"});
    EXPECT_EQ(past.exit_code, 2);
    EXPECT_NE(past.err.find("2001-01-01 is past"), std::string::npos) << past.err;
    for (const char* epoch : {"abc", "", "12x", "-1", "999999999999999999999"}) {
        setenv("SOURCE_DATE_EPOCH", epoch, 1);
        const CommandRun got = porttool(disk, {"check"});
        unsetenv("SOURCE_DATE_EPOCH");
        EXPECT_EQ(got.exit_code, 2) << epoch;
        EXPECT_EQ(got.out, "");
        EXPECT_NE(got.err.find("SOURCE_DATE_EPOCH"), std::string::npos) << got.err;
    }
    EXPECT_EQ(disk.files, before);
}

class LedgerInGit : public TemporaryRepository {};

TEST_F(LedgerInGit, ABaseNeedsNoLockThatCanBeRead) {
    write("src/k.cu", kTwo);
    write("port/k.comp", kTwoPort);
    ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    commit("one");
    write("src/k.cu", replaced(kTwo, "4.0f", "5.0f"));
    write("portmap.lock", "porttool-lock\t1\n<<<<<<< HEAD\n=======\n>>>>>>> other\n");
    const CommandRun got = porttool({"check", "--base", "HEAD", "--format", "json"});
    EXPECT_EQ(got.exit_code, 1) << got.err;
    EXPECT_NE(got.err.find("portmap.lock:2"), std::string::npos) << got.err;
    EXPECT_EQ(rules(nlohmann::json::parse(got.out)), Rules{"source-changed"});
    EXPECT_EQ(porttool({"check"}).exit_code, 2) << "without a base the lock is what counts";
}

TEST_F(LedgerInGit, AVerdictOnADriftThatIsOlderThanTheBaseIsNotIdle) {
    write("src/k.cu", kTwo);
    write("port/k.comp", kTwoPort);
    ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    commit("one");
    write("src/k.cu", replaced(kTwo, "4.0f", "5.0f"));
    ASSERT_EQ(porttool({"ignore", "src/k.cu:g", "--reason", "r"}).exit_code, 0);
    commit("two");
    const CommandRun got = porttool({"check", "--base", "HEAD", "--strict", "--format", "json"});
    EXPECT_EQ(got.exit_code, 0) << got.out << got.err;
    EXPECT_EQ(rules(nlohmann::json::parse(got.out)), Rules{});
    write("src/k.cu", kTwo);
    commit("three");
    const CommandRun idle = porttool({"check", "--base", "HEAD", "--format", "json"});
    EXPECT_EQ(rules(nlohmann::json::parse(idle.out)), Rules{"unused-suppression"}) << "both sides are as recorded";
}

TEST_F(LedgerInGit, ALockThatIsReadOnlyStaysAsItIs) {
    write("src/k.cu", kTwo);
    write("port/k.comp", kTwoPort);
    ASSERT_EQ(porttool({"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    write("src/k.cu", replaced(kTwo, "4.0f", "5.0f"));
    const auto lock = [&] { return disk.read((root / "portmap.lock").string(), kLargestFile).bytes; };
    const std::string before = lock();
    std::filesystem::permissions(root / "portmap.lock", std::filesystem::perms(0444));
    for (const std::vector<std::string>& command : {std::vector<std::string>{"accept", "--all"},
                                                    {"ignore", "src/k.cu:g", "--reason", "r"},
                                                    {"init", "--force", "--source", "src/*", "--target", "port/*"}}) {
        const CommandRun got = porttool(command);
        EXPECT_EQ(got.exit_code, 2) << command[0];
        EXPECT_NE(got.err.find("portmap.lock is read-only; nothing was written"), std::string::npos) << got.err;
        EXPECT_EQ(lock(), before) << command[0];
    }
    EXPECT_EQ(porttool({"check"}).exit_code, 1) << "to read it is enough for that";
}

}  // namespace
}  // namespace porttool::testing::ledger_test
