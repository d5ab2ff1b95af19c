// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "target_core/kernels/layout.h"

namespace eight_lanes {

/// Runs the kernels over the tile bound to this thread, eight jobs at a time; counts must be multiples of eight.
void generate(const target_core::Settings& settings, const target_core::Pass& pass);
void shade(const target_core::Settings& settings, const target_core::Pass& pass);
void finalize(const target_core::Settings& settings, const target_core::Pass& pass);

}  // namespace eight_lanes
