// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The command line as a user meets it: exit codes, streams, JSON.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/porttool/run_command.h"

namespace porttool::testing::command_test {
namespace {

TEST(Command, ScanPrintsTheContractsFields) {
    MemoryDisk disk;
    disk.files = {{"/r/k/a.cl", "// c\n__kernel void f(int a) {\n}\n"},
                  {"/r/k/empty.h", "int x;\n"},
                  {"/r/.git/HEAD", ""},
                  {"/r/k/bad.cu", std::string(1, '\0')}};
    const CommandRun got = run(disk, {"-C", "/r/k", "scan", ".", "--format", "json"});
    ASSERT_EQ(got.exit_code, 0) << got.err;
    const auto json = nlohmann::json::parse(got.out);
    ASSERT_EQ(json["units"].size(), 2u);
    const auto& unit = json["units"][0];
    EXPECT_EQ(unit["id"], "k/a.cl:f");
    EXPECT_EQ(unit["file"], "k/a.cl");
    EXPECT_EQ(unit["kind"], "kernel");
    EXPECT_EQ(unit["language"], "opencl");
    EXPECT_EQ(unit["start_line"], 2);
    EXPECT_EQ(unit["end_line"], 3);
    EXPECT_EQ(unit["fingerprint"].get<std::string>().size(), 16u);
    EXPECT_EQ(json["units"][1]["id"], "k/empty.h:@file");
    EXPECT_EQ(json["units"][1]["kind"], "file");
    EXPECT_EQ(json["skipped"][0]["file"], "k/bad.cu");
}

TEST(Command, NamesThatAreNotUtf8GiveValidJson) {
    MemoryDisk disk;
    disk.files = {{"/r/a.cl", "void f\xE4() {}\n"}};
    const CommandRun got = run(disk, {"-C", "/r", "scan", "a.cl", "--format", "json"});
    ASSERT_EQ(got.exit_code, 0);
    EXPECT_EQ(nlohmann::json::parse(got.out)["units"][0]["id"], "a.cl:f%E4");
    disk.files["/r/b.cpp"] = "void f\xE4() {}\n";
    ASSERT_EQ(run(disk, {"-C", "/r", "init", "--source", "a.cl", "--target", "b.cpp"}).exit_code, 0);
    EXPECT_EQ(run(disk, {"-C", "/r", "check"}).exit_code, 0);
}

TEST(Command, WhatCannotBeDoneIsExitCodeTwoWithEmptyStdout) {
    MemoryDisk disk;
    disk.files = {{"/r/a.cl", "void f() {}\n"}};
    for (const auto& arguments : std::vector<std::vector<std::string>>{{},
                                                                       {"scna", "a"},
                                                                       {"scan"},
                                                                       {"scan", "/r/none"},
                                                                       {"-C", "/none", "scan", "."},
                                                                       {"-C", "/r", "scan", "a.cl", "--format", "xml"},
                                                                       {"scan", "--bogus", "x"}}) {
        const CommandRun got = run(disk, arguments);
        EXPECT_EQ(got.exit_code, 2);
        EXPECT_EQ(got.out, "");
        EXPECT_FALSE(got.err.empty());
        EXPECT_LE(std::count(got.err.begin(), got.err.end(), '\n'), 2) << got.err;
    }
    EXPECT_NE(run(disk, {"scna", "a"}).err.find("did you mean 'scan'"), std::string::npos);
}

TEST(Command, AnUnknownSubcommandIsToldInOneLine) {
    MemoryDisk disk;
    const std::string known =
        "scan, map, init, check, watch, lsp, accept, defer, ignore, sync, difftest, audit, review, compare, explain, "
        "effort, history, report";
    for (const auto& [arguments, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"chekc"}, "unknown command 'chekc'; did you mean 'check'?"},
             {{"chekc", "--strict"}, "unknown command 'chekc'; did you mean 'check'?"},
             {{"-C", "/reprot", "hsitory"}, "unknown command 'hsitory'; did you mean 'history'?"},
             {{"--format", "check", "inti"}, "unknown command 'inti'; did you mean 'init'?"},
             {{"accpet", "--help"}, "unknown command 'accpet'; did you mean 'accept'?"},
             {{"frobnicate"}, "unknown command 'frobnicate'; there are " + known}}) {
        const CommandRun got = run(disk, arguments);
        EXPECT_EQ(got.exit_code, 2);
        EXPECT_EQ(got.out, "");
        EXPECT_EQ(got.err, "porttool: " + says + "\n");
    }
}

