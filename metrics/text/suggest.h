// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace metrics {

/// The candidate that `word` is most likely a slip of: the fewest letters changed, added, dropped or swapped with the
/// next, and no more than a third of the word's or, from four letters on, two. None where nothing is that near; the
/// first one on a tie.
std::optional<std::string> suggest(std::string_view word, std::span<const std::string> candidates);

}  // namespace metrics
