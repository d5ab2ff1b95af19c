// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/code_text.h"

#include <algorithm>

#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/port_text.h"

namespace porttool {
namespace {

/// What stands in the file before a token, from the end of the one before it.
std::string_view gap_before(const LexedText& lexed, uint32_t token) {
    const Token &before = lexed.tokens[token - 1], &here = lexed.tokens[token];
    const size_t end = before.offset + before.length;
    return std::string_view(lexed.text).substr(end, here.offset < end ? 0 : here.offset - end);
}

bool has_line_end(std::string_view text) { return text.find('\n') != std::string_view::npos; }

BraceLine most(size_t same, size_t own) {
    if (own >= 3 * same && own > 0) return BraceLine::Own;
    return same >= 3 * own && same > 0 ? BraceLine::Same : BraceLine::Unknown;
}

/// The blanks that the last line of a text begins with.
std::string last_indent(const std::string& text) {
    const size_t line = text.rfind('\n') == std::string::npos ? 0 : text.rfind('\n') + 1;
    return text.substr(line, text.find_first_not_of(" \t", line) - line);
}

/// The white space before a brace, or before an `else`, as the other file has it.
std::string brace_gap(const std::string& before, const std::string& word, const std::string& gap, BraceLine manner,
                      const std::string& so_far) {
    const bool heads = word == "{" && (before == ")" || before == "else" || before == "do");
    const bool joins = before == "}" && word == "else";
    const bool plain = gap.find_first_not_of(" \t\n") == std::string::npos;
    if ((!heads && !joins) || !plain || manner == BraceLine::Unknown) return gap;
    if (manner == BraceLine::Same) return " ";
    return has_line_end(gap) ? gap : "\n" + last_indent(so_far);
}

}  // namespace

BraceManner brace_manner(const ScannedFile& file) {
    const LexedText& lexed = file.lexed;
    size_t head_same = 0, head_own = 0, same = 0, own = 0;
    for (const Unit& unit : file.units) {
        if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) continue;
        if (unit.body.empty() || unit.body.first == 0) continue;
        const bool one_line = lexed.tokens[unit.body.first - 1].line == lexed.tokens[unit.body.end - 1].line;
        if (!one_line) ++(has_line_end(gap_before(lexed, unit.body.first - 1)) ? head_own : head_same);
        for (uint32_t i = unit.body.first + 1; i < unit.body.end; ++i) {
            const std::string_view before = lexed.view(i - 1);
            if (lexed.view(i) == "{" && (before == ")" || before == "else"))
                ++(has_line_end(gap_before(lexed, i)) ? own : same);
        }
    }
    return {most(head_same, head_own), most(same, own)};
}

CodeWords code_words(const ScannedFile& file, TokenRange tokens) {
    CodeWords out{file, tokens.first, {}};
    for (uint32_t i = tokens.first; i < tokens.end; ++i) {
        const std::string_view word = file.lexed.view(i);
        out.words.push_back(file.lexed.tokens[i].kind == TokenKind::Number ? normal_number(word) : std::string(word));
    }
    return out;
}

std::string code_text(const CodeWords& source, const std::vector<CarriedWord>& words, const BraceManner& there) {
    std::string out;
    int depth = 0;
    for (size_t i = 0; i < words.size(); ++i) {
        const CarriedWord& word = words[i];
        const bool placed = word.from != CarriedWord::kNoSource;
        if (i > 0) {
            const CarriedWord& before = words[i - 1];
            std::string gap;
            if (placed && word.from > 0)
                gap = gap_before(source.file.lexed, source.first + static_cast<uint32_t>(word.from));
            else
                gap = stand_apart(before.text, word.text) ? " " : "";
            const auto is_name = [](const std::string& text) { return is_word_token(text) || is_number_token(text); };
            if (gap.empty() && is_name(before.text) && is_name(word.text)) gap = " ";
            out += brace_gap(before.text, word.text, gap, depth == 0 ? there.head : there.control, out);
        }
        depth += word.text == "{" ? 1 : word.text == "}" ? -1 : 0;
        out += word.text;
    }
    return out;
}

std::string indented(const std::string& code, const std::string& from, size_t base, const std::string& to,
                     const std::string& new_base) {
    std::string out;
    for (size_t at = 0; at < code.size();) {
        const size_t end = std::min(code.find('\n', at), code.size());
        size_t first = at, columns = 0;
        for (; first < end && (code[first] == ' ' || code[first] == '\t'); ++first)
            columns += code[first] == '\t' && from != "\t" ? 4 : 1;
        const bool is_first = at == 0;
        if (!is_first) out += '\n';
        if (is_first || first == end || code[first] == '#') {
            out += is_first       ? code.substr(at, end - at)
                   : first == end ? std::string()
                                  : code.substr(first, end - first);
        } else {
            const size_t deeper = columns > base ? columns - base : 0;
            out += new_base;
            for (size_t k = 0; k < deeper / from.size(); ++k) out += to;
            out += std::string(deeper % from.size(), ' ') + code.substr(first, end - first);
        }
        at = end + 1;
    }
    return out;
}

}  // namespace porttool
