// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Names that a unit and its port have each in their own way, and the lines that are named where something is left. Each
// port is as a person would write it.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_own_names_test {

class SyncOwnNames : public SyncedRepository {
protected:
    /// The proposal of the one pair, where somebody names it.
    nlohmann::json asked(const std::string& id) {
        return nlohmann::json::parse(porttool({"sync", id, "--format", "json"}).out)["proposals"][0];
    }
};

const std::string kBlend =
    "template <typename T>\n"
    "void Blend<T>::back_near(const vector<Slab<T>*>& top, const bool down) {\n"
    "    if (down) {\n"
    "        const T* slope = top[0]->near_slope();\n"
    "        spread(slope, 3);\n"
    "    }\n"
    "}\n";

/// The same on the other side of a bus.
std::string far(const std::string& text) {
    return replaced(replaced(text, "back_near", "back_far"), "near_slope", "far_slope");
}

TEST_F(SyncOwnNames, AParameterOfATemplatesMethodIsDeclaredThere) {
    start("k.cpp", kBlend, "k.cu", far(kBlend));
    const std::string now =
        replaced(replaced(kBlend, "const bool down", "const vector<bool>& down"), "if (down)", "if (down[0])");
    expect_ported(now, far(now));
}

TEST_F(SyncOwnNames, AMethodKnowsItsOwnObject) {
    start("k.cpp", kBlend, "k.cu", far(kBlend));
    const std::string now = replaced(kBlend, "if (down)", "if (down && this->is_open)");
    expect_ported(now, far(now));
}

TEST_F(SyncOwnNames, AWordIsNotOfARuntimeForItsFirstLetters) {
    start("k.cpp", kBlend, "k.cu", far(kBlend));
    const std::string now = replaced(kBlend, "spread(slope, 3);", "spread(slope, 3);\n        current_row += 1;");
    expect_ported(now, far(now));
}

TEST_F(SyncOwnNames, TwoNamesOfTheSourceAreTwoThings) {
    const auto file = [](const std::string& step, const std::string& more) {
        return "namespace mill {\nvoid Wheel::" + step + "(int count) {\n  turn(count);\n" + more + "  rest();\n}\n}\n";
    };
    start("k.cpp", file("run_near", ""), "k.cu", file("run_far", ""));
    expect_ported(file("run_near", "  phase = Mill::phase(count);\n"),
                  file("run_far", "  phase = Mill::phase(count);\n"));
}

TEST_F(SyncOwnNames, AMacroNamedForItsRuntimeGoesOnBothSides) {
    const auto file = [](const std::string& runtime, const std::string& first, const std::string& last) {
        return "void Diff::run" + runtime + "(int vid) {\n  const int reps = count_of(vid);\n" + first +
               "  start(reps);\n  finish(reps, vid);\n" + last + "}\n";
    };
    start("k.cu", file("Cuda", "  DATA_SETUP_CUDA;\n", "  DATA_TEARDOWN_CUDA;\n"), "k.cpp",
          file("Hip", "  DATA_SETUP_HIP;\n", "  DATA_TEARDOWN_HIP;\n"));
    expect_ported(file("Cuda", "", ""), file("Hip", "", ""));
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
}

TEST_F(SyncOwnNames, AMacroThatTheOtherSideAloneLosesIsStillAskedAbout) {
    const auto file = [](const std::string& runtime, const std::string& first) {
        return "void Diff::run" + runtime + "(int vid) {\n  const int reps = count_of(vid);\n" + first +
               "  start(reps);\n  finish(reps, vid);\n}\n";
    };
    start("k.cu", file("Cuda", "  DATA_SETUP_CUDA;\n  CHECK_CUDA;\n"), "k.cpp",
          file("Hip", "  DATA_SETUP_HIP;\n  CHECK_HIP;\n"));
    write(source_path, file("Cuda", "  CHECK_CUDA;\n"));
    write(port_path, file("Hip", "  DATA_SETUP_HIP;\n"));
    EXPECT_EQ(porttool({"check"}).exit_code, 1);
}

TEST_F(SyncOwnNames, TheLineOfAParameterIsNamedNotThatOfTheHead) {
    const std::string source =
        "float fade(const Spot spot, float low,\n           float high) {\n  return low * high;\n}\n";
    const std::string port =
        "float fade(\n    float ax,\n    float ay,\n    float az,\n    float aw,\n    float low,\n    float high)\n{\n"
        "  return low * high;\n}\n";
    start("k.cu", source, "k.glsl", port);
    const nlohmann::json got = proposal_of(
        replaced(replaced(source, "float high)", "float high, unsigned edge)"), "low * high", "low * high * edge"));
    for (const nlohmann::json& item : got["left"]) EXPECT_GE(item["target_line"], 6) << got.dump(1);
}

