// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// One source with several ports: each is held against the source for itself.
#include <gtest/gtest.h>

#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::target_sets_test {
namespace {

using nlohmann::json;

CommandRun porttool_with_ports(Disk& disk, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"-C", "/r"});
    return run(disk, arguments);
}

const std::string kSquares =
    "__device__ float squares(float a, float b) {\n    float x = a * a;\n    float y = b * b;\n    return x + y * "
    "2.0f;\n}\n";
const std::string kTwist =
    "__device__ unsigned twist(unsigned seed) {\n    seed ^= seed >> 16;\n    seed *= 0x7feb352du;\n    return seed ^ "
    "(seed >> 15);\n}\n";

std::string port_of(const std::string& text) {
    std::string out = text;
    for (size_t at = out.find("__device__ "); at != std::string::npos; at = out.find("__device__ ")) out.erase(at, 11);
    return out;
}

/// Two identical ports in two folders.
MemoryDisk two_ports(const std::string& source = kSquares, const std::string& cpu = port_of(kSquares),
                     const std::string& sycl = port_of(kSquares)) {
    MemoryDisk disk;
    disk.files = {{"/r/cuda/k.cu", source}, {"/r/cpu/k.cpp", cpu}, {"/r/sycl/k.cpp", sycl}};
    const CommandRun got =
        run(disk, {"-C", "/r", "init", "--source", "cuda/*", "--target", "sycl=sycl/*", "--target", "cpu=cpu/*"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    return disk;
}

/// "rule set level", one a finding.
std::vector<std::string> told(const json& report) {
    std::vector<std::string> out;
    for (const auto& finding : report["findings"])
        out.push_back(finding["rule"].get<std::string>() + " " +
                      (finding["target_set"].is_null() ? "-" : finding["target_set"].get<std::string>()) + " " +
                      finding["level"].get<std::string>());
    return out;
}

using Told = std::vector<std::string>;

TEST(TargetSets, TheMapNamesThem) {
    MemoryDisk disk = two_ports();
    EXPECT_NE(disk.files["/r/portmap.toml"].find("[sides.targets]\ncpu = [\"cpu/*\"]\nsycl = [\"sycl/*\"]\n"),
              std::string::npos)
        << disk.files["/r/portmap.toml"];
    const json report = check(disk);
    EXPECT_EQ(report["summary"]["pairs"], 2);
    EXPECT_EQ(report["summary"]["units"], 1);
    EXPECT_TRUE(report["findings"].empty());
}

TEST(TargetSets, AStaleSecondPortIsAnError) {
    for (const std::string stale : {"cpu", "sycl"}) {
        MemoryDisk disk = two_ports();
        const std::string fresh = stale == "cpu" ? "sycl" : "cpu";
        disk.files["/r/cuda/k.cu"] = replaced(kSquares, "2.0f", "3.0f");
        disk.files["/r/" + fresh + "/k.cpp"] = replaced(port_of(kSquares), "2.0f", "3.0f");
        const CommandRun got = porttool_with_ports(disk, {"check", "--format", "json"});
        EXPECT_EQ(got.exit_code, 1);
        const json report = json::parse(got.out);
        EXPECT_EQ(told(report), Told{"source-changed " + stale + " error"});
        EXPECT_EQ(report["findings"][0]["target"]["file"], stale + "/k.cpp");
        EXPECT_EQ(report["summary"]["in_step"], 1);
        EXPECT_EQ(report["summary"]["drifted"], 1);
    }
}

TEST(TargetSets, ANewUnitIsLookedForInEach) {
    MemoryDisk disk = two_ports();
    disk.files["/r/cuda/k.cu"] += kTwist;
    EXPECT_EQ(told(check(disk)), (Told{"unported cpu error", "unported sycl error"}));
    const json both = check(disk);
    EXPECT_NE(both["findings"][0]["fingerprint"], both["findings"][1]["fingerprint"]);
    EXPECT_EQ(both["summary"]["unpaired"], 1) << "a unit counts once";
    disk.files["/r/cpu/k.cpp"] += port_of(kTwist);
    const Told half = told(check(disk));
    EXPECT_EQ(half, (Told{"unpaired cpu error", "unported sycl error"}));
    EXPECT_EQ(porttool_with_ports(disk, {"accept", "cuda/k.cu:twist=cpu/k.cpp:twist"}).exit_code, 0);
    EXPECT_EQ(told(check(disk)), Told{"unported sycl error"}) << "one port more is not all";
    disk.files["/r/sycl/k.cpp"] += port_of(kTwist);
    EXPECT_EQ(told(check(disk)), Told{"unpaired sycl error"});
    EXPECT_EQ(porttool_with_ports(disk, {"accept", "cuda/k.cu:twist=sycl/k.cpp:twist"}).exit_code, 0);
    EXPECT_TRUE(told(check(disk)).empty());
    EXPECT_EQ(check(disk)["summary"]["pairs"], 4);
}

TEST(TargetSets, TheBaselineIsOfEachPort) {
    MemoryDisk disk = two_ports(kSquares + kTwist, port_of(kSquares + kTwist), port_of(kSquares));
    EXPECT_TRUE(told(check(disk)).empty());
    EXPECT_EQ(check(disk)["summary"]["pairs"], 3);
    EXPECT_EQ(check(disk)["summary"]["unpaired"], 1);
    EXPECT_NE(disk.files["/r/portmap.lock"].find("targets=sycl"), std::string::npos);
    // a pair that is taken out of the map leaves a unit that the other port's baseline does not excuse
    std::string& map = disk.files["/r/portmap.toml"];
    const size_t pair = map.find("source = \"cuda/k.cu:twist\"");
    const size_t first = map.rfind("[[pair]]", pair), end = map.find("[[pair]]", pair);
    map.erase(first, end == std::string::npos ? std::string::npos : end - first);
    EXPECT_EQ(told(check(disk)), Told{"unpaired cpu error"});
    // and ignoring it does not leave two lines for one unit
    EXPECT_EQ(porttool_with_ports(disk, {"ignore", "cuda/k.cu:twist", "--reason", "host"}).exit_code, 0);
    const CommandRun got = porttool_with_ports(disk, {"check"});
    EXPECT_EQ(got.exit_code, 0) << got.err << got.out;
}

TEST(TargetSets, TheReportHasUnitsByPort) {
    MemoryDisk disk = two_ports(kSquares + kTwist, port_of(kSquares + kTwist), port_of(kSquares));
    disk.files["/r/cuda/k.cu"] = replaced(kSquares, "float x = a * a", "float x = a * a * a") + kTwist;
    disk.files["/r/cuda/k.cu"] = replaced(disk.files["/r/cuda/k.cu"], "2.0f", "3.0f");
    disk.files["/r/cpu/k.cpp"] = port_of(disk.files["/r/cuda/k.cu"]);
    const json matrix = json::parse(porttool_with_ports(disk, {"report", "--format", "json"}).out)["matrix"];
    EXPECT_EQ(matrix["targets"], (json{"cpu", "sycl"}));
    std::map<std::string, std::string> cells;
    for (const auto& unit : matrix["units"])
        for (size_t i = 0; i < 2; ++i)
            cells[unit["source"].get<std::string>().substr(10) + " " + matrix["targets"][i].get<std::string>()] =
                unit["cells"][i]["state"].get<std::string>() + " " +
                std::to_string(unit["cells"][i]["edits"].get<int>());
    const std::map<std::string, std::string> expected = {
        {"squares cpu", "twin 0"}, {"squares sycl", "behind 2"}, {"twist cpu", "twin 0"}, {"twist sycl", "absent 0"}};
    EXPECT_EQ(cells, expected);
    EXPECT_NE(porttool_with_ports(disk, {"report"}).out.find("cuda/k.cu:squares  twin  behind by 2 edits\n"),
              std::string::npos)
        << porttool_with_ports(disk, {"report"}).out;
    EXPECT_NE(
        porttool_with_ports(disk, {"report", "--format", "markdown"}).out.find("| `cuda/k.cu:twist` | twin | absent |"),
        std::string::npos);
    EXPECT_EQ(json::parse(porttool_with_ports(disk, {"map", "--format", "json"}).out)["pairs"].size(), 3u);
}

TEST(TargetSets, OneWithoutNamesIsAsBefore) {
    MemoryDisk disk = started(kSquares, port_of(kSquares));
    disk.files["/r/src/k.cu"] += kTwist;
    EXPECT_EQ(told(check(disk)), Told{"unported - error"});
    EXPECT_TRUE(json::parse(porttool_with_ports(disk, {"report", "--format", "json"}).out)["matrix"].is_null());
}

TEST(TargetSets, AMapThatNamesItsSidesAloneGetsItsPairsFromInit) {
    MemoryDisk disk;
    disk.files = {
        {"/r/cuda/k.cu", kSquares},
        {"/r/cpu/k.cpp", port_of(kSquares)},
        {"/r/sycl/k.cpp", port_of(kSquares)},
        {"/r/portmap.toml",
         "version = 1\n[sides]\nsource = [\"cuda/*\"]\n[sides.targets]\ncpu = [\"cpu/*\"]\nsycl = [\"sycl/*\"]\n"}};
    EXPECT_EQ(porttool_with_ports(disk, {"init"}).exit_code, 0);
    EXPECT_EQ(check(disk)["summary"]["pairs"], 2) << disk.files["/r/portmap.toml"];
    disk.files["/r/cuda/k.cu"] = replaced(kSquares, "2.0f", "3.0f");
    disk.files["/r/cpu/k.cpp"] = replaced(port_of(kSquares), "2.0f", "3.0f");
    EXPECT_EQ(told(check(disk)), Told{"source-changed sycl error"});
}

TEST(TargetSets, ACopyInAnotherFolderIsWatchedWithoutNamesToo) {
    MemoryDisk disk;
    disk.files = {{"/r/cuda/k.cu", kSquares}, {"/r/cpu/k.cpp", port_of(kSquares)}, {"/r/old/k.cpp", port_of(kSquares)}};
    run(disk, {"-C", "/r", "init", "--source", "cuda/*", "--target", "cpu/*", "old/*"});
    EXPECT_EQ(check(disk)["summary"]["pairs"], 2);
    disk.files["/r/cuda/k.cu"] = replaced(kSquares, "2.0f", "3.0f");
    disk.files["/r/cpu/k.cpp"] = replaced(port_of(kSquares), "2.0f", "3.0f");
    EXPECT_EQ(told(check(disk)), Told{"source-changed - error"});
    EXPECT_EQ(check(disk)["findings"][0]["target"]["file"], "old/k.cpp");
    // where two sources have the name, the second port may be that of the second source
    MemoryDisk two;
    two.files = {{"/r/cuda/k.cu", kSquares},
                 {"/r/cuda/l.cu", "__device__ float squares(float q) { return q; }\n"},
                 {"/r/cpu/k.cpp", port_of(kSquares)},
                 {"/r/old/k.cpp", port_of(kSquares)}};
    run(two, {"-C", "/r", "init", "--source", "cuda/k.cu", "cuda/l.cu", "--target", "cpu/*", "old/*"});
    const json mapped = json::parse(porttool_with_ports(two, {"map", "--format", "json"}).out);
    for (const auto& pair : mapped["pairs"])
        EXPECT_FALSE(pair["source"] == "cuda/k.cu:squares" && pair["target"] == "old/k.cpp:squares");
}

/// A solver's steps, each with a body of its own.
std::string steps(const std::string& before) {
    return before + "void scale_field(float* u, int n) { for (int i = 0; i < n; ++i) u[i] = 2.0f * u[i]; }\n" + before +
           "void smooth_field(float* u, int n) { for (int i = 1; i + 1 < n; ++i) u[i] = 0.5f * (u[i - 1] + u[i + 1]); "
           "}\n" +
           before +
           "float sum_field(const float* u, int n) { float s = 0; for (int i = 0; i < n; ++i) s += u[i]; return s; "
           "}\n" +
           before + "void copy_field(const float* u, float* v, int n) { for (int i = 0; i < n; ++i) v[i] = u[i]; }\n";
}

TEST(TargetSets, InitNamesThePortsOfAFlatList) {
    MemoryDisk disk;
    disk.files = {
        {"/r/cuda/k.cu", steps("__device__ ")}, {"/r/src/omp/k.cpp", steps("")}, {"/r/src/acc/k.cpp", steps("")}};
    const CommandRun got = run(disk, {"-C", "/r", "init", "--source", "cuda/*", "--target", "src/**/*.cpp"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    EXPECT_NE(got.out.find("named in [sides.targets]: acc, omp"), std::string::npos) << got.out;
    EXPECT_NE(disk.files["/r/portmap.toml"].find(
                  "[sides.targets]\nacc = [\"src/acc/**/*.cpp\"]\nomp = [\"src/omp/**/*.cpp\"]\n"),
              std::string::npos)
        << disk.files["/r/portmap.toml"];
    EXPECT_TRUE(check(disk)["findings"].empty());
    // a new unit that one of them has is asked of the other
    disk.files["/r/cuda/k.cu"] += kTwist;
    disk.files["/r/src/omp/k.cpp"] += port_of(kTwist);
    EXPECT_EQ(told(check(disk)), (Told{"unpaired omp error", "unported acc error"}));
}

TEST(TargetSets, InitLeavesAListFlatWhosePortsHaveFilesInCommon) {
    MemoryDisk disk;
    disk.files = {{"/r/cuda/k.cu", steps("__device__ ") + kTwist},
                  {"/r/src/omp/k.cpp", steps("")},
                  {"/r/src/acc/k.cpp", steps("")},
                  {"/r/src/common/twist.cpp", port_of(kTwist)}};
    const CommandRun got = run(disk, {"-C", "/r", "init", "--source", "cuda/*", "--target", "src/**"});
    EXPECT_NE(got.out.find("each is paired for itself: acc, omp"), std::string::npos) << got.out;
    EXPECT_NE(disk.files["/r/portmap.toml"].find("target = [\"src/**\"]\n"), std::string::npos);
    EXPECT_EQ(check(disk)["summary"]["pairs"], 9);
    EXPECT_TRUE(check(disk)["findings"].empty());
}

TEST(TargetSets, WhatCannotBeIsRefused) {
    for (const auto& [sides, says] : std::vector<std::pair<std::string, std::string>>{
             {"target = [\"cpu/*\"]\n[sides.targets]\ncpu = [\"cpu/*\"]\n", "exclude each other"},
             {"[sides.targets]\n", "expected NAME"},
             {"[sides.targets]\n\"a,b\" = [\"cpu/*\"]\n", "letters, digits"},
             {"[sides.targets]\ncpu = 3\n", "expected a string"}}) {
        MemoryDisk disk;
        disk.files = {{"/r/cuda/k.cu", kSquares},
                      {"/r/cpu/k.cpp", port_of(kSquares)},
                      {"/r/portmap.toml", "version = 1\n[sides]\nsource = [\"cuda/*\"]\n" + sides}};
        const CommandRun got = porttool_with_ports(disk, {"check"});
        EXPECT_EQ(got.exit_code, 2);
        EXPECT_NE(got.err.find(says), std::string::npos) << got.err;
    }
}

class TargetSetsInGit : public TemporaryRepository {};

TEST_F(TargetSetsInGit, ABaseKnowsWhichPortLackedWhat) {
    write("cuda/k.cu", kSquares + kTwist);
    write("cpu/k.cpp", port_of(kSquares + kTwist));
    write("sycl/k.cpp", port_of(kSquares));
    EXPECT_EQ(porttool({"init", "--source", "cuda/*", "--target", "cpu=cpu/*", "sycl=sycl/*"}).exit_code, 0);
    commit("first");
    const auto checked = [&] { return json::parse(porttool({"check", "--base", "HEAD", "--format", "json"}).out); };
    EXPECT_TRUE(told(checked()).empty()) << checked().dump(1);
    write("cuda/k.cu", replaced(kSquares, "2.0f", "3.0f") + kTwist);
    EXPECT_EQ(told(checked()), (Told{"source-changed cpu error", "source-changed sycl error"}));
}

}  // namespace
}  // namespace porttool::testing::target_sets_test
