// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/decide.h"

#include <algorithm>
#include <cmath>

namespace porttool {
namespace {

/// A constant is its name: it pairs with the one of the same name, whatever its value (that is what a check compares).
float constant_confidence(const UnitFeatures& source, const UnitFeatures& target, const Assignment& pair) {
    if (source.folded_leaf != target.folded_leaf) return 0;
    if (pair.only_one) return 0.95f;
    constexpr float kClear = 0.05f;
    const bool same_value = !source.value.empty() && source.value == target.value;
    return same_value || pair.source_margin > kClear ? 0.8f : 0.55f;
}

}  // namespace

float confidence(const UnitFeatures& source, const UnitFeatures& target, const Assignment& pair) {
    if (source.group == Group::Constant) return constant_confidence(source, target, pair);
    const Similarity& similarity = pair.similarity;
    const bool exact = similarity.same_name > 0.999f && pair.only_one;
    const bool all_words = similarity.words > 0.999f;
    // A logistic regression over labelled pairs of five ports (OpenCL, CUDA, SYCL, GLSL, C++), rounded. One set of
    // weights for all: the margins carry what differs from project to project.
    const float kind = source.group == Group::Code ? similarity.kind : 1.0f;
    const float z =
        -5.6f + 0.3f * similarity.families[kName] + 3.6f * similarity.families[kPlace] +
        1.4f * similarity.families[kBody] + 0.8f * similarity.words + 1.2f * kind +
        2.6f * std::clamp(pair.source_margin, -0.1f, 0.4f) + 2.6f * std::clamp(pair.free_margin, 0.0f, 0.4f) +
        0.5f * std::clamp(pair.target_margin, -0.1f, 0.4f) + (exact ? 4.0f : 0.0f) + (all_words ? 0.7f : 0.0f);
    return 1 / (1 + std::exp(-z));
}

}  // namespace porttool
