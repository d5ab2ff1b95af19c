// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/functions_of_side.h"

#include <set>

#include "porttool/audit/essence.h"
#include "porttool/scan/scan.h"

namespace porttool {

FunctionsOfSide::FunctionsOfSide(const UnitsById& units, const Dialect& dialect) : dialect_(dialect) {
    for (const auto& [id, unit] : units)
        if (unit.kind == UnitKind::Function) by_name_[leaf_of(unit.name)].push_back(&unit);
}

std::vector<WordsOfSide> FunctionsOfSide::called_by(const UnitState& unit) const {
    constexpr size_t kMost = 3;  // of one name
    std::vector<WordsOfSide> out;
    std::set<std::string_view> asked;
    const Words words = unit.text.words();
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        const auto found = words[i + 1] == "(" ? by_name_.find(words[i]) : by_name_.end();
        if (found == by_name_.end() || found->second.size() > kMost || !asked.insert(words[i]).second) continue;
        for (const UnitState* called : found->second) {
            if (called->id == unit.id) continue;
            WordsOfSide& says = out.emplace_back();
            for (const std::string_view word : called->text.words())
                says.insert(plain_word(std::string(word), dialect_));
        }
    }
    return out;
}

}  // namespace porttool
