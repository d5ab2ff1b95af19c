// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/file_uri.h"

#include <charconv>

#include "porttool/read/disk.h"
#include "porttool/text/sink/sarif.h"

namespace porttool::lsp {

std::string file_uri(const std::string& path) { return "file://" + uri_path(path); }

std::optional<std::string> path_of_uri(const std::string& uri) {
    constexpr std::string_view kScheme = "file://", kLocal = "localhost";
    if (!uri.starts_with(kScheme)) return std::nullopt;
    std::string rest = uri.substr(kScheme.size());
    if (rest.starts_with(kLocal)) rest.erase(0, kLocal.size());
    std::string path;
    for (size_t i = 0; i < rest.size(); ++i) {
        if (rest[i] == '?' || rest[i] == '#') break;
        if (rest[i] != '%') {
            path += rest[i];
            continue;
        }
        constexpr int kHex = 16;
        unsigned char byte = 0;
        if (i + 2 >= rest.size()) return std::nullopt;
        const auto [end, error] = std::from_chars(rest.data() + i + 1, rest.data() + i + 3, byte, kHex);
        if (error != std::errc() || end != rest.data() + i + 3 || byte == 0) return std::nullopt;
        path += static_cast<char>(byte);
        i += 2;
    }
    if (!path.starts_with('/')) return std::nullopt;
    return clean_path(path);
}

}  // namespace porttool::lsp
