// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// A line that gives a word of code another meaning.
struct WordMacro {
    std::string text;  ///< `#define sinf __sinf`; of a macro that is a unit itself only `#define fma ...`
    std::string_view file;
    uint32_t line = 1;
};

/// What the macros of a side make of the words of its units: those of a unit's file and of what that includes of the
/// same side, by whatever steps. A unit says something else where they change, though it was not edited:
///
///     now also  #define sinf __sinf           of()  "" before, "sinf:8c0e6a41" now
///     as ever   float f(float x) { return sinf(x); }
///
/// A macro with a value or parameters is a unit (scan/constants.h), whose edits are judged as such: here it counts that
/// it is there. One in the place of a keyword, which is news by itself, and one that only says how functions are called
/// or linked do not count.
class WordMacros {
public:
    /// `files`: all of the side; they must outlive it.
    explicit WordMacros(const std::vector<ScannedFile>& files);

    /// The words of a text that macros seen from `path` define, each with a hash of what they make of it, sorted:
    /// `fma:0a1b2c3d sinf:8c0e6a41`; "-" for none. More than 64 are one hash, `*:0a1b2c3d`.
    std::string of(const std::string& path, const NormalText& text);

    /// The macros of that name which a file sees, by file and line.
    std::vector<WordMacro> seen_from(const std::string& path, std::string_view word);

private:
    using Files = std::vector<bool>;  ///< by their places in `files_`
    struct Definition {
        const ScannedFile* file;
        const Directive* directive;
        bool is_unit;
    };

    void read(const ScannedFile& file);
    bool sees(const std::string& path, const ScannedFile* file);
    const Files& seen_files(const std::string& path);
    std::vector<const ScannedFile*> included_by(const ScannedFile& file);
    static std::string text_of(const Definition& definition);

    const std::vector<ScannedFile>& files_;
    std::unordered_map<std::string_view, std::vector<Definition>> by_word_;
    std::unordered_map<std::string_view, const ScannedFile*> by_path_;               ///< filled when first asked
    std::unordered_map<std::string_view, std::vector<const ScannedFile*>> by_name_;  ///< by the last part of the path
    std::unordered_map<const ScannedFile*, std::vector<const ScannedFile*>> includes_;
    std::unordered_map<std::string, Files> seen_;
};

/// The parts of what WordMacros::of() gave: the hash by the word.
std::map<std::string_view, std::string_view> words_with_macros(std::string_view words);

}  // namespace porttool
