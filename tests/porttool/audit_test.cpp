// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// porttool audit, on small repositories whose answers are known by how they were made.
#include <gtest/gtest.h>

#include <span>

#include "porttool/audit/same_value.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::audit_test {
namespace {

const std::string kCudaShade =
    "__device__ float shade(float cosine, float albedo) {\n"
    "    float weight = max(cosine, 0.0f);\n"
    "    float level = albedo * weight * 0.3183f;\n"
    "    if (level < 0.001f) return 0.0f;\n"
    "    return level + 0.01f;\n"
    "}\n";
const std::string kCppShade =
    "float shade(float cosine, float albedo) {\n"
    "    float weight = std::max(cosine, 0.0f);\n"
    "    float level = albedo * weight * 0.3183f;\n"
    "    if (level < 0.001f) return 0.0f;\n"
    "    return level + 0.01f;\n"
    "}\n";

class Audit : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        if (IsSkipped()) return;
        write("gpu/shade.cu", kCudaShade);
        write("cpu/shade.cpp", kCppShade);
        commit("Both sides", 1);
    }

    CommandRun audit(std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"audit", "--source", "gpu/*", "--target", "cpu/*"});
        return porttool(more);
    }
    nlohmann::json items(std::vector<std::string> more = {}) {
        more.insert(more.end(), {"--format", "json"});
        const CommandRun got = audit(more);
        EXPECT_LE(got.exit_code, 1) << got.err;
        const auto found = nlohmann::json::parse(got.out);
        EXPECT_EQ(got.exit_code, found["items"].empty() ? 0 : 1);
        return found["items"];
    }
    std::string id_of_head() const {
        std::ifstream file(root / ".git/refs/heads/main");
        std::string id;
        file >> id;
        return id;
    }
    /// Pairs of functions that nobody edits.
    void add_pairs(int count) {
        std::string gpu, cpu;
        for (int i = 0; i < count; ++i) {
            const std::string text = "float step_" + std::to_string(i) + "(float x) { return x * " +
                                     std::to_string(i + 2) + ".0f + sqrt(x); }\n";
            gpu += "__device__ " + text;
            cpu += text;
        }
        write("gpu/steps.cu", gpu);
        write("cpu/steps.cpp", cpu);
        commit("Steps", 4);
    }
    void change(const std::string& path, const std::string& from, const std::string& to) const {
        std::stringstream text;
        text << std::ifstream(root / path).rdbuf();
        write(path, replaced(text.str(), from, to));
    }
};

TEST_F(Audit, ListsTheFixThatNeverArrived) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces: the threshold was too high", 2);
    const std::string fix = id_of_head();
    change("gpu/shade.cu", "0.3183f", "0.31831f");
    change("cpu/shade.cpp", "0.3183f", "0.31831f");
    commit("More digits", 3);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/shade.cu:shade");
    EXPECT_EQ(found[0]["target"], "cpu/shade.cpp:shade");
    EXPECT_EQ(found[0]["commit"], fix);
    EXPECT_EQ(found[0]["date"], "2026-01-02");
    EXPECT_EQ(found[0]["edited"], "source");
    EXPECT_NE(found[0]["summary"].get<std::string>().find("1e-04f"), std::string::npos) << found[0]["summary"];
    EXPECT_GT(found[0]["certainty"], 0.8);
    EXPECT_TRUE(found[0]["witness"].is_null());
}

TEST_F(Audit, AFixThatArrivedLaterIsNone) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    change("cpu/shade.cpp", "level < 0.001f", "level < 0.0001f");
    commit("Port the fix", 9);
    EXPECT_TRUE(items().empty());
}

TEST_F(Audit, AnEditThatWasTakenBackIsNone) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    change("gpu/shade.cu", "level < 0.0001f", "level < 0.001f");
    commit("Take it back", 3);
    EXPECT_TRUE(items().empty());
}

TEST_F(Audit, AnEditOfTheTargetIsOneToo) {
    change("cpu/shade.cpp", "    if (level", "    if (std::isnan(level)) return 0.0f;\n    if (level");
    commit("Fix NaN of degenerate triangles", 2);
    change("gpu/shade.cu", "__device__", "__device__ inline");
    commit("Inline", 3);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/shade.cu:shade") << "the fields keep their sides";
    EXPECT_EQ(found[0]["edited"], "target");
    EXPECT_NE(found[0]["summary"].get<std::string>().find("isnan"), std::string::npos);
}

TEST_F(Audit, SeveralEditsOfOneStatementAreOneItemOfTheFirst) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    const std::string fix = id_of_head();
    change("gpu/shade.cu", "level < 0.0001f", "level < 0.00001f");
    commit("Darker still", 3);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["commit"], fix) << "there the port was left behind";
    EXPECT_NE(found[0]["summary"].get<std::string>().find("1e-05f"), std::string::npos) << "but this is what it lacks";
}

TEST_F(Audit, FollowsFilesAndUnitsThatWereRenamed) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    const std::string fix = id_of_head();
    git("mv gpu/shade.cu gpu/shading.cu");
    commit("Rename the file", 3);
    change("gpu/shading.cu", "float shade(", "float shade_surface(");
    commit("Rename the function", 4);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/shading.cu:shade_surface");
    EXPECT_EQ(found[0]["commit"], fix);
}

TEST_F(Audit, FollowsFoldersThatWereRenamedAndSidesThatSwappedRoles) {
    for (const std::string name : {"a", "b", "c"}) {
        write("gpu/" + name + ".cu", replaced(kCudaShade, "shade", "shade_" + name));
        write("cpu/" + name + ".cpp", replaced(kCppShade, "shade", "shade_" + name));
    }
    commit("More", 2);
    change("gpu/b.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 3);
    const std::string fix = id_of_head();
    git("mv gpu other && git mv cpu gpu && git mv other cpu");
    commit("The CPU version is the original now", 4);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["target"], "cpu/b.cu:shade_b");
    EXPECT_EQ(found[0]["edited"], "target");
    EXPECT_EQ(found[0]["commit"], fix);
}

// Dozens of files that are alike but for a name, all renamed at once, then all functions, then files that take each
// other's names: an edit from before is found, and told once.
TEST_F(Audit, ARenameStormHidesNoEdit) {
    constexpr int files = 30;
    const auto function = [](const std::string& what, int i) { return what + "_k" + std::to_string(i); };
    const auto move = [&](const std::string& from, const std::string& to, int by) {
        std::filesystem::rename(root / "gpu", root / "other");
        std::filesystem::create_directory(root / "gpu");
        for (int i = 0; i < files; ++i)
            std::filesystem::rename(root / "other" / (function(from, i) + ".cu"),
                                    root / "gpu" / (function(to, (i + by) % files) + ".cu"));
        std::filesystem::rename(root / "other/shade.cu", root / "gpu/shade.cu");
        std::filesystem::remove(root / "other");
    };
    for (int i = 0; i < files; ++i) {
        write("gpu/" + function("a", i) + ".cu", replaced(kCudaShade, "shade", function("shade", i)));
        write("cpu/" + function("a", i) + ".cpp", replaced(kCppShade, "shade", function("shade", i)));
    }
    commit("More", 2);
    change("gpu/a_k7.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 3);
    const std::string fix = id_of_head();
    move("a", "b", 0);
    commit("Rename all files", 4);
    for (const std::string side : {"gpu/b", "cpu/a"})
        for (int i = 0; i < files; ++i)
            change(function(side, i) + (side == "gpu/b" ? ".cu" : ".cpp"), function("shade", i), function("tint", i));
    commit("Rename all functions", 5);
    auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/b_k7.cu:tint_k7");
    EXPECT_EQ(found[0]["target"], "cpu/a_k7.cpp:tint_k7");
    EXPECT_EQ(found[0]["commit"], fix);

    // To git each of these files was edited: the item is there, the commit is that of the exchange.
    move("b", "b", 1);
    commit("Exchange the names", 6);
    found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/b_k8.cu:tint_k7");
    EXPECT_EQ(found[0]["target"], "cpu/a_k7.cpp:tint_k7");
}

TEST_F(Audit, WhatThePortSaysInOtherWordsHasArrived) {
    change("gpu/shade.cu", "    if (level", "    level *= albedo;\n    if (level");
    commit("Fix the level", 2);
    change("cpu/shade.cpp", "    if (level", "    level = level * albedo;\n    if (level");
    commit("Port the fix", 3);
    EXPECT_TRUE(items().empty()) << items();
}

TEST_F(Audit, NeitherMannersNorRenamedLocalsAreItems) {
    write("gpu/shade.cu",
          "// shading\nstatic __device__ __forceinline__ float shade(const float cos_theta, const float albedo) {\n"
          "    const float weight = fmaxf(cos_theta, 0.f);\n"
          "    const float level = albedo * weight * 0.3183f;\n"
          "    if (level < 0.001f)\n        return 0.0f;\n"
          "    return level + 0.01f;\n"
          "}\n");
    commit("Tidy up", 2);
    EXPECT_TRUE(items().empty()) << items();
}

TEST_F(Audit, OneEditOfManyUnitsIsOneItem) {
    std::string gpu, cpu;
    for (const std::string name : {"red_of", "green_of", "blue_of"}) {
        gpu += replaced(kCudaShade, "shade", name);
        cpu += replaced(kCppShade, "shade", name);
    }
    write("gpu/shade.cu", gpu);
    write("cpu/shade.cpp", cpu);
    commit("Colours", 2);
    for (int i = 0; i < 3; ++i) change("gpu/shade.cu", "return level + 0.01f", "return level + 0.02f");
    commit("Fix the ambient term", 3);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["same"].size(), 2);
}

