// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/paired_names.h"

#include <map>
#include <set>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// The last part of an id's name, without the number of an overload; "" for what is no name, as an operator.
std::string plain_leaf(const std::string& id) {
    const std::string name = split_id(id).second;
    const std::string_view plain = bare_leaf_of(name);
    const bool is_name = is_word_token(plain) && plain.find_first_not_of(
                                                     "abcdefghijklmnopqrstuvwxyz"
                                                     "ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                                     "0123456789_") == std::string_view::npos;
    return is_name ? std::string(plain) : std::string();
}

}  // namespace

Dialect dialect_of_edits(const MapFile& map) {
    Dialect dialect(map.dialect);
    std::map<std::string, std::set<std::string>> targets_of, sources_of;
    for (const MapPair& pair : map.pairs)
        for (const std::string& target : pair.targets) {
            const std::string here = plain_leaf(pair.source), there = plain_leaf(target);
            if (here.empty() || there.empty()) continue;
            targets_of[here].insert(there);
            sources_of[there].insert(here);
        }
    std::vector<std::pair<std::string, std::string>> names;
    for (const auto& [source, targets] : targets_of) {
        const std::string& target = *targets.begin();
        const bool one = targets.size() == 1 && sources_of.at(target).size() == 1 && source != target;
        if (!one || targets_of.contains(target) || sources_of.contains(source)) continue;
        if (dialect.meaning(source) != nullptr || dialect.meaning(target) != nullptr) continue;
        names.emplace_back(source, target);
    }
    dialect.add_counterparts(names);
    return dialect;
}

}  // namespace porttool
