// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// A text deflated (RFC 1950) and in base64, as a page carries it; the browser's DecompressionStream("deflate") reads
/// it. Letters, digits, `+`, `/` and `=` alone.
std::string packed(std::string_view text);

/// Bytes in base64.
std::string base64(std::string_view bytes);

}  // namespace porttool
