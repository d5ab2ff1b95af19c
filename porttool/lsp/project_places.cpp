// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/project_places.h"

#include <algorithm>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/scan.h"

namespace porttool::lsp {
namespace {

/// A line of a scanned file (from 1) without its end.
std::string_view line_of(const ScannedFile& file, uint32_t line) {
    const LexedText& lexed = file.lexed;
    if (line == 0 || line > lexed.line_starts.size()) return {};
    const std::string_view rest = std::string_view(lexed.text).substr(lexed.line_starts[line - 1]);
    return rest.substr(0, rest.find('\n'));
}

Range range_of_token(const ScannedFile& file, const Utf16Counts& counts, const Token& token) {
    const uint32_t first = counts.between(file.lexed.line_starts[token.line - 1], token.offset);
    const uint32_t length = utf16_length(std::string_view(file.lexed.text).substr(token.offset, token.length));
    return {{token.line - 1, first}, {token.line - 1, first + length}};
}

Range range_of_line(const ScannedFile& file, uint32_t line) {
    const std::string_view text = line_of(file, line);
    const size_t first = std::min(text.find_first_not_of(" \t"), text.size());
    const size_t end = text.find_last_not_of(" \t") + 1;
    const uint32_t row = line == 0 ? 0 : line - 1;
    return {{row, utf16_length(text.substr(0, first))}, {row, utf16_length(text.substr(0, std::max(first, end)))}};
}

bool holds(const Unit& unit, uint32_t line) { return unit.start_line <= line && line <= unit.end_line; }

}  // namespace

std::string PlacedUnit::id() const { return unit_id(*file, unit != nullptr ? *unit : whole_file_unit(*file)); }

ProjectPlaces::ProjectPlaces(const CheckedProject& project) : project_(project) {
    for (const Side side : kBothSides)
        for (const ScannedFile& file : side == Side::Source ? project.project.source : project.project.target)
            files_[path_of(side, file.path)].push_back({side, &file});
}

std::string ProjectPlaces::path_of(Side side, const std::string& file) const {
    const std::string root = side == Side::Source ? project_.project.root : target_root(project_.project);
    return absolute_path(join_path(root, file));
}

std::vector<PlacedUnit> ProjectPlaces::at(const std::string& path, uint32_t line) const {
    std::vector<PlacedUnit> out;
    const auto found = files_.find(path);
    if (found == files_.end()) return out;
    for (const auto& [side, file] : found->second) {
        std::vector<const Unit*> units;
        for (const Unit& unit : file->units)
            if (holds(unit, line)) units.push_back(&unit);
        std::stable_sort(units.begin(), units.end(), [](const Unit* a, const Unit* b) {
            return a->end_line - a->start_line < b->end_line - b->start_line;
        });
        for (const Unit* unit : units) out.push_back({side, path, file, unit});
        out.push_back({side, path, file, nullptr});
    }
    return out;
}

Range ProjectPlaces::range_of(const std::string& path, const std::string& id, uint32_t line) const {
    const auto found = files_.find(path);
    if (found == files_.end()) return {{line == 0 ? 0 : line - 1, 0}, {line == 0 ? 0 : line - 1, 0}};
    for (const auto& [side, file] : found->second) {
        const KnownFile& there = known(*file);
        if (const auto name = there.names.find(id); name != there.names.end())
            return range_of_token(*file, there.counts, *name->second);
    }
    return range_of_line(*found->second.front().file, std::max(line, 1U));
}

const ProjectPlaces::KnownFile& ProjectPlaces::known(const ScannedFile& file) const {
    if (const auto found = known_.find(&file); found != known_.end()) return found->second;
    KnownFile made{{}, Utf16Counts(file.lexed.text)};
    for (const Unit& unit : file.units)
        if (unit.name_token < file.lexed.tokens.size())
            made.names.emplace(unit_id(file, unit), &file.lexed.tokens[unit.name_token]);
    return known_.emplace(&file, std::move(made)).first->second;
}

std::vector<const JudgedPair*> ProjectPlaces::pairs_of(const PlacedUnit& unit) const {
    std::vector<const JudgedPair*> out;
    const std::string id = unit.id();
    for (const JudgedPair& pair : project_.judgement.pairs)
        if (pair.unit[unit.side] != nullptr && pair.unit[unit.side]->id == id) out.push_back(&pair);
    return out;
}

bool is_about_unit(const PlacedUnit& unit, Position at) {
    const std::vector<Token>& tokens = unit.file->lexed.tokens;
    if (unit.unit == nullptr) return true;
    const Utf16Counts counts(unit.file->lexed.text);
    for (uint32_t i = unit.unit->body.first; i < unit.unit->body.end && i < tokens.size(); ++i) {
        if (tokens[i].kind != TokenKind::Identifier || tokens[i].line != at.line + 1) continue;
        const Range range = range_of_token(*unit.file, counts, tokens[i]);
        if (range.start <= at && at <= range.end) return false;
    }
    return true;
}

}  // namespace porttool::lsp