// What the two sides say throughout in two ways is no edit that one of them lacks.
TEST_F(Audit, AMannerOfTheSidesIsNoItem) {
    std::string gpu, cpu;
    for (int i = 0; i < 12; ++i) {
        const std::string n = std::to_string(i);
        const std::string rest = " += values[i] * weight" + n + " + bias" + n + "; return sum; }\n";
        const std::string head = "float total" + n + "(const float* values, int count, float weight" + n +
                                 ", float bias" + n + ") { float sum = " + n + ".0f; ";
        gpu += "__device__ " + head + "for (int i = 0; i < count; i += WIDTH) sum" + rest;
        cpu += head + "for (int i = 0; i < count; ++i) sum" + rest;
    }
    write("gpu/sums.cu", gpu);
    write("cpu/sums.cpp", cpu);
    commit("Sums", 2);
    EXPECT_EQ(items(), nlohmann::json::array());
    change("gpu/sums.cu", "* weight7", "* weight7 * 0.5f");
    commit("Fix the seventh sum", 3);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/sums.cu:total7");
}

TEST_F(Audit, WhatAnotherPortHasIsMoreCertain) {
    write("old/shade.cpp", kCppShade);
    write("portmap.toml",
          "version = 1\n[sides]\nsource = [\"gpu/*\"]\n[sides.targets]\ncpu = [\"cpu/*\"]\nold = [\"old/*\"]\n"
          "[[pair]]\nsource = \"gpu/shade.cu:shade\"\ntarget = [\"cpu/shade.cpp:shade\", \"old/shade.cpp:shade\"]\n");
    commit("A second port", 2);
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Another threshold", 3);
    const auto both = nlohmann::json::parse(porttool({"audit", "--format", "json"}).out)["items"];
    ASSERT_EQ(both.size(), 1) << both;
    change("cpu/shade.cpp", "level < 0.001f", "level < 0.0001f");
    commit("Port it", 4);
    const auto one = nlohmann::json::parse(porttool({"audit", "--format", "json"}).out)["items"];
    ASSERT_EQ(one.size(), 1) << one;
    EXPECT_EQ(one[0]["target"], "old/shade.cpp:shade");
    EXPECT_NE(one[0]["why"].dump().find("another port of the same function has it"), std::string::npos) << one;
    EXPECT_GT(one[0]["certainty"].get<double>(), both[0]["certainty"].get<double>());
}

TEST_F(Audit, WhatIsOlderThanTheOtherSideIsLessCertain) {
    const auto tone = [](const std::string& text) {
        return replaced(replaced(text, "shade", "tone"), "0.01f", "0.07f");
    };
    const auto says = [](const nlohmann::json& item) {
        return item["why"].dump().find("written after") != std::string::npos;
    };
    write("cpu/tone.cpp", tone(kCppShade));
    commit("Tones", 2);
    for (const std::string file : {"cpu/shade.cpp", "cpu/tone.cpp"})
        change(file, "    if (level", "    if (std::isnan(level)) return 0.5f;\n    if (level");
    commit("Fix NaN of degenerate triangles", 3);
    write("gpu/tone.cu", tone(kCudaShade));
    std::filesystem::rename(root / "gpu/shade.cu", root / "gpu/shading.cu");
    commit("Tones on the GPU", 4);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << "one edit of two pairs: " << found;
    EXPECT_EQ(found[0]["source"], "gpu/shading.cu:shade") << "the more certain of them stands for both";
    EXPECT_FALSE(says(found[0])) << "a file that got another name was not written anew";
    change("gpu/shading.cu", "    if (level", "    if (isnan(level)) return 0.5f;\n    if (level");
    commit("Port it", 5);
    const auto left = items();
    ASSERT_EQ(left.size(), 1) << left;
    EXPECT_EQ(left[0]["source"], "gpu/tone.cu:tone");
    EXPECT_TRUE(says(left[0])) << left[0];
}

TEST_F(Audit, SinceLeavesOutWhatIsOlder) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 5);
    EXPECT_EQ(items({"--since", "2026-01-04"}).size(), 1);
    EXPECT_EQ(items({"--since", "HEAD~1"}).size(), 1);
    EXPECT_TRUE(items({"--since", "2026-01-06"}).empty());
    EXPECT_TRUE(items({"--since", "HEAD"}).empty());
    const CommandRun unknown = audit({"--since", "v9.9"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_NE(unknown.err.find("--since v9.9: no such revision"), std::string::npos) << unknown.err;
}

TEST_F(Audit, ABranchThatWasMergedCountsByItsOwnCommits) {
    git("checkout -q -b fix");
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    const CommandRun at_branch = audit();
    git("checkout -q main");
    write("notes.txt", "notes\n");
    commit("Notes", 3);
    git("merge -q --no-ff -m 'Merge branch fix' fix");
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_NE(audit().out.find("Fix dark surfaces"), std::string::npos);
    EXPECT_EQ(at_branch.exit_code, 1);
}

TEST_F(Audit, WritesNothing) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    ASSERT_EQ(audit().exit_code, 1);
    EXPECT_FALSE(std::filesystem::exists(root / ".git/porttool"));
    EXPECT_FALSE(std::filesystem::exists(root / "portmap.toml"));
    git("diff --quiet HEAD && test -z \"$(git status --porcelain)\"");
}

TEST_F(Audit, TakesThePairsOfAMap) {
    write("portmap.toml",
          "version = 1\n[sides]\nsource = [\"gpu/*\"]\ntarget = [\"cpu/*\"]\n[[pair]]\n"
          "source = \"gpu/shade.cu:shade\"\ntarget = \"cpu/shade.cpp:shade\"\n");
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    const CommandRun got = porttool({"audit", "--format", "json"});
    EXPECT_EQ(got.exit_code, 1) << got.err;
    EXPECT_EQ(nlohmann::json::parse(got.out)["items"].size(), 1);
}

TEST_F(Audit, AShallowCloneIsTold) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    change("gpu/shade.cu", "+ 0.01f", "+ 0.02f");
    commit("Fix the ambient term", 3);
    git("clone -q --depth 2 'file://" + root.string() + "' shallow");
    const CommandRun got =
        porttool({"audit", "--source", "gpu/*", "--target", "cpu/*", "--format", "json"}, (root / "shallow").string());
    EXPECT_EQ(got.exit_code, 1) << got.err;
    const auto found = nlohmann::json::parse(got.out);
    EXPECT_EQ(found["shallow"], true);
    EXPECT_EQ(found["items"][0]["date"], "2026-01-03");
    EXPECT_NE(got.err.find("git fetch --unshallow"), std::string::npos) << got.err;
}

TEST_F(Audit, ProposesThePort) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    const auto found = items();
    ASSERT_EQ(found.size(), 1);
    ASSERT_TRUE(found[0]["patch"].is_string()) << found[0];
    write("port.patch", found[0]["patch"]);
    git("apply port.patch && rm port.patch");
    std::stringstream text;
    text << std::ifstream(root / "cpu/shade.cpp").rdbuf();
    EXPECT_EQ(text.str(), replaced(kCppShade, "0.001f", "0.0001f"));
}

TEST_F(Audit, IgnoreSettlesAnItemForGood) {
    git("rm -q --cached -r . && true");
    ASSERT_EQ(porttool({"init", "--source", "gpu/*", "--target", "cpu/*"}).exit_code, 0);
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    ASSERT_EQ(porttool({"audit"}).exit_code, 1);
    ASSERT_EQ(porttool({"ignore", "gpu/shade.cu:shade=cpu/shade.cpp:shade", "--reason", "meant so"}).exit_code, 0);
    EXPECT_EQ(porttool({"audit"}).exit_code, 0);
}

/// Units of one line each, as they were on both sides and as one side has them now.
struct HandMade {
    const char *name, *before, *now;
    bool is_item;
    const char* there = nullptr;  ///< what the other side says, where it is not what was before
};

