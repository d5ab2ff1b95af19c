// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "porttool/normal/unit_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// A line of a file that gives a word of code another meaning.
struct MacroLine {
    std::string word;  ///< behind `=` where the line is a declaration: see declared_lines()
    std::string text;  ///< `#define sinf __sinf`; of a macro that is a unit itself only `#define fma ...`
    uint32_t line = 1;
};

/// What WordMacros asks of a file.
struct FileMacros {
    std::string path;
    std::vector<MacroLine> lines;       ///< in order
    std::vector<std::string> includes;  ///< what stands between the quotes or angles of its `#include`s, in order
};

FileMacros file_macros(const ScannedFile& file);

/// Of all files of a side.
std::vector<FileMacros> file_macros(const std::vector<ScannedFile>& files);

/// A line that gives a word of code another meaning.
struct WordMacro {
    std::string_view text;  ///< that of the MacroLine
    std::string_view file;
    uint32_t line = 1;
};

/// What the macros of a side make of the words of its units: those of a unit's file and of what that includes of the
/// same side, by whatever steps. A unit says something else where they change, though it was not edited:
///
///     now also  #define sinf __sinf           of()  "" before, "sinf:8c0e6a417b2d9f03" now
///     as ever   float f(float x) { return sinf(x); }
///
/// A macro with a value or parameters is a unit (scan/constants.h), whose edits are judged as such: here it counts that
/// it is there. One that only says how functions are called or linked does not count.
class WordMacros {
public:
    /// `files`: all of the side.
    explicit WordMacros(std::vector<FileMacros> files);
    WordMacros(const WordMacros&) = delete;
    WordMacros& operator=(const WordMacros&) = delete;
    WordMacros(WordMacros&&) = default;
    WordMacros& operator=(WordMacros&&) = default;

    /// The words of a text that macros seen from `path` define, each with a hash of what they make of it, sorted:
    /// `+ fma:0a1b2c3d4e5f6071 sinf:8c0e6a417b2d9f03`; "+" for none. More than 64 are one hash, `*:0a1b2c3d4e5f6071`,
    /// but for keywords and types of C, which stand behind. Without the plus: as it was noted when those did not count.
    /// Takes time in line with the text, whatever there is of definitions: those of a word are looked through once for
    /// each file.
    /// Behind that what the file and those it includes declare of words of the text, and of the words that these
    /// declarations use in turn, `=gain:5f0c6a417b2d9e03`, if anything; many are one, too.
    std::string of(const std::string& path, const UnitText& text);

    /// The first macro of that name which a file sees, by file and line; behind `=` the first declaration.
    std::optional<WordMacro> first_seen(const std::string& path, std::string_view word);

    /// True if what is declared of one word uses the other, by whatever steps: `const float gain = 2 * base;`.
    bool leads_to(std::string_view word, std::string_view other);

    /// True if a file includes another of the side, by whatever steps, as far as can be said.
    bool sees(const std::string& path, const std::string& included);

private:
    struct Definition {
        uint32_t file;  ///< by its place in `files_`
        const MacroLine* line;
    };
    /// Hashes of those of one word in one file, or one of them all where there are many.
    struct InFile {
        uint32_t file;
        size_t first;  ///< of `definitions`
        std::set<std::string> hashes;
    };
    struct Word {
        std::vector<Definition> definitions;
        std::vector<InFile> by_file;  ///< sorted; filled when first asked
        std::string hash_of_all;      ///< the same
        std::optional<std::vector<std::string_view>>
            used;  ///< words that its declarations use; filled when first asked
    };
    /// Files by their places in `files_`, sorted; all of them where more than a bound were to be followed.
    struct Files {
        bool all = false;
        std::vector<uint32_t> numbers;
    };

    static void sort_by_file(Word& defined);
    static std::string hash_in_order(const Word& defined, const InFile& in);
    const std::vector<std::string_view>& used_by(Word& declared);
    std::string hash_seen(const std::string& path, Word& defined);
    std::vector<const InFile*> seen_in(const std::string& path, Word& defined);
    const Files& seen_files(const std::string& path);
    const Files& included_by(uint32_t file);
    void index_paths();

    /// Tells most words that are no macros apart from those that may be, for less than a look into a table.
    class Sieve {
    public:
        void add(std::string_view word) { bits_[place(word)] = true; }
        bool may_have(std::string_view word) const { return bits_[place(word)]; }

    private:
        static constexpr int kBits = 17;
        static size_t place(std::string_view word);
        std::vector<bool> bits_ = std::vector<bool>(size_t{1} << kBits);
    };

    std::vector<FileMacros> files_;
    std::unordered_map<std::string_view, Word> by_word_, declared_;
    Sieve sieve_;                                                ///< of the keys of by_word_
    std::unordered_map<std::string_view, uint32_t> by_path_;     ///< filled when first asked
    std::vector<std::pair<std::string, uint32_t>> by_path_end_;  ///< by the path from its end, sorted
    std::unordered_map<uint32_t, Files> includes_;
    std::unordered_map<std::string, Files> seen_;
    size_t seen_numbers_ = 0;                                                                    ///< that seen_ holds
    std::unordered_map<std::string, std::unordered_map<std::string_view, std::string>> hashes_;  ///< of path and word
};

/// True for what WordMacros::of() gives today, false for what was noted without keywords and types.
constexpr bool counts_keywords(std::string_view words) { return words.starts_with('+'); }

/// True if words stand in it for what files declare of them.
constexpr bool counts_declared(std::string_view words) { return words.find(" =") != std::string_view::npos; }

/// What WordMacros::of() gave as it was noted without what files declare.
std::string without_declared(std::string_view words);

/// What WordMacros::of() gave as it was noted without keywords and types; "-" for none.
std::string without_keywords(std::string_view words);

/// The parts of what WordMacros::of() gave: the hash by the word.
std::map<std::string_view, std::string_view> words_with_macros(std::string_view words);

}  // namespace porttool
