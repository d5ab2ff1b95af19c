// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/scan.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "porttool/scan/brackets.h"
#include "porttool/scan/branches.h"
#include "porttool/scan/constants.h"
#include "porttool/scan/file_pragmas.h"
#include "porttool/scan/lexer.h"
#include "porttool/scan/suppressions.h"
#include "porttool/scan/units.h"
#include "porttool/text/fingerprint.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

bool starts_before(const Unit& a, const Unit& b) { return a.tokens.first < b.tokens.first; }

/// Joins structural units and macros; a macro inside a unit belongs to that unit. One table holds both where it can: of
/// tiny units it is ten times their text.
std::vector<Unit> merge(std::vector<Unit> units, std::vector<Unit> macros) {
    if (!std::is_sorted(units.begin(), units.end(), starts_before))
        std::stable_sort(units.begin(), units.end(), starts_before);
    size_t next = 0;
    uint32_t covered = 0;
    std::erase_if(macros, [&](const Unit& macro) {
        for (; next < units.size() && units[next].tokens.first < macro.tokens.first; ++next)
            covered = std::max(covered, units[next].tokens.end);
        return macro.tokens.first < covered;
    });
    if (units.empty()) return macros;
    const auto middle = static_cast<std::ptrdiff_t>(units.size());
    std::move(macros.begin(), macros.end(), std::back_inserter(units));
    std::inplace_merge(units.begin(), units.begin() + middle, units.end(), starts_before);
    return units;
}

/// Later units of one name get #2, #3.
void number_names(std::vector<Unit>& units) {
    std::map<std::string, int> seen;
    for (Unit& unit : units) {
        const int count = ++seen[unit.name];
        if (count > 1) unit.name += "#" + std::to_string(count);
    }
}

/// What no person wrote as a name is cut, with a number made of the whole after it: names stand in many places.
std::string shortened(std::string name) {
    constexpr size_t kLongest = 1024, kKept = 512;
    if (name.size() <= kLongest) return name;
    Fingerprinter print;
    print.add(name);
    size_t kept = kKept;
    while (kept > 0 && (static_cast<unsigned char>(name[kept]) & 0xC0) == 0x80) --kept;  // no half of a character
    return name.substr(0, kept) + "~" + print.digits();
}

/// Names of old files in Latin-1 must not make a map that is no valid text: their bytes are written as %E4.
std::string with_other_bytes_escaped(const std::string& name) {
    std::string out;
    for (size_t i = 0; i < name.size();) {
        if (const size_t length = utf8_length(std::string_view(name).substr(i)); length > 0) {
            out.append(name, i, length);
            i += length;
            continue;
        }
        constexpr char kDigits[] = "0123456789ABCDEF";
        const auto byte = static_cast<unsigned char>(name[i++]);
        out += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
    }
    return out;
}

void mark(std::vector<LineClass>& lines, uint32_t first, uint32_t last, LineClass line_class) {
    for (uint32_t line = std::max(1u, first); line <= last && line <= lines.size(); ++line)
        lines[line - 1] = std::max(lines[line - 1], line_class);
}

/// Classes hold other units, to any depth: units are counted in and out.
void mark_units(ScannedFile& file) {
    std::vector<int32_t> change(file.lines.size() + 2, 0);
    for (const Unit& unit : file.units) {
        if (unit.start_line > file.lines.size()) continue;
        ++change[unit.start_line];
        --change[std::min<size_t>(unit.end_line, file.lines.size()) + 1];
    }
    int32_t within = 0;
    for (size_t line = 1; line <= file.lines.size(); ++line) {
        within += change[line];
        if (within > 0) file.lines[line - 1] = LineClass::Unit;
    }
}

