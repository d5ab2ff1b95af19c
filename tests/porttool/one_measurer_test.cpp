// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// report and history measure alike: each commit is checked out and reported on, and history must say the same of it.
#include <random>

#include "porttool/measure/passage_measure.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::one_measurer_test {
namespace {

const std::string kShade =
    "float shade(float a, float b) {\n  float c = a * b;\n  c = c + b * 0.25f;\n  return c * 0.5f;\n}\n";
const std::string kFade =
    "float fade(float t, float u) {\n  float v = t - u * 3.0f;\n  v = max(v, t);\n  return v * v;\n}\n";
const std::string kGlow =
    "float glow(float k) {\n  float e = k * k - 1.0f;\n  e = min(e, 4.0f) / (k + 7.0f);\n  return e;\n}\n";
const std::string kTiny = "int q(int a) { return a; }\n";

std::string pair_of(const std::string& source, const std::string& target) {
    return "[[pair]]\nsource = \"" + source + "\"\ntarget = \"" + target + "\"\n";
}

std::string block_of(const std::string& name, const std::string& source, const std::string& target) {
    return "[[block]]\nname = \"" + name + "\"\nsource = " + source + "\ntarget = " + target + "\n";
}

const std::string kSides = "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n";

class OneMeasurer : public TemporaryRepository {
protected:
    /// What a report of the work tree has, but what only the newest commit of a history has.
    static void expect_alike(const nlohmann::json& report, const nlohmann::json& commit, bool newest) {
        const auto alike = [&](nlohmann::json expected, const nlohmann::json& block) {
            for (const auto& [key, value] : expected.items()) {
                ASSERT_TRUE(block.contains(key)) << key;
                if (!newest && (key == "decomposition" || key == "lines")) continue;
                EXPECT_EQ(block[key], value) << key;
            }
        };
        ASSERT_EQ(report["blocks"].size(), commit["blocks"].size());
        for (size_t i = 0; i < report["blocks"].size(); ++i) {
            SCOPED_TRACE(report["blocks"][i]["name"]);
            alike(report["blocks"][i], commit["blocks"][i]);
        }
        SCOPED_TRACE("totals");
        alike(report["totals"], commit["totals"]);
    }

