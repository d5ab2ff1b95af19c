// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/shared_files.h"

#include <algorithm>
#include <filesystem>

#include "porttool/normal/word_macros.h"
#include "porttool/scan/scan.h"

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

std::string_view last_part(std::string_view path) { return path.substr(path.rfind('/') + 1); }

std::string key_of(std::string_view place, std::string_view name) {
    return std::string(place) + '\n' + std::string(name);
}

std::string_view leaf_of_id(std::string_view id) { return bare_leaf_of(id.substr(id.rfind(':') + 1)); }

/// A few of one key are enough: a file includes one of a name.
void add_few(std::vector<std::string>& names, const std::string& name) {
    constexpr size_t kMostAlike = 16;
    if (names.size() < kMostAlike) names.push_back(name);
}

}  // namespace

const SharedFiles::Foreign& SharedFiles::foreign_includes(Side side) {
    if (foreign_[side]) return *foreign_[side];
    Foreign& out = foreign_[side].emplace();
    if (!facts_.files) return out;
    const std::vector<FileMacros> files = (*facts_.files)[side].macros();
    std::set<std::string_view> own;
    for (const FileMacros& file : files) {
        own.insert(file.path);
        own_[side].emplace(last_part(file.path));
    }
    for (const FileMacros& file : files)
        for (const std::string& name : file.includes) {
            const std::string_view folder = folder_of_path(file.path), last = last_part(name);
            if (own.contains(plain(std::string(folder) + name))) continue;
            add_few(out.by_file[key_of(file.path, last)], name);
            if (without_suffix(last) != last) add_few(out.by_folder[key_of(folder, without_suffix(last))], name);
        }
    return out;
}

bool SharedFiles::includes(Side side, std::string_view path, std::string_view there) {
    const Includes& all = foreign_includes(side).by_file;
    const auto found = all.find(key_of(path, last_part(there)));
    return found != all.end() && std::any_of(found->second.begin(), found->second.end(), [&](const std::string& name) {
               return may_mean(name, folder_of_path(path), there);
           });
}

bool SharedFiles::surely_includes(Side side, std::string_view path, std::string_view there) {
    return includes(side, path, there) && !own_[side].contains(last_part(there));
}

bool SharedFiles::folder_includes(Side side, std::string_view path, std::string_view there) {
    const Includes& all = foreign_includes(side).by_folder;
    const std::string_view folder = folder_of_path(path);
    const auto found = all.find(key_of(folder, without_suffix(last_part(there))));
    if (found == all.end()) return false;
    const auto any = [&](const auto& means) { return std::any_of(found->second.begin(), found->second.end(), means); };
    if (any([&](const std::string& name) { return may_mean(name, folder, there); })) return true;
    const auto names_header = [&](const std::string& name) {
        return may_mean(without_suffix(name), folder, without_suffix(there));
    };
    return any(names_header) && is_called_by(side, there);
}

bool SharedFiles::is_called_by(Side side, std::string_view there) {
    if (!called_[side]) {
        std::set<std::string_view> said, own;
        for (const auto& [id, unit] : facts_.units(side)) {
            own.insert(leaf_of_id(id));
            for (const std::string_view word : unit.text.words()) said.insert(word);
        }
        std::set<std::string_view>& files = called_[side].emplace();
        for (const auto& [id, unit] : facts_.units(porttool::other(side))) {
            const std::string_view leaf = leaf_of_id(id);
            if (said.contains(leaf) && !own.contains(leaf)) files.insert(unit.file);
        }
    }
    return called_[side]->contains(there);
}

}  // namespace porttool
