// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What programs that ran both sides saw, beside what the texts say. Which finding explains which difference follows
// from three functions of which one calls another; that was worked out by hand.
#include <gtest/gtest.h>

#include "porttool/text/fingerprint.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::evidence_test {
namespace {

using nlohmann::json;

const std::string kSource =
    "__device__ float fresnel(float c) { float m = 1.0f - c; return m * m; }\n"
    "__device__ float shade(float c) { return fresnel(c) * 0.5f; }\n"
    "__device__ float fog(float d) { return d * 0.125f; }\n";
const std::string kPort =
    "float fresnel(float c) { float m = 1.0 - c; return m * m; }\n"
    "float shade(float c) { return fresnel(c) * 0.5; }\n"
    "float fog(float d) { return d * 0.125; }\n";

json texts_of(const MemoryDisk& disk) {
    json out = json::array();
    for (const char* file : {"src/k.cu", "port/k.comp"}) {
        Fingerprinter print;
        print.add(disk.files.at(std::string("/r/") + file));
        out.push_back({{"file", file}, {"fingerprint", print.digits()}});
    }
    return out;
}

json pair_of(const std::string& name, const std::string& state) {
    json one = {{"source", "src/k.cu:" + name}, {"target", "port/k.comp:" + name}, {"state", state}};
    if (state == "differs")
        one["counterexample"] = {{"inputs", {{"c", 0.03999999910593033}}}, {"source", 0.25}, {"target", "nan"}};
    return one;
}

class Evidence : public ::testing::Test {
protected:
    /// What difftest would write of these pairs, in the tree as it is.
    void functions(const json& pairs) {
        disk.files["/e/f.json"] =
            json({{"version", 1}, {"kind", "difftest"}, {"texts", texts_of(disk)}, {"pairs", pairs}}).dump();
    }
    void picture(const json& more) {
        json all = {{"version", 1}, {"kind", "locate"}, {"texts", texts_of(disk)}};
        all.update(more);
        disk.files["/e/p.json"] = all.dump();
    }
    void edit(const std::string& from, const std::string& to) {
        disk.files["/r/src/k.cu"] = replaced(disk.files["/r/src/k.cu"], from, to);
    }
    CommandRun checked(const std::vector<std::string>& files, const std::string& format = "json") {
        std::vector<std::string> arguments = {"-C", "/r", "check", "--format", format, "--evidence"};
        arguments.insert(arguments.end(), files.begin(), files.end());
        return run(disk, arguments);
    }
    json report(const std::vector<std::string>& files) { return json::parse(checked(files).out); }

