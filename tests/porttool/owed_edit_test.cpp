// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// How much an edit of one side alone has to do with the other side's text, and what level it has therefore.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/porttool/fixtures.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::owed_edit_test {
namespace {

/// A function that has its port statement by statement, and one that does all in its own way.
const std::string kSource =
    "void f(span y, span x, span w, float lim, int n) {\n"
    "  const int rows = x.rows();\n  const int step = rows / 4;\n  float sum = 0.0f;\n"
    "  for (int at = 0; at < n; ++at) {\n    float v = x.load(at) * 0.5f;\n    v = v + lim * step;\n"
    "    if (v > lim) { v = lim; }\n    y.store(at, v);\n    sum += v * w.load(at);\n  }\n"
    "  for (int at = 0; at < rows; ++at) {\n    const float part = w.load(at) - sum / n;\n"
    "    w.store(at, part * part + lim);\n    if (part < 0.0f) { sum = sum - part * step; }\n  }\n"
    "  y.flush(rows);\n}\n";
const std::string kTwin = kSource;
const std::string kStranger =
    "int f(Context* ctx, const Request& request) {\n"
    "  auto pool = ctx->workers().borrow();\n  Plan plan = planner_for(request.shape());\n"
    "  plan.set_priority(request.priority(), ctx->quota());\n  plan.set_owner(request.owner());\n"
    "  while (plan.has_more()) {\n    Task task = plan.take();\n    task.bind(pool.any_free(), ctx->clock());\n"
    "    pool.enqueue(task, request.priority());\n    ctx->journal().note(task.id(), pool.depth());\n  }\n"
    "  Report report = pool.wait_all(request.timeout());\n  report.sign(ctx->keys(), request.owner());\n"
    "  ctx->outbox().post(report, request.reply_to());\n  return report.status();\n}\n";

struct Edit {
    std::string what, from, to;
};

/// The level of what is told of the edit of one side of a pair; "" for nothing.
std::string level_in(MemoryDisk disk, const BySide<std::string>& pair, bool of_port, const Edit& edit) {
    disk.files["/r/portmap.toml"] =
        "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
        "[[pair]]\nsource = \"" +
        pair.source + "\"\ntarget = \"" + pair.target + "\"\n";
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0) << edit.what;
    const std::string& id = of_port ? pair.target : pair.source;
    std::string& edited = disk.files["/r/" + id.substr(0, id.find(':'))];
    edited = replaced(edited, edit.from, edit.to);
    const auto report = check(disk);
    std::string out;
    for (const auto& finding : report["findings"]) {
        EXPECT_TRUE(out.empty()) << edit.what << ": more than one finding";
        out = finding["level"];
    }
    return out;
}

std::string level_of(const std::string& port, const Edit& edit, bool of_port = false,
                     const std::string& source_file = "k.cpp") {
    MemoryDisk disk;
    disk.files = {{"/r/s/" + source_file, kSource}, {"/r/t/k.cpp", port}};
    return level_in(disk, {"s/" + source_file + ":f", "t/k.cpp:f"}, of_port, edit);
}

/// The name in front of the first bracket.
std::string name_of_first(const std::string& text) {
    const size_t end = text.find('('), space = text.rfind(' ', end);
    return text.substr(space + 1, end - space - 1);
}

std::string level_of_kernel(const std::string& kernel, const std::string& port, const Edit& edit,
                            bool of_port = false) {
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cu", kernel}, {"/r/t/k.cpp", port}};
    return level_in(disk, {"s/k.cu:" + name_of_first(kernel), "t/k.cpp:" + name_of_first(port)}, of_port, edit);
}

const std::vector<Edit> kSlips = {
    {"a number", "* 0.5f", "* 0.25f"},
    {"a sign", "v + lim", "v - lim"},
    {"a comparison", "v > lim", "v < lim"},
    {"a name", "y.store(at, v)", "y.store(at, lim)"},
    {"a statement gone", "if (v > lim) { v = lim; }", ""},
    {"a statement more", "y.flush(rows);", "y.flush(rows); y.clear();"},
    {"another bound", "at < n", "at <= n"},
    {"a guard", "y.store(at, v);", "if (at < rows) { y.store(at, v); }"},
};

TEST(OwedEdit, SlipsAreNeverSilentWhateverThePortSays) {
    for (const Edit& edit : kSlips) {
        EXPECT_EQ(level_of(kTwin, edit), "error") << edit.what;
        const bool only_takes = edit.to.empty();  // what the port never had
        EXPECT_EQ(level_of(kStranger, edit), only_takes ? "warning" : "error") << edit.what;
        EXPECT_EQ(level_of(kStranger, edit, false, "k.cl"), only_takes ? "warning" : "error") << edit.what;
    }
}

