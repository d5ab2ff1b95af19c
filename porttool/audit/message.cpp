// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/message.h"

#include <algorithm>
#include <array>
#include <string>

#include "porttool/text/letters.h"

namespace porttool {
namespace {

/// True if one of the words begins at the start of a word of the text.
template <size_t N>
bool speaks_of(const std::string& text, const std::array<std::string_view, N>& words) {
    return std::any_of(words.begin(), words.end(), [&](std::string_view word) {
        for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1))
            if (at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0) return true;
        return false;
    });
}

constexpr std::array<std::string_view, 37> kFix = {
    "fix",       "bug",        "wrong",   "incorrect", "correct",  "nan",          "overflow",     "underflow",
    "race",      "off by",     "off-by",  "typo",      "crash",    "precision",    "error in",     "hang",
    "leak",      "broken",     "missing", "mistake",   "invalid",  "out of bound", "out-of-bound", "divi",
    "undefined", "uninitiali", "regress", "issue",     "artifact", "failure",      "should be",    "accura",
    "inf ",      "workaround", "oops",    "repair",    "segfault"};
constexpr std::array<std::string_view, 36> kManner = {
    "rewrit",  "rewrote",  "rework",   "restructur",  "migrat",  "switch to",  "unify",    "extract",   "measure",
    "profil",  "compil",   "build",    "support for", "port to", "refactor",   "cleanup",  "clean up",  "clean-up",
    "rename",  "reformat", "format",   "style",       "indent",  "whitespace", "license",  "copyright", "comment",
    "warning", "move",     "reorgani", "merge",       "sync",    "tidy",       "cosmetic", "simplif",   "review"};
constexpr std::array<std::string_view, 19> kSpeed = {
    "simd", "bandwidth", "throughput", "prefetch", "coalesc", "optimi", "speed",     "perf",   "faster", "unroll",
    "tune", "tuning",    "occupancy",  "register", "vectori", "cache",  "benchmark", "inline", "latency"};

/// What is mended there is the build, not what the code does.
constexpr std::array<std::string_view, 7> kBuild = {"compil", "build",    "driver",   "warning",
                                                    "script", "makefile", "dependenc"};

/// What is mended there may have been wrong there alone.
constexpr std::array<std::string_view, 38> kPlatform = {
    "platform", "opencl", "cuda",   "hip ",    "sycl",    "metal",  "vulkan", "gpu",      "opengl", "cpu",
    "os x",     "osx",    "mac",    "windows", "msvc",    "gcc",    "clang",  "intel",    "amd",    "arm",
    "nvidia",   "x86",    "sse",    "avx",     "neon",    "openmp", "rocm",   "dpcpp",    "oneapi", "navi",
    "gfx",      "volta",  "ampere", "pascal",  "maxwell", "kepler", "hopper", "lock step"};

/// What is mended there is no matter for a type of more digits.
constexpr std::array<std::string_view, 4> kFewDigits = {"single precision", "single-precision", "float precision",
                                                        "float's precision"};

/// What is mended there cannot be wrong where one thread does it all.
constexpr std::array<std::string_view, 8> kThreads = {"race",     "racing",   "atomic",      "deadlock",
                                                      "synchron", "barrier ", "thread safe", "thread-safe"};

/// Without the `cuda:` or `[cuda]` at its start: so some mark all that they do there.
std::string without_tag(const std::string& text) {
    constexpr size_t kLongest = 24;
    const size_t end = text.starts_with("[") ? text.find(']') : text.find(':');
    return end == std::string::npos || end > kLongest ? text : text.substr(end + 1);
}

}  // namespace

MessageSays read_message(std::string_view message) {
    const std::string text = in_small_letters(message);
    const std::string first = text.substr(0, text.find('\n'));
    MessageSays out{
        .fix = speaks_of(first, kFix), .manner = speaks_of(first, kManner), .speed = speaks_of(first, kSpeed)};
    out.platform = speaks_of(without_tag(first), kPlatform) || speaks_of(text, kFewDigits);
    out.threads = speaks_of(first, kThreads);
    if (speaks_of(first, kBuild)) {
        out.fix = false;
        out.manner = true;
    }
    if (!out.fix && !out.manner && !out.speed) out.fix = out.in_text = speaks_of(text, kFix);
    return out;
}

}  // namespace porttool
