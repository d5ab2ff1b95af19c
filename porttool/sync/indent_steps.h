// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "porttool/scan/token.h"

namespace porttool {

/// How the lines of a text step in, counted; where lines become others, these alone are counted anew.
class IndentSteps {
public:
    explicit IndentSteps(const LexedText& text);
    /// Takes out what the lines in bytes [first, end) of a text say, with the step behind them; or puts it back in.
    void remove(std::string_view text, size_t first, size_t end) { count(text, first, end, false); }
    void add(std::string_view text, size_t first, size_t end) { count(text, first, end, true); }
    /// Blanks, or a tab.
    std::string unit() const;

private:
    static constexpr size_t kMostBlanks = 8;
    void count(std::string_view text, size_t first, size_t end, bool adds);
    bool count_line(std::string_view text, size_t start, size_t& before, bool adds);

    std::array<size_t, kMostBlanks + 1> steps_{};  ///< by their blanks
    size_t tabs_ = 0;
};

/// How a file indents its blocks: blanks, or a tab.
std::string indent_unit(const LexedText& text);

}  // namespace porttool
