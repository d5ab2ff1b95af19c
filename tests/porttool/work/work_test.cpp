// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A text of twice the size costs at most twice the work, whatever it is made of. Work is counted, not timed: the code
// under test is compiled so that each of its branches counts itself, so nothing that loops can be forgotten.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <optional>
#include <sstream>

#include "porttool/audit/lone_slips.h"
#include "porttool/audit/past_edit.h"
#include "porttool/audit/same_value.h"
#include "porttool/command/run.h"
#include "porttool/effort/port_effort.h"
#include "porttool/history/blob_facts_source.h"
#include "porttool/match/match.h"
#include "porttool/measure/measure.h"
#include "porttool/normal/normal_form.h"
#include "porttool/read/id_patterns.h"
#include "porttool/read/ignore_rules.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/work/constructs.h"
#include "tests/porttool/work/recorded_sides.h"
#include "tests/porttool/work/work_counter.h"

namespace porttool::testing {
namespace {

constexpr size_t kBytes = 700;

Work work_of(const std::function<void()>& run) {
    const Work before = work_so_far();
    run();
    const Work after = work_so_far();
    return {after.steps - before.steps, after.allocated - before.allocated};
}

/// What is done with a construct of so many repetitions. Making its text is no part of the work.
using Task = std::function<Work(const Construct& construct, size_t repetitions)>;

struct Growth {
    Work once, twice;

