// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// porttool history: similarity, degree of portability and drift debt, with figures counted by hand.
#include <fstream>

#include "porttool/history/blob_facts.h"
#include "porttool/history/churn.h"
#include "porttool/measure/passage_measure.h"
#include "porttool/read/blob_cache.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::history_test {
namespace {

const std::string kMap =
    "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n"
    "[[pair]]\nsource = \"src/k.cu:shade\"\ntarget = \"port/k.comp:shade\"\n"
    "[[pair]]\nsource = \"src/k.cu:fade\"\ntarget = \"port/k.comp:fade\"\n";

const std::string kShade = "float shade(float a, float b) {\n  float c = a * b;\n  return c * 0.5f;\n}\n";
const std::string kFade = "float fade(float t, float u) {\n  float v = t - u * 3.0f;\n  return v * v;\n}\n";

class History : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        if (IsSkipped()) return;
        write("portmap.toml", kMap);
        write("src/k.cu", kShade + kFade);
        write("port/k.comp", kShade + kFade);
    }
    /// Five commits in which one edit waits eight days for its port and another one is never ported.
    void make_five_commits() const {
        const std::string shade = replaced(kShade, "a * b", "a + b");
        const std::string fade = replaced(kFade, "  return", "  v = min(v, t);\n  return");
        const std::string helper = "float helper(float x) {\n  return x + x;\n}\n";
        commit("Both cores", 1);
        write("src/k.cu", shade + kFade);
        commit("Source alone", 2);
        write("src/k.cu", shade + kFade + helper);
        commit("Something else", 5);
        write("src/k.cu", shade + fade + helper);
        commit("Source alone again", 7);
        write("port/k.comp", shade + kFade);
        commit("The first one ported", 10);
    }
};

TEST_F(History, DebtIsLinesTimesDays) {
    make_five_commits();
    const nlohmann::json history = json({"history"});
    ASSERT_EQ(history["commits"].size(), 5u);
    // One statement replaced: two lines, open since the 2nd. One statement added: one line, open since the 7th.
    const std::vector<std::tuple<int, double>> expected = {
        {0, 0}, {1, 0 * 2}, {1, 3 * 2}, {2, 5 * 2 + 0 * 1}, {1, 3 * 1}};
    for (size_t i = 0; i < expected.size(); ++i) {
        const nlohmann::json drift = history["commits"][i]["drift"];
        EXPECT_EQ(drift["open_pairs"], std::get<0>(expected[i])) << i;
        EXPECT_EQ(drift["debt_line_days"], std::get<1>(expected[i])) << i;
        EXPECT_EQ(drift["pairs"], 2);
    }
    ASSERT_EQ(history["open"].size(), 1u);
    EXPECT_EQ(history["open"][0]["source"], "src/k.cu:fade");
    EXPECT_EQ(history["open"][0]["since"], "2026-01-07");
    EXPECT_EQ(history["open"][0]["age_days"], 3.0);
    EXPECT_EQ(history["open"][0]["lines"], 1);
}

TEST_F(History, FiguresOfABlockAreCountedByHand) {
    commit("Alike", 1);
    write("port/k.comp", kShade + kFade + "int other(int q) {\n  return q % 7;\n}\n// Not code.\n");
    commit("Three novel lines", 2);
    const nlohmann::json history = json({"history"});
    const nlohmann::json first = history["commits"][0]["blocks"][0], second = history["commits"][1]["blocks"][0];
    EXPECT_EQ(first["name"], "src/k.cu=port/k.comp") << "without blocks in the map a block is a pair of files";
    EXPECT_EQ(first["target_lines"], 8);
    EXPECT_EQ(first["shared_target"], 8);
    EXPECT_EQ(first["degree_of_portability"]["loc"], 1.0);
    EXPECT_EQ(first["moss_percent_target"], 100.0);
    EXPECT_EQ(second["target_lines"], 11);
    EXPECT_EQ(second["shared_target"], 8);
    EXPECT_EQ(second["source_lines"], 8);
    EXPECT_EQ(second["shared_source"], 8);
    EXPECT_NEAR(second["degree_of_portability"]["loc"], 8.0 / 11, 1e-6);
    EXPECT_LE(second["degree_of_portability"]["low"], second["degree_of_portability"]["loc"]);
    EXPECT_GE(second["degree_of_portability"]["high"], second["degree_of_portability"]["loc"]);
    EXPECT_EQ(history["commits"][1]["totals"]["target_lines"], 11);
}