/// Holds what audit lists against the labels.
class HandMadeAudit : public Audit {
protected:
    void expect_items(std::span<const HandMade> all) {
        std::string gpu, cpu, edited;
        for (const HandMade& one : all) {
            const std::string head =
                std::string("float ") + one.name +
                "(const float* w, const float* v, const float* x, int* row, float* out, float level, "
                "float sum, float wide, bool flat, bool open, int n, int k, int col, int stride, int "
                "step) { float base = w[0] * level + v[0]; sum += base * 0.5f; ";
            const std::string tail = " return sum * base + level * 0.25f; }\n";
            gpu += "__device__ " + head + one.before + tail;
            cpu += head + (one.there != nullptr ? one.there : one.before) + tail;
            edited += "__device__ " + head + one.now + tail;
        }
        write("gpu/all.cu", gpu);
        write("cpu/all.cpp", cpu);
        commit("More", 2);
        write("gpu/all.cu", edited);
        commit("Some of these matter", 3);
        std::set<std::string> found, wanted;
        for (const auto& item : items()) {
            if (item["commit"].is_null()) continue;                // a difference of today, whoever is right
            if (item["certainty"].get<double>() < 0.45) continue;  // beneath the line, as doubtful
            const std::string id = item["source"];
            found.insert(id.substr(id.find(':') + 1));
        }
        for (const HandMade& one : all)
            if (one.is_item) wanted.insert(one.name);
        EXPECT_EQ(found, wanted);
    }
};

// Labelled by reading: what a maintainer of the other side would want to know, and what says the same otherwise.
TEST_F(HandMadeAudit, Edits) {
    const HandMade all[] = {
        {"label", "switch (k) { case A_ADD: case A_MUL: x = 2.0f * w; break; default: x = w; }",
         "switch (k) { case A_ADD: case A_MUL: case A_DIV: x = 2.0f * w; break; default: x = w; }", true},
        {"guard", "for (int i = 0; i < n; ++i) sum += w[i] * v[i];",
         "for (int i = 0; i < n; ++i) if (v[i] > 0.0f) sum += w[i] * v[i];", true},
        {"index", "const float xi = x[col]; sum += xi * xi + w[col];",
         "const float xi = x[col * stride]; sum += xi * xi + w[col];", true},
        {"term", "if (wide || (flat && open)) level = level * 2.0f + w[k];", "if (wide) level = level * 2.0f + w[k];",
         true},
        {"braces", "if (wide > 2.0f) level = w[k] + 2.0f; sum += level;",
         "if (wide > 2.0f) { level = w[k] + 2.0f; } sum += level;", false},
        {"loop", "for (int i = 0; i < k; i += step) sum += level * 2.0f;",
         "for (int n = 0; n < k; n += step) sum += level * 2.0f;", false},
        {"cast", "sum += load((int*)&(row[k]), 1) + level * w[k];", "sum += load(&row[k], 1) + level * w[k];", false},
        {"steps", "for (int i = 0; i < k; i++) sum += level * w[i];",
         "for (int i = 0; i < k; i += 1) sum += level * w[i];", false},
        {"turned", "if (k >= n) return level; sum += level * w[k];",
         "if (k < n) { sum += level * w[k]; } else { return level; }", false},
        {"sign", "if (k >= n) sum += level * w[k] * v[col];", "if (k < n) sum += level * w[k] * v[col];", true},
        {"cached", "sum += level * w[k] * v[col]; level = sum;",
         "const float held = w[k]; sum += level * held * v[col]; level = sum;", false},
        {"spread", "sum += level * w[k]; level = v[k] * 2.0f;",
         "if (sum < wide * v[n]) level = wide; sum += level * w[k]; level = v[k] * 2.0f;", false,
         "const float bar = wide * v[n]; if (sum < bar) level = wide; sum += level * w[k]; level = v[k] * 2.0f;"},
        {"worker", "sum += w[n] * 0.5f; level += v[k] * sum;",
         "const int lane = threadIdx.x; if (lane != row[blockIdx.x]) sum += w[n] * 0.5f; level += v[k] * sum;", false,
         "if (n != row[step]) sum += w[n] * 0.5f; level += v[k] * sum;"},
        {"held", "sum += fmax(flat ? level : wide, 0.0f) * w[k]; level *= 2.0f;",
         "const float most = flat ? level : wide; sum += fmax(most, 0.0f) * w[k]; level *= 2.0f;", false},
        {"read", "sum += add(level, v[k]) * w[n]; level *= 2.0f;",
         "sum += add(level, __ldg(&v[k])) * w[n]; level *= 2.0f;", false},
        {"place", "load(&row[k], level, n); sum += level * w[n];", "load(row + k, level, n); sum += level * w[n];",
         false},
        {"comma", "if (flat) out[k] = level, row[k] = n, out[n] = wide; sum += level * w[n];",
         "if (flat) { out[k] = level; row[k] = n; out[n] = wide; } sum += level * w[n];", false},
        {"macros", "CASES(A_ADD, B_ADD) CASES(A_MUL, B_MUL) CASES(A_SUB, B_SUB) sum += level * w[n];",
         "CASES(A_ADD, B_ADD) CASES(A_MUL, B_MUL) CASES(A_DIV, B_DIV) CASES(A_SUB, B_SUB) sum += level * w[n];", true},
        {"named", "sum += level * w[k]; level = v[k] * wide;",
         "const float least = w[n] * wide - v[n]; sum += fmax(level, least) * w[k]; level = v[k] * wide;", true},
        {"stored", "out[k] = v[k] + level * w[k]; sum += level;", "out[k] = v[k] - level * w[k]; sum += level;", true},
        {"cleared", "out[k] = 0.0f; sum += level;", "out[k] = 1.0f; sum += level;", true},
        {"limit", "const float limit = 0.001f; if (level < limit) sum += w[k];",
         "const float limit = 0.0001f; if (level < limit) sum += w[k];", true},
        {"wider", "const int at = n * stride + k; sum += w[at] * level;",
         "const int64_t at = n * stride + k; sum += w[at] * level;", true},
        {"which", "sum += level * row[0] + w[k]; level *= 2.0f;", "sum += level * row[1] + w[k]; level *= 2.0f;", true},
        {"order", "sum += reach(level, w, n); level *= 2.0f;", "sum += reach(level, w, n, step); level *= 2.0f;", false,
         "sum += reach(level, step, w, n); level *= 2.0f;"},
        {"nothing", "if (row == NULL) level = w[k] * 2.0f;", "if (!row) level = w[k] * 2.0f;", false},
        {"second", "if (flat) row[k + n] = 7; sum += level * v[n];",
         "if (flat) row[k + n] = 7; else row[k + n] = 3; sum += level * v[n];", true},
        {"vector", "sum += reach(float4(hit.p, level)) * w[k]; level *= 2.0f;",
         "sum += reach(float4(hit.p.x, hit.p.y, hit.p.z, level)) * w[k]; level *= 2.0f;", false},
        {"zeros", "sum += reach(flat ? hit.p : float4()) * w[k]; level *= 2.0f;",
         "sum += reach(flat ? hit.p : float4(0.0f, 0.0f, 0.0f, 0.0f)) * w[k]; level *= 2.0f;", false},
        {"swapped", "swap(row[n], row[k]); sum += level * w[k];",
         "const int kept = row[n]; row[n] = row[k]; row[k] = kept; sum += level * w[k];", false},
        {"digits", "if (wide > -1e-21 && wide < 1e-21) level = w[k];",
         "if (wide > -1e-6f && wide < 1e-6f) level = w[k];", false},
        {"null", "level = w[k] * 2.0f; *out = level + 1.0f; sum += level;",
         "level = w[k] * 2.0f; if (out) *out = level + 1.0f; sum += level;", false},
    };
    expect_items(all);
}

TEST_F(HandMadeAudit, EditsThatChangeNoNumber) {
    const HandMade all[] = {
        {"bound", "const int at = blockIdx.x * 64 + threadIdx.x; sum += level * w[at];",
         "const int at = blockIdx.x * 64 + threadIdx.x; if (at >= n * step) return 0.0f; sum += level * w[at];", false,
         "for (int i = 0; i < n * step; ++i) sum += level * w[i];"},
        {"exit", "sum += level * w[k]; for (int i = 0; i < n; ++i) sum += level * w[i];",
         "if (k >= n * step) return 0.0f; sum += level * w[k]; for (int i = 0; i < n; ++i) sum += level * w[i];", true},
        {"thread", "const int at = threadIdx.x; sum += level * w[at] + v[at * 3] * wide; level *= 3.0f;",
         "const int column = blockIdx.x * 64 + threadIdx.x; sum += level * w[column] + v[column * 3] * wide; level *= "
         "3.0f;",
         false, "for (int at = 0; at < n; ++at) { sum += level * w[at] + v[at * 3] * wide; level *= 3.0f; }"},
        {"strides", "for (int i = k; i < n; i += step) sum += level * w[i]; level *= 3.0f;",
         "for (int i = 0; i < n; ++i) sum += level * w[i]; level *= 3.0f;", false,
         "const int from = threadIdx.x; for (int i = from; i < n; i += step) sum += level * w[i]; level *= 3.0f;"},
        {"turns", "sum += level * w[k]; level *= 3.0f; out[k] = sum * 2.0f + v[k];",
         "sum += level * w[k]; level *= 3.0f; for (int i = 0; i < n * step; ++i) out[i] = sum * 2.0f + v[i];", false,
         "const int i = threadIdx.x; sum += level * w[k]; level *= 3.0f; out[i] = sum * 2.0f + v[i];"},
        {"parts", "hit.p -= dir * (level * wide); level *= 3.0f;",
         "hit.p.x -= dir.x * (level * wide); hit.p.y -= dir.y * (level * wide); hit.p.z -= dir.z * (level * wide); "
         "level "
         "*= 3.0f;",
         false, "hit.p.xyz -= dir.xyz * (level * wide); level *= 3.0f;"},
        {"twice", "const int at = k + n; sum += level * w[at] + v[at * 3] * wide; level *= 3.0f;",
         "const int at = k + n; const int later = at * 2; sum += level * w[later] + v[at * 3] * wide; level *= 3.0f;",
         true},
        {"halves", "sum += 1.0f / (2.0f * sqrtf(level / wide)) + w[k]; level *= 3.0f;",
         "sum += 0.5f / sqrtf(level / wide) + w[k]; level *= 3.0f;", false},
        {"quarters", "sum += 1.0f / (4.0f * sqrtf(level / wide)) + w[k]; level *= 3.0f;",
         "sum += 0.5f / sqrtf(level / wide) + w[k]; level *= 3.0f;", true},
        {"choice", "if (k < min(n, step) && col + k < n) sum += level * w[k];",
         "if (k < (n < step ? n : step) && col + k < n) sum += level * w[k];", false},
    };
    expect_items(all);
}

