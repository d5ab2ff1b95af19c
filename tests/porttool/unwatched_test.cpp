// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What no pair watches: new units and their likely counterparts, the baseline, pairs that were never recorded.
#include <gtest/gtest.h>

#include "tests/porttool/temporary_repository.h"

namespace porttool::testing::unwatched_test {
namespace {

CommandRun porttool_at_r(Disk& disk, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"-C", "/r"});
    return run(disk, arguments);
}

const std::string kLum = "__device__ float lum(float3 c) { return 0.2f * c.x + 0.7f * c.y + 0.1f * c.z; }\n";
const std::string kLumPort = "float lum(vec3 c) { return 0.2 * c.x + 0.7 * c.y + 0.1 * c.z; }\n";
const std::string kFresnel =
    "__device__ float fresnel(float c, float f0) {\n    float k = 1.0f - c;\n    float k2 = k * k;\n"
    "    return f0 + (1.0f - f0) * k2 * k2 * k;\n}\n";
const std::string kFresnelPort =
    "float fresnel(float c, float f0) {\n    float k = 1.0 - c;\n    float k2 = k * k;\n"
    "    return f0 + (1.0 - f0) * k2 * k2 * k;\n}\n";
const std::string kHash =
    "__device__ unsigned hash_of(unsigned seed) {\n    seed ^= seed >> 16;\n    seed *= 0x7feb352du;\n"
    "    seed ^= seed >> 15;\n    return seed;\n}\n";

TEST(Unwatched, ANewUnitWithACounterpartNamesItAndTheAcceptThatTakesIt) {
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] += kFresnel;
    disk.files["/r/port/k.comp"] += kFresnelPort;
    const CommandRun got = porttool_at_r(disk, {"check", "--format", "json"});
    EXPECT_EQ(got.exit_code, 1) << "from 0.9 on an error";
    const auto report = nlohmann::json::parse(got.out);
    ASSERT_EQ(rules(report), Rules{"unpaired"}) << report.dump(1);
    const auto& finding = report["findings"][0];
    EXPECT_EQ(finding["level"], "error");
    EXPECT_EQ(finding["source"]["id"], "src/k.cu:fresnel");
    EXPECT_EQ(finding["target"]["id"], "port/k.comp:fresnel");
    const std::string message = finding["message"];
    for (const char* part : {"port/k.comp:fresnel", "(0.9", "porttool accept 'src/k.cu:fresnel=port/k.comp:fresnel'"})
        EXPECT_TRUE(message.find(part) != std::string::npos || message.find("(1.00)") != std::string::npos) << message;
    EXPECT_EQ(report["summary"]["unpaired"], 1);
    EXPECT_EQ(report["summary"]["unpaired_changed"], 1);
    EXPECT_EQ(report["summary"]["units"], 2);

    const CommandRun taken = porttool_at_r(disk, {"accept", "src/k.cu:fresnel=port/k.comp:fresnel"});
    EXPECT_EQ(taken.exit_code, 0) << taken.err;
    EXPECT_NE(disk.files["/r/portmap.toml"].find(
                  "[[pair]]\nsource = \"src/k.cu:fresnel\"\ntarget = \"port/k.comp:fresnel\"\n"),
              std::string::npos);
    EXPECT_TRUE(check(disk)["findings"].empty());
    EXPECT_EQ(check(disk)["summary"]["pairs"], 2);
    disk.files["/r/src/k.cu"] = replaced(disk.files["/r/src/k.cu"], "1.0f - c", "1.0f - c * c");
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"}) << "it is watched from then on";
}

TEST(Unwatched, AcceptTakesTheFingerprintOfTheFindingAsWell) {
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] += kFresnel;
    disk.files["/r/port/k.comp"] += kFresnelPort;
    const std::string print = check(disk)["findings"][0]["fingerprint"];
    EXPECT_EQ(porttool_at_r(disk, {"accept", print}).exit_code, 0);
    EXPECT_TRUE(check(disk)["findings"].empty());
}

TEST(Unwatched, AcceptOfUnitsThatAreNotThereIsRefused) {
    MemoryDisk disk = started(kLum, kLumPort);
    const std::string map = disk.files["/r/portmap.toml"];
    const CommandRun got = porttool_at_r(disk, {"accept", "src/k.cu:lum=port/k.comp:lums"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("no such pair"), std::string::npos) << got.err;
    EXPECT_EQ(disk.files["/r/portmap.toml"], map);
}

TEST(Unwatched, AMapWhosePairsStandInOneLineIsLeftToItsAuthor) {
    MemoryDisk disk;
    disk.files = {{"/r/src/k.cu", kLum + kFresnel},
                  {"/r/port/k.comp", kLumPort + kFresnelPort},
                  {"/r/portmap.toml",
                   "version = 1\npair = [{source = \"src/k.cu:lum\", target = \"port/k.comp:lum\"}]\n"
                   "[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n"}};
    EXPECT_EQ(porttool_at_r(disk, {"init"}).exit_code, 0);
    const auto before = disk.files;
    const CommandRun got = porttool_at_r(disk, {"accept", "src/k.cu:fresnel=port/k.comp:fresnel"});
    EXPECT_EQ(got.exit_code, 2);
    EXPECT_NE(got.err.find("by hand"), std::string::npos) << got.err;
    EXPECT_EQ(disk.files, before);
}

TEST(Unwatched, UnportedIsLeftForWhatNothingLooksLike) {
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] += kHash;
    EXPECT_EQ(rules(check(disk)), Rules{"unported"});
    EXPECT_EQ(porttool_at_r(disk, {"ignore", "src/k.cu:hash_of", "--reason", "on the device alone"}).exit_code, 0);
    EXPECT_EQ(check(disk)["verdict"], "in_step");
    EXPECT_EQ(check(disk)["summary"]["unpaired"], 0) << "somebody said why";
    EXPECT_EQ(check(disk)["summary"]["unported"], 1);
}

TEST(Unwatched, ATargetThatHasItsSourceIsACandidateButNoneToBeSureOf) {
    MemoryDisk disk = started(kFresnel, kFresnelPort);
    disk.files["/r/src/more.cu"] = kFresnel;
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"unpaired"}) << report.dump(1);
    EXPECT_EQ(report["findings"][0]["level"], "warning");
    EXPECT_NE(report["findings"][0]["message"].get<std::string>().find("paired with src/k.cu:fresnel"),
              std::string::npos);
    EXPECT_EQ(report["verdict"], "review");
}

