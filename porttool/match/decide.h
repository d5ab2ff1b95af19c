// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/match/assign.h"

namespace porttool {

/// Pairs at or above this confidence are suggested.
inline constexpr float kLeastConfidence = 0.5f;

/// How likely a pair is right, in [0, 1]. Not the likeness alone decides, which is high between all parts of one code
/// base and low between all parts of another, but the margin to the runners-up, with names and place.
float confidence(const UnitFeatures& source, const UnitFeatures& target, const Assignment& pair);

}  // namespace porttool
