// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// A text as a basic string of TOML 1.0, quoted: what `visible` escapes as \uXXXX, so that it is read back
/// as it was. The text must be UTF-8.
std::string toml_string(std::string_view text);

}  // namespace porttool