TEST(Unwatched, AVariantOfAShaderLooksLikeThePortOfThat) {
    const std::string head =
        "#version 450\n"
        "layout(local_size_x = 64) in;\n"
        "layout(binding = 0) buffer In { float data[]; } src;\n"
        "layout(binding = 1) buffer Out { float data[]; } dst;\n"
        "layout(push_constant) uniform P { int w; int h; int top; int left; int outw; int outh; int type; } p;\n"
        "void main()\n"
        "{\n"
        "    int gx = int(gl_GlobalInvocationID.x);\n"
        "    int gy = int(gl_GlobalInvocationID.y);\n"
        "    if (gx >= p.outw || gy >= p.outh) return;\n";
    const std::string
        crop = "    dst.data[gy * p.outw + gx] = src.data[(gy + p.top) * p.w + gx + p.left];\n}\n",
        scale =
            "    float s = sqrt(float(p.w * p.h));\n    dst.data[gy * p.outw + gx] = src.data[gy * p.w + gx] * s;\n}\n",
        pad =
            "    int x = gx - p.left;\n"
            "    int y = gy - p.top;\n"
            "    float v = 0.0;\n"
            "    if (p.type == 0 && x >= 0 && x < p.w && y >= 0 && y < p.h) v = src.data[y * p.w + x];\n"
            "    if (p.type == 1) v = src.data[clamp(y, 0, p.h - 1) * p.w + clamp(x, 0, p.w - 1)];\n"
            "    dst.data[gy * p.outw + gx] = v;\n"
            "}\n",
        reflect =
            "    int x = abs(gx - p.left);\n"
            "    int y = abs(gy - p.top);\n"
            "    if (x >= p.w) x = 2 * p.w - 2 - x;\n"
            "    if (y >= p.h) y = 2 * p.h - 2 - y;\n"
            "    dst.data[gy * p.outw + gx] = src.data[y * p.w + x];\n"
            "}\n";
    const auto port = [](const std::string& name, const std::string& text) {
        return "int " + name +
               "::forward(const Mat& in, Mat& out) const\n{\n    for (int gy = 0; gy < outh; ++gy)\n        for (int "
               "gx = "
               "0; gx < outw; ++gx) {\n" +
               text + "        }\n    return 0;\n}\n";
    };
    const std::string of_pad =
        "int x = gx - left;\nint y = gy - top;\nfloat v = 0.0f;\n"
        "if (type == 0 && x >= 0 && x < w && y >= 0 && y < h) v = in[y * w + x];\n"
        "if (type == 1) v = in[std::clamp(y, 0, h - 1) * w + std::clamp(x, 0, w - 1)];\n"
        "if (type == 2) {\n    x = std::abs(x);\n    y = std::abs(y);\n    if (x >= w) x = 2 * w - 2 - x;\n"
        "    if (y >= h) y = 2 * h - 2 - y;\n    v = in[y * w + x];\n}\nout[gy * outw + gx] = v;\n";
    MemoryDisk disk;
    disk.files = {{"/r/src/crop.comp", head + crop},
                  {"/r/src/scale.comp", head + scale},
                  {"/r/src/padding.comp", head + pad},
                  {"/r/port/crop.cpp", port("Crop", "out[gy * outw + gx] = in[(gy + top) * w + gx + left];\n")},
                  {"/r/port/scale.cpp", port("Scale",
                                             "float s = std::sqrt(float(w * h));\nout[gy * outw + gx] = in[gy * w "
                                             "+ gx] * s;\n")},
                  {"/r/port/padding.cpp", port("Padding", of_pad)}};
    ASSERT_EQ(porttool_at_r(disk, {"init", "--source", "src/*", "--target", "port/*"}).exit_code, 0);
    ASSERT_EQ(check(disk)["summary"]["pairs"], 3);
    const auto told_of = [&](const std::string& path, const std::string& text) {
        disk.files["/r/" + path] = head + text;
        const auto report = check(disk);
        disk.files.erase("/r/" + path);
        std::string out;
        for (const auto& finding : report["findings"])
            if (finding["source"].is_object() && finding["source"]["id"] == path + ":main")
                out = finding["level"].get<std::string>() + " " + finding["rule"].get<std::string>() + " " +
                      (finding["target"].is_object() ? finding["target"]["id"].get<std::string>() : "");
        return out;
    };
    EXPECT_EQ(told_of("src/padding_reflect.comp", reflect), "warning unpaired port/padding.cpp:Padding::forward");
    EXPECT_EQ(told_of("src/other.comp", "    dst.data[gy] = exp(src.data[gx]) + float(bitCount(gy)) / 7.5;\n}\n"),
              "error unported ");
}

TEST(Unwatched, WhatChecksAKernelIsNoSourceOfItsPort) {
    MemoryDisk disk = started(kFresnel, kFresnelPort);
    disk.files["/r/src/check.cu"] = replaced(replaced(kFresnel, "fresnel", "fresnel_ref"), "__device__ ", "");
    EXPECT_EQ(rules(check(disk)), Rules{"unported"});
}

TEST(Unwatched, OneMoreOfAKindIsNoSourceOfItsSiblingsPort) {
    const auto load = [](const std::string& name, const std::string& bits) {
        return "void load_" + name +
               "(const int* in, int* out, int n) {\n    for (int i = 0; i < n; ++i) out[i] = in[i] >> " + bits +
               " & 15;\n}\n";
    };
    MemoryDisk disk = started(load("q8", "8"), load("q8", "8"));
    disk.files["/r/src/k.cu"] += load("q1", "1");
    EXPECT_EQ(rules(check(disk)), Rules{"unported"});
}

TEST(Unwatched, ACommentThatSettlesUnportedSettlesUnpairedToo) {
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] += "// porttool: ignore(unported) not yet\n" + kFresnel;
    EXPECT_TRUE(check(disk)["findings"].empty());
    disk.files["/r/port/k.comp"] += kFresnelPort;
    EXPECT_TRUE(check(disk)["findings"].empty()) << check(disk).dump(1);
}

TEST(Unwatched, RulesOfTheMapWin) {
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] += kFresnel;
    disk.files["/r/port/k.comp"] += kFresnelPort;
    disk.files["/r/portmap.toml"] += "\n[rules]\nunpaired = \"note\"\n";
    EXPECT_EQ(check(disk)["findings"][0]["level"], "note");
    EXPECT_EQ(check(disk)["verdict"], "in_step");
}

/// What becomes of a unit of the baseline without its being a new one.
TEST(Unwatched, WhatABaselinedUnitBecomesIsNotNew) {
    const std::string hash2 = replaced(kHash, "hash_of", "hash_more") + "// end\n";
    const std::string edited = replaced(kHash, "15", "17");
    struct Row {
        const char* says;
        std::map<std::string, std::string> files;
        size_t changed;
    };
    for (const Row& row : std::vector<Row>{
             {"as it was", {{"k.cu", kLum + kHash}}, 0},
             {"static inline", {{"k.cu", kLum + replaced(kHash, "__device__", "static inline")}}, 1},
             {"renamed", {{"k.cu", kLum + replaced(kHash, "hash_of", "mix_bits")}}, 0},
             {"renamed with its parameter",
              {{"k.cu", kLum + replaced(replaced(kHash, "hash_of(unsigned seed", "mix(unsigned seed"), "{\n", "{ \n")}},
              0},
             {"in a namespace", {{"k.cu", kLum + "namespace gpu {\n" + edited + "}\n"}}, 1},
             {"in another file", {{"k.cu", kLum}, {"hash.cu", kHash}}, 0},
             {"in another file, and edited", {{"k.cu", kLum}, {"hash.cu", edited}}, 1},
         }) {
        MemoryDisk disk = started(kLum + kHash, kLumPort);
        disk.files.erase("/r/src/k.cu");
        for (const auto& [name, text] : row.files) disk.files["/r/src/" + name] = text;
        const auto report = check(disk);
        EXPECT_TRUE(report["findings"].empty()) << row.says << report.dump(1);
        EXPECT_EQ(report["summary"]["unpaired"], 1) << row.says;
        EXPECT_EQ(report["summary"]["unpaired_changed"], row.changed) << row.says;
        EXPECT_EQ(porttool_at_r(disk, {"accept", "--all"}).exit_code, 0);
        EXPECT_TRUE(check(disk)["findings"].empty()) << row.says << ": the record follows it";
        EXPECT_EQ(porttool_at_r(disk, {"accept", "--all", "--force"}).exit_code, 0);
        EXPECT_EQ(check(disk)["summary"]["unpaired_changed"], 0) << row.says << ": it was looked at";
        const auto rows = nlohmann::json::parse(porttool_at_r(disk, {"report", "--format", "json"}).out);
        for (const auto& unit : rows["units"])
            if (unit["source"].is_object() && unit["target"].is_null() && unit["source"]["kind"] == "function") {
                EXPECT_EQ(unit["share"], "one_sided") << row.says << ": report and check agree";
            }
    }
    MemoryDisk disk = started(kLum + kHash, kLumPort);
    disk.files["/r/src/k.cu"] += hash2;
    EXPECT_EQ(rules(check(disk)), Rules{"unported"}) << "a second one is new";
}