// Each of the first kind beside one of the second that is nearly like it.
TEST_F(HandMadeAudit, EditsThatEachSideMakesInItsOwnWay) {
    const HandMade all[] = {
        {"message", "sum += level * w[k]; level *= 3.0f;",
         "sum += level * w[k]; for (int i = 0; i < n; ++i) printf(\"%f\", w[i]); level *= 3.0f;", false},
        {"refuses", "sum += level * w[k]; level *= 3.0f;",
         "if (k > n * col) throw std::runtime_error(\"too many\"); sum += level * w[k]; level *= 3.0f;", true},
        {"repeat", "sum += level * w[k]; out[k] = sum + v[k] * wide; level *= 3.0f;",
         "sum += level * w[k]; for (int i = 0; i < n * step; ++i) out[i] = sum + v[i] * wide; level *= 3.0f;", true},
        {"either",
         "for (int i = k; i < n; ++i) out[k] += level * w[i]; if (level > w[n] * wide + out[k]) row[col] = 3;",
         "for (int i = k; i < n; ++i) out[k] += level * w[i];\n#ifdef AS_ONE\nif (open && level > w[n] * wide * "
         "v[step]) "
         "row[col] = 3;\n#else\nif (level > w[n] * wide + out[k]) row[col] = 3;\n#endif\n",
         false, "for (int i = k; i < n; ++i) out[k] += level * w[i]; if (level > out[k] + x[0]) row[col] = 3;"},
        {"both", "\n#ifdef ONE_BY_ONE\nsum += level * w[k];\n#else\nsum += wide * w[k];\n#endif\nlevel *= 3.0f;",
         "\n#ifdef ONE_BY_ONE\nif (open && v[col] < 2.0f) sum += level * w[k];\n#else\nif (open && v[col] < 2.0f) sum "
         "+= wide * w[k];\n#endif\nlevel *= 3.0f;",
         true},
        {"clocks", "sum += level * w[k]; level = diff * 1000 / CLOCKS_PER_SEC + v[n];",
         "sum += level * w[k]; level = diff * 1e-6f + v[n];", false},
        {"typed", "const float angle = level + 1e-61f; sum += angle * w[k];",
         "const REAL angle = level + 1e-30f; sum += angle * w[k];", false,
         "const double angle = level + 1e-61; sum += angle * w[k];"},
        {"tiny", "const float angle = level + 1e-31f; sum += angle * w[k];",
         "const REAL angle = level + 1e-30f; sum += angle * w[k];", true},
        {"lies", "sum += rows[n][k] * w[k] + level; level *= 3.0f;",
         "sum += rows[n * stride + k] * w[k] + level; level *= 3.0f;", false},
        {"jumps", "sum += w[n + k] * level + v[k]; level *= 3.0f;",
         "sum += w[n * stride + k] * level + v[k]; level *= 3.0f;", true},
        {"copied", "out[k] = level * w[k] + v[k]; sum += level;",
         "float held[4]; out[k] = held[0] = level * w[k] + v[k]; sum += level;", false,
         "out[k] = level * w[k] + v[k]; sum += level;"},
        {"second", "std::vector<float> kept(n), lost(n); sum += level * w[k];",
         "std::vector<float> kept(n, 0.0f), lost(n, 0.0f); sum += level * w[k];", false},
        {"ones", "std::vector<float> kept(n), lost(n); sum += level * w[k];",
         "std::vector<float> kept(n, 1.0f), lost(n, 1.0f); sum += level * w[k];", true},
        {"reused",
         "int at = n + step; const int x0 = at % 4; at = at / 4; const int y0 = at % (k + col); sum += w[x0] * v[y0];",
         "int at = n + step; const int x0 = at % 4; int row0 = at / 4; const int y0 = row0 % (k + col); sum += w[x0] * "
         "v[y0];",
         false},
        {"other",
         "int at = n + step; const int x0 = at % 4; at = at / 4; const int y0 = at % (k + col); sum += w[x0] * v[y0];",
         "int at = n + step; const int x0 = at % 4; at = at / 4; const int y0 = step % (k + col); sum += w[x0] * "
         "v[y0];",
         true},
        {"start", "Turn turn; turn.around(level); sum += turn.of(w[k]); level *= 3.0f;",
         "Turn turn; turn.first = float3(1.0f, 0.0f, 0.0f); turn.around(level); sum += turn.of(w[k]); level *= 3.0f;",
         false, "RotationMatrix turn; turn.around(level); sum += turn.of(w[k]); level *= 3.0f;"},
        {"clamped", "sum += level * w[k]; level *= 3.0f;",
         "sum += level * w[k]; if (sum < level * wide) sum = level * wide; level *= 3.0f;", false,
         "sum += level * w[k]; sum = fmax(sum, wide * level); level *= 3.0f;"},
        {"capped", "sum += level * w[k]; level *= 3.0f;",
         "sum += level * w[k]; if (sum < level * wide) sum = level * wide; level *= 3.0f;", true,
         "sum += level * w[k]; sum = fmin(sum, wide * level); level *= 3.0f;"},
        {"parted", "sum += level * w[k]; level *= 3.0f;",
         "sum += level * w[k]; if (stride > 3 && open) sum = level * wide; level *= 3.0f;", false,
         "sum += level * w[k];\n#ifdef LEVELS\nif (stride > 3) sum = level * wide;\n#endif\nlevel *= 3.0f;"},
    };
    expect_items(all);
}

TEST_F(HandMadeAudit, EditsThatTheOtherSideHasByAnotherWay) {
    const HandMade all[] = {
        {"seeded", "sum += draw(stage, step, scene->getSeed()) * w[k]; level *= 3.0f;",
         "sum += draw(stage, step, seed) * w[k]; level *= 3.0f;", false},
        {"reseeded", "sum += draw(stage, step, scene->getSeed()) * w[k]; level *= 3.0f;",
         "sum += draw(stage, k, scene->getSeed()) * w[k]; level *= 3.0f;", true},
        {"memory", "fill(n, sizes.get_data(), parts.get_data()); sum += level * w[k];",
         "fill(n, sizes, parts); sum += level * w[k];", false},
        {"typed", "using real = float; const real held = v[0] * wide; sum += held * w[k];",
         "using real = float; const real held = static_cast<real>(v[0] * wide); sum += held * w[k];", false},
        {"placed", "hold(&rows(k), level, n); sum += level * w[n];",
         "hold(rows.data() + k, level, n); sum += level * w[n];", false},
        {"misplaced", "hold(&rows(k), level, n); sum += level * w[n];",
         "hold(rows.data() + k * stride, level, n); sum += level * w[n];", true},
        {"wrapped", "sum += level * w[k]; level *= 3.0f;",
         "sum += level * w[k];\n#if defined(FIRST_ARCH) || defined(NEXT_ARCH)\nwait_all();\n#endif\nlevel *= 3.0f;",
         false},
        {"converted", "sum += level * load(v) + w[k];", "sum += level * load(as_device_type(v)) + w[k];", false},
        {"asked", "sum += level * w[k]; level *= 3.0f;",
         "sum += level * w[k]; if (scene->fogEnabled && scene->fogShadows) sum = level * wide; level *= 3.0f;", false,
         "sum += level * w[k];\n#if (defined(FOG) && defined(SHADOWS))\nif (scene->fogShadows) sum = level * "
         "wide;\n#endif\nlevel *= 3.0f;"},
        {"unasked", "sum += level * w[k]; level *= 3.0f;",
         "sum += level * w[k]; if (stride > 3 && wide > v[n] * step) sum = level * wide; level *= 3.0f;", true,
         "sum += level * w[k];\n#if (defined(FOG) && defined(SHADOWS))\nsum += step;\n#endif\nlevel *= 3.0f;"},
        {"gathered", "out[0] = x[k] * x[k] * level; sum += wide;", "out[0] += x[k] * x[k] * level; sum += wide;", false,
         "float held[2]; held[0] = x[k] * x[k] * level; sum += wide; out[0] += held[0];"},
        {"added", "out[0] = x[k] * x[k] * level; sum += wide;", "out[0] += x[k] * x[k] * level; sum += wide;", true},
        {"labels", "switch (k) { case kDustCloud: sum = w[0]; break; default: sum = w[1]; }",
         "switch (k) { case kDustCloud: sum = w[0]; break; case kSilverMirror: sum = w[2]; break; default: sum = w[1]; "
         "}",
         false,
         "switch (k) { case kDustCloud: sum = w[0]; break; case clkSilverMirror: sum = w[3]; break; default: sum = "
         "w[1]; }"},
    };
    expect_items(all);
}

