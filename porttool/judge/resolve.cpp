// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/resolve.h"

#include <algorithm>
#include <deque>
#include <unordered_map>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// An id without its #2.
std::string_view plain_id(std::string_view id) {
    const size_t mark = id.rfind('#');
    const bool numbered = mark != std::string::npos && mark + 1 < id.size() &&
                          std::all_of(id.begin() + mark + 1, id.end(), [](char c) { return c >= '0' && c <= '9'; });
    return numbered ? id.substr(0, mark) : id;
}

/// A text up to its body, without the names of the parameters.
std::string signature_of(const NormalText& text) {
    Words out;
    int depth = 0;
    for (size_t i = 0; i < text.size() && text[i] != "{"; ++i) {
        const std::string_view word = text[i];
        if (word == "(") ++depth;
        const bool ends = depth == 1 && (word == "," || word == ")");
        if (ends && out.size() > 1 && out[out.size() - 2] != "(" && out[out.size() - 2] != ",") out.pop_back();
        if (word == ")") --depth;
        out.push_back(word);
    }
    std::string joined;
    for (const std::string_view word : out) joined.append(word) += ' ';
    return joined;
}

/// How many words two texts share, of all that they have: 0 to 1.
double shared_words(const NormalText& a, const NormalText& b) {
    std::unordered_map<std::string_view, size_t> left;
    for (size_t i = 0; i < a.size(); ++i) ++left[a[i]];
    size_t shared = 0;
    for (size_t i = 0; i < b.size(); ++i)
        if (const auto found = left.find(b[i]); found != left.end() && found->second > 0) {
            --found->second;
            ++shared;
        }
    return 2.0 * static_cast<double>(shared) / static_cast<double>(std::max<size_t>(1, a.size() + b.size()));
}

using Key = std::function<std::string(const UnitState&)>;

}  // namespace

Resolver::Resolver(const UnitsById& units, const std::vector<NamedUnit>& named,
                   const std::function<NormalText(Print)>& base_text)
    : units_(units), base_text_(base_text) {
    std::unordered_map<std::string_view, std::vector<const UnitState*>> variants;
    variants.reserve(units_.size());
    for (const auto& [id, unit] : units_) variants[plain_id(id)].push_back(&unit);
    std::unordered_map<std::string_view, Names> groups;
    Names first_of_id;
    for (const NamedUnit& name : named) {
        if (!named_.insert(name.id).second) continue;  // N-way ports share one
        groups[plain_id(name.id)].push_back(&name);
        first_of_id.push_back(&name);
    }
    for (const auto& [id, names] : groups)
        if (const auto group = variants.find(id); group != variants.end()) settle_variants(names, group->second);
    const auto gone = [&] {
        Names out;
        for (const NamedUnit* name : first_of_id)
            if (!found_.contains(name->id) && name->prints != nullptr) out.push_back(name);
        std::stable_sort(out.begin(), out.end(),
                         [](const NamedUnit* a, const NamedUnit* b) { return plain_id(a->id) < plain_id(b->id); });
        return out;
    };
    follow_texts(gone());
    follow_files(gone());
    follow_likeness(gone());
}

Resolved Resolver::find(const std::string& id) const {
    const auto found = found_.find(id);
    return found == found_.end() ? Resolved{} : found->second;
}

void Resolver::give(const std::string& id, const UnitState& unit, bool elsewhere) {
    found_[id] = {&unit, elsewhere};
    taken_.insert(&unit);
}

/// Gives each name the variant with its text, then the one with its signature, then that of its id, then what is left.
void Resolver::settle_variants(const Names& names, const std::vector<const UnitState*>& variants) {
    if (names.size() == 1 && variants.size() == 1) return give(names[0]->id, *variants[0], false);
    const auto by = [&](const Key& of_unit, const std::function<std::string(const NamedUnit&)>& of_name) {
        std::map<std::string, std::deque<const UnitState*>> free;
        for (const UnitState* unit : variants)
            if (!taken(*unit)) free[of_unit(*unit)].push_back(unit);
        for (const NamedUnit* name : names) {
            if (free.empty() || found_.contains(name->id)) continue;
            const std::string key = of_name(*name);
            const auto at = key.empty() ? free.end() : free.find(key);
            if (at == free.end() || at->second.empty()) continue;
            give(name->id, *at->second.front(), false);
            at->second.pop_front();
        }
    };
    if (names.size() > 1 || variants.size() > 1) {
        by([](const UnitState& u) { return u.id + " " + u.prints.written.text(); },
           [](const NamedUnit& n) {
               return n.prints != nullptr ? n.id + " " + n.prints->written.text() : std::string();
           });
        by([](const UnitState& u) { return u.prints.written.text(); },
           [](const NamedUnit& n) { return n.prints != nullptr ? n.prints->written.text() : std::string(); });
        by([](const UnitState& u) { return u.prints.renamed.text(); },
           [](const NamedUnit& n) { return n.prints != nullptr ? n.prints->renamed.text() : std::string(); });
        by([](const UnitState& u) { return signature_of(u.text); },
           [&](const NamedUnit& n) {
               return n.prints != nullptr ? signature_of(base_text_(n.prints->written)) : std::string();
           });
    }
    by([](const UnitState& u) { return u.id; }, [](const NamedUnit& n) { return n.id; });
    by([](const UnitState&) { return std::string("any"); }, [](const NamedUnit&) { return std::string("any"); });
}

