// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/unit_index.h"

#include <algorithm>
#include <functional>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

size_t hash_of(std::string_view text) { return std::hash<std::string_view>()(text); }

std::string id_of(const Excerpt& excerpt) {
    return excerpt.unit != nullptr ? unit_id(*excerpt.file, *excerpt.unit) : excerpt.file->path + ":@file";
}

}  // namespace

UnitIndex::UnitIndex(const std::vector<ScannedFile>& files) {
    for (const ScannedFile& file : files) {
        for (const Unit& unit : file.units) {
            by_id_.push_back({hash_of(unit_id(file, unit)), {&file, &unit}});
            by_name_.push_back({hash_of(unit.name), {&file, &unit}});
        }
        by_id_.push_back({hash_of(file.path + ":@file"), {&file, nullptr}});
    }
    sort(by_id_);
    sort(by_name_);
}

void UnitIndex::sort(std::vector<Entry>& entries) {
    std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.hash < b.hash; });
}

Excerpt UnitIndex::find(const std::string& id) const {
    const size_t hash = hash_of(id);
    auto at = std::lower_bound(by_id_.begin(), by_id_.end(), hash,
                               [](const Entry& entry, size_t wanted) { return entry.hash < wanted; });
    for (; at != by_id_.end() && at->hash == hash; ++at)
        if (id_of(at->excerpt) == id) return at->excerpt;
    return {};
}

Excerpt UnitIndex::find_before(const std::string& id, const UnitIndex& now) const {
    if (const Excerpt same = find(id); same.file != nullptr) return same;
    const std::string_view name = std::string_view(id).substr(id.find(':') + 1);
    const size_t hash = hash_of(name);
    Excerpt moved;
    auto at = std::lower_bound(by_name_.begin(), by_name_.end(), hash,
                               [](const Entry& entry, size_t wanted) { return entry.hash < wanted; });
    for (; at != by_name_.end() && at->hash == hash; ++at) {
        if (at->excerpt.unit->name != name || now.find(id_of(at->excerpt)).file != nullptr) continue;
        if (moved.file != nullptr) return {};
        moved = at->excerpt;
    }
    return moved;
}

}  // namespace porttool