TEST(Unwatched, TheBaselineIsCountedAndNeverListed) {
    MemoryDisk disk = started(kLum + kHash + kFresnel, kLumPort);
    disk.files["/r/src/k.cu"] = kLum + replaced(kHash, "15", "17") + kFresnel;
    const CommandRun got = porttool_at_r(disk, {"check"});
    EXPECT_EQ(got.exit_code, 0);
    EXPECT_NE(got.out.find("2 of 3 source units are not watched, 1 of them changed here"), std::string::npos)
        << got.out;
    EXPECT_EQ(got.out.find("hash_of"), std::string::npos);
}

/// Levels and ids of what is said of new units without a counterpart, sorted by id.
std::vector<std::string> unported_in(const nlohmann::json& report) {
    std::vector<std::string> out;
    for (const auto& finding : report["findings"])
        if (finding["rule"] == "unported")
            out.push_back(finding["source"]["id"].get<std::string>() + " " + finding["level"].get<std::string>());
    std::sort(out.begin(), out.end());
    return out;
}

const std::string kMix = "__device__ float mix_in(float c) { return c * SCALE + 0.25f; }\n";

TEST(Unwatched, WhatAWatchedUnitUsesIsToldWithIt) {
    MemoryDisk disk = started(kLum + kHash, kLumPort);
    const auto with = [&](const std::string& text) {
        disk.files["/r/src/k.cu"] = text;
        return check(disk);
    };
    const std::string uses = replaced(kLum, "return 0.2f", "return mix_in(c.x) + 0.2f");
    const auto watched = with("#define SCALE 2.0f\n" + kMix + uses + kHash);
    EXPECT_EQ(unported_in(watched), (std::vector<std::string>{"src/k.cu:SCALE note", "src/k.cu:mix_in note"}));
    EXPECT_EQ(watched["verdict"], "drift") << "the edit that uses it is told";
    EXPECT_EQ(watched["summary"]["unpaired_changed"], 2) << "nobody watches them all the same";

    EXPECT_EQ(
        unported_in(with("#define SCALE 2.0f\n" + kMix + kLum + replaced(kHash, "return seed", "return mix_in(seed)"))),
        (std::vector<std::string>{"src/k.cu:SCALE note", "src/k.cu:mix_in note"}))
        << "what uses it has no port either";
    EXPECT_EQ(
        unported_in(with("#if FAST\n#define SCALE 2.0f\n#else\n#define SCALE 3.0f\n#endif\n" + kMix + uses + kHash)),
        (std::vector<std::string>{"src/k.cu:SCALE note", "src/k.cu:SCALE#2 note", "src/k.cu:mix_in note"}))
        << "both branches of a constant";
    const std::string chooser =
        "__device__ float choose(int i, float3 c) { return i == 0 ? lum(c) : i == 1 ? 0.5f : c.x; }\n";
    MemoryDisk other = started(kLum + chooser, kLumPort);
    other.files["/r/src/k.cu"] = "#define SCALE 2.0f\n" + kMix + kLum + replaced(chooser, "0.5f", "mix_in(c.x)");
    EXPECT_EQ(unported_in(check(other)), (std::vector<std::string>{"src/k.cu:SCALE note", "src/k.cu:mix_in error"}))
        << "what uses it has no port, but joins what has";
    EXPECT_EQ(unported_in(with("#define SCALE 2.0f\n" + kMix + kLum + kHash)),
              (std::vector<std::string>{"src/k.cu:SCALE note", "src/k.cu:mix_in error"}))
        << "nothing uses the function";
    EXPECT_EQ(unported_in(with(kMix + replaced(kLum, "0.2f", "mix_in.x") + kHash)),
              (std::vector<std::string>{"src/k.cu:mix_in error"}))
        << "a variable of its name is no call";
    EXPECT_EQ(unported_in(with(kMix + "__device__ float mix_in(int c) { return c; }\n" + uses + kHash)),
              (std::vector<std::string>{"src/k.cu:mix_in note", "src/k.cu:mix_in#2 note"}))
        << "whichever of the two is called, both are new";
}

TEST(Unwatched, AMacroInThePlaceOfAWordOfTheLanguageIsToldForItself) {
    for (const char* macro : {"return one_more return", "return", "float double", "if(x) if (!(x))", "struct union"}) {
        MemoryDisk disk = started(kLum, kLumPort);
        disk.files["/r/src/k.cu"] = "#define " + std::string(macro) + "\n" + kLum;
        const auto report = check(disk);
        ASSERT_EQ(rules(report), Rules{"unported"}) << macro;
        EXPECT_EQ(report["findings"][0]["level"], "error") << macro << ": lum() means something else, unedited";
    }
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] = "#define DEVICE __device__\n" + kLum;
    EXPECT_EQ(rules(check(disk)), Rules{}) << "what only names a qualifier is no unit";
}

/// A pair that no edit touches, beside a header of its own side and one that it does not include.
std::map<std::string, std::string> macro_project() {
    return {{"/r/src/k.cu",
             "#include \"real.cuh\"\n#define real float\n__device__ real f(real x, real* restrict p) "
             "{ return sinf(x) + fma(x, p[0], x); }\n__device__ real g(real x) { return sinf(x); }\n"},
            {"/r/src/real.cuh", "#pragma once\n"},
            {"/r/src/other.cuh", "#pragma once\n"},
            {"/r/port/k.comp",
             "float f(float x, float p) { return sin(x) + fma(x, p, x); }\n"
             "float g(float x) { return sin(x); }\n"},
            {"/r/portmap.toml",
             "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n"
             "[[pair]]\nsource = \"src/k.cu:f\"\ntarget = \"port/k.comp:f\"\n"
             "[[pair]]\nsource = \"src/k.cu:g\"\ntarget = \"port/k.comp:g\"\n"}};
}

/// A lock as it was written before its lines said what macros make of words.
std::string without_macros(std::string lock) {
    for (size_t at = 0; (at = lock.find("-macros=", at)) != std::string::npos;)
        lock.erase(at - 7, std::min(lock.find_first_of("\t\n", at), lock.size()) - at + 7);
    return lock;
}

struct MacroRow {
    const char *file, *from, *to;  ///< the edit: `to` goes before the text where `from` is ""
    const char* says;              ///< of the finding; "" for none
};

