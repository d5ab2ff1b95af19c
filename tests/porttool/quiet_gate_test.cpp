// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What the gate says once, or as a note, each beside a case like it that stays as loud as ever.
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::quiet_gate_test {
namespace {

using Texts = std::map<std::string, std::string>;  ///< files by their paths beneath the root

/// The findings that weigh at least a warning, as "rule source-or-target", after `before` was recorded and `now` took
/// the place of what it names. `pairs` are lines of `[[pair]]`; none: those that init finds.
std::vector<std::string> loud(const Texts& before, const Texts& now, const std::vector<std::string>& pairs = {}) {
    MemoryDisk disk;
    for (const auto& [path, text] : before) disk.files["/r/" + path] = text;
    std::vector<std::string> init = {"-C", "/r", "init", "--force"};
    if (pairs.empty()) {
        for (const char* option : {"--source", "s/*", "--target", "t/*"}) init.emplace_back(option);
    } else {
        std::string map = "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n";
        for (const std::string& pair : pairs) {
            const size_t sign = pair.find('=');
            map += "[[pair]]\nsource = \"" + pair.substr(0, sign) + "\"\ntarget = \"" + pair.substr(sign + 1) + "\"\n";
        }
        disk.files["/r/portmap.toml"] = map;
    }
    EXPECT_EQ(run(disk, init).exit_code, 0);
    for (const auto& [path, text] : now) disk.files["/r/" + path] = text;
    std::vector<std::string> out;
    const auto report = check(disk);
    for (const auto& finding : report["findings"]) {
        if (finding["level"] == "note") continue;
        const auto& place = finding["source"].is_null() ? finding["target"] : finding["source"];
        out.push_back(finding["rule"].get<std::string>() + " " + place["id"].get<std::string>());
    }
    return out;
}

using Loud = std::vector<std::string>;

const std::string kSource =
    "void f(float* y, const float* x, float lim, int n) {\n"
    "  int at = first_index();\n  if (at >= n) { return; }\n  y[at] = x[at] * 2.0f;\n}\n";
const std::string kPort =
    "void f(float* y, const float* x, float lim, int n) {\n"
    "  Device device = pool.device(0);\n  device.open();\n"
    "  for (int at = 0; at < n; ++at) { y[at] = x[at] * 2.0f; }\n"
    "  pool.give_back(device);\n}\n";

Loud after_port(const std::string& from, const std::string& to) {
    return loud({{"s/k.cu", kSource}, {"t/k.cpp", kPort}}, {{"t/k.cpp", replaced(kPort, from, to)}},
                {"s/k.cu:f=t/k.cpp:f"});
}

TEST(QuietGate, WhatTouchesNothingInCommonIsANote) {
    const Loud told = {"target-changed s/k.cu:f"};
    const std::string open = "device.open();";
    EXPECT_EQ(after_port(open, "device.open();\n  if (pool.is_shared(device)) { pool.advise(device, Usage::Often); }"),
              Loud{});
    // The same in the middle of what both have; a word or two; another number; a pragma; the same in another order.
    EXPECT_EQ(after_port("{ y[at]", "{ if (pool.is_shared(device)) { pool.advise(device, Usage::Often); } y[at]"),
              told);
    EXPECT_EQ(after_port(open, "device.shut();"), told);
    EXPECT_EQ(after_port("pool.device(0);", "pool.device(Usage::Often, Kind::Large, pool.first() + 1);"), told);
    EXPECT_EQ(after_port(open, "#pragma omp atomic update hint(often) seq_cst\n  device.open();"), told);
    EXPECT_EQ(after_port("Device device = pool.device(0);\n  device.open();",
                         "device.open();\n  Device device = pool.device(0);"),
              told);
    // Names that both know.
    EXPECT_EQ(after_port(open, "device.open();\n  if (n > 0 && lim > 0) { y[0] = lim; x = y + n; }"), told);
}

TEST(QuietGate, WhereTextsAreApartOnlyWholeClausesAreCommonGround) {
    const std::string source =
        "__kernel void f(__global float* y, __global const float* x, const int n) {\n"
        "  const int id = get_global_id(0);\n  if (id >= n) { return; }\n"
        "  const float drop = exp(-x[id] * 0.5f);\n  y[id] = drop;\n}\n";
    const std::string port =
        "void Film::Fade(const Tile& tile) {\n  Job job(pool, tile.Rows());\n  Guard guard(job.Lock());\n"
        "  for (Row& row : tile.Each()) { if (row.IsMasked()) { continue; } row.Touch(job.Id()); }\n"
        "  const float drop = exp(-x[id] * 0.5f);\n  job.Finish();\n  log.Add(guard.Waited());\n}\n";
    const auto after = [&](const std::string& from, const std::string& to) {
        return loud({{"s/k.cl", source}, {"t/k.cpp", port}}, {{"t/k.cpp", replaced(port, from, to)}},
                    {"s/k.cl:f=t/k.cpp:Film::Fade"});
    };
    const Loud told = {"target-changed s/k.cl:f"};
    EXPECT_EQ(after("Guard guard(job.Lock());", "if (job.IsWide()) { job.Split(tile); }\n  Guard guard(job.Lock());"),
              Loud{});
    EXPECT_EQ(after("job.Finish();", "job.Finish();\n#ifdef TRACE_JOBS\n  job.Trace(Level::All, Sink::Own);\n#endif"),
              Loud{});
    // A word or two, the same word twice; a number for a number; what the compiler is told; beside what both say, and
    // in it.
    EXPECT_EQ(after("row.IsMasked()", "row.IsHidden()"), told);
    EXPECT_EQ(after("if (row.IsMasked()) {", "if (!row.IsMasked()) {"), told);
    EXPECT_EQ(after("Guard guard(job.Lock());", "Lease guard(job.Take());"), told);
    EXPECT_EQ(after("job.Finish();", "#pragma omp barrier\n  job.Finish(); job.Drain(pool, Level::All, Sink::Own);"),
              told);
    EXPECT_EQ(after("job.Finish();", "job.Finish();\n#define DROP_ALL job.Drain(pool, tile, Level::All, Sink::Own)\n"),
              told);
    EXPECT_EQ(after("  job.Finish();", "  Meter::Weigh(drop, tile.Rows(), Level::All);\n  job.Finish();"), told);
    EXPECT_EQ(after("exp(-x[id] * 0.5f)", "exp(-x[id] * 0.5f) * job.Gain(tile, Level::All, guard)"), told);
}

TEST(QuietGate, AnotherLabelInASwitchIsAWord) {
    const auto text = [](const std::string& label) {
        return "void f(int kind, Scene& scene) { Pool pool(scene); pool.Open(); switch (kind) { case " + label +
               ": pool.Wide(scene); break; case THIN: pool.Thin(scene); break; } pool.Shut(); }";
    };
    EXPECT_EQ(loud({{"s/k.cl", "__kernel void f(__global float* y) { y[get_global_id(0)] = sqrt(y[0]) * 0.5f; }"},
                    {"t/k.cpp", text("WIDE")}},
                   {{"t/k.cpp", text("VAST")}}, {"s/k.cl:f=t/k.cpp:f"}),
              Loud{"target-changed s/k.cl:f"});
}

TEST(QuietGate, ALabelThatTheOtherSideHasInThatArm) {
    const auto text = [](const std::string& plain, const std::string& other) {
        return "int f(int op) { switch (op) { " + plain + " return 1; " + other + " return 2; default: return 0; } }";
    };
    const std::string before = text("case ADD: case SUB:", "case MUL:");
    const std::string port = text("case ADD: case SUB: case NEG:", "case MUL: case DIV:");
    const auto after = [&](const std::string& source, const std::string& there) {
        return loud({{"s/k.cu", before}, {"t/k.cpp", port}}, {{"s/k.cu", source}, {"t/k.cpp", there}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after(text("case ADD: case SUB: case NEG:", "case MUL:"), port), Loud{});
    EXPECT_EQ(after(text("case ADD: case SUB:", "case MUL: case NEG:"), port), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after(text("case ADD: case SUB: case MOD:", "case MUL:"), port), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after(text("case MUL: case SUB: case NEG:", "case ADD:"), port), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after(text("case ADD: case SUB: case NEG: case NEG:", "case MUL:"), port),
              Loud{"source-changed s/k.cu:f"});
    // On both sides, each beside labels of its own.
    const std::string own = text("case ADD: case SUB: case NEG: case ABS:", "case MUL: case DIV:");
    EXPECT_EQ(after(text("case ADD: case SUB: case ABS:", "case MUL:"), own), Loud{});
    EXPECT_EQ(after(text("case ADD: case SUB:", "case MUL: case ABS:"), own), Loud{"port-differs s/k.cu:f"});
}

TEST(QuietGate, MembersOfWhatIsAPointerNow) {
    const std::string before = "float f(Aux aux, float x) { float c = aux.color; aux.keep(c); return c * x; }";
    const auto after = [&](const std::string& from, const std::string& to) {
        return loud({{"s/k.cl", before}, {"t/k.cpp", before}}, {{"s/k.cl", replaced(before, from, to)}},
                    {"s/k.cl:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after("aux.color", "aux->color"), Loud{});
    EXPECT_EQ(after("aux.keep", "aux->keep"), Loud{"source-changed s/k.cl:f"});
    EXPECT_EQ(after("aux.color", "aux->alpha"), Loud{"source-changed s/k.cl:f"});
}

TEST(QuietGate, AMacroThatOnlyDecidesOnPrints) {
    const auto text = [](const std::string& guarded) {
        return "void f(float* y, int n) {\n  for (int i = 0; i < n; ++i) { y[i] *= 2.0f; }\n#ifdef BENCH_PRINT\n" +
               guarded + "\n#endif\n}\n";
    };
    const auto after = [&](const std::string& guarded) {
        return loud({{"s/k.cu", "#define BENCH_PRINT\n" + text(guarded)}, {"t/k.cpp", text(guarded)}},
                    {{"s/k.cu", text(guarded)}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after("  for (int i = 0; i < n; ++i) { printf(\"%f\", y[i]); }"), Loud{});
    EXPECT_EQ(after("  for (int i = 0; i < n; ++i) { printf(\"%f\", y[i]); y[i] = 0.0f; }"),
              Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after("  for (n = 0; n < 4; ++n) { printf(\"%f\", y[n]); }"), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after("  for (int i = 0; i < n; ++i) { printf(\"%f\", y[i]); } n++;"), Loud{"source-changed s/k.cu:f"});
}

TEST(QuietGate, AMacroThatATextUsesNoLonger) {
    const std::string head = "#define MOST 8\n", text = "int f(int n, int k) { return n > MOST ? k : n; }\n",
                      port = "int f(int n, int k) { return n > 8 ? k : n; }\n";
    const auto after = [&](const std::string& now) {
        return loud({{"s/k.cu", head + text}, {"t/k.cpp", port}}, {{"s/k.cu", now}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after(replaced(text, "MOST", "most_of(k)")), Loud{"source-changed s/k.cu:f"}) << "the edit, and once";
    EXPECT_EQ(after("#define K_MOST 8\n" + text), Loud{"source-changed s/k.cu:f"}) << "text and macro apart";
}

TEST(QuietGate, ScopesOfNames) {
    const std::string port = "void f(float* y, nd_item<3>& item) { y[item.get(2)] = std::max(y[0], y[1]); }";
    const auto after = [&](const std::string& from, const std::string& to) {
        return loud(
            {{"s/k.cu", "__global__ void f(float* y) { y[threadIdx.x] = fmaxf(y[0], y[1]); }"}, {"t/k.cpp", port}},
            {{"t/k.cpp", replaced(port, from, to)}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after("nd_item<3>", "sycl::nd_item<3>"), Loud{});
    const auto rescoped = [&](const std::string& from, const std::string& to) {
        const std::string text = "void f(int* y) { auto last = " + from + "plus<int>(); y[0] = last(y[0], y[1]); }";
        return loud({{"s/k.cu", "__global__ void f(int* y) { y[0] += y[1]; }"}, {"t/k.cpp", text}},
                    {{"t/k.cpp", replaced(text, from, to)}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(rescoped("ext::oneapi::", "sycl::"), Loud{});
    EXPECT_EQ(rescoped("ext::oneapi::", "own::"), Loud{"target-changed s/k.cu:f"});
    EXPECT_EQ(rescoped("own::", "sycl::"), Loud{"target-changed s/k.cu:f"});
    EXPECT_EQ(after("std::max", "own::max"), Loud{"target-changed s/k.cu:f"});
    EXPECT_EQ(after("std::max(y[0], y[1])", "std::max(max(y[0], 0), y[1])"), Loud{"target-changed s/k.cu:f"});
}

TEST(QuietGate, FieldsOfStructsThatWereNeverOne) {
    const std::string own = "struct S { int device; Queue queue; void* room; };";
    const auto after = [&](const std::string& source, const std::string& from, const std::string& to) {
        return loud({{"s/k.h", source}, {"t/k.h", own}}, {{"t/k.h", replaced(own, from, to)}}, {"s/k.h:S=t/k.h:S"});
    };
    const std::string other = "struct S { int device; Stream stream; float* data; };";
    const std::string same = "struct S { int device; Queue queue; void* room; int flags; };";
    EXPECT_EQ(after(other, "void* room;", "void* room; bool shared;"), Loud{});
    EXPECT_EQ(after(other, "void* room;", "float* room;"), Loud{"target-changed s/k.h:S"});
    EXPECT_EQ(after(other, "int device; ", ""), Loud{"target-changed s/k.h:S"});
    EXPECT_EQ(after(same, "void* room;", "void* room; bool shared;"), Loud{"target-changed s/k.h:S"});
}

TEST(QuietGate, AListThatCatchesUp) {
    const std::string here = "enum Kind { MATTE, GLASS };", there = "enum Kind { MATTE, GLASS, METAL, VELVET };";
    const auto after = [&](const std::string& to) {
        return loud({{"s/k.h", here}, {"t/k.h", there}}, {{"s/k.h", to}}, {"s/k.h:Kind=t/k.h:Kind"});
    };
    EXPECT_EQ(after("enum Kind { MATTE, GLASS, METAL };"), Loud{});
    EXPECT_EQ(after("enum Kind { MATTE, GLASS, CLOTH };"), Loud{"constant-differs s/k.h:Kind"});
    EXPECT_EQ(after("enum Kind { MATTE, METAL };"), Loud{"constant-differs s/k.h:Kind"});
    EXPECT_EQ(after("enum Kind { MATTE };"), Loud{"constant-differs s/k.h:Kind"});
}

TEST(QuietGate, AnEditThatSeveralPortsLackIsToldOnce) {
    const auto file = [](const std::string& body) { return "float f(float x, float k) { " + body + " }\n"; };
    const std::string was = "return x * k + 1.0f;", is = "return x * k + sqrt(x + k) * 3.0f;";
    const Loud after = loud({{"s/k.cu", file(was)}, {"t/a.cpp", file(was)}, {"t/b.cpp", file(was)}},
                            {{"s/k.cu", file(is)}}, {"s/k.cu:f=t/a.cpp:f", "s/k.cu:f=t/b.cpp:f"});
    EXPECT_EQ(after, Loud{"source-changed s/k.cu:f"});
}

TEST(QuietGate, AnEditMadeInSeveralUnitsIsToldOnceUnlessItIsAWord) {
    const auto file = [](const std::string& body) {
        std::string out;
        for (const char* name : {"f", "g"})
            out += std::string("float ") + name + "(float x, float k) { " + body + " }\n";
        return out;
    };
    const std::string was = file("return x * k + 1.0f;");
    const auto after = [&](const std::string& body) {
        return loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"s/k.cu", file(body)}},
                    {"s/k.cu:f=t/k.cpp:f", "s/k.cu:g=t/k.cpp:g"});
    };
    EXPECT_EQ(after("return x * k + sqrt(x + k) * 3.0f;").size(), 1u);
    EXPECT_EQ(after("return x * k - 1.0f;").size(), 2u);
}

TEST(QuietGate, NewUnitsOfOneFileAreToldOnce) {
    const auto body = [](const std::string& name, const std::string& number) {
        return "float " + name + "(float x, float k) { float s = sqrt(x * k + " + number +
               "); for (int i = 0; i < 3; ++i) { s += x / (k + i); } return s * " + number + "; }\n";
    };
    const std::string old = body("first", "1.5f"), two = body("second", "2.5f") + body("third", "3.5f");
    const Texts before = {{"s/k.cu", old}, {"t/k.cpp", old + two}};
    EXPECT_EQ(loud(before, {{"s/k.cu", old + two}}, {"s/k.cu:first=t/k.cpp:first"}), Loud{"unpaired s/k.cu:second"});
    EXPECT_EQ(loud(before, {{"s/k.cu", old + body("second", "2.5f")}, {"s/b.cu", body("third", "3.5f")}},
                   {"s/k.cu:first=t/k.cpp:first"}),
              (Loud{"unpaired s/b.cu:third", "unpaired s/k.cu:second"}));
}

TEST(QuietGate, APortWithAnotherSourceIsNoOrphan) {
    const std::string port = "float f(float x) { return x * 2.0f + 1.0f; }\n";
    const std::string wide = "float f4(float x) { return x * 2.0f + 1.0f; }\n";
    const Texts before = {{"s/k.cl", port + wide}, {"t/k.cpp", port}};
    EXPECT_EQ(loud(before, {{"s/k.cl", port}}, {"s/k.cl:f=t/k.cpp:f", "s/k.cl:f4=t/k.cpp:f"}), Loud{});
    EXPECT_EQ(loud(before, {{"s/k.cl", "int g(int a) { return a; }\n"}}, {"s/k.cl:f4=t/k.cpp:f"}),
              (Loud{"unported s/k.cl:g", "orphaned t/k.cpp:f"}));
}

TEST(QuietGate, OneMoreOfManyWithoutAPortIsANote) {
    const auto function = [](const std::string& name) {
        return "int " + name + "(int a) { " + name + "_state += a; return reset_" + name + "(a); }\n";
    };
    const std::string paired = "float f(float x) { return x * 2.0f + 1.0f; }\n";
    const std::string few = paired + function("load"),
                      many = few + function("save") + function("quit") + function("idle");
    const auto after = [&](const std::string& text) {
        return loud({{"s/k.cu", text}, {"t/k.cpp", paired}}, {{"s/k.cu", text + function("fresh")}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after(many), Loud{});
    EXPECT_EQ(after(few), Loud{"unported s/k.cu:fresh"});
}

TEST(QuietGate, AnAliasOfTheSameCallIsANote) {
    const std::string text = "#include \"vendor.h\"\nvoid f(float* y) { cudaStreamWaitEvent(0); y[0] = exp(y[1]); }\n";
    const auto after = [&](const std::string& vendor) {
        return loud({{"s/vendor.h", "#define cudaFree hipFree\n"},
                     {"s/k.cu", text},
                     {"t/k.cpp", "void f(float* y) { y[0] = exp(y[1]); }\n"}},
                    {{"s/vendor.h", "#define cudaFree hipFree\n" + vendor}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after("#define cudaStreamWaitEvent hipStreamWaitEvent\n"), Loud{});
    EXPECT_EQ(after("#define exp native_exp\n"), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after("#define cudaStreamWaitEvent hipStreamQuery\n"), Loud{"source-changed s/k.cu:f"});
}

}  // namespace
}  // namespace porttool::testing::quiet_gate_test
