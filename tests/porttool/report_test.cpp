// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// The portability report: its figures, the lines behind them, its formats, and what it refuses.
#include <cstdlib>
#include <numeric>
#include <random>
#include <set>

#include "porttool/measure/alignment.h"
#include "porttool/report/portability_page.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::report_test {
namespace {

using nlohmann::json;

// Each line of code says what it is: T twin, R rewritten, O one-sided (ignored, or in the baseline), U unmatched.
const char* kSource = R"(#pragma once
// A head that does not count.
namespace kernels {                                        // U
__device__ float shade(float a, float b, float c) {        // T
    float d = a * b + c * 0.5f - b / 3.0f;                 // T
    for (int i = 0; i < 4; ++i) d += a * float(i) - c;     // T
    return d * a + b;                                      // T
}                                                          // T
struct Walker {                                            // O
    __device__ float walk(float a) { return a * 2.0f; }    // O
    int stack[64];                                         // O
};                                                         // O
__device__ float trace(float a, float b) {                 // R
    int node = 0; float best = 1e30f;                      // R
    while (node >= 0) { best = min(best, a); node -= 1; }  // R
    return best + b;                                       // R
}                                                          // R

float forgotten(float a) { return a; }                     // O
}                                                          // U
)";
const char* kTarget = R"(#version 450
layout(local_size_x = 8) in;                               // U
float shade(float a, float b, float c) {                   // T
    float d = a * b + c * 0.5 - b / 3.0;                   // T
    for (int i = 0; i < 4; ++i) d += a * float(i) - c;     // T
    return d * a + b;                                      // T
}                                                          // T
float trace(float a, float b) {                            // R
    Query query = Query(a, b, vec3(0.0), vec3(1.0));       // R
    proceed(query); confirm(query, 1u, 2u);                // R
    return distance_of(query, 0xffu).x;                    // R
}                                                          // R
float extra(float a) { return a * a; }                     // U
)";
const char* kMap = R"(version = 1
[sides]
source = ["src/*"]
target = ["port/*"]
[[pair]]
source = "src/k.cu:kernels::shade"
target = "port/k.comp:shade"
[[pair]]
source = "src/k.cu:kernels::trace"
target = "port/k.comp:trace"
[[ignore]]
id = "src/k.cu:kernels::Walker*"
reason = "hardware walks the tree"
)";
const char* kBlocks = R"([[block]]
name = "All"
source = "src/*"
target = "port/*"
[[block]]
name = "Shade, \"core\""
source = "src/k.cu:kernels::shade"
target = "port/k.comp:shade"
)";

MemoryDisk labelled(const std::string& more = kBlocks) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kSource}, {"/r/port/k.comp", kTarget}, {"/r/portmap.toml", kMap + more}};
    disk.files["/r/portmap.lock"] = "porttool-lock\t1\n";
    run(disk, {"-C", "/r", "accept", "--all", "--force"});
    return disk;
}

CommandRun report(Disk& disk, std::vector<std::string> options) {
    options.insert(options.begin(), {"-C", "/r", "report"});
    return run(disk, options);
}

json report_json(Disk& disk, std::vector<std::string> options = {}) {
    options.insert(options.begin(), {"--format", "json"});
    const CommandRun got = report(disk, options);
    EXPECT_EQ(got.exit_code, 0) << got.err;
    return got.exit_code == 0 ? json::parse(got.out) : json();
}

size_t labels(const std::string& text, const std::string& label) {
    size_t count = 0;
    for (size_t at = text.find("// " + label + "\n"); at != std::string::npos;
         at = text.find("// " + label + "\n", at + 1))
        ++count;
    return count;
}

size_t lines_in(const json& spans) {
    size_t count = 0;
    for (const json& span : spans) count += span[1].get<size_t>() - span[0].get<size_t>() + 1;
    return count;
}

TEST(Report, EveryLineOfBothSidesIsWhatItsLabelSays) {
    MemoryDisk disk = labelled();
    const json totals = report_json(disk)["totals"];
    for (const auto& [side, text] : {std::pair("source", kSource), std::pair("target", kTarget)}) {
        const json& parts = totals["decomposition"][side];
        EXPECT_EQ(parts["twin"], labels(text, "T")) << side;
        EXPECT_EQ(parts["rewritten"], labels(text, "R")) << side;
        EXPECT_EQ(parts["one_sided"], labels(text, "O")) << side;
        EXPECT_EQ(parts["unmatched"], labels(text, "U")) << side;
        EXPECT_EQ(parts["total"], totals[side + std::string("_lines")]) << side;
        EXPECT_EQ(parts["total"], labels(text, "T") + labels(text, "R") + labels(text, "O") + labels(text, "U"));
    }
}