void classify_lines(ScannedFile& file, const std::vector<TokenRange>& declarations) {
    const LexedText& lexed = file.lexed;
    file.lines.assign(lexed.line_count, LineClass::Blank);
    for (const LineSpan& comment : lexed.comments) mark(file.lines, comment.first, comment.last, LineClass::Comment);
    std::vector<int32_t> change(lexed.tokens.size() + 1, 0);  // ranges nest: count them in and out
    for (const TokenRange& range : declarations) {
        ++change[range.first];
        --change[range.end];
    }
    int32_t understood = 0;
    for (uint32_t i = 0; i < lexed.tokens.size(); ++i) {
        const Token& token = lexed.tokens[i];
        understood += change[i];
        LineClass line_class = LineClass::Unclassified;
        if (token.flags & kDead)
            line_class = LineClass::Comment;
        else if (token.flags & kInDirective)
            line_class = LineClass::Directive;
        else if (understood > 0 || (token.flags & kOffStructure))
            line_class = LineClass::Declaration;
        uint32_t last = token.line;
        if (token.kind == TokenKind::String)  // raw strings span lines
            last += static_cast<uint32_t>(std::count(lexed.view(token).begin(), lexed.view(token).end(), '\n'));
        mark(file.lines, token.line, last, line_class);
    }
    for (const Directive& directive : lexed.directives)
        mark(file.lines, directive.line, directive.end_line, LineClass::Directive);
    mark_units(file);
}

}  // namespace

std::string_view unit_kind_name(UnitKind kind) {
    switch (kind) {
        case UnitKind::Function:
            return "function";
        case UnitKind::Kernel:
            return "kernel";
        case UnitKind::Struct:
            return "struct";
        case UnitKind::Constant:
            return "constant";
        case UnitKind::File:
            break;
    }
    return "file";
}

ScannedFile scan_text(std::string_view path, std::string_view text) {
    ScannedFile file;
    file.path = std::string(path);
    file.language = language_of_text(language_of_path(path), path, text);
    file.lexed = lex(text);
    choose_branches(file.lexed);
    UnitList found;
    {
        const Structure structure = match_brackets(file.lexed);  // as large as the text: gone before the next big table
        file.balanced = structure.balanced;
        found = find_units(file.lexed, structure, file.language);
    }
    file.units = merge(std::move(found.units), find_macro_units(file.lexed));
    for (Unit& unit : file.units) {
        unit.name = shortened(with_other_bytes_escaped(unit.name));
        unit.namespace_length = std::min(unit.namespace_length, static_cast<uint32_t>(unit.name.size()));
    }
    number_names(file.units);
    for (const Unit& unit : file.units) found.declarations.push_back(unit.tokens);
    file.variables = std::move(found.variables);
    read_variable_pragmas(file.lexed, file.variables);
    file.pragmas = read_file_pragmas(file.lexed, file.units);
    for (const std::string_view name : spelling_macros(file.lexed)) file.spelling_macros.emplace_back(name);
    std::stable_sort(file.variables.begin(), file.variables.end(), [&](const FileVariable& a, const FileVariable& b) {
        return file.lexed.view(a.name_token) < file.lexed.view(b.name_token);
    });
    classify_lines(file, found.declarations);
    attach_suppressions(file);
    return file;
}

std::string unit_id(const ScannedFile& file, const Unit& unit) { return file.path + ":" + unit.name; }

std::pair<std::string, std::string> split_id(const std::string& id) {
    // The last lone colon: a file may have some in its name, a unit has only pairs of them.
    for (size_t i = id.size(); i-- > 0;) {
        if (id[i] != ':') continue;
        if (i == 0 || id[i - 1] != ':') return {id.substr(0, i), id.substr(i + 1)};
        --i;
    }
    return {id, {}};
}

std::string_view leaf_of(std::string_view name) {
    const size_t colons = name.rfind("::");
    return colons == std::string_view::npos ? name : name.substr(colons + 2);
}

std::string_view bare_leaf_of(std::string_view name) {
    const std::string_view leaf = leaf_of(name);
    return leaf.substr(0, leaf.find('#'));
}

Unit whole_file_unit(const ScannedFile& file) {
    Unit unit;
    unit.kind = UnitKind::File;
    unit.name = "@file";
    unit.start_line = 1;
    unit.end_line = std::max(1u, file.lexed.line_count);
    unit.tokens = {0, static_cast<uint32_t>(file.lexed.tokens.size())};
    unit.body = unit.tokens;
    return unit;
}

}  // namespace porttool
