// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "metrics/portability/degree.h"
#include "porttool/measure/measure.h"

namespace porttool {

/// What a port shares with its source, in lines, under three readings. The one that counts: the shared lines of the
/// measure. The strictest and the loosest: the share of its tokens that match as written, or with all names folded,
/// where these lie further out.
metrics::SharedLines shared_lines(const SideMeasure& port);

/// Mooney's degree of portability of a port from its lines, with that interval; none for a side without lines.
std::optional<metrics::Figure> degree_of_portability(const SideMeasure& port, const metrics::LineWeights& weights = {});

}  // namespace porttool
