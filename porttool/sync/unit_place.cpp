// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/unit_place.h"

#include <algorithm>

#include "porttool/scan/scan.h"
#include "porttool/sync/unit_extent.h"

namespace porttool {
namespace {

bool stands_within_another(const ScannedFile& file, const Unit& unit) {
    return std::any_of(file.units.begin(), file.units.end(), [&](const Unit& other) {
        return &other != &unit && other.tokens.first <= unit.tokens.first && unit.tokens.end <= other.tokens.end;
    });
}

/// True if all that the new unit uses stands above a place, and what uses it below.
bool is_in_order(const PlaceWanted& wanted, size_t offset) {
    const LexedText& lexed = wanted.target.lexed;
    if (wanted.user != nullptr && lexed.tokens[wanted.user->tokens.first].offset < offset) return false;
    std::set<std::string_view> above, below;
    for (const Unit& unit : wanted.target.units) {
        const std::string_view name = leaf_of(unit.name);
        (lexed.tokens[unit.tokens.first].offset < offset ? above : below).insert(name.substr(0, name.find('#')));
    }
    return std::all_of(wanted.uses.begin(), wanted.uses.end(),
                       [&](const std::string& name) { return above.contains(name) || !below.contains(name); });
}

std::string file_name(std::string_view path) { return std::string(path.substr(path.find_last_of('/') + 1)); }

/// The file that an include names, as the last part of its path; "" for none.
std::string included_name(const LexedText& lexed, const Directive& directive) {
    if (directive.kind != DirectiveKind::Include || directive.first_token >= directive.end_token) return {};
    const Token& last = lexed.tokens[directive.end_token - 1];
    const size_t start = lexed.line_starts[directive.line - 1];
    std::string text = lexed.text.substr(start, last.offset + last.length - start);
    while (!text.empty() && (text.back() == '"' || text.back() == '>' || text.back() == ' ')) text.pop_back();
    const size_t cut = text.find_last_of("/\"< ");
    return cut == std::string::npos ? std::string() : text.substr(cut + 1);
}

}  // namespace

UnitPlace place_of_new_unit(const PlaceWanted& wanted) {
    const UnitExtent own = extent_of(wanted.source, wanted.unit);
    const std::vector<uint32_t> branches = branches_around(wanted.source, own.tokens.first);
    std::vector<StandsFor> before, after;
    for (const StandsFor& pair : wanted.pairs) {
        if (pair.source == nullptr || pair.port == nullptr || stands_within_another(wanted.source, *pair.source) ||
            stands_within_another(wanted.target, *pair.port))
            continue;
        (pair.source->tokens.first < wanted.unit.tokens.first ? before : after).push_back(pair);
    }
    const auto by_place = [](const StandsFor& a, const StandsFor& b) {
        return a.source->tokens.first < b.source->tokens.first;
    };
    std::stable_sort(before.rbegin(), before.rend(), by_place);
    std::stable_sort(after.begin(), after.end(), by_place);
    bool any = false;
    for (const bool below : {true, false})
        for (const StandsFor& pair : below ? before : after) {
            const UnitExtent port = extent_of(wanted.target, *pair.port);
            const bool same_branch = branches_around(wanted.source, pair.source->tokens.first) == branches &&
                                     branches_around(wanted.target, pair.port->tokens.first).size() == branches.size();
            if (!port.has_lines || !same_branch) continue;
            any = true;
            const size_t offset = below ? port.end : port.comment;
            if (!is_in_order(wanted, offset)) continue;
            UnitPlace out;
            out.found = true;
            out.below = below;
            out.offset = offset;
            out.indent = indent_at(wanted.target.lexed, port.code);
            if (!below && port.comment == port.code) out.offset -= out.indent.size();
            out.blank_lines = below ? blank_lines_above(wanted.source.lexed, own.comment)
                                    : blank_lines_below(wanted.source.lexed, own.end);
            return out;
        }
    UnitPlace out;
    out.failure = any ? "beside its neighbours' ports it would stand above what it uses, or below what uses it"
                      : "nothing beside it has a port in that file";
    return out;
}

bool includes(const std::vector<ScannedFile>& files, const ScannedFile& file, const ScannedFile& wanted) {
    std::set<std::string> seen = {file_name(file.path)};
    std::vector<const ScannedFile*> open = {&file};
    const std::string goal = file_name(wanted.path);
    while (!open.empty()) {
        const ScannedFile* here = open.back();
        open.pop_back();
        for (const Directive& directive : here->lexed.directives) {
            const std::string name = included_name(here->lexed, directive);
            if (name == goal) return true;
            if (name.empty() || !seen.insert(name).second) continue;
            for (const ScannedFile& other : files)
                if (file_name(other.path) == name) open.push_back(&other);
        }
    }
    return false;
}

}  // namespace porttool
