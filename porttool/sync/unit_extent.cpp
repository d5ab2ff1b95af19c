// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/unit_extent.h"

#include <algorithm>

namespace porttool {
namespace {

/// True for a unit that ends with a semicolon of its own.
bool ends_with_semicolon(const ScannedFile& file, const Unit& unit) {
    const bool macro = unit.tokens.first > 0 && file.lexed.view(unit.tokens.first) == "#";
    return (unit.kind == UnitKind::Struct || unit.kind == UnitKind::Constant) && !macro;
}

TokenRange tokens_of(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    TokenRange out = unit.tokens;
    while (out.first > 0 && lexed.view(out.first - 1) == "typedef") --out.first;
    if (!ends_with_semicolon(file, unit) || lexed.view(out.end - 1) == ";") return out;
    // A name, or attributes, may follow the brace.
    constexpr uint32_t kMost = 8;
    for (uint32_t i = out.end; i < std::min(out.end + kMost, static_cast<uint32_t>(lexed.tokens.size())); ++i)
        if (lexed.view(i) == ";") {
            out.end = i + 1;
            break;
        }
    return out;
}

size_t line_start_of(const LexedText& text, size_t offset) {
    const size_t before = offset == 0 ? std::string::npos : text.text.rfind('\n', offset - 1);
    return before == std::string::npos ? 0 : before + 1;
}

size_t line_end_of(const LexedText& text, size_t offset) {
    return std::min(text.text.find('\n', offset), text.text.size());
}

bool is_blank(std::string_view text) { return text.find_first_not_of(" \t") == std::string_view::npos; }

}  // namespace

UnitExtent extent_of(const ScannedFile& file, const Unit& unit) {
    const LexedText& lexed = file.lexed;
    UnitExtent out;
    out.tokens = tokens_of(file, unit);
    const Token &first = lexed.tokens[out.tokens.first], &last = lexed.tokens[out.tokens.end - 1];
    out.code = first.offset;
    out.end = line_end_of(lexed, last.offset + last.length);
    // A comment that begins on the last line and goes on is part of that line.
    for (const LineSpan& comment : lexed.comments)
        if (comment.first == last.line && comment.last > last.line)
            out.end = line_end_of(lexed, lexed.line_starts[comment.last - 1]);
    const uint32_t before = out.tokens.first, after = out.tokens.end;
    out.has_lines = (before == 0 || lexed.tokens[before - 1].offset < line_start_of(lexed, out.code)) &&
                    (after == lexed.tokens.size() || lexed.tokens[after].offset > out.end) &&
                    is_blank(std::string_view(lexed.text)
                                 .substr(line_start_of(lexed, out.code), out.code - line_start_of(lexed, out.code)));
    uint32_t line = first.line;
    while (line >= 2 && line - 2 < file.lines.size() && file.lines[line - 2] == LineClass::Comment) --line;
    out.comment = line == first.line ? out.code : lexed.line_starts[line - 1];
    return out;
}

std::string indent_at(const LexedText& text, size_t offset) {
    const size_t first = line_start_of(text, offset);
    return text.text.substr(first, std::min(text.text.find_first_not_of(" \t", first), text.text.size()) - first);
}

size_t blank_lines_above(const LexedText& text, size_t line_start) {
    size_t count = 0;
    for (size_t at = line_start_of(text, line_start); at > 0 && count < 2; ++count) {
        const size_t above = line_start_of(text, at - 1);
        if (!is_blank(std::string_view(text.text).substr(above, at - 1 - above))) break;
        at = above;
    }
    return count;
}

size_t blank_lines_below(const LexedText& text, size_t line_end) {
    size_t count = 0;
    for (size_t at = line_end; at < text.text.size() && count < 2; ++count) {
        const size_t next = line_end_of(text, at + 1);
        if (at + 1 >= text.text.size() || !is_blank(std::string_view(text.text).substr(at + 1, next - at - 1))) break;
        at = next;
    }
    return count;
}

std::vector<uint32_t> branches_around(const ScannedFile& file, uint32_t token) {
    const std::vector<Directive>& all = file.lexed.directives;
    std::vector<uint32_t> out;
    for (size_t i = 0; i < all.size() && all[i].first_token < token; ++i) {
        switch (all[i].kind) {
            case DirectiveKind::If:
                out.push_back(all[i].line);
                break;
            case DirectiveKind::Elif:
            case DirectiveKind::Else:
                if (!out.empty()) out.back() = all[i].line;
                break;
            case DirectiveKind::Endif:
                if (!out.empty()) out.pop_back();
                break;
            default:
                break;
        }
    }
    const bool guarded = all.size() >= 3 && all.front().kind == DirectiveKind::If &&
                         all[1].kind == DirectiveKind::Define && all[1].line == all.front().line + 1 &&
                         all.back().kind == DirectiveKind::Endif;
    if (guarded && !out.empty() && out.front() == all.front().line) out.erase(out.begin());
    return out;
}

}  // namespace porttool