TEST(Churn, WorkedExample) {
    EXPECT_DOUBLE_EQ(*rank_correlation({3, 2, 1}, {90, 20, 50}), 0.5);
    EXPECT_DOUBLE_EQ(*rank_correlation({1, 2, 3, 4}, {5, 6, 7, 8}), 1);
    EXPECT_DOUBLE_EQ(*rank_correlation({1, 1, 2}, {3, 3, 1}), -1) << "ties share a rank";
    EXPECT_FALSE(rank_correlation({1, 2}, {1, 2}));
    EXPECT_FALSE(rank_correlation({1, 1, 1}, {1, 2, 3}));
}

TEST_F(History, ChurnCountsTheCommitsThatTouchedABlock) {
    write("src/other.cu", kFade);
    write("port/other.comp", kFade);
    write("portmap.toml", kMap + "[[block]]\nname = \"K\"\nsource = [\"src/k.cu\"]\ntarget = [\"port/k.comp\"]\n" +
                              "[[block]]\nname = \"O\"\nsource = [\"src/other.cu\"]\ntarget = [\"port/other.comp\"]\n");
    make_five_commits();  // the four after the first touch K, none O
    const nlohmann::json churn = json({"history"})["churn"];
    ASSERT_EQ(churn["blocks"].size(), 2u);
    EXPECT_EQ(churn["blocks"][0]["name"], "K");
    EXPECT_EQ(churn["blocks"][0]["commits"], 4);
    EXPECT_NEAR(churn["blocks"][0]["commits_per_100_lines"].get<double>(), 100.0 * 4 / (12 + 8), 1e-5);
    EXPECT_EQ(churn["blocks"][1]["commits"], 0);
    EXPECT_TRUE(churn["rank_correlation"].is_null()) << "two blocks say nothing";
}