/// The same of a source under another name than its port's; `beside` stands in the source's file, too.
std::string level_of_method(const std::string& source, const std::string& port, const std::string& body,
                            const Edit& edit, const std::string& beside = "") {
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cpp", replaced(kSource, "void f(", "void " + source + "(") + beside},
                  {"/r/t/k.cpp", replaced(body, " f(", " " + port + "(")}};
    return level_in(disk, {"s/k.cpp:" + source, "t/k.cpp:" + port}, false, edit);
}

TEST(OwedEdit, SlipsBetweenOtherNamesAreOwedWhereAnythingIsAlike) {
    for (const Edit& edit : kSlips) {
        EXPECT_EQ(level_of_method("scale_rows", "RunPlan", kTwin, edit), "error") << edit.what;
        EXPECT_EQ(level_of_method("scale_rows", "RunPlan", kStranger, edit), "warning") << edit.what;
        // One name, in the class of each side.
        EXPECT_NE(level_of_method("Fast::run", "Plain::run", kStranger, edit), edit.to.empty() ? "error" : "warning")
            << edit.what;
    }
}

TEST(OwedEdit, AMethodThatAWholeFamilyHasIsKnownByItsClass) {
    const Edit number = kSlips.front();
    const std::string another = "void Other::run(span y) {\n  y.clear();\n  y.flush(2);\n}\n";
    EXPECT_EQ(level_of_method("Fast::run", "Plain::run", kStranger, number, another), "warning");
    EXPECT_EQ(level_of_method("Plain::run", "Plain::run", kStranger, number, another), "error");
    EXPECT_EQ(level_of_method("Fast::run", "Plain::run", kTwin, number, another), "error");
}

TEST(OwedEdit, WhetherEditsOfTextsThatSayLittleAlikeAreOneIsHardToTell) {
    const auto level = [](const std::string& source, const std::string& port, const std::string& body,
                          const Edit& there) {
        const std::string from = replaced(kSource, "void f(", "void " + source + "("),
                          to = replaced(body, " f(", " " + port + "(");
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cpp", from},
                      {"/r/t/k.cpp", to},
                      {"/r/portmap.toml",
                       "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n[[pair]]\nsource = \"s/k.cpp:" +
                           source + "\"\ntarget = \"t/k.cpp:" + port + "\"\n"}};
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/s/k.cpp"] = replaced(from, "* 0.5f", "* 0.25f");
        disk.files["/r/t/k.cpp"] = replaced(to, there.from, there.to);
        const auto report = check(disk);
        EXPECT_EQ(report["findings"][0]["rule"], "port-differs");
        return report["findings"][0]["level"].get<std::string>();
    };
    const Edit quota = {"", "ctx->quota()", "ctx->quota(2)"}, third = {"", "* 0.5f", "* 0.125f"};
    EXPECT_EQ(level("scale_rows", "RunPlan", kStranger, quota), "warning");
    EXPECT_EQ(level("scale_rows", "scale_rows", kStranger, quota), "error");
    EXPECT_EQ(level("scale_rows", "RunPlan", kTwin, third), "error");
}

TEST(OwedEdit, EditsOfBothThatLeaveMoreThanASlipDoes) {
    const auto level = [](const std::string& here, const std::string& there) {
        MemoryDisk disk;
        disk.files = {{"/r/s/k.cpp", kSource}, {"/r/t/k.cpp", kTwin}};
        disk.files["/r/portmap.toml"] =
            "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
            "[[pair]]\nsource = \"s/k.cpp:f\"\ntarget = \"t/k.cpp:f\"\n";
        EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
        disk.files["/r/s/k.cpp"] = replaced(kSource, "  y.flush(rows);\n", here);
        disk.files["/r/t/k.cpp"] = replaced(kTwin, "  y.flush(rows);\n", there);
        const auto report = check(disk);
        EXPECT_EQ(report["findings"][0]["rule"], "port-differs");
        return report["findings"][0]["level"].get<std::string>();
    };
    const std::string all = "  y.trim(sum);\n  w.scale(lim);\n  y.mark(step);\n  w.bind(n);\n  y.flush(rows);\n";
    EXPECT_EQ(level(all, replaced(all, "w.scale(lim)", "w.scale(sum)")), "error") << "a word";
    EXPECT_EQ(level(all, replaced(all, "  w.scale(lim);\n", "")), "error") << "a statement";
    EXPECT_EQ(level(all, replaced(replaced(all, "mark(step)", "mark(n)"), "scale(lim)", "scale(sum)")), "error");
    EXPECT_EQ(level(all, "  y.flush(rows);\n  y.close();\n"), "error") << "next to nothing";
    EXPECT_EQ(level(all, "  y.seal(lim);\n  if (sum > lim) { y.drop(n); }\n  w.bind(n);\n  y.flush(rows);\n"),
              "warning");
}

