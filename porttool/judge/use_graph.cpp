// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/use_graph.h"

#include <limits>
#include <set>
#include <string_view>
#include <unordered_map>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

std::string_view borne_name(const UnitState& unit) { return bare_leaf_of(unit.name); }

std::string_view stem_of_path(std::string_view path) {
    path.remove_prefix(path.rfind('/') + 1);  // npos + 1 is 0
    return path.substr(0, path.find('.'));
}

}  // namespace

UseGraph::UseGraph(const UnitsById& units) {
    for (const auto& [id, unit] : units) {
        units_.push_back(&unit);
        by_file_[unit.file].push_back(&unit);
    }
    uses_.resize(units_.size());
    // A name is a node of its own, so that many uses of many bearers are no product.
    using Names = std::unordered_map<std::string_view, uint32_t>;
    Names anywhere;
    std::set<std::string> called;  // NAME( of functions
    std::unordered_map<std::string_view, Names> in_file;
    const auto name_node = [&](Names& names, std::string_view name, uint32_t bearer) {
        const auto [found, is_new] = names.emplace(name, static_cast<uint32_t>(uses_.size()));
        if (is_new) uses_.emplace_back();
        uses_[found->second].push_back(bearer);
    };
    // A function is used where it is called: a local may bear the name of one. Names of the others count anywhere.
    const auto as_called = [&](std::string_view name) { return called.insert(std::string(name) + "(").first; };
    for (uint32_t i = 0; i < units_.size(); ++i) {
        const UnitState& unit = *units_[i];
        if (unit.kind == UnitKind::File) continue;
        const bool is_code = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
        const std::string_view name = is_code ? std::string_view(*as_called(borne_name(unit))) : borne_name(unit);
        name_node(anywhere, name, i);
        name_node(in_file[unit.file], name, i);
    }
    for (uint32_t i = 0; i < units_.size(); ++i) {
        const Names& near = in_file[units_[i]->file];
        const NormalText& text = units_[i]->text;
        const auto use = [&](std::string_view name) {
            if (const auto here = near.find(name); here != near.end())
                uses_[i].push_back(here->second);
            else if (const auto there = anywhere.find(name); there != anywhere.end())
                uses_[i].push_back(there->second);
        };
        for (size_t k = 0; k < text.size(); ++k) {
            if (!is_word_token(text[k])) continue;
            use(text[k]);
            if (k + 1 < text.size() && (text[k + 1] == "(" || text[k + 1] == "<")) use(std::string(text[k]) + "(");
        }
    }
    users_.resize(uses_.size());
    for (uint32_t node = 0; node < uses_.size(); ++node)
        for (const uint32_t used : uses_[node]) users_[used].push_back(node);
}

std::map<const UnitState*, size_t> UseGraph::reached(const std::vector<Marked>& starts, Along along) const {
    constexpr size_t kNone = std::numeric_limits<size_t>::max();
    const auto& next = along == Along::Uses ? uses_ : users_;
    std::map<const UnitState*, uint32_t> numbers;
    for (uint32_t i = 0; i < units_.size(); ++i) numbers.emplace(units_[i], i);
    std::vector<size_t> marks(next.size(), kNone);
    std::vector<uint32_t> queue;
    const auto visit = [&](uint32_t node, size_t mark) {
        if (marks[node] != kNone) return;
        marks[node] = mark;
        queue.push_back(node);
    };
    for (const Marked& start : starts)
        if (const auto found = numbers.find(start.unit); found != numbers.end()) visit(found->second, start.mark);
    for (size_t at = 0; at < queue.size(); ++at)
        for (const uint32_t node : next[queue[at]]) visit(node, marks[queue[at]]);
    std::map<const UnitState*, size_t> out;
    for (uint32_t i = 0; i < units_.size(); ++i)
        if (marks[i] != kNone) out.emplace(units_[i], marks[i]);
    return out;
}

std::vector<const UnitState*> UseGraph::units_of_file(const std::string& path) const {
    const auto found = by_file_.find(path);
    return found == by_file_.end() ? std::vector<const UnitState*>() : found->second;
}

std::vector<const UnitState*> UseGraph::units_of_stem(const std::string& stem) const {
    std::vector<const UnitState*> out;
    for (const auto& [path, units] : by_file_)
        if (stem_of_path(path) == stem) out.insert(out.end(), units.begin(), units.end());
    return out;
}

}  // namespace porttool
