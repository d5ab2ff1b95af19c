// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/leaves.h"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <utility>

namespace porttool {
namespace {

std::vector<std::string_view> fields_of_line(std::string_view line, size_t most) {
    std::vector<std::string_view> out;
    for (size_t at = 0; at <= line.size();) {
        const size_t end = out.size() + 1 == most ? line.size() : std::min(line.find(' ', at), line.size());
        out.push_back(line.substr(at, end - at));
        at = end + 1;
    }
    return out;
}

std::string reason_of(std::string_view why, std::string_view path) {
    const std::string where = path.empty() ? "what it returns" : std::string(path);
    if (why == "pointer" || why == "returned") return "pointer of unknown length: " + where;
    if (why == "deep") return "a name of more than 1000 letters: " + where.substr(0, where.find_first_of(".["));
    if (why == "many") return "more than 2048 numbers: " + where.substr(0, where.find_first_of(".["));
    if (why == "union") return "a union: " + where;
    if (why == "layout") return "a type whose layout is not known: " + where;
    return "a type that cannot be filled: " + where;
}

Leaf leaf_of_line(const std::vector<std::string_view>& words) {
    Leaf out;
    out.parameter = std::atoi(std::string(words[1]).c_str());
    const char kind = words[2].empty() ? 'f' : words[2][0];
    out.bytes = std::atoi(std::string(words[2].substr(std::min<size_t>(1, words[2].size()))).c_str());
    out.kind = kind == 'f'   ? (out.bytes == 8   ? NumberKind::Double
                                : out.bytes == 2 ? NumberKind::Half
                                                 : NumberKind::Float)
               : kind == 'b' ? NumberKind::Bool
               : kind == 'u' ? NumberKind::Unsigned
                             : NumberKind::Signed;
    if (words.size() > 3) out.path = words[3];
    return out;
}

/// The path without the parameter's own name, which the other side may call differently.
std::string_view beneath_parameter(const Leaf& leaf) {
    const std::string_view path = leaf.path;
    const size_t at = path.find_first_of(".[");
    if (leaf.parameter < 0) return path;
    return at == std::string_view::npos ? std::string_view() : path.substr(at);
}

/// The places of each parameter's numbers, by the parameter.
std::map<int, std::vector<size_t>> by_parameter(const std::vector<Leaf>& leaves) {
    std::map<int, std::vector<size_t>> out;
    for (size_t i = 0; i < leaves.size(); ++i) out[leaves[i].parameter].push_back(i);
    return out;
}

bool fit(const Leaf& a, const Leaf& b) { return a.is_real() == b.is_real(); }

/// Pairs the numbers of one parameter with those of its counterpart: by their names, else by their order.
bool match_parameter(const std::vector<Leaf>& source, const std::vector<size_t>& ours, const std::vector<Leaf>& target,
                     const std::vector<size_t>& theirs, std::vector<BySide<size_t>>& out) {
    if (ours.size() != theirs.size()) return false;
    std::map<std::string_view, size_t> names;
    for (const size_t at : theirs) names.emplace(beneath_parameter(target[at]), at);
    const bool named = names.size() == theirs.size() && std::all_of(ours.begin(), ours.end(), [&](size_t at) {
                           return names.contains(beneath_parameter(source[at]));
                       });
    for (size_t i = 0; i < ours.size(); ++i) {
        const size_t at = named ? names[beneath_parameter(source[ours[i]])] : theirs[i];
        if (!fit(source[ours[i]], target[at])) return false;
        out[ours[i]] = {ours[i], at};
    }
    return true;
}

std::string parameters_text(size_t count) { return std::to_string(count) + (count == 1 ? " number" : " numbers"); }

bool match_side(const std::vector<Leaf>& source, const std::vector<Leaf>& target, std::vector<BySide<size_t>>& out) {
    out.assign(source.size(), {});
    const auto ours = by_parameter(source), theirs = by_parameter(target);
    if (ours.size() == theirs.size()) {
        bool all = true;
        auto other = theirs.begin();
        for (const auto& [parameter, places] : ours) {
            all = all && match_parameter(source, places, target, other->second, out);
            ++other;
        }
        if (all) return true;
    }
    // As many numbers of the same kinds in the same order, whatever they are held in.
    if (source.size() != target.size()) return false;
    for (size_t i = 0; i < source.size(); ++i) {
        if (!fit(source[i], target[i])) return false;
        out[i] = {i, i};
    }
    return true;
}

/// True for a number that nothing looks at: a part of its path is named nowhere.
bool is_idle(const Leaf& leaf, const TextOfSide& text) {
    const std::string_view path = beneath_parameter(leaf);
    for (size_t at = 0; at < path.size();) {
        const size_t end = std::min(path.find_first_of(".[", at + 1), path.size());
        const std::string_view part = path.substr(at + 1, end - at - 1);
        if (path[at] == '.' && part.size() > 1 && !text.words.contains(part)) return true;
        at = end;
    }
    return false;
}

/// The places of each parameter's numbers that are looked at, and of those that are not.
struct UsedPlaces {
    std::map<int, std::vector<size_t>> used, idle;
};
UsedPlaces used_places(const std::vector<Leaf>& leaves, const TextOfSide& text, bool are_given) {
    UsedPlaces out;
    for (size_t i = 0; i < leaves.size(); ++i) {
        if (are_given && text.unwritten.contains(leaves[i].parameter)) continue;
        const bool idle = is_idle(leaves[i], text);
        (idle ? out.idle : out.used)[leaves[i].parameter].push_back(i);
    }
    return out;
}

using NamedPlaces = std::map<std::string_view, size_t>;

/// The places of what stands beneath a name and is a real number, or is none, in their order.
std::vector<size_t> beneath(const NamedPlaces& all, const std::vector<Leaf>& leaves, std::string_view name,
                            bool is_real) {
    std::vector<size_t> out;
    for (auto at = all.lower_bound(name); at != all.end() && at->first.starts_with(name); ++at)
        if (leaves[at->second].is_real() == is_real && at->first.size() > name.size() && at->first[name.size()] == '.')
            out.push_back(at->second);
    std::sort(out.begin(), out.end());
    return out;
}

/// Pairs what stands beneath the nearest name that both sides have by its order: `m.a.x` with `m.rows.a11`.
bool match_by_order(const BySide<const std::vector<Leaf>*>& leaves, const BySide<NamedPlaces>& all, Side side,
                    std::string_view name, std::set<size_t>& done, std::vector<BySide<size_t>>& out) {
    const bool is_real = (*leaves[side])[all[side].at(name)].is_real();
    for (size_t dot = name.rfind('.'); dot != std::string_view::npos && dot > 0; dot = name.rfind('.', dot - 1)) {
        const std::string_view above = name.substr(0, dot);
        const auto ours = beneath(all.source, *leaves.source, above, is_real);
        const auto theirs = beneath(all.target, *leaves.target, above, is_real);
        if ((side == Side::Source ? theirs : ours).empty()) continue;
        if (ours.size() != theirs.size()) return false;
        for (size_t i = 0; i < ours.size(); ++i)
            if (done.insert(ours[i]).second) out.push_back({ours[i], theirs[i]});
        return true;
    }
    return false;
}

/// True where something stands beneath the value that a field belongs to: `m.a` for `m.is_set`.
bool has_beside(const NamedPlaces& all, std::string_view name) {
    const size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || dot == 0) return false;
    const auto at = all.lower_bound(name.substr(0, dot + 1));
    return at != all.end() && at->first.starts_with(name.substr(0, dot + 1));
}

/// Pairs what both look at of one parameter by its names; what only one looks at must be there on the other side.
bool match_used(const BySide<const std::vector<Leaf>*>& leaves, const BySide<UsedPlaces>& places,
                const BySide<int>& parameter, std::vector<BySide<size_t>>& out, LeafMatch& guesses) {
    BySide<NamedPlaces> all, used;
    std::set<size_t> done;  // of the source's
    for (const Side side : kBothSides)
        for (const auto* some : {&places[side].used, &places[side].idle})
            if (const auto found = some->find(parameter[side]); found != some->end())
                for (const size_t at : found->second) {
                    std::string_view name = beneath_parameter((*leaves[side])[at]);
                    if (name.starts_with(".")) name.remove_prefix(1);  // what is returned has no name
                    if (!all[side].emplace(name, at).second) return false;
                    if (some == &places[side].used) used[side].emplace(name, at);
                }
    for (const Side side : kBothSides)
        for (const auto& [name, at] : used[side]) {
            const auto there = all[other(side)].find(name);
            if (there == all[other(side)].end()) {
                if (match_by_order(leaves, all, side, name, done, out)) {
                    guesses.ordered = (*leaves[side])[at].path;
                    continue;
                }
                // What one side notes of a value that both have, it has noted nothing of.
                if ((*leaves[side])[at].kind != NumberKind::Bool || !has_beside(all[other(side)], name)) return false;
                guesses.zeroed = (*leaves[side])[at].path;
                guesses.marks[side].push_back(at);
                continue;
            }
            if (!fit((*leaves[side])[at], (*leaves[other(side)])[there->second])) return false;
            const BySide<size_t> both =
                side == Side::Source ? BySide<size_t>{at, there->second} : BySide<size_t>{there->second, at};
            if (done.insert(both.source).second) out.push_back(both);
        }
    return true;
}

/// The name of the parameter that a number belongs to.
std::string_view parameter_of(const Leaf& leaf) {
    return std::string_view(leaf.path).substr(0, leaf.path.find_first_of(".["));
}

/// A lone whole number that one side takes among parameters that both have under the same names in one order: by its
/// number there, and the side. `f ( rows , n , first )` and `f ( rows , n )`.
std::optional<std::pair<Side, int>> lone_parameter(const BySide<const std::vector<Leaf>*>& leaves,
                                                   const BySide<UsedPlaces>& places) {
    BySide<std::vector<std::pair<std::string_view, int>>> names;
    for (const Side side : kBothSides)
        for (const auto& [parameter, numbers] : places[side].used)
            names[side].emplace_back(parameter_of((*leaves[side])[numbers.front()]), parameter);
    const Side more = names.source.size() > names.target.size() ? Side::Source : Side::Target;
    auto& longer = names[more];
    const auto& shorter = names[other(more)];
    if (longer.size() != shorter.size() + 1) return std::nullopt;
    size_t at = 0;
    while (at < shorter.size() && longer[at].first == shorter[at].first) ++at;
    const auto [name, parameter] = longer[at];
    longer.erase(longer.begin() + static_cast<ptrdiff_t>(at));
    const bool others_agree = std::equal(longer.begin(), longer.end(), shorter.begin(),
                                         [](const auto& a, const auto& b) { return a.first == b.first; });
    const std::vector<size_t>& numbers = places[more].used.at(parameter);
    const bool is_one = numbers.size() == 1 && (*leaves[more])[numbers.front()].path == name;
    if (!others_agree || !is_one || name.empty()) return std::nullopt;
    const NumberKind kind = (*leaves[more])[numbers.front()].kind;
    return kind == NumberKind::Signed || kind == NumberKind::Unsigned ? std::optional(std::pair(more, parameter))
                                                                      : std::nullopt;
}

bool match_used_side(const BySide<const std::vector<Leaf>*>& leaves, const BySide<TextOfSide>& texts, bool are_given,
                     std::vector<BySide<size_t>>& out, LeafMatch& guesses) {
    out.clear();
    BySide<UsedPlaces> places = {used_places(*leaves.source, texts.source, are_given),
                                 used_places(*leaves.target, texts.target, are_given)};
    if (const auto lone = are_given ? std::nullopt : lone_parameter(leaves, places)) {
        const auto& [side, parameter] = *lone;
        const size_t place = places[side].used.at(parameter).front();
        guesses.lone = (*leaves[side])[place].path;
        guesses.zeroed = guesses.lone;
        guesses.marks[side].push_back(place);
        places[side].used.erase(parameter);
    }
    const auto &ours = places.source.used, &theirs = places.target.used;
    if (ours.size() != theirs.size()) return false;
    auto other = theirs.begin();
    for (const auto& [parameter, numbers] : ours) {
        if (!match_used(leaves, places, {parameter, other->first}, out, guesses)) return false;
        ++other;
    }
    std::sort(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.source < b.source; });
    return true;
}

}  // namespace

