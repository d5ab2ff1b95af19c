// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace porttool {

/// A text of at most `most` bytes (at least 16) as it is; of a longer one the beginning and the end, cut between
/// characters: "the beginning ... the end".
std::string shortened(std::string_view text, size_t most);

}  // namespace porttool