TEST(OwedEdit, LongEditsOfWhatThePortDoesInItsOwnWay) {
    const std::vector<Edit> edits = {
        {"what stands around has no like", "y.flush(rows);",
         "if (rows > step) { y.reserve(rows * step); } y.flush(rows); tally.add(rows);"},
        {"more", "v = v + lim * step;", "v = v + lim * step; book.open(at, rows); book.enter(v, lim); book.close(at);"},
    };
    for (const Edit& edit : edits) {
        EXPECT_EQ(level_of(kStranger, edit), "warning") << edit.what;
        EXPECT_EQ(level_of(kTwin, edit), "error") << edit.what;
    }
}

/// Kernels, and the methods that do their work in a way of their own, as renderers have them.
const std::string kSplat =
    "__global__ void splatKernel(const float4* __restrict__ pos, const float* __restrict__ opacity, float* "
    "__restrict__ image, int count, int width, int height, SplatParams prm) {\n"
    "  __shared__ float4 tile[128];\n"
    "  int gid = blockIdx.x * blockDim.x + threadIdx.x;\n"
    "  int lane = threadIdx.x;\n"
    "  float2 centre = make_float2(blockIdx.y % prm.tilesX * 16.0f + 8.0f, blockIdx.y / prm.tilesX * 16.0f + 8.0f);\n"
    "  float acc = 0.0f;\n"
    "  float transmittance = 1.0f;\n"
    "  for (int base = 0; base < count; base += 128) {\n"
    "    if (base + lane < count) tile[lane] = pos[base + lane];\n"
    "    __syncthreads();\n"
    "    int limit = min(128, count - base);\n"
    "    for (int k = 0; k < limit; ++k) {\n"
    "      float dx = tile[k].x - centre.x;\n"
    "      float dy = tile[k].y - centre.y;\n"
    "      float power = -0.5f * (dx * dx + dy * dy) * tile[k].z;\n"
    "      if (power > 0.0f) continue;\n"
    "      float alpha = fminf(0.99f, opacity[base + k] * __expf(power));\n"
    "      if (alpha < 1.0f / 255.0f) continue;\n"
    "      acc += alpha * transmittance * tile[k].w;\n"
    "      transmittance *= 1.0f - alpha;\n"
    "    }\n"
    "    __syncthreads();\n"
    "  }\n"
    "  if (gid < width * height) image[gid] = acc + transmittance * prm.background;\n"
    "}\n";
const std::string kSplatter =
    "void Renderer::Splat(const std::vector<Gaussian>& gaussians, Image& out) const {\n"
    "  const int tilesAcross = (out.Width() + kTile - 1) / kTile;\n"
    "  #pragma omp parallel for schedule(dynamic)\n"
    "  for (int t = 0; t < tilesAcross * tilesAcross; ++t) {\n"
    "    const Vec2 mid{(t % tilesAcross + 0.5f) * kTile, (t / tilesAcross + 0.5f) * kTile};\n"
    "    double light = 0;\n"
    "    double remaining = 1;\n"
    "    for (const Gaussian& g : gaussians) {\n"
    "      const Vec2 offset = g.position - mid;\n"
    "      const double exponent = -0.5 * Dot(offset, offset) * g.inverseVariance;\n"
    "      if (exponent > 0) continue;\n"
    "      const double coverage = std::min(0.99, g.opacity * std::exp(exponent));\n"
    "      if (coverage < 1.0 / 255.0) continue;\n"
    "      light += coverage * remaining * g.colour;\n"
    "      remaining *= 1 - coverage;\n"
    "    }\n"
    "    out.Fill(t, light + remaining * settings_.background);\n"
    "  }\n"
    "}\n";
