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

/// The level of what is told of the edit of one side; "" for nothing.
std::string level_of(const std::string& port, const Edit& edit, bool of_port = false,
                     const std::string& source_file = "k.cpp") {
    MemoryDisk disk;
    disk.files = {{"/r/s/" + source_file, kSource},
                  {"/r/t/k.cpp", port},
                  {"/r/portmap.toml",
                   "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n"
                   "[[pair]]\nsource = \"s/" +
                       source_file + ":f\"\ntarget = \"t/k.cpp:f\"\n"}};
    EXPECT_EQ(run(disk, {"-C", "/r", "init", "--force"}).exit_code, 0) << edit.what;
    std::string& edited = disk.files[of_port ? "/r/t/k.cpp" : "/r/s/" + source_file];
    edited = replaced(edited, edit.from, edit.to);
    const auto report = check(disk);
    std::string out;
    for (const auto& finding : report["findings"]) {
        EXPECT_TRUE(out.empty()) << edit.what << ": more than one finding";
        out = finding["level"];
    }
    return out;
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

TEST(OwedEdit, LongEditsOfWhatThePortDoesInItsOwnWay) {
    const std::vector<Edit> edits = {
        {"what stands around has no like", "y.flush(rows);",
         "if (rows > step) { y.reserve(rows * step); } y.flush(rows); tally.add(rows);"},
        {"more", "v = v + lim * step;", "v = v + lim * step; book.open(at, rows); book.enter(v, lim); book.close(at);"},
    };
    for (const Edit& edit : edits) {
        EXPECT_EQ(level_of(kStranger, edit), "note") << edit.what;
        EXPECT_EQ(level_of(kTwin, edit), "error") << edit.what;
    }
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

TEST(OwedEdit, LongEditsOfThePortAlone) {
    const Edit own = {
        "of the port", "Plan plan = planner_for(request.shape());",
        "Plan plan = cached_plan(ctx->plans(), request.shape(), request.flags()); plan.check(ctx->rules());"};
    EXPECT_EQ(level_of(kStranger, own, true), "note");
    const Edit of_twin = {"of a twin", "v = v + lim * step;", "v = fold(v, lim) * step; v = clamp_to(v, lim, rows);"};
    EXPECT_EQ(level_of(kTwin, of_twin, true), "warning");
}

}  // namespace
}  // namespace porttool::testing::owed_edit_test
