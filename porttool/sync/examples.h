// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/compare/alignment.h"
#include "porttool/compare/statement_patterns.h"

namespace porttool {

/// How one side says what the other says, learned from pairs that are in step.
///
///     source    i = get_global_id ( 0 ) ;              info -> x * 2
///     target    i = item . get_global_id ( 2 ) ;       x * 2
///     learned   get_global_id ( 0 ) -> item . get_global_id ( 2 )        info -> x  ->  x
class Examples {
public:
    static constexpr size_t kLongest = 12;  ///< words of a phrase

    /// Takes what two texts that stand for each other say alike.
    void learn(const AlignedText& source, const AlignedText& target, const Alignment& alignment);

    /// The longest phrase known from words[at] on, as the target says it.
    struct Phrase {
        size_t length = 0;  ///< in words of the source; 0 if none is known
        std::vector<std::string> target;
    };
    /// `in_head`: of a function's head, where an address space may be another one than in a body.
    Phrase longest(const std::vector<std::string>& words, size_t at, size_t end, bool in_head = false) const;

    /// Takes statements that say the same of one name each.
    void learn_patterns(const AlignedText& source, const AlignedText& target, const Alignment& alignment) {
        patterns_.learn(source, target, alignment);
    }
    const StatementPatterns& patterns() const { return patterns_; }

    /// Takes what a unit and its port are called: names that tell of their parts as all others do.
    void learn_name(const std::string& source, const std::string& target) { note_part(source, target); }

    /// True for a phrase that the target says in several ways, however often each.
    bool is_said_variously(const std::string& word) const;

    /// How the target writes a number that the source writes so: with or without the mark of a float or of an unsigned.
    std::string number(std::string_view written) const;
    /// True if a number with that mark was seen.
    bool knows_mark_of(std::string_view written) const;
    /// A real number with the mark of a float.
    static std::string marked(const std::string& written);

    /// A name that begins as names do which the target begins otherwise: where `hipFree` and `hipMalloc` are `cudaFree`
    /// and `cudaMalloc`, `hipMemset` is `cudaMemset`. "" if there is no such rule.
    std::string renamed(std::string_view word) const;
    /// A name with a part in it that the target calls otherwise in all names: where `copy_cpu` and `mutable_cpu_data`
    /// are `copy_gpu` and `mutable_gpu_data`, `gemm_cpu` is `gemm_gpu`. "" if there is no such rule.
    std::string with_other_part(std::string_view word) const;
    /// A name with a prefix of one letter, `m_rate`, in the manner of those that the target calls otherwise; the same
    /// where nothing tells, "" where one name alone does.
    std::string with_prefix_there(std::string_view word) const;
    /// A name that begins as names do which have one part more there: where `blas_add` and `blas_mul` are
    /// `blas_gpu_add` and `blas_gpu_mul`, `blas_set` is `blas_gpu_set`. "" where some have and others have not; nothing
    /// where none has.
    std::optional<std::string> with_part_gained(std::string_view word) const;
    /// True for a name with a part that the target calls otherwise in any name.
    bool has_other_part(std::string_view word) const;

private:
    void learn_parameter_types(const AlignedText& source, const AlignedText& target, const Alignment& alignment);
    void learn_statements(const AlignedText& source, const AlignedText& target, const Alignment& alignment);
    void note_name(const std::string& here, const std::string& said);
    void note_part(const std::string& here, const std::string& said);
    void note_part_gained(const std::string& here, const std::string& said);
    void note(const AlignedText& source, size_t first, size_t end, const AlignedText& target, size_t there,
              size_t there_end);

    struct Said {
        std::unordered_map<std::string, size_t> times;  ///< by the target's words
        size_t all = 0;
    };
    std::unordered_map<std::string, Said> phrases_;  ///< by the source's words
    StatementPatterns patterns_;
    /// How names begin, by the source; which of its names say so.
    std::map<std::string, std::map<std::string, std::set<std::string>>, std::less<>> begins_;
    /// Parts of names that are another one there in a name that is the same but for it; which of its names say so.
    std::map<std::string, std::map<std::string, std::set<std::string>>, std::less<>> parts_;
    /// How names begin that have one part more there behind that, as they begin there; which of them say so.
    std::map<std::string, std::map<std::string, std::set<std::string>>, std::less<>> gained_;
    std::set<std::string, std::less<>> kept_;  ///< names that are the same there
    std::map<std::string, std::string, std::less<>>
        prefixed_;                                   ///< names with a prefix of one letter, as they are there
    std::set<std::string, std::less<>> kept_parts_;  ///< of names that are the same there
    std::map<std::pair<char, char>, size_t> marks_;  ///< how often a number with that mark has that one there; ' ' none
};

/// Words with \x1f between them.
std::string joined(const std::vector<std::string>& words, size_t first, size_t end);

}  // namespace porttool
