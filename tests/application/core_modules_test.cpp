// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/application/run_pathtracer.h"
#include "tests/application/small_scene.h"

namespace pathtracer_modules_test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::AnyOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr const char* NAME = "pathtracer-core-dark.so";

/// A folder of modules beside one with a scene, and what the program does with both.
class Modules : public testing::Test {
protected:
    Modules() { fs::create_directory(modules); }

    RunResult run(const std::vector<std::string>& words, const std::string& named) {
        return run_pathtracer(words, folder.path, {"PATHTRACER_MODULES=" + named});
    }
    RunResult bench(const std::string& core, const std::string& named) {
        return run({"bench", scene, "--core", core, "--size", "16x9", "--spp", "1", "--quiet"}, named);
    }
    std::string picture(const std::string& core) {
        const RunResult result = run({"render", scene, "--core", core, "--size", "16x9", "-o", "a.png"}, modules);
        EXPECT_EQ(result.exit_code, 0) << result.err;
        return read_file(folder.path / "a.png");
    }
    void expect_refused(const std::string& core, const std::string& named, const std::string& words) {
        const RunResult result = bench(core, named);
        EXPECT_EQ(result.exit_code, 2) << result.err;
        EXPECT_THAT(result.out, IsEmpty());
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.err, HasSubstr(words));
    }
    /// The same with these bytes as the module.
    void expect_refused_bytes(const std::string& bytes, const std::string& words) {
        std::ofstream(modules / NAME, std::ios::binary) << bytes;
        expect_refused("dark", modules, (modules / NAME).string() + " " + words);
    }

    const TemporaryFolder folder;
    const fs::path modules = folder.path / "modules";
    const std::string scene = write_small_scene(folder.path).filename().string();
    const std::string dark = read_file(DARK_CORE);
};

TEST_F(Modules, AThirdCoreIsDroppedIntoAFolder) {
    fs::copy(DARK_CORE, modules / NAME);
    const std::string seen = picture("dark");
    EXPECT_FALSE(seen.empty());
    EXPECT_TRUE(seen == picture("null"));

    const json cores = json::parse(run({"info", "--format", "json"}, modules).out)["cores"];
    ASSERT_EQ(cores.size(), 3u);
    EXPECT_EQ(cores[0]["id"], "source");
    EXPECT_EQ(cores[1]["id"], "target");
    EXPECT_EQ(cores[2]["id"], "dark");
    EXPECT_EQ(cores[2]["available"], true);
    EXPECT_EQ(cores[2]["file"], (modules / NAME).string());
    EXPECT_TRUE(fs::equivalent(fs::path(cores[1]["file"]).parent_path(), fs::path(OWN_MODULES)));

    for (const char* name : {"pathtracer-core-\x1b[2J.so", "pathtracer-core-null.so", "pathtracer-core-.so", "core.so"})
        fs::copy(DARK_CORE, modules / name);
    const RunResult unknown = bench("bright", modules);
    EXPECT_THAT(unknown.err, HasSubstr("'bright' is not one of auto, dark, null, source, target"));
    EXPECT_EQ(std::count(unknown.err.begin(), unknown.err.end(), '\x1b'), 0);

    // Not from where the scene lies or the program is started.
    fs::copy(DARK_CORE, folder.path / NAME);
    const RunResult elsewhere = run_pathtracer({"render", scene, "--core", "dark", "-o", "b.png"}, folder.path);
    EXPECT_EQ(elsewhere.exit_code, 2);
    EXPECT_THAT(elsewhere.err, HasSubstr("'dark' is not one of auto, null, source, target"));
}

TEST_F(Modules, WhatIsNoModuleIsRefusedByName) {
    expect_refused_bytes("", "is empty; build or install it anew, or remove it");
    expect_refused_bytes("#!/bin/sh\necho a text that is called a module, and no shorter than its head is\n",
                         "is no shared object");
    expect_refused_bytes(read_file(PATHTRACER).substr(0, 5000), "is cut short");
    expect_refused_bytes(read_file(fs::path(OWN_MODULES) / "pathtracer-images.so"), "exports no pathtracer_core");
    // Another text of the interface's number, and another machine (EI_CLASS, e_machine).
    const size_t interface = dark.find("1, headers ");
    ASSERT_NE(interface, std::string::npos);
    ASSERT_EQ(dark.find("1, headers ", interface + 1), std::string::npos);
    std::string other = dark;
    other[interface] = '0';
    expect_refused_bytes(other, "is of another version (its interface is \"0, headers ");
    other = dark;
    other[18] = 3;
    expect_refused_bytes(other, "is for another kind of machine");
    for (size_t part = 0; part < 12; ++part) {
        std::ofstream(modules / NAME, std::ios::binary) << dark.substr(0, dark.size() * part / 12);
        const RunResult result = bench("dark", modules);
        // The loader needs neither the names of sections nor the symbols for debuggers, which stand at the end.
        EXPECT_THAT(result.exit_code, AnyOf(2, part < 6 ? 2 : 0)) << part << ": " << result.err;
    }
    fs::remove(modules / NAME);
    fs::create_symlink("nowhere.so", modules / NAME);
    expect_refused("dark", modules, "is a link that leads nowhere");
    fs::remove(modules / NAME);
    fs::create_directory(modules / NAME);
    expect_refused("dark", modules, "is a folder");
    fs::remove(modules / NAME);
    fs::copy(DARK_CORE, modules / "pathtracer-core-light.so");
    expect_refused("light", modules, "calls its core \"dark\"");
}

TEST_F(Modules, ABrokenCoreIsPassedOverForTheNext) {
    std::ofstream(modules / NAME) << "broken";
    std::ofstream(modules / "pathtracer-core-source.so") << "broken";
    const RunResult result = run({"bench", scene, "--core", "dark,null", "--size", "16x9", "--spp", "1"}, modules);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("core null: core dark: "));
    EXPECT_THAT(result.err, HasSubstr("is no shared object"));
    // The named folder goes before the program's own.
    expect_refused("source", modules, (modules / "pathtracer-core-source.so").string() + " is no shared object");
}

TEST_F(Modules, AFolderThatAnybodyCanFillIsNoFolderOfModules) {
    fs::copy(DARK_CORE, modules / NAME);
    fs::permissions(modules / NAME, fs::perms::others_write, fs::perm_options::add);
    expect_refused("dark", modules, "can be written by anybody; chmod o-w it");
    fs::permissions(modules / NAME, fs::perms::others_write, fs::perm_options::remove);
    fs::permissions(modules, fs::perms::others_write, fs::perm_options::add);
    expect_refused("null", modules, "PATHTRACER_MODULES: " + modules.string() + " can be written by anybody");
    expect_refused("null", "modules", "modules is not a whole path");
    expect_refused("null", folder.path / "none", "is no folder");
}

TEST_F(Modules, WithoutAnyThereIsALineThatSaysWhatToDo) {
    fs::create_directory(folder.path / "bin");
    fs::copy(PATHTRACER, folder.path / "bin" / "pathtracer");
    const std::string alone = (folder.path / "bin" / "pathtracer").string();
    for (const char* core : {"auto", "source", "target"}) {
        const RunResult result = run_program({alone, "bench", scene, "--core", core, "--quiet"}, folder.path);
        EXPECT_EQ(result.exit_code, 2);
        EXPECT_THAT(result.out, IsEmpty());
        EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
        EXPECT_THAT(result.err, HasSubstr("there is no "));
        EXPECT_THAT(result.err, HasSubstr(".so; install the program anew"));
    }
}

}  // namespace
}  // namespace pathtracer_modules_test