TEST(AuditValues, AreTheSameWhereRealNumbersAre) {
    const auto words = [](const std::string& text) {
        std::istringstream in(text);
        return std::vector<std::string>(std::istream_iterator<std::string>(in), {});
    };
    struct Row {
        const char *a, *b;
        bool same;
    };
    // By algebra; NaNs, infinities and division by zero count, the order of rounding does not.
    for (const Row& row : {Row{"x = a / 2f", "x = a * 0.5f", true},
                           Row{"x = a / 2f", "x = 0.25f * ( a + a )", true},
                           Row{"x = a / 2 + a / 2", "x = a", false},  // perhaps integers, which this does not know
                           Row{"x = n / 2 * 2", "x = n", false},
                           Row{"x = pow ( a , 2f )", "x = a * a", true},
                           Row{"x = a > b ? a : b", "x = max ( a , b )", true},
                           Row{"x = a > b ? b : a", "x = max ( a , b )", false},
                           Row{"x = a < 0f ? - a : a", "x = fabs ( a )", true},
                           Row{"x = a < 0f ? a : - a", "x = fabs ( a )", false},
                           Row{"x = max ( a , 0f )", "x = a", false},
                           Row{"x = max ( fabs ( a ) , 1e-20f )", "x = fabs ( a )", false},
                           Row{"x = a / b", "x = a / ( b + 1e-20f )", false},
                           Row{"x = min ( a , 1e6f )", "x = a", false},
                           Row{"if ( a < b )", "if ( a <= b )", false},
                           Row{"if ( a < b )", "if ( b > a )", true},
                           Row{"if ( a + b < c * 2f )", "if ( 2f * c > b + a )", true},
                           Row{"return f ( a , b )", "return f ( b , a )", false},
                           Row{"return f ( a * 2f )", "return f ( a + a * 1f )", true},
                           Row{"x [ i ] = a", "x [ j ] = a", false},
                           Row{"x = a - b", "x = b - a", false},
                           Row{"x = v . x * 2f", "x = v . y * 2f", false},
                           Row{"x = a == b", "x = b == a", true},
                           Row{"x = a & b", "x = b & a", true},
                           Row{"x = a % b", "x = b % a", false},
                           Row{"x = fma ( a , b , c )", "x = a * b + 1f * c", true},
                           Row{"x = sqrt ( - a * a - 1f )", "x = log ( - a * a )", false},
                           Row{"x = 0.1f", "x = 0.10f", true},
                           Row{"x = 0.1f", "x = 0.2f", false},
                           Row{"x = ( a", "x = ( a", false}}) {
        EXPECT_EQ(give_the_same_value(words(row.a), words(row.b)), row.same) << row.a << "   " << row.b;
        EXPECT_EQ(give_the_same_value(words(row.b), words(row.a)), row.same) << row.b << "   " << row.a;
    }
}

TEST_F(Audit, ReadsNoValueOfADepthThatNobodyWrites) {
    constexpr size_t kDeep = 100'000;
    const std::vector<std::vector<std::string>> nests = {
        {"!"},          {"-"}, {"("}, {"f", "("}, {"a", "["}, {"a", "?"}, {"a", "?", "a", ":"}, {"static_cast", "<"},
        {"a", "*", "("}};
    for (const std::vector<std::string>& nest : nests) {
        std::vector<std::string> text = {"x", "="};
        for (size_t i = 0; i < kDeep; ++i) text.insert(text.end(), nest.begin(), nest.end());
        text.emplace_back("a");
        EXPECT_FALSE(give_the_same_value(text, {"x", "=", "b"})) << nest.back();
    }
}

TEST_F(Audit, ACallerIsNoPortOfWhatItCalls) {
    const std::string body =
        "(const float* w, float level, int n) {\n    float sum = level * 0.5f;\n"
        "    for (int i = 0; i < n; ++i) sum += w[i] * level;\n";
    write("gpu/total.cu", "__device__ float total_gpu" + body + "    return sum;\n}\n");
    write("cpu/total.cpp", "float total" + body + "    return sum + total_gpu(w, level, n);\n}\n");
    commit("Totals", 2);
    change("gpu/total.cu", "w[i] * level", "w[i] * level * level");
    commit("Fix the sum", 3);
    EXPECT_EQ(items(), nlohmann::json::array());
    change("cpu/total.cpp", " + total_gpu(w, level, n)", "");
    commit("On its own", 4);
    EXPECT_EQ(items().size(), 1) << "without the call it is one";
}

// A function that was cut into two on the other side, under names of their own: the edit is found by its text.
TEST_F(Audit, WhatAFunctionDoesThatTheOtherSideCallsIsSaidThere) {
    const std::string head = "float march(const float* ray, float* spot, float far_away) {\n",
                      start = "    spot[0] = ray[0] * far_away;\n    spot[1] = ray[1] * far_away;\n",
                      end = "    float sum = spot[0] * 0.25f + spot[1];\n    return sum * far_away + 0.5f;\n}\n";
    for (const bool calls : {true, false}) {
        write("gpu/march.cu",
              "__device__ void begin_march(float* spot) {\n    spot[3] = turned_normal * opening_weight(spot[4]);\n}\n"
              "__device__ " +
                  head + (calls ? "    begin_march(spot);\n" : "") + start + end);
        write("cpu/march.cpp", head + start + end);
        commit("March", calls ? 2 : 4);
        change("cpu/march.cpp", start, start + "    far_away = turned_normal * opening_weight(ray[2]);\n");
        commit("Fix the start of the march", calls ? 3 : 5);
        EXPECT_EQ(items().size(), calls ? 0 : 1);
    }
}

TEST_F(Audit, FindsTheTextFromBeforeInAnotherFunction) {
    const std::string lit =
        "    float fall = 1.0f / (distance * distance + radius);\n"
        "    float cone = clamp(angle * slope + offset, 0.0f, 1.0f);\n"
        "    float scale = power * fall * cone;\n";
    write(
        "gpu/light.cu",
        "__device__ float spot(float distance, float radius, float angle, float slope, float offset, float power) {\n" +
            lit + "    return scale;\n}\n");
    write(
        "cpu/lamps.cpp",
        "struct Lamp { int kind; };\nfloat emit_all(const Lamp* lamps, int count, float distance, float radius, float "
        "angle, float slope, float offset, float power) {\n    float sum = 0.0f;\n    for (int i = 0; i < count; ++i) "
        "{\n"
        "        if (lamps[i].kind == 0) { sum += power; continue; }\n" +
            lit +
            "        sum += scale;\n    }\n    if (count == 0) return offset;\n    sum = sum * 0.5f + offset * count;\n"
            "    return sum / (count + power);\n}\n");
    commit("Lights", 2);
    EXPECT_EQ(items(), nlohmann::json::array());
    change("gpu/light.cu", "angle * slope + offset, 0.0f, 1.0f", "angle * slope - offset, 0.0f, 1.0f");
    commit("Fix the sign of the offset", 3);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/light.cu:spot");
    EXPECT_EQ(found[0]["target"], "cpu/lamps.cpp:emit_all");
    change("cpu/lamps.cpp", "angle * slope + offset, 0.0f, 1.0f", "angle * slope - offset, 0.0f, 1.0f");
    commit("The same here", 4);
    EXPECT_EQ(items(), nlohmann::json::array());
}

TEST_F(Audit, AnItemSaysBehindWhatItStands) {
    change("gpu/shade.cu", "    return level", "    level += albedo * cosine * 0.5f;\n    return level");
    commit("Fix the missing term", 2);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    const std::string summary = found[0]["summary"];
    EXPECT_NE(summary.find("the target lacks `level += albedo * cosine * 0.5f`"), std::string::npos) << summary;
    EXPECT_NE(summary.find("behind `return 0f` here"), std::string::npos) << summary;
}

// A pair of two names says less where one of the two has a port of its own name.
TEST_F(Audit, APairBesideNamesakesIsLessCertain) {
    const auto kernel = [](const std::string& name, const std::string& bound, const std::string& extra) {
        return "float " + name + "(const float* w, float level, int n) {\n    float sum = level * 0.5f;\n" +
               "    for (int i = 0; i < n; ++i) sum += w[i] * level + " + bound + ";\n" + extra +
               "    if (sum < 0.001f) return 0.0f;\n    return sum * level;\n}\n";
    };
    const auto certainty = [&](const std::string& there) {
        for (const auto& item : items({"--limit", "100"}))
            if (item["target"] == "cpu/forward.cpp:" + there) return item["certainty"].get<double>();
        return -1.0;
    };
    write("gpu/forward.cu", "__device__ " + kernel("forward", "1.0f", ""));
    write("cpu/forward.cpp", kernel("forward_half", "1.0f", ""));
    commit("Forward", 2);
    change("gpu/forward.cu", "sum < 0.001f", "sum < 0.0001f");
    commit("Fix the bound", 3);
    const double alone = certainty("forward_half");
    EXPECT_GT(alone, 0.5);
    write("cpu/forward.cpp", kernel("forward", "1.0f", "") + kernel("forward_half", "1.0f", ""));
    commit("One of the same name", 4);
    EXPECT_GT(certainty("forward"), 0.5);
    EXPECT_LT(certainty("forward_half"), alone);
}

