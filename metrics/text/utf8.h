// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace metrics {

/// True for well-formed UTF-8 (RFC 3629: no overlong forms, no surrogates, nothing above U+10FFFF).
bool is_utf8(std::string_view bytes);

/// The bytes of the character that stands first in a text that is not empty, or 0 if they are no UTF-8.
size_t utf8_length(std::string_view text);

/// The text with U+FFFD in the place of each byte that is no UTF-8.
std::string as_utf8(std::string_view bytes);

}  // namespace metrics