    MemoryDisk disk = started(kSource, kPort);
};

TEST_F(Evidence, ADifferenceThatNoEditExplainsIsAFinding) {
    functions({pair_of("shade", "differs"), pair_of("fog", "same")});
    const CommandRun got = checked({"/e/f.json"});
    EXPECT_EQ(got.exit_code, 1);
    const json out = json::parse(got.out);
    ASSERT_EQ(rules(out), Rules{"unexplained-difference"});
    const json& finding = out["findings"][0];
    EXPECT_EQ(finding["level"], "error");
    EXPECT_EQ(finding["source"]["id"], "src/k.cu:shade");
    EXPECT_EQ(finding["target"]["id"], "port/k.comp:shade");
    EXPECT_EQ(finding["evidence"]["counterexample"]["inputs"]["c"].get<double>(), 0.03999999910593033);
    EXPECT_NE(finding["message"].get<std::string>().find("; differs for c = 0.04: 0.25, nan"), std::string::npos)
        << finding["message"];
    EXPECT_TRUE(finding["evidence"]["kernel"].is_null());
    EXPECT_EQ(out["summary"]["drifted"], 1);
    EXPECT_EQ(out["summary"]["verified"], 1) << "fog ran and was the same";
    EXPECT_EQ(out["summary"]["recorded"], 2);
}

TEST_F(Evidence, AnEditOfWhatAFunctionCallsExplainsIt) {
    edit("m * m", "m * m * m");
    functions(json::array({pair_of("shade", "differs")}));
    const json out = report({"/e/f.json"});
    ASSERT_EQ(rules(out), Rules{"source-changed"});
    EXPECT_EQ(out["findings"][0]["source"]["id"], "src/k.cu:fresnel");
    EXPECT_NE(out["findings"][0]["message"].get<std::string>().find("; shade, which uses it, differs for c = 0.04"),
              std::string::npos);
    EXPECT_EQ(out["findings"][0]["evidence"]["counterexample"]["target"], "nan");
    // Also where a person left that edit as it is.
    run(disk, {"-C", "/r", "ignore", "src/k.cu:fresnel", "--reason", "measured"});
    EXPECT_EQ(rules(report({"/e/f.json"})), Rules{});
}

TEST_F(Evidence, ASettledEditThatWasSeenToChangeNothingExplainsNothing) {
    edit("return m * m", "return m * m * 1.0f");
    run(disk, {"-C", "/r", "ignore", "src/k.cu:fresnel", "--reason", "the same"});
    functions({pair_of("fresnel", "same"), pair_of("shade", "differs")});
    EXPECT_EQ(rules(report({"/e/f.json"})), Rules{"unexplained-difference"});
    functions({pair_of("fresnel", "differs"), pair_of("shade", "differs")});
    EXPECT_EQ(rules(report({"/e/f.json"})), Rules{});
}

TEST_F(Evidence, AnEditElsewhereExplainsNothing) {
    edit("d * 0.125f", "d * 0.25f");
    functions(json::array({pair_of("shade", "differs")}));
    EXPECT_EQ(rules(report({"/e/f.json"})), (Rules{"unexplained-difference", "source-changed"}));
    edit("fresnel(c) * 0.5f", "fresnel(c) * 0.75f");  // nor does the caller explain what it calls
    functions(json::array({pair_of("fresnel", "differs")}));
    EXPECT_EQ(rules(report({"/e/f.json"})), (Rules{"unexplained-difference", "source-changed", "source-changed"}));
}

TEST_F(Evidence, ALocalThatBearsTheNameOfAFunctionIsNoUseOfIt) {
    disk = started(kSource + "__device__ float haze(float fresnel) { return fresnel * 2.0f; }\n",
                   kPort + "float haze(float fresnel) { return fresnel * 2.0; }\n");
    edit("m * m", "m * m * m");
    functions(json::array({pair_of("haze", "differs")}));
    EXPECT_EQ(rules(report({"/e/f.json"})), (Rules{"source-changed", "unexplained-difference"}));
}

TEST_F(Evidence, ACommentSettlesItAndIsNotIdleWithout) {
    edit("__device__ float shade",
         "// porttool: ignore(unexplained-difference) half precision\n__device__ float shade");
    functions(json::array({pair_of("shade", "differs")}));
    EXPECT_EQ(checked({"/e/f.json"}).exit_code, 0);
    EXPECT_EQ(rules(report({"/e/f.json"})), Rules{});
    EXPECT_EQ(rules(check(disk)), Rules{});
    functions(json::array({pair_of("fog", "same")}));
    EXPECT_EQ(rules(report({"/e/f.json"})), Rules{"unused-suppression"});
}

json parting(const std::string& kernel) {
    return {{"segment", 4},  {"kernel", kernel},       {"field", "radiance"}, {"paths", 310},
            {"share", 0.31}, {"materials", {"glass"}}, {"pixel", {12, 7}}};
}

TEST_F(Evidence, APictureIsExplainedByWhatItsKernelReaches) {
    const json kernels = {{{"kernel", "shade"}, {"source", "src/k.cu:shade"}, {"target", "port/k.comp:shade"}},
                          {{"kernel", "fog"}, {"source", "src/k.cu:fog"}, {"target", "port/k.comp:fog"}}};
    edit("m * m", "m * m * m");
    picture({{"kernels", kernels}, {"differences", json::array({parting("shade")})}, {"ssim", 0.93}});
    json out = report({"/e/p.json"});
    ASSERT_EQ(rules(out), Rules{"source-changed"});
    const std::string message = out["findings"][0]["message"];
    EXPECT_NE(message.find("; 31 % of the paths part in 'radiance' of shade, material 'glass', 3 bounces; SSIM 0.93"),
              std::string::npos)
        << message;
    const json& seen = out["findings"][0]["evidence"];
    EXPECT_EQ(seen["kernel"], "shade");
    EXPECT_EQ(seen["segment"], 4);
    EXPECT_EQ(seen["share"], 0.31);
    EXPECT_EQ(seen["pixel"], (json{12, 7}));
    EXPECT_TRUE(seen["counterexample"].is_null());
    // Of another kernel the edit says nothing.
    picture({{"kernels", kernels}, {"first", parting("fog")}});
    out = report({"/e/p.json"});
    EXPECT_EQ(rules(out), (Rules{"source-changed", "unexplained-difference"}));
    EXPECT_EQ(out["findings"][1]["source"]["id"], "src/k.cu:fog");
    EXPECT_TRUE(out["findings"][0]["evidence"].is_null());
    // A kernel of which nothing is known is told as well.
    picture({{"first", parting("extend")}});
    out = report({"/e/p.json"});
    ASSERT_EQ(rules(out).size(), 2u);
    EXPECT_NE(out.dump().find("the pictures part in extend, and no finding"), std::string::npos);
    picture({{"first", nullptr}});
    EXPECT_EQ(rules(report({"/e/p.json"})), Rules{"source-changed"});
}

TEST_F(Evidence, EveryFormatTellsIt) {
    disk.files["/e/where.png"] = "\x89PNG\r\n\x1a\nabc";
    disk.files["/e/other.txt"] = "secret";
    disk.files["/secret.png"] = "\x89PNG\r\n\x1a\nsecret";
    picture({{"first", parting("k")}, {"pictures", {"where.png", "../secret.png", "other.txt", "none.png"}}});
    for (const char* format : {"text", "markdown", "github", "gitlab", "junit", "html", "sarif"})
        EXPECT_NE(checked({"/e/p.json"}, format).out.find(" of the paths part in"), std::string::npos) << format;
    const std::string page = checked({"/e/p.json"}, "html").out;
    EXPECT_NE(page.find("src=\"data:image/png;base64,iVBORw0KGgphYmM=\""), std::string::npos);
    EXPECT_EQ(page.find("<img", page.find("<img") + 1), std::string::npos) << "one picture, the others are none";
    EXPECT_NE(page.find("other.txt is no PNG"), std::string::npos);
    const json log = json::parse(checked({"/e/p.json"}, "sarif").out);
    EXPECT_EQ(log["runs"][0]["results"][0]["properties"]["evidence"]["pictures"][0], "/e/where.png");
    for (const char* foreign :
         {"/secret.png", "../secret.png", "a/../../b.png", "C:\\b.png", "http://x/y.png", "..", ""}) {
        picture({{"first", parting("k")}, {"pictures", {foreign, "where.png"}}});
        for (const json& seen :
             {json::parse(checked({"/e/p.json"}, "sarif").out)["runs"][0]["results"][0]["properties"],
              report({"/e/p.json"})["findings"][0]})
            EXPECT_EQ(seen["evidence"]["pictures"], json::array({"/e/where.png"})) << foreign;
    }
}

TEST_F(Evidence, OfOtherTextsIsRefusedWithTheirNames) {
    functions(json::array({pair_of("shade", "same")}));
    edit("0.5f", "0.25f");
    const CommandRun got = checked({"/e/f.json"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_EQ(got.out, "");
    EXPECT_EQ(got.err,
              "porttool: --evidence /e/f.json: other texts ran than those of this tree: src/k.cu\nRun it again here\n");
    // White space, too, is another text; but not how lines end.
    disk = started(kSource, kPort);
    functions(json::array({pair_of("shade", "same")}));
    std::string& text = disk.files["/r/src/k.cu"];
    for (size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.replace(at, 1, "\r\n");
    EXPECT_EQ(checked({"/e/f.json"}).exit_code, 0);
}

TEST_F(Evidence, WhatIsNoEvidenceIsOneLine) {
    functions(json::array({pair_of("shade", "same")}));
    const json good = json::parse(disk.files["/e/f.json"]);
    const auto with = [&](const char* name, const json& value) {
        json out = good;
        out[name] = value;
        return out.dump();
    };
    const auto located = [&](const json& difference, const json& more) {
        json out = {{"version", 1}, {"kind", "locate"}, {"texts", good["texts"]}, {"first", difference}};
        out.update(more);
        return out.dump();
    };
    const auto odd = [&](const char* name, const json& value) {
        json difference = parting("shade");
        difference[name] = value;
        return located(difference, json::object());
    };
    const auto whole = [&](const char* name, const json& value) { return located(parting("shade"), {{name, value}}); };
    const std::vector<std::string> bad = {
        "",
        "{",
        "[]",
        "null",
        "{\"pairs\": []}",
        disk.files["/e/f.json"].substr(0, disk.files["/e/f.json"].size() / 2),
        std::string(200'000, '['),
        "{\"version\":1,\"kind\":\"difftest\",\"texts\":" + std::string(100'000, '['),
        with("version", 2),
        with("version", "1"),
        with("kind", "coverage"),
        with("kind", "locate"),
        with("texts", json::array()),
        with("texts", {{{"file", "src/k.cu"}, {"fingerprint", "../../etc"}}}),
        with("texts", {{{"file", "src/none.cu"}, {"fingerprint", "0123456789abcdef"}}}),
        with("pairs", 7),
        with("pairs", {{{"source", "a"}}}),
        with("texts", json::array({good["texts"][0]})),  // of the source alone
        with("texts", json::array({good["texts"][1]})),
        with("pairs", {{{"source", "src/k.cu:shade"}, {"target", "port/other.comp:shade"}, {"state", "same"}}}),
        with("pairs", {{{"source", "src/k.cu:fog"}, {"target", "port/k.comp:fog"}, {"state", "same"}, {"inputs", -1}}}),
        odd("share", 1.5),
        odd("share", -0.25),
        odd("share", "0.5"),
        odd("segment", -3),
        odd("segment", 2.5),
        odd("paths", -1),
        odd("pixel", {1, -2}),
        odd("pixel", {1, 2, 3}),
        whole("ssim", 2),
        whole("ssim", "nan"),
    };
    for (const std::string& text : bad) {
        disk.files["/e/bad.json"] = text;
        const CommandRun got = checked({"/e/bad.json"});
        EXPECT_EQ(got.exit_code, 2) << text.substr(0, 80);
        EXPECT_EQ(got.out, "");
        EXPECT_EQ(got.err.find("porttool: --evidence /e/bad.json: "), 0u) << got.err;
        EXPECT_LE(std::count(got.err.begin(), got.err.end(), '\n'), 2) << got.err;
    }
    EXPECT_EQ(checked({"/e/none.json"}).exit_code, 2);
    EXPECT_EQ(checked({"/e"}).exit_code, 2);
}

}  // namespace
}  // namespace porttool::testing::evidence_test
