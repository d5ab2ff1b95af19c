// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/match/candidates.h"
#include "porttool/match/features.h"

namespace porttool {

/// One name for several units of a file, and the two share it. In several files they are copies.
bool is_overloaded(const UnitFeatures& a, const UnitFeatures& b);

/// Units of one side that are one function in several forms: copies, versions, for several instruction sets.
class UnitForms {
public:
    /// The terms have to stay.
    explicit UnitForms(const TermNumbers& terms) : terms_(terms) {}

    /// Of one subject in another file, under a longer name: of a project that has its functions in two forms, where a
    /// whole family of a file has the same words more.
    static bool is_second_form(const UnitFeatures& a, const UnitFeatures& b);

    /// The same function once more, or for another instruction set: but for such a word the names are equal, and the
    /// bodies at least as alike as two ports are.
    bool is_copy(const UnitFeatures& a, const UnitFeatures& b) const;

    /// How likely one is ported by what ports the other, as they are the same but for words that tell how, or for the
    /// number of a version.
    float as_variant(const UnitFeatures& unit, const UnitFeatures& owner) const;

    /// UnitForms of one unit, or of one name, share a counterpart; what else resembles one that is taken is a sibling
    /// of its owner. `unit` and `owner` are of one side, and the candidate is of `unit` and `other`.
    bool may_share(const UnitFeatures& unit, const UnitFeatures& other, const UnitFeatures& owner,
                   const Candidate& candidate) const;

private:
    std::vector<uint32_t> without_instruction_set(const UnitFeatures& unit) const;

    /// `solver_2` of `solver`: the same words, and numbers.
    bool is_version_of(const TermIds& longer, const TermIds& shorter) const;

    /// What a project computes on the host to compare its kernels with is not what ports them.
    bool is_reference_of(const UnitFeatures& unit, const UnitFeatures& target) const;

    const TermNumbers& terms_;
};

}  // namespace porttool
