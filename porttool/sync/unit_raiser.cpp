// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/unit_raiser.h"

#include <algorithm>

#include "porttool/scan/scan.h"
#include "porttool/sync/file_text.h"
#include "porttool/sync/unit_extent.h"
#include "porttool/sync/unit_place.h"

namespace porttool {
namespace {

constexpr size_t kHighest = 8;  ///< units that use one another
constexpr size_t kMostLifted = 16;

std::string name_alone(const Unit& unit) { return std::string(bare_leaf_of(unit.name)); }

bool is_member(const Unit& unit) { return unit.name.size() > unit.namespace_length + leaf_of(unit.name).size() + 2; }

/// True where a file may say what a name is, if only that it is a function or a type.
bool declares(const ScannedFile& file, uint32_t token) {
    const LexedText& lexed = file.lexed;
    if (token + 1 < lexed.tokens.size() && (lexed.view(token + 1) == "(" || lexed.view(token + 1) == "::")) return true;
    if (token == 0) return false;
    const std::string_view last = lexed.view(token - 1);
    return last == "struct" || last == "class" || last == "union" || last == "enum" || last == "define" ||
           last == "using" || last == "typename";
}

bool declares_before(const ScannedFile& file, uint32_t end, const std::string& name) {
    if (file.lexed.text.find(name) == std::string::npos) return false;
    for (uint32_t i = 0; i < end; ++i)
        if (file.lexed.view(i) == name && declares(file, i)) return true;
    return false;
}

std::set<std::string> words_of(const ScannedFile& file, const Unit& unit) {
    std::set<std::string> out;
    for (uint32_t i = unit.tokens.first; i < unit.tokens.end; ++i)
        if (file.lexed.tokens[i].kind == TokenKind::Identifier && i != unit.name_token) out.emplace(file.lexed.view(i));
    return out;
}

}  // namespace

UnitRaiser::Raised UnitRaiser::raise(Side to, Draft& draft, const std::string& user,
                                     const std::set<std::string>& names) {
    Raised out;
    if (names.empty() || draft.scanned.language == Language::Slang) return out;  // Slang knows names from below
    out.failure = raise_one(to, draft, user, names, 0, out.any);
    return out;
}

std::string UnitRaiser::raise_one(Side to, Draft& draft, const std::string& user, const std::set<std::string>& names,
                                  size_t depth, bool& any) {
    for (size_t lifted = 0;; ++lifted) {
        const Unit* here = draft.unit(user);
        if (here == nullptr) return "its port was lost";
        const Unit* below = declared_below(to, draft.scanned, *here, names);
        if (below == nullptr) return {};
        const std::string name = name_alone(*below), id = unit_id(draft.scanned, *below);
        const std::string failure = "it uses `" + name + "`, which the port's file declares below it; move that up";
        const std::set<std::string> uses = words_of(draft.scanned, *below);
        if (lifted == kMostLifted || depth == kHighest || !lift(draft, *below, *here)) return failure;
        any = true;
        if (!raise_one(to, draft, id, uses, depth + 1, any).empty()) return failure;
    }
}

const Unit* UnitRaiser::declared_below(Side to, const ScannedFile& file, const Unit& user,
                                       const std::set<std::string>& names) const {
    for (const Unit& unit : file.units)
        if (unit.tokens.first >= user.tokens.end && unit.kind != UnitKind::File && !is_member(unit) &&
            names.contains(name_alone(unit)) && !is_declared_above(to, file, user, name_alone(unit)) &&
            !is_below_in_source(to, unit_id(file, unit), unit_id(file, user)))
            return &unit;
    return nullptr;
}

bool UnitRaiser::is_declared_above(Side to, const ScannedFile& file, const Unit& user, const std::string& name) const {
    if (declares_before(file, user.tokens.first, name)) return true;
    const std::vector<ScannedFile>& files = knowledge_.files(to);
    return std::any_of(files.begin(), files.end(), [&](const ScannedFile& other) {
        return other.path != file.path &&
               declares_before(other, static_cast<uint32_t>(other.lexed.tokens.size()), name) &&
               includes(files, file, other);
    });
}

/// True where the counterparts stand in the same order: then something else declares the one, there as here.
bool UnitRaiser::is_below_in_source(Side to, const std::string& unit, const std::string& user) const {
    const UnitState *below = nullptr, *above = nullptr;
    const Side from = other_side(to);
    for (const JudgedPair& pair : checked_.judgement.pairs) {
        if (pair.id[to] == unit) below = pair.unit[from];
        if (pair.id[to] == user) above = pair.unit[from];
    }
    return below != nullptr && above != nullptr && below->file == above->file && below->start_line > above->end_line;
}

/// False where the two are no neighbours of one kind, on lines of their own.
bool UnitRaiser::lift(Draft& draft, const Unit& unit, const Unit& user) {
    const ScannedFile& file = draft.scanned;
    const UnitExtent from = extent_of(file, unit), place = extent_of(file, user);
    if (!from.has_lines || !place.has_lines || is_member(user) ||
        branches_around(file, unit.tokens.first) != branches_around(file, user.tokens.first))
        return false;
    const std::string& text = file.lexed.text;
    const auto line_start = [&](size_t at) { return at == 0 ? 0 : text.rfind('\n', at - 1) + 1; };
    const size_t first = line_start(from.comment), above = line_start(place.comment);
    size_t end = std::min(from.end + 1, text.size());
    const bool is_last = text.find_first_not_of(" \t\n", end) == std::string::npos;
    const bool is_apart =
        blank_lines_above(file.lexed, first) > 0 && (is_last || blank_lines_below(file.lexed, from.end) > 0);
    const std::string moved = text.substr(first, from.end - first) + "\n" + (is_apart ? "\n" : "");
    size_t cut = first;
    if (is_apart && is_last)
        cut = text.find_last_not_of(" \t\n", first - 1) + 2;
    else if (is_apart)
        end = std::min(text.find('\n', end), text.size() - 1) + 1;
    if (cut < above) return false;
    const std::optional<std::string> now = edit_file(draft.bytes, text, {{above, above, moved}, {cut, end, ""}});
    if (!now) return false;
    ScannedFile scanned = scan_text(file.path, *now);
    if (scanned.units.size() != file.units.size() || scanned.balanced != file.balanced) return false;
    drafts_.write(draft, *now, std::move(scanned));
    return true;
}

}  // namespace porttool