TEST(Unwatched, AMacroThatGivesAWordOfAnUneditedUnitAnotherMeaningIsAnError) {
    const std::vector<MacroRow> rows = {
        {"src/k.cu", "", "#define sinf __sinf\n",
         "`#define sinf __sinf` now (src/k.cu:1); so does the source of 1 more"},
        {"src/k.cu", "", "#define fma(a, b, c) ((a) * (b) + (c))\n", "`#define fma ...` now (src/k.cu:1)"},
        {"src/k.cu", "", "#define restrict\n", "`#define restrict` now (src/k.cu:1)"},
        {"src/real.cuh", "", "#define sinf __sinf\n", "(src/real.cuh:1)"},
        {"src/k.cu", "real float", "real double", "its word real is `#define real double` now"},
        {"src/k.cu", "#define real float", "", "its word real is a macro no longer"},
        {"src/k.cu", "#include", "#include \"other.cuh\"\n#undef real\n#include", "its word real is `#undef real` now"},
        {"src/other.cuh", "", "#define sinf __sinf\n", ""},                  // f() does not see it
        {"src/k.cu", "", "#define HOST __host__\n#define also real\n", ""},  // nobody had the word
        {"src/k.cu", "return sinf(x);", "return cosf(x);", "-"},             // told as the edit that it is
    };
    for (const MacroRow& row : rows) {
        MemoryDisk disk;
        disk.files = macro_project();
        ASSERT_EQ(porttool_at_r(disk, {"init"}).exit_code, 0);
        ASSERT_EQ(rules(check(disk)), Rules{}) << row.to;
        std::string& text = disk.files["/r/" + std::string(row.file)];
        text = *row.from == '\0' ? row.to + text : replaced(text, row.from, row.to);
        const auto report = check(disk);
        Rules found = rules(report);
        std::erase(found, "unported");
        ASSERT_EQ(found, *row.says == '\0' ? Rules{} : Rules{"source-changed"}) << row.to << report.dump(1);
        for (const auto& finding : report["findings"]) {
            if (finding["rule"] == "unported") continue;
            EXPECT_EQ(finding["level"], "error") << row.to;
            EXPECT_NE(finding["message"].get<std::string>().find(row.says), std::string::npos) << finding["message"];
        }
        EXPECT_EQ(porttool_at_r(disk, {"accept", "src/k.cu:f", "--reason", "the device rounds so"}).exit_code, 0);
        if (*row.says != '-') {
            found = rules(check(disk));
            std::erase(found, "unported");
            EXPECT_EQ(found, Rules{}) << row.to << ": one look settles the macro";
        }
    }
}

TEST(Unwatched, MacrosThatBothSidesGetAlikeAreInStepAndALockFromBeforeIsSilent) {
    MemoryDisk disk;
    disk.files = macro_project();
    ASSERT_EQ(porttool_at_r(disk, {"init"}).exit_code, 0);
    std::map<std::string, std::string> before = disk.files;
    for (const char* file : {"/r/src/k.cu", "/r/port/k.comp"}) disk.files[file] = "#define x y\n" + disk.files[file];
    EXPECT_EQ(rules(check(disk)), Rules{});
    disk.files = before;
    disk.files["/r/portmap.lock"] = without_macros(before["/r/portmap.lock"]);
    disk.files["/r/src/k.cu"] = "#define sinf __sinf\n" + disk.files["/r/src/k.cu"];
    EXPECT_EQ(rules(check(disk)), Rules{}) << "what macros were there then is not known";
}