TEST_F(Audit, WhatIsUnlikelyIsListedWhereManyAreAskedFor) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    change("gpu/shade.cu", "albedo * weight * 0.3183f", "albedo * scale(weight)");
    commit("Simplify: vectorised, faster, one cache line less", 3);
    const auto few = items();
    ASSERT_EQ(few.size(), 2) << "of one pair all is listed";
    EXPECT_LT(few[1]["certainty"], 0.25);
    add_pairs(20);
    EXPECT_EQ(items().size(), 1);
    const auto found = items({"--limit", "21"});
    ASSERT_EQ(found.size(), 2);
    EXPECT_LT(found[1]["certainty"], 0.25);
}

TEST_F(Audit, AnEditAmongWhatTheOtherSideSaysOtherwiseIsLessCertain) {
    const auto certainty_of = [&](const std::string& name, const std::string& before, const std::string& behind) {
        const std::string head =
            "float " + name + "(const float* lut, float level, float white, int n) {\n    float out = level * 0.5f;\n";
        const std::string edited = "    out = clamp_to(out * white, level * 0.25f, 0.75f);\n";
        const std::string tail = "    return out;\n}\n";
        write("gpu/" + name + ".cu", "__device__ " + head +
                                         "    out += lut[n] * level;\n    out = out / (out + white);\n" + edited +
                                         "    if (out > white) out = white;\n    out *= lut[0];\n" + tail);
        write("cpu/" + name + ".cpp", head + before + edited + behind + tail);
        commit("Tones", 2);
        change("gpu/" + name + ".cu", "0.75f", "0.85f");
        commit("Another upper bound of tones", 3);
        for (const auto& item : items({"--limit", "100"}))
            if (item["source"] == "gpu/" + name + ".cu:" + name) return item;
        return nlohmann::json();
    };
    const auto same = certainty_of("tone", "    out += lut[n] * level;\n    out = out / (out + white);\n",
                                   "    if (out > white) out = white;\n    out *= lut[0];\n");
    const auto other = certainty_of("grade", "    scale_by(out, lut, n);\n    compress(out, white, 2.0f);\n",
                                    "    limit_tone(out, white);\n    finish(out, lut);\n");
    ASSERT_TRUE(same.is_object());
    ASSERT_TRUE(other.is_object());
    EXPECT_GT(same["certainty"], 0.8);
    EXPECT_LT(other["certainty"].get<double>(), same["certainty"].get<double>() - 0.05) << other;
    EXPECT_NE(same["why"].dump().find("stands on the other side, too"), std::string::npos) << same;
    EXPECT_EQ(other["why"].dump().find("stands on the other side, too"), std::string::npos) << other;
}

TEST_F(Audit, TheLastLineSaysThatLessCertainOnesAreLeftOut) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 2);
    EXPECT_EQ(audit().out.find("less certain: --limit 1000"), std::string::npos);
    change("gpu/shade.cu", "albedo * weight * 0.3183f", "albedo * scale(weight)");
    commit("Simplify: vectorised, faster, one cache line less", 3);
    for (const char* format : {"text", "markdown", "html"}) {
        const std::string shown = audit({"--format", format}).out;
        const size_t sure = shown.find("0.0001f"), line = shown.find("fewer than half"), unsure = shown.find("scale(");
        EXPECT_LT(sure, line) << shown;
        EXPECT_LT(line, unsure) << shown;
        EXPECT_NE(unsure, std::string::npos) << shown;
    }
    add_pairs(20);
    const CommandRun got = audit();
    EXPECT_EQ(got.out.find("fewer than half"), std::string::npos) << got.out;
    EXPECT_NE(got.out.find("1 of 2 items"), std::string::npos) << got.out;
    EXPECT_NE(got.out.find("less certain: --limit 1000"), std::string::npos) << got.out;
}

TEST_F(Audit, WithoutAPastOnlyWhatDiffersToday) {
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    git("add -A && git commit -q --amend -m All");
    const CommandRun got = audit({"--format", "json"});
    EXPECT_EQ(got.exit_code, 1);
    EXPECT_NE(got.err.find("a single commit"), std::string::npos) << got.err;
    const auto found = nlohmann::json::parse(got.out)["items"];
    ASSERT_EQ(found.size(), 1);
    EXPECT_TRUE(found[0]["commit"].is_null());
    EXPECT_LT(found[0]["certainty"], 0.5);
}

TEST_F(Audit, SaysWhereNoCommitEditedASide) {
    write("README", "Two sides.\n");
    commit("Nothing of the sides", 2);
    CommandRun got = audit();
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_NE(got.err.find("none of the 2 commits read edited a function"), std::string::npos) << got.err;
    EXPECT_EQ(audit({"--quiet"}).err, "");
    // Files that git does not know have no past either.
    write("new/a.cu", kCudaShade);
    write("old/a.cpp", kCppShade);
    got = porttool({"audit", "--source", "new/*", "--target", "old/*"});
    EXPECT_NE(got.err.find("none of the 2 commits read edited a function"), std::string::npos) << got.err;
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix dark surfaces", 3);
    EXPECT_EQ(audit().err, "");
}

TEST_F(Audit, ASlipIsToldOfSidesThatAreHardlyAlike) {
    write(
        "gpu/frame.cu",
        "__device__ void frame(float3 v, float3* a, float3* b) {\n    float len = sqrt(v.x * v.x + v.z * v.z);\n"
        "    if (len < 1e-5f) {\n        (*b).x = 1.0f;\n        (*b).y = 0.0f;\n        (*b).z = 0.0f;\n    } else {\n"
        "        (*b).x = -v.y / len;\n        (*b).y = v.x / len;\n        (*b).z = 0.0f;\n    }\n"
        "    *a = cross(v, *b);\n}\n");
    write("cpu/frame.cpp",
          "void frame(const Vec& v, Vec* a, Vec* b) {\n    float len = sqrtf(v.x * v.x + v.y * v.y);\n"
          "    if (len < 1e-5f) *b = Vec(1.0f, 0.0f, 0.0f);\n    else *b = Vec(-v.y / len, v.x / len, 0.0f);\n"
          "    *a = cross(v, *b);\n}\n");
    commit("Frames", 2);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/frame.cu:frame");
    EXPECT_TRUE(found[0]["commit"].is_null());
    EXPECT_LT(found[0]["certainty"], 0.25);
    EXPECT_NE(found[0]["summary"].get<std::string>().find("v.z * v.z"), std::string::npos) << found[0]["summary"];
}