const std::string kTone =
    "__device__ float3 tonemap(float3 c, float exposure, float white, int mode) {\n"
    "  c = make_float3(c.x * exposure, c.y * exposure, c.z * exposure);\n"
    "  float l = 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;\n"
    "  if (l <= 0.0f) return make_float3(0.0f, 0.0f, 0.0f);\n"
    "  float m = l;\n"
    "  switch (mode) {\n"
    "    case 0: m = fminf(l, 1.0f); break;\n"
    "    case 1: m = l / (1.0f + l); break;\n"
    "    case 2: m = l * (1.0f + l / (white * white)) / (1.0f + l); break;\n"
    "    default: m = l * (2.51f * l + 0.03f) / (l * (2.43f * l + 0.59f) + 0.14f); break;\n"
    "  }\n"
    "  float s = m / l;\n"
    "  c.x = powf(c.x * s, 1.0f / 2.2f);\n"
    "  c.y = powf(c.y * s, 1.0f / 2.2f);\n"
    "  c.z = powf(c.z * s, 1.0f / 2.2f);\n"
    "  return c;\n"
    "}\n";
const std::string kToneMapper =
    "Colour ToneMapper::tonemap(Colour in) const {\n"
    "  in *= exposure;\n"
    "  const float lum = in.Luminance();\n"
    "  if (lum <= 0.0f) return Colour(0.0f);\n"
    "  float mapped = lum;\n"
    "  if (mode == Mode::Clip) mapped = std::min(lum, 1.0f);\n"
    "  else if (mode == Mode::Reinhard) mapped = lum / (1.0f + lum);\n"
    "  else if (mode == Mode::Extended) mapped = lum * (1.0f + lum / (white * white)) / (1.0f + lum);\n"
    "  else mapped = lum * (2.51f * lum + 0.03f) / (lum * (2.43f * lum + 0.59f) + 0.14f);\n"
    "  return (in * (mapped / lum)).Pow(1.0f / 2.2f);\n"
    "}\n";

TEST(OwedEdit, FeaturesAndFormulasOfAKernelAreNoNotes) {
    const std::vector<Edit> edits = {
        {"a test more", "if (power > 0.0f) continue;",
         "if (power > 0.0f || tile[k].z <= 0.0f || fabsf(dx) > prm.most || fabsf(dy) > prm.most) continue;"},
        {"an early stop", "transmittance *= 1.0f - alpha;",
         "transmittance *= 1.0f - alpha;\n"
         "if (transmittance < prm.stopAt) { acc /= fmaxf(1.0f - transmittance, 1e-4f); break; }"},
        {"a curve on what is stored", "image[gid] = acc + transmittance * prm.background;",
         "{ float c = acc + transmittance * prm.background; "
         "image[gid] = prm.gamma > 0.0f ? powf(fmaxf(c, 0.0f), 1.0f / prm.gamma) : c; }"},
    };
    for (const Edit& edit : edits) EXPECT_EQ(level_of_kernel(kSplat, kSplatter, edit), "warning") << edit.what;
    const Edit shoulder = {"a shoulder", "float s = m / l;",
                           "m = fminf(m, 1.0f - 0.02f * expf(-8.0f * fmaxf(m - 0.9f, 0.0f)));\n  float s = m / l;"};
    EXPECT_EQ(level_of_kernel(kTone, kToneMapper, shoulder), "warning");
}

TEST(OwedEdit, NorWhatAPortLosesOrDoesTwice) {
    const std::string adds = "light += coverage * remaining * g.colour;",
                      dims = "if (coverage < 1.0 / 255.0) continue;";
    const std::vector<Edit> edits = {
        {"a sum gone", adds, ""},
        {"a sum twice", adds, adds + "\n      " + adds},
        {"a curve", "out.Fill(t, light + remaining * settings_.background);",
         "out.Fill(t, std::pow(std::max(light + remaining * settings_.background, 0.0), 1.0 / settings_.gamma));"},
        {"a test gone", dims, ""},
    };
    for (const Edit& edit : edits) EXPECT_EQ(level_of_kernel(kSplat, kSplatter, edit, true), "warning") << edit.what;
}

TEST(OwedEdit, WhatIsGoneDrawsNoPortNearerThatSaysItInItsOwnWords) {
    const std::string gamma = "c.y = powf(c.y * s, 1.0f / 2.2f);";
    const std::vector<Edit> edits = {
        {"a step", "c = make_float3(c.x * exposure, c.y * exposure, c.z * exposure);", ""},
        {"a channel", gamma, ""},
        {"the same once more", gamma, gamma + " " + gamma},
    };
    for (const Edit& edit : edits) EXPECT_EQ(level_of_kernel(kTone, kToneMapper, edit), "warning") << edit.what;
}