TEST(Unwatched, AcceptAllNotesMacrosInLinesFromBeforeAndKeepsTheirState) {
    MemoryDisk disk;
    disk.files = macro_project();
    ASSERT_EQ(porttool_at_r(disk, {"init"}).exit_code, 0);
    ASSERT_EQ(porttool_at_r(disk, {"accept", "src/k.cu:g", "--reason", "measured"}).exit_code, 0);
    const std::map<std::string, std::string> whole = disk.files;
    const std::string before = without_macros(whole.at("/r/portmap.lock"));
    disk.files["/r/portmap.lock"] = before;
    ASSERT_EQ(porttool_at_r(disk, {"ignore", "src/k.cu:f", "--reason", "later"}).exit_code, 0);
    EXPECT_EQ(disk.files["/r/portmap.lock"].find("-macros="), std::string::npos) << "no other line is touched";
    disk.files["/r/portmap.lock"] = before;
    const CommandRun got = porttool_at_r(disk, {"accept", "--all"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    EXPECT_NE(got.out.find("2 more lines note what macros make of their words"), std::string::npos) << got.out;
    EXPECT_EQ(disk.files, whole) << "their states and days stay";
    EXPECT_EQ(porttool_at_r(disk, {"accept", "--all"}).out, "0 pairs recorded as in step\n");
    disk.files["/r/portmap.lock"] = before;
    disk.files["/r/src/k.cu"] = replaced(disk.files["/r/src/k.cu"], "sinf(x) + fma", "cosf(x) + fma");
    EXPECT_EQ(porttool_at_r(disk, {"accept", "--all"}).exit_code, 1);
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"}) << "a line of another text is left";
}

/// A lock as it was written when macros over keywords and types did not count.
std::string without_keywords_noted(std::string lock) {
    for (size_t at = 0; (at = lock.find("-macros=+", at)) != std::string::npos;) {
        at += std::string_view("-macros=").size();
        const bool has_words = lock[at + 1] == ' ';
        lock.replace(at, has_words ? 2 : 1, has_words ? "" : "-");
    }
    return lock;
}

TEST(Unwatched, AMacroOverAKeywordOrATypeIsToldOnThePortToo) {
    MemoryDisk disk;
    disk.files = macro_project();
    ASSERT_EQ(porttool_at_r(disk, {"init"}).exit_code, 0);
    const std::map<std::string, std::string> whole = disk.files;
    const std::string before = without_keywords_noted(whole.at("/r/portmap.lock"));
    ASSERT_NE(before, whole.at("/r/portmap.lock"));
    for (const char* line : {"#define return\n", "#define float double\n", "#define return(x) return 0; x\n"}) {
        disk.files = whole;
        disk.files["/r/port/k.comp"] = line + disk.files["/r/port/k.comp"];
        EXPECT_EQ(rules(check(disk)), Rules{"target-changed"}) << line << "one tells of both pairs";
        disk.files["/r/portmap.lock"] = before;
        EXPECT_EQ(rules(check(disk)), Rules{}) << line << "whether it was there then is not known";
    }
    disk.files = whole;
    disk.files["/r/portmap.lock"] = before;
    EXPECT_EQ(porttool_at_r(disk, {"accept", "--all"}).exit_code, 0);
    EXPECT_EQ(disk.files, whole) << "a lock from before is noted anew";
    disk.files["/r/portmap.lock"] = before;
    disk.files["/r/src/k.cu"] = "#define sinf __sinf\n" + disk.files["/r/src/k.cu"];
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"});
    EXPECT_EQ(porttool_at_r(disk, {"accept", "--all"}).exit_code, 1);
    EXPECT_EQ(disk.files["/r/portmap.lock"].find("sinf:"), std::string::npos) << "but not over what is to be told";
}

TEST(Unwatched, AMacroOverANameOfAnyAlphabetIsTold) {
    for (const std::string name : {"gr\u00f6\u00dfe", "\u00d6l", "$h", "h$", "\u03b1"}) {
        MemoryDisk disk;
        disk.files = macro_project();
        for (const char* file : {"/r/src/k.cu", "/r/port/k.comp"})
            while (disk.files[file].find("sinf") != std::string::npos)
                disk.files[file] = replaced(disk.files[file], "sinf", name);
        ASSERT_EQ(porttool_at_r(disk, {"init"}).exit_code, 0);
        const std::map<std::string, std::string> whole = disk.files;
        for (const std::string& spelled : {name, name.size() > 6 ? replaced(name, "\u00f6", "\\u00f6") : name}) {
            disk.files = whole;
            disk.files["/r/src/k.cu"] = "#define " + spelled + " other\n" + disk.files["/r/src/k.cu"];
            const Rules found = rules(check(disk));
            EXPECT_TRUE(std::find(found.begin(), found.end(), "source-changed") != found.end()) << spelled;
        }
    }
}

TEST(Unwatched, AcceptAllDoesNotSettleAMacroThatOnePairTellsForSeveral) {
    MemoryDisk disk;
    disk.files = macro_project();
    ASSERT_EQ(porttool_at_r(disk, {"init"}).exit_code, 0);
    disk.files["/r/src/k.cu"] = "#define sinf __sinf\n" + disk.files["/r/src/k.cu"];
    const std::string lock = disk.files["/r/portmap.lock"];
    EXPECT_EQ(porttool_at_r(disk, {"accept", "--all"}).exit_code, 1);
    EXPECT_EQ(disk.files["/r/portmap.lock"], lock);
    EXPECT_EQ(rules(check(disk)), Rules{"source-changed"});
    EXPECT_EQ(porttool_at_r(disk, {"accept", "--all", "--force"}).exit_code, 0);
    EXPECT_EQ(rules(check(disk)), Rules{});
}

TEST(Unwatched, OfAKernelAndItsLauncherTheKernelIsTold) {
    MemoryDisk disk = started(kLum + "void step(int n) { printf(\"%d\", n); }\n", kLumPort);
    const std::string kernel =
        "__global__ void tint_rows(float* a, int n) {\n    int i = threadIdx.x;\n"
        "    if (i < n) a[i] = a[i] * 3.0f;\n}\n";
    const std::string launcher = "void tint(float* a, int n) { tint_rows<<<1, n>>>(a, n); }\n";
    const std::string caller =
        "int tint_all(float** a, int n) { for (int i = 0; i < n; ++i) tint(a[i], n); return n; }\n";
    disk.files["/r/src/k.cu"] = kLum + "void step(int n) { printf(\"%d\", n); }\n" + kernel + launcher + caller;
    EXPECT_EQ(unported_in(check(disk)),
              (std::vector<std::string>{"src/k.cu:tint note", "src/k.cu:tint_all note", "src/k.cu:tint_rows error"}));
    disk.files["/r/portmap.toml"] += "\n[rules]\nunported = \"warning\"\n";
    EXPECT_EQ(unported_in(check(disk)), (std::vector<std::string>{"src/k.cu:tint warning", "src/k.cu:tint_all warning",
                                                                  "src/k.cu:tint_rows warning"}))
        << "what [rules] says wins";
}

TEST(Unwatched, ANewKernelIsToldWithWhatLaunchesItWhereThatHasACounterpart) {
    const std::string kernel =
        "__global__ void tint_rows(float* a, int n) {\n    int i = threadIdx.x;\n"
        "    if (i < n) a[i] = a[i] * 3.0f;\n}\n";
    const std::string launch = "    tint_rows<<<1, n>>>(a, n);\n";
    const auto tint = [&](const std::string& does) {
        return "int tint_all(float* a, int n, int times) {\n    int done = 0;\n"
               "    for (int k = 0; k < times; ++k) {\n    done += n;\n" +
               does + "    }\n    return done;\n}\n";
    };
    const std::string loop = "    for (int i = 0; i < n; ++i) a[i] = a[i] * 3.0f;\n";
    const auto of_kernel = [](const nlohmann::json& report) {
        std::string out;
        for (const auto& finding : report["findings"])
            if (!finding["source"].is_null() && finding["source"]["id"] == "src/k.cu:tint_rows")
                out += finding["level"].get<std::string>();
        return out;
    };
    {
        MemoryDisk disk = started(kLum, kLumPort);
        disk.files["/r/src/k.cu"] = kLum + kernel + tint(launch);
        EXPECT_EQ(unported_in(check(disk)),
                  (std::vector<std::string>{"src/k.cu:tint_all note", "src/k.cu:tint_rows error"}));
        disk.files["/r/port/k.comp"] = kLumPort + tint("    tint_tile(a, n, done % 7, rows_of(done));\n");
        const auto report = check(disk);
        EXPECT_EQ(of_kernel(report), "note") << "the launcher asks for the look: " << report.dump(1);
        EXPECT_EQ(report["verdict"], "drift");
    }
    // A launcher that was there: its edit is told with the kernel where the port followed in its own way, and the
    // kernel is news where the port did not.
    MemoryDisk disk = started(kLum + tint(""), kLumPort + tint(""));
    disk.files["/r/src/k.cu"] = kLum + kernel + tint(launch);
    EXPECT_EQ(unported_in(check(disk)), (std::vector<std::string>{"src/k.cu:tint_rows error"}));
    disk.files["/r/port/k.comp"] = kLumPort + tint(loop);
    EXPECT_EQ(unported_in(check(disk)), (std::vector<std::string>{"src/k.cu:tint_rows note"}));
    EXPECT_EQ(check(disk)["verdict"], "drift");
}

TEST(Unwatched, OfSeveralKernelsThatOneFunctionLeadsToTheFirstIsTold) {
    const auto kernel = [](const std::string& name, const std::string& sign) {
        return "__global__ void " + name +
               "(float* a, int n) {\n    int i = threadIdx.x;\n    if (i < n) a[i] = a[i] " + sign + " 3.0f;\n}\n";
    };
    const std::string kernels = kernel("tint_rows", "*") + kernel("wipe_rows", "-");
    const auto all = [](const std::string& does) {
        return "int tint_all(float* a, int n, int times) {\n    int done = 0;\n"
               "    for (int k = 0; k < times; ++k) {\n    done += n;\n" +
               does + "    }\n    return done;\n}\n";
    };
    const std::string tint = "tint_rows<<<1, n>>>(a, n); ", wipe = "wipe_rows<<<1, n>>>(a, n); ";
    const auto after = [&](const std::string& text) {
        MemoryDisk disk = started(kLum + all(""), kLumPort + all(""));
        disk.files["/r/src/k.cu"] = kLum + kernels + text;
        EXPECT_EQ(check(disk)["verdict"], "drift");
        std::vector<std::string> out;
        for (const std::string& each : unported_in(check(disk)))
            if (each.find("_rows") != std::string::npos) out.push_back(each);
        return out;
    };
    const std::vector<std::string> first = {"src/k.cu:tint_rows error", "src/k.cu:wipe_rows note"},
                                   each = {"src/k.cu:tint_rows error", "src/k.cu:wipe_rows error"};
    EXPECT_EQ(after(all(tint + wipe)), first);
    EXPECT_EQ(after(all("paint(a, n); ") + "void paint(float* a, int n) { " + tint + wipe + "}\n"), first);
    EXPECT_EQ(after(all("")), each) << "nothing launches them";
    EXPECT_EQ(after(all(tint) + "int wipe_all(float* a, int n) { " + wipe + "return n; }\n"), each);
}

TEST(Unwatched, OneMoreVariantOfWhatHasNoPortIsNoNews) {
    const std::string tile = "template <int N> struct Tile { int rows; int area(int n) { return n * rows; } };\n";
    const std::string more =
        "template <> struct Tile<8> { int rows[8]; int area(int n) { return n * rows[0] * 8; } };\n";
    MemoryDisk disk = started(kLum + tile, kLumPort);
    disk.files["/r/src/k.cu"] = kLum + tile + more;
    EXPECT_EQ(unported_in(check(disk)),
              (std::vector<std::string>{"src/k.cu:Tile#2 note", "src/k.cu:Tile::area#2 note"}));
    disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] = kLum + tile;
    EXPECT_EQ(unported_in(check(disk)), (std::vector<std::string>{"src/k.cu:Tile error", "src/k.cu:Tile::area note"}))
        << "the first is news, and what belongs to it is told with it";
}

TEST(Unwatched, AConstantOfAClassWithoutAPortIsToldWithTheClass) {
    MemoryDisk disk = started(kLum + "struct Tile { int rows; static constexpr int width = 4; };\n", kLumPort);
    disk.files["/r/src/k.cu"] = kLum +
                                "struct Tile { int rows; static constexpr int width = 4; static constexpr int depth = "
                                "8; };\nconstexpr int kDepth = 8;\n";
    EXPECT_EQ(unported_in(check(disk)),
              (std::vector<std::string>{"src/k.cu:Tile::depth note", "src/k.cu:kDepth error"}));
}

TEST(Unwatched, ANewFileWithoutAnyPortIsOneError) {
    const std::string host =
        "double now() { return clock() / 1e6; }\nvoid stop(double a) { print(now() - a); }\n"
        "int parse(char* a) { return a[0] - '0'; }\nvoid quit(int a) { exit(a); }\n";
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/host.h"] = host;
    EXPECT_EQ(unported_in(check(disk)), (std::vector<std::string>{"src/host.h:now note", "src/host.h:parse error",
                                                                  "src/host.h:quit note", "src/host.h:stop note"}));
    disk.files["/r/src/host.h"] =
        host + "__global__ void fill(float* a) { a[threadIdx.x] = 0.0f; }\n__global__ void wipe(int* a) { *a = 1; }\n";
    EXPECT_EQ(unported_in(check(disk)),
              (std::vector<std::string>{"src/host.h:fill error", "src/host.h:now note", "src/host.h:parse note",
                                        "src/host.h:quit note", "src/host.h:stop note", "src/host.h:wipe error"}))
        << "every kernel is an error";
    disk.files["/r/src/host.h"] = host + kLum;
    EXPECT_EQ(unported_in(check(disk)).size(), 4u);
    EXPECT_NE(unported_in(check(disk))[1].find("error"), std::string::npos);
    disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] += host;
    EXPECT_EQ(unported_in(check(disk)), (std::vector<std::string>{"src/k.cu:now note", "src/k.cu:parse error",
                                                                  "src/k.cu:quit error", "src/k.cu:stop error"}))
        << "in a file that has ports each is news";
}

