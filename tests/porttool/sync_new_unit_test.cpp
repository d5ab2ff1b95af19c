// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What an edit brings with it: helpers, constants and structs that the port has not yet. Each port is as a person would
// write it.
#include "porttool/sync/name_manner.h"
#include "tests/porttool/temporary_repository.h"

namespace porttool::testing {
namespace sync_new_unit_test {

const std::string kLobes =
    "const float MIN_ALPHA = 0.001;\n"
    "\n"
    "struct Surface {\n"
    "  vec3 normal;\n"
    "  float roughness;\n"
    "};\n"
    "\n"
    "// Schlick's weight.\n"
    "float schlick(float cosine) {\n"
    "  float m = 1.0 - cosine;\n"
    "  if (m < 0.0) {\n"
    "    m = 0.0;\n"
    "  }\n"
    "  return m * m * m;\n"
    "}\n"
    "\n"
    "float maskedRoot(Surface s, float cosine) {\n"
    "  float a = max(s.roughness, MIN_ALPHA);\n"
    "  return sqrt(a + cosine * cosine);\n"
    "}\n"
    "\n"
    "void darken(inout float value, float amount) { value = value * amount; }\n"
    "\n"
    "float evaluate(Surface s, vec3 view) {\n"
    "  float cosine = dot(s.normal, view);\n"
    "  return schlick(cosine) * maskedRoot(s, cosine);\n"
    "}\n"
    "\n"
    "float sampleWeight(Surface s, vec3 view) {\n"
    "  float cosine = dot(s.normal, view);\n"
    "  return schlick(cosine);\n"
    "}\n";

const std::string kHostLobes =
    "#include <algorithm>\n"
    "#include <cmath>\n"
    "\n"
    "namespace host {\n"
    "\n"
    "static constexpr float MIN_ALPHA = 0.001f;\n"
    "\n"
    "struct Surface {\n"
    "    Vector normal;\n"
    "    float roughness;\n"
    "};\n"
    "\n"
    "// Schlick's weight.\n"
    "static inline float Schlick(float cosine)\n"
    "{\n"
    "    float m = 1.0f - cosine;\n"
    "    if (m < 0.0f) {\n"
    "        m = 0.0f;\n"
    "    }\n"
    "    return m * m * m;\n"
    "}\n"
    "\n"
    "static inline float MaskedRoot(const Surface& s, float cosine)\n"
    "{\n"
    "    float a = std::max(s.roughness, MIN_ALPHA);\n"
    "    return std::sqrt(a + cosine * cosine);\n"
    "}\n"
    "\n"
    "static inline void Darken(float& value, float amount) { value = value * amount; }\n"
    "\n"
    "float Evaluate(const Surface& s, const Vector& view)\n"
    "{\n"
    "    float cosine = Dot(s.normal, view);\n"
    "    return Schlick(cosine) * MaskedRoot(s, cosine);\n"
    "}\n"
    "\n"
    "float SampleWeight(const Surface& s, const Vector& view)\n"
    "{\n"
    "    float cosine = Dot(s.normal, view);\n"
    "    return Schlick(cosine);\n"
    "}\n"
    "\n"
    "} // namespace host\n";

/// What sync makes of an edit of these two files, or of other ones.
class SyncNewUnit : public TemporaryRepository {
protected:
    void start(const std::string& source_name, const std::string& source, const std::string& target_name,
               const std::string& target) {
        source_path = "s/" + source_name;
        target_path = "t/" + target_name;
        write(source_path, source);
        write(target_path, target);
        ASSERT_EQ(porttool({"init", "--source", "s/*", "--target", "t/*"}).exit_code, 0);
        commit("in step");
    }
    void start_lobes() { start("lobes.glsl", kLobes, "lobes.cpp", kHostLobes); }
    void edit(const std::string& from, const std::string& to) {
        write(source_path, replaced(read_text(root / source_path), from, to));
    }
    std::string target() const { return read_text(root / target_path); }

