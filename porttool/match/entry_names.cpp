// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/entry_names.h"

#include <algorithm>

#include "porttool/match/words.h"

namespace porttool {
namespace {

constexpr uint32_t kFamily = 4;  ///< files that make one

/// The definitions of one name, one a file: how long the first in each file is.
struct Definitions {
    uint32_t last_file = 0;
    std::vector<uint32_t> lengths;
};

/// Half of a family or more differ in length: they are no copies.
bool differ(std::vector<uint32_t> lengths) {
    const size_t count = lengths.size();
    std::sort(lengths.begin(), lengths.end());
    lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
    return 2 * lengths.size() > count;
}

}  // namespace

std::string_view plain_name(const Unit& unit) {
    return std::string_view(unit.name).substr(0, unit.name.find('#')).substr(unit.namespace_length);
}

EntryNames::EntryNames(const std::vector<ScannedFile>& files) {
    std::unordered_map<std::string_view, Definitions> all;
    for (uint32_t f = 0; f < files.size(); ++f) {
        ++stems_[fold(file_stem(files[f].path))];
        for (const Unit& unit : files[f].units) {
            if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) continue;
            Definitions& definitions = all[plain_name(unit)];
            if (definitions.last_file == f + 1) continue;
            definitions.last_file = f + 1;
            definitions.lengths.push_back(unit.body.end - unit.body.first);
        }
    }
    for (auto& [name, definitions] : all)
        if (definitions.lengths.size() >= kFamily && differ(std::move(definitions.lengths))) names_.emplace(name);
}

std::string EntryNames::subject(std::string_view path) const {
    const std::string_view stem = file_stem(path);
    const auto found = stems_.find(fold(stem));
    if (found == stems_.end() || found->second < kFamily) return std::string(stem);
    const std::string_view folder = folder_of(path);
    return std::string(folder.substr(folder.find_last_of('/') + 1));
}

}  // namespace porttool
