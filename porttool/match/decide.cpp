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
    return same_value || pair.margin > kClear ? 0.8f : 0.55f;
}

}  // namespace

float confidence(const UnitFeatures& source, const UnitFeatures& target, const Assignment& pair) {
    if (source.group == Group::Constant) return constant_confidence(source, target, pair);
    const Resemblance& resemblance = pair.resemblance;
    const bool exact = resemblance.same_name > 0.999f && pair.only_one;
    // The longer name is forgiven what ports leave out, not what they keep.
    const float words = resemblance.words + (resemblance.subject - resemblance.words) * (1 - pair.names.lost);
    const float kind = source.group == Group::Code ? resemblance.kind : 1.0f;
    // A logistic regression over labelled pairs of five ports (OpenCL, CUDA, SYCL, GLSL, C++) and over the same ports
    // with 40 % of the counterparts deleted, rounded. One set of weights for all: the margin and what the names of a
    // project's own certain pairs do carry what differs from project to project.
    const float z = -4.1f + 3.3f * resemblance.families[kPlace] + 2.6f * words + 0.8f * kind +
                    3.8f * std::clamp(pair.margin, -0.1f, 0.4f) + (exact ? 4.2f : 0.0f) - doubt(pair.names);
    return 1 / (1 + std::exp(-z));
}

}  // namespace porttool