TEST(Unwatched, ACopyOfAnotherFilesHelperIsNoSourceOfItsPort) {
    const std::string pack = "#define PACK(a, b) ((a) << 16 | (b))\n";
    MemoryDisk disk = started(kLum + pack + kFresnel, kLumPort + pack + kFresnelPort);
    EXPECT_EQ(check(disk)["summary"]["pairs"], 3);
    disk.files["/r/portmap.toml"] = replaced(disk.files["/r/portmap.toml"], "src/*", "src/**");
    disk.files["/r/src/far/k.cu"] = pack + kFresnel + "__global__ void spin(int* a) { a[0] = PACK(a[1], 7); }\n";
    const auto report = check(disk);
    EXPECT_EQ(unported_in(report), (std::vector<std::string>{"src/far/k.cu:PACK note", "src/far/k.cu:fresnel error",
                                                             "src/far/k.cu:spin error"}))
        << report.dump(1);
    EXPECT_EQ(rules(report), (Rules{"unported", "unported", "unported"}));
    disk.files.erase("/r/src/far/k.cu");
    disk.files["/r/src/k.cu"] += replaced(pack, "PACK", "PACK_TWO") + replaced(kFresnel, "fresnel", "fresnel_two");
    for (const auto& finding : check(disk)["findings"])
        EXPECT_EQ(finding["rule"], "unpaired") << "a variant in the same file: " << finding.dump();
}

// ---- pairs that were never recorded

const std::string kPairOfFresnel = "\n[[pair]]\nsource = \"src/k.cu:fresnel\"\ntarget = \"port/k.comp:fresnel\"\n";

TEST(Unrecorded, APairAddedByHandIsAnErrorUntilItIsAccepted) {
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] += kFresnel;
    disk.files["/r/port/k.comp"] += kFresnelPort;
    disk.files["/r/portmap.toml"] += kPairOfFresnel;
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"unrecorded"});
    EXPECT_EQ(report["findings"][0]["level"], "error");
    EXPECT_EQ(report["verdict"], "drift");
    EXPECT_EQ(porttool_at_r(disk, {"accept", "--all"}).exit_code, 1) << "nobody has compared it";
    EXPECT_EQ(rules(check(disk)), Rules{"unrecorded"});
    EXPECT_EQ(porttool_at_r(disk, {"accept", "src/k.cu:fresnel"}).exit_code, 0);
    EXPECT_TRUE(check(disk)["findings"].empty());
}

TEST(Unrecorded, AnEditOfItsSourceSinceTheBaselineIsSaid) {
    MemoryDisk disk = started(kLum + kFresnel, kLumPort);
    disk.files["/r/port/k.comp"] += kFresnelPort;
    disk.files["/r/portmap.toml"] += kPairOfFresnel;
    EXPECT_EQ(check(disk)["findings"][0]["message"].get<std::string>().find("its source changed"), std::string::npos);
    disk.files["/r/src/k.cu"] = kLum + replaced(kFresnel, "1.0f - c", "2.0f - c");
    const auto report = check(disk);
    ASSERT_EQ(rules(report), Rules{"unrecorded"});
    EXPECT_NE(report["findings"][0]["message"].get<std::string>().find("its source changed"), std::string::npos);
}

class UnrecordedInGit : public TemporaryRepository {
protected:
    nlohmann::json checked(std::vector<std::string> more) {
        more.insert(more.begin(), {"check", "--format", "json"});
        return nlohmann::json::parse(porttool(more).out);
    }
};

TEST_F(UnrecordedInGit, AgainstABaseItIsAnErrorOnlyWhereThereIsALockAndHidesNoEdit) {
    write("src/k.cu", kLum + kFresnel);
    write("port/k.comp", kLumPort + kFresnelPort);
    write("portmap.toml", "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n" + kPairOfFresnel +
                              "[[ignore]]\nid = \"src/k.cu:lum\"\nreason = \"\"\n");
    commit("no lock");
    EXPECT_TRUE(checked({"--base", "HEAD"})["findings"].empty());
    EXPECT_EQ(porttool({"init"}).exit_code, 0);
    write("portmap.toml",
          read_text(root / "portmap.toml") + "\n[[pair]]\nsource = \"src/k.cu:lum\"\ntarget = \"port/k.comp:lum\"\n");
    EXPECT_EQ(rules(checked({"--base", "HEAD"})), Rules{"unrecorded"});
    write("src/k.cu", replaced(kLum, "0.2f", "0.3f") + kFresnel);
    EXPECT_EQ(rules(checked({"--base", "HEAD"})), (Rules{"source-changed", "unrecorded"}));
}