    /// Holds each commit of the history, measured anew and from the cache, against a report on its files.
    void expect_reports_of_all_commits() {
        const nlohmann::json fresh = json({"history", "--no-cache"});
        json({"history"});
        EXPECT_EQ(json({"history"}), fresh) << "the cache changes nothing";
        const size_t count = fresh["commits"].size();
        ASSERT_GE(count, 2u);
        for (size_t i = 0; i < count; ++i) {
            const nlohmann::json& commit = fresh["commits"][i];
            SCOPED_TRACE(commit["subject"]);
            git("checkout -q " + commit["id"].get<std::string>());
            expect_alike(json({"report"}), commit, i + 1 == count);
        }
    }
};

TEST_F(OneMeasurer, BlocksOfSeveralFiles) {
    // fade is paired across files and glow is not paired at all: both are shared within the block.
    write("portmap.toml", kSides + pair_of("src/a.cu:shade", "port/k.comp:shade") +
                              block_of("All of it", "[\"src/*\"]", "[\"port/*\"]") +
                              block_of("One", "\"src/a.cu\"", "\"port/k.comp\""));
    write("src/a.cu", kShade);
    write("src/b.cu", kFade + kGlow);
    write("port/k.comp", kFade + kShade);
    write("port/l.comp", "// Nothing yet.\n");
    commit("Four files", 1);
    write("port/l.comp", kGlow + replaced(kShade, "0.25f", "0.125f"));
    commit("Code that no pair of files holds", 2);
    write("src/a.cu", replaced(kShade, "c + b", "c - b"));
    std::filesystem::remove(root / "src/b.cu");
    commit("A file goes", 3);
    expect_reports_of_all_commits();
    const nlohmann::json second = json({"history"})["commits"][1]["blocks"][0];
    EXPECT_EQ(second["source_lines"], 15);
    EXPECT_EQ(second["shared_source"], 15) << "glow is in a file with no pair to port/l.comp";
}

TEST_F(OneMeasurer, RewrittenAndOneSidedFilesAndUnitsLeftOut) {
    const std::string other =
        "float other(float q) {\n  for (int i = 0; i < 9; ++i) q = q / (q + 2.0f) - i;\n  return q;\n}\n";
    const std::string blocks =
        "[[ignore]]\nid = \"src/only.cu:*\"\nreason = \"the host does it\"\n" +
        block_of("Units", "[\"src/a.cu:shade\", \"src/r.cu\"]", "[\"port/k.comp:{shade,other}\"]") +
        block_of("Source alone", "\"src/only.cu\"", "[]") + block_of("Everything", "\"src/*\"", "\"port/*\"");
    write("portmap.toml", kSides + pair_of("src/a.cu:shade", "port/k.comp:shade") +
                              pair_of("src/r.cu:fade", "port/k.comp:other") + blocks);
    write("src/a.cu", kShade + kGlow + "static const float kBias = 0.5f;\n");
    write("src/r.cu", kFade);
    write("src/only.cu", kGlow);
    write("port/k.comp", kShade + other);
    commit("A rewritten and a one-sided file", 1);
    ASSERT_EQ(porttool({"init", "--force", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    write("portmap.toml", read_text(root / "portmap.toml") + pair_of("src/r.cu:fade", "port/k.comp:other") + blocks);
    ASSERT_EQ(porttool({"accept", "src/r.cu:fade"}).exit_code, 0);
    write("port/k.comp", kShade + "// Moved down.\n" + other + kGlow + kGlow);
    commit("A lock, and one function twice", 2);
    write("src/r.cu", kFade + replaced(kFade, "float t, float u", "vec2 t, vec2 u"));
    commit("An overload", 3);
    expect_reports_of_all_commits();
    const nlohmann::json newest = json({"history"})["commits"].back()["blocks"];
    EXPECT_EQ(newest[0]["target_lines"], 9);
    EXPECT_EQ(newest[0]["decomposition"]["target"]["rewritten"], 4);
    EXPECT_EQ(newest[1]["decomposition"]["source"]["one_sided"], 5);
}

TEST_F(OneMeasurer, WhatIsTooShortToBeMeasured) {
    const std::string map =
        kSides + pair_of("src/q.cu:q", "port/q.comp:q") + pair_of("src/a.cu:shade", "port/k.comp:shade");
    write("portmap.toml", map);
    write("src/q.cu", kTiny);
    write("port/q.comp", kTiny);
    write("src/a.cu", kShade + kFade);
    write("port/k.comp", kShade);
    commit("Pairs of files as blocks", 1);
    write("portmap.toml", map + block_of("Tiny", "\"src/q.cu\"", "\"port/q.comp\"") +
                              block_of("Both", "[\"src/q.cu\", \"src/a.cu\"]", "\"port/*\"") +
                              block_of("Tiny against all", "\"src/q.cu\"", "\"port/*\""));
    commit("Blocks of the map", 2);
    write("port/k.comp", kTiny + kShade + kTiny);
    commit("What is tiny stands beside what is not", 3);
    expect_reports_of_all_commits();
    const nlohmann::json newest = json({"history"})["commits"].back()["blocks"];
    EXPECT_TRUE(newest[0]["degree_of_portability"].is_null());
    EXPECT_TRUE(newest[0]["shared_target"].is_null());
    EXPECT_FALSE(newest[1]["degree_of_portability"].is_null());
}

TEST_F(OneMeasurer, ThisRepository) {
    if (!std::filesystem::exists(std::filesystem::path(REPOSITORY) / ".git")) GTEST_SKIP() << "no git repository";
    git("clone -q '" REPOSITORY "' own");
    const std::string own = (root / "own").string();
    const nlohmann::json history = json({"history", "--no-cache", "--since", "HEAD~1"}, own),
                         report = json({"report"}, own);
    ASSERT_FALSE(report["blocks"].empty());
    expect_alike(report, history["commits"].back(), true);
}

/// A side of files that change, as parts of a passage.
class ChangingSide {
public:
    explicit ChangingSide(std::string suffix) : suffix_(std::move(suffix)) {}

    void change(std::mt19937& random) {
        const std::string path = std::string(1, static_cast<char>('a' + random() % 6)) + suffix_;
        if (random() % 5 == 0) {
            files_.erase(path);
            return;
        }
        std::string text;
        for (uint32_t functions = random() % 6; functions > 0; --functions) {
            const std::string name = "f" + std::to_string(random() % 8);
            text += "float " + name + "(float a, float b) {\n";
            for (uint32_t lines = random() % 9; lines > 0; --lines)
                text += random() % 3 == 0 ? "    inline\n    a = min(a, b) * " + std::to_string(random() % 3) + ".5f;\n"
                                          : "    b = std::max(a + b, 1.0f) - dot(a, b);\n    store(a, b);\n";
            text += "    return a;\n}\n";
        }
        files_[path] = {std::to_string(++versions_), std::make_shared<const ScannedFile>(scan_text(path, text))};
    }

    PartedPassage passage() const {
        PartedPassage out;
        for (const auto& [path, file] : files_)
            out.push_back({path, file.first + suffix_, [kept = file.second] {
                               return PartText{kept, {{kept.get(), nullptr}}};
                           }});
        return out;
    }

    Passage whole() const {
        Passage out;
        for (const auto& [path, file] : files_) out.push_back({file.second.get(), nullptr});
        return out;
    }

private:
    std::string suffix_;
    int versions_ = 0;
    std::map<std::string, std::pair<std::string, std::shared_ptr<const ScannedFile>>> files_;
};

TEST(PassageTracker, MeasuresWhatChangesAsIfItWereNew) {
    std::mt19937 random(3);
    BlobCache cache;
    PassageMeasurer measurer(cache);
    measurer.use_dialect({});
    BySide<ChangingSide> sides{ChangingSide(".cu"), ChangingSide(".cpp")};
    int measured = 0;
    for (int round = 0; round < 200; ++round) {
        sides[random() % 2 == 0 ? Side::Source : Side::Target].change(random);
        const PassageMeasure& found = measurer.measure("", sides.source.passage(), sides.target.passage());
        const PassageMeasure wanted = measure_passages(sides.source.whole(), sides.target.whole(), Dialect());
        ASSERT_EQ(facts_line(found), facts_line(wanted)) << round;
        measured += wanted.source.measure.moss_percent && *wanted.source.measure.moss_percent > 0 ? 1 : 0;
    }
    EXPECT_GT(measured, 100);
}

}  // namespace
}  // namespace porttool::testing::one_measurer_test
