// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// porttool_fuzz KIND [--seed FIRST] [--runs N] [--seconds CAP] [--save FOLDER]: runs the inputs of N seeds, see
// fuzz.sh.
//
// Exit 0: all held; 1: one did not, crashed or took longer than CAP. Then its seed is on stderr and its files lie in
// FOLDER/KIND-SEED; `--seed SEED --runs 1` runs it again. Ctrl-C and SIGTERM end it after the input at work, with exit
// 1 and the seed at which to go on.
#include <sys/time.h>
#include <unistd.h>

#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "tests/porttool/fuzz_inputs.h"

/// There under sanitizers: what they call before they end the program.
extern "C" void __sanitizer_set_death_callback(void (*callback)()) __attribute__((weak));

namespace porttool::testing {
namespace {

struct Arguments {
    std::string kind_name;
    uint64_t first = 0, runs = 1000;
    unsigned seconds =
        20;  ///< of processor time for one input, a hundred times what the slowest takes under sanitizers
    std::string save = "fuzz-failures";
};

/// What runs now; read when the program dies.
struct Current {
    Arguments arguments;
    uint64_t seed = 0;
    const FuzzInput* input = nullptr;
};
Current current;
volatile std::sig_atomic_t is_ended = 0;

void save_input() {
    namespace fs = std::filesystem;
    const fs::path folder =
        fs::path(current.arguments.save) / (current.arguments.kind_name + "-" + std::to_string(current.seed));
    std::error_code error;
    fs::create_directories(folder, error);
    for (const auto& [path, text] : *current.input) {
        std::string name = path.substr(path.starts_with("/r/") ? 3 : 0);
        for (char& letter : name)
            if (letter == '/') letter = '_';
        std::ofstream(folder / name, std::ios::binary) << text;
    }
    std::cerr << "porttool_fuzz: its files are in " << folder.string() << std::endl;
}

/// Names the input that the program died of. Once: what it calls may die in its turn.
void report_death() {
    if (current.input == nullptr) return;
    std::cerr << "\nporttool_fuzz: died on " << current.arguments.kind_name << " seed " << current.seed << std::endl;
    alarm(5);
    save_input();
    current.input = nullptr;
}

extern "C" void on_signal(int signal) {
    std::signal(signal, SIG_DFL);
    std::signal(SIGALRM, SIG_DFL);
    std::signal(SIGPROF, SIG_DFL);
    if (signal == SIGALRM || signal == SIGPROF) std::fputs("porttool_fuzz: longer than its time cap\n", stderr);
    report_death();
    _exit(1);
}

extern "C" void on_end(int) { is_ended = 1; }

/// Ends the program after so many seconds of processor time, as what runs beside a low priority may take all of the
/// machine; or, for what hangs without any, after many times that. 0 takes the cap back.
void set_cap(unsigned seconds) {
    constexpr unsigned kWaiting = 60;
    itimerval timer{};
    timer.it_value.tv_sec = seconds;
    setitimer(ITIMER_PROF, &timer, nullptr);
    alarm(seconds * kWaiting);
}

uint64_t number(const char* text) {
    uint64_t value = 0;
    const auto [end, error] = std::from_chars(text, text + std::strlen(text), value);
    if (error != std::errc() || *end != '\0') {
        std::cerr << "porttool_fuzz: expected a number, not '" << text << "'\n";
        std::exit(2);
    }
    return value;
}

Arguments parse(int count, char** texts) {
    Arguments out;
    if (count >= 2) out.kind_name = texts[1];
    bool good = count >= 2 && count % 2 == 0 && fuzz_kind(texts[1]).has_value();
    for (int i = 2; good && i < count; i += 2) {
        const std::string option = texts[i];
        if (option == "--seed")
            out.first = number(texts[i + 1]);
        else if (option == "--runs")
            out.runs = number(texts[i + 1]);
        else if (option == "--seconds")
            out.seconds = static_cast<unsigned>(number(texts[i + 1]));
        else if (option == "--save")
            out.save = texts[i + 1];
        else
            good = false;
    }
    if (good) return out;
    std::cerr
        << "usage: porttool_fuzz source|map|lock|base [--seed FIRST] [--runs N] [--seconds CAP] [--save FOLDER]\n";
    std::exit(2);
}

/// Runs them all; true if all ran and held. A fault does not end the run: there may be more.
bool run_all(FuzzKind kind) {
    const Arguments& arguments = current.arguments;
    bool good = true;
    double slowest = 0;
    uint64_t done = 0;
    for (; done < arguments.runs && is_ended == 0; ++done) {
        const uint64_t seed = arguments.first + done;
        const FuzzInput input = fuzz_input(kind, seed);
        current.seed = seed;
        current.input = &input;
        set_cap(arguments.seconds);
        const auto start = std::chrono::steady_clock::now();
        const std::string fault = fuzz_fault(kind, input, seed);
        slowest = std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        set_cap(0);
        if (!fault.empty()) {
            std::cerr << arguments.kind_name << " seed " << seed << ": " << fault << std::endl;
            save_input();
            good = false;
        }
        current.input = nullptr;
        if ((done + 1) % 10'000 == 0)
            std::cerr << arguments.kind_name << ": " << done + 1 << " runs, next seed " << seed + 1 << std::endl;
    }
    std::cout << arguments.kind_name << ": " << done << " runs from seed " << arguments.first
              << (good ? ", all held" : ", FAILED") << "; the slowest took " << slowest << " s";
    if (done < arguments.runs) std::cout << "; ended, next seed " << arguments.first + done;
    std::cout << std::endl;
    return good && done == arguments.runs;
}

}  // namespace
}  // namespace porttool::testing

int main(int argc, char** argv) {
    using namespace porttool::testing;
    current.arguments = parse(argc, argv);
    for (const int signal : {SIGALRM, SIGPROF}) std::signal(signal, on_signal);
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_end);
    if (__sanitizer_set_death_callback != nullptr)
        __sanitizer_set_death_callback(report_death);
    else
        for (const int signal : {SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL}) std::signal(signal, on_signal);
    return run_all(*fuzz_kind(current.arguments.kind_name)) ? 0 : 1;
}
