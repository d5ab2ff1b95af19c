// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/resemblance.h"

#include <algorithm>
#include <cmath>

namespace porttool {

const std::array<float, kFamilies> kFamilyWeights = {0.26f, 0.20f, 0.20f, 0.10f, 0.08f, 0.04f};

namespace {

/// Share of letter triples that two names have in common (Dice).
float trigram_share(const std::string& a, const std::string& b) {
    constexpr size_t kLength = 3;
    if (a.size() < kLength || b.size() < kLength) return a == b ? 1.0f : 0.0f;
    auto triples = [](const std::string& text) {
        std::vector<uint32_t> out;
        for (size_t i = 0; i + kLength <= text.size(); ++i)
            out.push_back(static_cast<uint32_t>(static_cast<unsigned char>(text[i])) << 16 |
                          static_cast<uint32_t>(static_cast<unsigned char>(text[i + 1])) << 8 |
                          static_cast<unsigned char>(text[i + 2]));
        std::sort(out.begin(), out.end());
        return out;
    };
    const auto left = triples(a), right = triples(b);
    size_t shared = 0;
    for (size_t i = 0, k = 0; i < left.size() && k < right.size();) {
        if (left[i] == right[k])
            ++shared, ++i, ++k;
        else if (left[i] < right[k])
            ++i;
        else
            ++k;
    }
    return 2.0f * static_cast<float>(shared) / static_cast<float>(left.size() + right.size());
}

/// How much of the first bag's weight lies in terms that the second has, too.
float contained_share(const Bag& a, const Bag& b) {
    float sum = 0;
    for (size_t i = 0, k = 0; i < a.size() && k < b.size();) {
        if (a[i].id == b[k].id) {
            sum += a[i].weight * a[i].weight;
            ++i, ++k;
        } else if (a[i].id < b[k].id) {
            ++i;
        } else {
            ++k;
        }
    }
    return sum;
}

float name_likeness(const UnitFeatures& a, const UnitFeatures& b) {
    if (a.folded_name == b.folded_name) return 1;
    if (a.folded_leaf == b.folded_leaf) return 0.85f;
    return 0.8f * std::max(trigram_share(a.folded_leaf, b.folded_leaf), trigram_share(a.folded_name, b.folded_name));
}

/// Dice's share of two sorted lists.
float dice(const TermIds& a, const TermIds& b) {
    if (a.empty() && b.empty()) return 1;
    size_t shared = 0;
    for (size_t i = 0, k = 0; i < a.size() && k < b.size();) {
        if (a[i] == b[k])
            ++shared, ++i, ++k;
        else if (a[i] < b[k])
            ++i;
        else
            ++k;
    }
    return 2.0f * static_cast<float>(shared) / static_cast<float>(a.size() + b.size());
}

/// A file with one main is named by its subject alone (`argsort.comp`), the function by more (`k_argsort_f32_i32`):
/// there the share of the file's words counts.
float subject_likeness(const UnitFeatures& a, const UnitFeatures& b, float words) {
    if (a.whole_file_main == b.whole_file_main || a.kernel != b.kernel) return words;
    const auto& file = a.whole_file_main ? a.name_words : b.name_words;
    const float sum = static_cast<float>(a.name_words.size() + b.name_words.size());
    const float contained = file.empty() ? 0 : words * sum / (2 * static_cast<float>(file.size()));
    return std::max(words, 0.95f * contained);
}

/// A helper or launcher beside the kernels of its side, and a main: an entry point is a kernel's port before all else.
bool is_helper_to_main(const UnitFeatures& a, const UnitFeatures& b) {
    return (a.whole_file_main && !b.kernel && b.beside_kernels) || (b.whole_file_main && !a.kernel && a.beside_kernels);
}

float kind_likeness(const UnitFeatures& a, const UnitFeatures& b) {
    if (a.kernel == b.kernel) return 1;
    if (is_helper_to_main(a, b)) return 0;
    return a.says_kernels && b.says_kernels ? 0.4f : 1.0f;
}

float signature_likeness(const UnitFeatures& a, const UnitFeatures& b) {
    const float few = static_cast<float>(std::min(a.parameters, b.parameters));
    const float many = static_cast<float>(std::max(a.parameters, b.parameters));
    const float counts = many > 0 ? few / many : 1;
    const float types = dice(a.parameter_types, b.parameter_types);
    return 0.5f * counts + 0.5f * types;
}

float operand_likeness(const UnitFeatures& a, const UnitFeatures& b) {
    constexpr float kPerhaps = 0.8f;
    const size_t few = std::min(a.operands.size(), b.operands.size());
    const size_t many = std::max(a.operands.size(), b.operands.size());
    if (many == 0) return 1;
    float equal = 0;
    for (size_t i = 0; i < few; ++i) {
        if (a.operands[i] == b.operands[i])
            equal += 1;
        else if (a.operands[i] == kAnyType || b.operands[i] == kAnyType)
            equal += kPerhaps;
    }
    return equal / static_cast<float>(many);
}

float size_likeness(const UnitFeatures& a, const UnitFeatures& b) {
    const float few = 8 + static_cast<float>(std::min(a.size, b.size));
    const float many = 8 + static_cast<float>(std::max(a.size, b.size));
    return few / many;
}

}  // namespace

float contained_in(const UnitFeatures& a, const UnitFeatures& b) {
    return 0.5f * contained_share(a.bags[kBody], b.bags[kBody]) +
           0.5f * contained_share(a.bags[kShape], b.bags[kShape]);
}

float plain_likeness(const UnitFeatures& a, const UnitFeatures& b) {
    size_t shared = 0, all = 0;
    for (const Family family : {kBody, kShape}) {
        const Bag &left = a.bags[family], &right = b.bags[family];
        all += left.size() + right.size();
        for (size_t i = 0, k = 0; i < left.size() && k < right.size();) {
            if (left[i].id == right[k].id)
                ++shared, ++i, ++k;
            else if (left[i].id < right[k].id)
                ++i;
            else
                ++k;
        }
    }
    return all > 0 ? 2 * static_cast<float>(shared) / static_cast<float>(all) : 0;
}

float cosine(const Bag& a, const Bag& b) {
    float sum = 0;
    for (size_t i = 0, k = 0; i < a.size() && k < b.size();) {
        if (a[i].id == b[k].id)
            sum += a[i++].weight * b[k++].weight;
        else if (a[i].id < b[k].id)
            ++i;
        else
            ++k;
    }
    return sum;
}

Resemblance compare_units(const UnitFeatures& a, const UnitFeatures& b) {
    Resemblance out;
    constexpr float kNameWeight = 0.12f, kWordsWeight = 0.08f, kSignatureWeight = 0.06f, kSizeWeight = 0.05f,
                    kKindWeight = 0.09f;
    float weight = kNameWeight + kWordsWeight + kSizeWeight;
    out.same_name = name_likeness(a, b);
    out.words = dice(a.name_words, b.name_words);
    out.core = a.core == b.core ? 1.0f : 0.95f * dice(a.core_words, b.core_words);
    out.reversed = a.converts && b.converts && a.all_words == b.all_words && a.ordered_words != b.ordered_words;
    if (out.reversed) out.words = 0;
    out.subject = subject_likeness(a, b, out.words);
    out.size = size_likeness(a, b);
    float score = kNameWeight * out.same_name + kWordsWeight * out.subject + kSizeWeight * out.size;
    for (size_t family = 0; family < kFamilies; ++family) {
        const bool left = !a.bags[family].empty(), right = !b.bags[family].empty();
        if (!left && !right) continue;  // neither calls anything: says nothing
        out.families[family] = left && right ? cosine(a.bags[family], b.bags[family]) : 0;
        const float share = left && right ? kFamilyWeights[family] : 0.5f * kFamilyWeights[family];
        score += share * out.families[family];
        weight += share;
    }
    if (a.group == Group::Code) {
        out.signature = signature_likeness(a, b);
        out.operands = operand_likeness(a, b);
        out.kind = kind_likeness(a, b);
        score += kSignatureWeight * out.signature + kKindWeight * out.kind;
        weight += kSignatureWeight + kKindWeight;
    }
    constexpr float kSameNumber = 0.03f;  // decides among copies of one unit in files that are numbered
    if (a.file_number != 0 && a.file_number == b.file_number) score += kSameNumber * weight;
    // Helpers and launchers of a kernel resemble its port as well, sometimes more than the kernel itself.
    constexpr float kNoEntryPoint = 0.25f;
    out.score = std::clamp(score / weight - (is_helper_to_main(a, b) ? kNoEntryPoint : 0.0f), 0.0f, 1.0f);
    return out;
}

}  // namespace porttool
