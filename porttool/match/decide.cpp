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

/// How much of a doubt about names is left where a body is written like this one, and no other is.
float left_by_bodies(const Assignment& pair) {
    constexpr float kAlike = 0.6f, kFrom = 0.4f, kAhead = 0.25f, kPerShare = 2.0f;
    const float alike = body_likeness(pair.resemblance);
    if (pair.shared || alike < kAlike || pair.body_margin < kAhead) return 1;
    return std::max(0.0f, 1 - kPerShare * (alike - kFrom));
}

}  // namespace

float confidence(const UnitFeatures& source, const UnitFeatures& target, const Assignment& pair) {
    if (source.group == Group::Constant) return constant_confidence(source, target, pair);
    // What launches a kernel is not its port, nor that of what launches none; where both sides have kernels it can be
    // one that hands on.
    if (pair.other_role && (source.kernel || target.kernel || !source.on_device || !target.on_device)) return 0;
    const Resemblance& resemblance = pair.resemblance;
    // An equal name counts as much as what stands under it: two bodies with nothing in common are two functions.
    const bool unlike = resemblance.families[kBody] < 0.08f && resemblance.families[kShape] < 0.02f;
    const bool exact =
        resemblance.same_name > 0.999f && pair.only_one && !pair.unfit && !(unlike && resemblance.signature < 0.5f);
    // The longer name is forgiven what ports leave out, not what they keep.
    const float words = resemblance.words + (resemblance.subject - resemblance.words) * (1 - pair.names.lost);
    // What both are about in as many words is as good as a place, also where few names make a word look common.
    constexpr float kSameCore = 0.6f;
    const float place = std::max(resemblance.families[kPlace], pair.same_subject ? kSameCore : 0.0f);
    const bool code = source.group == Group::Code;
    const float kind = code ? resemblance.kind : 1.0f;
    // A logistic regression over labelled pairs of five ports (OpenCL, CUDA, SYCL, GLSL, C++) and over the same ports
    // with 40 % of the counterparts deleted, rounded. One set of weights for all: the margin and what the names of a
    // project's own certain pairs do carry what differs from project to project.
    const bool variant = pair.shared && resemblance.core >= 1;  // only words that tell how set it apart
    const float doubtful = variant ? 0.2f : left_by_bodies(pair);
    float z = -4.1f + 3.3f * place + 2.6f * std::max(words, pair.same_subject ? kSameCore : 0.0f) + 0.8f * kind +
              3.8f * std::clamp(pair.margin, -0.1f, 0.4f) + (exact ? 4.2f : 0.0f) - doubtful * doubt(pair.names);
    if (!code) {
        // Of two structs by different names the fields have to say that they are one.
        constexpr float kMostOfNames = 0.85f;
        const float of_names = 1 / (1 + std::exp(-z));
        return unlike && resemblance.same_name < 0.999f ? std::min(of_names, kMostOfNames) : of_names;
    }
    // Near-identical code outweighs a doubt about names, unless all of a family is written alike.
    z += 4.0f * std::max(0.0f, std::min(body_likeness(resemblance) - 0.4f, 2 * pair.body_margin));
    if (unlike) z -= 0.7f;
    if (pair.other_role) z -= 3.0f;
    if (!pair.other_role && source.launcher != target.launcher) z -= 1.5f;  // under one name: perhaps both in one
    // A file's entry point is named after the file, which holds other functions as well.
    constexpr float kHeld = 0.3f;
    if (target.entry && !source.entry) z -= 5.0f * std::max(0.0f, kHeld - contained_in(source, target));
    if (resemblance.reversed) z -= 2.5f;
    if (pair.wrong_operands) z -= 2.5f;
    if (pair.unfit) z -= 2.0f;
    const bool idle = source.kernel && source.acts && !target.kernel ? !target.acts : !target.computes;
    if (source.works && idle) z -= 1.5f;
    if (pair.shared && !variant) z -= 1.0f;
    const float score = 1 / (1 + std::exp(-z));
    // One more source of a target that is another's is only sure under its name: of `clamp` and `op_clamp` one may be
    // the helper of the other.
    constexpr float kMostOfShared = 0.85f;
    return pair.shared && resemblance.same_name < 0.999f ? std::min(score, kMostOfShared) : score;
}

}  // namespace porttool