// ---- map --write

TEST(MapWrite, AddsSuggestionsFromAScoreOnAndRecordsNothing) {
    MemoryDisk disk = started(kLum, kLumPort);
    disk.files["/r/src/k.cu"] += kFresnel + kHash;
    disk.files["/r/port/k.comp"] += kFresnelPort;
    const std::string map = disk.files["/r/portmap.toml"], lock = disk.files["/r/portmap.lock"];
    const CommandRun got = porttool_at_r(disk, {"map", "--write"});
    EXPECT_EQ(got.exit_code, 0) << got.err;
    const std::string now = disk.files["/r/portmap.toml"];
    const size_t first = now.find("\n[[pair]]  # ");
    ASSERT_NE(first, std::string::npos);
    EXPECT_EQ(std::string(now).erase(first, now.size() - map.size()), map) << "what was there stays as it was written";
    EXPECT_NE(disk.files["/r/portmap.toml"].find("source = \"src/k.cu:fresnel\""), std::string::npos);
    EXPECT_EQ(disk.files["/r/portmap.toml"].find("hash_of"), std::string::npos);
    EXPECT_EQ(disk.files["/r/portmap.lock"], lock);
    EXPECT_EQ(rules(check(disk)), (Rules{"unrecorded", "unported"}));
    const std::string written = disk.files["/r/portmap.toml"];
    EXPECT_EQ(porttool_at_r(disk, {"map", "--write", "0.5"}).exit_code, 0);
    EXPECT_EQ(disk.files["/r/portmap.toml"], written) << "nothing is left to add";
}

TEST(MapWrite, RefusesWhatIsNoScoreAndGlobsBesideTheMap) {
    MemoryDisk disk = started(kLum, kLumPort);
    for (const char* score : {"high", "1.5", "-1", "0.5x"})
        EXPECT_EQ(porttool_at_r(disk, {"map", "--write", score}).exit_code, 2) << score;
    EXPECT_EQ(porttool_at_r(disk, {"map", "--write", "--source", "src/*", "--target", "port/*"}).exit_code, 2);
}

// ---- which side is the contract

/// A pair, recorded, with the reference; then one side or the other changes.
MemoryDisk with_reference(const std::string& reference, const std::string& source = kLum,
                          const std::string& target = kLumPort) {
    MemoryDisk disk = started(source, target);
    disk.files["/r/portmap.toml"] =
        replaced(disk.files["/r/portmap.toml"], "reference = \"source\"", "reference = \"" + reference + "\"");
    run(disk, {"-C", "/r", "init", "--force"});
    return disk;
}

std::string levels(const nlohmann::json& report) {
    std::string out;
    for (const auto& finding : report["findings"])
        out += finding["rule"].get<std::string>() + "/" + finding["level"].get<std::string>() + " ";
    return out;
}

TEST(WhichReference, ChangesOfTheReferenceAreErrorsOfTheOtherWarnings) {
    struct Row {
        const char *reference, *source_edited, *target_edited;
    };
    for (const Row& row : {Row{"source", "source-changed/error ", "target-changed/warning "},
                           Row{"target", "source-changed/warning ", "target-changed/error "},
                           Row{"both", "source-changed/error ", "target-changed/error "}}) {
        MemoryDisk disk = with_reference(row.reference);
        disk.files["/r/src/k.cu"] = replaced(kLum, "0.2f", "0.3f");
        EXPECT_EQ(levels(check(disk)), row.source_edited) << row.reference;
        EXPECT_EQ(check(disk)["findings"][0]["source"]["id"], "src/k.cu:lum") << "the sides never swap";
        disk.files["/r/src/k.cu"] = kLum;
        disk.files["/r/port/k.comp"] = replaced(kLumPort, "0.2", "0.3");
        EXPECT_EQ(levels(check(disk)), row.target_edited) << row.reference;
        disk.files["/r/portmap.toml"] += "\n[rules]\n\"target-changed\" = \"note\"\n";
        EXPECT_EQ(levels(check(disk)), "target-changed/note ") << "[rules] wins";
    }
}

TEST(WhichReference, NewUnitsAreLookedForOnTheSideThatIsTheContract) {
    for (const std::string reference : {"source", "target", "both"}) {
        MemoryDisk disk = with_reference(reference);
        disk.files["/r/port/k.comp"] += replaced(kHash, "__device__ unsigned", "uint");
        EXPECT_EQ(levels(check(disk)), reference == "source" ? "" : "unported/error ") << reference;
        if (reference == "source") continue;
        EXPECT_TRUE(check(disk)["findings"][0]["source"].is_null());
        EXPECT_EQ(check(disk)["findings"][0]["target"]["id"], "port/k.comp:hash_of");
        MemoryDisk deferred = disk;
        EXPECT_EQ(porttool_at_r(deferred, {"defer", "port/k.comp:hash_of", "--owner", "me", "--until", "2999-01-01",
                                           "--reason", "later"})
                      .exit_code,
                  0);
        EXPECT_EQ(levels(check(deferred)), "") << reference;
        EXPECT_EQ(porttool_at_r(disk, {"ignore", "port/k.comp:hash_of", "--reason", "CPU alone"}).exit_code, 0);
        EXPECT_EQ(levels(check(disk)), "") << reference;
    }
    for (const std::string reference : {"source", "target", "both"}) {
        MemoryDisk disk = with_reference(reference, kLum, kLumPort + kFresnelPort);
        disk.files["/r/src/k.cu"] += kFresnel;
        EXPECT_EQ(levels(check(disk)), reference == "target" ? "" : "unpaired/error ") << reference;
    }
    MemoryDisk disk = with_reference("target", kLum + kFresnel, kLumPort);
    disk.files["/r/port/k.comp"] += kFresnelPort;
    const auto report = check(disk);
    ASSERT_EQ(levels(report), "unpaired/error ");
    EXPECT_NE(report["findings"][0]["message"].get<std::string>().find(
                  "porttool accept 'src/k.cu:fresnel=port/k.comp:fresnel'"),
              std::string::npos);
    EXPECT_EQ(porttool_at_r(disk, {"accept", "src/k.cu:fresnel=port/k.comp:fresnel"}).exit_code, 0);
    EXPECT_EQ(levels(check(disk)), "");
}

TEST(WhichReference, OrphanedIsThePortWhoseOriginalIsGone) {
    struct Row {
        const char *reference, *no_source, *no_target;
    };
    for (const Row& row :
         {Row{"source", "orphaned/warning ", "dead-link/error "},
          Row{"target", "dead-link/error ", "orphaned/warning "}, Row{"both", "orphaned/error ", "dead-link/error "}}) {
        MemoryDisk disk = with_reference(row.reference, kLum + kFresnel, kLumPort + kFresnelPort);
        disk.files["/r/src/k.cu"] = kLum;
        EXPECT_EQ(levels(check(disk)), row.no_source) << row.reference;
        disk.files["/r/src/k.cu"] = kLum + kFresnel;
        disk.files["/r/port/k.comp"] = kLumPort;
        EXPECT_EQ(levels(check(disk)), row.no_target) << row.reference;
    }
}