    static double of(uint64_t once, uint64_t twice) {
        return static_cast<double>(twice) / static_cast<double>(std::max<uint64_t>(1, once));
    }
    bool is_linear() const {
        return of(once.steps, twice.steps) <= kMostGrowth && of(once.allocated, twice.allocated) <= kMostGrowth;
    }
};

/// Some tables are filled in up to a bound that is documented: what grows faster in a small text must not in a large
/// one. What a text of twice the size took is kept, for it is the first of the next two.
Growth growth_of(const Task& task, const Construct& construct) {
    constexpr size_t kLargest = 100'000;
    size_t bytes = kBytes, repetitions = construct.repetitions(bytes);
    Growth growth{task(construct, repetitions), task(construct, 2 * repetitions)};
    while (!growth.is_linear() && 2 * (bytes *= 2) <= kLargest) {
        repetitions *= 2;
        growth = {growth.twice, task(construct, 2 * repetitions)};
    }
    return growth;
}

void expect_linear(const char* name, const Task& task) {
    for (const Construct& construct : read_constructs(CONSTRUCTS)) {
        const Growth growth = growth_of(task, construct);
        EXPECT_TRUE(growth.is_linear()) << name << " of " << construct.name << ": from " << growth.once.steps << " to "
                                        << growth.twice.steps << " steps, from " << growth.once.allocated << " to "
                                        << growth.twice.allocated << " bytes allocated";
    }
}

TEST(Work, TheListIsLong) { EXPECT_GE(read_constructs(CONSTRUCTS).size(), 80u); }

TEST(Work, Scan) {
    expect_linear("scan", [](const Construct& construct, size_t repetitions) {
        const std::string text = construct.text(repetitions, EditOf::None);
        return work_of([&] { scan_text("s/a.cu", text); });
    });
}

TEST(Work, Map) {
    expect_linear("map", [](const Construct& construct, size_t repetitions) {
        const std::string text = construct.text(repetitions, EditOf::None);
        return work_of([&] { match_units({scan_text("s/a.cu", text)}, {scan_text("t/a.cpp", text)}, {}, Dialect()); });
    });
}

Task check_of(EditOf source, EditOf target) {
    return [=](const Construct& construct, size_t repetitions) {
        const RecordedSides sides(construct.text(repetitions, EditOf::None));
        const std::string left = construct.text(repetitions, source), right = construct.text(repetitions, target);
        return work_of([&] { sides.check(left, right); });
    };
}

TEST(Work, CheckOfOneEditedPlace) { expect_linear("check", check_of(EditOf::One, EditOf::None)); }
TEST(Work, CheckOfTheSameEditOnBothSides) { expect_linear("check", check_of(EditOf::All, EditOf::All)); }
TEST(Work, CheckOfOtherEditsOnBothSides) { expect_linear("check", check_of(EditOf::All, EditOf::One)); }

/// What audit reads of the statements of one text, and of two that stand for each other.
TEST(Work, AuditOfStatements) {
    expect_linear("audit", [](const Construct& construct, size_t repetitions) {
        const ScannedFile a = scan_text("s/a.cu", construct.text(repetitions, EditOf::None)),
                          b = scan_text("t/a.cpp", construct.text(repetitions, EditOf::One));
        std::vector<std::pair<std::vector<WrittenStatement>, std::vector<WrittenStatement>>> pairs;
        for (size_t i = 0; i < std::min(a.units.size(), b.units.size()); ++i)
            pairs.emplace_back(written_statements(normal_form(a, a.units[i]).words()),
                               written_statements(normal_form(b, b.units[i]).words()));
        return work_of([&] {
            for (const auto& [here, there] : pairs) {
                lone_slips(here);
                for (size_t k = 0; k < std::min(here.size(), there.size()); ++k)
                    give_the_same_value(words_of_statement(here[k]), words_of_statement(there[k]));
            }
        });
    });
}

TEST(Work, Compare) {
    expect_linear("compare", [](const Construct& construct, size_t repetitions) {
        const ScannedFile a = scan_text("s/a.cu", construct.text(repetitions, EditOf::None)),
                          b = scan_text("t/a.cpp", construct.text(repetitions, EditOf::One));
        return work_of([&] { measure_shares({{&a, nullptr}}, {{&b, nullptr}}, Dialect()); });
    });
}

TEST(Work, Effort) {
    expect_linear("effort", [](const Construct& construct, size_t repetitions) {
        const auto scanned = [&](const char* path, EditOf edit) {
            std::vector<ScannedFile> files;
            files.push_back(scan_text(path, construct.text(repetitions, edit)));
            return files;
        };
        const std::vector<ScannedFile> source_before = scanned("s/a.cu", EditOf::None),
                                       source_now = scanned("s/a.cu", EditOf::All),
                                       target_before = scanned("t/a.cpp", EditOf::None),
                                       target_now = scanned("t/a.cpp", EditOf::All);
        std::vector<MapPair> pairs;
        for (const Unit& unit : source_before[0].units)
            pairs.push_back({unit_id(source_before[0], unit), {"t/a.cpp:" + unit.name}, 1});
        return work_of([&] {
            port_effort(pairs, {}, {source_before, source_now, target_before, target_now}, Dialect());
        });
    });
}

/// One function for each number, with this factor.
std::string functions(size_t count, const std::string& factor) {
    std::string out;
    for (size_t i = 0; i < count; ++i)
        out += "float f" + std::to_string(i) + "(float a) {\n    float b = a + " + std::to_string(i) +
               ".0f;\n    return b * " + factor + ";\n}\n";
    return out;
}

/// Judges all pairs of two files of a repository's past, both of which changed.
Work history_work(size_t count) {
    const std::filesystem::path root = std::filesystem::temp_directory_path() / "porttool_work_history";
    std::filesystem::remove_all(root);
    std::filesystem::create_directories(root);
    const std::string go = "cd '" + root.string() + "' && ";
    EXPECT_EQ(std::system((go + "git init -q .").c_str()), 0);
    const auto stored = [&](const std::string& path, const std::string& factor) {
        std::ofstream(root / "text") << functions(count, factor);
        EXPECT_EQ(std::system((go + "git hash-object -w text > blob").c_str()), 0);
        FileVersion out{path, ""};
        std::getline(std::ifstream(root / "blob"), out.blob);
        return out;
    };
    const BySide<FileVersion> before{stored("s/k.cu", "0.5f"), stored("t/k.cpp", "0.5f")},
        now{stored("s/k.cu", "0.25f"), stored("t/k.cpp", "0.75f")};
    Past past;
    past.root = root.string();
    past.git = std::make_unique<GitRepository>(past.root);
    BlobCache cache;
    BlobFactsSource blobs(past, cache);
    const Work out = work_of([&] {
        BySide<BlobFacts> was{blobs.facts(before.source), blobs.facts(before.target)};
        BySide<BlobFacts> is{blobs.facts(now.source), blobs.facts(now.target)};
        CompareBudget budget;
        size_t differ = 0;
        for (size_t i = 0; i < count; ++i) {
            const std::string name = "f" + std::to_string(i), here = "s/k.cu:" + name, there = "t/k.cpp:" + name;
            differ += !blobs
                           .edits(
                               {{here, was.source.find(name)->prints, *is.source.find(name)},
                                {there, was.target.find(name)->prints, *is.target.find(name)}},
                               [](Print) { return std::string(); }, budget)
                           .in_step;
        }
        EXPECT_EQ(differ, count);
    });
    std::filesystem::remove_all(root);
    return out;
}

/// Proposes the ports of all units of one file.
Work sync_work(size_t count) {
    MemoryDisk disk;
    std::string map = "version = 1\n[sides]\nsource = [\"s/*\"]\ntarget = [\"t/*\"]\n";
    for (size_t i = 0; i < count; ++i)
        map += "[[pair]]\nsource = \"s/k.cu:f" + std::to_string(i) + "\"\ntarget = \"t/k.cpp:f" + std::to_string(i) +
               "\"\n";
    disk.files = {
        {"/r/portmap.toml", map}, {"/r/s/k.cu", functions(count, "0.5f")}, {"/r/t/k.cpp", functions(count, "0.5f")}};
    const auto run_here = [&](const char* command) {
        const std::array<const char*, 4> arguments{"porttool", "-C", "/r", command};
        std::ostringstream out, err;
        return run_porttool(static_cast<int>(arguments.size()), arguments.data(), disk, out, err);
    };
    EXPECT_EQ(run_here("init"), 0);
    disk.files["/r/s/k.cu"] = functions(count, "0.25f");
    return work_of([&] { EXPECT_EQ(run_here("sync"), 0); });
}

TEST(Work, SyncOfAFileWithManyChangedUnits) {
    const Growth growth{sync_work(100), sync_work(200)};
    EXPECT_TRUE(growth.is_linear()) << growth.once.steps << ", " << growth.twice.steps << " steps, "
                                    << growth.once.allocated << ", " << growth.twice.allocated << " bytes allocated";
}

TEST(Work, HistoryOfAFileWithManyChangedUnits) {
    if (std::system("git --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "git is not installed";
    const Growth growth{history_work(100), history_work(200)};
    EXPECT_TRUE(growth.is_linear()) << growth.once.steps << ", " << growth.twice.steps;
}

}  // namespace
}  // namespace porttool::testing
