// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// The files of one side, and the one of them that an edit is in.
struct FilesOfSide {
    const std::vector<ScannedFile>& all;
    const ScannedFile& edited;
};

/// What a port may be written in: the words that the target's side uses, and those that both sides have from elsewhere,
/// as a library's. What the source declares itself is not known there.
class KnownWords {
public:
    /// All must outlive it.
    KnownWords(const FilesOfSide& from, const FilesOfSide& to, const Dialect& dialect);

    bool in_file(std::string_view word) const { return file_words_.contains(word); }
    /// True for a language without casts in C's manner.
    bool lacks_casts() const { return to_.edited.language == Language::Glsl; }
    /// True for a language whose types have functions of their own.
    bool has_methods() const {
        const Language language = to_.edited.language;
        return language != Language::C && language != Language::OpenCl && language != Language::Glsl &&
               language != Language::Ispc;
    }
    /// True for one with C's literals of structs, `(T){1, 2}`.
    bool has_literals() const { return to_.edited.language == Language::C || to_.edited.language == Language::OpenCl; }
    /// True where a real number without a mark is a float in the source's language and none in the target's.
    bool needs_float_marks() const {
        return traits_of(from_.edited.language).literals == Literals::Shading &&
               traits_of(to_.edited.language).literals == Literals::C;
    }
    /// What a word means in any language; "" if it has no counterpart elsewhere.
    std::string meaning(const std::string& word) const {
        const std::string* known = dialect_.meaning(word);
        return known == nullptr ? word : *known;
    }
    /// The word that the target's file uses for what means the same by the dialect, as a function or not; "" if none or
    /// several do.
    std::string in_dialect(std::string_view word, bool called) const;
    /// The same name in the target's manner (`base_color`, `baseColor`), if it stands somewhere there; else "".
    std::string in_other_manner(std::string_view word) const;
    /// True for what a file of the source's side declares.
    bool is_of_source(std::string_view word) const;
    /// True if any file of the side has it, or both sides have it from elsewhere.
    bool anywhere(std::string_view word) const;

private:
    using Uses = std::map<std::string_view, size_t>;  ///< a word, and how often it is used

    /// Adds a file's words, without names that mean something in one function alone.
    static void add_known(const ScannedFile& file, std::unordered_set<std::string_view>& words);
    void note(const ScannedFile& file, std::map<std::string, Uses, std::less<>>& by_meaning) const;
    void read_all() const;
    void read_own() const;
    bool speaks(std::string_view runtime) const;
    bool scopes_builtins() const;
    static std::string usual(const Uses* words);

    FilesOfSide from_, to_;
    const Dialect& dialect_;
    std::unordered_set<std::string_view> file_words_, called_;
    std::map<std::string, Uses, std::less<>> by_meaning_;  ///< of the edited file
    // Read when first asked for.
    mutable std::map<std::string, Uses, std::less<>> all_by_meaning_;
    mutable std::unordered_set<std::string_view> all_words_, own_words_;
    mutable bool all_read_ = false, own_read_ = false;
};

}  // namespace porttool
