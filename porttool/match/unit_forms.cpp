// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/unit_forms.h"

#include <algorithm>
#include <iterator>

#include "porttool/match/words.h"

namespace porttool {

bool is_overloaded(const UnitFeatures& a, const UnitFeatures& b) {
    if (a.whole_file_main || b.whole_file_main) return false;  // what they take stands outside
    return a.folded_leaf == b.folded_leaf && (a.overloaded || b.overloaded);
}

bool UnitForms::is_second_form(const UnitFeatures& a, const UnitFeatures& b) {
    return a.file != b.file && a.core == b.core && !a.core.empty() && a.all_words.size() > b.all_words.size() &&
           std::includes(a.all_words.begin(), a.all_words.end(), b.all_words.begin(), b.all_words.end());
}

bool UnitForms::is_copy(const UnitFeatures& a, const UnitFeatures& b) const {
    constexpr float kAlike = 0.4f;
    if (a.folded_name != b.folded_name && without_instruction_set(a) != without_instruction_set(b)) return false;
    return a.folded_name != b.folded_name || body_likeness(compare_units(a, b)) >= kAlike;
}

std::vector<uint32_t> UnitForms::without_instruction_set(const UnitFeatures& unit) const {
    std::vector<uint32_t> words = unit.ordered_words.copy();
    std::erase_if(words, [&](uint32_t word) { return names_instruction_set(terms_.text(word)); });
    return words;
}

float UnitForms::as_variant(const UnitFeatures& unit, const UnitFeatures& owner) const {
    constexpr float kAlike = 0.5f, kMost = 0.85f;
    const bool one = unit.core == owner.core || is_version_of(unit.core_words, owner.core_words);
    const float alike = one ? body_likeness(compare_units(unit, owner)) : 0.0f;
    return alike < kAlike ? 0.0f : std::min(kMost, 0.2f + 0.7f * alike);
}

bool UnitForms::is_version_of(const TermIds& longer, const TermIds& shorter) const {
    if (!std::includes(longer.begin(), longer.end(), shorter.begin(), shorter.end())) return false;
    std::vector<uint32_t> more;
    std::set_difference(longer.begin(), longer.end(), shorter.begin(), shorter.end(), std::back_inserter(more));
    return std::all_of(more.begin(), more.end(), [&](uint32_t word) { return numbers_a_version(terms_.text(word)); });
}

bool UnitForms::is_reference_of(const UnitFeatures& unit, const UnitFeatures& target) const {
    return std::any_of(unit.all_words.begin(), unit.all_words.end(), [&](uint32_t word) {
        return marks_reference(terms_.text(word)) &&
               !std::binary_search(target.all_words.begin(), target.all_words.end(), word);
    });
}

bool UnitForms::may_share(const UnitFeatures& unit, const UnitFeatures& other, const UnitFeatures& owner,
                          const Candidate& candidate) const {
    constexpr float kOperands = 0.75f, kAlike = 0.4f;
    const Resemblance& resemblance = candidate.resemblance;
    const auto within = [](const TermIds& few, const TermIds& many) {
        return std::includes(many.begin(), many.end(), few.begin(), few.end());
    };
    const bool one_subject = unit.core == owner.core || resemblance.core >= 1;
    const bool more_of_it = within(other.core_words, unit.core_words) && body_likeness(resemblance) >= kAlike;
    if (!one_subject && !more_of_it) return false;
    if (unit.entry && unit.called_as != other.called_as) return false;
    const bool its_kernel = unit.kernel && owner.launcher && resemblance.core >= 1;
    if (owner.folded_name == other.folded_name && !its_kernel && !within(other.all_words, unit.all_words)) return false;
    if (is_reference_of(unit, other) || resemblance.kind <= 0) return false;
    return !is_overloaded(unit, other) || resemblance.operands >= kOperands;
}

}  // namespace porttool
