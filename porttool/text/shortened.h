// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace porttool {

/// What a reader is shown of a statement of others, which may be as long as its file; formats for machines have it
/// whole.
inline constexpr size_t kLongestStatement = 4096;

/// A text of at most `most` bytes (at least 16) as it is; of a longer one the beginning and the end, cut between
/// characters: "the beginning ... the end".
std::string shortened(std::string_view text, size_t most);

}  // namespace porttool
