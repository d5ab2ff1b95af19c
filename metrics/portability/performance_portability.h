// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>

namespace metrics {

/// Performance portability (Pennycook, Sewall, Lee 2016): the harmonic mean of an application's efficiency, in (0, 1],
/// on each platform of a set, and 0 if one of them is not supported (no efficiency, or 0). The set must not be empty.
double performance_portability(std::span<const std::optional<double>> efficiencies);

}  // namespace metrics
