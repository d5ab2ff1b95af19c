// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// porttool_growth [--bytes 131072] [--repeat 1] [--only PART]...: what the commands take of each text of
// bench/constructs.json, at a size and at twice that.
//
// Steps and bytes allocated are counted, so they are the same on a busy machine; beside them stands the processor time,
// the least of so many runs: what grows in time and not in steps is the caches'. A line for each command of each text,
// then the worst ten; exit 1 if a count grows more than 2.1 times. What is filled in up to a bound that
// docs/porttool.md names grows faster below it, so what grows too fast is doubled again, up to 4 MiB. Nothing is
// written to a disk.
#include <sched.h>
#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <functional>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "porttool/command/run.h"
#include "porttool/effort/port_effort.h"
#include "porttool/scan/scan.h"
#include "tests/porttool/work/constructs.h"
#include "tests/porttool/work/recorded_sides.h"
#include "tests/porttool/work/work_counter.h"

namespace porttool::testing {
namespace {

constexpr size_t kLargest = 4 << 20;
constexpr size_t kWorst = 10;

struct Options {
    size_t bytes = 128 << 10, repeat = 1;
    std::vector<std::string> only;
};

struct Cost {
    Work work;
    double seconds = 0;
};

/// By command.
using Costs = std::map<std::string, Cost>;

double processor_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// Runs something and notes what it took.
void note(Costs& costs, const std::string& command, const std::function<void()>& run) {
    const Work before = work_so_far();
    const double start = processor_seconds();
    run();
    const double seconds = processor_seconds() - start;
    const Work after = work_so_far();
    costs[command] = {{after.steps - before.steps, after.allocated - before.allocated}, seconds};
}

void run_command(MemoryDisk& disk, std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), {"porttool", "-C", "/r"});
    std::ostringstream out, err;
    if (run_porttool(static_cast<int>(arguments.size()), arguments.data(), disk, out, err) == 2) std::cerr << err.str();
}

/// Without git, as what it tells of a commit is no work on the texts; so is `check --base`.
void measure_effort(const std::string& before, const std::string& source, const std::string& target) {
    const auto scanned = [](const char* path, const std::string& text) {
        std::vector<ScannedFile> files;
        files.push_back(scan_text(path, text));
        return files;
    };
    const std::vector<ScannedFile> source_before = scanned("s/a.cu", before), source_now = scanned("s/a.cu", source),
                                   target_before = scanned("t/a.cpp", before), target_now = scanned("t/a.cpp", target);
    std::vector<MapPair> pairs;
    for (const Unit& unit : source_before[0].units)
        pairs.push_back({unit_id(source_before[0], unit), {"t/a.cpp:" + unit.name}, 1});
    port_effort(pairs, {}, {source_before, source_now, target_before, target_now}, Dialect());
}

/// Of the commands that are wanted, of all where none is; `init` comes with each that needs it.
Costs costs_of(const Construct& construct, size_t repetitions, const std::set<std::string>& wanted) {
    const std::string old = construct.text(repetitions, EditOf::None), one = construct.text(repetitions, EditOf::One),
                      all = construct.text(repetitions, EditOf::All);
    MemoryDisk disk;
    disk.files = {{"/r/s/a.cu", old}, {"/r/t/a.cpp", old}};
    Costs costs;
    const auto is_wanted = [&](const std::string& name) { return wanted.empty() || wanted.contains(name); };
    const auto run = [&](const std::string& name, std::vector<const char*> arguments) {
        if (is_wanted(name)) note(costs, name, [&] { run_command(disk, std::move(arguments)); });
    };
    run("scan", {"scan", "s", "--format", "json"});
    run("map", {"map", "--source", "s/**", "--target", "t/**", "--format", "json"});
    if (is_wanted("init") || is_wanted("check, one side") || is_wanted("check, both sides"))
        note(costs, "init", [&] { run_command(disk, {"init", "--source", "s/**", "--target", "t/**"}); });
    disk.files["/r/s/a.cu"] = one;
    run("check, one side", {"check"});
    disk.files["/r/s/a.cu"] = all;
    disk.files["/r/t/a.cpp"] = one;
    run("check, both sides", {"check"});
    if (is_wanted("check --base")) {
        const RecordedSides sides(old);
        note(costs, "check --base", [&] { sides.check_against_base(all, one); });
    }
    run("compare", {"compare", "s/a.cu", "t/a.cpp"});
    if (is_wanted("effort")) note(costs, "effort", [&] { measure_effort(old, all, one); });
    return costs;
}

/// The least time of so many runs; the counts are those of each.
Costs least_costs(const Construct& construct, size_t repetitions, const std::set<std::string>& wanted, size_t repeat) {
    Costs least = costs_of(construct, repetitions, wanted);
    for (size_t i = 1; i < repeat; ++i)
        for (const auto& [command, cost] : costs_of(construct, repetitions, wanted))
            least[command].seconds = std::min(least[command].seconds, cost.seconds);
    return least;
}

