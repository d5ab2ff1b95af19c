// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/importer/texture_name.h"

#include <algorithm>
#include <cctype>

namespace importer {

namespace {

using std::filesystem::path;

bool is_there(const path& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error);
}

bool is_absolute(const std::string& name) {
    return name.starts_with('/') ||
           (name.size() > 1 && name[1] == ':' && std::isalpha(static_cast<unsigned char>(name[0])) != 0);
}

std::string percent_encoded(const std::string& name) {
    static const char* const digits = "0123456789ABCDEF";
    std::string encoded;
    for (const char c : name) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || std::string_view("/._-~").find(c) != std::string_view::npos) {
            encoded += c;
        } else {
            encoded += '%';
            encoded += digits[byte >> 4];
            encoded += digits[byte & 15];
        }
    }
    return encoded;
}

}  // namespace

std::string texture_uri(const std::string& name, const path& folder) {
    std::string relative = name;
    std::replace(relative.begin(), relative.end(), '\\', '/');
    while (relative.starts_with("./")) relative.erase(0, 2);
    const std::string own_name = relative.substr(relative.rfind('/') + 1);
    const bool leads_out = is_absolute(relative) || path(relative).lexically_normal().string().starts_with("..");
    if (!leads_out && is_there(folder / relative)) return percent_encoded(relative);
    for (const char* place : {".", "textures", "Textures", "texture", "maps", "images", "tex"}) {
        if (is_there(folder / place / own_name)) return percent_encoded(path(place) / own_name);
    }
    return percent_encoded(is_absolute(relative) ? own_name : relative);
}

}  // namespace importer