// ---- several originals of one port

const std::string kTwoInOne =
    "float shade(float a, float b) {\n    float c = a * 2.0;\n    float d = c + b;\n    return d * d;\n}\n";

/// Two kernels that one function ports.
MemoryDisk two_for_one() {
    MemoryDisk disk;
    const std::string kernel =
        "__device__ float shade(float a, float b) {\n    float c = a * 2.0f;\n    float d = c + "
        "b;\n    return d * d;\n}\n";
    disk.files = {{"/r/src/a.cu", kernel},
                  {"/r/src/b.cu", replaced(kernel, "d * d", "d")},
                  {"/r/port/k.comp", kTwoInOne},
                  {"/r/portmap.toml",
                   "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n"
                   "[[pair]]\nsource = \"src/a.cu:shade\"\ntarget = \"port/k.comp:shade\"\n"
                   "[[pair]]\nsource = \"src/b.cu:shade\"\ntarget = \"port/k.comp:shade\"\n"}};
    run(disk, {"-C", "/r", "init"});
    return disk;
}

TEST(SharedPort, AnEditThatOneOriginalExplainsIsSettledForAll) {
    MemoryDisk disk = two_for_one();
    for (const std::string file : {"/r/src/a.cu", "/r/src/b.cu"}) {
        MemoryDisk edited = disk;
        edited.files[file] = replaced(edited.files[file], "a * 2.0f", "a * 3.0f");
        edited.files["/r/port/k.comp"] = replaced(kTwoInOne, "a * 2.0", "a * 3.0");
        const auto report = check(edited);
        EXPECT_TRUE(report["findings"].empty()) << report.dump(1);
        EXPECT_EQ(report["summary"]["in_step"], 2);
        EXPECT_EQ(porttool_at_r(edited, {"accept", "--all"}).exit_code, 0);
        edited.files["/r/port/k.comp"] = kTwoInOne;
        EXPECT_FALSE(check(edited)["findings"].empty()) << "both pairs were recorded anew";
    }
}

TEST(SharedPort, AnEditThatNoneExplainsWarnsOnce) {
    MemoryDisk disk = two_for_one();
    disk.files["/r/port/k.comp"] = replaced(kTwoInOne, "a * 2.0", "a * 3.0");
    const auto report = check(disk);
    EXPECT_EQ(levels(report), "target-changed/warning ");
    EXPECT_EQ(report["summary"]["review"], 2) << "neither pair is in step";
    EXPECT_EQ(porttool_at_r(disk, {"accept", "port/k.comp:shade"}).exit_code, 0);
    EXPECT_TRUE(check(disk)["findings"].empty());
}

TEST(SharedPort, AnEditOfAnOriginalIsNeverSettledByAnother) {
    MemoryDisk disk = two_for_one();
    disk.files["/r/src/a.cu"] = replaced(disk.files["/r/src/a.cu"], "a * 2.0f", "a * 3.0f");
    disk.files["/r/src/b.cu"] = replaced(disk.files["/r/src/b.cu"], "c + b", "c - b");
    EXPECT_EQ(levels(check(disk)), "source-changed/error source-changed/error ");
    disk.files["/r/port/k.comp"] = replaced(kTwoInOne, "a * 2.0", "a * 3.0");
    const auto report = check(disk);
    ASSERT_EQ(levels(report), "port-differs/error ") << report.dump(1);
    EXPECT_EQ(report["findings"][0]["source"]["id"], "src/b.cu:shade");
}

TEST(SharedPort, AnEditThatIsToldOfOnePairIsNoNewsToTheOthers) {
    for (const std::string file : {"/r/src/a.cu", "/r/src/b.cu"}) {
        MemoryDisk disk = two_for_one();
        disk.files[file] = replaced(disk.files[file], "a * 2.0f", "a * 4.0f");
        disk.files["/r/port/k.comp"] = replaced(kTwoInOne, "a * 2.0", "a * 3.0");
        const auto report = check(disk);
        EXPECT_EQ(levels(report), "port-differs/error ") << report.dump(1);
        EXPECT_EQ(report["summary"]["in_step"], 0);
        disk.files["/r/portmap.toml"] += "\n[rules]\n\"port-differs\" = \"off\"\n";
        EXPECT_EQ(levels(check(disk)), "target-changed/warning ") << "it would not be told at all";
    }
}

/// An edit of one of two kernels that one function holds, a loop each, made in the loop of either.
TEST(SharedPort, AnEditInThePartOfAnotherIsNoPort) {
    const std::string index = "int i = blockIdx.x * blockDim.x + threadIdx.x;\n    if (i >= n) return;\n";
    const std::string clip =
        "__global__ void clip(float* m, int n, float lo, float hi) {\n    " + index +
        "    float v = m[i];\n    if (v < lo) v = lo;\n    if (v > hi) v = hi;\n    m[i] = v;\n}\n";
    const std::string noise = "__global__ void noise(float* m, const float* r, int n, float amount) {\n    " + index +
                              "    float v = m[i];\n    v += amount * r[i];\n    m[i] = v;\n}\n";
    const std::string port =
        "void all(float* m, const float* noise, int n, float low, float high, float amount) {\n"
        "    for (int k = 0; k < n; ++k) {\n        float v = m[k];\n        if (v < low) v = low;\n"
        "        if (v > high) v = high;\n        m[k] = v; // clip\n    }\n"
        "    for (int k = 0; k < n; ++k) {\n        float v = m[k];\n        v += amount * noise[k];\n"
        "        m[k] = v; // noise\n    }\n}\n";
    MemoryDisk disk;
    disk.files = {{"/r/src/clip.cu", clip},
                  {"/r/src/noise.cu", noise},
                  {"/r/port/m.cpp", port},
                  {"/r/portmap.toml",
                   "version = 1\n[sides]\nsource = [\"src/*\"]\ntarget = [\"port/*\"]\n"
                   "[[pair]]\nsource = \"src/clip.cu:clip\"\ntarget = \"port/m.cpp:all\"\n"
                   "[[pair]]\nsource = \"src/noise.cu:noise\"\ntarget = \"port/m.cpp:all\"\n"}};
    ASSERT_EQ(run(disk, {"-C", "/r", "init"}).exit_code, 0);
    for (const std::string statement : {"v *= 2.0f;", "v += 1.0f;", "if (v > 5.0f) v = 5.0f;"}) {
        disk.files["/r/src/clip.cu"] = replaced(clip, "m[i] = v;", statement + " m[i] = v;");
        disk.files["/r/port/m.cpp"] = replaced(port, "m[k] = v; // clip", statement + " m[k] = v;");
        EXPECT_TRUE(check(disk)["findings"].empty()) << statement << check(disk).dump(1);
        disk.files["/r/port/m.cpp"] = replaced(port, "m[k] = v; // noise", statement + " m[k] = v;");
        EXPECT_EQ(check(disk)["summary"]["drifted"], 1) << statement << check(disk).dump(1);
        EXPECT_EQ(check(disk)["summary"]["review"], 1) << "the part of noise was edited, and noise was not";
    }
}

}  // namespace
}  // namespace porttool::testing::unwatched_test
