// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/rescan.h"

#include <algorithm>

#include "porttool/scan/lexer.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/rewrite.h"

namespace porttool {
namespace {

/// The lines of a unit, and its tokens, with the semicolon that ends a constant or a struct.
struct Window {
    uint32_t first_byte = 0, end_byte = 0;
    uint32_t first_line = 0, lines = 0;  ///< first_line from 0
    TokenRange tokens;
};

/// True if indices, bytes and lines of a file can be moved along by what follows it.
bool is_plain(const ScannedFile& file) {
    return file.balanced && file.pragmas.empty() &&
           std::none_of(file.lexed.directives.begin(), file.lexed.directives.end(), [](const Directive& one) {
               return one.kind == DirectiveKind::Else || one.kind == DirectiveKind::Elif;
           });
}

bool is_semicolon(const LexedText& lexed, size_t token) {
    return token < lexed.tokens.size() && lexed.tokens[token].length == 1 &&
           lexed.text[lexed.tokens[token].offset] == ';';
}

bool window_of(const ScannedFile& file, const Unit& unit, Window& out) {
    const LexedText& lexed = file.lexed;
    if (!unit.holes.empty() || unit.tokens.empty()) return false;
    const uint32_t after = unit.tokens.end + (is_semicolon(lexed, unit.tokens.end) ? 1 : 0);
    const Token &first = lexed.tokens[unit.tokens.first], &last = lexed.tokens[after - 1];
    out.tokens = {unit.tokens.first, after};
    out.first_line = first.line - 1;
    out.first_byte = lexed.line_starts[out.first_line];
    const size_t end = lexed.text.find('\n', last.offset + last.length);
    if (end == std::string::npos) return false;
    out.end_byte = static_cast<uint32_t>(end + 1);
    const auto next_line = std::lower_bound(lexed.line_starts.begin(), lexed.line_starts.end(), out.end_byte);
    if (next_line == lexed.line_starts.end() || *next_line != out.end_byte) return false;
    out.lines = static_cast<uint32_t>(next_line - lexed.line_starts.begin()) - out.first_line;
    const auto touches = [&](uint32_t line, uint32_t end_line) {
        return end_line > out.first_line && line <= out.first_line + out.lines;
    };
    const bool alone = (unit.tokens.first == 0 || lexed.tokens[unit.tokens.first - 1].line <= out.first_line) &&
                       (after == lexed.tokens.size() || lexed.tokens[after].line > out.first_line + out.lines);
    // Comments follow one another, and a file can have as many of them as units.
    const auto comment = std::partition_point(lexed.comments.begin(), lexed.comments.end(),
                                              [&](const LineSpan& one) { return one.last <= out.first_line; });
    return alone &&
           std::none_of(lexed.directives.begin(), lexed.directives.end(),
                        [&](const Directive& one) { return touches(one.line, one.end_line); }) &&
           (comment == lexed.comments.end() || !touches(comment->first, comment->last)) &&
           std::none_of(lexed.suppressions.begin(), lexed.suppressions.end(),
                        [&](const Suppression& one) { return touches(one.line, one.line); }) &&
           std::all_of(lexed.tokens.begin() + unit.tokens.first, lexed.tokens.begin() + after,
                       [](const Token& token) { return (token.flags & ~kStartsLine) == 0; });
}

/// The one unit that a text is, read by itself; nullptr where it is more or other than that.
const Unit* only_unit(const ScannedFile& piece, Language language) {
    const bool plain = piece.balanced && piece.language == language && piece.lexed.directives.empty() &&
                       piece.lexed.comments.empty() && piece.lexed.suppressions.empty() && piece.variables.empty() &&
                       piece.pragmas.empty() && piece.units.size() == 1;
    const Unit* unit = plain ? &piece.units.front() : nullptr;
    if (unit == nullptr || unit->tokens.first != 0 || !unit->holes.empty()) return nullptr;
    const size_t end = unit->tokens.end + (is_semicolon(piece.lexed, unit->tokens.end) ? 1 : 0);
    return end == piece.lexed.tokens.size() ? unit : nullptr;
}

bool same_range(TokenRange a, TokenRange b, uint32_t by) {
    return a.empty() == b.empty() && (a.empty() || (a.first + by == b.first && a.end + by == b.end));
}

template <class T>
void splice(std::vector<T>& all, size_t first, size_t end, const std::vector<T>& piece) {
    const size_t kept = std::min(end - first, piece.size());
    std::copy(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(kept),
              all.begin() + static_cast<std::ptrdiff_t>(first));
    const auto at = all.begin() + static_cast<std::ptrdiff_t>(first + kept);
    if (kept < piece.size())
        all.insert(at, piece.begin() + static_cast<std::ptrdiff_t>(kept), piece.end());
    else
        all.erase(at, all.begin() + static_cast<std::ptrdiff_t>(end));
}

/// Puts a scanned piece in the place of a window.
class Splicer {
public:
    Splicer(ScannedFile& file, const Window& window, const ScannedFile& piece, uint32_t piece_lines)
        : file_(file),
          window_(window),
          piece_(piece),
          piece_lines_(piece_lines),
          tokens_(static_cast<uint32_t>(piece.lexed.tokens.size()) - (window.tokens.end - window.tokens.first)),
          bytes_(static_cast<uint32_t>(piece.lexed.text.size()) - (window.end_byte - window.first_byte)),
          lines_(piece_lines - window.lines) {}