/// One command on one text at a size and at twice that.
struct Row {
    std::string command, construct;
    size_t bytes = 0;
    Cost once, twice;

    static double ratio(double once, double twice) { return twice / std::max(once, 1e-9); }
    double steps() const { return ratio(static_cast<double>(once.work.steps), static_cast<double>(twice.work.steps)); }
    double allocated() const {
        return ratio(static_cast<double>(once.work.allocated), static_cast<double>(twice.work.allocated));
    }
    double time() const { return ratio(once.seconds, twice.seconds); }
    bool is_linear() const { return steps() <= kMostGrowth && allocated() <= kMostGrowth; }
};

std::vector<Row> rows_of(const Construct& construct, const Options& options) {
    size_t bytes = options.bytes, repetitions = construct.repetitions(bytes);
    std::map<std::string, Row> rows;
    std::set<std::string> wanted;
    Costs once = least_costs(construct, repetitions, {}, options.repeat);
    do {
        const Costs twice = least_costs(construct, 2 * repetitions, wanted, options.repeat);
        for (const auto& [command, cost] : twice)
            if (wanted.empty() || wanted.contains(command))
                rows[command] = {command, construct.name, bytes, once.at(command), cost};
        wanted.clear();
        for (const auto& [command, row] : rows)
            if (!row.is_linear() && row.bytes == bytes) wanted.insert(command);
        once = twice;
        bytes *= 2;
        repetitions *= 2;
    } while (!wanted.empty() && 2 * bytes <= kLargest);
    std::vector<Row> out;
    for (auto& [command, row] : rows) out.push_back(std::move(row));
    return out;
}

void print(const Row& row) {
    std::printf("| %s | %s | %zu | %.3g | %.2f | %.2f | %.2f | %.2f | %s |\n", row.command.c_str(),
                row.construct.c_str(), row.bytes, static_cast<double>(row.twice.work.steps), row.steps(),
                row.allocated(), row.twice.seconds, row.time(), row.is_linear() ? "" : "TOO MUCH");
    std::fflush(stdout);
}

void print_worst(std::vector<Row> rows, const char* by, const std::function<double(const Row&)>& growth) {
    std::sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) { return growth(a) > growth(b); });
    rows.resize(std::min(rows.size(), kWorst));
    std::printf("\nThe worst by %s:\n", by);
    for (const Row& row : rows) print(row);
}

Options parse(int count, char** texts) {
    Options options;
    const auto number = [](const std::string& text, size_t& value) {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        return error == std::errc() && end == text.data() + text.size() && value > 0;
    };
    for (int i = 1; i < count; i += 2) {
        const std::string option = texts[i], value = i + 1 < count ? texts[i + 1] : "";
        const bool good = option == "--bytes"    ? number(value, options.bytes)
                          : option == "--repeat" ? number(value, options.repeat)
                                                 : option == "--only" && !value.empty();
        if (!good) {
            std::cerr << "usage: porttool_growth [--bytes N] [--repeat N] [--only PART]...\n";
            std::exit(2);
        }
        if (option == "--only") options.only.push_back(value);
    }
    return options;
}

/// On one processor, where no two threads count at once.
void stay_on_one_processor() {
    cpu_set_t here;
    CPU_ZERO(&here);
    CPU_SET(static_cast<size_t>(std::max(0, sched_getcpu())), &here);
    sched_setaffinity(0, sizeof(here), &here);
}

bool run(const Options& options) {
    std::puts(
        "| command | construct | bytes | steps of twice that | growth | of bytes allocated | s | of time | |\n"
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |");
    std::vector<Row> all;
    for (const Construct& construct : read_constructs(CONSTRUCTS)) {
        const auto is_named = [&](const std::string& part) { return construct.name.find(part) != std::string::npos; };
        if (!options.only.empty() && std::none_of(options.only.begin(), options.only.end(), is_named)) continue;
        for (Row& row : rows_of(construct, options)) {
            print(row);
            all.push_back(std::move(row));
        }
    }
    print_worst(all, "steps", [](const Row& row) { return row.steps(); });
    print_worst(all, "bytes allocated", [](const Row& row) { return row.allocated(); });
    print_worst(all, "time", [](const Row& row) { return row.time(); });
    return std::all_of(all.begin(), all.end(), [](const Row& row) { return row.is_linear(); });
}

}  // namespace
}  // namespace porttool::testing

int main(int argc, char** argv) {
    using namespace porttool::testing;
    const Options options = parse(argc, argv);
    stay_on_one_processor();
    return run(options) ? 0 : 1;
}
