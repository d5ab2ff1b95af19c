// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What the gate says once, or as a note, each beside a case like it that stays as loud as ever.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::quiet_gate_test {
namespace {

using Texts = std::map<std::string, std::string>;  ///< files by their paths beneath the root

/// What is found after `before` was recorded and `now` took the place of what it names. `pairs` are lines of
/// `[[pair]]`; none: those that init finds.
nlohmann::json found_after(const Texts& before, const Texts& now, const std::vector<std::string>& pairs) {
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
    return check(disk)["findings"];
}

/// The findings that weigh at least a warning, as "rule source-or-target".
std::vector<std::string> loud(const Texts& before, const Texts& now, const std::vector<std::string>& pairs = {}) {
    std::vector<std::string> out;
    for (const auto& finding : found_after(before, now, pairs)) {
        if (finding["level"] == "note") continue;
        const auto& place = finding["source"].is_null() ? finding["target"] : finding["source"];
        out.push_back(finding["rule"].get<std::string>() + " " + place["id"].get<std::string>());
    }
    return out;
}

using Loud = std::vector<std::string>;

/// The level of the one finding; "" for none.
std::string level_of(const Texts& before, const Texts& now, const std::vector<std::string>& pairs) {
    const nlohmann::json findings = found_after(before, now, pairs);
    EXPECT_LE(findings.size(), 1u);
    return findings.empty() ? std::string() : findings[0]["level"].get<std::string>();
}

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

/// How the finding of the pair is told after an edit of a host function whose port works in another way; "" if nothing
/// is told.
std::string level_after(const std::string& from, const std::string& to, const char* edited = "s/k.cu") {
    const Texts before = {
        {"s/k.cu",
         "void f(float* y, const float* x, int n) {\n  float* p = nullptr;\n"
         "  CUDA_CHECK(cudaSetDevice(kDevice));\n  CUDA_CHECK(cudaFree(nullptr));\n  for (int at = 0; at < n; ++at) { "
         "y[at] = x[at] * 2.0f; }\n"
         "  gather(p, strides, pitches, Kind::Own, Order::Last);\n  cudaMemset(p, 0, sizeof(float) * 64);\n"
         "  if (cudaFree(p) != cudaSuccess) { cudaGetLastError(); }\n}\n"},
        {"t/k.cpp", replaced(kPort, "device.open();", "device.open(Usage::Often, pool.kind(), pool.first());")}};
    MemoryDisk disk;
    for (const auto& [path, text] : before) disk.files["/r/" + path] = text;
    disk.files["/r/portmap.toml"] =
        "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
        "[[pair]]\nsource = \"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n";
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    disk.files[std::string("/r/") + edited] = replaced(before.at(edited), from, to);
    const auto report = check(disk);
    return report["findings"].empty() ? std::string() : report["findings"][0]["level"].get<std::string>();
}

TEST(QuietGate, WhatTouchesNothingInCommonIsAWarningAndUpkeepOfARuntimeANote) {
    const std::string set = "CUDA_CHECK(cudaSetDevice(kDevice));", data = "  cudaMemset(p, 0, sizeof(float) * 64);\n";
    const auto with = [&](const std::string& statement) { return level_after(set, set + "\n  " + statement); };
    EXPECT_EQ(with("cudaEvent_t begun; CUDA_CHECK(cudaEventCreate(&begun));"), "note");
    EXPECT_EQ(with("CUDA_CHECK(cudaMalloc((void**)&q, sizeof(float) * 128));"), "note");
    EXPECT_EQ(with("if (cudaPeekAtLastError() != cudaSuccess) { cudaDeviceReset(); }"), "note");
    EXPECT_EQ(with("cudaFuncSetAttribute(kernel, cudaFuncAttributePreferredSharedMemoryCarveout, 50);"), "note");
    EXPECT_EQ(level_after("  if (cudaFree(p) != cudaSuccess) { cudaGetLastError(); }\n", ""), "note");
    // What moves data, waits, launches or returns; functions of the program's own; and what is reckoned.
    EXPECT_EQ(level_after(data, ""), "warning");
    EXPECT_EQ(with("cudaMemcpyAsync(q, p, sizeof(float) * 128, cudaMemcpyDeviceToDevice, stream);"), "warning");
    EXPECT_EQ(with("if (cudaStreamSynchronize(stream) != cudaSuccess) { cudaGetLastError(); }"), "warning");
    EXPECT_EQ(with("if (cudaGetLastError() != cudaSuccess) { cudaDeviceReset(); return; }"), "warning");
    EXPECT_EQ(with("if (is_shared(q)) { cudaMemAdvise(q, 64, cudaMemAdviseSetReadMostly, 0); }"), "warning");
    EXPECT_EQ(with("if (cudaGetLastError() != cudaSuccess) { cudaDeviceReset(); relax(q, weights); }"), "warning");
    EXPECT_EQ(with("scale *= weight; cudaEventCreate(&begun); cudaEventRecord(begun);"), "warning");
    EXPECT_EQ(level_after("  gather(p, strides, pitches, Kind::Own, Order::Last);\n", ""), "warning");
    EXPECT_EQ(level_after("  for (int at = 0; at < n; ++at) { y[at] = x[at] * 2.0f; }\n", ""), "error");
    // A block that stays under another condition, however the runtime is asked.
    EXPECT_EQ(with("if (cudaPeekAtLastError() == cudaErrorNotReady && cudaGetDevice(&d) == cudaSuccess)"), "warning");
    // One word of such a statement.
    EXPECT_EQ(level_after("cudaFree(nullptr)", "cudaFree(p)"), "error");
    EXPECT_EQ(level_after("cudaSetDevice(kDevice)", "cudaSetDeviceFlags(kDevice)"), "error");
}

TEST(QuietGate, ALongEditOfWhatTheOtherHasNothingLikeIsInDoubtAndTellsItsNewUnits) {
    const std::string open = "device.open();";
    const auto after_source = [&](const std::string& to) {
        return loud({{"s/k.cu", kPort}, {"t/k.cpp", kSource}}, {{"s/k.cu", replaced(kPort, open, to)}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"source-changed s/k.cu:f"};
    const std::string shares = "if (pool.is_shared(device)) { pool.advise(device, Usage::Often); ",
                      weighs = "meter.weigh(device, Level::All); meter.flush(sink, Level::None); } ";
    EXPECT_EQ(after_source(shares + weighs + open), told);
    // A new function that only this calls is told with it.
    const std::string trace = "int trace_all(Meter& meter, int depth) { meter.depth = depth; return meter.count(); }\n";
    const std::string traced = replaced(kPort, open, shares + "trace_all(meter, 3); " + weighs + open);
    EXPECT_EQ(loud({{"s/k.cu", kPort}, {"t/k.cpp", kSource}}, {{"s/k.cu", trace + traced}}, {"s/k.cu:f=t/k.cpp:f"}),
              told);
    // As long beside what both have, in names that both have, with a pragma, or of what both have; and a short one.
    EXPECT_EQ(loud({{"s/k.cu", kPort}, {"t/k.cpp", kSource}},
                   {{"s/k.cu", replaced(kPort, "{ y[at]", "{ " + shares + weighs + " y[at]")}}, {"s/k.cu:f=t/k.cpp:f"}),
              told);
    EXPECT_EQ(after_source("if (n > 0 && lim > 0) { y[0] = lim; x = y + n; y[1] = x[0] * lim; n = 0; } " + open), told);
    EXPECT_EQ(after_source("#pragma omp atomic update hint(often) seq_cst\n" + shares + weighs + open), told);
    EXPECT_EQ(after_source(shares + "} " + open), told);
}

TEST(QuietGate, EditsThatThePortsHaveNothingLikeAreToldOnce) {
    const auto named = [](const std::string& text, const char* name) {
        return replaced(text, "void f(", "void " + std::string(name) + "(");
    };
    const std::string open = "device.open();";
    const std::string advised = replaced(kPort, open,
                                         open +
                                             " if (pool.is_shared(device)) { pool.advise(device, Usage::Often, "
                                             "Kind::Wide); pool.pin(device, Span::All); }"),
                      weighed = replaced(named(kPort, "g"), open,
                                         open +
                                             " meter.weigh(gauge, Level::Fine); meter.flush(sink, Order::Last); "
                                             "journal.note(gauge, sink, Tone::Low);"),
                      doubled = replaced(advised, "x[at] * 2.0f", "x[at] * 4.0f");
    const auto after = [&](const Texts& now, const std::string& file) {
        return loud({{"s/k.cu", kPort + named(kPort, "g")},
                     {"s/l.cu", named(kPort, "g")},
                     {"t/k.cpp", kSource + named(kSource, "g")}},
                    now, {"s/k.cu:f=t/k.cpp:f", "s/" + file + ":g=t/k.cpp:g"});
    };
    EXPECT_EQ(after({{"s/k.cu", advised + weighed}}, "k.cu"), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after({{"s/k.cu", advised + named(kPort, "g")}, {"s/l.cu", weighed}}, "l.cu"),
              Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after({{"s/k.cu", doubled + weighed}}, "k.cu"),
              (Loud{"source-changed s/k.cu:f", "source-changed s/k.cu:g"}))
        << "an edit of what both have is told for itself";
}

TEST(QuietGate, ALongIdIsNamedByItsBeginningAndItsEnd) {
    const std::string folder(150, 'd'), text = "void f(float* y, int n) {\n  y[n] = old_rows(y, n) * 2.0f;\n}\n";
    MemoryDisk disk;
    std::string map = "version = 1\n[sides]\nsource = [\"s/**\"]\ntarget = [\"t/**\"]\n";
    for (const char* name : {"f", "g", "h"}) {
        const std::string file = folder + "/" + name + ".cpp",
                          of_name = replaced(text, "f(float", name + std::string("(float"));
        disk.files["/r/s/" + file] = disk.files["/r/t/" + file] = of_name;
        map += "[[pair]]\nsource = \"s/" + file + ":" + name + "\"\ntarget = \"t/" + file + ":" + name + "\"\n";
    }
    disk.files["/r/portmap.toml"] = map;
    ASSERT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    for (const char* name : {"f", "g", "h"}) {
        std::string& edited = disk.files["/r/s/" + folder + "/" + name + ".cpp"];
        edited = replaced(edited, "old_rows(y, n)", "new_rows(y, n, 3) + wide(n, y) * 4.0f");
    }
    const auto report = check(disk);
    const std::string message = report["findings"][0]["message"];
    EXPECT_NE(message.find("s/" + folder.substr(0, 40)), std::string::npos) << message;
    EXPECT_NE(message.find("/g.cpp:g ("), std::string::npos) << message;
    EXPECT_EQ(message.find(folder), std::string::npos) << message;
}

TEST(QuietGate, InTextsThatAreTooLongToLayTheWordsTell) {
    std::string here = "void f(float* y, int n) {\n", there = "void f(Span& y, int n) {\n";
    for (int i = 0; i < 1300; ++i) {
        here += "  make(rows[" + std::to_string(i) + "], n);\n";
        there += "  y[" + std::to_string(i) + "] = n % 7;\n";
    }
    const auto after = [&](const std::string& statement) {
        return loud({{"s/k.cu", here + "}\n"}, {"t/k.cpp", there + "}\n"}}, {{"s/k.cu", here + statement + "}\n"}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"source-changed s/k.cu:f"};
    EXPECT_EQ(after("  create(board, shade_rows, shade_rows_length, shade_rows_data, wide);\n"), told);
    EXPECT_EQ(after("  create(board, shade_rows, shade_rows_length);\n"), told) << "a few names";
    EXPECT_EQ(after("  create(board, shade_rows, shade_rows_length, shade_rows_data, y, n);\n"), told);
    EXPECT_EQ(after("  make(rows[17], n);\n"), told);
}

TEST(QuietGate, APortThatOthersUseIsNoOrphan) {
    const std::string helper = "float lift(float x) { return x * 2.0f + 1.0f; }\n";
    const std::string uses = "float f(float x) { return lift(x) - x; }\n",
                      does = "float f(float x) { return x * 2.0f + 1.0f - x; }\n",
                      alone = "float f(float x) { return x - 1.0f; }\n";
    const std::vector<std::string> pairs = {"s/k.cl:f=t/k.cpp:f", "s/k.cl:lift=t/k.cpp:lift"};
    EXPECT_EQ(loud({{"s/k.cl", helper + uses}, {"t/k.cpp", helper + uses}}, {{"s/k.cl", does}}, pairs),
              Loud{"source-changed s/k.cl:f"})
        << "what uses it tells";
    EXPECT_EQ(loud({{"s/k.cl", helper + alone}, {"t/k.cpp", helper + alone}}, {{"s/k.cl", alone}}, pairs),
              Loud{"orphaned t/k.cpp:lift"});
    EXPECT_EQ(loud({{"s/k.cl", helper + uses}, {"t/k.cpp", helper + uses}}, {{"s/k.cl", "int g;\n"}}, pairs).size(), 1u)
        << "nothing that has a source uses them: both are told, once";
}

TEST(QuietGate, WhatTouchesNothingInCommonIsToldOfThePortToo) {
    const Loud told = {"target-changed s/k.cu:f"};
    const std::string open = "device.open();";
    EXPECT_EQ(after_port(open, "device.open();\n  if (pool.is_shared(device)) { pool.advise(device, Usage::Often); }"),
              told);
    EXPECT_EQ(after_port(open, "device.open();\n  clReleaseEvent(begun); clReleaseEvent(ended);"), Loud{});
    EXPECT_EQ(loud({{"s/k.cu", kPort}, {"t/k.cpp", kSource}},
                   {{"s/k.cu", replaced(kPort, open,
                                        "device.open();\n  if (pool.is_shared(device)) { "
                                        "pool.advise(device, Usage::Often); }")}},
                   {"s/k.cu:f=t/k.cpp:f"}),
              Loud{"source-changed s/k.cu:f"});
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

TEST(QuietGate, TheSameEditOfALauncherIsThePortsToo) {
    const std::string kernel =
        "__global__ void fir(float* y, const float* x, int n) {\n  const int i = blockIdx.x * blockDim.x + "
        "threadIdx.x;\n  if (i < n) { y[i] = 0.25f * x[i] + 0.5f * x[i + 1] + 0.25f * x[i + 2]; }\n}\n";
    const std::string host =
        "void Fir::launch(Pool& pool) {\n  const int n = size() - taps;\n  fir<<<n / 256, 256>>>(pool.out(), "
        "pool.in(), "
        "n);\n}\n";
    const std::string port =
        "void Fir::run(Pool& pool) {\n  const int n = size() - taps;\n  float* y = pool.out();\n  const float* x = "
        "pool.in();\n  for (int i = 0; i < n; ++i) { y[i] = 0.25f * x[i] + 0.5f * x[i + 1] + 0.25f * x[i + 2]; }\n}\n";
    const auto after = [&](const std::string& to_host, const std::string& to_port, const std::string& rest = "") {
        const std::string what = "size() - taps;";
        return loud(
            {{"s/k.cu", kernel + host + rest}, {"t/k.cpp", port}},
            {{"s/k.cu", kernel + replaced(host, what, to_host) + rest}, {"t/k.cpp", replaced(port, what, to_port)}},
            {"s/k.cu:fir=t/k.cpp:Fir::run"});
    };
    const Loud told = {"target-changed s/k.cu:fir"};
    EXPECT_EQ(after("size() - taps;", "size() - taps + 1;"), told);
    EXPECT_EQ(after("size() - taps + 1;", "size() - taps + 1;"), Loud{});
    EXPECT_EQ(after("size() - taps + 1;", "size() - taps - 1;"), told);
    EXPECT_EQ(after("size() - taps + 1;", "size() - taps + 1;\n  check(pool, n);"), told) << "a part of it";
    EXPECT_EQ(after("size() - taps; n += taps;", "size() - taps + 1;"), told) << "another edit";
    EXPECT_EQ(after("size() - taps;", "size() - taps + 1;",
                    "int most(int taps) { const int n = size() - taps + 1; return n; }\n"),
              told)
        << "it was not edited";
    // A function that neither calls the kernel nor is called by it, though it was edited so.
    const std::string stranger =
        "void Other::prepare(Pool& pool) {\n  const int n = size() - taps;\n  tell(pool, n);\n}\n";
    EXPECT_EQ(loud({{"s/k.cu", kernel + stranger}, {"t/k.cpp", port}},
                   {{"s/k.cu", kernel + replaced(stranger, "size() - taps", "size() - taps + 1")},
                    {"t/k.cpp", replaced(port, "size() - taps", "size() - taps + 1")}},
                   {"s/k.cu:fir=t/k.cpp:Fir::run"}),
              told);
    // What the pair says on both sides is the kernel's own, whatever was edited beside it.
    const std::string term = "0.5f * x[i + 1]",
                      more = "void more(float* y, const float* x, int i) {\n  " +
                             kernel.substr(kernel.find("y[i] ="),
                                           kernel.find(";", kernel.find("y[i] =")) + 1 - kernel.find("y[i] =")) +
                             "\n}\n";
    EXPECT_EQ(loud({{"s/k.cu", kernel + more}, {"t/k.cpp", port}},
                   {{"s/k.cu", kernel + replaced(more, term, "0.75f * x[i + 1]")},
                    {"t/k.cpp", replaced(port, term, "0.75f * x[i + 1]")}},
                   {"s/k.cu:fir=t/k.cpp:Fir::run"}),
              told);
    const std::string line = "  y[i] = min(y[i], 1.0f);\n}\n";
    EXPECT_EQ(loud({{"s/k.cu", kernel + more}, {"t/k.cpp", port}},
                   {{"s/k.cu", kernel + replaced(more, "\n}\n", "\n" + line)},
                    {"t/k.cpp", replaced(port, "x[i + 2]; }\n}\n", "x[i + 2];\n" + line + "}\n")}},
                   {"s/k.cu:fir=t/k.cpp:Fir::run"}),
              told);
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
              told);
    EXPECT_EQ(after("job.Finish();", "job.Finish();\n#ifdef TRACE_JOBS\n  job.Trace(Level::All, Sink::Own);\n#endif"),
              told);
    EXPECT_EQ(after("job.Finish();", "job.Finish();\n  clReleaseEvent(begun); clReleaseEvent(ended);"), Loud{});
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

TEST(QuietGate, ArmsThatTheOtherSideHas) {
    const auto text = [](const std::string& more) {
        return "void f(int op, Out& out) { switch (op) { case ADD: out.add(1); break; " + more + " default: break; } }";
    };
    const std::string port =
        "int f(int op) { switch (op) { case ADD: return 1; case MUL: case DIV: { scale(op); break; } } return 0; }";
    const auto after = [&](const std::string& more, const std::string& there) {
        return loud({{"s/k.cu", text("")}, {"t/k.cpp", there}}, {{"s/k.cu", text(more)}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"source-changed s/k.cu:f"};
    EXPECT_EQ(after("case MUL: scale(op); break;", port), Loud{});
    EXPECT_EQ(after("case MUL: case DIV: { scale(op); break; }", port), Loud{});
    EXPECT_EQ(after("case MUL: scale(op); return;", port), told) << "the end of the function";
    EXPECT_EQ(after("case MUL: out.scale(op, 0.5f); break;", port), told);
    EXPECT_EQ(after("case MUL: out.scale(op, 0.5f); break; case MOD: out.rest(op); break;", port), told);
    EXPECT_EQ(after("case MUL: out.scale(op, 0.5f);", port), told) << "it falls through";
    EXPECT_EQ(after("case MUL: if (op > 2) { out.scale(op, 0.5f); break; }", port), told);
    EXPECT_EQ(after("case MUL: out.scale(op, 0.5f); break;", replaced(port, "case MUL: ", "")), told);
    // Something else beside it.
    EXPECT_EQ(loud({{"s/k.cu", text("")}, {"t/k.cpp", port}},
                   {{"s/k.cu", replaced(text("case MUL: out.scale(op, 0.5f); break;"), "add(1)", "add(2)")}},
                   {"s/k.cu:f=t/k.cpp:f"}),
              told);
}

TEST(QuietGate, ConstantsThatWereNeverTheSame) {
    const auto level = [](const std::string& was, const std::string& there, const std::string& is,
                          const std::string& there_now) {
        MemoryDisk disk;
        const auto text = [](const std::string& value) { return "#define MOST " + value + "\n"; };
        disk.files = {{"/r/s/k.cu", text(was)},
                      {"/r/t/k.h", text(there)},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
                       "[[pair]]\nsource = \"s/k.cu:MOST\"\ntarget = \"t/k.h:MOST\"\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/s/k.cu"] = text(is);
        disk.files["/r/t/k.h"] = text(there_now);
        const auto report = check(disk);
        std::string out;
        for (const auto& finding : report["findings"])
            out += finding["rule"].get<std::string>() + " " + finding["level"].get<std::string>() + " ";
        return out;
    };
    EXPECT_EQ(level("8", "8", "9", "8"), "constant-differs error ");
    EXPECT_EQ(level("8", "8", "9", "7"), "constant-differs error ");
    EXPECT_EQ(level("8", "8", "9", "(3 * 3)"), "");
    EXPECT_EQ(level("8", "4", "9", "4"), "constant-differs warning ");
    EXPECT_EQ(level("8", "4", "9", "5"), "constant-differs warning ");
    EXPECT_EQ(level("8", "4", "4", "4"), "source-changed error ");
    EXPECT_EQ(level("8", "4", "6", "6"), "");
    // The same value in names with the platform in them.
    EXPECT_EQ(level("2 * SIZE_CUDA", "2 * SIZE_HIP", "3 * SIZE_CUDA", "3 * SIZE_HIP"), "");
    EXPECT_EQ(level("2 * SIZE_CUDA", "2 * SIZE_HIP", "3 * SIZE_CUDA", "4 * SIZE_HIP"), "constant-differs error ");
    EXPECT_EQ(level("2 * SIZE_CUDA", "2 * SIZE_HIP", "3 * SIZE_CUDA", "2 * SIZE_HIP"), "constant-differs error ");
    EXPECT_EQ(level("2 * SIZE_CUDA", "2 * SIZE_HIP", "3 * SIZE_CUDA - WIDE_HIP", "3 * WIDE_HIP - SIZE_HIP"),
              "constant-differs error ");
}

TEST(QuietGate, WhatManyFunctionsHandOnIsToldOnce) {
    const auto text = [](const std::string& take, const std::string& hand, const std::string& scale) {
        std::string out = "float sum(Args* args" + take + ") { return args->a + args->b * 2.0f; }\n";
        for (const std::string name : {"near", "far", "wide"})
            out += "float " + name + "(Args* args" + take + ") { float s = sum(args" + hand + "); return s * " + scale +
                   " + args->" + name + "; }\n";
        return out + "float all(Args* args) { return near(args, 1); }\n";
    };
    std::vector<std::string> pairs;
    for (const std::string name : {"sum", "near", "far", "wide", "all"})
        pairs.push_back("s/k.cl:" + name + "=t/k.cpp:" + name);
    const auto after = [&](const std::string& now) {
        return loud({{"s/k.cl", text("", "", "0.5f")}, {"t/k.cpp", text("", "", "0.5f")}}, {{"s/k.cl", now}}, pairs);
    };
    EXPECT_EQ(after(text(", __global State* state", ", state", "0.5f")).size(), 1);
    EXPECT_EQ(after(text(", State* state", ", state", "0.25f")).size(), 4) << "three do more";
    EXPECT_EQ(after(replaced(text(", State* state", ", state", "0.5f"), "args->b * 2", "args->b * 3")).size(), 2);
    EXPECT_EQ(after(replaced(text(", State* state", ", state", "0.5f"), "near(args, 1)", "near(args, 2)")).size(), 2);
    EXPECT_EQ(after(replaced(text("", "", "0.5f"), "sum(Args* args)", "sum(Args* args, State* state)")).size(), 1);
}

TEST(QuietGate, AFunctionOfAWholeFamilyThatIsGoneIsToldOnce) {
    const auto after = [](const std::vector<std::string>& gone) {
        Texts before, now;
        std::vector<std::string> pairs;
        for (const std::string kind : {"Glass", "Matte", "Metal", "Cloth"}) {
            const std::string file = "s/" + kind + ".cl", port = "t/" + kind + ".cpp";
            const std::string other = "float " + kind + "_Pdf(float x) { return x * 2.0f; }\n";
            before[file] = "int " + kind + "_GetKind(int i) { return i + 1; }\n" + other;
            before[port] = "int " + kind + "::GetKind(int i) { return i + 1; }\n";
            pairs.push_back(file + ":" + kind + "_GetKind=" + port + ":" + kind + "::GetKind");
            if (std::find(gone.begin(), gone.end(), kind) != gone.end()) now[file] = other;
        }
        return loud(before, now, pairs).size();
    };
    EXPECT_EQ(after({"Glass", "Matte", "Metal", "Cloth"}), 1);
    EXPECT_EQ(after({"Glass", "Matte"}), 2);
}

TEST(QuietGate, MacrosOfOneHeaderAreToldOnce) {
    const auto file = [](const std::string& header, const std::string& name, const std::string& body) {
        return "#include \"" + header + "\"\nfloat " + name + "(float x) { return " + body + "; }\n";
    };
    const std::string head = "#define SCALE 2.0f\n#define SHIFT 0.5f\n#define BASE 1.0f\n";
    Texts before = {{"s/own.h", "#define OTHER 3.0f\n"}, {"s/k.h", head}};
    const std::vector<std::pair<std::string, std::string>> bodies = {
        {"f", "x * SCALE"}, {"g", "x + SHIFT"}, {"h", "x * SCALE + SHIFT"}, {"k", "x - BASE"}};
    std::vector<std::string> pairs;
    for (const auto& [name, body] : bodies) {
        before["s/" + name + ".cu"] = file("k.h", name, body);
        before["t/" + name + ".cpp"] = file("k.h", name, body);
        pairs.push_back("s/" + name + ".cu:" + name + "=t/" + name + ".cpp:" + name);
    }
    before["s/o.cu"] = file("own.h", "o", "x * OTHER");
    before["t/o.cpp"] = file("own.h", "o", "x * OTHER");
    pairs.emplace_back("s/o.cu:o=t/o.cpp:o");
    const Loud after = loud(before, {{"s/k.h", ""}, {"s/own.h", ""}}, pairs);
    EXPECT_EQ(after.size(), 3) << "those of SCALE and SHIFT, BASE, and OTHER";
    EXPECT_EQ(std::count(after.begin(), after.end(), "source-changed s/f.cu:f"), 1);
    EXPECT_EQ(std::count(after.begin(), after.end(), "source-changed s/k.cu:k"), 1) << "another macro";
    EXPECT_EQ(std::count(after.begin(), after.end(), "source-changed s/o.cu:o"), 1) << "another header";
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

TEST(QuietGate, OtherStatementsThatComputeTheSameAreANoteUnlessTheSidesAreTwins) {
    const std::string before =
        "float f(float v, float low, float high) {\n    if (v < low) return low;\n    if (v > high) return high;\n"
        "    return v;\n}\n";
    const std::string chosen =
        "float f(float v, float low, float high) {\n    return v < low ? low : v > high ? high : v;\n}\n";
    const std::string port =
        "float f(float value, Range range) {\n    float out = max(range.low, value);\n"
        "    return min(out, range.high);\n}\n";
    const auto after = [&](const std::string& now, const std::string& there) {
        return loud({{"s/k.cl", before}, {"t/k.cpp", there}}, {{"s/k.cl", now}}, {"s/k.cl:f=t/k.cpp:f"});
    };
    const Loud found = {"source-changed s/k.cl:f"};
    EXPECT_EQ(after(chosen, port), Loud{});
    EXPECT_EQ(after(replaced(before, "if (v < low) return low;\n    if (v > high) return high;\n    return v;",
                             "if (v < low) { return low; } else if (high < v) { return high; } else { return v; }"),
                    port),
              Loud{});
    EXPECT_EQ(after(chosen, before), found) << "twins";
    EXPECT_EQ(after(replaced(chosen, "v > high", "v >= high"), port), found);
    EXPECT_EQ(after(replaced(chosen, "? low", "? high"), port), found);
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

TEST(QuietGate, APortThatIncludesTheOriginalNow) {
    const std::string helper = "float g(float x) { return x * 2.0f + 0.5f; }\n", limit = "#define MOST 8\n",
                      text = "int f(int n, int k) { return n > MOST ? k : n + (int)g(k); }\n";
    const std::vector<std::string> pairs = {"s/k.cu:f=t/k.cpp:f", "s/both.h:g=t/k.cpp:g", "s/both.h:MOST=t/k.cpp:MOST"};
    const auto after = [&](const Texts& now) {
        return loud({{"s/both.h", limit + helper},
                     {"s/k.cu", "#include \"both.h\"\n" + text},
                     {"t/k.cpp", limit + helper + text}},
                    now, pairs);
    };
    EXPECT_EQ(after({{"t/k.cpp", "#include \"both.h\"\n" + text}}), Loud{});
    EXPECT_EQ(after({{"t/k.cpp", "#include \"../s/both.h\"\n" + text}}), Loud{});
    EXPECT_EQ(
        after({{"t/k.cpp", "#include \"both.h\"\n" + text}, {"s/both.h", limit + replaced(helper, "0.5f", "0.7f")}}),
        Loud{})
        << "an edit of the one text that there is";
    // Another file, one of the port's own, and nothing.
    EXPECT_EQ(after({{"t/k.cpp", "#include \"one.h\"\n" + text}}).size(), 2u);
    EXPECT_EQ(after({{"t/k.cpp", "#include \"both.h\"\n" + text}, {"t/both.h", "int none;\n"}}).size(), 2u);
    EXPECT_EQ(after({{"t/k.cpp", text}}).size(), 2u);
}

TEST(QuietGate, AHeaderOfTheSameNameIsNotTheOriginal) {
    const std::string march = "float march(float x, Way w) { return 1.0f - exp(x * w.sigma) * w.step; }\n",
                      way = "struct Way { float sigma; float step; };\n", head = "#include \"march.h\"\n",
                      calls = "int f(float* y, int n) { y[n] = march(y[0], Way{}); return n + 3; }\n",
                      other = "int f(float* y, int n) { y[n] = 0.0f; return n + 3; }\n";
    const auto after = [&](const std::string& list, const Texts& more) {
        Texts now = {{"t/march.cpp", ""}};
        now.insert(more.begin(), more.end());
        return loud({{"s/march.h", way}, {"s/march.cu", head + march}, {"t/march.cpp", march}, {"t/list.cpp", list}},
                    now, {"s/march.cu:march=t/march.cpp:march"});
    };
    EXPECT_EQ(after(head + other, {}).size(), 1u) << "an include that is there for the struct";
    EXPECT_EQ(after(other, {{"t/list.cpp", head + other}}).size(), 1u);
    EXPECT_EQ(after(calls, {{"t/list.cpp", head + calls}}), Loud{}) << "what is called is the original";
}

TEST(QuietGate, ATypeThatGotAnotherNameThroughout) {
    const std::string names = "using rgbaf = tuple4<float>;\nusing rgbad = tuple4<double>;\n",
                      f = "float f(float x) { rgbaf sum = rgbaf(x); return sum.first() * x; }\n",
                      g = "float g(float x, float y) { rgbaf sum = rgbaf(x, y); return sum.last() - y; }\n",
                      h = "float h(float x) { rgbad sum = rgbad(x); return sum.last() + x; }\n";
    const std::string source =
        "float f(float x) { float4 sum = (float4)(x); return first(sum) * x; }\n"
        "float g(float x, float y) { float4 sum = pair(x, y); return last(sum) - y; }\n"
        "float h(float x) { double4 sum = wide(x); return last(sum) + x; }\n";
    const auto after = [&](const std::string& now) {
        return loud({{"s/k.cl", source}, {"t/k.cpp", names + f + g + h}}, {{"t/k.cpp", now}},
                    {"s/k.cl:f=t/k.cpp:f", "s/k.cl:g=t/k.cpp:g", "s/k.cl:h=t/k.cpp:h"})
            .size();
    };
    const auto renamed = [](std::string text, const std::string& to) {
        for (size_t at = text.find("rgbaf"); at != std::string::npos; at = text.find("rgbaf", at))
            text.replace(at, 5, to);
        return text;
    };
    EXPECT_EQ(after(renamed(names + f + g, "RgbaF") + h), 0u);
    EXPECT_EQ(after("// rgbaf no longer\n" + renamed(names + f + g, "RgbaF") + h), 0u);
    // The old name is still there; the new one was, or means nothing; more was edited; one function alone.
    EXPECT_GT(after("using RgbaF = tuple4<half>;\n" + names + renamed(f + g, "RgbaF") + h), 0u);
    EXPECT_GT(after("using rgbad = tuple4<double>;\n" + renamed(f + g, "rgbad") + h), 0u);
    EXPECT_GT(after("using rgbad = tuple4<double>;\n" + renamed(f + g, "RgbaF") + h), 0u);
    EXPECT_GT(after("typedef double RgbaF;\n" + renamed(f + g, "RgbaF") + h), 0u) << "another kind of number, perhaps";
    EXPECT_GT(after(renamed(names + replaced(f, "* x", "/ x") + g, "RgbaF") + h), 0u);
    EXPECT_GT(after(renamed(names + f, "RgbaF") + replaced(renamed(g, "RgbaF"), "- y", "+ y") + h), 0u);
}

TEST(QuietGate, ANameThatBothSidesChangedThroughout) {
    const std::string source =
                          "float f(L p, int i) { return p.cj4[i] * 2.0f; }\n"
                          "float g(L p, int i) { return p.cj4[i] + first(p, i); }\n"
                          "float h(L p, int i) { return last(p, i) - 1.0f; }\n",
                      port =
                          "float f(const L& p, int i) { return p.cj4[i] * 2.0f; }\n"
                          "float g(const L& p, int i) { return at(p, i) + first(p, i); }\n"
                          "float h(const L& p, int i) { const float* row = p.cj4; return last(row, i) - 1.0f; }\n";
    const auto after = [&](const std::string& now_source, const std::string& now_port, const std::string& more = "") {
        return loud({{"s/k.cl", source}, {"t/k.cpp", port + more}},
                    {{"s/k.cl", now_source}, {"t/k.cpp", now_port + more}},
                    {"s/k.cl:f=t/k.cpp:f", "s/k.cl:g=t/k.cpp:g", "s/k.cl:h=t/k.cpp:h"});
    };
    const auto renamed = [](std::string text, const std::string& to) {
        for (size_t at = text.find("cj4"); at != std::string::npos; at = text.find("cj4", at)) text.replace(at, 3, to);
        return text;
    };
    const std::string sources = renamed(source, "packed"), ports = renamed(port, "packed");
    EXPECT_EQ(after(sources, ports), Loud{});
    // One side alone; another name; a name that was there; the old one still is; more was edited.
    EXPECT_EQ(after(sources, port).size(), 2u);
    EXPECT_EQ(after(sources, renamed(port, "rows")).size(), 3u);
    EXPECT_EQ(after(renamed(source, "last"), renamed(port, "last")).size(), 2u);
    EXPECT_EQ(after(sources, ports, "float own(const L& p) { return p.cj4[0]; }\n").size(), 2u);
    EXPECT_EQ(after(replaced(sources, "+ first", "- first"), ports), Loud{"source-changed s/k.cl:g"});
    EXPECT_EQ(after(renamed(source, "double"), renamed(port, "double")).size(), 2u) << "a word of the language";
    // One name became two, each side's in another place.
    EXPECT_EQ(after(replaced(sources, "p.packed", "p.rows"), replaced(ports, "row = p.packed", "row = p.rows")).size(),
              3u);
    const auto calling = [](const std::string& name, const std::string& own) {
        return "float f(L p, int i) { return " + name + "(p, i) * 2.0f; }\nfloat g(L p, int i) { return " + own +
               "(p, i) + first(p, i); }\n";
    };
    EXPECT_EQ(loud({{"s/k.cl", calling("near", "near")}, {"t/k.cpp", calling("near", "at")}},
                   {{"s/k.cl", calling("far", "far")}, {"t/k.cpp", calling("far", "at")}},
                   {"s/k.cl:f=t/k.cpp:f", "s/k.cl:g=t/k.cpp:g"}),
              Loud{"source-changed s/k.cl:g"})
        << "another function";
}

/// Whether the build asks for the macro by default stands in files that no glob names: it is a warning, told once.
TEST(QuietGate, ABranchForABuildThatTheOtherSideNeverHas) {
    const std::string source = "void f(float* y, int n) { float sum = at(y, n); sum += y[0] * 0.5f; y[n] = sum; }\n",
                      old = "sum += y[0] * 0.5f;", fresh = "sum += fetch(y, 0) * 0.5f;";
    const auto after = [&](const std::string& text, const std::string& port = {}, const std::string& head = {}) {
        const std::string there = source + port;
        return level_of({{"s/k.cu", head + source}, {"t/k.cpp", there}},
                        {{"s/k.cu", head + replaced(source, old, text)}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const std::string told = "error", warned = "warning";
    const auto branch = [](const std::string& opening, const std::string& first, const std::string& second) {
        return "\n#" + opening + "\n" + first + "\n#else\n" + second + "\n#endif\n";
    };
    EXPECT_EQ(after(branch("ifdef USE_IMAGES", fresh, old)), warned);
    EXPECT_EQ(after(branch("if USE_IMAGES", fresh, old)), warned);
    EXPECT_EQ(after(branch("if defined(USE_IMAGES)", fresh, old)), warned);
    EXPECT_EQ(after(branch("ifndef USE_IMAGES", old, fresh)), warned);
    EXPECT_EQ(after(branch("ifdef USE_FOG", "sum -= fetch(y, 0) * 0.25f;", old)), warned);
    // What only says more than the text in its place is a feature.
    EXPECT_EQ(after(branch("ifdef USE_FOG", old + " sum = fade(sum, y);", old)), told);
    EXPECT_EQ(after("\n#ifdef USE_FOG\nsum = fade(sum, y);\n#else\n#endif\n" + old), told);
    const auto in_two = [&](const std::string& macro) {
        const std::string other = replaced(source, "void f", "void g"), fog = branch("if USE_FOG", fresh, old),
                          more = branch("if " + macro, "sum -= fade(fetch(y, 0)) / n;", old);
        return loud({{"s/k.cu", source}, {"s/l.cu", other}, {"t/k.cpp", source + other}},
                    {{"s/k.cu", replaced(source, old, fog)}, {"s/l.cu", replaced(other, old, more)}},
                    {"s/k.cu:f=t/k.cpp:f", "s/l.cu:g=t/k.cpp:g"});
    };
    EXPECT_EQ(in_two("USE_FOG"), Loud{"source-changed s/k.cu:f"}) << "told once";
    EXPECT_EQ(in_two("USE_MIST").size(), 2u);
    const auto once_more = [&](const std::string& text) {
        const std::string before =
            replaced(source, "y[n] = sum;", branch("if USE_IMAGES", "keep(sum);", "y[n] = sum;"));
        return level_of({{"s/k.cu", before}, {"t/k.cpp", source}}, {{"s/k.cu", replaced(before, old, text)}},
                        {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(once_more(branch("if USE_IMAGES", fresh, old)), warned) << "a macro that it asked for before";
    EXPECT_EQ(once_more(branch("if USE_IMAGES", old, fresh)), told);
    EXPECT_EQ(level_of({{"s/k.cu", "#define FAST 1\n" + replaced(source, old, branch("if FAST", fresh, old))},
                        {"t/k.cpp", source}},
                       {{"s/k.cu", "#define FAST 1\n" +
                                       replaced(replaced(source, old, branch("if USE_IMAGES", fresh, old)),
                                                "y[n] = sum;", branch("if USE_IMAGES", "keep(sum);", "y[n] = sum;"))}},
                       {"s/k.cu:f=t/k.cpp:f"}),
              told)
        << "a branch that was built is gone";
    EXPECT_EQ(after(old + "\n#ifdef USE_IMAGES\n" + fresh + "\n#endif\n"), told) << "more, and not something else";
    EXPECT_EQ(after(branch("ifndef USE_IMAGES", fresh, old)), told) << "what everybody builds is the new text";
    EXPECT_EQ(after(branch("ifdef USE_IMAGES", old, fresh)), told);
    EXPECT_EQ(after("\n#ifndef NEVER\n" + fresh + "\n#endif\n" + old), told);
    EXPECT_EQ(after(branch("ifdef __CUDA_ARCH__", fresh, old)), told) << "a compiler's own";
    EXPECT_EQ(after(branch("if 1", fresh, old)), told);
    EXPECT_EQ(after(branch("if n", fresh, old)), told) << "a word of the text";
    EXPECT_EQ(after(branch("ifdef USE_IMAGES", fresh, old + " sum *= 2.0f;")), told);
    EXPECT_EQ(after(branch("ifdef USE_IMAGES", fresh, old), "", "#define USE_IMAGES\n"), told) << "it is on";
    EXPECT_EQ(after(branch("ifdef USE_IMAGES", fresh, old), "#ifdef USE_IMAGES\nint more;\n#endif\n"), told)
        << "the port may be built with it";
}

TEST(QuietGate, WhatTheFileDeclaresForABuildThatTheOtherSideNeverHas) {
    const std::string image = "layout(binding = 0) uniform highp sampler3D work;",
                      buffer = "layout(binding = 0) readonly buffer data { float work[]; };",
                      texel = "sum += texelFetch(work, ivec3(0, 0, 1), 0).r;", element = "sum += work[1];",
                      body = "void main() {\n  float sum = start;\n  " + element + "\n  top[0] = sum * 0.5f;\n}\n",
                      port = "void run(float* top, const float* work) { top[0] = (start + work[1]) * 0.5f; }\n";
    const auto branch = [](const std::string& opening, const std::string& first, const std::string& second) {
        return "\n#" + opening + "\n" + first + "\n#else\n" + second + "\n#endif\n";
    };
    const auto after = [&](const std::string& declared, const std::string& code) {
        return level_of({{"s/k.comp", buffer + "\n" + body}, {"t/k.cpp", port}},
                        {{"s/k.comp", declared + "\n" + replaced(body, element, code)}}, {"s/k.comp:main=t/k.cpp:run"});
    };
    const std::string told = "error";
    EXPECT_EQ(after(branch("if USE_IMAGES", image, buffer), branch("if USE_IMAGES", texel, element)), "warning");
    EXPECT_EQ(after(image + "\n" + buffer, branch("if USE_IMAGES", texel, element)), told) << "for every build";
    EXPECT_EQ(after(branch("if USE_OTHERS", image, buffer), branch("if USE_IMAGES", texel, element)), told);
    EXPECT_EQ(after(branch("if USE_IMAGES", buffer, image), branch("if USE_IMAGES", texel, element)), told)
        << "the old text has the new declaration";
}

TEST(QuietGate, EditsThatHaveLittleToDoWithTheirOtherSideAreToldOnce) {
    const auto kernel = [](const std::string& name) {
        return "void " + name +
               "(span y, span x, span w, float lim, int n) {\n"
               "  const int rows = x.rows();\n  const int step = rows / 4;\n  float sum = 0.0f;\n"
               "  for (int at = 0; at < n; ++at) {\n    float v = x.load(at) * 0.5f;\n    v = v + lim * step;\n"
               "    if (v > lim) { v = lim; }\n    y.store(at, v);\n    sum += v * w.load(at);\n  }\n"
               "  y.flush(rows);\n}\n";
    };
    const auto stranger = [](const std::string& name) {
        return "int " + name +
               "(Context* ctx, const Request& request) {\n"
               "  auto pool = ctx->workers().borrow();\n  Plan plan = planner_for(request.shape());\n"
               "  plan.set_priority(request.priority(), ctx->quota());\n  plan.set_owner(request.owner());\n"
               "  while (plan.has_more()) {\n    Task task = plan.take();\n    task.bind(pool.any_free(), lim);\n"
               "    pool.enqueue(task, request.priority());\n    ctx->journal().note(task.id(), pool.depth());\n  }\n"
               "  Report report = pool.wait_all(request.timeout());\n  report.sign(ctx->keys(), v, at, rows);\n"
               "  ctx->outbox().post(report, request.reply_to());\n  return report.status();\n}\n";
    };
    const std::string from = "v = v + lim * step;",
                      to = "v = v + lim * step; book.open(at, rows); book.enter(v, lim); book.close(at);",
                      other = "v = v + lim * step; if (rows > at) { tally.push(v, lim, at); tally.keep(rows, n); }";
    const std::string source = kernel("f") + kernel("g") + kernel("h"),
                      port = stranger("f") + stranger("g") + stranger("h");
    const std::vector<std::string> pairs = {"s/k.cpp:f=t/k.cpp:f", "s/k.cpp:g=t/k.cpp:g", "s/k.cpp:h=t/k.cpp:h"};
    const auto after = [&](const std::string& h) {
        return loud({{"s/k.cpp", source}, {"t/k.cpp", port}},
                    {{"s/k.cpp", replaced(kernel("f"), from, to) + replaced(kernel("g"), from, other) + h}}, pairs);
    };
    EXPECT_EQ(after(kernel("h")), Loud{"source-changed s/k.cpp:f"});
    // A slip is never told with another edit.
    EXPECT_EQ(after(replaced(kernel("h"), "* 0.5f", "* 0.25f")),
              (Loud{"source-changed s/k.cpp:f", "source-changed s/k.cpp:h"}));
}

TEST(QuietGate, NamesThatGaveWayInSeveralUnitsAreToldOnce) {
    const auto file = [](const std::string& size, const std::string& half) {
        return "float f(float* p, int i) { return p[i * " + size + " + " + size +
               "] * 2.0f; }\nfloat g(float* p, int i) { return p[" + size + " + i / " + size + "] + " + half +
               "; }\nfloat h(float* p, int i) { return p[" + size + " - i % " + size + "] - 1.0f; }\n";
    };
    const auto after = [&](const std::string& now, const std::string& more = "") {
        return loud({{"s/k.cu", file("cl_size", "lim") + more}, {"t/k.cpp", file("cl_size", "lim")}},
                    {{"s/k.cu", now + more}}, {"s/k.cu:f=t/k.cpp:f", "s/k.cu:g=t/k.cpp:g", "s/k.cu:h=t/k.cpp:h"});
    };
    const std::string now = file("cluster_size", "lim");
    EXPECT_EQ(after(now), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after(now, "float own(float* p) { return p[cl_size]; }\n").size(), 3u)
        << "the old one still stands there";
    EXPECT_EQ(after(replaced(now, "cluster_size - i", "other_size - i")).size(), 3u) << "it gave way to two";
    EXPECT_EQ(after(replaced(now, "+ lim", "- lim")).size(), 3u) << "two units that do nothing else are too few";
    EXPECT_EQ(after(replaced(now, "* 2.0f", "* 3.0f")).size(), 3u);
    // One word of each may be a slip that was made three times.
    const auto once = [](const std::string& size) {
        return "float f(float* p, int i) { return p[i * " + size + "]; }\nfloat g(float* p, int i) { return p[i / " +
               size + "]; }\nfloat h(float* p, int i) { return p[i % " + size + "]; }\n";
    };
    EXPECT_EQ(loud({{"s/k.cu", once("cl_size")}, {"t/k.cpp", once("cl_size")}}, {{"s/k.cu", once("cluster_size")}},
                   {"s/k.cu:f=t/k.cpp:f", "s/k.cu:g=t/k.cpp:g", "s/k.cu:h=t/k.cpp:h"})
                  .size(),
              3u);
}

TEST(QuietGate, WhatBringsTheSameNewNamesIsToldOnce) {
    const auto file = [](const std::string& take, const std::string& hand, const std::string& use) {
        return "void make(Block* b, int n" + take + ") { store(b, n * 2" + hand + "); }\nvoid all(Block* b, int n" +
               take + ") { make(b, n + 1" + hand + "); }\nfloat eval(Block* b, float* x) { float s = mix(x[0] * 0.5f" +
               use + "); return s + b->size; }\n";
    };
    const std::string before = file("", "", "");
    const auto after = [&](const std::string& now, const std::string& more = "") {
        return loud({{"s/k.cu", before + more}, {"t/k.cpp", before}}, {{"s/k.cu", now + more}},
                    {"s/k.cu:make=t/k.cpp:make", "s/k.cu:all=t/k.cpp:all", "s/k.cu:eval=t/k.cpp:eval"});
    };
    const std::string now = file(", bool fuse", ", fuse", ", rows_of(b->fuse)");
    EXPECT_EQ(after(now), Loud{"source-changed s/k.cu:make"});
    // More than the new names is told for itself.
    const Loud and_eval = {"source-changed s/k.cu:make", "source-changed s/k.cu:eval"};
    EXPECT_EQ(after(replaced(now, "* 0.5f", "* 0.25f")), and_eval);
    EXPECT_EQ(after(replaced(now, "return s", "if (b->fuse) return 0.0f; return s")), and_eval);
    EXPECT_EQ(after(replaced(now, "return s", "while (b->fuse) --b->fuse; return s")), and_eval);
    EXPECT_EQ(after(replaced(now, "return s", "s = b->fuse; return s")), and_eval);
    EXPECT_EQ(after(replaced(now, "return s", "clear(b->fuse); return s")), and_eval);
    EXPECT_EQ(after(replaced(now, "n + 1, fuse", "n + 1 - 1, fuse")).size(), 2u);
    EXPECT_EQ(after(now, "bool own() { return fuse && rows_of; }\n").size(), 3u) << "names that it had";
}

TEST(QuietGate, TheSameNewNamesOnBothSides) {
    const std::string
        source = "void f(int m) { if (m == FEW) few(m, LIM); if (m == MANY) many(m); }\n",
        port =
            "void f(int m) { if (m == FEW) few(m); if (m == MANY) many(m, lo); if (m > MANY) more(fmax(m, "
            "lo)); }\n";
    const auto named = [](std::string text, const std::string& from, const std::string& to) {
        for (size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
            text.replace(at, from.size(), to);
        return text;
    };
    const auto after = [&](const std::string& here, const std::string& there) {
        return loud({{"s/k.cu", source}, {"t/k.cpp", port}}, {{"s/k.cu", here}, {"t/k.cpp", there}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    const std::string here = named(named(source, "FEW", "lib::Few"), "MANY", "lib::Many"),
                      there = named(named(port, "FEW", "lib::Few"), "MANY", "lib::Many");
    const Loud told = {"port-differs s/k.cu:f"};
    EXPECT_EQ(after(here, there), Loud{});
    EXPECT_EQ(after(here, named(there, "lib::Many", "lib::Most")), told) << "another name on each side";
    EXPECT_EQ(after(here, named(there, "lib::Many", "lib::Few")), told) << "two became one";
    EXPECT_EQ(after(here, named(there, "fmax", "fmin")), told) << "what the source calls otherwise, or not at all";
    EXPECT_EQ(after(here, named(there, "lo)", "LIM)")), told);
    EXPECT_EQ(after(replaced(here, "many(m)", "many(m + 1)"), there), told);
}

TEST(QuietGate, ParametersThatNothingReads) {
    const std::string text =
                          "float f(const Hit* hit, float a, float b) { float s = a * 2.0f + b; if (s > 1.0f) s = a; "
                          "return s * b; }\n",
                      port =
                          "float Texture::Value(Span rows) const { const Pair pair = rows.first(); return "
                          "std::min(pair.a, this->Scaled(pair)) * pair.b; }\n";
    const auto after = [&](const std::string& now, const std::string& before) {
        return loud({{"s/k.cu", before}, {"t/k.cpp", port}}, {{"s/k.cu", now}}, {"s/k.cu:f=t/k.cpp:Texture::Value"});
    };
    const auto head = [&](const std::string& parameters) {
        return replaced(text, "const Hit* hit, float a, float b", parameters);
    };
    const Loud told = {"source-changed s/k.cu:f"};
    EXPECT_EQ(after(head("float a, float b"), text), Loud{});
    EXPECT_EQ(after(text, head("float a, float b")), Loud{});
    EXPECT_EQ(after(head("const Hit* hit, float a, const Map<int, int>& map, float b"), text), Loud{});
    EXPECT_EQ(after(head("float b, float a"), text), told) << "calls mean another thing";
    EXPECT_EQ(after(head("const Hit* hit, float b, float a"), text), told);
    EXPECT_EQ(after(head("float a, float spare, float b = 1.0f"), head("float a, float b = 1.0f")), told)
        << "calls that leave the last one out hand theirs to the new one";
    EXPECT_EQ(after(replaced(head("float a, float b"), "* 2.0f", "* 3.0f"), text), told);
    const std::string read = replaced(text, "* b;", "* b * hit->t;");
    EXPECT_EQ(after(replaced(read, "const Hit* hit, ", ""), read), told) << "another `hit`, of the file";
    const std::string by_macro = "#define SCALE(x) ((x) * gain)\n" + replaced(text, "a * 2.0f", "SCALE(a)");
    EXPECT_EQ(after(replaced(by_macro, "float b)", "float gain, float b)"), by_macro), told) << "a macro reads it";
    const std::string elsewhere = replaced(text, "a * 2.0f", "SCALE(a)"), spare = "float spare, float b)";
    EXPECT_EQ(after(replaced(elsewhere, "float b)", spare), elsewhere), told) << "a macro of a header elsewhere may";
    for (const std::string known : {"HUGE_GAIN", "FLT_MAX", "INFINITY"}) {
        const std::string other = "enum Gain { LEAST_GAIN, HUGE_GAIN };\n" + replaced(text, "a * 2.0f", "a * " + known);
        EXPECT_EQ(after(replaced(other, "float b)", spare), other), Loud{}) << known;
    }
    const std::string kernel = "__global__ void f(float* y, float a) { y[0] = a; y[1] = a * 2.0f; y[2] = a + 1.0f; }\n";
    EXPECT_EQ(after(replaced(kernel, "float a)", "int n, float a)"), kernel), told)
        << "who launches it hands over what comes behind by its place";
    EXPECT_EQ(
        loud({{"s/k.cu", text}, {"t/k.cpp", text}}, {{"s/k.cu", head("float a, float b")}}, {"s/k.cu:f=t/k.cpp:f"}),
        told)
        << "a twin has its parameters as well";
}

TEST(QuietGate, AsidesWithinBranchesForTheCompiler) {
    const std::string text = "void f(float* y, int n) { y[n] = 2.0f; g(y); }\n";
    const auto after = [&](const std::string& more) {
        return loud({{"s/k.cu", text}, {"t/k.cpp", text}}, {{"s/k.cu", replaced(text, "g(y);", more + "g(y);")}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    const std::string slow = "printf(\"slow\\n\");\n", fast = "printf(\"fast\\n\");\n";
    EXPECT_EQ(after("\n#ifdef SLOW\n" + slow + "#else\n" + fast + "#endif\n"), Loud{});
    EXPECT_EQ(after("\n#ifndef SLOW\n" + fast + "#endif\n"), Loud{});
    EXPECT_EQ(after("\n#ifdef SLOW\n" + slow + "#else\ny[n] = 3.0f;\n#endif\n"), Loud{"source-changed s/k.cu:f"});
}

TEST(QuietGate, ATypedefOfATypeThatIsAskedForDeclaresItsNameAlone) {
    const std::string text = "void f(float* y, int n) { decltype(n) i = n; real r = y[i]; y[n] = r; }\n",
                      head = "typedef decltype(g<float, 2>) kernel_t;\nalignas(8) static float all[4];\n";
    const auto after = [&](const std::string& before, const std::string& now) {
        return loud({{"s/k.cu", before + text}, {"t/k.cpp", text}}, {{"s/k.cu", now + text}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after(head, head + "typedef decltype(h<float, 3>) other_t;\n"), Loud{});
    EXPECT_EQ(after(head, head + "alignas(16) static float spare[4];\n"), Loud{});
    const std::string real = "typedef decltype(g<float, 2>(1)) real;\n";
    EXPECT_EQ(after(real, replaced(real, "float", "half")), Loud{"source-changed s/k.cu:f"});
}

TEST(QuietGate, WaitingMoreOftenForTheOwnDevice) {
    const std::string source =
                          "void f(int* n, const int* p, int k) { cudaMemcpy(n, p, 4, cudaMemcpyDeviceToHost); "
                          "if (*n > k) { *n = k; } }\n",
                      port =
                          "void f(queue& q, int* n, const int* p, int k) { q.memcpy(n, p, 4); "
                          "if (*n > k) { *n = k; } }\n",
                      copy = "q.memcpy(n, p, 4)";
    const auto after = [&](const std::string& before, const std::string& now) {
        return loud({{"s/k.cu", source}, {"t/k.cpp", before}}, {{"t/k.cpp", now}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"target-changed s/k.cu:f"};
    const std::string waits = replaced(port, copy, copy + ".wait()"),
                      waits_then = replaced(port, copy, copy + "; q.wait()");
    EXPECT_EQ(after(port, waits), Loud{});
    EXPECT_EQ(after(port, waits_then), Loud{});
    EXPECT_EQ(after(waits, port), told) << "no longer";
    EXPECT_EQ(after(waits_then, port), told);
    EXPECT_EQ(after(port, replaced(waits, "*n > k", "*n >= k")), told) << "and more";
    EXPECT_EQ(loud({{"s/k.cu", source}, {"t/k.cpp", waits}},
                   {{"s/k.cu", replaced(source, "if (*n", "cudaDeviceSynchronize(); if (*n")}}, {"s/k.cu:f=t/k.cpp:f"}),
              Loud{"source-changed s/k.cu:f"})
        << "what the original lacked the port may lack";
}

TEST(QuietGate, EnumeratorsInBranchesForTheCompiler) {
    const std::string before = "enum Part {\n  Red = 1,\n  All = 7\n};\n",
                      now = "enum Part {\n  Red = 1,\n#ifdef WIDE\n  All = 7,\n#else\n  All = 7\n#endif\n};\n",
                      text = "int f(int n, int k) { if (n > k) { k = n; } else { k = Red; } return k; }\n";
    EXPECT_EQ(loud({{"s/k.cu", text}, {"t/k.cpp", before + text}}, {{"t/k.cpp", now + text}}, {"s/k.cu:f=t/k.cpp:f"}),
              Loud{})
        << "`else` is none";
}

TEST(QuietGate, ALocalInATextWithBranchesForTheCompiler) {
    const std::string
        text = "int f(int n) {\n#ifdef WIDE\n  n *= 2;\n#endif\n  const int step = 4;\n  return n * step;\n}\n",
        head = "struct Manner {\n  static constexpr int step = ";
    const auto after = [&](const std::string& used) {
        return loud({{"s/k.cu", head + "2;\n};\n" + used}, {"t/k.cpp", text}}, {{"s/k.cu", head + "3;\n};\n" + used}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after(text), Loud{});
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

/// A scope is left out of the word that a port uses, or comes before it; around it stands the rest of its file.
TEST(QuietGate, ScopesOfOtherThings) {
    const auto after = [&](const std::string& around, const std::string& from, const std::string& to) {
        const std::string text = around + "void f(float* y) { y[0] = " + from + "(y[1]) * 3.0f; }";
        return loud({{"s/k.cu", "__global__ void f(float* y) { y[0] = wave(y[1]) * 3.0f; }"}, {"t/k.cpp", text}},
                    {{"t/k.cpp", replaced(text, from + "(y[1]) * 3", to + "(y[1]) * 3")}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud none, raised = {"target-changed s/k.cu:f"};
    const std::string coarse = "namespace coarse { float lobe(float x) { return x * x; } }\n",
                      own = "float lobe(float x) { return x * (3.0f - x); }\n";
    const auto both_ways = [&](const std::string& around, const std::string& with, const std::string& without,
                               const Loud& expected) {
        EXPECT_EQ(after(around, with, without), expected) << around << with;
        EXPECT_EQ(after(around, without, with), expected) << around << without << " -> " << with;
    };
    for (const std::string with : {"std::sqrt", "sycl::pow", "metal::sin", "cl::sycl::exp"})
        both_ways("", with, with.substr(with.rfind(':') + 1), none);
    for (const std::string with : {"native::sin", "half_precision::sqrt", "precise::divide", "metal::fast::exp",
                                   "sycl::native::exp", "sycl::half_precision::exp"}) {
        both_ways("", with, with.substr(with.rfind(':') + 1), raised);
        both_ways("using namespace metal; using namespace native;\n", with, with.substr(with.rfind(':') + 1), raised);
    }
    both_ways("", "sycl::native::sin", "native::sin", none);
    both_ways(coarse + own, "coarse::lobe", "lobe", raised);
    both_ways(coarse, "coarse::lobe", "lobe", raised);
    both_ways(coarse + "using namespace coarse;\n", "coarse::lobe", "lobe", none);
    both_ways(coarse + "using coarse :: lobe;\n", "coarse::lobe", "lobe", none);
    both_ways(coarse + own + "using namespace coarse;\n", "coarse::lobe", "lobe", raised);
    both_ways(own, "std::lobe", "lobe", raised);
    EXPECT_EQ(after(own, "std::lobe(std::lobe", "std::lobe(lobe"), raised) << "one of two";
}

TEST(QuietGate, NamesOfARuntimeInAnotherVersion) {
    const auto after = [](const std::string& before, const std::string& now) {
        const auto file = [](const std::string& body) { return "void f(float* y, int n) { " + body + " y[1] = n; }"; };
        return loud({{"s/k.cu", file("cublasDotEx(h, n, y);")}, {"t/k.cpp", file(before)}}, {{"t/k.cpp", file(now)}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"target-changed s/k.cu:f"};
    EXPECT_EQ(after("hipblasDotEx_v2(h, n, y);", "hipblasDotEx_64(h, n, y);"), Loud{});
    EXPECT_EQ(after("hipblasDatatype_t a = kind(n); use(a);", "hipDataType a = kind(n); use(a);"), Loud{});
    EXPECT_EQ(after("hipblasDotEx_v2(h, n, y);", "hipblasDotcEx_v2(h, n, y);"), told);
    EXPECT_EQ(after("hipblasDotEx_v2(h, n, y);", "hipblasDotEx_64(h, n, y + 1);"), told);
    EXPECT_EQ(after("hipblasSgemm(h, n, y);", "hipblasDgemm(h, n, y);"), told);
    EXPECT_EQ(after("hipMemcpy(h, y, n);", "hipMemset(h, y, n);"), told);
    EXPECT_EQ(after("own_v2(h, n, y);", "own_64(h, n, y);"), told) << "of nobody knows what";
}

TEST(QuietGate, ABaseThatIsNotOfTheProject) {
    const std::string fields = " { int step; int operator()(int i) const { return step * i; } };\n",
                      of_lib = "struct S : public lib::unary<int, int>" + fields, plain = "struct S" + fields,
                      own = "struct Base { int more; };\n";
    const auto after = [&](const std::string& before, const std::string& now) {
        return loud({{"s/k.h", before}, {"t/k.h", before}}, {{"s/k.h", now}}, {"s/k.h:S=t/k.h:S"});
    };
    EXPECT_EQ(after(of_lib, plain), Loud{});
    EXPECT_EQ(after(plain, of_lib), Loud{});
    EXPECT_EQ(after(own + plain, own + "struct S : Base" + fields), Loud{"source-changed s/k.h:S"}) << "its fields";
    EXPECT_EQ(after(of_lib, replaced(plain, "int step", "long step")), Loud{"layout-differs s/k.h:S"});
    EXPECT_EQ(after(of_lib, replaced(of_lib, "unary", "binary")), Loud{"source-changed s/k.h:S"});
}

TEST(QuietGate, AKernelOfAFolderWithFewPorts) {
    const auto kernel = [](const std::string& name) {
        return "__global__ void " + name + "(float* y) { y[threadIdx.x] = " + name + "_of(y[threadIdx.x]); }\n";
    };
    /// `ported` of the folder's kernels have a port; the new one stands in `file`.
    const auto after = [&](int kernels, int ported, const std::string& file = "s/new.cu") {
        Texts texts;
        std::vector<std::string> pairs;
        for (int i = 0; i < kernels; ++i) {
            const std::string name = "k" + std::to_string(i);
            texts[i < ported ? "s/k.cu" : "s/alone.cu"] += kernel(name);
            if (i >= ported) continue;
            texts["t/k.cpp"] += kernel(name);
            pairs.push_back("s/k.cu:" + name + "=t/k.cpp:" + name);
        }
        return loud(texts, {{file, texts[file] + kernel("fresh")}}, pairs);
    };
    const Loud told = {"unported s/new.cu:fresh"};
    EXPECT_EQ(after(33, 1), Loud{});
    EXPECT_EQ(after(40, 9), Loud{});
    EXPECT_EQ(after(40, 9, "s/alone.cu"), Loud{});
    EXPECT_EQ(after(40, 9, "s/k.cu"), Loud{"unported s/k.cu:fresh"}) << "those beside it have ports";
    EXPECT_EQ(after(40, 10), told) << "a quarter of them has one";
    EXPECT_EQ(after(17, 1), told) << "so few tell nothing";
    EXPECT_EQ(after(6, 1, "s/alone.cu"), Loud{}) << "none of its file has one";
    EXPECT_EQ(after(4, 1, "s/alone.cu"), Loud{"unported s/alone.cu:fresh"}) << "three tell nothing";

    Texts texts;
    std::vector<std::string> pairs;
    for (int i = 0; i < 40; ++i) {
        const std::string name = (i < 4 ? "op_" : "bench_") + std::to_string(i);
        texts[i < 4 ? "s/k.cu" : "s/alone.cu"] += kernel(name);
        if (i >= 4) continue;
        texts["t/k.cpp"] += kernel(name);
        pairs.push_back("s/k.cu:" + name + "=t/k.cpp:" + name);
    }
    EXPECT_EQ(loud(texts, {{"s/new.cu", kernel("bench_fresh")}}, pairs), Loud{});
    EXPECT_EQ(loud(texts, {{"s/new.cu", kernel("op_fresh")}}, pairs), Loud{"unported s/new.cu:op_fresh"});
}

TEST(QuietGate, HowThePortDrivesARuntimeOfItsOwn) {
    const std::string
        source =
            "void f(float* y, int n, int rows) {\n  float* d = nullptr;\n  cudaMalloc(&d, n * rows);\n"
            "  scale<<<n / 64, 64>>>(d, n);\n  y[n] = rows * 0.5f;\n}\n",
        port =
            "void f(float* y, int n, int rows) {\n  err = clEnqueueWriteBuffer(q, d, 1, 0, n * rows, y, 0, "
            "0, 0);\n  err = clEnqueueNDRangeKernel(q, k_scale, 1, 0, all, some, 0, 0, 0);\n"
            "  y[n] = rows * 0.5f;\n}\n";
    const auto after = [&](const std::string& now) {
        return loud({{"s/k.cu", source}, {"t/k.cpp", port}}, {{"t/k.cpp", now}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const std::string events =
        replaced(replaced(replaced(port, "y, 0, 0, 0);", "y, 0, 0, &write_event);"), "some, 0, 0, 0);",
                          "some, 0, 0, &kernel_event);\n  h2d_time += probe(write_event, q);\n"
                          "  kernel_time += probe(kernel_event, q);"),
                 "  err = clEnqueueWrite", "  cl_event write_event, kernel_event;\n  err = clEnqueueWrite");
    const Loud told = {"target-changed s/k.cu:f"};
    EXPECT_EQ(after(events), Loud{});
    EXPECT_EQ(after(replaced(events, "rows * 0.5f", "rows * 0.7f")), told) << "a number of both";
    EXPECT_EQ(after(replaced(events, "n * rows, y", "n * wide, y")), told) << "a name of both";
    EXPECT_EQ(after(replaced(events, "y[n] = rows", "y[0] = rows")), told);
    EXPECT_EQ(after(replaced(port, "some, 0, 0, 0)", "some, 0, 0, 1)")), told) << "one word";
}

TEST(QuietGate, ANewUnitInAFileThatThePortIncludes) {
    const std::string text = "int f(int n, int k) { return n > 8 ? k : n + 3; }\n",
                      fresh = "float reference(const float* y, int n) { return y[n] * weights[n] - offset(y); }\n";
    const auto after = [&](const std::string& head, const Texts& more) {
        Texts now = {{"s/ref.h", fresh}, {"t/k.cpp", head + text}};
        now.insert(more.begin(), more.end());
        return loud({{"s/k.cu", text}, {"t/k.cpp", text}}, now, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after("#include \"ref.h\"\n", {}), Loud{});
    EXPECT_EQ(after("", {}), Loud{"unported s/ref.h:reference"});
    EXPECT_EQ(after("#include \"ref.h\"\n", {{"t/ref.h", "int none;\n"}}), Loud{"unported s/ref.h:reference"});
    EXPECT_EQ(after("#include \"own.h\"\n", {}), Loud{"unported s/ref.h:reference"});
}

TEST(QuietGate, ASweepThroughManyUnitsIsToldOnce) {
    constexpr int kUnits = 6;
    const auto file = [](bool now, int slip, const std::string& how) {
        std::string out;
        for (int i = 0; i < kUnits; ++i) {
            const std::string own = "own" + std::to_string(i), n = std::to_string(i);
            const std::string term = i == slip ? how : own + "(x) * 0.5f";
            out += now ? "void f" + n + "(const Film* film, Stack* stack, Row* row) {\n  float x = pop(stack);\n" +
                             "  put(stack, film, " + term + ");\n  row->" + own + " = x;\n}\n"
                       : "float f" + n + "(float x, Row* row) {\n  row->" + own + " = x;\n  return " + own +
                             "(x) * 0.5f;\n}\n";
        }
        return out;
    };
    std::vector<std::string> pairs;
    for (int i = 0; i < kUnits; ++i) pairs.push_back("s/k.cu:f" + std::to_string(i) + "=t/k.cpp:f" + std::to_string(i));
    const std::string was = file(false, -1, "");
    const auto count = [&](int slip, const std::string& how) {
        return loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"s/k.cu", file(true, slip, how)}}, pairs).size();
    };
    EXPECT_EQ(count(-1, ""), 1u);
    EXPECT_EQ(count(2, "own2(x) * 0.7f"), 2u) << "another number";
    EXPECT_EQ(count(2, "own2(x) / 0.5f"), 2u) << "another operation";
    EXPECT_EQ(count(2, "fast(own2(x), bright) * gain(dark)"), 2u) << "words of its own";
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

TEST(QuietGate, AMethodThatAClassDeclaresIsNotUsedThere) {
    const std::string own = "struct S { int device; Queue queue; void* room; };",
                      other = "struct S { int rows; Stream stream; float* data; };",
                      wide = replaced(other, "float* data;", "float* data; bool stale; void refit(int n);"),
                      refit = "void S::refit(int n) { rows = n * 7; stale = n > 3; }\n";
    const auto after = [&](const std::string& step) {
        return loud({{"s/k.cu", other + kSource}, {"t/k.cpp", own + kSource}}, {{"s/k.cu", wide + refit + step}},
                    {"s/k.cu:S=t/k.cpp:S", "s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after(replaced(kSource, "int at", "mesh->refit(n); int at")), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after(kSource), Loud{"unported s/k.cu:S::refit"}) << "nothing that is told uses it";
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
    const std::string four = body("fourth", "4.5f");
    EXPECT_EQ(loud({{"s/k.cu", old}, {"t/k.cpp", old + two + four}},
                   {{"s/k.cu", old + body("second", "2.5f")}, {"s/b.cu", body("third", "3.5f")}, {"s/c.cu", four}},
                   {"s/k.cu:first=t/k.cpp:first"}),
              Loud{"unpaired s/b.cu:third"});
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

TEST(QuietGate, NamesThatAreThrownAway) {
    const std::string text = "void f(float* y, int n, int k) { y[n] = 2.0f; }";
    const auto after = [&](const std::string& statement) {
        return loud({{"s/k.cu", text}, {"t/k.cpp", text}}, {{"s/k.cu", replaced(text, "y[n]", statement + " y[n]")}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    for (const char* statement : {"UNUSED(k);", "Q_UNUSED(k);", "MY_UNUSED(n, k);"})
        EXPECT_EQ(after(statement), Loud{}) << statement;
    for (const char* statement : {"UNUSED(n++);", "USED(k);", "UNUSEDISH(k);", "mark_unused(k);", "UNUSED(take(k));"})
        EXPECT_EQ(after(statement), Loud{"source-changed s/k.cu:f"}) << statement;
    const std::string was = replaced(text, "y[n]", "UNUSED(n); UNUSED(k); y[n]");
    const auto now = [&](const std::string& from, const std::string& to) {
        return loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"s/k.cu", replaced(was, from, to)}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(now("UNUSED(n); UNUSED(k);", "MY_UNUSED(k, n);"), Loud{});
    EXPECT_EQ(now("UNUSED(k)", "UNUSED(n)"), Loud{"source-changed s/k.cu:f"}) << "a slip";
}

TEST(QuietGate, WordsOfWhatIsPrinted) {
    const std::string text = "void f(float* y, int n) { y[n] = 2.0f; printf(\"%d of them\\n\", n); tell(\"%d\", n); }";
    const auto after = [&](const std::string& from, const std::string& to) {
        return loud({{"s/k.cu", text}, {"t/k.cpp", text}}, {{"s/k.cu", replaced(text, from, to)}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after("\"%d of them\\n\"", "\"%ld of all\\n\""), Loud{});
    EXPECT_EQ(after("them\\n\", n", "them\\n\", 2"), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after("tell(\"%d\"", "tell(\"%u\""), Loud{"source-changed s/k.cu:f"});
    // Both sides at once, each in its own words.
    const std::string there = replaced(text, "%d of them", "%d of these");
    const auto both = [&](const std::string& now) {
        return loud({{"s/k.cu", text}, {"t/k.cpp", text}}, {{"s/k.cu", now}, {"t/k.cpp", there}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(both(replaced(text, "%d of them", "%d of those")), Loud{});
    EXPECT_EQ(both(replaced(text, "2.0f", "3.0f")), Loud{"port-differs s/k.cu:f"});
}

TEST(QuietGate, APartThatGetsAName) {
    const std::string text =
        "void f(float* y, const float* x, int n) {\n  for (int i = 0; i < n; ++i) {\n"
        "    y[3 * i + 0] = cos(x[0]) * x[i] - sin(x[0]);\n    y[3 * i + 1] = 2.0f * (n + 7) * x[i];\n  }\n}\n";
    const std::string kernel =
        "__global__ void f(float* y, int n) { int at = blockIdx.x * blockDim.x + threadIdx.x; y[at] = n * threadIdx.x; "
        "}";
    const auto port_of = [](const std::string& there) {
        return replaced(there, "{", "{\n  Rows rows(pool, n);\n  for (Row& row : rows.each(Order::Any)) {") + "}\n";
    };
    const auto after = [&](const std::string& before, const std::string& now) {
        return loud({{"s/k.cu", before}, {"t/k.cpp", port_of(before)}}, {{"s/k.cu", now}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"source-changed s/k.cu:f"};
    const auto named = [&](const std::string& part, const std::string& declared, const std::string& name) {
        const std::string with = replaced(text, part, name);
        return replaced(with, "  for", "  " + declared + "\n  for");
    };
    EXPECT_EQ(after(text, named("(n + 7)", "const float most = n + 7;", "most")), Loud{});
    EXPECT_EQ(after(named("(n + 7)", "const float most = n + 7;", "most"), text), Loud{}) << "and written out";
    EXPECT_EQ(after(kernel,
                    "__global__ void f(float* y, int n) { int lid = threadIdx.x; "
                    "int at = blockIdx.x * blockDim.x + lid; y[at] = n * lid; }"),
              Loud{});
    const std::string with_name = named("(n + 7)", "const float most = n + 7;", "most");
    EXPECT_EQ(loud({{"s/k.cu", text}, {"t/k.cpp", text}}, {{"s/k.cu", with_name}}, {"s/k.cu:f=t/k.cpp:f"}), told)
        << "twins are held to every word";
    // Another part; one that changes; one that is changed; one that something else may change; what calls anything.
    EXPECT_EQ(after(text, named("(n + 7)", "const float most = n + 8;", "most")), told);
    EXPECT_EQ(after(text, named("x[0]", "const float first = x[0];", "first")), told);
    EXPECT_EQ(after(text, replaced(text, "y[3 * i + 1]", "int at = i; y[3 * at + 1]")), Loud{}) << "that of this turn";
    EXPECT_EQ(after(text, replaced(text, "y[3 * i + 1]", "int at = i; ++i; y[3 * at + 1]")), told) << "i is stepped";
    EXPECT_EQ(after(text, replaced(replaced(text, "  for", "  int at = 0;\n  for"), "3 * i + 1", "3 * at + 1")), told);
    EXPECT_EQ(after(text, named("(n + 7)", "float most = n + 7; most += 1;", "most")), told);
    EXPECT_EQ(after(text, named("(n + 7)", "float most = n + 7; grow(&most);", "most")), told);
    EXPECT_EQ(after(text, named("(n + 7)", "const float most = n + 7; grow(n);", "most")), told) << "by reference";
    // Nothing else changed, but a call stands between the name and where it is used.
    const auto moved = [&](const std::string& part, const std::string& value, const std::string& call) {
        const std::string with_call = replaced(replaced(text, "(n + 7)", part), "  for", "  " + call + ";\n  for");
        return after(with_call, replaced(replaced(with_call, part, "most"), "  " + call,
                                         "  const float most = " + value + ";\n  " + call));
    };
    EXPECT_EQ(moved("(n + 7)", "n + 7", "advance()"), Loud{});
    EXPECT_EQ(moved("(n + 7)", "n + 7", "advance(n)"), told) << "by reference";
    EXPECT_EQ(moved("state->count", "state->count", "advance()"), told);
    EXPECT_EQ(moved("total_count", "total_count", "advance()"), told) << "a variable of the file";
    EXPECT_EQ(moved("n.size", "n.size", "n.grow()"), told);
    EXPECT_EQ(moved("n.size", "n.size", "advance()"), Loud{}) << "a structure of its own";
    const std::string called = replaced(text, "(n + 7)", "next(n)");
    EXPECT_EQ(
        after(called, replaced(replaced(called, "next(n)", "most"), "  for", "  const float most = next(n);\n  for")),
        told);
}

TEST(QuietGate, WhatARuntimeCalledOtherwiseInAnEarlierVersion) {
    const auto after = [](const std::string& before, const std::string& now, const std::string& there = "x += y[2];") {
        const auto file = [](const std::string& body) {
            return "void f(float* y, G group, unsigned mask) { float x = y[0]; " + body + " y[1] = x; }";
        };
        return loud({{"s/k.cu", file(there)}, {"t/k.cpp", file(before)}}, {{"t/k.cpp", file(now)}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"target-changed s/k.cu:f"};
    const std::string down = "x += group.shuffle_down(x, 1);", left = "x += sycl::shift_group_left(group, x, 1);";
    EXPECT_EQ(after(down, left), Loud{});
    EXPECT_EQ(after(left, down), Loud{});
    EXPECT_EQ(after("x = __shfl_xor(x, 4);", "x = __shfl_xor_sync(mask & 0xff, x, 4);"), Loud{});
    EXPECT_EQ(after(down, replaced(left, "x, 1", "x, 2")), told);
    EXPECT_EQ(after(down, replaced(left, "left", "right")), told);
    EXPECT_EQ(after(down, replaced(left, "(group", "(other")), told);
    EXPECT_EQ(after("x = __shfl_xor_sync(mask, x, 4);", "x = __shfl_xor_sync(0xff, x, 4);"), told);
    EXPECT_EQ(after("x = LIB_MAX(x, 1.0f);", "x = max(x, 1.0f);", "x = max(x, 1.0f);"), Loud{});
    EXPECT_EQ(after("x = ARG_MAX(x, 1.0f);", "x = max(x, 1.0f);"), told) << "who knows what that is";
    EXPECT_EQ(after("x = max(x, 1.0f);", "x = ARG_MAX(x, 1.0f);", "x = max(x, 1.0f);"), told);
    EXPECT_EQ(after("x = ARG_MAX(x, 1.0f);", "x = max(x, 1.0f);", "x = ARG_MAX(x, 1.0f);"), told);
    EXPECT_EQ(after("x = std::abs(x);", "x = abs(x);"), told) << "of whole numbers";
    EXPECT_EQ(after("x = LIB_MAX(x, 1.0f);", "x = min(x, 1.0f);"), told);
    EXPECT_EQ(after("x = row_max(x, 1.0f);", "x = max(x, 1.0f);"), told);
}

TEST(QuietGate, ALocalThatAMacroReads) {
    const auto after = [](const std::string& macro, const std::string& from, const std::string& to) {
        const std::string file =
            macro + "\nvoid f(float* p, int n) {\n  int lane = n & 31;\n  p[SLOT] = 2.0f * n;\n}\n";
        return loud({{"s/k.cu", file}, {"t/k.cpp", "void f(float* p, int n) { p[n] = 2.0f * n; }"}},
                    {{"s/k.cu", replaced(file, from, to)}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after("#define SLOT (lane * 4)", "n & 31", "n & 15"), Loud{"source-changed s/k.cu:f"});
    EXPECT_EQ(after("#define SLOT 4", "n & 31", "n & 15"), Loud{});
}

TEST(QuietGate, ANamespaceThatIsOpenedInACommentIsNot) {
    const auto after = [](const std::string& line) {
        const std::string file = line + "\nfloat f(float c) {\n  float d = c * 2.0f;\n  return far::grow(d);\n}\n";
        return loud({{"s/k.cu", file}, {"t/k.cpp", "float f(float c) { return other(c); }"}},
                    {{"s/k.cu", replaced(file, "return far::grow", "return grow")}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"source-changed s/k.cu:f"};
    EXPECT_EQ(after("using namespace far;"), Loud{});
    EXPECT_EQ(after("using far::grow;"), Loud{});
    EXPECT_EQ(after("// using namespace far;"), told);
    EXPECT_EQ(after("/* using far::grow; */"), told);
    EXPECT_EQ(after("const char* s = \"using namespace far;\";"), told);
    EXPECT_EQ(after("void g() { using namespace far; }"), told);
}

TEST(QuietGate, BranchesForTheCompilerAreToldOnce) {
    const auto file = [](const std::string& f, const std::string& g) {
        return "int f(int a) {\n" + f + "return a;\n}\nint g(int a) {\n" + g + "return a;\n}\n";
    };
    const std::string was = file("a += 2;\n", "a *= 3;\n");
    const auto after = [&](const std::string& now) {
        return loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"t/k.cpp", now}},
                    {"s/k.cu:f=t/k.cpp:f", "s/k.cu:g=t/k.cpp:g"})
            .size();
    };
    EXPECT_EQ(after(file("#ifdef WITH_F\na += 2;\n#endif\n", "#ifdef WITH_G\na *= 3;\n#endif\n")), 1u);
    EXPECT_EQ(after(file("#ifdef WITH_F\na += 2;\n#endif\n", "#ifdef WITH_G\na *= 4;\n#endif\n")), 2u);
    EXPECT_EQ(after(file("#if WITH_F > 2\na += 2;\n#endif\n", "#if WITH_F > 3\na *= 3;\n#endif\n")), 2u);
}

TEST(QuietGate, FunctionsThatTakeAnotherTypeAreToldOnce) {
    const auto after = [](const std::string& from, const std::string& to, int functions) {
        std::string was, is;
        Loud pairs;
        for (int i = 0; i < functions; ++i) {
            const std::string name = "f" + std::to_string(i), number = std::to_string(i);
            const std::string head =
                "void " + name + "(Array<float> out, const Array<float>& in, float k" + number + ")";
            const std::string body = " { out[" + number + "] = in[" + number + "] * k" + number + "; }\n";
            was += head + body;
            is += replaced(head, from, to) + body;
            pairs.push_back("s/k.cu:" + name + "=t/k.cpp:" + name);
        }
        return loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"s/k.cu", is}}, pairs).size();
    };
    const std::string types = "Array<float> out, const Array<float>& in";
    EXPECT_EQ(after(types, "Param<float> out, View<float> in", 5), 1u);
    EXPECT_EQ(after(types, "Param<float> out, View<float> in", 4), 4u);
    EXPECT_EQ(after(types, "Param<float> out, const Array<float>& in", 5), 5u) << "one of two";
    EXPECT_EQ(after("float k", "double k", 5), 5u) << "a type of the language";
    EXPECT_EQ(after(types, "Param<float> out, View<double> in", 5), 5u);
}

TEST(QuietGate, TheMethodsOfANewClassAreToldWithIt) {
    const std::string paired = "float f(float x) { return x * 2.0f + 1.0f; }\n";
    const std::string fresh =
        "struct Pool {\n  int size;\n  int take(int n) { return size -= n; }\n"
        "  void give(int n) { size += n; }\n};\nint spare(int k) { return k % 9; }\n";
    EXPECT_EQ(loud({{"s/k.cu", paired}, {"t/k.cpp", paired}}, {{"s/k.cu", paired + fresh}}, {"s/k.cu:f=t/k.cpp:f"}),
              (Loud{"unported s/k.cu:Pool", "unported s/k.cu:spare"}));
}

TEST(QuietGate, WhatManyUnitsDoAlikeIsToldOnce) {
    constexpr int kUnits = 5;
    struct Change {
        std::string load = "load_bytes", first, last, term = "3";
    };
    const auto file = [](const std::vector<Change>& changes) {
        std::string out;
        for (int i = 0; i < kUnits; ++i) {
            const Change& change = changes[static_cast<size_t>(i)];
            const std::string name = "f" + std::to_string(i), own = "x" + std::to_string(i);
            out += "int " + name + "(const int* q, int " + own + ") {\n" + change.first + "  int s = " + change.load +
                   "(q, " + own + " + " + std::to_string(i) + ");\n  s += " + own + " * " + change.term + ";\n" +
                   change.last + "  return s;\n}\n";
        }
        return out;
    };
    std::vector<std::string> pairs;
    for (int i = 0; i < kUnits; ++i) pairs.push_back("s/k.cu:f" + std::to_string(i) + "=t/k.cpp:f" + std::to_string(i));
    const std::string was = file(std::vector<Change>(kUnits));
    const auto count = [&](const std::vector<Change>& changes) {
        return loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"s/k.cu", file(changes)}}, pairs).size();
    };
    const Change same, words{"load_words"}, guarded{"load_bytes", "#if ARCH >= 61\n", "#else\n  stop(q);\n#endif\n"};
    const Change both{"load_words", guarded.first, guarded.last};
    EXPECT_EQ(count({words, words, words, words, words}), 1u) << "a function that is another now";
    EXPECT_EQ(count({words, words, words, words, same}), 4u) << "so few may be slips";
    EXPECT_EQ(count({words, words, words, words, {"load_quads"}}), 5u);
    EXPECT_EQ(count({words, words, words, words, {"load_words", "", "", "4"}}), 2u) << "another edit beside it";
    EXPECT_EQ(count({both, words, words, {"load_words", "", "", "3 + sqrt(s) * 7"}, words}), 3u);
    EXPECT_EQ(count({guarded, guarded, guarded, same, same}), 1u) << "whole lines";
    EXPECT_EQ(count({both, both, both, words, words}), 1u) << "the first tells both";
    EXPECT_EQ(count({{"load_bytes", "", "", "4"},
                     {"load_bytes", "", "", "4"},
                     {"load_bytes", "", "", "4"},
                     {"load_bytes", "", "", "4"},
                     {"load_bytes", "", "", "4"}}),
              5u)
        << "a number in the place of another";
    for (const char* slip : {"3.5f", "x9.y", "q[1]"})
        EXPECT_EQ(count(std::vector<Change>(kUnits, {"load_bytes", "", "", slip})), 5u) << slip;
    EXPECT_EQ(count(std::vector<Change>(kUnits, {"load_bytes", "", "", "3 && q[0] || q[1]"})), 1u);
}

TEST(QuietGate, WhatASweepDoesToManyUnitsIsToldOnce) {
    constexpr int kUnits = 9;
    const auto file = [](const std::string& type, const std::string& view, int slip, const std::string& term) {
        std::string out;
        for (int i = 0; i < kUnits; ++i) {
            const std::string name = "f" + std::to_string(i), own = "x" + std::to_string(i);
            out += "int " + name + "(View " + view + own + ", int n) {\n  const " + type + " at = n / " +
                   std::to_string(i + 2) + ";\n  return " + own + "[at] * " + (i == slip ? term : "3") + ";\n}\n";
        }
        return out;
    };
    std::vector<std::string> pairs;
    for (int i = 0; i < kUnits; ++i) pairs.push_back("s/k.cu:f" + std::to_string(i) + "=t/k.cpp:f" + std::to_string(i));
    const std::string was = file("size_t", "", -1, "");
    const auto count = [&](const std::string& now) {
        return loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"t/k.cpp", now}}, pairs).size();
    };
    EXPECT_EQ(count(file("int", "& ", -1, "")), 1u);
    EXPECT_EQ(count(file("int", "& ", 4, "4")), 2u) << "with a slip in one of them";
    EXPECT_EQ(count(file("int", "& ", 4, "n")), 2u);
    EXPECT_EQ(count(file("size_t", "& ", -1, "")), 1u) << "references alone";
    EXPECT_EQ(count(file("int", "", -1, "")), 9u) << "one word may be a slip, however often";
}

TEST(QuietGate, CallsThatGoToOneFunctionNowAreToldOnce) {
    const std::vector<std::string> was = {"load_u8", "load_u8", "load_i8", "load_i8_aligned", "load_raw"};
    const auto file = [&](const std::vector<std::string>& loads, const std::string& peek) {
        std::string out;
        for (size_t i = 0; i < loads.size(); ++i)
            out += "int f" + std::to_string(i) + "(const int* q, int k) {\n  return " + loads[i] + "(q, k + " +
                   std::to_string(i) + ") * " + peek + "(q, " + std::to_string(i + 2) + ");\n}\n";
        return out;
    };
    std::vector<std::string> pairs;
    for (size_t i = 0; i < was.size(); ++i)
        pairs.push_back("s/k.cu:f" + std::to_string(i) + "=t/k.cpp:f" + std::to_string(i));
    const auto count = [&](const std::vector<std::string>& loads, const std::string& peek) {
        const std::string then = file(was, "peek");
        return loud({{"s/k.cu", then}, {"t/k.cpp", then}}, {{"s/k.cu", file(loads, peek)}}, pairs).size();
    };
    const std::vector<std::string> now(5, "load_b2");
    EXPECT_EQ(count(now, "peek_b4"), 1u);
    EXPECT_EQ(count({"load_b2", "load_b2", "load_b2", "load_b2", "load_b4"}, "peek_b4"), 5u) << "so few may be slips";
    EXPECT_EQ(count(now, "peek"), 5u) << "one word of each";
}

TEST(QuietGate, TheSameEditOfSiblingsIsToldOnce) {
    const auto function = [](const std::string& part, const std::string& constant, bool now) {
        const std::string buffer = part + "_buffer", flag = part + "_flag";
        return "void post_" + part + "(float* " + buffer + ", int* " + flag + ", int n) {\n" +
               (now ? "  exchange(" + constant + ", " + buffer + ", " + flag + ", n, Mode::Staged, 4);\n"
                    : "  const int to = ranks[k_" + part + "] - 1;\n  send(" + buffer + ", n, to);\n  receive(" + flag +
                          ", 1, to);\n") +
               "  wait_for(" + flag + ");\n}\n";
    };
    const auto file = [&](const std::string& of_top, const std::string& of_left, bool now) {
        return function("top", of_top, now) + function("left", of_left, now);
    };
    const std::string was = file("", "", false);
    const auto count = [&](const std::string& of_top, const std::string& of_left) {
        return loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"s/k.cu", file(of_top, of_left, true)}},
                    {"s/k.cu:post_top=t/k.cpp:post_top", "s/k.cu:post_left=t/k.cpp:post_left"})
            .size();
    };
    EXPECT_EQ(count("kTop", "kLeft"), 1u);
    EXPECT_EQ(count("kTop", "kRight"), 2u) << "another name than the unit's";
    EXPECT_EQ(count("kTop", "kTop"), 1u) << "the same word in both is no name of theirs";
    EXPECT_EQ(count("kTop", "left_flag"), 2u);
}

TEST(QuietGate, NamesThatNothingReads) {
    const auto level = [](const std::string& from, const std::string& to, const char* edited = "s/k.cu") {
        const std::string source =
            "void f(float* y, const float* x, const Rows& rows, int n) {\n  float gain, drop, spare;\n"
            "  const int all = rows.size();\n  gain = x[0] * 0.5f;\n  drop = gain * 2.0f;\n  spare = drop;\n"
            "  y[n] = gain + drop;\n}\n";
        const std::string port =
            "void f(Span y, Span x, const Table& rows, int n) {\n  float gain, drop;\n  gain = x.load(0) * 0.5f;\n"
            "  drop = gain * 2.0f;\n  Job job(rows); job.each(n);\n  y.store(n, gain + drop);\n}\n";
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cu", source},
                      {"/r/t/k.cpp", port},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
                       "[[pair]]\nsource = \"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        std::string& text = disk.files[std::string("/r/") + edited];
        text = replaced(text, from, to);
        const auto report = check(disk);
        return report["findings"].empty() ? std::string() : report["findings"][0]["level"].get<std::string>();
    };
    EXPECT_EQ(level("  const int all = rows.size();\n", ""), "note");
    EXPECT_EQ(level("  spare = drop;\n", ""), "note");
    EXPECT_EQ(level("const int all = rows.size();", "const int all = 2 * n;"), "note");
    EXPECT_EQ(level("float gain, drop, spare;", "float gain, drop, spare, more;"), "note");
    EXPECT_EQ(level("  spare = drop;\n", "  spare = drop;\n  const lib::Table* const all_of = rows.all;\n"), "note");
    EXPECT_EQ(level("  spare = drop;\n", "  spare = drop;\n  const lib::Table* const drops = rows.drops;\n"), "note")
        << "a member of its name is another thing";
    EXPECT_EQ(level("  spare = drop;\n", "  spare = drop;\n  Table* all_of = rows.take();\n"), "error");
    EXPECT_EQ(level("  spare = drop;\n", "  spare = drop;\n  Guard guard = rows.all;\n"), "error")
        << "which may do something when it goes";
    EXPECT_EQ(level("  spare = drop;\n", "  Table* all_of = rows.all;\n  all_of->spare = drop;\n"), "error");
    EXPECT_EQ(level("  spare = drop;\n", "  drop = spare;\n"), "error") << "what nobody read is read";
    EXPECT_EQ(level("  drop = gain * 2.0f;\n", "  spare = gain * 2.0f;\n"), "error");
    EXPECT_EQ(level("gain + drop", "spare + drop"), "error");
    EXPECT_EQ(level("  const int all = rows.size();\n", "  const int all = rows.take();\n"), "error")
        << "what may do more than to tell";
    EXPECT_EQ(level("  spare = drop;\n", "  spare = drop = 0.0f;\n"), "error");
    EXPECT_EQ(level("  spare = drop;\n", "  x.spare = drop;\n"), "error") << "a field";
    // First values.
    EXPECT_EQ(level("float gain, drop;", "float gain = 0, drop{};", "t/k.cpp"), "note");
    EXPECT_EQ(level("float gain, drop;", "float gain = 0.0f, drop = 0x0;", "t/k.cpp"), "note");
    EXPECT_EQ(level("float gain, drop;", "float gain = 0, drop = 7;", "t/k.cpp"), "warning")
        << "a value that says something";
    EXPECT_EQ(level("float gain, drop, spare;", "float gain = 0, drop{}, spare;"), "error")
        << "both may have lacked it";
    EXPECT_EQ(level("  drop = gain * 2.0f;\n", "", "t/k.cpp"), "warning") << "the other way round";
}

TEST(QuietGate, AMacroWithinATextIsToldWithTheEditOfBothSides) {
    const auto text = [](const std::string& with, const std::string& hand) {
        return "void f(int n, int m) {\n  n += " + with + ";\n#define EVAL(k) eval(k, " + hand +
               ")\n  EVAL(n);\n  EVAL(m);\n}\n";
    };
    const std::string was = text("1", "n, m");
    EXPECT_EQ(loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"s/k.cu", text("2", "m, m")}, {"t/k.cpp", text("2", "m")}},
                   {"s/k.cu:f=t/k.cpp:f"}),
              Loud{"port-differs s/k.cu:f"});
    EXPECT_EQ(loud({{"s/k.cu", was}, {"t/k.cpp", was}}, {{"s/k.cu", text("1", "m, m")}}, {"s/k.cu:f=t/k.cpp:f"}).size(),
              1u);
}

TEST(QuietGate, AMacroIsToldWithTheEditOfAText) {
    const auto text = [](const std::string& name, const std::string& value) {
        return "int " + name + "(int n) {\n#ifdef WIDE\n  n *= 2;\n#endif\n  return n + " + value + ";\n}\n";
    };
    const std::string before = text("f", "1") + text("g", "1");
    const auto after = [&](const std::string& now) {
        return loud({{"s/k.cu", before}, {"t/k.cpp", before}}, {{"s/k.cu", "#define WIDE\n" + now}},
                    {"s/k.cu:f=t/k.cpp:f", "s/k.cu:g=t/k.cpp:g"});
    };
    const Loud f = {"source-changed s/k.cu:f"}, both = {"source-changed s/k.cu:f", "source-changed s/k.cu:g"};
    EXPECT_EQ(after(before), f) << "one macro, told once";
    EXPECT_EQ(after(text("f", "2") + text("g", "3")), both);
    EXPECT_EQ(after(text("f", "2") + text("g", "1")), both) << "what was not edited tells of the macro";
}

const std::string kWeighKernel =
    "__global__ void f(const float* x, float* y, P p, int n) {\n"
    "  int i = blockIdx.x * blockDim.x + threadIdx.x;\n  if (i >= n) return;\n"
    "  float v = x[i] * p.gain;\n  float w = v * v + p.bias;\n  if (w > p.limit) w = p.limit;\n"
    "  y[i] = w / (v + 1.0f);\n}\n";
const std::string kWeighLoop =
    "void f(const std::vector<float>& x, std::vector<float>& y, const P& p) {\n"
    "  for (int i = 0; i < int(x.size()); ++i) {\n"
    "    float v = x[i] * p.gain;\n    float w = v * v + p.bias;\n    if (w > p.limit) w = p.limit;\n"
    "    y[i] = w / (v + 1.0f);\n  }\n}\n";

TEST(QuietGate, AnotherFunctionOfMathematicsIsNoEditInOwnWords) {
    const auto after_both = [](const std::string& here, const std::string& there) {
        const auto with = [](const std::string& text, const std::string& call) {
            const std::string more = "float k = " + call + ";\n w += k * p.slope - 0.5f;\n y[i]";
            return replaced(text, "y[i]", more);
        };
        return loud({{"s/k.cu", kWeighKernel}, {"t/k.cpp", kWeighLoop}},
                    {{"s/k.cu", with(kWeighKernel, here)}, {"t/k.cpp", with(kWeighLoop, there)}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"port-differs s/k.cu:f"};
    EXPECT_EQ(after_both("floorf(v * p.knee)", "std::floor(v * p.knee)"), Loud{});
    EXPECT_EQ(after_both("sinf(v * p.knee)", "std::sin(v * p.knee)"), Loud{});
    EXPECT_EQ(after_both("floorf(v * p.knee)", "std::ceil(v * p.knee)"), told);
    for (const char* other : {"cbrt", "sqrt", "log10", "erf", "acosh", "tgamma", "sinpi", "isfinite"}) {
        const auto called = [](const std::string& name) { return name + "(v * p.knee)"; };
        EXPECT_EQ(after_both("coshf(v * p.knee)", called(std::string("std::") + other)), told) << other;
        EXPECT_EQ(after_both(called(std::string(other) + "f"), called(std::string("std::") + other)), Loud{}) << other;
    }
    EXPECT_EQ(after_both("sinf(v * p.knee)", "std::cos(v * p.knee)"), told);
    EXPECT_EQ(after_both("fmaxf(v, p.knee)", "std::min(v, p.knee)"), told);
    EXPECT_EQ(after_both("powf(v, p.knee)", "std::fmod(v, p.knee)"), told);
    EXPECT_EQ(after_both("fabsf(v * p.knee)", "std::sqrt(v * p.knee)"), told);
    EXPECT_EQ(after_both("floorf(v * p.knee)", "std::round(v * p.knee)"), told) << "which is floor of half more";
    // Another member of what both call the same, new to both; and another spelling of one.
    EXPECT_EQ(after_both("floorf(v * p.knee)", "std::floor(v * p.crest)"), told);
    EXPECT_EQ(after_both("floorf(v * p.kneeLevel)", "std::floor(v * p.knee_level)"), Loud{});
}

TEST(QuietGate, WhatOnlyOneOfBothTakesIsTold) {
    const auto after = [](const std::string& kept) {
        const std::string last = "y[i] = w / (v + 1.0f);", limit = "if (w > p.limit) w = p.limit;";
        const auto now = [&](const std::string& text, const std::string& root, const std::string& before) {
            const std::string more =
                "if (i > p.least) { float q = " + root + "(w, v * p.slope); w /= q - p.floor; v *= q; }\n";
            return replaced(replaced(text, last, more + last), limit, before);
        };
        return loud({{"s/k.cu", kWeighKernel}, {"t/k.cpp", kWeighLoop}},
                    {{"s/k.cu", now(kWeighKernel, "fmaxf", limit)}, {"t/k.cpp", now(kWeighLoop, "std::max", kept)}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after("if (w > p.limit) w = p.limit;"), Loud{});
    EXPECT_EQ(after(""), Loud{"port-differs s/k.cu:f"});
}

TEST(QuietGate, AMemberThatBothHadIsNoWordOfOneSidesOwn) {
    const auto after_both = [](const std::string& member) {
        const std::string last = "y[i] = w / (v + 1.0f);";
        const auto now = [&](const std::string& text, const std::string& bias, const std::string& root) {
            const std::string more = "float g2 = p.g * p.g;\n float e = (1.0f - g2) / " + root +
                                     "(1.0f + g2 - 2.0f * p.g * v, 1.5f);\n y[i] = w / (v + 1.0f) + e * p.sun;";
            return replaced(replaced(text, "p.bias", bias + " * p.sun"), last, more);
        };
        return loud({{"s/k.cu", kWeighKernel}, {"t/k.cpp", kWeighLoop}},
                    {{"s/k.cu", now(kWeighKernel, "p.bias", "powf")}, {"t/k.cpp", now(kWeighLoop, member, "std::pow")}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after_both("p.bias"), Loud{});
    EXPECT_EQ(after_both("p.offset"), Loud{"port-differs s/k.cu:f"});
}

const std::string kMarch =
    "  float t = x[i];\n  float c = 0.0f;\n  float left = 1.0f;\n  while (t < p.end && left > 0.001f) {\n"
    "    float rho = d[int(t)];\n    if (rho < 0.0f) break;\n    float a = 1.0f - EXP(-rho * p.sigma);\n"
    "    c += p.glow * (left * a * rho);\n    left *= 1.0f - a;\nMORE    t += p.step;\n  }\n  y[i] = c;\n";

/// The level of what is told after a kernel came to stop in those words, as its port has long stopped.
std::string after_catching_up(const std::string& stop, const std::string& there =
                                                           "if (left < p.stop) { c /= std::max(1.0f - left, p.eps); "
                                                           "left = 0.0f; break; }\n") {
    const auto kernel = [](const std::string& more) {
        return "__global__ void f(const float* x, const float* d, float* y, P p, int n) {\n"
               "  int i = blockIdx.x * blockDim.x + threadIdx.x;\n  if (i >= n) return;\n" +
               replaced(replaced(kMarch, "EXP", "expf"), "MORE", more) + "}\n";
    };
    const std::string port =
        "void f(const std::vector<float>& x, const std::vector<float>& d, std::vector<float>& y, const P& p) {\n"
        "  for (int i = 0; i < int(x.size()); ++i) {\n" +
        replaced(replaced(kMarch, "EXP", "std::exp"), "MORE", there) + "  }\n}\n";
    MemoryDisk disk;
    disk.files["/r/s/k.cu"] = kernel("");
    disk.files["/r/t/k.cpp"] = port;
    disk.files["/r/portmap.toml"] =
        "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
        "[[pair]]\nsource = \"s/k.cu:f\"\ntarget = \"t/k.cpp:f\"\n";
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    disk.files["/r/s/k.cu"] = kernel(stop);
    const auto report = check(disk);
    return report["findings"].empty() ? std::string() : report["findings"][0]["level"].get<std::string>();
}

TEST(QuietGate, ASideThatCatchesUpInAnotherFunctionOrJumpDoesNot) {
    const std::string stop = "if (left < p.stop) { c /= fmaxf(1.0f - left, p.eps); left = 0.0f; break; }\n";
    EXPECT_TRUE(after_catching_up(stop).empty() || after_catching_up(stop) == "note");
    EXPECT_EQ(after_catching_up(replaced(stop, "fmaxf", "fminf")), "error");
    EXPECT_EQ(after_catching_up(replaced(stop, "break", "continue")), "error");
    EXPECT_EQ(after_catching_up(replaced(stop, "p.stop", "p.step")), "error");
    EXPECT_EQ(after_catching_up(replaced(stop, "p.stop", "p.least")), "warning") << "a member that is new here";
}

TEST(QuietGate, ASideThatCatchesUpWithAPartIsAWarning) {
    const std::string first = "float g = p.g * p.g;\n", next = "float h = 1.0f + g - 2.0f * p.g * a;\n",
                      last = "c += (1.0f - g) / (h * sqrtf(h)) * p.glow;\n",
                      there = first + next + replaced(last, "sqrtf", "std::sqrt");
    const std::string whole = after_catching_up(first + next + last, there);
    EXPECT_TRUE(whole.empty() || whole == "note") << whole;
    for (const std::string& part : {first + last, next + last})
        EXPECT_EQ(after_catching_up(part, there), "warning") << part;
    EXPECT_NE(after_catching_up("c = p.wrap ? fmodf(c, p.most) : c;\n",
                                "c = p.wrap ? std::fmod(c, p.most) : c;\n    t = p.wrap ? std::fmod(t, p.end) : t;\n"),
              "note")
        << "one of two members";
}

TEST(QuietGate, ALabelThatJoinsAnotherArmThanThere) {
    const auto text = [](const std::string& zero, const std::string& one, const std::string& more) {
        return "float f(float a, float b, int k) { float r = 0.0f; switch (k) { " + zero + " r = a + b; break; " + one +
               " r = a * b; break; " + more + " } return r; }";
    };
    const auto after = [&](const std::string& zero, const std::string& one, const std::string& three) {
        return loud({{"s/k.cu", text("case 0:", "case 1:", "")},
                     {"t/k.cpp", text("case 0:", "case 1:", "case 3: " + three + " break;")}},
                    {{"s/k.cu", text(zero, one, "")}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const Loud told = {"source-changed s/k.cu:f"};
    EXPECT_EQ(after("case 3: case 0:", "case 1:", "r = a + b - a * b;"), told);
    EXPECT_EQ(after("case 0: case 3:", "case 1:", "r = a + b - a * b;"), told);
    EXPECT_EQ(after("case 0:", "case 1: case 3:", "r = a + b - a * b;"), told);
    EXPECT_EQ(after("case 0:", "case 1: case 3:", "r = a * b;"), Loud{}) << "the same in an arm of its own";
}

TEST(QuietGate, WhatSoundsLikeAnAsideAndReckons) {
    const std::string plain =
        "__global__ void f(float* out, float* s, int n, float k) {\n  float best = -1.0f;\n"
        "  for (int j = 0; j < n; ++j) { s[j] = s[j] * k; best = fmaxf(best, s[j]); }\n"
        "  HERE\n  log_softmax_row(s, n, best, 1.0f);\n  if (threadIdx.x == 0) out[n - 1] = best;\n}\n";
    const auto after_edit = [&](const std::string& now) {
        const std::string before = replaced(plain, "HERE", "");
        return loud({{"s/k.cu", before}, {"t/k.cpp", before}}, {{"s/k.cu", now}}, {"s/k.cu:f=t/k.cpp:f"});
    };
    const auto with = [&](const std::string& more) { return after_edit(replaced(plain, "HERE", more)); };
    const Loud told = {"source-changed s/k.cu:f"};
    const std::string call = "log_softmax_row(s, n, best, 1.0f);";
    EXPECT_EQ(after_edit(replaced(replaced(plain, "HERE", ""), call, "")), told);
    EXPECT_EQ(after_edit(replaced(replaced(plain, "HERE", ""), call, "log_softmax_row(s, best, n - 1, k * 0.5f);")),
              told);
    EXPECT_EQ(with("log_sum_add(s, n, best, 1e-6f);"), told);
    EXPECT_EQ(with("debug_clampScores(s, n, -80.0f, 80.0f);"), told);
    EXPECT_EQ(with("warn_if_zero_then_nudge(s, n, 1e-6f, 2);"), told);
    EXPECT_EQ(with("apply_density_profile(); apply_density_profile();"), told);
    EXPECT_EQ(with("assert_finite_or_zero(s, n, k * 4, best);"), told);
    EXPECT_EQ(with("log(best) << 3 << n << k;"), told);
    EXPECT_EQ(with("\n#ifdef USE_TIMER_FAST_PATH\n  rescale(s, n, best, 0.5f);\n#endif\n"), told);
    EXPECT_EQ(with("\n#ifdef VERBOSE\n  __syncthreads();\n#endif\n"), told);
    EXPECT_EQ(with("\n#ifdef VERBOSE\n  print_row(s, n, best, 0.5f); show(n, best);\n#endif\n"), Loud{});
    EXPECT_EQ(with("assert_all_of(n, k * 4, best);"), Loud{});
    EXPECT_EQ(with("K_ASSERT(s, n > 3, best);"), Loud{});
    EXPECT_EQ(with("LIB_CASSERT(n > 3 && best < k, \"too few\");"), Loud{});
    EXPECT_EQ(with("reassert(s, n, best, 1.0f);"), told);
    EXPECT_EQ(with("LOG(INFO) << \"best of \" << n << best;"), Loud{});
    EXPECT_EQ(with("log_best(best, n, k, 4);"), Loud{});
    EXPECT_EQ(with("debug_print_row(\"row\", s, n, best);"), Loud{});
    EXPECT_EQ(with("warn_once(\"%d of %f\", n, best);"), Loud{});
    EXPECT_EQ(with("print_row(s, n, best, 3);"), Loud{});
}

TEST(QuietGate, AReadThatMovesBeforeItsGuardIsNotTheSame) {
    const std::string head =
                          "__global__ void f(const float* d, float* y, int n, float lim) {\n  int i = threadIdx.x;\n",
                      guard = "  if (i < 0 || i >= n) return;\n", read = "  float rho = d[i + 1];\n",
                      scale = "  float k = lim * 2.0f;\n", rest = "  y[i] = 1.0f - expf(-rho * k);\n}\n";
    const std::string port =
        "void f(const Grid& d, Grid& y, float lim) {\n  for (int i = 0; i < d.size(); ++i) {\n"
        "    y.put(i, 1.0f - std::exp(-d.at(i + 1) * lim * 2.0f));\n  }\n}\n";
    const auto after_edit = [&](const std::string& now) {
        return loud({{"s/k.cu", head + guard + scale + read + rest}, {"t/k.cpp", port}}, {{"s/k.cu", now}},
                    {"s/k.cu:f=t/k.cpp:f"});
    };
    EXPECT_EQ(after_edit(head + guard + read + scale + rest), Loud{});
    EXPECT_EQ(after_edit(head + scale + guard + read + rest), Loud{});
    EXPECT_EQ(after_edit(head + read + guard + scale + rest), Loud{"source-changed s/k.cu:f"});
}

}  // namespace
}  // namespace porttool::testing::quiet_gate_test
