// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The formats for CI: what their specifications require is there.
#include <gtest/gtest.h>

#include <set>

#include "tests/porttool/run_command.h"

namespace porttool::testing {
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

/// What SARIF 2.1.0 demands of a message (3.11), and of the places that porttool writes (3.28 to 3.30).
void expect_message(const json& message) {
    ASSERT_TRUE(message.is_object());
    EXPECT_TRUE(message.contains("text") || message.contains("id"));
    EXPECT_FALSE(message.value("text", std::string("-")).empty());
}

void expect_location(const json& location, const json& base_ids) {
    const json& artifact = location.at("physicalLocation").at("artifactLocation");
    const std::string uri = artifact.at("uri");
    EXPECT_FALSE(uri.empty() || uri[0] == '/' || uri.find("://") != std::string::npos) << uri;
    EXPECT_EQ(uri.find_first_of(" \\\"<>"), std::string::npos) << uri;
    EXPECT_TRUE(base_ids.contains(artifact.at("uriBaseId").get<std::string>()));
    const json& region = location.at("physicalLocation").at("region");
    EXPECT_GE(region.at("startLine").get<int>(), 1);
    EXPECT_GE(region.at("endLine").get<int>(), region.at("startLine").get<int>());
    EXPECT_GE(location.value("id", 0), 0);
    if (location.contains("message")) expect_message(location.at("message"));
}

/// The members that the specification requires (3.13, 3.14, 3.18, 3.19, 3.27, 3.35, 3.49), with their values' sets.
void expect_sarif(const json& log) {
    EXPECT_EQ(log.at("version"), "2.1.0");
    ASSERT_TRUE(log.at("runs").is_array());
    for (const json& one : log.at("runs")) {
        const json& driver = one.at("tool").at("driver");
        EXPECT_FALSE(driver.at("name").get<std::string>().empty());
        std::set<std::string> ids;
        for (const json& rule : driver.at("rules")) {
            EXPECT_TRUE(ids.insert(rule.at("id")).second) << "two entries for one rule";
            expect_message(rule.at("shortDescription"));
            expect_message(rule.at("help"));
        }
        const std::set<std::string> kinds = {"utf16CodeUnits", "unicodeCodePoints"};
        EXPECT_TRUE(kinds.contains(one.at("columnKind")));
        for (const json& result : one.at("results")) {
            expect_message(result.at("message"));
            const std::set<std::string> levels = {"none", "note", "warning", "error"};
            EXPECT_TRUE(levels.contains(result.at("level")));
            EXPECT_EQ(driver.at("rules").at(result.at("ruleIndex").get<size_t>()).at("id"), result.at("ruleId"));
            for (const json& location : result.at("locations")) expect_location(location, one.at("originalUriBaseIds"));
            for (const json& location : result.value("relatedLocations", json::array()))
                expect_location(location, one.at("originalUriBaseIds"));
            for (const auto& [key, value] : result.at("partialFingerprints").items()) EXPECT_TRUE(value.is_string());
            for (const json& suppression : result.value("suppressions", json::array())) {
                const std::set<std::string> places = {"inSource", "external"};
                EXPECT_TRUE(places.contains(suppression.at("kind")));
                const std::set<std::string> states = {"accepted", "underReview", "rejected"};
                EXPECT_TRUE(states.contains(suppression.at("status")));
            }
        }
    }
}

TEST(CiReports, SarifMeetsTheSpecificationWhateverIsFound) {
    expect_sarif(json::parse(report("sarif")));
    MemoryDisk clean = started("int f(int a) { return a * 3; }\n", "int f(int a) { return a * 3; }\n");
    expect_sarif(json::parse(run(clean, {"-C", "/r", "check", "--format", "sarif"}).out));
}

TEST(CiReports, SarifTellsCommentsFromTheLedgerAndPointsIntoTheMap) {
    MemoryDisk disk = drifted();
    disk.files["/r/src/k.cu"] = "// porttool: ignore(source-changed) by design\n" + disk.files["/r/src/k.cu"];
    disk.files["/r/portmap.toml"] += "\n[[pair]]\nsource = \"src/k.cu:no such\"\ntarget = \"port/k.comp:nor this\"\n";
    const json log = json::parse(run(disk, {"-C", "/r", "check", "--format", "sarif"}).out);
    expect_sarif(log);
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
}  // namespace porttool::testing