// What differs today, of sides that are hardly alike: told where it looks like a slip of one side.
TEST_F(Audit, SlipsOfToday) {
    struct Row {
        const char *name, *source, *target;
        bool is_told;
    };
    const Row rows[] = {
        {"operand", "c.x *= g.x * k.y / 256.0f; c.y *= g.y * k.y / 256.0f; c.z *= g.z * k.y / 256.0f;",
         "c = c * g * k.y;", false},  // k.y is of another component than the rest: no run of components
        {"operands", "c.x *= g.x * level / 256.0f; c.y *= g.y * level / 256.0f; c.z *= g.z * level / 256.0f;",
         "c *= g * level;", true},
        {"components", "c.x *= g.x * level; c.y *= g.y * level; c.z *= g.z * level;", "c *= g * level;", false},
        {"bound", "wide = min(sum * level + base, 1.0f);", "wide = sum * level + base;", true},
        {"factor", "wide = sum * level * share + base;", "wide = sum * level + base; use(share);", true},
        {"sign", "wide = -sum * level + base;", "wide = sum * level + base;", true},
        {"later", "wide = sum * level * share + base;", "wide = sum * level + base; wide = wide * share;", false},
        {"asked", "if (level > share && sum > 0.5f && flat) wide = base;",
         "if (level > share && sum > 0.5f) wide = base; use(flat);", true},
        {"nulls", "if (!flat || !fogMode || !wide) return 0.0f;", "if (!flat || !fogMode) return 0.0f; use(wide);",
         false},
        {"around", "if (level > share && sum > 0.5f && flat) wide = base;",
         "if (flat) if (level > share && sum > 0.5f) wide = base;", false},
        {"by_switch", "if (level > share && sum > 0.5f && fogMode) wide = base;",
         "#ifdef FOG_MODE\nif (level > share && sum > 0.5f) wide = base;\n#endif\nuse(share);", false},
        {"tiny", "wide = sum * level / (share + 1e-30f);", "wide = sum * level / (share + 1e-20f);", false},
        {"truth", "state.lastVertexSeen = true;", "state.lastVertexSeen = false;", true},
        {"guard", "if (share < 0.001f) return 0.0f;", "use(share);", true},
        {"no_guard", "if (share < 0.001f) return share * level + base;", "use(share);", false},
        {"clamped", "if (share < 0.5f) share = 0.5f;", "share = max(share, 0.5f);", false},
        {"member", "o.point = base; o.delta = share * level;", "o.point = base; use(share);", true},
        {"renamed", "o.point = base; o.delta = share * level;", "o.point = base; o.offset = share * level;", false},
        {"filled", "o.point = base; o.delta = 0.0f;", "o.point = base;", false},
        {"longer_name", "o.point = base; o.deltaIndex = none(share);", "o.point = base; o.delta = none(share);", false},
        {"value", "o.delta = footprint(share);", "o.delta = share;", true},
        {"argument", "wide = heuristic(sum, base * share);", "wide = flat ? 1.0f : heuristic(sum, base); use(share);",
         true},
        {"argument_before", "wide = heuristic(sum, base * share);",
         "base *= share; wide = flat ? 1.0f : heuristic(sum, base);", false},
        {"argument_only_here", "wide = heuristic(sum, base * ownWeight);", "wide = flat ? 1.0f : heuristic(sum, base);",
         false},
        {"question",
         "bool mis = !flat && (isFar(o.light) || isLit(o.light)) && passes(o.light, level, a) && !h.inside;",
         "bool mis = !flat && Light_isFarOrLit(o.light) && passes(o.light, level, b); use(o.inside);", true},
        {"asked_before",
         "bool mis = !flat && (isFar(o.light) || isLit(o.light)) && passes(o.light, level, a) && !h.inside;",
         "if (o.inside) return 0.0f; bool mis = !flat && Light_isFarOrLit(o.light) && passes(o.light, level, b);",
         false},
        {"other_member", "wide = (flat ? 1.0f : -1.0f) * o.geometryN * level + sum;",
         "wide = (flat ? 1.0f : -1.0f) * o.shadeN * level + sum;", true},
        {"own_member", "wide = (flat ? 1.0f : -1.0f) * o.normalOfFace * level + sum;",
         "wide = (flat ? 1.0f : -1.0f) * o.faceN * level + sum;", false},
        {"loaded", "o.point = base; o.shadeN = load3(&o.geometryN.x) * level; wide = o.geometryN * sum * level;",
         "o.point = base; o.shadeN = o.geometryN * level; wide = vload3(0, &o.geometryN.x) * sum * level;", false},
        {"stored", "o.shadeN = cross(c, k) * level;", "store3(cross(c, k) * level, &o.shadeN.x);", false},
        {"held", "o.point = base; o.shadeN = cross(c, cross(k, c));",
         "k = cross(c, cross(k, c)); o.point = base; store3(k, &o.shadeN.x);", false},
        {"manner", "a = sum * level / 65536.0f; b = base * level / 65536.0f; wide = share * level / 65536.0f;",
         "a = sum * level; b = base * level; wide = share * level;", false},
    };
    std::string gpu =
        "__device__ float footprint(float x) { return x * 0.125f; }\n"
        "__device__ float normals_of_all(Point o) { return o.geometryN + o.shadeN; }\n";
    std::string cpu =
        "float footprint(float x) { return x * 0.125f; }\nfloat deltas(Point o) { return o.delta + o.deltaIndex; }\n"
        "float normals_of_all(Point o) { return o.geometryN + o.shadeN; }\n";
    std::set<std::string> wanted;
    for (const Row& row : rows) {
        const std::string head = std::string("float ") + row.name +
                                 "(float3 c, float3 g, float3 k, Point o, State state, float a, float b, float level, "
                                 "float share, float wide, float sum, bool flat, bool fogMode) {\n";
        const std::string first = "    float base = level * 0.5f + wide;\n    sum += base * level + 0.25f;\n    ";
        const std::string last = "\n    level = level * base + sum * wide;\n";
        gpu += "__device__ " + head + first + row.source + last + "    return level + tex(c, g).x;\n}\n";
        cpu += head + first + row.target + last + "    log_of(level); return level;\n}\n";
        if (row.is_told) wanted.insert(row.name);
    }
    write("gpu/slips.cu", gpu);
    write("cpu/slips.cpp", cpu);
    commit("Slips", 2);
    std::set<std::string> found;
    for (const auto& item : items({"--limit", "1000"})) {
        const std::string id = item["source"];
        EXPECT_TRUE(item["commit"].is_null());
        if (item["certainty"].get<double>() >= 0.29) found.insert(id.substr(id.find(':') + 1));
    }
    EXPECT_EQ(found, wanted);
}

// What was copied from a neighbour and not changed everywhere, one text tells, whether it has a pair or not.
TEST_F(Audit, AMemberOfAnotherGroupAmongThoseOfOne) {
    const auto arms = [](const std::string& odd) {
        return "    switch (m.type) {\n        case kMirror: r = f(m.mirror.kr, m.mirror.film, m.mirror.bump); break;\n"
               "        case kGlass: r = f(m.glass.kr, m.glass.kt, " +
               odd + "); break;\n    }\n";
    };
    const std::string reads = "float glass_bump(Material m) { return m.glass.bump + m.glass.film; }\n";
    const auto set = [&](const std::string& gpu, const std::string& cpu) {
        write("gpu/surfaces.cu",
              "__device__ float evaluate(Material m, float r) {\n" + arms(gpu) + "    return r;\n}\n");
        write("cpu/surfaces.cpp", reads + "float evaluateSurface(Material m, float r, int far) {\n" + arms(cpu) +
                                      "    return r * far;\n}\n");
        git("add -A && git commit -q --amend -m Surfaces");
        size_t told = 0;
        for (const auto& item : items())
            told += item["summary"].get<std::string>().find("among members") != std::string::npos ? 1 : 0;
        return told;
    };
    EXPECT_EQ(set("m.glass.bump, m.glass.n", "m.glass.bump, m.glass.n"), 0);
    EXPECT_EQ(set("m.mirror.bump, m.glass.n", "m.glass.bump, m.glass.n"), 1);
    EXPECT_EQ(set("m.glass.bump, m.glass.n", "m.mirror.bump, m.glass.n"), 1);
    EXPECT_EQ(set("m.mirror.bump, m.glass.bump", "m.glass.bump, m.glass.n"), 0);  // it means both
    EXPECT_EQ(set("m.mirror.tint, m.glass.n", "m.glass.bump, m.glass.n"), 0);     // glass has none
    EXPECT_EQ(set("m.glass.bump, m.glass.n); break;\n    }\n    { r = f(m.mirror.film", "m.glass.bump, m.glass.n"), 0);
    EXPECT_EQ(set("m.metal.bump, m.glass.n", "m.glass.bump, m.glass.n"), 0);  // nothing is about metal
}

// A function that goes by the name of a group is about that group.
TEST_F(Audit, AMemberOfAnotherGroupInAFunctionThatGoesByTheNameOfOne) {
    const auto set = [&](const std::string& odd) {
        write(
            "gpu/noise.cu",
            "__device__ float wood_eval(Texture t) { return t.wood.size + t.wood.depth * t.wood.mapping; }\n"
            "__device__ float clouds_eval(Texture t) {\n    return t.clouds.size * t.clouds.depth + t.clouds.hard * " +
                odd + ";\n}\n");
        write("cpu/noise.cpp", "float mapping_of_clouds(Texture t) { return t.clouds.mapping; }\n");
        git("add -A && git commit -q --amend -m Noise");
        size_t told = 0;
        for (const auto& item : items())
            told += item["summary"] ==
                            "the source reads `wood.mapping` among members of `clouds`, which has a `mapping`, too"
                        ? 1
                        : 0;
        return told;
    };
    EXPECT_EQ(set("t.wood.mapping"), 1);
    EXPECT_EQ(set("t.clouds.mapping"), 0);
    EXPECT_EQ(set("t.wood.mapping * t.clouds.mapping"), 0);  // it means both
    EXPECT_EQ(set("t.metal.mapping"), 0);                    // nothing goes by that name
}

