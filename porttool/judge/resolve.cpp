// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/resolve.h"

#include <algorithm>

namespace porttool {
namespace {

/// An id without its #2.
std::string plain_id(const std::string& id) {
    const size_t mark = id.rfind('#');
    const bool numbered = mark != std::string::npos && mark + 1 < id.size() &&
                          std::all_of(id.begin() + static_cast<std::ptrdiff_t>(mark) + 1, id.end(),
                                      [](char c) { return c >= '0' && c <= '9'; });
    return numbered ? id.substr(0, mark) : id;
}

constexpr size_t kLongEnough = 12;  // tokens that make a text its own

}  // namespace

Resolver::Resolver(const std::map<std::string, UnitState>& units, std::set<std::string> named)
    : units_(units), named_(std::move(named)) {
    for (const auto& [id, unit] : units_) {
        variants_[plain_id(id)].push_back(&unit);
        if (unit.tokens >= kLongEnough) by_text_.emplace(unit.prints.renamed, &unit);
    }
}

Resolved Resolver::find(const std::string& id, const Fingerprints* prints) {
    if (const auto group = variants_.find(plain_id(id)); group != variants_.end()) {
        const auto& variants = group->second;
        if (prints != nullptr && variants.size() > 1) {
            for (const UnitState* unit : variants)
                if (!taken(*unit) && unit->prints.written == prints->written) return {unit, false};
            for (const UnitState* unit : variants)
                if (!taken(*unit) && unit->prints.renamed == prints->renamed) return {unit, false};
        }
        if (const auto exact = units_.find(id); exact != units_.end() && !taken(exact->second))
            return {&exact->second, false};
        for (const UnitState* unit : variants)
            if (!taken(*unit)) return {unit, false};
    }
    if (const auto exact = units_.find(id); exact != units_.end())
        return {&exact->second, false};  // N-way ports share one
    if (prints == nullptr) return {};
    const auto [first, last] = by_text_.equal_range(prints->renamed);
    for (auto at = first; at != last; ++at)
        if (!taken(*at->second) && !named_.contains(at->second->id)) return {at->second, true};
    return {};
}

void Resolver::take(const UnitState* unit) {
    if (unit != nullptr) taken_.insert(unit);
}

}  // namespace porttool
