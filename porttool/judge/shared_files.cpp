// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/shared_files.h"

#include <algorithm>
#include <filesystem>

#include "porttool/normal/word_macros.h"

namespace porttool {
namespace {

std::string_view folder_of_path(std::string_view path) { return path.substr(0, path.rfind('/') + 1); }

std::string plain(const std::string& path) { return std::filesystem::path(path).lexically_normal().generic_string(); }

/// The path without what its last part has behind the last dot.
std::string_view without_suffix(std::string_view path) {
    const size_t dot = path.rfind('.'), slash = path.rfind('/');
    return dot == std::string_view::npos || (slash != std::string_view::npos && dot < slash) ? path
                                                                                             : path.substr(0, dot);
}

/// True if an `#include` in a file of that folder may mean that file of the other side: its place from there, or the
/// end of its path.
bool may_mean(std::string_view name, std::string_view folder, std::string_view there) {
    if (plain(std::string(folder) + std::string(name)) == there) return true;
    std::string end = plain(std::string(name));
    while (end.starts_with("../")) end.erase(0, 3);
    return there == end || there.ends_with("/" + end);
}

}  // namespace

const SharedFiles::Includes& SharedFiles::foreign_includes(Side side) {
    if (includes_[side]) return *includes_[side];
    Includes& out = includes_[side].emplace();
    if (!facts_.files) return out;
    const std::vector<FileMacros> files = (*facts_.files)[side].macros();
    std::set<std::string_view> own;
    for (const FileMacros& file : files) own.insert(file.path);
    for (const FileMacros& file : files)
        for (const std::string& name : file.includes)
            if (!own.contains(plain(std::string(folder_of_path(file.path)) + name))) out[file.path].push_back(name);
    return out;
}

bool SharedFiles::includes(Side side, std::string_view path, std::string_view there) {
    const Includes& all = foreign_includes(side);
    const auto file = all.find(path);
    return file != all.end() && std::any_of(file->second.begin(), file->second.end(), [&](const std::string& name) {
               return may_mean(name, folder_of_path(path), there);
           });
}

bool SharedFiles::folder_includes(Side side, std::string_view path, std::string_view there) {
    const std::string_view folder = folder_of_path(path);
    const auto is_header_of = [&](const std::string& name) {
        const std::string_view stem = without_suffix(name);
        return stem.size() < name.size() && may_mean(std::string(stem), folder, without_suffix(there));
    };
    for (const auto& [file, names] : foreign_includes(side))
        if (folder_of_path(file) == folder && std::any_of(names.begin(), names.end(), is_header_of)) return true;
    return false;
}

}  // namespace porttool
