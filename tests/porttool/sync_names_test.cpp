// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Names that a unit and its port have each in their own way, and the lines that are named where something is left. Each
// port is as a person would write it.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_own_names_test {

class SyncOwnNames : public SyncedRepository {};

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

}  // namespace sync_own_names_test
}  // namespace porttool::testing