    void run(Unit& edited) {
        const Unit& fresh = piece_.units.front();
        if (tokens_ != 0 || lines_ != 0) move_others(edited);
        edited.tokens = within(fresh.tokens);
        edited.parameters = within(fresh.parameters);
        edited.body = within(fresh.body);
        edited.name_token = fresh.name_token + window_.tokens.first;
        edited.start_line = fresh.start_line + window_.first_line;
        edited.end_line = fresh.end_line + window_.first_line;
        move_lexed();
    }

private:
    void move_others(const Unit& edited) {
        for (Unit& unit : file_.units) {
            if (&unit == &edited) continue;
            for (TokenRange* range : {&unit.tokens, &unit.parameters, &unit.body}) move(*range);
            for (TokenRange& hole : unit.holes) move(hole);
            move_token(unit.name_token);
            move_line(unit.start_line);
            move_line(unit.end_line);
        }
        for (FileVariable& variable : file_.variables) {
            move_token(variable.name_token);
            move(variable.tokens);
        }
        LexedText& lexed = file_.lexed;
        for (Directive& one : lexed.directives) {
            move_token(one.first_token);
            move_token(one.end_token);
            move_line(one.line);
            move_line(one.end_line);
        }
        for (LineSpan& one : lexed.comments) {
            move_line(one.first);
            move_line(one.last);
        }
        for (Suppression& one : lexed.suppressions) move_line(one.line);
    }

    void move_lexed() {
        LexedText& lexed = file_.lexed;
        if (bytes_ != 0 || lines_ != 0)
            for (size_t i = window_.tokens.end; i < lexed.tokens.size(); ++i) {
                lexed.tokens[i].offset += bytes_;
                lexed.tokens[i].line += lines_;
            }
        std::vector<Token> tokens = piece_.lexed.tokens;
        for (Token& token : tokens) {
            token.offset += window_.first_byte;
            token.line += window_.first_line;
        }
        splice(lexed.tokens, window_.tokens.first, window_.tokens.end, tokens);
        if (bytes_ != 0)
            for (size_t i = window_.first_line + window_.lines; i < lexed.line_starts.size(); ++i)
                lexed.line_starts[i] += bytes_;
        std::vector<uint32_t> starts(piece_.lexed.line_starts.begin(),
                                     piece_.lexed.line_starts.begin() + static_cast<std::ptrdiff_t>(piece_lines_));
        for (uint32_t& start : starts) start += window_.first_byte;
        splice(lexed.line_starts, window_.first_line, window_.first_line + window_.lines, starts);
        splice(file_.lines, window_.first_line, window_.first_line + window_.lines,
               std::vector<LineClass>(piece_.lines.begin(),
                                      piece_.lines.begin() + static_cast<std::ptrdiff_t>(piece_lines_)));
        lexed.line_count += lines_;
        lexed.text.replace(window_.first_byte, window_.end_byte - window_.first_byte, piece_.lexed.text);
    }

    TokenRange within(TokenRange range) const {
        const bool is_none = range.first == 0 && range.end == 0;
        return is_none ? range : TokenRange{range.first + window_.tokens.first, range.end + window_.tokens.first};
    }
    void move_token(uint32_t& token) const {
        if (token >= window_.tokens.end) token += tokens_;
    }
    void move(TokenRange& range) const {
        move_token(range.first);
        move_token(range.end);
    }
    void move_line(uint32_t& line) const {
        if (line > window_.first_line + window_.lines) line += lines_;
    }

