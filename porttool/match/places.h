// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/match/match.h"

namespace porttool {

/// Doubts suggested pairs between folders that belong to others: where both folders have most of their pairs elsewhere,
/// and hardly any with each other. Such a pair is scored below 0.9; if it shares its target, which has its source where
/// most of its folder has, it goes.
///
///     a/cuda/mm.cu  a/sycl/mm.cpp     a/cuda/log.h  b/sycl/log.h     a's helper resembles b's, which ports that of b
///     b/cuda/bf.cu  b/sycl/bf.cpp     b/cuda/log.h  b/sycl/log.h
void doubt_other_places(std::vector<MatchedPair>& pairs);

}  // namespace porttool