/// On any report: the parts make up the whole, and every figure is as large as the list of its lines.
void expect_accounted_for(const json& report) {
    json all = report["blocks"];
    all.push_back(report["totals"]);
    for (const std::string side : {"source", "target"}) {
        std::map<std::string, size_t> rows;
        for (const json& row : report["units"]) {
            if (row[side].is_null()) continue;
            EXPECT_EQ(lines_in(row[side]["code"]), row[side]["lines"]) << row["key"];
            rows[row["share"]] += row[side]["lines"].get<size_t>();
        }
        const json& parts = report["totals"]["decomposition"][side];
        size_t sum = 0;
        for (const char* part : {"twin", "rewritten", "one_sided", "unmatched"}) {
            EXPECT_EQ(rows[part], parts[part]) << side << " " << part;
            sum += parts[part].get<size_t>();
        }
        EXPECT_EQ(sum, report["totals"][side + "_lines"]) << side;
        for (const json& block : all) {
            size_t code = 0, shared = 0;
            for (const json& file : block["lines"][side]) {
                code += lines_in(file["code"]);
                shared += lines_in(file["shared"]);
            }
            EXPECT_EQ(code, block[side + "_lines"]) << block.value("name", "totals");
            // Null where nothing could be measured: then no line is shown as shared.
            EXPECT_EQ(shared, block["shared_" + side].is_null() ? 0 : block["shared_" + side].get<size_t>())
                << block.value("name", "totals");
        }
        size_t own = 0;
        for (const json& block : report["own_blocks"]) own += block[side + "_lines"].get<size_t>();
        EXPECT_EQ(own, report["totals"][side + "_lines"]) << "a line is drawn in one block";
    }
    std::map<std::string, size_t> states;
    for (const json& row : report["units"])
        if (!row["state"].is_null()) ++states[row["state"]];
    if (report["drift"]["summary"].is_null()) return;  // nothing recorded
    for (const char* state : {"in_step", "drifted", "review", "deferred", "ignored"})
        EXPECT_EQ(states[state], report["drift"]["summary"][state]) << state;
}

TEST(Report, FiguresLeadToTheirLines) {
    MemoryDisk disk = labelled();
    expect_accounted_for(report_json(disk));
}

TEST(Report, ThisRepositoryIsAccountedFor) {
    RealDisk disk;
    const CommandRun got = run(disk, {"-C", REPOSITORY, "report", "--format", "json"});
    ASSERT_EQ(got.exit_code, 0) << got.err;
    expect_accounted_for(json::parse(got.out));
}

TEST(Report, HasTheFieldsOfItsContract) {
    MemoryDisk disk = labelled();
    const json got = report_json(disk);
    ASSERT_EQ(got["blocks"].size(), 2);
    for (const json& block : got["blocks"])
        for (const char* field : {"name", "source_lines", "target_lines", "shared_source", "shared_target",
                                  "moss_percent_source", "moss_percent_target", "degree_of_portability"})
            EXPECT_TRUE(block.contains(field)) << field;
    const json& degree = got["blocks"][1]["degree_of_portability"];
    for (const char* field : {"loc", "low", "high"}) EXPECT_TRUE(degree[field].is_number()) << field;
    EXPECT_EQ(degree["model"], "lines");
    EXPECT_EQ(got["drift"]["verdict"], "in_step");
}

TEST(Report, ABlockIsMeasuredAsCompareMeasuresIt) {
    MemoryDisk disk = labelled();
    const json block = report_json(disk)["blocks"][1];
    const CommandRun got =
        run(disk, {"-C", "/r", "compare", "src/k.cu:kernels::shade", "port/k.comp:shade", "--format", "json"});
    ASSERT_EQ(got.exit_code, 0) << got.err;
    const json compared = json::parse(got.out);
    EXPECT_EQ(block["source_lines"], compared["a"]["lines"]);
    EXPECT_EQ(block["shared_target"], compared["shared_lines_b"]);
    EXPECT_NEAR(block["moss_percent_source"].get<double>(), compared["moss_percent_a"].get<double>(), 1e-6);
    EXPECT_NEAR(block["moss_percent_raw_target"].get<double>(), compared["moss_percent_raw_b"].get<double>(), 1e-6);
    EXPECT_EQ(block["source_lines"], 5);
    EXPECT_EQ(block["moss_percent_target"], 100.0);
}

TEST(Report, WithoutBlocksEachPairOfFilesIsOne) {
    MemoryDisk disk = labelled("");
    const json got = report_json(disk);
    ASSERT_EQ(got["blocks"].size(), 1);
    EXPECT_EQ(got["blocks"][0]["name"], "src/k.cu=port/k.comp");
    EXPECT_EQ(got["blocks"][0]["source_lines"], got["totals"]["source_lines"]);
    expect_accounted_for(got);
}

TEST(Report, ABlockThatMatchesNothingIsNamed) {
    MemoryDisk disk = labelled("[[block]]\nname = \"BSDF\"\nsource = \"src/*\"\ntarget = \"port/k.com\"\n");
    const CommandRun got = report(disk, {});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_EQ(got.out, "");
    EXPECT_EQ(got.err,
              "porttool: portmap.toml: block 'BSDF': target 'port/k.com' matches no file and no unit; did you mean "
              "'port/k.comp'?\n");
    disk = labelled("[[block]]\nname = \"BSDF\"\n");
    EXPECT_NE(report(disk, {}).err.find("names neither"), std::string::npos);
    disk = labelled(std::string(kBlocks) + "[[block]]\nname = \"All\"\nsource = \"src/*\"\n");
    EXPECT_NE(report(disk, {}).err.find("there are two of this name"), std::string::npos);
}

