// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// porttool effort: what porting a range of commits cost, with figures counted by hand.
#include <cmath>
#include <map>
#include <random>
#include <set>

#include "porttool/effort/word_numbers.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/statements.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::effort_test {
namespace {

const std::string kMap =
    "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n"
    "[[pair]]\nsource = \"src/k.cu:shade\"\ntarget = \"port/k.comp:shade\"\n";

const std::string kSource =
    "__device__ float shade(float a, float b) {\n"
    "  float c = a * b;\n"
    "  return c * 0.5f;\n"
    "}\n";
const std::string kTarget =
    "float shade(float a, float b) {\n"
    "  float c = a * b;\n"
    "  return c * 0.5;\n"
    "}\n";

class Effort : public TemporaryRepository {
protected:
    void SetUp() override {
        TemporaryRepository::SetUp();
        if (IsSkipped()) return;
        write("portmap.toml", kMap);
        write("src/k.cu", kSource);
        write("port/k.comp", kTarget);
        commit("Both cores");
    }
    /// Two lines on both sides, and one that only the port needs.
    void port_a_change() const {
        write("src/k.cu", replaced(kSource, "  return",
                                   "  float d = max(c, 0.0f);  // no light from below\n"
                                   "  c = d * rsqrtf(a) + b;\n  return"));
        write("port/k.comp", replaced(kTarget, "  return",
                                      "  float d = max(c, 0.0);\n"
                                      "  c = d * inversesqrt(a) + b;\n"
                                      "  imageStore(result, ivec2(gl_GlobalInvocationID.xy), vec4(c, c, c, 1.0));\n"
                                      "  return"));
        commit("A floor", 2);
    }
};

TEST_F(Effort, CountsWhatWasCarriedOverAndWhatIsNovel) {
    port_a_change();
    const nlohmann::json report = json({"effort", "--from", "HEAD~1", "--to", "HEAD"});
    EXPECT_EQ(report["commits"], 1);
    ASSERT_EQ(report["pairs"].size(), 1u);
    for (const nlohmann::json& edit : {report["pairs"][0], report["totals"]}) {
        EXPECT_EQ(edit["source_added"], 2);
        EXPECT_EQ(edit["source_removed"], 0);
        EXPECT_EQ(edit["target_added"], 3);
        EXPECT_EQ(edit["target_removed"], 0);
        EXPECT_EQ(edit["novel_lines"], 1);
        EXPECT_EQ(edit["carried_over"], 1.0);
        // The two lines have 9 and 10 tokens in the common vocabulary on both sides, the third has 22.
        EXPECT_NEAR(edit["edit_similarity"], 2.0 * 19 / (19 + 41), 1e-6);
        EXPECT_NEAR(edit["degree_of_portability"]["loc"], 2.0 / 3, 1e-6);
        EXPECT_EQ(edit["degree_of_portability"]["low"], 0.0) << "0.0f and rsqrtf are written otherwise";
        EXPECT_GE(edit["degree_of_portability"]["high"], edit["degree_of_portability"]["loc"]);
    }
    // COCOMO II: CM = IM = 100 / 3, so AAF = 20 and AAM = (4 + 20 x 1.24) / 100.
    ASSERT_EQ(report["degrees_of_portability"].size(), 2u);
    EXPECT_EQ(report["degrees_of_portability"][1]["model"], "COCOMO II reuse");
    EXPECT_NEAR(report["degrees_of_portability"][1]["value"], 1 - 0.288, 1e-6);
}

TEST_F(Effort, AnEditOnOneSideHasNoDegreeOfPortability) {
    write("src/k.cu", replaced(kSource, "a * b", "a + b"));
    commit("Only here", 2);
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    EXPECT_EQ(report["totals"]["source_added"], 1);
    EXPECT_EQ(report["totals"]["source_removed"], 1);
    EXPECT_EQ(report["totals"]["carried_over"], 0.0);
    EXPECT_TRUE(report["totals"]["edit_similarity"].is_null());
    EXPECT_TRUE(report["totals"]["degree_of_portability"].is_null());
}

TEST_F(Effort, AWrongPortIsNovel) {
    write("src/k.cu", replaced(kSource, "a * b", "a + b"));
    write("port/k.comp", replaced(kTarget, "a * b", "a - b"));
    commit("Not alike", 2);
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    EXPECT_EQ(report["totals"]["novel_lines"], 1);
    EXPECT_EQ(report["totals"]["carried_over"], 0.0);
    EXPECT_EQ(report["totals"]["degree_of_portability"]["loc"], 0.0);
}

TEST_F(Effort, CommentsAndBlanksAreNoLines) {
    write("src/k.cu", "// A comment.\n\n" + replaced(kSource, "a * b;", "a  *  b;  // product"));
    commit("Words", 2);
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    EXPECT_EQ(report["totals"]["source_added"], 0);
    EXPECT_EQ(report["pairs"].size(), 0u);
    EXPECT_NE(porttool({"effort", "--from", "HEAD~1"}).out.find("no line of code changed"), std::string::npos);
}

TEST_F(Effort, TheWordsOfAVeryLongLineAllCount) {
    const auto line = [](const std::string& last) {
        std::string text = "  c = c";
        for (int i = 0; i < 50'000; ++i) text += " + a";
        for (int i = 0; i < 10'000; ++i) text += " + " + last;
        return text + ";\n  return";
    };
    write("src/k.cu", replaced(kSource, "  return", line("y")));
    write("port/k.comp", replaced(kTarget, "  return", line("z")));
    commit("Long", 2);
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    constexpr double kWords = 3 + 2 * 60'000, kCommon = kWords - 10'000;
    EXPECT_NEAR(report["totals"]["edit_similarity"].get<double>(), kCommon / kWords, 1e-6);
}

TEST(EffortWords, AreThoseOfStatementsInTheCommonVocabulary) {
    const std::vector<std::string> words = {
        "a", "Aa_", "vec3", "float3", "1.0f", "0x10", "::",         "::", "(", ")", "{",
        "}", ";",   "if",   "for",    "+",    ".5",   "__device__", "n",  "%", ","};
    const Dialect dialect;
    WordNumbers numbers(dialect);
    SequenceNumbers texts;
    std::map<std::vector<std::string>, uint32_t> expected;
    std::mt19937 random(1);
    for (int round = 0; round < 3000; ++round) {
        std::vector<std::string> tokens(random() % 12);
        NumberedWords text, common;
        for (std::string& token : tokens) {
            const std::string& written = words[random() % words.size()];
            const bool number = written[0] == '.' || (written[0] >= '0' && written[0] <= '9');
            token = number ? normal_number(written) : written;
            text.push_back(numbers.word(written, number ? TokenKind::Number : TokenKind::Identifier));
        }
        std::vector<std::string> said;
        for (const Statement& statement : split_statements(Words(tokens.begin(), tokens.end()), dialect))
            said.insert(said.end(), statement.common.begin(), statement.common.end());
        numbers.append_common(text, common);
        EXPECT_EQ(common.size(), said.size());
        const uint32_t number = texts.number(common);
        EXPECT_EQ(number == 0, said.empty());
        if (!said.empty()) {
            EXPECT_EQ(expected.try_emplace(said, number).first->second, number);
        }
    }
    std::set<uint32_t> distinct;
    for (const auto& [said, number] : expected) EXPECT_TRUE(distinct.insert(number).second);
}

TEST_F(Effort, CodeOutsidePairsIsCountedOnce) {
    write("port/k.comp", kTarget + "float helper(float x) {\n  return x * x;\n}\n");
    write("port/extra.comp", "float other(float x) {\n  return x + 1.0;\n}\n");
    commit("Helpers", 2);
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    EXPECT_EQ(report["totals"]["target_added"], 6);
    EXPECT_EQ(report["totals"]["novel_lines"], 6);
    EXPECT_EQ(report["totals"]["degree_of_portability"]["loc"], 0.0);
    EXPECT_EQ(report["target_outside_pairs"].size(), 2u);
    EXPECT_EQ(report["target_outside_pairs"][1]["added"], 3);
}

TEST_F(Effort, NewCodeThatWasPortedNeedsNoPairInTheMap) {
    const std::string body =
        "(float cosine, float eta) {\n"
        "  float r0 = (1.0f - eta) / (1.0f + eta);\n"
        "  r0 = r0 * r0;\n"
        "  float m = 1.0f - cosine;\n"
        "  float m2 = m * m;\n"
        "  return r0 + (1.0f - r0) * m2 * m2 * m;\n"
        "}\n";
    write("src/fresnel.cu", "__device__ float fresnel_schlick" + body);
    commit("Fresnel", 2);
    write("port/fresnel.cpp", "static inline float fresnel_schlick" + body);
    commit("Fresnel in the port", 3);
    const nlohmann::json report = json({"effort", "--from", "HEAD~2"});
    ASSERT_EQ(report["pairs"].size(), 1u);
    EXPECT_EQ(report["pairs"][0]["source"], "src/fresnel.cu:fresnel_schlick");
    EXPECT_EQ(report["pairs"][0]["target"], "port/fresnel.cpp:fresnel_schlick");
    EXPECT_EQ(report["pairs"][0]["state"], "suggested");
    EXPECT_EQ(report["totals"]["target_added"], 7);
    EXPECT_GE(report["totals"]["degree_of_portability"]["loc"], 6.0 / 7) << "but for the head line by line";
    EXPECT_TRUE(report["target_outside_pairs"].empty());
    // What the map leaves out with a reason stays outside.
    write("portmap.toml", kMap + "[[ignore]]\nid = \"src/fresnel.cu:*\"\nreason = \"not ported\"\n");
    commit("Left out", 4);
    EXPECT_TRUE(json({"effort", "--from", "HEAD~3"})["pairs"].empty());
}

TEST_F(Effort, APortOfOldCodeIsCarriedOverFromIt) {
    const std::string body =
        "  float sum = a * a + b * b + 1.0;\n"
        "  float root = sqrt(sum) * (a - b) / (a + b + 2.0);\n"
        "  return clamp(root, 0.0, 1.0) * sum;\n}\n";
    write("src/k.cu", "__device__ float shade(float a, float b) {\n" + body);
    std::filesystem::remove(root / "port/k.comp");
    commit("Not ported yet", 2);
    write("port/k.comp", "float shade(float a, float b) {\n" + body);
    commit("Ported", 3);
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    EXPECT_EQ(report["totals"]["source_added"], 0);
    EXPECT_EQ(report["totals"]["target_added"], 5);
    EXPECT_EQ(report["totals"]["novel_lines"], 0);
    EXPECT_EQ(report["totals"]["degree_of_portability"]["loc"], 1.0);
}

TEST_F(Effort, AFileThatMovedHasNotChanged) {
    git("mv port/k.comp port/shade.comp");
    write("portmap.toml", replaced(kMap, "port/k.comp", "port/shade.comp"));
    commit("Moved", 2);
    EXPECT_EQ(json({"effort", "--from", "HEAD~1"})["totals"]["target_added"], 0);
}

TEST_F(Effort, AUnitInTwoPairsCountsOnceInAll) {
    write("portmap.toml", kMap + "[[pair]]\nsource = \"src/k.cu:shade\"\ntarget = \"port/l.comp:shade\"\n");
    write("port/l.comp", kTarget);
    commit("A second port", 2);
    write("src/k.cu", replaced(kSource, "a * b", "a * b + 1.0f"));
    write("port/k.comp", replaced(kTarget, "a * b", "a * b + 1.0"));
    write("port/l.comp", replaced(kTarget, "a * b", "a * b + 1.0"));
    commit("Plus one", 3);
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    EXPECT_EQ(report["pairs"].size(), 2u);
    EXPECT_EQ(report["totals"]["source_added"], 1);
    EXPECT_EQ(report["totals"]["target_added"], 2);
    EXPECT_EQ(report["totals"]["novel_lines"], 0);
}

/// A long line that both sides have; deleting ` * 2.0` leaves two runs of 12 tokens that both sides still have.
const std::string kLong = "  float d = max(a * b, n * k) + a * a * 2.0 - min(b * b, n * n) * k;\n";

std::string long_line_unit(const std::string& start) {
    return start + "float shade(float a, float b, float n, float k) {\n" + kLong + "  return d;\n}\n";
}

TEST_F(Effort, ADeletionThatWasNotPortedIsNotCarriedOver) {
    write("src/k.cu", long_line_unit("__device__ "));
    write("port/k.comp", long_line_unit(""));
    commit("A long line", 2);
    write("src/k.cu", replaced(long_line_unit("__device__ "), " * 2.0", ""));
    commit("The source alone", 3);
    nlohmann::json totals = json({"effort", "--from", "HEAD~1"})["totals"];
    EXPECT_EQ(totals["source_added"], 1);
    EXPECT_EQ(totals["carried_over"], 0.0);
    write("port/k.comp", replaced(long_line_unit(""), " * 2.0", ""));
    commit("The port follows", 4);
    totals = json({"effort", "--from", "HEAD~1"})["totals"];
    EXPECT_EQ(totals["novel_lines"], 0) << "the source had it already";
    EXPECT_EQ(totals["degree_of_portability"]["loc"], 1.0);
    EXPECT_EQ(json({"effort", "--from", "HEAD~2"})["totals"]["carried_over"], 1.0);
}

TEST_F(Effort, ADeletionInThePortAloneIsNovel) {
    write("src/k.cu", long_line_unit("__device__ "));
    write("port/k.comp", long_line_unit(""));
    commit("A long line", 2);
    write("port/k.comp", replaced(long_line_unit(""), " * 2.0", ""));
    commit("The port alone", 3);
    const nlohmann::json totals = json({"effort", "--from", "HEAD~1"})["totals"];
    EXPECT_EQ(totals["novel_lines"], 1);
    EXPECT_EQ(totals["degree_of_portability"]["loc"], 0.0);
}

TEST_F(Effort, ALineThatThePortHadElsewhereIsNotCarriedOver) {
    write("src/k.cu", replaced(kSource, "  return", "  c = c + a;\n  return"));
    write("port/k.comp", replaced(kTarget, "  return", "  c = c + a;\n  return"));
    commit("Once", 2);
    write("src/k.cu", replaced(kSource, "  return", "  c = c + a;\n  c = c + a;\n  return"));
    commit("Twice in the source", 3);
    EXPECT_EQ(json({"effort", "--from", "HEAD~1"})["totals"]["carried_over"], 0.0);
    write("port/k.comp", replaced(kTarget, "  return", "  c = c + a;\n  c = c + a;\n  c = c + a;\n  return"));
    commit("Three times in the port", 4);
    const nlohmann::json totals = json({"effort", "--from", "HEAD~2"})["totals"];
    EXPECT_EQ(totals["carried_over"], 1.0);
    EXPECT_EQ(totals["novel_lines"], 1) << "the source has it twice";
}

TEST_F(Effort, APortThatBreaksTheLinesElsewhereHasThem) {
    write("src/k.cu", replaced(kSource, "  return", "  c = max(a * b, c) + min(a * a, b * b) - a * c;\n  return"));
    write("port/k.comp",
          replaced(kTarget, "  return", "  c = max(a * b, c) +\n      min(a * a, b * b) - a * c;\n  return"));
    commit("One statement", 2);
    const nlohmann::json totals = json({"effort", "--from", "HEAD~1"})["totals"];
    EXPECT_EQ(totals["carried_over"], 1.0);
    EXPECT_EQ(totals["novel_lines"], 0);
}

/// One source unit with two ports, of which one follows an edit of one line.
TEST_F(Effort, SeveralPortsCountAlikeInAnyOrder) {
    const std::string head =
        "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n"
        "[[pair]]\nsource = \"src/k.cu:shade\"\ntarget = [";
    const std::string k = "\"port/k.comp:shade\"", l = "\"port/l.comp:shade\"";
    write("portmap.toml", head + k + ", " + l + "]\n");
    write("port/l.comp", kTarget);
    commit("A second port", 2);
    write("src/k.cu", replaced(kSource, "a * b", "a * b + 1.0f"));
    write("port/k.comp", replaced(kTarget, "a * b", "a * b + 1.0"));
    commit("One follows", 3);
    const nlohmann::json one = json({"effort", "--from", "HEAD~1"})["totals"];
    EXPECT_EQ(one["carried_over"], 0.5) << "the mean of 1 and 0";
    write("portmap.toml", head + l + ", " + k + "]\n");
    EXPECT_EQ(json({"effort", "--from", "HEAD~1", "--config", "portmap.toml"})["totals"], one);
    write("port/l.comp", replaced(kTarget, "a * b", "a * b + 1.0"));
    commit("Both follow", 4);
    const nlohmann::json both = json({"effort", "--from", "HEAD~2"})["totals"];
    EXPECT_EQ(both["carried_over"], 1.0);
    EXPECT_EQ(both["edit_similarity"], 1.0) << "alike never exceeds 1";
}

TEST_F(Effort, HoursFromTheLedgerGiveTheirOwnFigure) {
    port_a_change();
    write("portmap.toml", kMap + porttool({"effort", "--from", "HEAD~1", "--format", "toml"}).out +
                              "block = \"Lights\"\nport = { coding = 2, testing = 0.5 }\n"
                              "redevelopment = { design = 2, coding = 4, testing = 3, documentation = 1 }\n");
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    ASSERT_EQ(report["degrees_of_portability"].size(), 3u);
    EXPECT_EQ(report["degrees_of_portability"][2]["model"], "hours");
    EXPECT_EQ(report["degrees_of_portability"][2]["value"], 0.75);
    EXPECT_EQ(report["ledger_degree_of_portability"]["inputs"]["records"], 1.0);
    EXPECT_EQ(report["ledger_blocks"][0]["block"], "Lights");
    EXPECT_NE(report["not_given"].dump().find("1 ports with hours are recorded; a fit needs at least 8"),
              std::string::npos);
}

TEST_F(Effort, EightRecordedPortsPredictTheHours) {
    port_a_change();
    std::string map = kMap;
    for (int i = 1; i <= 8; ++i) {  // 1 hour + 0.5 for a novel line + 0.25 for a carried one; 2 a line anew
        const int novel = 2 * i, carried = i * i % 5;
        map += "[[effort]]\nwhat = \"port\"\nlines = " + std::to_string(novel + carried) +
               "\nnovel = " + std::to_string(novel) +
               "\nport = { coding = " + std::to_string(1 + 0.5 * novel + 0.25 * carried) +
               " }\nredevelopment = { coding = " + std::to_string(2 * (novel + carried)) + " }\n";
    }
    write("portmap.toml", map);
    const nlohmann::json report = json({"effort", "--from", "HEAD~1"});
    EXPECT_NEAR(report["predicted_hours"]["value"], 1 + 0.5 * 1 + 0.25 * 2, 1e-6);
    EXPECT_NEAR(report["degrees_of_portability"].back()["value"], 1 - 2.0 / 6, 1e-6);

    // Ports of other projects are no records of this one's lines.
    write("portmap.toml", map +
                              "[[effort]]\nwhat = \"other\"\nlines = 50\nnovel = 20\nmined = true\n"
                              "port = { coding = 400 }\n");
    EXPECT_NEAR(json({"effort", "--from", "HEAD~1"})["predicted_hours"]["value"], 1 + 0.5 * 1 + 0.25 * 2, 1e-6);
}

TEST_F(Effort, EightRecordedPortsPredictTheHoursByHakutaAndOhminami) {
    port_a_change();
    std::string map = kMap + std::string("[cost]\nimpediments = { p = 0.5 }\n");
    for (int i = 1; i <= 8; ++i) {  // Y = 0.1 x 10^alpha_p x X
        const double alpha = 0.1 * (i % 3);
        map += "[[effort]]\nwhat = \"port\"\nlines = " + std::to_string(10 * i) +
               "\nmined = " + (i < 3 ? "true" : "false") + "\nimpediments = { p = " + std::to_string(alpha) +
               " }\nport = { coding = " + std::to_string(0.1 * std::pow(10, alpha) * 10 * i) + " }\n";
    }
    write("portmap.toml", map);
    const nlohmann::json hours = json({"effort", "--from", "HEAD~1"})["predicted_hours_by_law"];
    EXPECT_EQ(hours["model"], "Hakuta and Ohminami, equation 8, fitted");
    EXPECT_EQ(hours["inputs"]["of them mined"], 2.0);
    EXPECT_NEAR(hours["value"], 0.1 * std::pow(10, 0.5) * hours["inputs"]["lines"].get<double>(), 1e-4);
    EXPECT_NEAR(hours["inputs"]["beta_p"], 1, 1e-4);
    EXPECT_TRUE(hours["inputs"].contains("standard error of beta_p"));
    map.replace(map.find("p = 0.5"), 7, "p = 1e9");
    write("portmap.toml", map);
    EXPECT_TRUE(json({"effort", "--from", "HEAD~1"})["predicted_hours_by_law"].is_null());
    EXPECT_NE(
        porttool({"effort", "--from", "HEAD~1"}).out.find("equation 8: the recorded ports give no number of hours"),
        std::string::npos);
    write("portmap.toml", kMap + std::string("[[effort]]\nwhat = \"x\"\nmined = 1\n"));
    EXPECT_NE(porttool({"effort", "--from", "HEAD~1"}).err.find("'mined': expected true or false"), std::string::npos);
}

TEST_F(Effort, CommitsThatAreNotInLineAreComparedAsTheyAre) {
    port_a_change();
    const CommandRun got = porttool({"effort", "--from", "HEAD", "--to", "HEAD~1"});
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_NE(got.err.find("HEAD is no ancestor of HEAD~1"), std::string::npos) << got.err;
    EXPECT_NE(got.out.find("+0 -3"), std::string::npos) << got.out;
}

TEST_F(Effort, TextAndCsvNameModelAndInterval) {
    port_a_change();
    const std::string text = porttool({"effort", "--from", "HEAD~1"}).out;
    EXPECT_NE(text.find("lines of the port 3, shared 2"), std::string::npos) << text;
    EXPECT_NE(text.find("COCOMO II reuse"), std::string::npos);
    EXPECT_EQ(text.find("Moss"), std::string::npos);
    const std::string csv = porttool({"effort", "--from", "HEAD~1", "--format", "csv"}).out;
    EXPECT_NE(csv.find("total,,,2,0,3,0,1,1,0.633333,0.666667,"), std::string::npos) << csv;
}

TEST_F(Effort, WhatGitCannotGiveIsExitCodeTwo) {
    CommandRun got = porttool({"effort", "--from", "HEAD~1"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("--from HEAD~1: no such revision"), std::string::npos) << got.err;
    EXPECT_NE(got.err.find("a single commit"), std::string::npos) << got.err;
    port_a_change();
    git("clone -q --depth 1 'file://" + root.string() + "' shallow");
    got = porttool({"effort", "--from", "HEAD~1"}, (root / "shallow").string());
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("git fetch --unshallow"), std::string::npos) << got.err;
    got = porttool({"effort", "--from", "HEAD", "--format", "html"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_EQ(got.out, "");
    std::filesystem::remove_all(root / ".git");
    got = porttool({"effort", "--from", "HEAD"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("no git repository"), std::string::npos) << got.err;
}

TEST_F(Effort, TheMapMayBeYoungerThanTheRange) {
    port_a_change();
    git("rm -q --cached portmap.toml");
    git("commit -q --amend -m unmapped");
    std::filesystem::remove(root / "portmap.toml");
    EXPECT_EQ(json({"effort", "--from", "HEAD~1"})["pairs"].size(), 1u) << "the map of the older commit";
    git("checkout -q --orphan other");
    commit("Alone");
    const CommandRun got = porttool({"effort", "--from", "HEAD"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("there is no portmap.toml at"), std::string::npos) << got.err;
    write("portmap.toml", kMap);
    EXPECT_EQ(porttool({"effort", "--from", "HEAD"}).exit_code, 0) << "today's";
}

TEST(EffortLedger, AMapNamesWhatItCannotRead) {
    MemoryDisk disk = started(kSource, kTarget);
    const std::string map = disk.files.at("/r/portmap.toml");
    auto error_of = [&](const std::string& entry) {
        disk.files["/r/portmap.toml"] = map + entry;
        const CommandRun got = run(disk, {"-C", "/r", "check"});
        EXPECT_EQ(got.exit_code, 2) << entry;
        return got.err;
    };
    EXPECT_NE(error_of("[[effort]]\nwaht = \"x\"\n").find("did you mean 'what'"), std::string::npos);
    EXPECT_NE(error_of("[[effort]]\nlines = 3\n").find("'what' is missing"), std::string::npos);
    EXPECT_NE(error_of("[[effort]]\nwhat = \"x\"\nport = { design = 1 }\n").find("unknown key 'design'"),
              std::string::npos);
    for (const char* hours : {"-1", "nan", "inf", "1e300", "true", "\"2\""}) {
        const std::string error =
            error_of("[[effort]]\nwhat = \"x\"\nport = { coding = " + std::string(hours) + " }\n");
        EXPECT_NE(error.find("'coding': expected a number of at least 0 and at most 1e+09"), std::string::npos)
            << error;
    }
    EXPECT_NE(error_of("[cost]\nimpediments = { p = inf }\n").find("'p': expected a number"), std::string::npos);
    EXPECT_NE(error_of("[[effort]]\nwhat = \"x\"\nlines = 3\nnovel = 4\n").find("at most 'lines'"), std::string::npos);
    EXPECT_NE(error_of("[[effort]]\nwhat = \"x\"\nredevelopment = { coding = 0 }\n").find("no hours"),
              std::string::npos);
    EXPECT_NE(error_of("[reuse]\nunderstanding = 60\n").find("from 0 to 50"), std::string::npos);
    EXPECT_NE(error_of("[[block]]\nname = \"BSDF\"\nsource = \"a\"\ntarget = \"b\"\n[[effort]]\nwhat = \"x\"\n"
                       "block = \"BSFD\"\n")
                  .find("did you mean 'BSDF'"),
              std::string::npos);
    EXPECT_NE(error_of("[cost]\ncoding = 0\n").find("every weight is 0"), std::string::npos);
}

}  // namespace
}  // namespace porttool::testing::effort_test