/// By its text without names where that is long enough to be no chance, else by its name and exact text together.
void Resolver::follow_texts(const Names& gone) {
    if (gone.empty()) return;
    std::map<std::string, std::deque<const UnitState*>> by_text;
    for (const auto& [id, unit] : units_) {
        if (!is_free(unit)) continue;
        if (unit.text.size() >= kTokensOfOwnText) by_text[unit.prints.renamed.text()].push_back(&unit);
        by_text[unit.name + " " + unit.prints.written.text()].push_back(&unit);
    }
    const auto follow = [&](const NamedUnit& name, const std::string& text) {
        const auto found = by_text.find(text);
        if (found == by_text.end()) return;
        std::deque<const UnitState*>& units = found->second;
        while (!units.empty() && taken(*units.front())) units.pop_front();
        if (!units.empty()) give(name.id, *units.front(), true);
    };
    for (const NamedUnit* name : gone) follow(*name, split_id(name->id).second + " " + name->prints->written.text());
    for (const NamedUnit* name : gone)
        if (!found_.contains(name->id)) follow(*name, name->prints->renamed.text());
}

/// A file that no id leads to any more was moved where most of its units went, unless two files have as many.
void Resolver::follow_files(const Names& gone) {
    if (gone.empty()) return;
    std::map<std::string, std::vector<const UnitState*>> by_name;
    std::set<std::string> files;
    for (const auto& [id, unit] : units_) {
        files.insert(unit.file);
        if (is_free(unit)) by_name[unit.name].push_back(&unit);
    }
    std::map<std::string, std::map<std::string, size_t>> went;  // old file -> new file -> units of the same text
    for (const auto& [id, found] : found_)
        if (found.elsewhere) ++went[split_id(id).first][found.unit->file];
    for (const NamedUnit* name : gone) {
        const auto [file, unit_name] = split_id(name->id);
        for (const UnitState* unit : by_name[unit_name])
            if (unit->prints.renamed == name->prints->renamed) ++went[file][unit->file];
    }
    for (const NamedUnit* name : gone) {
        const auto [file, unit_name] = split_id(name->id);
        const auto& places = went[file];
        if (files.contains(file) || places.empty()) continue;
        const auto best = std::max_element(places.begin(), places.end(),
                                           [](const auto& a, const auto& b) { return a.second < b.second; });
        if (std::count_if(places.begin(), places.end(), [&](const auto& p) { return p.second == best->second; }) > 1)
            continue;
        for (const UnitState* unit : by_name[unit_name])
            if (unit->file == best->first && is_free(*unit)) give(name->id, *unit, true);
    }
}

/// A unit that was moved or renamed and edited at once: under its name it keeps most of its words, under another one in
/// its own file nearly all, or in a file that others of its own went to, and no other unit is as like.
void Resolver::follow_likeness(const Names& gone) {
    if (gone.empty()) return;
    constexpr double kUnderItsName = 0.6, kInItsFile = 0.85;
    constexpr size_t kMostWords = 20'000'000;  // beyond, what is gone is called gone
    std::unordered_map<std::string, std::vector<const UnitState*>> by_name, by_file;
    for (const auto& [id, unit] : units_) {
        if (!is_free(unit) || unit.text.size() < kTokensOfOwnText) continue;
        by_name[std::string(leaf_of(plain_id(unit.name)))].push_back(&unit);
        by_file[unit.file].push_back(&unit);
    }
    std::map<std::string, std::set<std::string>> went;  // old file -> the files that its units went to
    for (const auto& [id, found] : found_)
        if (found.elsewhere) went[split_id(id).first].insert(found.unit->file);
    size_t words = 0;
    for (const NamedUnit* name : gone) {
        const NormalText before = base_text_(name->prints->written);
        if (before.size() < kTokensOfOwnText) continue;
        const auto [file, unit_name] = split_id(name->id);
        const UnitState* best = nullptr;
        double likeness = 0, second = 0;
        const auto try_all = [&](const std::vector<const UnitState*>& units, double least) {
            for (const UnitState* unit : units) {
                words += before.size() + unit->text.size();
                if (words > kMostWords || unit == best || !is_free(*unit)) continue;
                const double found = shared_words(before, unit->text);
                if (found < least) continue;
                second = std::max(second, std::min(found, likeness));
                if (found > likeness) best = unit;
                likeness = std::max(likeness, found);
            }
        };
        if (const auto found = by_name.find(std::string(leaf_of(plain_id(unit_name)))); found != by_name.end())
            try_all(found->second, kUnderItsName);
        std::set<std::string> places = went[file];
        places.insert(file);
        if (best == nullptr)
            for (const std::string& place : places)
                if (const auto found = by_file.find(place); found != by_file.end()) try_all(found->second, kInItsFile);
        if (best != nullptr && second < likeness) give(name->id, *best, true);
    }
}

}  // namespace porttool
