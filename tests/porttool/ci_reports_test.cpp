// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The formats for CI: what their specifications require is there.
#include <gtest/gtest.h>

#include <set>

#include "tests/porttool/run_command.h"

namespace porttool::testing::ci_reports_test {
namespace {

MemoryDisk drifted() {
    MemoryDisk disk = started(
        "__device__ float f(float a) { float b = a * 2.0f; return b; }\n__device__ float g(float a) { return a - 1.5f; "
        "}\n",
        "float f(float a) { float b = a * 2.0; return b; }\nfloat g(float a) { return a - 1.5; }\n");
    disk.files["/r/src/k.cu"] =
        "__device__ float f(float a) { float b = a * 2.0f; if (b < 1.0f && a > 0.0f) b = 1.0f; return b; }\n__device__ "
        "float g(float a) { return a - 2.5f; }\n";
    run(disk, {"-C", "/r", "ignore", "src/k.cu:g", "--reason", "measured"});
    return disk;
}

std::string report(const std::string& format) {
    MemoryDisk disk = drifted();
    const CommandRun got = run(disk, {"-C", "/r", "check", "--format", format});
    EXPECT_EQ(got.exit_code, 1);
    return got.out;
}

TEST(CiReports, SarifHasTheRequiredProperties) {
    const auto json = nlohmann::json::parse(report("sarif"));
    EXPECT_EQ(json["version"], "2.1.0");
    ASSERT_EQ(json["runs"].size(), 1u);
    const auto& one = json["runs"][0];
    EXPECT_EQ(one["tool"]["driver"]["name"], "porttool");
    ASSERT_EQ(one["results"].size(), 2u);
    for (const auto& result : one["results"]) {
        EXPECT_FALSE(result["message"]["text"].get<std::string>().empty());
        const auto index = result["ruleIndex"].get<size_t>();
        EXPECT_EQ(one["tool"]["driver"]["rules"][index]["id"], result["ruleId"]);
        const auto& location = result["locations"][0]["physicalLocation"];
        EXPECT_EQ(location["artifactLocation"]["uri"], "src/k.cu");
        EXPECT_EQ(location["artifactLocation"]["uriBaseId"], "%SRCROOT%");
        EXPECT_GE(location["region"]["startLine"].get<int>(), 1);
        EXPECT_EQ(result["relatedLocations"][0]["physicalLocation"]["artifactLocation"]["uri"], "port/k.comp");
        EXPECT_EQ(result["partialFingerprints"].size(), 1u);
    }
    EXPECT_FALSE(one["results"][0].contains("suppressions"));
    EXPECT_EQ(one["results"][1]["suppressions"][0]["justification"], "measured");
}

using nlohmann::json;

TEST(CiReports, SarifTellsCommentsFromTheLedgerAndPointsIntoTheMap) {
    MemoryDisk disk = drifted();
    disk.files["/r/src/k.cu"] = "// porttool: ignore(source-changed) by design\n" + disk.files["/r/src/k.cu"];
    disk.files["/r/portmap.toml"] += "\n[[pair]]\nsource = \"src/k.cu:no such\"\ntarget = \"port/k.comp:nor this\"\n";
    const json log = json::parse(run(disk, {"-C", "/r", "check", "--format", "sarif"}).out);
    const json& results = log["runs"][0]["results"];
    std::set<std::string> kinds;
    bool in_map = false;
    for (const json& result : results) {
        for (const json& suppression : result.value("suppressions", json::array())) kinds.insert(suppression["kind"]);
        const json& place = result["locations"][0]["physicalLocation"];
        if (place["artifactLocation"]["uri"] != "portmap.toml") continue;
        in_map = true;
        const std::string& map = disk.files["/r/portmap.toml"];
        const auto before = std::count(map.begin(), map.begin() + static_cast<long>(map.find("no such")), '\n');
        EXPECT_LE(std::abs(place["region"]["startLine"].get<long>() - before), 1) << "the line of the pair";
    }
    EXPECT_EQ(kinds, (std::set<std::string>{"external", "inSource"}));
    EXPECT_TRUE(in_map);
}

TEST(CiReports, JunitCountsAndEscapes) {
    const std::string xml = report("junit");
    EXPECT_NE(xml.find("tests=\"1\" failures=\"1\""), std::string::npos) << xml;
    EXPECT_NE(xml.find("b &lt; 1f &amp;&amp;"), std::string::npos) << xml;
}

TEST(CiReports, GithubAnnotatesOneLineEach) {
    const std::string text = report("github");
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
    EXPECT_TRUE(text.starts_with("::error file=src/k.cu,line=1,endLine=1,title=porttool source-changed::")) << text;
}

TEST(CiReports, GitlabHasItsFields) {
    const auto issues = json::parse(report("gitlab"));
    ASSERT_EQ(issues.size(), 1u);
    EXPECT_EQ(issues[0]["severity"], "major");
    EXPECT_EQ(issues[0]["location"]["path"], "src/k.cu");
    EXPECT_EQ(issues[0]["location"]["lines"]["begin"], 1);
    EXPECT_FALSE(issues[0]["fingerprint"].get<std::string>().empty());
}

TEST(CiReports, MarkdownIsATable) {
    const std::string text = report("markdown");
    EXPECT_NE(text.find("### porttool: drift"), std::string::npos);
    EXPECT_NE(text.find("| error | src/k.cu:1 | port/k.comp:1 |"), std::string::npos) << text;
}

}  // namespace
}  // namespace porttool::testing::ci_reports_test
