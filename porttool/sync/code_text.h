// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/sync/translator.h"

namespace porttool {

/// Whether a brace stands on a line of its own; Unknown where a file has none, or has both.
enum class BraceLine : uint8_t { Unknown, Same, Own };

/// How a file breaks its lines at braces.
struct BraceManner {
    BraceLine head = BraceLine::Unknown;     ///< after a function's head
    BraceLine control = BraceLine::Unknown;  ///< within its body
};
BraceManner brace_manner(const ScannedFile& file);

/// Tokens of one file as words, and how they are written there.
struct CodeWords {
    const ScannedFile& file;
    uint32_t first;  ///< the token that words[0] is
    std::vector<std::string> words;
    std::string written(size_t i) const { return std::string(file.lexed.view(first + static_cast<uint32_t>(i))); }
};
CodeWords code_words(const ScannedFile& file, TokenRange tokens);

/// Carried words as code: spaced, broken into lines and commented as the source has them, with braces in the manner of
/// the other file.
std::string code_text(const CodeWords& source, const std::vector<CarriedWord>& words, const BraceManner& there);

/// Lines that are indented by steps of `from` and begin at `base`, with steps of `to`, beginning at `new_base`. The
/// first line begins where it is put.
std::string indented(const std::string& code, const std::string& from, size_t base, const std::string& to,
                     const std::string& new_base);

}  // namespace porttool
