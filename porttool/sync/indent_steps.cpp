// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/indent_steps.h"

#include <algorithm>

namespace porttool {

IndentSteps::IndentSteps(const LexedText& text) {
    size_t before = 0;
    for (const uint32_t start : text.line_starts) count_line(text.text, start, before, true);
}

/// `before`: the blanks of the last line that has more than these, and then of this one. False for one that has not.
bool IndentSteps::count_line(std::string_view text, size_t start, size_t& before, bool adds) {
    const auto note = [&](size_t& number) { adds ? ++number : --number; };
    size_t blanks = 0;
    while (start + blanks < text.size() && text[start + blanks] == ' ') ++blanks;
    if (start < text.size() && text[start] == '\t') note(tabs_);
    if (start + blanks >= text.size() || text[start + blanks] == '\n') return false;
    if (blanks >= before + 2 && blanks - before <= kMostBlanks) note(steps_.at(blanks - before));
    before = blanks;
    return true;
}

void IndentSteps::count(std::string_view text, size_t first, size_t end, bool adds) {
    size_t before = 0;
    for (size_t at = first; at > 0;) {
        const size_t last = at < 2 ? std::string_view::npos : text.rfind('\n', at - 2);
        at = last == std::string_view::npos ? 0 : last + 1;
        const size_t word = std::min(text.find_first_not_of(' ', at), text.size());
        if (word == text.size() || text[word] == '\n') continue;
        before = word - at;
        break;
    }
    for (size_t start = first; start < text.size();) {
        // The first line behind them steps from the last of them.
        if (count_line(text, start, before, adds) && start >= end) break;
        const size_t line_end = text.find('\n', start);
        start = line_end == std::string_view::npos ? text.size() : line_end + 1;
    }
}

std::string IndentSteps::unit() const {
    size_t best = 4, most = 0;
    for (size_t step = 2; step < steps_.size(); ++step)
        if (steps_[step] > most) {
            best = step;
            most = steps_[step];
        }
    return tabs_ > most ? "\t" : std::string(best, ' ');
}

std::string indent_unit(const LexedText& text) { return IndentSteps(text).unit(); }

}  // namespace porttool
