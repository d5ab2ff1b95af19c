// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/normal/locals.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// A function's text with numbers for its locals: `float x` is `float %1`. The words of its numbers live in it.
class NumberedText {
public:
    explicit NumberedText(const Words& text) : words_(text) {
        const std::vector<size_t> locals = local_numbers(text);
        if (locals.empty()) return;
        numbers_.reserve(text.size());  // no word moves
        for (size_t i = 0; i < text.size(); ++i)
            if (locals[i] != 0) words_[i] = numbers_.emplace_back("%" + std::to_string(locals[i]));
    }
    NumberedText(const NumberedText&) = delete;
    NumberedText& operator=(const NumberedText&) = delete;

    const Words& words() const { return words_; }

private:
    Words words_;
    std::vector<std::string> numbers_;
};

}  // namespace porttool
