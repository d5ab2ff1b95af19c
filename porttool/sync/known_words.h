// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/language/language.h"
#include "porttool/scan/unit.h"
#include "porttool/sync/launch_manner.h"

namespace porttool {

/// The words of all files of one side, read when they are first asked for.
class SideWords {
public:
    using Uses = std::map<std::string_view, size_t>;  ///< a word, and how often it is used
    using ByMeaning = std::map<std::string, Uses, std::less<>>;
    using Words = std::unordered_set<std::string_view>;

    /// Both must outlive it.
    SideWords(const std::vector<ScannedFile>& files, const Dialect& dialect) : files_(files), dialect_(dialect) {}
    const std::vector<ScannedFile>& files() const { return files_; }

    /// All but names that mean something in one function alone.
    const Words& known() const;
    const ByMeaning& by_meaning() const;
    /// What the side declares: units, macros, variables of files, fields.
    const Words& declared() const;

    /// Names that mean something in every function: of functions, types, macros, variables, enumerators; no fields.
    const Words& bare() const;

    static void add_bare(const ScannedFile& file, Words& words);
    static void add_known(const ScannedFile& file, Words& words);
    static void note(const ScannedFile& file, const Dialect& dialect, ByMeaning& by_meaning);

private:
    void read() const;

    const std::vector<ScannedFile>& files_;
    const Dialect& dialect_;
    mutable ByMeaning by_meaning_;
    mutable Words known_, declared_, bare_;
    mutable bool read_ = false, declared_read_ = false, bare_read_ = false;
};

/// The words of one side, and the file of it that an edit is in.
struct WordsOfSide {
    const SideWords& all;
    const ScannedFile& edited;
};

/// What a port may be written in: the words that the target's side uses, and those that both sides have from elsewhere,
/// as a library's. What the source declares itself is not known there.
class KnownWords {
public:
    /// All must outlive it.
    KnownWords(const WordsOfSide& from, const WordsOfSide& to, const Dialect& dialect);

    bool in_file(std::string_view word) const { return file_words_.contains(word); }
    /// True for a language without casts in C's manner.
    bool lacks_casts() const { return to_.edited.language == Language::Glsl; }
    /// True for a language whose types have functions of their own.
    bool has_methods() const {
        const Language language = to_.edited.language;
        return language != Language::C && language != Language::OpenCl && language != Language::Glsl &&
               language != Language::Ispc;
    }
    /// True for `double` where the target's language is one of devices, of which many have none, and the source's is
    /// not.
    bool may_lack(std::string_view type) const {
        return type == "double" && there().is_of_devices && !traits_of(from_.edited.language).is_of_devices;
    }
    /// True for a language that has the standard library of C++.
    bool has_std() const { return there().std_library; }
    /// True where the source's `(float4)(a, b)`, one value of several parts, is `float4(a, b)` in the target's
    /// language.
    bool constructs_vectors() const {
        const Language here = from_.edited.language, there = to_.edited.language;
        return here == Language::OpenCl && there != Language::OpenCl && there != Language::C &&
               there != Language::Cuda && there != Language::Hip && there != Language::Ispc;
    }
    /// What opens a value of several parts of a type after what stands for `(T)` or `T`, as the target's file writes
    /// it or, of a type that it declares variables of, as its language has it: "{" or "("; "" where nothing tells.
    std::string opens_literal(std::string_view type) const;
    /// True for one with C's literals of structs, `(T){1, 2}`.
    bool has_literals() const { return to_.edited.language == Language::C || to_.edited.language == Language::OpenCl; }
    /// True where a real number without a mark is a float in the source's language and none in the target's.
    bool needs_float_marks() const {
        return traits_of(from_.edited.language).literals == Literals::Shading &&
               traits_of(to_.edited.language).literals == Literals::C;
    }
    /// True for a file of a language of devices whose real numbers are all marked as floats.
    bool marks_reals() const;
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
    /// True where both files may call what a library has: host code of one family of languages.
    bool are_both_cpp() const { return traits_of(from_.edited.language).c_libraries && there().c_libraries; }
    /// True for a qualifier that both languages have, whether the target's file uses it or not.
    bool is_qualifier_of_both(std::string_view word) const;
    /// True where both files may include the same headers of the project.
    bool share_headers() const { return are_both_cpp() || are_of_one_language(); }
    /// True for what any file of the target's side has, but for names of one function.
    bool is_known_there(std::string_view word) const { return to_.all.known().contains(word); }
    /// True for a text that speaks of the source's platform, or of what its file is called and the target's is not.
    bool names_one_side(std::string_view literal) const;
    bool stands_bare(std::string_view word) const { return to_.all.bare().contains(word); }
    /// True for what the target's side has within functions or as a field, and nowhere else.
    bool is_only_local(std::string_view word) const;
    bool is_declared_there(std::string_view word) const { return to_.all.declared().contains(word); }
    /// True for a name that no file of either side declares, and no language has of itself.
    bool is_declared_nowhere(std::string_view word) const;
    /// The same of one that is none of a language's run time.
    bool is_from_elsewhere(std::string_view word) const;
    /// True for what an `#ifdef` may ask for on either side.
    bool is_macro_of_build(std::string_view word) const;
    /// A word of CUDA's run time in HIP's manner, or the other way round, where the target's file has that alone.
    std::string in_sister_runtime(std::string_view word) const;
    /// True for a method of the standard library of C++, where both have that and no type of the source has one so.
    bool is_standard_method(std::string_view word) const;
    /// True for a constant that neither side declares, of a family whose others both files have under one name: with
    /// `GGML_OP_NORM` and `GGML_OP_ADD` in both, `GGML_OP_SUB` is from where these are.
    bool is_of_shared_family(std::string_view word) const;
    /// True if the target's file says a name of `std` without that, or may say each so.
    bool is_there_without_scope(std::string_view word) const;
    /// The scope that words of the target call every built-in in, as `sycl ::`; none where they call one otherwise.
    std::vector<std::string> scope_of_builtins(const std::vector<std::string>& words) const;
    /// True for a function that languages have of themselves, which no file of the target declares.
    bool is_builtin(const std::string& word) const;
    /// True if any file of the side has it, or both sides have it from elsewhere.
    bool anywhere(std::string_view word) const;
    /// How the target's file starts kernels.
    const LaunchManner& launches() const { return launches_; }
    bool are_of_one_language() const { return from_.edited.language == to_.edited.language; }

private:
    using Uses = SideWords::Uses;

    void add_name(TokenRange parameter);
    const LanguageTraits& there() const { return traits_of(to_.edited.language); }
    bool is_in_source_file(std::string_view word) const;
    bool speaks(std::string_view runtime) const;
    bool scopes_builtins() const;
    bool uses_std() const;
    size_t times_literal_opens(std::string_view type, std::string_view bracket) const;
    static std::string usual(const Uses* words);

    WordsOfSide from_, to_;
    const Dialect& dialect_;
    LaunchManner launches_;
    SideWords::Words file_words_, called_, parameters_;
    SideWords::ByMeaning by_meaning_;             ///< of the edited file
    mutable std::set<std::string_view> shouted_;  ///< constants that both files have and neither side declares
    mutable bool shouted_read_ = false;
};

}  // namespace porttool