TEST_F(SyncOwnNames, WhatThePortHasOnceIsNamedWhereItHasIt) {
    const std::string step = "  widen(blob, wide, top, bottom, 0.0f, opt);\n";
    const std::string half = "void forward(int blob, int wide, int top, int bottom, int opt) {\n" + step +
                             "  if (blob > 3) {\n    sort(blob);\n    flip(wide);\n  }\n  settle(top);\n";
    const std::string rest = "  for (int i = 0; i < 3; i++) {\n    shift(i);\n  }\n" + step + "  sum(bottom);\n}\n";
    const std::string port =
        "void forward(int blob, int wide, int top, int bottom, int opt)\n{\n  for (int i = 0; i < 3; i++)\n  {\n"
        "    shift(i);\n  }\n" +
        step + "  sum(bottom);\n}\n";
    start("k.cpp", half + rest, "k.cu", port);
    const nlohmann::json got = proposal_of(replaced(replaced(half, "0.0f", "rim"), "int opt", "int opt, float rim") +
                                           replaced(rest, "0.0f", "rim"));
    for (const nlohmann::json& item : got["left"]) EXPECT_NEAR(item["target_line"].get<int>(), 7, 3) << got.dump(1);
}

TEST_F(SyncOwnNames, WhatThePortLacksIsNotReadBeyondTheEndOfTheEdit) {
    const std::string begin = "void bind(box& m) {\n  item<Cells, Base>(m, \"Cells\").with(init<Shared<Sys>>())";
    start("k.cc",
          begin +
              "\n    .part(\"size\", &Cells::size, &Cells::resize)\n    .def(\"join\", &Cells::join)\n"
              "    .def(\"leave\", &Cells::leave);\n}\n",
          "g.cc", "void bind(box& m) {\n  item<CellsGPU, Cells>(m, \"CellsGPU\").with(init<Shared<Sys>>());\n}\n");
    expect_left(begin +
                    "\n    .part(\"size\", &Cells::size, &Cells::resize)\n    .part(\"shift\", &Cells::shifts, "
                    "&Cells::shift);\n}\n",
                "changed beside it", 2);
}

TEST_F(SyncOwnNames, ANewNameOfALocalIsCarriedWhereSomebodyAsks) {
    const auto file = [](const std::string& local) {
        return "float fade(float low) {\n    float " + local + " = low * 2.0f;\n    return " + local + " + low;\n}\n";
    };
    start("k.cpp", file("span"), "k.cl", file("span"));
    write(source_path, file("reach"));
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0) << "nothing is due";
    EXPECT_TRUE(nlohmann::json::parse(porttool({"sync", "--format", "json"}).out)["proposals"].empty());
    ASSERT_EQ(asked("src/k.cpp:fade")["state"], "proposed");
    ASSERT_EQ(porttool({"sync", "src/k.cpp:fade", "--apply"}).exit_code, 0);
    EXPECT_EQ(port_now(), file("reach"));
    EXPECT_EQ(porttool({"check", "--strict"}).exit_code, 0);
}

TEST_F(SyncOwnNames, ALocalThatThePortCallsOtherwiseKeepsItsName) {
    const auto file = [](const std::string& local) {
        return "float fade(float low) {\n    float " + local + " = low * 2.0f;\n    return " + local + " + low;\n}\n";
    };
    start("k.cpp", file("span"), "k.cl", file("width"));
    write(source_path, file("reach"));
    const nlohmann::json got = asked("src/k.cpp:fade");
    EXPECT_EQ(got["state"], "already") << got;
    EXPECT_TRUE(got["patch"].is_null());
}

TEST_F(SyncOwnNames, AMemberOfAPointerOfThePort) {
    const auto file = [](const std::string& type, const std::string& picks, const std::string& more) {
        return "void reset(" + type + "aux) {\n    aux" + picks + "count = 0;\n}\n\nvoid step(" + type +
               "aux, float z) {\n    float w = z * 2.0f;\n    show(w);\n" + more + "}\n";
    };
    start("k.cpp", file("Aux &", ".", ""), "k.cl", file("__global Aux *", "->", ""));
    expect_ported(file("Aux &", ".", "    aux.count = 3;\n"), file("__global Aux *", "->", "    aux->count = 3;\n"));
}

TEST_F(SyncOwnNames, AMacroForAConstantIsLeft) {
    const std::string rest = "\nint twice(int n) {\n    return n * 2;\n}\n", plain = "const int kSize = 256;",
                      macro = "#define kSize 128";
    start("k.cu", plain + rest, "k.cpp", plain + rest);
    expect_left(macro + rest, "made a macro of it", 1);
}

TEST_F(SyncOwnNames, AConstantForAMacroIsLeft) {
    const std::string rest = "\nint twice(int n) {\n    return n * 2;\n}\n", plain = "const int kSize = 256;",
                      macro = "#define kSize 128";
    start("k.cu", macro + rest, "k.cpp", macro + rest);
    expect_left(plain + rest, "no macro any more", 1);
}