TEST(OwedEdit, WhatStandsBesideAStatementOfBothIsToldWhateverTheRestSays) {
    const std::string shared = "    y.store(at, v);\n";
    const std::string port = replaced(kStranger, "  return report.status();\n", shared + "  return report.status();\n");
    const Edit clamp = {"a clamp", "y.store(at, v);",
                        "y.store(at, v); if (y.load(at) > lim * step) { y.store(at, lim * step); }"};
    EXPECT_NE(level_of(port, clamp), "note");
    const Edit gone = {"gone with more", "    y.store(at, v);\n    sum += v * w.load(at);\n",
                       "    tally.add(at, part_of(v, rows)); log.note(at, rows);\n"};
    EXPECT_NE(level_of(port, gone), "note");
}

TEST(OwedEdit, WhatIsNeverSilentIsNotDoubted) {
    const std::vector<Edit> edits = {
        {"volatile", "float v = x.load(at) * 0.5f;", "volatile float v = x.load(at) * 0.5f; watch(v); settle(v, at);"},
        {"a static", "const int step = rows / 4;", "static int step = rows / 4; note_step(step, rows); keep(step);"},
        {"a pragma", "  for (int at",
         "  #pragma omp parallel for reduction(+ : total) num_threads(step)\n  for (int at"},
    };
    for (const Edit& edit : edits) EXPECT_EQ(level_of(kStranger, edit), "error") << edit.what;
}

TEST(OwedEdit, NumbersAndOrderAreMeantForBoth) {
    const std::vector<Edit> edits = {
        {"numbers", "float v = x.load(at) * 0.5f;\n    v = v + lim * step;",
         "float v = x.load(at) * 0.25f;\n    v = fold(v, lim, step, 3) + tally(v, 7);"},
        {"order", "const int rows = x.rows();\n  const int step = rows / 4;",
         "const int step = x.rows() / 4;\n  const int rows = step;"},
    };
    for (const Edit& edit : edits) EXPECT_EQ(level_of(kStranger, edit), "error") << edit.what;
}

/// The level of an edit of `f`, whose port is a stranger, beside `many` pairs of one name that are twins or strangers.
std::string level_beside(size_t many, const std::string& others, const Edit& edit) {
    MemoryDisk disk;
    disk.files = {{"/r/s/k.cpp", kSource}, {"/r/t/k.cpp", kStranger}};
    std::string map = "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n";
    const auto pair = [&](const std::string& file, const std::string& name) {
        map += "[[pair]]\nsource = \"s/" + file + ":" + name + "\"\ntarget = \"t/" + file + ":" + name + "\"\n";
    };
    pair("k.cpp", "f");
    for (size_t i = 0; i < many; ++i) {
        const std::string name = "g" + std::to_string(i);
        disk.files["/r/s/more.cpp"] += replaced(kSource, " f(", " " + name + "(");
        disk.files["/r/t/more.cpp"] += replaced(others, " f(", " " + name + "(");
        pair("more.cpp", name);
    }
    disk.files["/r/portmap.toml"] = map;
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0);
    disk.files["/r/s/k.cpp"] = replaced(kSource, edit.from, edit.to);
    const auto report = check(disk);
    EXPECT_EQ(report["findings"].size(), 1) << edit.what;
    return report["findings"][0]["level"];
}

TEST(OwedEdit, ANameTellsLittleWherePortsHaveWordsOfTheirOwn) {
    for (const Edit& edit : kSlips) {
        if (edit.to.empty()) continue;
        EXPECT_EQ(level_beside(8, kStranger, edit), "warning") << edit.what;
        EXPECT_EQ(level_beside(4, kStranger, edit), "error") << edit.what << ": too few to tell";
        EXPECT_EQ(level_beside(16, kTwin, edit), "error") << edit.what;
    }
}

TEST(OwedEdit, LongEditsOfThePortAlone) {
    const Edit own = {
        "of the port", "Plan plan = planner_for(request.shape());",
        "Plan plan = cached_plan(ctx->plans(), request.shape(), request.flags()); plan.check(ctx->rules());"};
    EXPECT_EQ(level_of(kStranger, own, true), "warning");
    const Edit of_twin = {"of a twin", "v = v + lim * step;", "v = fold(v, lim) * step; v = clamp_to(v, lim, rows);"};
    EXPECT_EQ(level_of(kTwin, of_twin, true), "warning");
}

}  // namespace
}  // namespace porttool::testing::owed_edit_test
