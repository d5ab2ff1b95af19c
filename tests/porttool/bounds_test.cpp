// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What is done in fewer steps than the plain way gives what the plain way gives; what is beyond a bound is loud.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <new>
#include <random>

#include "porttool/normal/diff.h"
#include "tests/porttool/run_command.h"

namespace porttool::testing::bounds_test {
namespace {

using Texts = std::vector<std::string>;

/// The whole table, as a book has it: of two ways of one length the one that removes first.
std::vector<std::array<size_t, 3>> plain_diff(const Texts& before, const Texts& now) {
    std::vector<std::vector<size_t>> kept(before.size() + 1, std::vector<size_t>(now.size() + 1, 0));
    for (size_t i = before.size(); i-- > 0;)
        for (size_t k = now.size(); k-- > 0;)
            kept[i][k] = before[i] == now[k] ? kept[i + 1][k + 1] + 1 : std::max(kept[i + 1][k], kept[i][k + 1]);
    std::vector<std::array<size_t, 3>> out;
    size_t i = 0, k = 0;
    while (i < before.size() || k < now.size()) {
        if (i < before.size() && k < now.size() && before[i] == now[k])
            out.push_back({DiffStep::Keep, i++, k++});
        else if (i < before.size() && (k == now.size() || kept[i + 1][k] >= kept[i][k + 1]))
            out.push_back({DiffStep::Remove, i++, k});
        else
            out.push_back({DiffStep::Add, i, k++});
    }
    return out;
}

TEST(Bounds, DiffIsThatOfTheWholeTable) {
    std::mt19937 dice(7);
    for (int round = 0; round < 400; ++round) {
        const auto text = [&](size_t length, unsigned words) {
            Texts out;
            for (size_t i = 0; i < length; ++i) out.push_back(std::to_string(dice() % words));
            return out;
        };
        Texts before = text(1 + dice() % 150, 2 + dice() % 60), now = before;
        for (size_t edit = dice() % 40; edit > 0; --edit) {
            const auto at = now.begin() + static_cast<std::ptrdiff_t>(now.empty() ? 0 : dice() % now.size());
            if (dice() % 2 == 0 && !now.empty())
                now.erase(at);
            else
                now.insert(at, std::to_string(dice() % 70));
        }
        if (round % 5 == 0) now = text(dice() % 150, 40);
        // Both ends that are alike are kept as they are, in either way.
        while (!before.empty() && !now.empty() && before.back() == now.back()) before.pop_back(), now.pop_back();
        std::vector<std::array<size_t, 3>> found;
        for (const DiffStep& step : diff(before, now)) found.push_back({step.kind, step.before, step.now});
        ASSERT_EQ(found, plain_diff(before, now)) << round;
    }
}

/// Where the whole table would be too large, a band of it holds every shortest way.
TEST(Bounds, DiffOfLongTextsWithFewEditsIsThatOfTheWholeTable) {
    std::mt19937 dice(11);
    for (const size_t edits : {8u, 150u}) {
        Texts before;
        for (size_t i = 0; i < 3050; ++i) before.push_back(std::to_string(dice() % 60));
        Texts now = before;
        for (size_t edit = 0; edit < edits; ++edit) {
            const auto at = now.begin() + static_cast<std::ptrdiff_t>(dice() % now.size());
            if (edit % 2 == 0)
                now.erase(at);
            else
                now.insert(at, std::to_string(dice() % 60));
        }
        std::swap(now.front(), now[1]);
        std::swap(now.back(), now[now.size() - 2]);
        std::vector<std::array<size_t, 3>> found;
        for (const DiffStep& step : diff(before, now)) found.push_back({step.kind, step.before, step.now});
        const auto kept = [](const auto& step) { return step[0] == DiffStep::Keep; };
        ASSERT_GT(std::count_if(found.begin(), found.end(), kept), 2800) << edits;
        while (before.back() == now.back()) before.pop_back(), now.pop_back();
        found.resize(found.size() - (3050 - before.size()));
        EXPECT_TRUE(found == plain_diff(before, now)) << edits;
    }
}

/// Fails in a way that no command foresees.
template <class Thrown>
class FailingDisk final : public Disk {
public:
    FileText read(const std::string&, uint64_t) const override { throw Thrown(); }
    FileText read(const TreePath&, uint64_t) const override { throw Thrown(); }
    FolderList list(const TreePath&) const override { throw Thrown(); }
    FileKind kind(const TreePath&) const override { throw Thrown(); }
    bool is_directory(const std::string&) const override { return true; }
    bool exists(const std::string&) const override { throw Thrown(); }
    std::string write(const std::string&, const std::string&) override { throw Thrown(); }
    std::string write(const TreePath&, const std::string&) override { throw Thrown(); }
    std::string remove(const TreePath&) override { throw Thrown(); }
    TakenGuard guard(const TreePath&) override { throw Thrown(); }
};

template <class Thrown>
void expect_exit_2() {
    FailingDisk<Thrown> disk;
    for (const char* command : {"check", "map", "init", "report"}) {
        const CommandRun outcome = run(disk, {command});
        EXPECT_EQ(outcome.exit_code, 2) << command;
        EXPECT_TRUE(outcome.err.starts_with("porttool: ")) << outcome.err;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
}

struct Unforeseen {};

TEST(Bounds, EveryExceptionEndsInExit2) {
    expect_exit_2<std::bad_alloc>();
    expect_exit_2<std::bad_function_call>();
    expect_exit_2<Unforeseen>();
}

TEST(Bounds, AUnitTooLongToCompareIsAFinding) {
    std::string body;
    for (int i = 0; i < 160'000; ++i) body += "a;";
    const auto text = [&](const char* value) { return "void f(int a) {" + body + "a = " + value + ";}\n"; };
    MemoryDisk disk = started(text("1"), text("1"));
    disk.files["/r/src/k.cu"] = text("2");
    nlohmann::json found = check(disk);
    EXPECT_EQ(found["verdict"], "drift");
    EXPECT_EQ(found["findings"][0]["rule"], "source-changed");
    EXPECT_NE(found["findings"][0]["message"].get<std::string>().find("not compared"), std::string::npos);
    disk.files["/r/port/k.comp"] = text("2");
    found = check(disk);
    EXPECT_EQ(found["verdict"], "drift");
    EXPECT_EQ(found["findings"][0]["rule"], "port-differs");
}

TEST(Bounds, DeepKeysOfTheMapAreRefused) {
    MemoryDisk disk = started("int f() { return 1; }\n", "int f() { return 1; }\n");
    const std::string map = disk.files["/r/portmap.toml"];
    std::string deep = "a";
    for (int i = 0; i < 100'000; ++i) deep += i % 2 == 0 ? ".a" : " . \"=[\"";
    for (const std::string& text :
         {"[" + deep + "]\n", "[[" + deep + "]]\n", deep + " = 1\n", "x = {" + deep + " = 1}\n"}) {
        disk.files["/r/portmap.toml"] = map + text;
        const CommandRun outcome = run(disk, {"-C", "/r", "check"});
        EXPECT_EQ(outcome.exit_code, 2);
        EXPECT_NE(outcome.err.find("more than 16 dots"), std::string::npos) << outcome.err.substr(0, 200);
    }
    disk.files["/r/portmap.toml"] = map + "# " + deep + "\n[dialect]\n\"x\" = '''" + deep + "'''\n";
    EXPECT_EQ(run(disk, {"-C", "/r", "check"}).exit_code, 0);
}

}  // namespace
}  // namespace porttool::testing::bounds_test
