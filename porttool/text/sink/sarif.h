// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// A plain text message of SARIF 2.1.0 (3.11.3), in one line; its JSON is made by `json_text`. What would be an
/// embedded link (3.11.6) is none.
std::string sarif_message(std::string_view text);

/// A path as the path of a relative URI (RFC 3986, 3.3): it has no scheme, host, query or fragment, whatever it holds.
std::string uri_path(std::string_view path);

}  // namespace porttool
