// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// This repository's own map: it leaves no unit out, says nothing that is not so, and its check can fail.
#include <set>

#include "porttool/read/glob.h"
#include "porttool/read/map_file.h"
#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::own_map_test {
namespace {

MapFile own_map() {
    const ReadMap read = read_map("portmap.toml", read_text(std::filesystem::path(REPOSITORY) / "portmap.toml"));
    if (!read.error.empty()) throw std::runtime_error(read.error);
    return read.map;
}

bool any_matches(const std::vector<std::string>& globs, const std::string& text) {
    return std::any_of(globs.begin(), globs.end(),
                       [&](const std::string& glob) { return glob == text || Glob(glob).matches(text); });
}

/// The ids of all units in the files of both sides.
std::set<std::string> own_units(const MapFile& map) {
    RealDisk disk;
    const CommandRun got = run(disk, {"-C", REPOSITORY, "scan", "source_core", "target_core", "--format", "json"});
    std::vector<std::string> sides = map.source;
    sides.insert(sides.end(), map.target.begin(), map.target.end());
    std::set<std::string> ids;
    const auto report = nlohmann::json::parse(got.out);
    for (const auto& unit : report["units"])
        if (any_matches(sides, unit["file"])) ids.insert(unit["id"].get<std::string>());
    return ids;
}

TEST(OwnMap, EveryUnitOfBothSidesIsPairedOrLeftOutWithAReason) {
    const MapFile map = own_map();
    std::set<std::string> paired;
    for (const MapPair& pair : map.pairs) {
        paired.insert(pair.source);
        paired.insert(pair.targets.begin(), pair.targets.end());
    }
    std::set<std::string> used;
    const std::set<std::string> units = own_units(map);
    ASSERT_GT(units.size(), 1200u) << "both cores, whole";
    for (const std::string& id : units) {
        bool ignored = false;
        for (const MapIgnore& ignore : map.ignores) {
            if (!any_matches({ignore.id}, id)) continue;
            ignored = true;
            used.insert(ignore.id);
        }
        EXPECT_NE(paired.contains(id), ignored)
            << id << (ignored ? ": paired and ignored" : ": in no pair, not ignored");
    }
    for (const MapIgnore& ignore : map.ignores) {
        EXPECT_TRUE(used.contains(ignore.id)) << ignore.id << " leaves nothing out";
        EXPECT_GT(ignore.reason.size(), 20u) << ignore.id;
    }
}

TEST(OwnMap, TheBlocksOfTheThesisAreThereAndHoldUnitsOfBothSides) {
    const MapFile map = own_map();
    const std::set<std::string> units = own_units(map);
    std::vector<std::string> names;
    for (const MapBlock& block : map.blocks) {
        names.push_back(block.name);
        for (const auto& side : {block.source, block.target})
            for (const std::string& glob : side)
                EXPECT_TRUE(
                    std::any_of(units.begin(), units.end(),
                                [&](const std::string& id) { return any_matches({glob}, id.substr(0, id.find(':'))); }))
                    << block.name << ": '" << glob << "' matches no file of the map";
    }
    EXPECT_EQ(names, (std::vector<std::string>{"Render core", "Kernels", "BSDF", "Shading", "Extend", "Extend kernels",
                                               "Tables"}));
}

/// The repository's two sides and its map, in memory.
MemoryDisk own_repository() {
    MemoryDisk disk;
    const std::filesystem::path root = REPOSITORY;
    for (const char* folder : {"source_core", "target_core", "portmap.base"})
        for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder))
            if (entry.is_regular_file())
                disk.files["/r/" + std::filesystem::relative(entry.path(), root).generic_string()] =
                    read_text(entry.path());
    for (const char* file : {"portmap.toml", "portmap.lock"})
        disk.files[std::string("/r/") + file] = read_text(root / file);
    return disk;
}

TEST(OwnMap, AnEditOfOneKernelAloneIsDrift) {
    MemoryDisk disk = own_repository();
    ASSERT_EQ(run(disk, {"-C", "/r", "check", "--strict"}).exit_code, 0);
    std::string& kernel = disk.files.at("/r/source_core/kernels/connect.glsl");
    kernel = replaced(kernel, "trace_any(", "!trace_any(");
    const CommandRun got = run(disk, {"-C", "/r", "check", "--format", "json"});
    EXPECT_EQ(got.exit_code, 1);
    const auto report = nlohmann::json::parse(got.out);
    ASSERT_EQ(report["findings"].size(), 1u);
    EXPECT_EQ(report["findings"][0]["source"]["id"], "source_core/kernels/connect.glsl:connect_shadow_ray");
}

TEST(OwnMap, AnEditOfTheHostOrOfTheWideTraceAloneIsDrift) {
    struct Row {
        const char *file, *from, *to, *source;
    };
    for (const Row& row : {Row{"source_core/wavefront.cpp", "pass.first_pixel = batch.first_pixel;",
                               "pass.first_pixel = 0;", "source_core/wavefront.cpp:source_core::Wavefront::pass_of"},
                           Row{"source_core/render_core.cpp", "frame.seed = settings().seed;", "frame.seed = 0;",
                               "source_core/render_core.cpp:source_core::SourceCore::frame_settings"},
                           Row{"target_core/device/wide_trace.h", "return end < 0.0f;", "return end > 0.0f;",
                               "source_core/kernels/trace.glsl:trace_any"}}) {
        MemoryDisk disk = own_repository();
        std::string& text = disk.files.at(std::string("/r/") + row.file);
        ASSERT_NE(text.find(row.from), std::string::npos) << row.file;
        text = replaced(text, row.from, row.to);
        const CommandRun got = run(disk, {"-C", "/r", "check", "--strict", "--format", "json"});
        EXPECT_EQ(got.exit_code, 1) << row.file;
        const auto report = nlohmann::json::parse(got.out);
        EXPECT_FALSE(report["findings"].empty());
        for (const auto& finding : report["findings"]) EXPECT_EQ(finding["source"]["id"], row.source);
    }
}

TEST(OwnMap, ANewFunctionBesideTheTreeWalkIsNotCoveredByItsReason) {
    MemoryDisk disk = own_repository();
    disk.files.at("/r/source_core/kernels/trace.glsl") += "\nFloat brand_new(Float a) { return a * 17.0; }\n";
    const auto report = nlohmann::json::parse(run(disk, {"-C", "/r", "check", "--format", "json"}).out);
    ASSERT_EQ(report["findings"].size(), 1u);
    EXPECT_EQ(report["findings"][0]["rule"], "unported");
}

}  // namespace
}  // namespace porttool::testing::own_map_test