// What a text says of itself is told of a function with a pair and without, and once of several.
TEST_F(Audit, WhatOneTextTellsIsNoItemWhereBothSidesMeanIt) {
    const auto lines = [](const std::string& qualifier, const std::string& name, const std::string& odd) {
        return qualifier + "float " + name + "(float3 p, float3 q, float far) {\n    float w[3];\n    w[2] = far;\n" +
               "    return p.x * q.x + " + odd + " * far;\n}\n";
    };
    const auto set = [&](const std::string& gpu, const std::string& cpu) {
        write("gpu/reach.cu", lines("__device__ ", "reach", gpu));
        write("cpu/reach.cpp", lines("", "reach", cpu));
        git("add -A && git commit -q --amend -m Reach");
        std::string told;
        for (const auto& item : items())
            if (const std::string summary = item["summary"]; summary.find(" itself") != std::string::npos ||
                                                             summary.find(" both sides of") != std::string::npos ||
                                                             summary.find(" elements") != std::string::npos)
                told += summary + "; ";
        return told;
    };
    EXPECT_EQ(set("(p.y - q.y)", "(p.y - q.y)"), "");
    EXPECT_EQ(set("(p.y - p.y)", "(p.y - q.y)"), "the source has `p . y` on both sides of `-`; ");
    EXPECT_EQ(set("(p.y - q.y)", "(p.y - p.y)"), "the target has `p . y` on both sides of `-`; ");
    EXPECT_EQ(set("(p.y - p.y)", "(p.y - p.y)"), "");
    // What nobody can mean is told all the same, once.
    EXPECT_EQ(set("w[3]", "w[3]"), "the source uses `w [ 3 ]`, and `w` has 3 elements; ");
    // Of two functions that say the same it is told once.
    write("gpu/more.cu", lines("__device__ ", "near_reach", "w[3]"));
    EXPECT_EQ(set("w[3]", "w[2]"), "the source uses `w [ 3 ]`, and `w` has 3 elements; ");
}

TEST_F(Audit, OfAFunctionWithoutAPairTheOneThatHoldsItsWordsIsAsked) {
    const std::string statements =
        "    float weightOfLight = pickProbability * directPdf;\n    float throughput = albedoOfSurface * cosTheta * "
        "directPdf + 0.25f;\n"
        "    float visible = shadowFactor * transmittanceOfFog;\n    float reach = falloffRadius * areaOfLamp;\n";
    const std::string names =
        "float pickProbability, float directPdf, float albedoOfSurface, float cosTheta, float shadowFactor, "
        "float transmittanceOfFog, float falloffRadius, float areaOfLamp";
    const std::string path = "    float sum = 0.0f;\n    for (int i = 0; i < s.bounces; ++i) {\n";
    const std::string rest =
        "    s.ray = nextRay(s.ray, i);\n    if (s.ray.isDead) break;\n    }\n    return sum / s.samples;\n}\n";
    write("gpu/trace.cu", "__device__ float tracePath(Scene& s, float directPdf) {\n" + path +
                              "    sum += sample_lamp(s, i) * 0.5f;\n" + rest);
    write("gpu/lamps.cu", "__device__ float sample_lamp(" + names + ") {\n" + statements +
                              "    return throughput * weightOfLight * visible * reach;\n}\n");
    write("cpu/trace.cpp", "float tracePath(Scene& s, " + names + ") {\n" + path + statements +
                               "    sum += throughput * weightOfLight * visible * reach;\n" + rest);
    git("add -A && git commit -q --amend -m Lamps");
    EXPECT_EQ(items({"--limit", "1000"}).size(), 0);
    change("cpu/trace.cpp", " * cosTheta", "");
    git("add -A && git commit -q --amend -m Lamps");
    const auto found = items({"--limit", "1000"});
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["source"], "gpu/lamps.cu:sample_lamp");
    EXPECT_EQ(found[0]["target"], "cpu/trace.cpp:tracePath");
}

// An edit of which little is certain does not hide what today's texts tell.
TEST_F(Audit, ASlipIsToldThoughAnEditOfThePastTellsOfIt) {
    add_pairs(24);
    write("gpu/blend.cu",
          "__device__ float blend(float a, float share, float level) {\n    float base = a * 0.5f + level;\n"
          "    float wide = base * level * share + 0.25f;\n    return wide + base;\n}\n");
    write("cpu/blend.cpp",
          "float blend(float a, float share, float level) {\n    float base = a * 0.5f + level;\n"
          "    float wide = base * level * share + 0.25f;\n    return wide + base;\n}\n");
    commit("Blend", 3);
    change("cpu/blend.cpp", "level * share", "level");
    change("gpu/blend.cu", "return wide + base", "return base + wide");
    commit("Refactor for speed on one platform", 2);
    const auto all = items({"--limit", "1000"});
    EXPECT_EQ(std::count_if(all.begin(), all.end(),
                            [](const auto& one) {
                                return one["summary"].template get<std::string>().find("level * share") !=
                                       std::string::npos;
                            }),
              1)
        << all;
    EXPECT_TRUE(all[0]["commit"].is_null());
    EXPECT_EQ(items().size(), 1);
}

TEST_F(Audit, WhatIsSaidForEachComponentIsSaidForTheVector) {
    write("gpu/tint.cu",
          "__device__ void tint(float3* c, float3 g, float level) {\n    float share = level * 0.5f + 0.25f;\n"
          "    c->x = c->x * g.x * level;\n    c->y = c->y * g.y * level;\n    c->z = c->z * g.z * level;\n}\n");
    write("cpu/tint.cpp",
          "void tint(Vec* c, Vec g, float level) {\n    float share = level * 0.5f + 0.25f;\n"
          "    *c = *c * g * level;\n}\n");
    commit("Tint", 2);
    EXPECT_TRUE(items().empty());
    change("cpu/tint.cpp", "* g * level", "* g * level * share");
    commit("Fix the tint: the share was forgotten", 3);
    const auto found = items();
    ASSERT_EQ(found.size(), 1) << found;
    EXPECT_EQ(found[0]["edited"], "target");
    EXPECT_FALSE(found[0]["commit"].is_null());
    EXPECT_GE(found[0]["certainty"], 0.45);
}

TEST_F(Audit, CallsThatTakeTheSameInAnotherOrderAreNoDifference) {
    const auto write_sides = [&](const std::string& there) {
        const std::string rest =
            "    for (int i = 0; i < n; ++i) out[i] = x[i] * level + y[i];\n    return level * 0.5f;\n}\n";
        const std::string head =
            "float run(float* out, const float* x, const float* y, float level, float span, int n) {\n";
        write("gpu/run.cu", "__device__ " + head + "    gather(n, x, y, level, span);\n" + rest);
        write("cpu/run.cpp", head + "    gather(" + there + ");\n" + rest);
    };
    write_sides("n, y, x, level, span");
    commit("Two that changed places may be a slip", 2);
    EXPECT_EQ(items().size(), 1);
    write_sides("n, level, span, x, y");
    git("add -A && git commit -q --amend -m Gather");
    EXPECT_TRUE(items().empty());
}

TEST_F(Audit, PrintsForPeople) {
    change("cpu/shade.cpp", "level + 0.01f;", "level + 0.01f;  // <b>\x1b[31m```\u202e");
    commit("A note", 1);
    change("gpu/shade.cu", "level < 0.001f", "level < 0.0001f");
    commit("Fix <b>dark</b> surfaces", 2);
    for (const std::string format : {"html", "markdown", "text"}) {
        const CommandRun got = audit({"--format", format});
        EXPECT_EQ(got.exit_code, 1);
        EXPECT_NE(got.out.find("gpu/shade.cu:1, shade"), std::string::npos) << got.out;
        EXPECT_EQ(got.out.find("<b>dark</b>") != std::string::npos, format == "text") << got.out;
        // The patch is for reading here, and acts on nobody.
        EXPECT_NE(got.out.find("\\u{1b}[31m```\\u{202e}"), std::string::npos) << got.out;
        EXPECT_EQ(got.out.find_first_of("\x1b"), std::string::npos) << got.out;
        EXPECT_EQ(got.out.find("````diff\n") != std::string::npos, format == "markdown") << got.out;
    }
    EXPECT_EQ(audit({"--format", "sarif"}).exit_code, 2);
}

TEST_F(Audit, AWitnessIsAnInputOnWhichTheSidesDiffer) {
    change("gpu/shade.cu", "level + 0.01f", "level + 0.02f");
    commit("Fix the ambient term", 2);
    const auto found = items({"--run"});
    ASSERT_EQ(found.size(), 1);
    const auto& witness = found[0]["witness"];
    ASSERT_TRUE(witness.is_object()) << found[0];
    EXPECT_TRUE(witness["inputs"].contains("cosine")) << witness;
    EXPECT_NE(witness["source"], witness["target"]);
    EXPECT_GT(found[0]["certainty"], items()[0]["certainty"]);
}

TEST_F(Audit, SaysWhatItNeeds) {
    const CommandRun no_sides = porttool({"audit"});
    EXPECT_EQ(no_sides.exit_code, 2);
    EXPECT_NE(no_sides.err.find("--source"), std::string::npos) << no_sides.err;
    const CommandRun limit = audit({"--limit", "none"});
    EXPECT_EQ(limit.exit_code, 2);
    EXPECT_NE(limit.err.find("--limit none"), std::string::npos) << limit.err;
    git("checkout -q --orphan empty");
    const CommandRun no_commit = audit();
    EXPECT_EQ(no_commit.exit_code, 2);
    EXPECT_NE(no_commit.err.find("names no commit yet"), std::string::npos) << no_commit.err;
    EXPECT_EQ(no_commit.out, "");
    std::filesystem::remove_all(root / ".git");
    const CommandRun no_git = audit();
    EXPECT_EQ(no_git.exit_code, 2);
    EXPECT_NE(no_git.err.find("git"), std::string::npos) << no_git.err;
}

}  // namespace
}  // namespace porttool::testing::audit_test