TEST_F(History, AgreesWithTheReport) {
    write("port/k.comp", replaced(kShade + kFade, "0.5f", "0.5") + "int other(int q) {\n  return q % 7;\n}\n");
    ASSERT_EQ(porttool({"init", "--force", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    commit("Both cores", 1);
    const nlohmann::json now = json({"report"})["blocks"][0], then = json({"history"})["commits"][0]["blocks"][0];
    for (const char* key : {"name", "source_lines", "target_lines", "shared_source", "shared_target",
                            "moss_percent_source", "moss_percent_target"})
        EXPECT_EQ(now[key], then[key]) << key;
    for (const char* key : {"loc", "low", "high"})
        EXPECT_EQ(now["degree_of_portability"][key], then["degree_of_portability"][key]) << key;
    EXPECT_GT(then["degree_of_portability"]["high"], then["degree_of_portability"]["loc"]) << "there is an interval";
}

TEST_F(History, WhatIsTooShortIsNeitherSharedNorNovel) {
    const std::string tiny = "int q(int a) { return a + 1; }\n";
    write("src/q.cu", tiny);
    write("port/q.comp", tiny);
    ASSERT_EQ(porttool({"init", "--force", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    commit("Twins, one too short", 1);
    const nlohmann::json report = json({"report"}), then = json({"history"})["commits"][0];
    ASSERT_EQ(then["blocks"][1]["name"], "src/q.cu=port/q.comp");
    EXPECT_TRUE(then["blocks"][1]["degree_of_portability"].is_null()) << "not 0: nothing is known";
    EXPECT_TRUE(then["blocks"][1]["shared_target"].is_null());
    EXPECT_TRUE(report["blocks"][1]["degree_of_portability"].is_null());
    EXPECT_TRUE(report["blocks"][1]["shared_target"].is_null());
    EXPECT_TRUE(report["blocks"][1]["shared_source"].is_null());
    EXPECT_EQ(then["totals"]["moss_percent_target"], 100.0);
    EXPECT_EQ(then["totals"]["degree_of_portability"]["loc"], 1.0);
    EXPECT_EQ(then["totals"]["moss_percent_target"], report["totals"]["moss_percent_target"]);
    EXPECT_EQ(then["totals"]["degree_of_portability"]["loc"], report["totals"]["degree_of_portability"]["loc"]);
    EXPECT_EQ(then["totals"]["target_lines"], 9);
}

TEST_F(History, AnUnrelatedEditOfTheSameLinePaysNothing) {
    const std::string unit =
        "float mix3(float p, float q, float a, float b) {\n  float r = p + q * a;\n  return r;\n}\n";
    write("portmap.toml",
          "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n[[pair]]\nsource = "
          "\"src/k.cu:mix3\"\ntarget = \"port/k.comp:mix3\"\n");
    write("src/k.cu", unit);
    write("port/k.comp", unit);
    commit("Both", 1);
    write("src/k.cu", replaced(unit, "p + q * a", "p - q * a"));
    commit("Source", 2);
    write("port/k.comp", replaced(unit, "p + q * a", "p + q / b - 7.0 * a * a * a"));
    commit("Another matter on the same line", 3);
    EXPECT_EQ(json({"history"})["commits"][2]["drift"]["open_pairs"], 1);
    write("port/k.comp", replaced(unit, "p + q * a", "p - q * a"));
    commit("Ported", 4);
    EXPECT_EQ(json({"history"})["commits"][3]["drift"]["open_pairs"], 0);
}

TEST_F(History, APortThatWasRemovedStaysOpen) {
    commit("Both cores", 1);
    write("src/k.cu", replaced(kShade, "a * b", "a + b") + kFade);
    commit("Source alone", 2);
    write("port/k.comp", kFade);
    commit("The port of it removed", 4);
    write("other.txt", "x");
    write("src/k.cu", replaced(kShade, "a * b", "a + b") + kFade + "// End.\n");
    commit("Later", 5);
    const nlohmann::json history = json({"history"});
    EXPECT_EQ(history["commits"][2]["drift"]["open_pairs"], 1);
    ASSERT_EQ(history["open"].size(), 1u);
    EXPECT_EQ(history["open"][0]["since"], "2026-01-02");
    EXPECT_EQ(history["open"][0]["lines"], 4) << "the source as a whole waits";
    EXPECT_EQ(history["commits"][3]["drift"]["debt_line_days"], 3 * 4);
    std::filesystem::remove(root / "src/k.cu");
    commit("The source removed, too", 6);
    EXPECT_EQ(json({"history"})["open"].size(), 0u);
}

TEST_F(History, TheChartShowsTheDebtBeforeItWasPaid) {
    commit("Both cores", 1);
    write("src/k.cu", replaced(kShade, "a * b", "a + b") + kFade);
    commit("Source", 2);
    write("port/k.comp", replaced(kShade, "a * b", "a + b") + kFade);
    commit("Port", 12);
    const nlohmann::json drift = json({"history"})["commits"][2]["drift"];
    EXPECT_EQ(drift["debt_before_line_days"], 10 * 2);
    EXPECT_EQ(drift["debt_line_days"], 0.0);
    const std::string page = porttool({"history", "--format", "html"}).out;
    const size_t chart = page.find("<h2>Drift debt</h2>");
    ASSERT_NE(chart, std::string::npos);
    // The axis ends at 20, so the peak touches the top of the chart (y 14) and falls to its foot (y 266) at one place.
    EXPECT_NE(page.find("L944.0 14.0L944.0 266.0", chart), std::string::npos) << page.substr(chart, 2000);
}

TEST_F(History, BlocksOfTheMapAreFilesOrUnits) {
    write("portmap.toml", kMap +
                              "[[block]]\nname = \"Files\"\nsource = \"src/k.cu\"\ntarget = \"port/*\"\n"
                              "[[block]]\nname = \"Units\"\nsource = \"src/k.cu:shade\"\n"
                              "target = \"port/k.comp:{shade,late}\"\n");
    commit("Both cores", 1);
    write("port/k.comp", kShade + kFade + "int late(int q) {\n  return q % 7;\n}\n");
    commit("A unit that joins its block", 2);
    const nlohmann::json history = json({"history"});
    EXPECT_EQ(history["commits"][0]["blocks"][0]["target_lines"], 8);
    EXPECT_EQ(history["commits"][0]["blocks"][1]["target_lines"], 4);
    EXPECT_EQ(history["commits"][0]["blocks"][1]["shared_target"], 4);
    EXPECT_EQ(history["commits"][1]["blocks"][0]["target_lines"], 11);
    EXPECT_EQ(history["commits"][1]["blocks"][1]["target_lines"], 7);
}

TEST_F(History, APortThatResemblesTheEditClosesAPairWithoutALock) {
    commit("Both cores", 1);
    const std::string edit = "  float d = max(c, 0.0f) * rsqrtf(a + b);\n  return";
    write("src/k.cu", replaced(kShade, "  return", edit) + kFade);
    commit("Source", 2);
    write("port/k.comp", replaced(kShade, "  return", "  barrier();\n" + edit) + kFade);
    commit("Ported with an addition", 3);
    write("src/k.cu", replaced(kShade, "  return", edit) + replaced(kFade, "t - u", "t + u"));
    commit("Source again", 4);
    write("port/k.comp", replaced(kShade, "  return", "  barrier();\n" + edit) +
                             replaced(kFade, "return v * v", "discard_pixel(17); imageStore(out_image, 3); return v"));
    commit("Another matter", 5);
    const nlohmann::json commits = json({"history"})["commits"];
    EXPECT_EQ(commits[1]["drift"]["open_pairs"], 1);
    EXPECT_EQ(commits[2]["drift"]["open_pairs"], 0);
    EXPECT_EQ(commits[3]["drift"]["open_pairs"], 1);
    EXPECT_EQ(commits[4]["drift"]["open_pairs"], 1) << "an edit that has nothing to do with it is no port";
}

TEST_F(History, TheLockOfACommitDecides) {
    ASSERT_EQ(porttool({"init", "--force", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    commit("Recorded", 1);
    write("src/k.cu", replaced(kShade, "a * b", "a + b") + kFade);
    commit("Source alone", 3);
    ASSERT_EQ(porttool({"accept", "src/k.cu:shade", "--reason", "GPU only"}).exit_code, 0);
    commit("Accepted", 6);
    write("port/k.comp", replaced(kShade, "c * 0.5f", "c * 0.25f") + kFade);
    commit("Port alone", 7);
    ASSERT_EQ(porttool({"ignore", "src/k.cu:shade", "--reason", "on purpose"}).exit_code, 0);
    commit("Ignored", 9);
    const nlohmann::json commits = json({"history"})["commits"];
    ASSERT_EQ(commits.size(), 5u);
    const std::vector<int> open = {0, 1, 0, 1, 0};
    for (size_t i = 0; i < open.size(); ++i) EXPECT_EQ(commits[i]["drift"]["open_pairs"], open[i]) << i;
}

TEST_F(History, CosmeticEditsAndRenamesOfLocalsOpenNothing) {
    commit("Both cores", 1);
    write("src/k.cu", "// A comment.\n" +
                          replaced(replaced(kShade, "float c =", "float product ="), "return c", "return product") +
                          kFade);
    commit("Renamed", 2);
    EXPECT_EQ(json({"history"})["commits"][1]["drift"]["open_pairs"], 0);
}

TEST_F(History, FilesComeAndGo) {
    commit("Both cores", 1);
    git("mv port/k.comp port/moved.comp");
    commit("Moved, the map forgotten", 2);
    write("portmap.toml", replaced(replaced(kMap, "port/k.comp", "port/moved.comp"), "port/k.comp", "port/moved.comp"));
    commit("The map follows", 3);
    std::filesystem::remove(root / "src/k.cu");
    commit("The source gone", 4);
    const nlohmann::json commits = json({"history"})["commits"];
    ASSERT_EQ(commits.size(), 4u);
    EXPECT_EQ(commits[1]["blocks"].size(), 0u);
    EXPECT_EQ(commits[1]["drift"]["pairs"], 0);
    EXPECT_EQ(commits[2]["blocks"][0]["name"], "src/k.cu=port/moved.comp");
    EXPECT_EQ(commits[3]["totals"]["source_lines"], 0);
    EXPECT_EQ(commits[3]["totals"]["target_lines"], 8);
    EXPECT_EQ(commits[3]["totals"]["shared_target"], 0);
}

TEST_F(History, CommitsBeforeTheMapAreReadWithTodays) {
    std::filesystem::remove(root / "portmap.toml");
    commit("No map", 1);
    write("src/k.cu", replaced(kShade, "a * b", "a + b") + kFade);
    commit("Still none", 2);
    CommandRun got = porttool({"history"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("no portmap.toml"), std::string::npos) << got.err;
    write("portmap.toml", kMap);
    const nlohmann::json history = json({"history"});
    ASSERT_EQ(history["commits"].size(), 2u);
    EXPECT_EQ(history["commits"][1]["drift"]["open_pairs"], 1);
    commit("A map", 3);
    EXPECT_EQ(json({"history"})["commits"].size(), 3u);
}

TEST_F(History, AMapThatWasOnceBrokenIsPassedOver) {
    commit("Both cores", 1);
    write("portmap.toml", kMap + "[[pear]]\n");
    commit("Broken", 2);
    write("portmap.toml", kMap);
    write("src/k.cu", replaced(kShade, "a * b", "a + b") + kFade);
    commit("Mended", 3);
    const CommandRun got = porttool({"history", "--format", "json"});
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_NE(got.err.find("unknown key 'pear'"), std::string::npos) << got.err;
    EXPECT_EQ(nlohmann::json::parse(got.out)["commits"].back()["drift"]["open_pairs"], 1);
}

TEST_F(History, AMapThatWasBrokenFromTheStartIsToldByTodays) {
    write("portmap.toml", "version = 2\n");
    commit("Broken", 1);
    write("portmap.toml", kMap);
    const nlohmann::json commits = json({"history"})["commits"];
    EXPECT_EQ(commits[0]["totals"]["target_lines"], 8);
    EXPECT_EQ(commits[0]["drift"]["pairs"], 2);
}

TEST_F(History, AGivenMapCountsForEveryCommit) {
    commit("Both cores", 1);
    write("src/k.cu", replaced(kShade, "a * b", "a + b") + replaced(kFade, "t - u", "t + u"));
    commit("Source alone", 2);
    EXPECT_EQ(json({"history"})["commits"][1]["drift"]["open_pairs"], 2);
    write("other.toml", kMap.substr(0, kMap.rfind("[[pair]]")));
    EXPECT_EQ(json({"history", "--config", (root / "other.toml").string()})["commits"][1]["drift"]["open_pairs"], 1);
}

TEST_F(History, AProjectInASubfolderOfALinkedWorkTreeIsReadThere) {
    for (const char* path : {"portmap.toml", "src", "port"}) {
        std::filesystem::create_directories(root / "sub");
        std::filesystem::rename(root / path, root / "sub" / path);
    }
    write("src/k.cu", "another project's");
    commit("Below", 1);
    write("sub/src/k.cu", replaced(kShade, "a * b", "a + b") + kFade);
    commit("Source alone", 2);
    git("worktree add -q --detach tree HEAD");
    const nlohmann::json history = json({"history"}, (root / "tree/sub").string());
    ASSERT_EQ(history["commits"].size(), 2u);
    EXPECT_EQ(history["commits"][1]["totals"]["source_lines"], 8);
    EXPECT_EQ(history["commits"][1]["drift"]["open_pairs"], 1);
    EXPECT_TRUE(std::filesystem::exists(root / ".git/porttool/history.cache"));
    EXPECT_EQ(json({"effort", "--from", "HEAD~1"}, (root / "tree/sub").string())["totals"]["source_added"], 1);
}

TEST_F(History, ACacheThatCannotBeWrittenIsNoError) {
    make_five_commits();
    std::ofstream(root / ".git/porttool") << "in the way";
    EXPECT_EQ(json({"history"})["commits"].size(), 5u);
}

TEST_F(History, SinceShowsLessAndCountsAll) {
    make_five_commits();
    const nlohmann::json all = json({"history"}), some = json({"history", "--since", "HEAD~2"});
    ASSERT_EQ(some["commits"].size(), 2u);
    EXPECT_EQ(some["commits"][0], all["commits"][3]);
    EXPECT_EQ(some["commits"][1], all["commits"][4]);
    EXPECT_EQ(json({"history", "--since", "HEAD"})["commits"].size(), 1u) << "the newest is always there";
    const CommandRun got = porttool({"history", "--since", "nowhere"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("--since nowhere"), std::string::npos);
}

TEST_F(History, SinceADayShowsWhatCameOnItAndLater) {
    make_five_commits();
    const nlohmann::json all = json({"history"});
    for (const auto& [day, shown] : std::vector<std::pair<std::string, size_t>>{
             {"2025-12-31", 5}, {"2026-01-01", 5}, {"2026-01-02", 4}, {"2026-01-06", 2}, {"2030-01-01", 1}}) {
        const nlohmann::json got = json({"history", "--since", day});
        ASSERT_EQ(got["commits"].size(), shown) << day;
        EXPECT_EQ(got["commits"].back(), all["commits"].back()) << day;
    }
    const CommandRun wrong = porttool({"history", "--since", "2026-02-30"});
    EXPECT_EQ(wrong.exit_code, 2);
    EXPECT_NE(wrong.err.find("2026-02-30"), std::string::npos) << wrong.err;
}

TEST_F(History, SideBranchesCountWhereTheyAreMerged) {
    commit("Both cores", 1);
    git("checkout -q -b side");
    write("src/k.cu", replaced(kShade, "a * b", "a + b") + kFade);
    commit("On a branch", 2);
    git("checkout -q main");
    write("notes.txt", "x");
    commit("Elsewhere", 3);
    git("merge -q --no-ff -m merged side");
    const nlohmann::json commits = json({"history"})["commits"];
    ASSERT_EQ(commits.size(), 2u);
    EXPECT_EQ(commits[1]["subject"], "merged");
    EXPECT_EQ(commits[1]["drift"]["open_pairs"], 1);
}

TEST_F(History, TheCacheChangesNothingButTime) {
    make_five_commits();
    const std::string cache = (root / ".git/porttool/history.cache").string();
    const std::string fresh = porttool({"history", "--format", "json", "--no-cache"}).out;
    EXPECT_FALSE(std::filesystem::exists(cache));
    EXPECT_EQ(porttool({"history", "--format", "json"}).out, fresh);
    ASSERT_TRUE(std::filesystem::exists(cache));
    EXPECT_EQ(porttool({"history", "--format", "json"}).out, fresh);
    const std::string text = read_text(cache);
    const auto written = std::filesystem::last_write_time(cache);
    porttool({"history"});
    EXPECT_EQ(std::filesystem::last_write_time(cache), written) << "nothing new, nothing written";
    for (size_t at = 0; at < text.size(); at += text.size() / 7) {  // cut off, and damaged, at several places
        std::string damaged = text;
        damaged[at] = damaged[at] == '1' ? '2' : '1';
        std::ofstream(cache, std::ios::binary) << damaged;
        EXPECT_EQ(porttool({"history", "--format", "json"}).out, fresh) << at;
        std::ofstream(cache, std::ios::binary) << text.substr(0, at);
        EXPECT_EQ(porttool({"history", "--format", "json"}).out, fresh) << at;
    }
    EXPECT_EQ(read_text(cache), text) << "mended";
}

TEST_F(History, ReadsShallowClonesAndSingleCommits) {
    make_five_commits();
    git("clone -q --depth 2 'file://" + root.string() + "' shallow");
    const CommandRun got = porttool({"history", "--format", "json"}, (root / "shallow").string());
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_NE(got.err.find("reaches back to"), std::string::npos) << got.err;
    EXPECT_NE(got.err.find("2026-01-07"), std::string::npos) << got.err;
    const nlohmann::json history = nlohmann::json::parse(got.out);
    EXPECT_EQ(history["shallow"], true);
    EXPECT_EQ(history["commits"].size(), 2u);
    git("clone -q --depth 1 'file://" + root.string() + "' single");
    EXPECT_EQ(json({"history"}, (root / "single").string())["commits"].size(), 1u);
}

TEST_F(History, WhatGitCannotGiveIsExitCodeTwo) {
    CommandRun got = porttool({"history"});
    EXPECT_EQ(got.exit_code, 2) << "no commit yet";
    EXPECT_NE(got.err.find("commit once"), std::string::npos) << got.err;
    commit("Both cores", 1);
    got = porttool({"history", "--format", "sarif"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("text, html, json, csv"), std::string::npos) << got.err;
    std::filesystem::remove_all(root / ".git");
    got = porttool({"history"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("no git repository"), std::string::npos) << got.err;
    EXPECT_EQ(got.out, "");
}

TEST_F(History, BinaryFilesAreEmpty) {
    write("src/blob.cu", std::string("a\0b", 3));
    commit("Both cores", 1);
    EXPECT_EQ(json({"history"})["commits"][0]["totals"]["source_lines"], 8);
}

TEST_F(History, CsvHasOneLineForEachBlockAndTheTotals) {
    make_five_commits();
    const std::string csv = porttool({"history", "--format", "csv"}).out;
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5 * 2);
    EXPECT_NE(csv.find(",2026-01-10,*,12,8,"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",1,3\n"), std::string::npos) << csv;
}

TEST_F(History, TheTextNamesModelAndInterval) {
    make_five_commits();
    const std::string text = porttool({"history"}).out;
    EXPECT_NE(text.find("DP in lines"), std::string::npos);
    EXPECT_NE(text.find("open since 2026-01-07: src/k.cu:fade  =  port/k.comp:fade, 1 lines, 3.0 line-days"),
              std::string::npos)
        << text;
}

TEST_F(History, ThePageStandsAlone) {
    write("portmap.toml", kMap + "[[block]]\nname = \"<b> & \\\"c\\\"\"\nsource = \"src/*\"\ntarget = \"port/*\"\n");
    make_five_commits();
    ASSERT_EQ(porttool({"history", "--format", "html", "-o", "page.html"}).exit_code, 0);
    const std::string page = read_text(root / "page.html");
    EXPECT_EQ(page.find("http"), std::string::npos);
    EXPECT_EQ(page.find("<script"), std::string::npos);
    EXPECT_EQ(page.find("<b>"), std::string::npos);
    EXPECT_NE(page.find("&lt;b&gt; &amp; &quot;c&quot;"), std::string::npos);
    EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
    EXPECT_NE(page.find("role=\"img\""), std::string::npos);
    EXPECT_NE(page.find("1 of 2 pairs are open, 3.0 line-days"), std::string::npos);
    EXPECT_NE(page.find("<td>4</td></tr>"), std::string::npos) << "commits that touched the block";
    EXPECT_NE(page.find("Too few blocks to say whether"), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_EQ(page.find("inf"), std::string::npos);
}

TEST(BlobCache, GivesBackWhatWasPutAndForgetsWhatIsDamaged) {
    BlobCache cache;
    const std::string one = BlobCache::key({"a", "bc"}), two = BlobCache::key({"ab", "c"});
    EXPECT_NE(one, two) << "parts are kept apart";
    cache.put(one, "first value");
    cache.put(two, "");
    std::string file = cache.file(1000);
    BlobCache again(file);
    ASSERT_NE(again.find(one), nullptr);
    EXPECT_EQ(*again.find(one), "first value");
    EXPECT_EQ(*again.find(two), "");
    EXPECT_FALSE(again.changed());
    BlobCache damaged(replaced(file, "first value", "other value"));
    EXPECT_EQ(damaged.find(one), nullptr);
    EXPECT_NE(damaged.find(two), nullptr);
    EXPECT_EQ(BlobCache("garbage").find(one), nullptr);
}

TEST(BlobCache, IsOfOneBuildAndOneNormalForm) {
    BlobCache cache;
    const std::string key = BlobCache::key({"a"});
    cache.put(key, "value");
    const std::string file = cache.file(1000), entries = file.substr(file.find('\n'));
    const std::string form = "normal-form " + std::to_string(kNormalForm), program = "program " + this_program();
    ASSERT_FALSE(this_program().empty());
    EXPECT_NE(BlobCache(file).find(key), nullptr);
    for (const std::string& other :
         {replaced(file, form, "normal-form 2"), replaced(file, program, "program 1 2 3 4.5"),
          replaced(file, "porttool-cache 3", "porttool-cache 0"), "porttool-cache 2" + entries})
        EXPECT_EQ(BlobCache(other).find(key), nullptr) << other;
}

TEST(BlobCache, KeepsWhatWasUsedWhereThereIsTooMuch) {
    BlobCache cache;
    for (int i = 0; i < 100; ++i) cache.put(BlobCache::key({std::to_string(i)}), std::string(100, 'x'));
    BlobCache next(cache.file(100'000));
    next.find(BlobCache::key({"7"}));
    BlobCache last(next.file(1000));
    EXPECT_NE(last.find(BlobCache::key({"7"})), nullptr);
    EXPECT_EQ(last.find(BlobCache::key({"8"})), nullptr);
}

TEST(BlobFacts, SurviveTheCache) {
    const ScannedFile file = scan_text("k.cu", kShade + kFade), other = scan_text("k.comp", kFade);
    const BlobFacts facts = blob_facts(file);
    EXPECT_EQ(facts.lines, 8u);
    ASSERT_EQ(facts.units.size(), 3u);
    EXPECT_EQ(facts.units[2].kind, UnitKind::File);
    const auto read = read_blob_facts(facts_line(facts));
    ASSERT_TRUE(read);
    EXPECT_EQ(facts_line(*read), facts_line(facts));
    EXPECT_EQ(read->units[1].prints, facts.units[1].prints);
    EXPECT_FALSE(read_blob_facts("what"));
    const PassageMeasure measure = measure_passages({{&file, nullptr}}, {{&other, nullptr}}, Dialect());
    const auto again = read_passage_measure(facts_line(measure));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->source.shared, measure.source.shared);
    EXPECT_EQ(again->source.shared, (std::vector<bool>{false, false, false, false, true, true, true, true}));
    EXPECT_EQ(again->target.measure.moss_percent, 100.0);
    EXPECT_FALSE(read_passage_measure("1 2 3"));
}

}  // namespace
}  // namespace porttool::testing::history_test