TEST(Report, ManyBlocksAreLookedUpAndNotTried) {
    constexpr size_t kMany = 3000;  // 9,000,000 pairs of a block and a function
    std::string text;
    for (size_t i = 0; i < kMany; ++i) text += "int f" + std::to_string(i) + "(int x) {\n    return x + 1;\n}\n";
    const auto report_of = [&](const std::function<std::string(size_t)>& pattern) {
        std::string map = "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n";
        for (size_t i = 0; i < kMany; ++i)
            map += "[[block]]\nname = \"b" + std::to_string(i) + "\"\nsource = [\"s/" + pattern(i) +
                   "\"]\ntarget = [\"t/" + pattern(i) + "\"]\n";
        MemoryDisk disk;
        disk.files = {{"/r/s/a.cpp", text}, {"/r/t/a.cpp", text}, {"/r/portmap.toml", map}};
        return run(disk, {"-C", "/r", "report", "--format", "json"});
    };
    const CommandRun own = report_of([](size_t i) { return "a.cpp:f" + std::to_string(i); });
    ASSERT_EQ(own.exit_code, 0) << own.err;
    const json blocks = json::parse(own.out)["blocks"];
    ASSERT_EQ(blocks.size(), kMany);
    for (const json& block : blocks) EXPECT_EQ(block["source_lines"], 3) << block["name"];
    const CommandRun more = report_of([](size_t i) { return "a.cpp:f" + std::to_string(i) + "*"; });
    ASSERT_EQ(more.exit_code, 0) << more.err;
    EXPECT_EQ(json::parse(more.out)["blocks"][299]["source_lines"], 3 * 11) << "f299 and f2990 to f2999";
    const CommandRun all = report_of([](size_t) { return std::string("a.cpp:*"); });
    EXPECT_EQ(all.exit_code, 2);
    EXPECT_NE(all.err.find("let each block take code of its own"), std::string::npos) << all.err;
    const CommandRun again = report_of([](size_t) { return std::string("a.cpp"); });
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_NE(again.err.find("take the same code again and again"), std::string::npos) << again.err;
}

