// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

namespace porttool::lsp {

/// The `file:` URI of an absolute path (RFC 8089).
std::string file_uri(const std::string& path);

/// The absolute path that a `file:` URI names; none for another scheme, another host, or what names no path.
std::optional<std::string> path_of_uri(const std::string& uri);

}  // namespace porttool::lsp
