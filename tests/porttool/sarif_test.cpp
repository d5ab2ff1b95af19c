// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// check --format sarif against the OASIS schema, where npm brought it, and against the members that the specification
// requires. Both oracles must also refuse broken documents.
#include <sys/wait.h>

#include <cstdlib>
#include <set>

#include "porttool/read/map_file.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::sarif_test {
namespace {

using nlohmann::json;

const char* kSource =
    "__device__ float f(float a) { float b = a * 2.0f; return b; }\n"
    "__device__ float g(float a) { return a - 1.5f; }\n"
    "__device__ float h(float a) { return a + 3.5f; }\n";
const char* kTarget =
    "float f(float a) { float b = a * 2.0; return b; }\n"
    "float g(float a) { return a - 1.5; }\n"
    "float h(float a) { return a + 3.5; }\n";

json sarif(MemoryDisk& disk) { return json::parse(run(disk, {"-C", "/r", "check", "--format", "sarif"}).out); }

/// Findings of many kinds: open, deferred, ignored in the ledger and in the source, in the map, in odd files.
std::vector<json> documents() {
    std::vector<json> out;
    MemoryDisk disk = started(kSource, kTarget);
    out.push_back(sarif(disk));
    disk.files["/r/src/k.cu"] =
        replaced(replaced(replaced(kSource, "2.0f", "2.5f"), "- 1.5f", "- 2.5f"), "3.5f", "powf(a, 2.0f)") +
        "int fresh(int a) { return a; }\n";
    run(disk, {"-C", "/r", "ignore", "src/k.cu:g", "--reason", "measured"});
    run(disk, {"-C", "/r", "defer", "src/k.cu:h", "--owner", "me", "--until", "2999-01-01", "--reason", "later"});
    out.push_back(sarif(disk));
    disk.files["/r/src/k.cu"] = "// porttool: ignore(source-changed) by design\n" + disk.files["/r/src/k.cu"];
    disk.files["/r/portmap.toml"] +=
        "\n[[pair]]\nsource = \"src/k.cu:no such\"\ntarget = \"port/k.comp:nor this\"\n"
        "[[ignore]]\nid = \"src/gone.cu:*\"\nreason = \"left\"\n";
    disk.files["/r/src/an odd n\xC3\xA4me#1.cu"] = "int odd(int a) { return a + 9; }\n";
    disk.files["/r/src/binary.cu"] = std::string("a\0b", 3);
    out.push_back(sarif(disk));
    return out;
}

/// The same document, broken in one place each.
std::vector<std::pair<std::string, json>> broken_documents() {
    const json whole = documents().back();
    std::vector<std::pair<std::string, json>> out;
    auto add = [&](const std::string& name, const std::function<void(json&)>& edit) {
        json copy = whole;
        edit(copy);
        out.emplace_back(name, std::move(copy));
    };
    add("another version", [](json& log) { log["version"] = "2.0.0"; });
    add("no runs", [](json& log) { log.erase("runs"); });
    add("no tool", [](json& log) { log["runs"][0].erase("tool"); });
    add("a driver without a name", [](json& log) { log["runs"][0]["tool"]["driver"].erase("name"); });
    add("a result without a message", [](json& log) { log["runs"][0]["results"][0].erase("message"); });
    add("an unknown level", [](json& log) { log["runs"][0]["results"][0]["level"] = "fatal"; });
    add("line 0",
        [](json& log) { log["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["region"]["startLine"] = 0; });
    add("a rule without an id", [](json& log) { log["runs"][0]["tool"]["driver"]["rules"][0].erase("id"); });
    add("a suppression of no kind", [](json& log) {
        for (json& result : log["runs"][0]["results"])
            if (result.contains("suppressions")) result["suppressions"][0].erase("kind");
    });
    add("a fingerprint that is a number",
        [](json& log) { log["runs"][0]["results"][0]["partialFingerprints"]["porttool/v1"] = 7; });
    return out;
}

/// What the specification requires of the objects that porttool writes (sections 3.11 to 3.49), and what porttool
/// promises beyond; one sentence for each thing that is wrong.
class SarifReader {
public:
    std::vector<std::string> problems;

    void read(const json& log) {
        try {
            need(log.at("version") == "2.1.0", "version");
            need(!log.at("runs").empty(), "runs");
            for (const json& one : log.at("runs")) read_run(one);
        } catch (const json::exception& error) {
            problems.push_back(error.what());
        }
    }

private:
    void need(bool holds, const std::string& what) {
        if (!holds) problems.push_back(what);
    }
    bool is_one_of(const json& value, const std::set<std::string>& known) {
        return value.is_string() && known.contains(value.get<std::string>());
    }
    void read_message(const json& message) { need(!message.at("text").get<std::string>().empty(), "message"); }

    void read_run(const json& one) {
        const json& driver = one.at("tool").at("driver");
        need(!driver.at("name").get<std::string>().empty(), "driver name");
        std::set<std::string> ids;
        for (const json& rule : driver.at("rules")) {
            need(ids.insert(rule.at("id")).second, "two entries for one rule");
            read_message(rule.at("shortDescription"));
            read_message(rule.at("help"));
            need(is_one_of(rule.at("defaultConfiguration").at("level"), {"none", "note", "warning", "error"}), "level");
        }
        need(is_one_of(one.at("columnKind"), {"utf16CodeUnits", "unicodeCodePoints"}), "columnKind");
        for (const json& result : one.at("results"))
            read_result(result, driver.at("rules"), one.at("originalUriBaseIds"));
    }

    void read_result(const json& result, const json& rules, const json& bases) {
        read_message(result.at("message"));
        need(is_one_of(result.at("level"), {"none", "note", "warning", "error"}), "level of a result");
        need(rules.at(result.at("ruleIndex").get<size_t>()).at("id") == result.at("ruleId"), "ruleIndex");
        need(!result.at("locations").empty(), "locations");
        for (const char* list : {"locations", "relatedLocations"})
            for (const json& location : result.value(list, json::array())) read_location(location, bases);
        need(!result.at("partialFingerprints").empty(), "partialFingerprints");
        for (const auto& [key, value] : result.at("partialFingerprints").items()) need(value.is_string(), key);
        for (const json& suppression : result.value("suppressions", json::array())) {
            need(is_one_of(suppression.at("kind"), {"inSource", "external"}), "kind of a suppression");
            need(is_one_of(suppression.at("status"), {"accepted", "underReview", "rejected"}), "status");
        }
        for (const json& fix : result.value("fixes", json::array())) read_fix(fix, bases);
    }

    void read_fix(const json& fix, const json& bases) {
        read_message(fix.at("description"));
        need(!fix.at("artifactChanges").empty(), "artifactChanges");
        for (const json& change : fix.at("artifactChanges")) {
            need(bases.contains(change.at("artifactLocation").at("uriBaseId").get<std::string>()),
                 "uriBaseId of a fix");
            need(!change.at("replacements").empty(), "replacements");
            for (const json& one : change.at("replacements")) {
                const json& region = one.at("deletedRegion");
                need(region.at("startLine") >= 1 && region.at("endLine") >= region.at("startLine"), "lines of a fix");
                need(region.at("startColumn") == 1 && region.at("endColumn") == 1, "columns of a fix");
                need(region.at("endLine") > region.at("startLine") || one.contains("insertedContent"),
                     "a fix of nothing");
            }
        }
    }

    void read_location(const json& location, const json& bases) {
        const json& artifact = location.at("physicalLocation").at("artifactLocation");
        const std::string uri = artifact.at("uri");
        need(!uri.empty() && uri[0] != '/' && uri.find("://") == std::string::npos, "a relative URI: " + uri);
        for (const char c : uri)
            need(c > ' ' && c < 0x7F && !std::strchr("\\\"<>#?", c), "characters of a URI: " + uri);
        need(bases.contains(artifact.at("uriBaseId").get<std::string>()), "uriBaseId");
        const json& region = location.at("physicalLocation").at("region");
        need(region.at("startLine").get<int>() >= 1, "startLine");
        need(region.at("endLine").get<int>() >= region.at("startLine").get<int>(), "endLine");
    }
};

std::vector<std::string> problems_of(const json& log) {
    SarifReader reader;
    reader.read(log);
    return reader.problems;
}

TEST(Sarif, MeetsWhatTheSpecificationRequires) {
    for (const json& log : documents()) EXPECT_EQ(problems_of(log), std::vector<std::string>()) << log.dump(1);
    for (const auto& [name, log] : broken_documents()) EXPECT_FALSE(problems_of(log).empty()) << name;
}

TEST(Sarif, MeetsTheSchemaOfOasis) {
    const std::filesystem::path here = std::filesystem::path(REPOSITORY) / "tests/porttool";
    const auto schema = here / "node_modules/@microsoft/jest-sarif/lib/schemas/sarif-2.1.0-rtm.5.json";
    if (!std::filesystem::exists(schema)) GTEST_SKIP() << "the schema is not there; ./setup.sh gets it from npm";
    if (std::system("python3 -c 'import jsonschema' 2> /dev/null") != 0)
        GTEST_SKIP() << "python3-jsonschema is not there; ./setup.sh installs it";
    const auto folder = std::filesystem::temp_directory_path() / "porttool_sarif_test";
    std::filesystem::create_directories(folder);
    std::string command = "python3 -W ignore '" + (here / "validate_json.py").string() + "' '" + schema.string() + "'";
    const auto whole = documents();
    const auto broken = broken_documents();
    std::set<std::string> must_fail;
    auto add = [&](const std::string& name, const json& log) {
        const auto file = folder / name;
        std::ofstream(file) << log.dump();
        command += " '" + file.string() + "'";
    };
    for (size_t i = 0; i < whole.size(); ++i) add("whole" + std::to_string(i), whole[i]);
    for (size_t i = 0; i < broken.size(); ++i) {
        add("broken" + std::to_string(i), broken[i].second);
        must_fail.insert("broken" + std::to_string(i));
    }
    const int status = std::system((command + " > '" + (folder / "reasons").string() + "'").c_str());
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_EQ(WEXITSTATUS(status), 1) << "the broken ones are refused";
    std::set<std::string> failed;
    std::istringstream reasons(read_text(folder / "reasons"));
    for (std::string line; std::getline(reasons, line);)
        failed.insert(std::filesystem::path(line.substr(0, line.find(": "))).filename());
    EXPECT_EQ(failed, must_fail) << reasons.str();
    std::filesystem::remove_all(folder);
}

TEST(Sarif, ListsEveryRuleWithHelpAlsoThoseNotFound) {
    for (const json& log : documents()) {
        std::set<std::string> ids;
        for (const json& rule : log["runs"][0]["tool"]["driver"]["rules"]) {
            ids.insert(rule["id"]);
            EXPECT_GT(rule["help"]["text"].get<std::string>().size(), 20u);
        }
        EXPECT_EQ(ids, std::set<std::string>(kRuleNames.begin(), kRuleNames.end()));
    }
}

TEST(Sarif, FingerprintsDoNotFollowLines) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(kSource, "2.0f", "2.5f");
    const json before = sarif(disk)["runs"][0]["results"];
    disk.files["/r/src/k.cu"] = "// further\n\n// down\n" + disk.files["/r/src/k.cu"];
    const json after = sarif(disk)["runs"][0]["results"];
    ASSERT_EQ(before.size(), 1u);
    EXPECT_EQ(before[0]["partialFingerprints"], after[0]["partialFingerprints"]);
    EXPECT_NE(before[0]["locations"], after[0]["locations"]);
}

/// A text with the replacements of whole lines made, the last first.
std::string fixed(const std::string& text, const json& replacements) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line + "\n");
    for (auto one = replacements.rbegin(); one != replacements.rend(); ++one) {
        const auto first = lines.begin() + ((*one)["deletedRegion"]["startLine"].get<int>() - 1);
        const auto end = lines.begin() + ((*one)["deletedRegion"]["endLine"].get<int>() - 1);
        const auto place = lines.erase(first, end);
        if (one->contains("insertedContent")) lines.insert(place, (*one)["insertedContent"]["text"].get<std::string>());
    }
    std::string out;
    for (const std::string& line : lines) out += line;
    return out;
}

TEST(Sarif, AFixIsThePortThatSyncWrites) {
    const std::string source = replaced(kSource, "{ float b = a * 2.0f; return b; }",
                                        "{\n    float b = a * 2.0f;\n    float c = b;\n    return c;\n}");
    const std::string target = replaced(kTarget, "{ float b = a * 2.0; return b; }",
                                        "{\n    float b = a * 2.0;\n    float c = b;\n    return c;\n}");
    const std::vector<std::pair<std::string, std::string>> edits = {
        {"2.0f", "2.5f"},
        {"    float c = b;\n", "    float c = b;\n    c = c * 3.0f;\n    b = c;\n"},
        {"b = a * 2.0f;\n    float c = b;\n", "c = a * 2.0f;\n"},
        {"3.5f", "4.5f"}};
    for (const auto& [from, to] : edits) {
        MemoryDisk disk = started(source, target);
        disk.files["/r/src/k.cu"] = replaced(source, from, to);
        const json log = sarif(disk);
        EXPECT_EQ(problems_of(log), std::vector<std::string>()) << log.dump(1);
        const json result = log["runs"][0]["results"][0];
        if (!result.contains("fixes")) {
            EXPECT_EQ(run(disk, {"-C", "/r", "sync", "-q"}).exit_code, 1) << from;
            continue;
        }
        const json change = result["fixes"][0]["artifactChanges"][0];
        EXPECT_EQ(change["artifactLocation"]["uri"], "port/k.comp");
        const std::string ported = fixed(target, change["replacements"]);
        EXPECT_EQ(run(disk, {"-C", "/r", "sync", "--apply", "--force"}).exit_code, 0);
        EXPECT_EQ(disk.files["/r/port/k.comp"], ported) << from;
        EXPECT_NE(ported, target);
    }
}

TEST(Sarif, NoFixForWhatIsSettledOrLeft) {
    MemoryDisk disk = started(kSource, kTarget);
    disk.files["/r/src/k.cu"] = replaced(replaced(kSource, "2.0f", "2.5f"), "a - 1.5f", "noise_table[a]");
    run(disk, {"-C", "/r", "ignore", "src/k.cu:f", "--reason", "measured"});
    const json log = sarif(disk);
    for (const json& result : log["runs"][0]["results"]) EXPECT_FALSE(result.contains("fixes")) << result.dump(1);
}

}  // namespace
}  // namespace porttool::testing::sarif_test