TEST_F(SyncOwnNames, ANewEnumeratorIsTheEditsOwn) {
    const auto file = [](const std::string& last) {
        return "typedef enum {\n    NEAR_EDGE = 1,\n    FAR_EDGE = 2" + last + "\n} Edge;\n";
    };
    start("k.cpp", file(""), "k.cl", file(""));
    expect_ported(file(",\n    NO_EDGE = 4"), file(",\n    NO_EDGE = 4"));
}

TEST_F(SyncOwnNames, ANewEnumeratorComesBehindTheOneBeforeItWhateverFollows) {
    const auto file = [](const std::string& list) { return "typedef enum { " + list + " } Kind;\n"; };
    start("k.cpp", file("IMAGE, NOISE, MARBLE, WOOD, BRICK"), "k.cl", file("IMAGE, WOOD, MARBLE, NOISE, BRICK"));
    const nlohmann::json got = proposal_of(file("IMAGE, NOISE, MARBLE, CLOUD, WOOD, BRICK"));
    EXPECT_NE(got["patch"].get<std::string>().find("MARBLE, CLOUD, NOISE"), std::string::npos) << got;
}

TEST_F(SyncOwnNames, ATemplatesLastValueIsDeclaredThere) {
    const std::string before =
        "template <int kRows, int kLanes, int kRuns>\nvoid spin(int n) {\n"
        "    turn<kRows, kLanes>(n, kRuns);\n}\n";
    const std::string now = replaced(replaced(before, ", int kRuns", ""), "n, kRuns", "n, 3");
    start("k.cu", before, "k.cpp", before);
    expect_ported(now, now);
}

TEST_F(SyncOwnNames, ACallThatThePortsFunctionCannotTakeIsLeft) {
    const std::string body = "\nfloat shade(float z) {\n    float w = z + 1.0f;\n    return w;\n}\n";
    start("k.cu", "#define blend(a) ((a) * 2.0f)\n" + body, "k.cpp",
          "float blend(float a, float b) {\n    return a * b;\n}\n" + body);
    const nlohmann::json got =
        proposal_of("#define blend(a) ((a) * 2.0f)\n" + replaced(body, "    return", "    w = blend(w);\n    return"));
    EXPECT_NE(got["state"], "proposed") << got.dump(1);
}

TEST_F(SyncOwnNames, AnArgumentComesBehindThePortsOwn) {
    struct Side {
        std::string queue, own, given;
    };
    const auto file = [](const Side& side, const std::string& more, const std::string& given, const std::string& now) {
        return "template <typename T>\nvoid run(" + side.own + more +
               "int repeat, bool timing) {\n    show(repeat, timing);\n}\n\nint main(int argc, char** argv) {\n" +
               side.queue + "    int repeat = atoi(argv[1]);\n" + now + "    run<char>(" + side.given + given +
               "repeat, false);\n    run<int>(" + side.given + given + "repeat, true);\n    return 0;\n}\n";
    };
    const Side plain, queued{"    queue q;\n", "queue& q, ", "q, "};
    start("k.cu", file(plain, "", "", ""), "k.cpp", file(queued, "", "", ""));
    write(source_path, file(plain, "int n, ", "n, ", "    int n = atoi(argv[2]);\n"));
    const std::string left = porttool({"sync"}).out;
    ASSERT_EQ(porttool({"sync", "--apply"}).exit_code, 0) << left;
    EXPECT_EQ(dense(port_now()), dense(file(queued, "int n, ", "n, ", "    int n = atoi(argv[2]);\n")));
}

TEST_F(SyncOwnNames, ANeighbourThatNamesALibrarysStreamMayBeMissing) {
    const auto file = [](const std::string& more, const std::string& last) {
        return "void usage(char** argv) {\n    fprintf(stderr, \"Usage: %s <rows>\\n\", argv[0]);\n"
               "    fprintf(stderr, \"rows: how many\\n\");\n" +
               more + last + "    exit(1);\n}\n";
    };
    const std::string more = "    fprintf(stderr, \"repeat: how often\\n\");\n",
                      last = "    fprintf(stderr, \"file: where to\\n\");\n";
    start("k.cu", file("", last), "k.cpp", file("", ""));
    expect_ported(file(more, last), file(more, ""));
}

TEST_F(SyncOwnNames, AConditionIsTheSameWhateverElseThePortAsks) {
    const auto file = [](const std::string& own, const std::string& samples) {
        return "void drive(int n) {\n#ifdef DEBUG\n    const int lanes = 2;\n    const int samples = 64;\n#else\n"
               "    const int lanes = 8;\n    const int samples = " +
               samples + ";\n#endif\n" + own + "    go(n, lanes, samples);\n}\n";
    };
    const std::string own = "#ifdef USE_GPU\n    prefer(1);\n#else\n    prefer(0);\n#endif\n";
    start("k.cu", file("", "1000"), "k.cpp", file(own, "1000"));
    expect_ported(file("", "5000"), file(own, "5000"));
}

}  // namespace sync_own_names_test
}  // namespace porttool::testing
