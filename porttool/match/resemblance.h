// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "porttool/match/features.h"

namespace porttool {

/// How two units resemble each other, signal by signal, each in [0, 1].
struct Resemblance {
    std::array<float, kFamilies> families{};
    float same_name = 0;    ///< 1: the whole names fold to one; less: the last parts do, or share their letters
    float words = 0;        ///< share of the names' words, each counting the same
    bool reversed = false;  ///< the two convert the other way round: `hex_to_u8`, `u8_to_hex`
    float subject = 0;      ///< the same, but the name of a file with one main may be the shorter one
    float core = 0;         ///< the same of the words that tell what a function is about; 1: they are equal
    float signature = 0;
    float operands = 0;  ///< share of the parameters that have one type, by their place
    float size = 0;
    float kind = 0;   ///< 1: both kernels or both not
    float score = 0;  ///< all together
};

Resemblance compare_units(const UnitFeatures& a, const UnitFeatures& b);

/// Share of the first one's body and shape that the second has as well.
float contained_in(const UnitFeatures& a, const UnitFeatures& b);

/// How alike two bodies are, in shape and words.
inline float body_likeness(const Resemblance& resemblance) {
    return 0.5f * resemblance.families[kShape] + 0.5f * resemblance.families[kBody];
}

/// The same of both, each of their terms counting the same, however common it is: what is left of a likeness where the
/// two stand among others that are written like them.
float plain_likeness(const UnitFeatures& a, const UnitFeatures& b);

/// The product of two weighed bags.
float cosine(const Bag& a, const Bag& b);

/// What each family adds to a score, also used to find candidates.
extern const std::array<float, kFamilies> kFamilyWeights;

}  // namespace porttool
