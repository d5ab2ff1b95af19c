// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// New statements whose words the port's side knows, and that are not how the port does such things.
#include "tests/porttool/synced_repository.h"

namespace porttool::testing {
namespace sync_port_manner_test {

class SyncPortManner : public SyncedRepository {};

/// The same for another runtime.
std::string for_hip(const std::string& text) {
    return replaced(replaced(replaced(text, "runCuda", "runHip"), "allocCudaRoom", "allocHipRoom"), "freeCudaRoom",
                    "freeHipRoom");
}

const std::string kRun =
    "void Sum::runCuda(int reps) {\n"
    "  Real_ptr all;\n"
    "  allocCudaRoom(all, 1);\n"
    "  for (int i = 0; i < reps; ++i) {\n"
    "    step(all);\n"
    "  }\n"
    "  freeCudaRoom(all);\n"
    "}\n";

TEST_F(SyncPortManner, ANewNameHasThePartThatAllOthersHaveThere) {
    start("sum-Cuda.cu", kRun, "sum-Hip.hip", for_hip(kRun));
    const std::string now = replaced(replaced(kRun, "allocCudaRoom(all, 1)", "alloc(Space::CudaPinned, all, 1)"),
                                     "freeCudaRoom(all)", "free_room(Space::CudaPinned, all)");
    const std::string ported =
        replaced(replaced(for_hip(kRun), "allocHipRoom(all, 1)", "alloc(Space::HipPinned, all, 1)"), "freeHipRoom(all)",
                 "free_room(Space::HipPinned, all)");
    expect_ported(now, ported);
}

TEST_F(SyncPortManner, AMethodHasThePartThatTheOthersHaveThere) {
    const auto file = [](const std::string& side, const std::string& more) {
        return "void Cut::forward_" + side + "(const Slab& in, Slab& out) {\n  float* to = out.mutable_" + side +
               "_rows();\n" + more + "  spread(to, 3);\n}\n";
    };
    start("k.cpp", file("near", ""), "k.cu", file("far", ""));
    expect_ported(file("near", "  const float* from = in.read_near_rows();\n"),
                  file("far", "  const float* from = in.read_far_rows();\n"));
}

TEST_F(SyncPortManner, ANameThatIsKeptSomewhereTellsNothing) {
    const auto file = [](const std::string& side, const std::string& more) {
        return "void Cut::forward_" + side + "(const Slab& in, Slab& out) {\n  float* to = out.mutable_" + side +
               "_rows();\n  float* kept = in.own_near_rows();\n  spread(to, kept);\n" + more + "}\n";
    };
    start("k.cpp", file("near", ""), "k.cu", file("far", ""));
    expect_left(file("near", "  mix(to, in.read_near_rows());\n"), "read_near_rows", 4);
}

TEST_F(SyncPortManner, OneMorePartThatAllHaveIsHadByANewOneToo) {
    const auto file = [](const std::string& part, const std::string& more) {
        return "void Mix::run(int count, const float* a, float* out) {\n  blas_" + part +
               "add(count, a, out);\n  blas_" + part + "mul(count, a, out);\n" + more + "}\n";
    };
    start("k.cpp", file("", ""), "k.cu", file("dev_", ""));
    const nlohmann::json got = proposal_of(file("", "  blas_set(count, out);\n"));
    EXPECT_NE(got["patch"].get<std::string>().find("+  blas_dev_set(count, out);"), std::string::npos) << got.dump(1);
}

TEST_F(SyncPortManner, HostCodeUsesNoElementOfWhatItHasForADevice) {
    const auto file = [](const std::string& side, const std::string& more) {
        return "void Loss::backward_" + side + "(Slab& out, int count) {\n  float* slope = out.slope_on_" + side +
               "();\n  scale(count, slope);\n" + more + "}\n";
    };
    start("k.cpp", file("host", ""), "k.cu", file("card", ""));
    expect_left(file("host", "  for (int i = 0; i < count; ++i) {\n    slope[i] = 0;\n  }\n"), "uses no element of", 3);
}

TEST_F(SyncPortManner, WhatTakesAReferenceThereTakesNoPointer) {
    const auto file = [](const std::string& amp, const std::string& more) {
        return "void most(int* at, int x);\nvoid pick(int* all, int* best, int x, int n) {\n  most(" + amp +
               "all[n], x);\n  least(best, x);\n" + more + "}\n";
    };
    start("k.c", file("&", ""), "k.cpp", replaced(file("", ""), "void most(int* at", "void most(int& at"));
    expect_left(file("&", "  most(best, x);\n"), "takes no pointer", 4);
}

TEST_F(SyncPortManner, WhatIsACallThereEachTimeIsOneAgain) {
    const auto file = [](const std::string& low, const std::string& high, const std::string& more) {
        return "void add_light(Sums* sums, const Colour light, int kind) {\n" + more + "  if (kind == 1)\n    " + low +
               ";\n  else\n    " + high + ";\n}\n";
    };
    start("k.cpp", file("sums->low += light", "sums->high += light", ""), "k.cl",
          file("ADD3(&sums->low.r, light)", "ADD3(&sums->high.r, light)", ""));
    expect_left(file("sums->low += light", "sums->high += light", "  sums->all[kind] += light;\n"), "calls `ADD3`", 1);
}

TEST_F(SyncPortManner, AnOldUseInAStatementOfThePortsOwnIsNamed) {
    const auto file = [](const std::string& name, const std::string& more, const std::string& own) {
        return "int part(int rank, int axis) {\n" + more + "  if (rank == 1 && " + name +
               " == 0) return first(rank);\n  if (rank == 2 && " + name + " == 1) return second(rank);\n" + own +
               "  return rank;\n}\n";
    };
    const std::string own = "  if (rank != 3 || axis != 0) return whole(rank);\n";
    start("k.cpp", file("axis", "", ""), "k.cu", file("axis", "", own));
    expect_left(file("at", "  int at = axis < 0 ? rank + axis : axis;\n", ""), "statement of its own", 4);
}

TEST_F(SyncPortManner, ATemplateOfThePortKeepsItsArguments) {
    const auto file = [](const std::string& head, const std::string& name) {
        return head + "struct square {\n  float operator()(float x) const { return x * x; }\n};\n" +
               "int each(int rank) {\n  int count = rank + 1;\n  return apply<" + name + ">(count);\n}\n";
    };
    start("k.cpp", file("template <typename T>\n", "square<float>"), "k.cu",
          replaced(file("template <typename T>\n", "square<float>"), "  float operator", "  T operator"));
    write(source_path, file("", "square"));
    const nlohmann::json all = nlohmann::json::parse(porttool({"sync", "--all", "--format", "json"}).out)["proposals"];
    for (const nlohmann::json& one : all)
        if (one["source"] == source_path + ":each") {
            EXPECT_NE(one["state"], "proposed") << one.dump(1);
        }
}

TEST_F(SyncPortManner, AMemberOfWhatIsPointedToIsSaidAsThePortSaysIt) {
    const auto file = [](const std::string& at, const std::string& more) {
        return "float bend(float3* out, const float3 in, float cut) {\n  if (fabs(" + at + "z) < cut" + more +
               ") return 0.0f;\n  const float a = fabs(" + at + "z);\n  return a * in.z;\n}\n";
    };
    start("k.cpp", file("out->", ""), "k.cl", file("(*out).", ""));
    const nlohmann::json got = proposal_of(file("out->", " || in.z * out->z < 0.0f"));
    ASSERT_TRUE(got["patch"].is_string()) << got.dump(1);
    std::string dense = got["patch"];
    std::erase(dense, ' ');
    EXPECT_NE(dense.find("||in.z*(*out).z<0.0f"), std::string::npos) << got.dump(1);
}

TEST_F(SyncPortManner, AParameterThatGoesIsTheOneOfItsNameOfWhateverType) {
    const auto file = [](const std::string& type, const std::string& middle, const std::string& last) {
        return "void press(int n, " + type + "low" + middle + last + ") {\n  run(n, low);\n}\n";
    };
    const std::string from = "grid::Reader<double, 2>::Type ", to = "grid::Buffer<double> &";
    start("k.cpp", file(from, ", " + from + "high", ", " + from + "work"), "k.cu",
          file(to, ", " + to + "high", ", " + to + "work"));
    const nlohmann::json got = proposal_of(file(from, ", " + from + "high", ""));
    ASSERT_TRUE(got["patch"].is_string()) << got.dump(1);
    EXPECT_NE(got["patch"].get<std::string>().find("&high) {"), std::string::npos) << got.dump(1);
}

}  // namespace sync_port_manner_test
}  // namespace porttool::testing