    ScannedFile& file_;
    const Window& window_;
    const ScannedFile& piece_;
    uint32_t piece_lines_;
    // By how many what stands behind moves; each may wrap around, and back.
    const uint32_t tokens_, bytes_, lines_;
};

/// True for two texts that read the same but for what their numbers are.
bool differ_in_numbers_alone(const LexedText& before, const LexedText& now) {
    const auto is_same = [&](const Token& a, const Token& b) {
        return a.kind == b.kind && a.flags == b.flags && a.line == b.line &&
               (a.kind == TokenKind::Number || before.view(a) == now.view(b));
    };
    return before.comments.empty() && now.comments.empty() && before.directives.size() == now.directives.size() &&
           before.line_starts.size() == now.line_starts.size() &&
           std::equal(before.tokens.begin(), before.tokens.end(), now.tokens.begin(), now.tokens.end(), is_same);
}

/// The same for a unit in one line, a `#define` or what shares that with others, of which the edits change numbers
/// alone: nothing reads a number otherwise than another, but for the conditions of `#if`.
std::optional<RescannedLines> renumber(LexedText& lexed, const Unit& unit, const std::vector<TextEdit>& edits) {
    if (unit.tokens.empty()) return std::nullopt;
    const uint32_t line = lexed.tokens[unit.tokens.first].line;
    if (lexed.tokens[unit.tokens.end - 1].line != line || line >= lexed.line_starts.size()) return std::nullopt;
    const uint32_t first = lexed.line_starts[line - 1], end = lexed.line_starts[line];
    const auto from = std::lower_bound(lexed.tokens.begin(), lexed.tokens.end(), line,
                                       [](const Token& token, uint32_t at) { return token.line < at; });
    const auto to = std::upper_bound(from, lexed.tokens.end(), line,
                                     [](uint32_t at, const Token& token) { return at < token.line; });
    std::vector<TextEdit> here = edits;
    for (TextEdit& edit : here) {
        if (edit.first < first || edit.end >= end) return std::nullopt;
        edit.first -= first;
        edit.end -= first;
    }
    const std::string old = lexed.text.substr(first, end - first), fresh = with_edits(old, here);
    const LexedText before = lex(old), now = lex(fresh);
    if (before.text != old || now.text != fresh) return std::nullopt;
    const auto stands_here = [&](const Token& alone, const Token& token) {
        return alone.kind == token.kind && alone.flags == token.flags && alone.length == token.length &&
               alone.offset + first == token.offset;
    };
    const bool is_define = before.directives.empty() ||
                           (before.directives.size() == 1 && before.directives[0].kind == DirectiveKind::Define);
    if (!is_define || !differ_in_numbers_alone(before, now) ||
        !std::equal(before.tokens.begin(), before.tokens.end(), from, to, stands_here))
        return std::nullopt;
    const auto moved = static_cast<uint32_t>(now.text.size() - before.text.size());  // may wrap around, and back
    auto token = from;
    for (const Token& one : now.tokens) {
        token->offset = one.offset + first;
        token->length = one.length;
        ++token;
    }
    for (; moved != 0 && token != lexed.tokens.end(); ++token) token->offset += moved;
    for (size_t i = line; moved != 0 && i < lexed.line_starts.size(); ++i) lexed.line_starts[i] += moved;
    lexed.text.replace(first, end - first, now.text);
    return RescannedLines{first, end, now.text.size()};
}

}  // namespace

std::optional<RescannedLines> rescan_unit(ScannedFile& file, size_t unit_place, const std::vector<TextEdit>& edits) {
    Unit* const unit = &file.units.at(unit_place);
    if (const auto lines = renumber(file.lexed, *unit, edits)) return lines;
    Window window;
    if (!is_plain(file) || !window_of(file, *unit, window)) return std::nullopt;
    const std::string_view old =
        std::string_view(file.lexed.text).substr(window.first_byte, window.end_byte - window.first_byte);
    std::vector<TextEdit> here = edits;
    for (TextEdit& edit : here) {
        if (edit.first < window.first_byte || edit.end >= window.end_byte) return std::nullopt;
        edit.first -= window.first_byte;
        edit.end -= window.first_byte;
    }
    const ScannedFile before = scan_text(file.path, old), now = scan_text(file.path, with_edits(old, here));
    const Unit *was = only_unit(before, file.language), *is = only_unit(now, file.language);
    const uint32_t by = window.tokens.first;
    const bool as_in_file = was != nullptr && was->kind == unit->kind && leaf_of(was->name) == leaf_of(unit->name) &&
                            same_range(was->tokens, unit->tokens, by) &&
                            same_range(was->parameters, unit->parameters, by) &&
                            same_range(was->body, unit->body, by) && was->name_token + by == unit->name_token;
    if (!as_in_file || is == nullptr || is->kind != was->kind || is->name != was->name) return std::nullopt;
    if (!now.lexed.text.ends_with('\n')) return std::nullopt;
    const auto lines = static_cast<uint32_t>(std::count(now.lexed.text.begin(), now.lexed.text.end(), '\n'));
    if (now.lines.size() < lines || now.lexed.line_starts.size() < lines) return std::nullopt;
    Splicer(file, window, now, lines).run(*unit);
    return RescannedLines{window.first_byte, window.end_byte, now.lexed.text.size()};
}

}  // namespace porttool