std::map<int, Leaves> read_leaves(std::string_view text) {
    std::map<int, Leaves> out;
    Leaves* current = nullptr;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\n', at), text.size());
        const std::vector<std::string_view> words = fields_of_line(text.substr(at, end - at), 4);
        at = end + 1;
        if (words[0] == "subject" && words.size() > 1) current = &out[std::atoi(std::string(words[1]).c_str())];
        if (current == nullptr || words.size() < 3) continue;
        if (words[0] == "in") current->in.push_back(leaf_of_line(words));
        if (words[0] == "out") current->out.push_back(leaf_of_line(words));
        if (words[0] == "guess" && current->guess.empty() && words.size() > 3) current->guess = words[3];
        if (words[0] == "bad" && current->reason.empty())
            current->reason = reason_of(words[2], words.size() > 3 ? words[3] : std::string_view());
    }
    for (auto& [number, leaves] : out)
        if (leaves.reason.empty() && leaves.out.empty()) leaves.reason = "void, and nothing that it writes to";
    return out;
}

LeafMatch match_leaves(const Leaves& source, const Leaves& target) {
    LeafMatch out;
    if (!match_side(source.in, target.in, out.in))
        out.reason = "the parameters differ: " + parameters_text(source.in.size()) + " in the source, " +
                     parameters_text(target.in.size()) + " in the target";
    else if (!match_side(source.out, target.out, out.out))
        out.reason = "what they give differs: " + parameters_text(source.out.size()) + " from the source, " +
                     parameters_text(target.out.size()) + " from the target";
    return out;
}

LeafMatch match_used_leaves(const Leaves& source, const Leaves& target, const BySide<TextOfSide>& texts) {
    LeafMatch out, given;
    if (!match_used_side({&source.in, &target.in}, texts, false, out.in, out) ||
        !match_used_side({&source.out, &target.out}, texts, true, out.out, given) || out.out.empty())
        out.reason = "they look at different numbers";
    if (out.zeroed.empty()) out.zeroed = given.zeroed;  // a mark that is only given is not compared
    if (out.ordered.empty()) out.ordered = given.ordered;
    return out;
}

}  // namespace porttool
