// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/console.h"

#include "metrics/text/visible.h"

namespace application {
namespace {

constexpr const char* RED = "\033[1;31m";
constexpr const char* YELLOW = "\033[1;33m";
constexpr const char* PLAIN = "\033[0m";

}  // namespace

bool use_color(ColorMode mode, bool is_terminal, const char* no_color) {
    if (mode != ColorMode::automatic) return mode == ColorMode::always;
    return is_terminal && (no_color == nullptr || *no_color == '\0');
}

Console::Console(const Options& options, bool color, bool is_terminal)
    : quiet_(options.quiet),
      verbose_(options.verbose),
      color_(color),
      progress_(!options.quiet && (is_terminal || options.progress)) {}

void Console::line(const char* color, const std::string& label, const std::string& message) {
    progress("");
    const bool colored = color_ && color != nullptr;
    const std::string head = label.empty() ? "" : label + ": ";
    const std::string text = (colored ? color + head + PLAIN : head) + metrics::visible_lines(message) + "\n";
    std::fputs(text.c_str(), stderr);
}

void Console::error(const std::string& message) { line(RED, "pathtracer: error", message); }

void Console::warning(const std::string& message) {
    if (!quiet_) line(YELLOW, "warning", message);
}

void Console::note(const std::string& message) {
    if (!quiet_) line(nullptr, "", message);
}

void Console::detail(const std::string& message) {
    if (verbose_) line(nullptr, "", message);
}

void Console::result(const std::string& text) {
    progress("");
    std::fputs(text.c_str(), stdout);
    std::fflush(stdout);
}

void Console::progress(const std::string& text) {
    if (text.empty() && progress_width_ == 0) return;
    std::string padded = "\r" + text;
    if (text.size() < progress_width_) padded.append(progress_width_ - text.size(), ' ');
    if (text.empty()) padded += "\r";
    progress_width_ = text.size();
    std::fputs(padded.c_str(), stderr);
    std::fflush(stderr);
}

}  // namespace application