TEST(Report, AThousandEditedFunctionsInOneLineArePutSideBySideOnce) {
    constexpr int kFunctions = 1000;  // each with the words of all took 13 s and more
    const auto text = [&](int more) {
        std::string out;
        for (int i = 0; i < kFunctions; ++i)
            out += "int f" + std::to_string(i) + "(int x) { return x * 3 + " + std::to_string(i + more) + "; } ";
        return out + "\n";
    };
    MemoryDisk disk;
    disk.files = {{"/r/s/a.cpp", text(0)}, {"/r/t/a.cpp", text(0)}};
    run(disk, {"-C", "/r", "init", "--source", "s/*", "--target", "t/*"});
    disk.files["/r/s/a.cpp"] = text(1);
    const CommandRun got = run(disk, {"-C", "/r", "report", "--format", "html"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
}

TEST(Report, ABarThatIsNotMetIsExitCodeOne) {
    MemoryDisk disk = labelled();
    EXPECT_EQ(report(disk, {"--fail-under", "Shade, \"core\"=100", "--fail-under", "All=0"}).exit_code, 0);
    const CommandRun got = report(disk, {"--fail-under", "Shade, \"core\"=100", "--fail-under", "All=99.5%"});
    EXPECT_EQ(got.exit_code, 1);
    EXPECT_NE(got.out, "");
    EXPECT_NE(got.err.find("porttool: All: moss_percent_target is "), std::string::npos) << got.err;
    EXPECT_EQ(got.err.find("Shade"), std::string::npos) << got.err;
}

TEST(Report, ABarThatCannotBeReadIsExitCodeTwo) {
    MemoryDisk disk = labelled("[[block]]\nname = \"BSDF\"\nsource = \"src/*\"\ntarget = \"port/*\"\n");
    for (const char* bar : {"BSDF", "=3", "BSDF=", "BSDF=lots", "BSDF=101", "BSDF=-1", "BSDF=nan", "BSDF=1e2x"}) {
        const CommandRun got = report(disk, {"--fail-under", bar});
        EXPECT_EQ(got.exit_code, 2) << bar;
        EXPECT_EQ(got.out, "") << bar;
        EXPECT_NE(got.err.find(std::string("--fail-under ") + bar), std::string::npos) << got.err;
    }
    const CommandRun unknown = report(disk, {"--fail-under", "BSFD=3"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.err.find("did you mean 'BSDF'?"), std::string::npos) << unknown.err;
    disk = labelled("");
    const CommandRun nameless = report(disk, {"--fail-under", "BSDF=3"});
    EXPECT_NE(nameless.err.find("src/k.cu=port/k.comp"), std::string::npos) << nameless.err;
}

// Pennycook's example shape: 2 / (1 / 0.75 + 1 / 0.25) = 0.375.
TEST(Report, PerformancePortabilityIsTheHarmonicMeanOfWhatBenchFilesSay) {
    MemoryDisk disk = labelled();
    disk.files["/r/cpu.json"] = R"({"core":"target","device":"CPU","mrays_per_s":{"total":12},)"
                                R"("embree_limit_mrays_per_s":16})";
    disk.files["/r/gpu.json"] = R"({"core":"source","device":"GPU","mrays_per_s":{"total":5},)"
                                R"("embree_limit_mrays_per_s":null})";
    const std::vector<std::string> start = {"-C", "/r", "report", "--format", "json", "--bench", "cpu.json"};
    auto with = [&](const std::string& bench) {
        std::vector<std::string> arguments = start;
        arguments.insert(arguments.end(), {"--bench", bench});
        return run(disk, arguments);
    };
    const json known = json::parse(with("gpu.json=20").out)["performance"];
    EXPECT_DOUBLE_EQ(known["performance_portability"], 0.375);
    EXPECT_EQ(known["platforms"][0]["name"], "target core on CPU");
    EXPECT_DOUBLE_EQ(known["platforms"][1]["efficiency"], 0.25);
    const json unknown = json::parse(with("gpu.json").out)["performance"];
    EXPECT_TRUE(unknown["performance_portability"].is_null());
    EXPECT_TRUE(report_json(disk)["performance"].is_null());
}

TEST(Report, ABenchFileThatCannotBeReadIsExitCodeTwo) {
    MemoryDisk disk = labelled();
    disk.files["/r/text.json"] = "no json";
    disk.files["/r/other.json"] = R"({"mrays_per_s": 4})";
    for (const auto& [bench, word] : {std::pair("none.json", "none.json"), std::pair("text.json", "no JSON"),
                                      std::pair("other.json", "mrays_per_s.total"), std::pair("text.json=x", "'x'")}) {
        const CommandRun got = run(disk, {"-C", "/r", "report", "--bench", bench});
        EXPECT_EQ(got.exit_code, 2) << bench;
        EXPECT_EQ(got.out, "") << bench;
        EXPECT_NE(got.err.find(word), std::string::npos) << got.err;
    }
}

TEST(Report, CsvHasOneRowABlockAndQuotesNames) {
    MemoryDisk disk = labelled();
    const std::string csv = report(disk, {"--format", "csv"}).out;
    std::vector<std::string> rows;
    for (size_t at = 0; at < csv.size();) {
        const size_t end = csv.find("\r\n", at);
        rows.push_back(csv.substr(at, end - at));
        at = end + 2;
    }
    ASSERT_EQ(rows.size(), 3);
    const auto commas = [](const std::string& row) { return std::count(row.begin(), row.end(), ','); };
    EXPECT_EQ(rows[0].substr(0, 19), "block,source_lines,");
    EXPECT_EQ(rows[2].substr(0, 24), "\"Shade, \"\"core\"\"\",5,5,5,");
    EXPECT_EQ(commas(rows[1]), commas(rows[0]));
    EXPECT_EQ(commas(rows[2]), commas(rows[0]) + 1) << "one comma is within quotes";
}

TEST(Report, WithoutALockOnlyTheDriftIsNotKnown) {
    MemoryDisk disk = labelled();
    const json recorded = report_json(disk);
    disk.files.erase("/r/portmap.lock");
    const json got = report_json(disk);
    for (const char* key :
         {"source_lines", "shared_source", "shared_target", "moss_percent_target", "lines", "degree_of_portability"})
        EXPECT_EQ(got["blocks"][0][key], recorded["blocks"][0][key]) << key;
    EXPECT_EQ(got["totals"]["moss_percent_target"], recorded["totals"]["moss_percent_target"]);
    EXPECT_TRUE(got["drift"]["verdict"].is_null());
    EXPECT_TRUE(got["drift"]["findings"].empty());
    for (const json& unit : got["units"]) EXPECT_TRUE(unit["state"].is_null()) << unit;
    expect_accounted_for(got);
    for (const char* format : {"text", "markdown"})
        EXPECT_NE(report(disk, {"--format", format}).out.find("nothing recorded"), std::string::npos) << format;
    EXPECT_EQ(report(disk, {"--format", "html"}).exit_code, 0);
}

TEST(Report, NamesThatCannotBeToldApartAreRefused) {
    for (const char* name : {"", "All lines", "*"}) {
        MemoryDisk disk = labelled("[[block]]\nname = \"" + std::string(name) + "\"\nsource = \"src/*\"\n");
        const CommandRun got = report(disk, {});
        EXPECT_EQ(got.exit_code, 2) << name;
        EXPECT_NE(got.err.find("portmap.toml"), std::string::npos) << got.err;
        EXPECT_NE(got.err.find("name"), std::string::npos) << got.err;
        EXPECT_EQ(got.out, "");
    }
}

TEST(Report, NamesCannotControlATerminalNorASpreadsheet) {
    MemoryDisk disk = labelled(
        "[[block]]\nname = \"a\\u001b[2Jb\\u0007\"\nsource = \"src/*\"\ntarget = \"port/*\"\n"
        "[[block]]\nname = \"=1+1\"\nsource = \"src/*\"\ntarget = \"port/*\"\n");
    for (const char* format : {"text", "markdown"}) {
        const std::string out = report(disk, {"--format", format}).out;
        EXPECT_EQ(out.find('\x1b'), std::string::npos) << format;
        EXPECT_EQ(out.find('\a'), std::string::npos) << format;
    }
    const std::string csv = report(disk, {"--format", "csv"}).out;
    EXPECT_NE(csv.find("\n'=1+1,"), std::string::npos) << csv;
}

TEST(Report, ASideWithoutCodeIsNamed) {
    MemoryDisk disk = labelled("[[block]]\nname = \"Alone\"\ntarget = \"port/*\"\n");
    for (const char* format : {"text", "markdown"}) {
        const std::string out = report(disk, {"--format", format}).out;
        EXPECT_NE(out.find("no source"), std::string::npos) << out;
        EXPECT_EQ(out.find("too short"), std::string::npos) << out;
    }
}

TEST(Report, WhatIsTooShortIsNeitherNoneNorAll) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", "#define A 3\n"}, {"/r/port/k.comp", "#define A 3\n"}};
    run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    const json got = report_json(disk);
    EXPECT_TRUE(got["totals"]["moss_percent_source"].is_null());
    EXPECT_TRUE(got["totals"]["degree_of_portability"].is_null());
    EXPECT_TRUE(got["totals"]["shared_source"].is_null());
    EXPECT_TRUE(got["blocks"][0]["shared_target"].is_null());
    EXPECT_TRUE(got["own_blocks"][0]["target_shared"].is_null()) << "the page draws it as too short";
    EXPECT_NE(report(disk, {"--format", "csv"}).out.find("src/k.cu=port/k.comp,1,1,,,"), std::string::npos);
    EXPECT_TRUE(got["units"][0]["moss_percent_target"].is_null());
    EXPECT_EQ(got["units"][0]["share"], "twin") << "its tokens are the same";
    for (const char* format : {"text", "markdown"})
        EXPECT_NE(report(disk, {"--format", format}).out.find("too short"), std::string::npos) << format;
    EXPECT_EQ(report(disk, {"--fail-under", "src/k.cu=port/k.comp=1"}).exit_code, 2);
    expect_accounted_for(got);
}

TEST(Report, EmptySidesBinaryFilesAndTwinsAreToldApart) {
    MemoryDisk disk = labelled("");
    disk.files["/r/port/k.comp"] = "\n\n// nothing\n";
    json got = report_json(disk);
    EXPECT_EQ(got["totals"]["target_lines"], 0);
    EXPECT_TRUE(got["totals"]["moss_percent_target"].is_null());
    EXPECT_TRUE(got["totals"]["degree_of_portability"].is_null());
    EXPECT_EQ(got["drift"]["verdict"], "drift");
    disk.files["/r/port/k.comp"] = std::string("float a;\0b", 10);
    got = report_json(disk);
    EXPECT_NE(got["drift"]["findings"].dump().find("is binary"), std::string::npos);
    expect_accounted_for(got);
    disk = labelled("");
    disk.files["/r/port/k.comp"] = kSource;
    got = report_json(disk);
    EXPECT_EQ(got["totals"]["moss_percent_source"], 100.0);
    EXPECT_EQ(got["totals"]["degree_of_portability"]["loc"], 1.0);
}

TEST(Report, MarkdownSaysTheVerdictFirstAndNoDateOrLine) {
    MemoryDisk disk = labelled();
    disk.files["/r/src/k.cu"] = replaced(kSource, "float d = a * b", "float d = a + b");
    const std::string text = report(disk, {"--format", "markdown"}).out;
    EXPECT_EQ(text.find("<!-- Made by: porttool report --format markdown -->\n### Port: drifted\n"), 0) << text;
    EXPECT_NE(text.find("| error | `src/k.cu:kernels::shade` | `port/k.comp:shade` |"), std::string::npos) << text;
    EXPECT_NE(text.find("- `port/k.comp:extra`: 1 line\n"), std::string::npos) << text;
    EXPECT_EQ(text.find("k.cu:4"), std::string::npos);
    EXPECT_EQ(text.find("-20"), std::string::npos) << "no date";
}

TEST(Report, ADeferralShowsItsOwnerAndTheDaysLeft) {
    MemoryDisk disk = labelled();
    disk.files["/r/src/k.cu"] = replaced(kSource, "float d = a * b", "float d = a + b");
    setenv("SOURCE_DATE_EPOCH", "1767225600", 1);  // 2026-01-01
    ASSERT_EQ(run(disk, {"-C", "/r", "defer", "src/k.cu:kernels::shade", "--owner", "Ada", "--until", "2026-02-01",
                         "--reason", "next week"})
                  .exit_code,
              0);
    const json row = report_json(disk)["drift"]["findings"][0];
    EXPECT_EQ(row["status"], "deferred");
    EXPECT_EQ(row["owner"], "Ada");
    EXPECT_EQ(row["reason"], "next week");
    EXPECT_EQ(row["days_left"], 31);
    setenv("SOURCE_DATE_EPOCH", "1770076800", 1);  // 2026-02-03
    const json late = report_json(disk);
    EXPECT_EQ(late["drift"]["findings"][0]["status"], "open");
    EXPECT_EQ(late["drift"]["findings"][0]["days_left"], -2);
    EXPECT_EQ(late["drift"]["verdict"], "drift");
    unsetenv("SOURCE_DATE_EPOCH");
    expect_accounted_for(late);
}

TEST(Report, OnePairOfWholeFilesTakesWhatNoOtherPairHas) {
    MemoryDisk disk = labelled();
    disk.files["/r/portmap.toml"] = replaced(kMap, "[[ignore]]",
                                             "[[pair]]\nsource = \"src/k.cu:@file\"\ntarget = \"port/k.comp:@file\"\n"
                                             "[[ignore]]");
    const json got = report_json(disk);
    EXPECT_EQ(got["totals"]["decomposition"]["source"]["unmatched"], 0);
    EXPECT_EQ(got["totals"]["decomposition"]["source"]["one_sided"], labels(kSource, "O"));
    expect_accounted_for(got);
}

TEST(Report, ASourceWithTwoPortsCountsItsLinesOnce) {
    MemoryDisk disk = labelled("");
    disk.files["/r/port/again.comp"] = "void other() { }\n" + std::string(kTarget);
    disk.files["/r/portmap.toml"] =
        replaced(kMap, "target = \"port/k.comp:shade\"", "target = [\"port/k.comp:shade\", \"port/again.comp:shade\"]");
    const json got = report_json(disk);
    EXPECT_EQ(got["totals"]["decomposition"]["source"]["twin"], labels(kSource, "T"));
    EXPECT_EQ(got["totals"]["decomposition"]["target"]["twin"], 2 * labels(kTarget, "T"));
    expect_accounted_for(got);
}

TEST(Report, WhatCannotBeDoneIsExitCodeTwo) {
    MemoryDisk disk = labelled();
    EXPECT_EQ(report(disk, {"--format", "pdf"}).exit_code, 2);
    RealDisk real;
    const CommandRun unwritable =
        run(real, {"-C", REPOSITORY, "report", "--format", "html", "-o", "/proc/nowhere/page.html"});
    EXPECT_EQ(unwritable.exit_code, 2);
    EXPECT_EQ(unwritable.out, "");
    EXPECT_NE(unwritable.err.find("-o /proc/nowhere/page.html"), std::string::npos) << unwritable.err;
}

/// What the page carries, unpacked by Python's zlib.
json page_data(const std::string& page) {
    const size_t begin = page.find("id=\"data\">") + 10;
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();  // two of them may run at once
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / (std::string("porttool_report_page_") + test->name());
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "packed") << page.substr(begin, page.find("</script>", begin) - begin);
    const std::string command = "cd '" + folder.string() +
                                "' && python3 -c \"import base64, zlib; open('data', 'wb').write(zlib.decompress("
                                "base64.b64decode(open('packed').read(), validate=True)))\"";
    EXPECT_EQ(std::system(command.c_str()), 0);
    std::ifstream file(folder / "data");
    return json::parse(file);
}

TEST(ReportPage, TextsCannotLeaveTheirElement) {
    MemoryDisk disk = labelled();
    disk.files["/r/src/k.cu"] += "// </script><!-- <script> \xE4\xC0\xAF \xED\xA0\x80 @DATA@ @SCRIPT@ \"'\n";
    const std::string page = report(disk, {"--format", "html"}).out;
    const auto count = [&](const std::string& word) {
        size_t found = 0;
        for (size_t at = page.find(word); at != std::string::npos; at = page.find(word, at + 1)) ++found;
        return found;
    };
    EXPECT_EQ(count("</script"), 2);
    EXPECT_EQ(count("<!--"), 0);
    EXPECT_EQ(count("@SCRIPT@"), 0) << "that of the text is packed";
    const json data = page_data(page);
    const std::string text = data["texts"]["source"]["src/k.cu"];
    EXPECT_NE(text.find("// </script><!-- <script> \uFFFD\uFFFD\uFFFD \uFFFD\uFFFD\uFFFD @DATA@ @SCRIPT@ \"'\n"),
              std::string::npos);
}

TEST(ReportPage, LinesAreThoseOfTheFile) {
    EXPECT_EQ(page_text("\xEF\xBB\xBF"
                        "a\r\nb\rc\n\nd"),
              "a\nb\nc\n\nd\n");
    EXPECT_EQ(page_text("\xF0\x9F\x98\x80\xF4\x90\x80\x80"), "\U0001F600\uFFFD\uFFFD\uFFFD\uFFFD\n");
    EXPECT_EQ(page_text(""), "");
}

TEST(ReportPage, MarksCountAsJavaScriptDoes) {
    MemoryDisk disk = labelled();
    const std::string head = "/* \U0001F600 \xE4 */ ";  // 2 units and 1
    disk.files["/r/src/k.cu"] = replaced(kSource, "    return d * a + b;", head + "return d * a - b;");
    const json data = page_data(report(disk, {"--format", "html"}).out);
    std::vector<json> firsts;
    for (const json& row : data["units"])
        if (row.contains("rows") && row["source"]["name"] == "kernels::shade") {
            uint32_t line = 0;
            for (const json& cells : row["rows"]) {
                line += cells[0].get<uint32_t>();  // steps from line to line
                if (line == 7 && cells[0] != 0) firsts.push_back(cells[2][0]);
            }
        }
    EXPECT_EQ(firsts, std::vector<json>{24}) << "'-' stands behind 3 + 2 + 1 + 1 + 4 units and 'return d * a '";
}

/// A function of lines drawn from a few, so that lines repeat.
std::string random_function(std::mt19937& random, size_t lines) {
    std::string text = "float f(float a, float b) {\n";
    for (size_t i = 0; i < lines; ++i) {
        const char* kLines[] = {
            "  a = a * b;",     "  b = lerp(a, b, 0.5f);",     "", "  // a comment", "  if (a > b) {", "  }",
            "  a += 1.0f + b;", "  float3 v = make_float3(a);"};
        text += kLines[random() % 8] + std::string("\n");
    }
    return text + "}\n";
}

TEST(Alignment, ShowsEachLineOfBothSidesOnceAndInOrder) {
    std::mt19937 random(7);
    for (int round = 0; round < 60; ++round) {
        const ScannedFile a = scan_text("a.cu", random_function(random, random() % 40));
        const ScannedFile b = scan_text("b.comp", random_function(random, random() % 40));
        ASSERT_FALSE(a.units.empty());
        const auto rows = align_units({&a, &a.units[0]}, {&b, &b.units[0]}, Dialect());
        std::vector<uint32_t> left, right;
        for (const AlignedRow& row : rows) {
            if (row.source_line != 0) left.push_back(row.source_line);
            if (row.target_line != 0) right.push_back(row.target_line);
        }
        std::vector<uint32_t> all_left(a.units[0].end_line), all_right(b.units[0].end_line);
        std::iota(all_left.begin(), all_left.end(), 1u);
        std::iota(all_right.begin(), all_right.end(), 1u);
        EXPECT_EQ(left, all_left);
        EXPECT_EQ(right, all_right);
    }
}

TEST(Alignment, MarksWhatDiffersAndWhatIsOnlySpelledDifferently) {
    const ScannedFile a = scan_text("a.cu", "float f(float3 v) {\n  return dot(v, v) * 0.5f;\n}\n");
    const ScannedFile b = scan_text("b.comp", "float f(vec3 v) {\n  int extra = 1;\n  return dot(v, v) + 0.5;\n}\n");
    const auto rows = align_units({&a, &a.units[0]}, {&b, &b.units[0]}, Dialect());
    ASSERT_EQ(rows.size(), 4);
    ASSERT_EQ(rows[0].source_marks.size(), 1);
    EXPECT_TRUE(rows[0].source_marks[0].translated);
    EXPECT_EQ(rows[0].source_marks[0].first, 8);
    EXPECT_EQ(rows[0].source_marks[0].length, 6);
    EXPECT_EQ(rows[1].source_line, 0);
    EXPECT_EQ(rows[1].target_line, 2);
    EXPECT_EQ(rows[2].source_line, 2);
    EXPECT_EQ(rows[2].target_line, 3);
    ASSERT_EQ(rows[2].source_marks.size(), 2);
    EXPECT_FALSE(rows[2].source_marks[0].translated) << "* became +";
    EXPECT_EQ(rows[2].source_marks[0].first, 19);
    EXPECT_TRUE(rows[2].source_marks[1].translated) << "0.5f is 0.5";
    EXPECT_TRUE(rows[3].source_marks.empty());
}

TEST(Report, AGiantFunctionIsReported) {
    MemoryDisk disk;
    std::string body;
    const int kLines = 20'000 / kLighter;
    for (int i = 0; i < kLines; ++i) body += "  x = x * " + std::to_string(i) + ".0f + y;\n";
    disk.files["/r/src/k.cu"] = "__device__ float giant(float x, float y) {\n" + body + "  return x;\n}\n";
    disk.files["/r/port/k.comp"] = "float giant(float x, float y) {\n" + body + "  return y;\n}\n";
    run(disk, {"-C", "/r", "init", "--source", "src/*", "--target", "port/*"});
    const json got = report_json(disk);
    EXPECT_EQ(got["totals"]["source_lines"], kLines + 3);
    EXPECT_GT(got["totals"]["moss_percent_source"], 99.9);
    EXPECT_EQ(report(disk, {"--format", "html"}).exit_code, 0);
}

class ReportBase : public ::testing::Test {
protected:
    void SetUp() override {
        if (std::system("git --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "git is not installed";
        root = std::filesystem::temp_directory_path() /
               ("porttool_report_test_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
        std::filesystem::remove_all(root);
        const MemoryDisk files = labelled();
        for (const auto& [path, text] : files.files) write(path.substr(3), text);
        shell("git init -q -b main . && git config user.email a@b && git config user.name a");
        commit("one", "2026-01-01T12:00:00Z");
    }
    void TearDown() override {
        unsetenv("SOURCE_DATE_EPOCH");
        std::filesystem::remove_all(root);
    }

    void write(const std::string& path, const std::string& text) const {
        std::filesystem::create_directories((root / path).parent_path());
        std::ofstream(root / path, std::ios::binary) << text;
    }
    void shell(const std::string& line) const {
        ASSERT_EQ(std::system(("cd '" + root.string() + "' && " + line + " > /dev/null 2>&1").c_str()), 0) << line;
    }
    void commit(const std::string& name, const std::string& date) const {
        shell("git add -A && GIT_AUTHOR_DATE=" + date + " GIT_COMMITTER_DATE=" + date + " git commit -qm " + name);
    }
    CommandRun got(std::vector<std::string> options, const std::string& folder = "") {
        options.insert(options.begin(), {"-C", folder.empty() ? root.string() : folder, "report"});
        return run(disk, options);
    }
    json got_json(std::vector<std::string> options = {}) {
        options.insert(options.begin(), {"--format", "json"});
        const CommandRun run = got(options);
        EXPECT_EQ(run.exit_code, 0) << run.err;
        return run.exit_code == 0 ? json::parse(run.out) : json();
    }

    std::filesystem::path root;
    RealDisk disk;
};

TEST_F(ReportBase, ShowsTheDifferenceOfTwoReports) {
    const json before = got_json();
    shell("git branch start");
    write("src/k.cu", replaced(kSource, "return d * a + b;", "d = d + a * b;\n    return d * a;"));
    write("port/k.comp", replaced(kTarget, "float extra(float a) { return a * a; }", ""));
    commit("two", "2026-01-02T12:00:00Z");
    const json now = got_json({"--base", "start"});
    for (size_t i = 0; i < now["blocks"].size(); ++i) {
        const json &a = before["blocks"][i], &b = now["blocks"][i];
        for (const char* field : {"source_lines", "target_lines", "shared_source", "shared_target",
                                  "moss_percent_source", "moss_percent_target"})
            EXPECT_NEAR(b["change"][field].get<double>(), b[field].get<double>() - a[field].get<double>(), 2e-6)
                << b["name"] << " " << field;
        EXPECT_NEAR(b["change"]["degree_of_portability"].get<double>(),
                    b["degree_of_portability"]["loc"].get<double>() - a["degree_of_portability"]["loc"].get<double>(),
                    2e-6);
    }
    EXPECT_EQ(now["totals"]["change"]["source_lines"], 1);
    EXPECT_EQ(now["totals"]["change"]["target_lines"], -1);
    EXPECT_EQ(now["drift"]["change"]["drifted"], 1);
    EXPECT_EQ(now["drift"]["change"]["in_step"], -1);
    EXPECT_EQ(before["drift"].contains("change"), false);
    const std::string markdown = got({"--base", "start", "--format", "markdown"}).out;
    EXPECT_NE(markdown.find(" ▲ +1 |"), std::string::npos) << markdown;
    EXPECT_NE(markdown.find(" ▼ -1 |"), std::string::npos) << markdown;
    EXPECT_NE(got({"--base", "start", "--format", "csv"}).out.find("_change\r\n"), std::string::npos);
}

TEST_F(ReportBase, AgainstItselfNothingChangesInARepositoryOfOneCommit) {
    const json now = got_json({"--base", "HEAD"});
    for (const auto& [name, value] : now["totals"]["change"].items()) EXPECT_EQ(value, 0) << name;
    EXPECT_EQ(got({"--base", "HEAD", "--format", "markdown"}).out.find("▲"), std::string::npos);
}

TEST_F(ReportBase, AShallowCloneIsToldToFetchMore) {
    shell("git checkout -q -b side");
    write("src/k.cu", std::string(kSource) + "\n");
    commit("aside", "2026-01-02T12:00:00Z");
    shell("git checkout -q main");
    write("src/k.cu", "\n" + std::string(kSource));
    commit("two", "2026-01-03T12:00:00Z");
    const std::string clone = root.string() + "_clone";
    std::filesystem::remove_all(clone);
    shell("git clone -q --depth 1 'file://" + root.string() + "' '" + clone + "'");
    shell("cd '" + clone + "' && git fetch -q --depth 1 origin side && git branch side FETCH_HEAD");
    const CommandRun run = got({"--base", "side"}, clone);
    std::filesystem::remove_all(clone);
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_EQ(run.out, "");
    EXPECT_NE(run.err.find("fetch-depth: 0"), std::string::npos) << run.err;
}

TEST_F(ReportBase, FindingsAreAsOldAsTheCommitThatBroughtThemIn) {
    const std::string changed = replaced(kSource, "float d = a * b", "float d = a + b");
    write("src/k.cu", changed);
    commit("drift", "2026-01-10T12:00:00Z");
    write("src/k.cu", "\n\n" + changed);
    commit("cosmetic", "2026-01-15T12:00:00Z");
    setenv("SOURCE_DATE_EPOCH", "1768867200", 1);  // 2026-01-20
    json finding = got_json()["drift"]["findings"][0];
    EXPECT_EQ(finding["rule"], "source-changed");
    EXPECT_EQ(finding["age_days"], 10);
    EXPECT_EQ(finding["age_is_least"], false);
    write("src/k.cu", kSource);
    write("port/k.comp", replaced(kTarget, "d * a + b", "d * b + a"));
    finding = got_json()["drift"]["findings"][0];
    EXPECT_EQ(finding["rule"], "target-changed");
    EXPECT_EQ(finding["age_days"], 0) << "it is not committed yet";
}

TEST_F(ReportBase, WithoutGitThereAreNoAges) {
    std::filesystem::remove_all(root / ".git");
    write("src/k.cu", replaced(kSource, "float d = a * b", "float d = a + b"));
    EXPECT_TRUE(got_json()["drift"]["findings"][0]["age_days"].is_null());
    EXPECT_EQ(got({"--base", "HEAD"}).exit_code, 2);
}

/// docs/portability-report.md is what the command prints on this repository.
TEST(OwnReport, TheOneInTheDocsIsUpToDate) {
    RealDisk disk;
    const CommandRun got = run(disk, {"-C", REPOSITORY, "report", "--format", "markdown"});
    ASSERT_EQ(got.exit_code, 0) << got.err;
    EXPECT_EQ(read_text(std::filesystem::path(REPOSITORY) / "docs/portability-report.md"), got.out)
        << "make it anew: build/release/bin/porttool report --format markdown -o docs/portability-report.md";
}

}  // namespace
}  // namespace porttool::testing::report_test