TEST(Command, AnUnknownOptionIsToldWithTheNearestOfItsCommand) {
    MemoryDisk disk;
    for (const auto& [arguments, near] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"check", "--strcit"}, "--strict"},
             {{"check", "--bsae=main"}, "--base"},
             {{"check", "--fromat", "json"}, "--format"},
             {{"report", "--fail-udner", "BSDF=90"}, "--fail-under"},
             {{"map", "--frobnicate"}, ""},
             {{"map", "--strict"}, ""}}) {  // another command's
        const CommandRun got = run(disk, arguments);
        EXPECT_EQ(got.exit_code, 2);
        EXPECT_EQ(got.out, "");
        if (near.empty())
            EXPECT_NE(got.err.find(arguments[1] + "; map has --source, --target, --write\n"), std::string::npos)
                << got.err;
        else
            EXPECT_NE(got.err.find(arguments[1] + "; did you mean '" + near + "'?\n"), std::string::npos) << got.err;
    }
}

TEST(Command, AnEmptyFileIsNoneAtAll) {  // as an unset variable of CI makes it
    MemoryDisk disk;
    for (const std::string option : {"-o", "--output", "--config"}) {
        const CommandRun got = run(disk, {"check", option, ""});
        EXPECT_EQ(got.exit_code, 2);
        EXPECT_NE(got.err.find("expected a file"), std::string::npos) << got.err;
        EXPECT_EQ(got.out, "");
    }
}

TEST(Command, AnOptionWithoutACommandIsTold) {
    MemoryDisk disk;
    const CommandRun got = run(disk, {"--nope"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_TRUE(got.err.starts_with("porttool: no command given beside --nope\n")) << got.err;
}

TEST(Command, AcceptTakesIdsOrAll) {
    MemoryDisk disk;
    EXPECT_EQ(run(disk, {"accept", "--all", "s/a.cu:f"}).err,
              "porttool: accept takes ids or --all, not both: leave out --all to accept s/a.cu:f alone\n");
    EXPECT_EQ(run(disk, {"accept"}).err,
              "porttool: accept needs ids, or --all for every pair whose two edits are equivalent\n");
}

TEST(Command, EveryReferenceIsTakenWithoutAWord) {
    const std::string pair = "[[pair]]\nsource = \"src/k.cu:f\"\ntarget = \"port/k.comp:f\"\n";
    const std::string sides = "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n";
    const std::string text = "int f(int a) { return a * 3; }\n";
    for (const std::string line :
         {"", "reference = \"source\"\n", "reference = \"target\"\n", "reference = \"both\"\n"}) {
        MemoryDisk disk;
        disk.files = {{"/r/portmap.toml", sides + line + pair}, {"/r/src/k.cu", text}, {"/r/port/k.comp", text}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init"}).err, "");
        for (const auto& arguments : std::vector<std::vector<std::string>>{{"map"},
                                                                           {"check"},
                                                                           {"explain", "src/k.cu:f", "port/k.comp:f"},
                                                                           {"report"},
                                                                           {"compare", "src/k.cu", "port/k.comp"},
                                                                           {"accept", "src/k.cu:f"}}) {
            std::vector<std::string> all = {"-C", "/r"};
            all.insert(all.end(), arguments.begin(), arguments.end());
            const CommandRun got = run(disk, all);
            EXPECT_EQ(got.exit_code, 0) << arguments[0] << got.err;
            EXPECT_EQ(got.err, "") << arguments[0];
        }
    }
    MemoryDisk disk;
    disk.files = {{"/r/portmap.toml", sides + "reference = \"cpu\"\n"}, {"/r/src/k.cu", text}};
    EXPECT_NE(run(disk, {"-C", "/r", "check"}).err.find("\"source\", \"target\" or \"both\""), std::string::npos);
}

TEST(Command, HelpAndVersionAreExitCodeZero) {
    MemoryDisk disk;
    for (const auto& arguments :
         std::vector<std::vector<std::string>>{{"--help"}, {"--version"}, {"scan", "--help"}, {"map", "--help"}}) {
        const CommandRun got = run(disk, arguments);
        EXPECT_EQ(got.exit_code, 0);
        EXPECT_FALSE(got.out.empty());
        EXPECT_EQ(got.err, "");
    }
}

TEST(Command, OutputGoesToTheFile) {
    MemoryDisk disk;
    disk.files = {{"/r/a.cl", "void f() {}\n"}};
    const CommandRun got = run(disk, {"-C", "/r", "scan", "a.cl", "-o", "/r/out.txt"});
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_EQ(got.out, "");
    EXPECT_NE(disk.files["/r/out.txt"].find("a.cl:f"), std::string::npos);
}

}  // namespace
}  // namespace porttool::testing::command_test