    /// Applies the patches of a run as a user would, one after another, and has check look at them.
    nlohmann::json proposals(int exit_code) {
        const CommandRun got = porttool({"sync", "--format", "json"});
        EXPECT_EQ(got.exit_code, exit_code) << got.out << got.err;
        return got.exit_code == 2 ? nlohmann::json::array() : nlohmann::json::parse(got.out)["proposals"];
    }
    void apply_all(const nlohmann::json& all) {
        for (const auto& one : all) {
            if (!one["patch"].is_string()) continue;
            write("one.patch", one["patch"]);
            git("apply one.patch");
        }
        std::filesystem::remove(root / "one.patch");
    }
    void expect_ported(const std::string& expected) {
        const nlohmann::json all = proposals(0);
        for (const auto& one : all) EXPECT_EQ(one["state"], "proposed") << one.dump(1);
        apply_all(all);
        EXPECT_EQ(target(), expected);
        const CommandRun check = porttool({"check", "--strict"});
        EXPECT_EQ(check.exit_code, 0) << check.out;
        EXPECT_EQ(json({"check"})["summary"]["unpaired_changed"], edited_without_pair);
        // The same by --apply.
        git("checkout -q t portmap.toml portmap.lock");
        git("clean -qfd portmap.base");
        EXPECT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
        EXPECT_EQ(target(), expected);
        EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
    }
    /// Nothing is written, and the reason names what is missing.
    void expect_left(const std::string& reason) {
        const std::string before = target();
        const nlohmann::json all = proposals(1);
        EXPECT_NE(all.dump().find(reason), std::string::npos) << all.dump(1);
        for (const auto& one : all) EXPECT_NE(one["state"], "proposed") << one.dump(1);
        EXPECT_EQ(porttool({"sync", "--apply"}).exit_code, 1);
        EXPECT_EQ(target(), before);
        EXPECT_EQ(read_text(root / "portmap.toml").find("sheen"), std::string::npos);
    }

