// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/own_names.h"

#include <algorithm>

#include "porttool/language/spelling.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// What stands before the last part of a unit's name: `a::b::` of `a::b::f`.
std::string_view scope_of_unit(std::string_view name) {
    const size_t last = name.rfind("::");
    return last == std::string_view::npos ? std::string_view() : name.substr(0, last + 2);
}

/// True if `scope` is some of the scopes of a unit, in order: `b::` of `a::b::c::f`.
bool is_around(std::string_view scope, const UnitState& unit) {
    const std::string_view all = scope_of_unit(unit.name);
    const size_t at = all.find(scope);
    return at != std::string_view::npos && (at == 0 || all[at - 1] == ':');
}

/// `native::`, `metal::fast::`.
bool stands_for_precision(std::string_view scope) {
    while (!scope.empty()) {
        const std::string_view part = scope.substr(0, scope.find("::"));
        if (names_precision(part)) return true;
        scope.remove_prefix(std::min(scope.size(), part.size() + 2));
    }
    return false;
}

/// True if a text has `using WHAT;`, whatever blanks stand in it.
bool has_using(std::string_view text, std::string_view what) {
    constexpr std::string_view kUsing = "using", kBlanks = " \t\r\n";
    for (size_t at = text.find(kUsing); at != std::string_view::npos; at = text.find(kUsing, at + 1)) {
        const size_t end = std::min(text.find(';', at), text.size());
        std::string words;
        bool gap = false;
        for (size_t i = text.find_first_not_of(kBlanks, at + kUsing.size()); i < end; ++i) {
            const bool is_blank = kBlanks.find(text[i]) != std::string_view::npos;
            if (!is_blank && gap && words == "namespace") words += ' ';
            if (!is_blank) words += text[i];
            gap = is_blank;
            if (words.size() > what.size()) break;
        }
        if (words == what) return true;
    }
    return false;
}

}  // namespace

const std::vector<const UnitState*>* OwnNames::of(Side side, std::string_view name) {
    if (!by_name_[side]) {
        ByName& names = by_name_[side].emplace();
        for (const auto& [id, unit] : side == Side::Source ? facts_.source : facts_.target)
            if (unit.kind != UnitKind::File) names[bare_leaf_of(unit.name)].push_back(&unit);
    }
    const auto found = by_name_[side]->find(name);
    return found == by_name_[side]->end() ? nullptr : &found->second;
}

bool OwnNames::is_one_thing(const RescopedName& name, const UnitState& unit, Side side) {
    if (name.scope.empty()) return true;
    const bool of_library = is_scope_of_library(name.scope);
    if (!of_library && (stands_for_precision(name.scope) ||
                        !(is_around(name.scope, unit) || is_seen_without(name.scope, name.name, unit, side))))
        return false;
    const std::vector<const UnitState*>* own = of(side, name.name);
    return own == nullptr || std::all_of(own->begin(), own->end(), [&](const UnitState* other) {
               const std::string_view scope = scope_of_unit(other->name);
               if (!of_library && (scope == name.scope || scope.ends_with("::" + name.scope))) return true;
               const bool is_seen = scope.empty() || is_around(scope, unit);
               return !is_seen && !is_seen_without(scope, name.name, unit, side);
           });
}

/// True if the unit's file opens a namespace, or takes a name out of it.
bool OwnNames::is_seen_without(std::string_view scope, std::string_view name, const UnitState& unit, Side side) const {
    if (!facts_.files || scope.size() < 2) return false;
    const FilesOfSide& files = (*facts_.files)[side];
    const std::string path(scope.substr(0, scope.size() - 2));
    for (size_t i = 0; i < files.size(); ++i)
        if (files.path(i) == unit.file)
            return has_using(files.text(i), "namespace " + path) ||
                   has_using(files.text(i), path + "::" + std::string(name));
    return false;
}

}  // namespace porttool