    std::string source_path, target_path;
    int edited_without_pair = 0;  ///< units of the source
};

const std::string kSheen =
    "// Grows toward the rim.\n"
    "float sheenWeight(Surface s, float cosine) {\n"
    "  float m = 1.0 - cosine;  // from the normal\n"
    "  if (m > 0.5) {\n"
    "    m = s.roughness;\n"
    "  }\n"
    "  return max(m, MIN_ALPHA) * 0.25;\n"
    "}\n"
    "\n";
const std::string kHostSheen =
    "// Grows toward the rim.\n"
    "static inline float SheenWeight(const Surface& s, float cosine)\n"
    "{\n"
    "    float m = 1.0f - cosine;  // from the normal\n"
    "    if (m > 0.5f) {\n"
    "        m = s.roughness;\n"
    "    }\n"
    "    return std::max(m, MIN_ALPHA) * 0.25f;\n"
    "}\n"
    "\n";

TEST_F(SyncNewUnit, AHelperComesInThePortsDress) {
    start_lobes();
    edit("float evaluate(", kSheen + "float evaluate(");
    edit("* maskedRoot(s, cosine)", "* maskedRoot(s, cosine) + sheenWeight(s, cosine)");
    expect_ported(
        replaced(replaced(kHostLobes, "* MaskedRoot(s, cosine)", "* MaskedRoot(s, cosine) + SheenWeight(s, cosine)"),
                 "float Evaluate(", kHostSheen + "float Evaluate("));
    EXPECT_NE(read_text(root / "portmap.toml")
                  .find("\n[[pair]]\nsource = \"s/lobes.glsl:sheenWeight\"\n"
                        "target = \"t/lobes.cpp:host::SheenWeight\"\n"),
              std::string::npos);
}

// The source moved a function up, as one above it came to use it. C++ wants it above as well.
TEST_F(SyncNewUnit, WhatAPortComesToUseIsLiftedAboveIt) {
    start_lobes();
    const std::string darken = "void darken(inout float value, float amount) { value = value * amount; }\n\n";
    const std::string host = "static inline void Darken(float& value, float amount) { value = value * amount; }\n\n";
    edit(darken, "");
    edit("float maskedRoot(", darken + "float maskedRoot(");
    edit("MIN_ALPHA);\n", "MIN_ALPHA);\n  darken(a, cosine);\n");
    expect_ported(replaced(replaced(replaced(kHostLobes, host, ""), "static inline float MaskedRoot(",
                                    host + "static inline float MaskedRoot("),
                           "MIN_ALPHA);\n", "MIN_ALPHA);\n    Darken(a, cosine);\n"));
}

TEST_F(SyncNewUnit, AHelperWithAHelperAndAConstant) {
    start_lobes();
    edit("const float MIN_ALPHA = 0.001;\n", "const float MIN_ALPHA = 0.001;\nconst float SHEEN_SCALE = 0.75;\n");
    edit("float evaluate(",
         "float rim(float cosine) { return schlick(cosine) * SHEEN_SCALE; }\n\n"
         "float sheen(Surface s, vec3 view) {\n  return rim(dot(s.normal, view));\n}\n\nfloat evaluate(");
    edit("* maskedRoot(s, cosine)", "* maskedRoot(s, cosine) + sheen(s, view)");
    const std::string expected = replaced(
        replaced(kHostLobes, "* MaskedRoot(s, cosine)", "* MaskedRoot(s, cosine) + Sheen(s, view)"), "float Evaluate(",
        "static inline float Rim(float cosine) { return Schlick(cosine) * SHEEN_SCALE; }\n\n"
        "static inline float Sheen(const Surface& s, const Vector& view)\n{\n    return Rim(Dot(s.normal, "
        "view));\n}\n\n"
        "float Evaluate(");
    expect_ported(replaced(expected, "MIN_ALPHA = 0.001f;\n",
                           "MIN_ALPHA = 0.001f;\nstatic constexpr float SHEEN_SCALE = 0.75f;\n"));
}

TEST_F(SyncNewUnit, TheFirstPatchThatNeedsAHelperHasIt) {
    start_lobes();
    edit("float evaluate(", kSheen + "float evaluate(");
    edit("* maskedRoot(s, cosine)", "* maskedRoot(s, cosine) + sheenWeight(s, cosine)");
    edit("return schlick(cosine);", "return schlick(cosine) + sheenWeight(s, cosine);");
    const nlohmann::json all = proposals(0);
    ASSERT_EQ(all.size(), 2u);
    const std::string first = all[0]["patch"], second = all[1]["patch"];
    EXPECT_NE(first.find("+static inline float SheenWeight("), std::string::npos);
    EXPECT_NE(first.find("+++ b/portmap.toml"), std::string::npos);
    EXPECT_NE(first.find("+++ b/portmap.lock"), std::string::npos);
    EXPECT_NE(first.find("+++ b/portmap.base/"), std::string::npos);
    EXPECT_EQ(second.find("SheenWeight(const"), std::string::npos);
    EXPECT_EQ(second.find("portmap"), std::string::npos);
    EXPECT_TRUE(all[0]["map_patch"].is_null());
    apply_all(all);
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
}

TEST_F(SyncNewUnit, AStructAndItsUse) {
    start_lobes();
    edit("// Schlick's weight.\n",
         "struct Rim {\n  float start;  // of the slope\n  float end;\n};\n\n// Schlick's weight.\n");
    edit("float evaluate(",
         "float slope(Rim rim, float x) { return (x - rim.start) / (rim.end - rim.start); }\n\nfloat evaluate(");
    edit("  return schlick(cosine) * ",
         "  Rim rim;\n  rim.start = 0.25;\n  rim.end = 1.0;\n  return slope(rim, cosine) * ");
    std::string expected = replaced(kHostLobes, "// Schlick's weight.\n",
                                    "struct Rim {\n    float start;  // of the slope\n    float end;\n};\n\n"
                                    "// Schlick's weight.\n");
    expected = replaced(expected, "float Evaluate(",
                        "static inline float Slope(const Rim& rim, float x) { return (x - rim.start) / (rim.end - "
                        "rim.start); }\n\nfloat Evaluate(");
    expect_ported(
        replaced(expected, "    return Schlick(cosine) * ",
                 "    Rim rim;\n    rim.start = 0.25f;\n    rim.end = 1.0f;\n    return Slope(rim, cosine) * "));
}

TEST_F(SyncNewUnit, AMacroAndAHelperOnADevice) {
    const std::string source =
        "#define LIMIT 4.0f\n"
        "inline float clip(float x) { return sycl::fmin(x, LIMIT); }\n"
        "float twice(float x) { return 2.0f * x; }\n"
        "inline float shade(float x) {\n  float y = clip(x);\n  return y * 0.5f;\n}\n";
    const std::string target =
        "#define LIMIT 4.0f\n"
        "__device__ float clip(float x) { return fminf(x, LIMIT); }\n"
        "float twice(float x) { return 2.0f * x; }\n"
        "__device__ float shade(float x) {\n  float y = clip(x);\n  return y * 0.5f;\n}\n";
    start("k.cpp", source, "k.cu", target);
    edit("#define LIMIT 4.0f\n", "#define LIMIT 4.0f\n#define GAIN(v) ((v) * 3.0f)\n");
    edit("inline float shade", "inline float lift(float x) { return clip(GAIN(x)); }\ninline float shade");
    edit("y * 0.5f", "lift(y) * 0.5f");
    expect_ported(replaced(
        replaced(replaced(target, "#define LIMIT 4.0f\n", "#define LIMIT 4.0f\n#define GAIN(v) ((v) * 3.0f)\n"),
                 "__device__ float shade",
                 "__device__ float lift(float x) { return clip(GAIN(x)); }\n__device__ float shade"),
        "y * 0.5f", "lift(y) * 0.5f"));
}

TEST_F(SyncNewUnit, FromTheTargetToTheSource) {
    start_lobes();
    source_path.swap(target_path);
    edit("float Evaluate(", kHostSheen + "float Evaluate(");
    edit("* MaskedRoot(s, cosine)", "* MaskedRoot(s, cosine) + SheenWeight(s, cosine)");
    const nlohmann::json all = proposals(0);
    apply_all(all);
    EXPECT_EQ(target(),
              replaced(replaced(kLobes, "* maskedRoot(s, cosine)", "* maskedRoot(s, cosine) + sheenWeight(s, cosine)"),
                       "float evaluate(", kSheen + "float evaluate("))
        << all.dump(1);
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
}

TEST_F(SyncNewUnit, WithATargetElsewhereTheMapHasAPatchOfItsOwn) {
    const std::filesystem::path other = root.string() + "_other";
    std::filesystem::remove_all(other);
    std::filesystem::create_directories(other / "t");
    std::ofstream(other / "t/lobes.cpp") << kHostLobes;
    write("s/lobes.glsl", kLobes);
    write("portmap.toml", "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\ntarget_root = \"../" +
                              other.filename().string() + "\"\n");
    ASSERT_EQ(porttool({"map", "--write", "0.5"}).exit_code, 0);
    const std::string map = read_text(root / "portmap.toml");
    ASSERT_EQ(porttool({"init", "--force"}).exit_code, 0);
    commit("in step");
    source_path = "s/lobes.glsl";
    edit("float evaluate(", kSheen + "float evaluate(");
    edit("* maskedRoot(s, cosine)", "* maskedRoot(s, cosine) + sheenWeight(s, cosine)");
    const nlohmann::json all = proposals(0);
    ASSERT_EQ(all.size(), 1u) << map;
    const std::string patch = all[0]["patch"], map_patch = all[0]["map_patch"];
    EXPECT_EQ(patch.find("portmap"), std::string::npos);
    EXPECT_EQ(map_patch.find("lobes.cpp\n"), std::string::npos);
    write("map.patch", map_patch);
    git("apply map.patch");
    std::ofstream(other / "one.patch") << patch;
    ASSERT_EQ(std::system(("cd '" + other.string() + "' && git apply one.patch").c_str()), 0);
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
    std::filesystem::remove_all(other);
}

TEST_F(SyncNewUnit, WhatTheHelperCannotSayIsLeft) {
    start_lobes();
    edit("float evaluate(", "float sheen(float cosine) { return noise_table(cosine); }\n\nfloat evaluate(");
    edit("* maskedRoot(s, cosine)", "* maskedRoot(s, cosine) + sheen(cosine)");
    expect_left("`sheen`, which came without a port; port that, too: nothing tells how the port says `noise_table`");
}

TEST_F(SyncNewUnit, ATypeThatThePortHasInSeveralWaysIsLeft) {
    const std::string source =
        "vec3 tint(vec3 color) { return color * 0.5; }\n\n"
        "vec3 bend(vec3 direction) { return direction * 2.0; }\n\n"
        "float shade(vec3 color) { return tint(color).x; }\n";
    const std::string target =
        "inline Color Tint(const Color& color) { return color * 0.5f; }\n\n"
        "inline Vector Bend(const Vector& direction) { return direction * 2.0f; }\n\n"
        "inline float Shade(const Color& color) { return Tint(color).x; }\n";
    start("k.glsl", source, "k.cpp", target);
    edit("float shade(", "vec3 sheen(float x) { return vec3(x); }\n\nfloat shade(");
    edit("tint(color).x", "tint(color).x + sheen(0.5).x");
    expect_left("the port has `vec3` as several types");
}

TEST_F(SyncNewUnit, ANameThatThePortHasIsLeft) {
    start("lobes.glsl", kLobes, "lobes.cpp",
          replaced(kHostLobes, "float Evaluate(", "float SheenWeight(float x) { return x; }\n\nfloat Evaluate("));
    edit("float evaluate(", kSheen + "float evaluate(");
    edit("* maskedRoot(s, cosine)", "* maskedRoot(s, cosine) + sheenWeight(s, cosine)");
    expect_left("which may be its counterpart");
}

TEST_F(SyncNewUnit, WhatOnlyALeftStatementUsesIsNotPorted) {
    start_lobes();
    edit("float evaluate(", kSheen + "float evaluate(");
    edit("* maskedRoot(s, cosine)", "* maskedRoot(s, cosine) + sheenWeight(s, cosine) * noise_table(cosine)");
    expect_left("noise_table");
}

TEST_F(SyncNewUnit, ANewNameGoesOnlyWithItsDeclaration) {
    start_lobes();
    edit("  return schlick(cosine) * maskedRoot(s, cosine);",
         "  float sheen = noise_table(cosine);\n  return schlick(cosine) * maskedRoot(s, cosine) * sheen;");
    expect_left("noise_table");
    EXPECT_EQ(porttool({"sync", "--format", "patch"}).out.find("sheen"), std::string::npos);
}

TEST_F(SyncNewUnit, APlaceAboveWhatItUsesIsNotTaken) {
    start_lobes();
    // The source may call what stands below by a declaration; the port has none.
    edit("// Schlick's weight.\n",
         "float maskedRoot(Surface s, float cosine);\n"
         "float sheen(Surface s, float cosine) { return maskedRoot(s, cosine); }\n\n// Schlick's weight.\n");
    edit("* maskedRoot(s, cosine);", "+ sheen(s, cosine);");
    expect_ported(
        replaced(replaced(kHostLobes, "* MaskedRoot(s, cosine);", "+ Sheen(s, cosine);"), "static inline void Darken",
                 "static inline float Sheen(const Surface& s, float cosine) { return MaskedRoot(s, cosine); }\n\n"
                 "static inline void Darken"));
}

TEST_F(SyncNewUnit, LocalsThatNeverChangeAreConstWhereThoseOfThePortAre) {
    const std::string source =
        "float one(float x) {\n    float a = x * 2.0;\n    float b = a + x;\n    return b * a;\n}\n\n"
        "float two(float x) {\n    float a = x * 3.0;\n    a += x;\n    float b = a + x;\n    return b * a + "
        "one(x);\n}\n";
    const std::string target =
        "inline float one(float x) {\n    const float a = x * 2.0f;\n    const float b = a + x;\n    return b * "
        "a;\n}\n\n"
        "inline float two(float x) {\n    float a = x * 3.0f;\n    a += x;\n    const float b = a + x;\n"
        "    return b * a + one(x);\n}\n";
    start("k.glsl", source, "k.cpp", target);
    edit("float two(",
         "float three(float x) {\n    float m = x - 1.0;\n    float sum = m * m;\n    sum += x;\n"
         "    return sum * m;\n}\n\nfloat two(");
    edit("b * a + one(x)", "b * a + one(x) * three(x)");
    expect_ported(replaced(replaced(target, "inline float two(",
                                    "inline float three(float x) {\n    const float m = x - 1.0f;\n"
                                    "    float sum = m * m;\n    sum += x;\n    return sum * m;\n}\n\n"
                                    "inline float two("),
                           "b * a + one(x)", "b * a + one(x) * three(x)"));
}

const std::string kTimed =
    "#include <stdio.h>\n#include <stdlib.h>\n#include \"shapes.h\"\n"
    "float shade(float a) {\n    float b = a * 2.0f;\n    return b;\n}\n";
const std::string kTimedPort =
    "#include <cstdio>\n#include <stdlib.h>\n#include <sycl/sycl.hpp>\n#include \"cpu_shapes.h\"\n"
    "float shade(float a) {\n    float b = a * 2.0f;\n    return b;\n}\n";

TEST_F(SyncNewUnit, IncludesComeAlong) {
    write("s/shapes.h", "inline float area(float a) { return a * a * 3.0f; }\n");
    write("t/cpu_shapes.h", "inline float area(float a) { return a * a * 3.0f; }\n");
    write("s/noise.h", "inline float noise(float a) { return a / 3.0f - 1.0f; }\n");
    write("t/cpu_noise.h", "inline float noise(float a) { return a / 3.0f - 1.0f; }\n");
    start("k.cu", kTimed, "k.cpp", kTimedPort);
    edit("#include <stdlib.h>\n",
         "#include <stdlib.h>\n#include <math.h>\n#include <cuda_fp16.h>\n#include <chrono>\n");
    edit("#include \"shapes.h\"\n", "#include \"shapes.h\"\n#include \"noise.h\"\n");
    edit("a * 2.0f", "noise(a) * 2.0f");
    expect_ported(replaced(replaced(replaced(kTimedPort, "a * 2.0f", "noise(a) * 2.0f"), "#include <stdlib.h>\n",
                                    "#include <stdlib.h>\n#include <math.h>\n#include <chrono>\n"),
                           "#include \"cpu_shapes.h\"\n", "#include \"cpu_shapes.h\"\n#include \"cpu_noise.h\"\n"));
}

TEST_F(SyncNewUnit, AnIncludeThatThePortHasOrThatStandsInABranchStaysOut) {
    start("k.cu", kTimed, "k.cpp",
          replaced(kTimedPort, "#include <stdlib.h>\n", "#include <cmath>\n#include <stdlib.h>\n"));
    edit("#include <stdlib.h>\n", "#include <stdlib.h>\n#include <math.h>\n#ifdef LOG\n#include <chrono>\n#endif\n");
    edit("a * 2.0f", "a * 4.0f");
    expect_ported(replaced(replaced(kTimedPort, "#include <stdlib.h>\n", "#include <cmath>\n#include <stdlib.h>\n"),
                           "a * 2.0f", "a * 4.0f"));
}

TEST_F(SyncNewUnit, AVariableOfTheFileComesWithWhatUsesIt) {
    start("k.cu", kTimed, "k.cpp", kTimedPort);
    edit("float shade(", "float gain = 3.0f;\nint unused = 1;\nhalf_word packed = 2;\nfloat shade(");
    edit("a * 2.0f", "a * gain");
    expect_ported(replaced(replaced(kTimedPort, "a * 2.0f", "a * gain"), "#include \"cpu_shapes.h\"\n",
                           "#include \"cpu_shapes.h\"\nfloat gain = 3.0f;\n"));
}

TEST_F(SyncNewUnit, AVariableOfATypeThatThePortHasNotStaysOut) {
    start("k.cu", kTimed, "k.cpp", kTimedPort);
    edit("float shade(", "half_word packed = 2;\nfloat shade(");
    edit("a * 2.0f", "a * packed");
    for (const auto& one : proposals(1)) EXPECT_NE(one["state"], "proposed") << one.dump(1);
}

TEST_F(SyncNewUnit, TheHeadOfAFunctionThatIsDefinedElsewhereFollows) {
    const std::string source =
        "void test(const float* __restrict__ a, int n);\nvoid show(int n);\n"
        "int run(float* a, int n) {\n    test(a, n);\n    show(n);\n    return 0;\n}\n";
    const std::string port =
        "void test(const float* __restrict a,\n          int n);\nvoid show(int n);\n"
        "int run(float* a, int n) {\n    test(a, n);\n    show(n);\n    return 0;\n}\n";
    start("k.cu", source, "k.cpp", port);
    edit("void test(", "bool test(");
    edit("void show(int n)", "void show(int n, bool ok)");
    edit("    test(a, n);\n    show(n);\n", "    bool ok = test(a, n);\n    show(n, ok);\n");
    expect_ported(replaced(replaced(replaced(port, "void test(", "bool test("), "show(int n)", "show(int n, bool ok)"),
                           "    test(a, n);\n    show(n);\n", "    bool ok = test(a, n);\n    show(n, ok);\n"));
}

TEST_F(SyncNewUnit, AConstantOfAFunctionThatBecomesTheFilesIsDeclaredThere) {
    const std::string source =
        "float shade(float a) {\n    const float kGain = 3.0f;\n    float b = a * kGain;\n    return b;\n}\n";
    start("k.cu", "__device__ " + source, "k.cpp", source);
    edit("    const float kGain = 3.0f;\n", "");
    edit("__device__ float shade", "const float kGain = 3.0f;\n__device__ float shade");
    expect_ported("const float kGain = 3.0f;\n" + replaced(source, "    const float kGain = 3.0f;\n", ""));
}

const std::string kRoot =
    "__device__ float root(float a, float b) {\n    return sqrtf(a * b);\n}\n"
    "__device__ float shade(float a) {\n    float b = root(a, 2.0f);\n    return b;\n}\n"
    "__global__ void probe(float* out) { out[0] = root(1.0f, 2.0f); }\n";
const std::string kRootPort =
    "float root(float, float b);\n"
    "inline float root(float a, float b)\n{\n    return std::sqrt(a * b);\n}\n"
    "inline float shade(float a)\n{\n    float b = root(a, 2.0f);\n    return b;\n}\n"
    "inline float check_root() { return std::abs(root(root(4.0f, 1.0f), 9.0f)) - 6.0f; }\n";

TEST_F(SyncNewUnit, ANewParameterReachesDeclarationsAndCallsOfThePortsOwn) {
    start("k.cu", kRoot, "k.cpp", kRootPort);
    edit("root(float a, float b)", "root(float a, float scale, float b)");
    edit("sqrtf(a * b)", "sqrtf(a * b) * scale");
    edit("root(a, 2.0f)", "root(a, a, 2.0f)");
    edit("root(1.0f, 2.0f)", "root(1.0f, 1.0f, 2.0f)");
    edited_without_pair = 1;
    expect_ported(
        "float root(float, float scale, float b);\n"
        "inline float root(float a, float scale, float b)\n{\n    return std::sqrt(a * b) * scale;\n}\n"
        "inline float shade(float a)\n{\n    float b = root(a, a, 2.0f);\n    return b;\n}\n"
        "inline float check_root() { return std::abs(root(root(4.0f, 1.0f, 1.0f), 1.0f, 9.0f)) - 6.0f; }\n");
}

TEST_F(SyncNewUnit, ACallWhoseNewArgumentIsNotCertainIsLeft) {
    start("k.cu", kRoot, "k.cpp", kRootPort);
    edit("root(float a, float b)", "root(float a, float b, float scale)");
    edit("sqrtf(a * b)", "sqrtf(a * b) * scale");
    edit("root(a, 2.0f)", "root(a, 2.0f, a)");
    edit("root(1.0f, 2.0f)", "root(1.0f, 2.0f, out[0])");
    const std::string before = target();
    const nlohmann::json all = proposals(1);
    EXPECT_NE(all.dump().find("`root` takes 3 arguments now; it is called with 2 in `t/k.cpp:check_root`, line 11"),
              std::string::npos)
        << all.dump(1);
}

TEST_F(SyncNewUnit, ANewArgumentForAFunctionThatIsLeftIsLeft) {
    start("k.cu", kRoot, "k.cpp", kRootPort);
    edit("root(float a, float b)", "root(float a, float b, half_word scale)");
    edit("sqrtf(a * b)", "sqrtf(a * b) * noise_table[scale]");
    edit("root(a, 2.0f)", "root(a, 2.0f, 1)");
    const nlohmann::json all = proposals(1);
    for (const auto& one : all) EXPECT_NE(one["state"], "proposed") << one.dump(1);
}

TEST_F(SyncNewUnit, AFieldThatIsLeftIsNotUsed) {
    const std::string source =
        "struct Hit { float t; float u; };\nfloat shade(Hit hit) {\n    float b = hit.t * 2.0f;\n    return b;\n}\n";
    start("k.cu", source, "k.cpp", source);
    edit("float u; };", "float u; half_word packed; };");
    edit("hit.t * 2.0f", "hit.t * 2.0f + hit.packed");
    write("s/words.cuh", "typedef unsigned short half_word;\n");
    const nlohmann::json all = proposals(1);
    for (const auto& one : all) EXPECT_NE(one["state"], "proposed") << one.dump(1);
}

TEST(SyncNames, FollowThoseBesideThem) {
    EXPECT_EQ(name_in_manner("sheenWeight", {{"schlick", "Schlick"}, {"evaluateAll", "EvaluateAll"}}), "SheenWeight");
    EXPECT_EQ(name_in_manner("sheen_weight", {{"evaluate_all", "evaluateAll"}, {"draw", "draw"}, {"set_it", "setIt"}}),
              "sheenWeight");
    EXPECT_EQ(name_in_manner("sheenWeight", {{"evaluateAll", "evaluate_all"}}), "sheen_weight");
    EXPECT_EQ(name_in_manner("sheen_weight", {{"trace_ray", "gpu_trace_ray"}, {"set_row", "gpu_set_row"}}),
              "gpu_sheen_weight");
    EXPECT_EQ(name_in_manner("cl_sheen", {{"cl_trace", "trace"}, {"cl_row", "row"}}), "sheen");
    EXPECT_EQ(name_in_manner("sheen_weight", {{"a_b", "a_b"}, {"c_d", "c_d"}, {"e", "f"}}), "sheen_weight");
    EXPECT_EQ(name_in_manner("sheen_weight", {}), "sheen_weight");
}

const std::string kScaled =
    "// What is left of a value.\nfloat scaled(float value) { return value * 0.5; }\n\n"
    "float shade(float value) { return scaled(value) + 1.0; }\n";
const std::string kScaledPort =
    "// What is left of a value.\nstatic float scaled(float value) { return value * 0.5f; }\n\n"
    "static float shade(float value) { return scaled(value) + 1.0f; }\n";
const std::string kMerged = "float shade(float value) { return value * 0.5 + 1.0; }\n";
const std::string kMergedPort = "static float shade(float value) { return value * 0.5f + 1.0f; }\n";

TEST_F(SyncNewUnit, AHelperThatGoesTakesItsPortAlong) {
    start("k.glsl", kScaled, "k.cpp", kScaledPort);
    write(source_path, kMerged);
    expect_ported(kMergedPort);
    EXPECT_EQ(read_text(root / "portmap.toml").find("scaled"), std::string::npos);
    EXPECT_EQ(read_text(root / "portmap.lock").find("scaled"), std::string::npos);
}

TEST_F(SyncNewUnit, APortThatIsStillUsedStays) {
    const std::string own = "\nfloat preview(float value) { return scaled(value); }\n";
    start("k.glsl", kScaled, "k.cpp", kScaledPort + own);
    write(source_path, kMerged);
    const nlohmann::json all = proposals(1);
    ASSERT_EQ(all.size(), 2u);
    EXPECT_EQ(all[1]["state"], "refused") << all.dump(1);
    EXPECT_NE(all[1].dump().find("still uses `scaled`"), std::string::npos) << all.dump(1);
    apply_all(all);
    EXPECT_EQ(target(), replaced(kScaledPort, "scaled(value) +", "value * 0.5f +") + own);
}

// A new function that nobody calls may be the old one under another name, with another text.
TEST_F(SyncNewUnit, APortStaysWhereItsSourceMayBeAnotherNow) {
    start("k.glsl", kScaled, "k.cpp", kScaledPort);
    write(source_path, "float damped(float v, float by) { return v / max(by, 2.0); }\n\n" + kMerged);
    const nlohmann::json all = proposals(1);
    EXPECT_NE(all.dump().find("`damped` came without a port"), std::string::npos) << all.dump(1);
    apply_all(all);
    EXPECT_NE(target().find("scaled"), std::string::npos);
}

TEST_F(SyncNewUnit, WhatIsBroughtInStepIsNoLongerDeferred) {
    start("k.glsl", kScaled, "k.cpp", kScaledPort);
    write(source_path, replaced(kScaled, "value * 0.5", "value * 0.25"));
    ASSERT_EQ(
        porttool({"defer", "s/k.glsl:scaled", "--owner", "me", "--until", "2100-01-01", "--reason", "later"}).exit_code,
        0);
    commit("later");
    EXPECT_EQ(json({"check"})["summary"]["deferred"], 1);
    const nlohmann::json all = proposals(0);
    apply_all(all);
    EXPECT_EQ(read_text(root / "portmap.lock").find("later"), std::string::npos);
    EXPECT_EQ(json({"check"})["summary"]["in_step"], 2);
    git("checkout -q t portmap.lock");
    EXPECT_EQ(porttool({"sync", "--apply"}).exit_code, 0);
    EXPECT_EQ(read_text(root / "portmap.lock").find("later"), std::string::npos);
}

// What each side makes of its kernels is said once more for a new one.
TEST_F(SyncNewUnit, AStatementThatDiffersFromOthersByAFunctionIsSaidAsTheyAre) {
    const std::string units =
                          "void first(uint job) { store(job, 1.0); }\nvoid second(uint job) { store(job, 2.0); }\n"
                          "void third(uint job) { store(job, 3.0); }\n",
                      fourth = "void fourth(uint job) { store(job, 4.0); }\n";
    const std::string run =
                          "void run(uint job, int stage) {\n  if (stage == 0) {\n    first(job);\n  } else if (stage "
                          "== 1) {\n    second(job);\n"
                          "  } else {\n    third(job);\n  }\n}\n",
                      more = "    second(job);\n  } else if (stage == 2) {\n    fourth(job);\n";
    const std::string host_units =
        "void first(uint job) { store(job, 1.0f); }\nvoid second(uint job) { store(job, 2.0f); }\n"
        "void third(uint job) { store(job, 3.0f); }\n";
    const std::string host_run =
        "void run(int stage) {\n  if (stage == 0) {\n    each<first>(pass.count);\n  } else if (stage == 1) {\n"
        "    each<second>(pass.count);\n  } else {\n    each<third>(pass.count);\n  }\n}\n";
    start("k.glsl", units + run, "k.cpp", host_units + host_run);
    write(source_path, units + fourth + replaced(run, "    second(job);\n", more));
    const nlohmann::json all = proposals(0);
    apply_all(all);
    EXPECT_NE(target().find(" each<fourth>(pass.count);\n"), std::string::npos) << target();
    EXPECT_EQ(target().find("fourth(job)"), std::string::npos) << target();
}

TEST_F(SyncNewUnit, BlocksGetAndLoseTheirBracesAsTheSourcesDo) {
    const std::string bare =
        "int clip(int v, int top) {\n  if (v > top)\n    v = top;\n  if (v < 0) v = 0;\n  return v;\n}\n";
    start("clip.cpp", bare, "clip.cu", bare);
    const std::string braced =
        "int clip(int v, int top) {\n  if (v > top + 1) {\n    v = top;\n  }\n  if (v < 0) v = 0;\n  return v;\n}\n";
    write(source_path, braced);
    expect_ported(braced);
    ASSERT_EQ(porttool({"accept", "--all"}).exit_code, 0);
    commit("braced");
    write(source_path, replaced(bare, "v < 0", "v < 1"));
    expect_ported(replaced(bare, "v < 0", "v < 1"));
}

TEST_F(SyncNewUnit, BracesThatThePortAloneHasOrLacksStay) {
    const std::string bare = "int clip(int v, int top) {\n  if (v > top)\n    v = top;\n  return v;\n}\n";
    const std::string braced = "int clip(int v, int top) {\n  if (v > top) {\n    v = top;\n  }\n  return v;\n}\n";
    start("clip.cpp", braced, "clip.cu", bare);
    write(source_path, replaced(braced, "v > top", "v >= top"));
    expect_ported(replaced(bare, "v > top", "v >= top"));
}

}  // namespace sync_new_unit_test
}  // namespace porttool::testing
