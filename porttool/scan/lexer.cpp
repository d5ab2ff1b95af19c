// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/lexer.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <optional>
#include <utility>

#include "metrics/text/fingerprint.h"
#include "porttool/scan/suppressions.h"

namespace porttool {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool starts_identifier(char c) {
    // Bytes above 127 belong to names: UTF-8 letters, and Latin-1 in old files.
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' || static_cast<signed char>(c) < 0;
}

bool continues_identifier(char c) { return starts_identifier(c) || is_digit(c); }

/// The length and value of a letter that is spelled `\\u00f6`, `\\U000000f6` or `\\u{f6}` at a place, as C has it in
/// names; of plain letters, which may not be, and of anything else 0.
std::pair<size_t, uint32_t> spelled_letter(std::string_view text, size_t at) {
    if (at + 2 >= text.size() || text[at] != '\\' || (text[at + 1] != 'u' && text[at + 1] != 'U')) return {0, 0};
    const bool braced = text[at + 1] == 'u' && text[at + 2] == '{';
    const size_t first = at + (braced ? 3 : 2);
    const size_t digits = braced ? std::min<size_t>(text.substr(first, 9).find('}'), 8) : text[at + 1] == 'u' ? 4 : 8;
    if (first + digits > text.size()) return {0, 0};
    uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data() + first, text.data() + first + digits, value, 16);
    if (error != std::errc() || end != text.data() + first + digits) return {0, 0};
    if (braced && (first + digits >= text.size() || text[first + digits] != '}')) return {0, 0};
    if (value < 0x80 || value > 0x10FFFF || (value >= 0xD800 && value < 0xE000)) return {0, 0};
    return {first + digits + (braced ? 1 : 0) - at, value};
}

void add_utf8(std::string& out, uint32_t letter) {
    const auto tail = [&](int shift) { out += static_cast<char>(0x80 | ((letter >> shift) & 0x3F)); };
    if (letter < 0x800) {
        out += static_cast<char>(0xC0 | (letter >> 6));
    } else if (letter < 0x10000) {
        out += static_cast<char>(0xE0 | (letter >> 12));
        tail(6);
    } else {
        out += static_cast<char>(0xF0 | (letter >> 18));
        tail(12);
        tail(6);
    }
    tail(0);
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\0'; }

// Angle brackets stay single, so that template lists and `>>` need no second look.
constexpr std::array<std::string_view, 19> kPunctuators = {
    "...", "::", "->", "++", "--", "&&", "||", "==", "!=", "<=", ">=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^="};

DirectiveKind directive_kind(std::string_view name) {
    if (name == "if" || name == "ifdef" || name == "ifndef") return DirectiveKind::If;
    if (name == "elif" || name == "elifdef" || name == "elifndef") return DirectiveKind::Elif;
    if (name == "else") return DirectiveKind::Else;
    if (name == "endif") return DirectiveKind::Endif;
    if (name == "define") return DirectiveKind::Define;
    if (name == "include" || name == "import" || name == "include_next") return DirectiveKind::Include;
    return DirectiveKind::Other;
}

class Lexer {
public:
    explicit Lexer(std::string_view file) {
        out_.text = metrics::plain_text(file, &splices_);
        splices_.push_back(std::numeric_limits<uint32_t>::max());  // behind all text
        text_ = out_.text;
        out_.line_starts = {0};
    }

    LexedText run() {
        while (at_ < text_.size()) step();
        if (directive_) end_directive();
        // A last line without newline counts; an empty file has no lines.
        out_.line_count = line_ - (at_ == line_start_ && line_ > 0 ? 1 : 0);
        return std::move(out_);
    }

private:
    char peek(size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }

    /// Moves to `to`, counting the lines on the way.
    void advance(size_t to) {
        while (splices_[next_splice_] <= to) {
            advance_without_splices(splices_[next_splice_]);
            count_splices();
        }
        advance_without_splices(to);
    }

    void advance_without_splices(size_t to) {
        for (; at_ < to; ++at_) {
            if (text_[at_] != '\n') continue;
            begin_line(at_ + 1);
            line_is_fresh_ = true;
        }
    }

    void count_splices() {
        while (splices_[next_splice_] <= at_) {
            begin_line(at_);
            ++next_splice_;
        }
    }

    void begin_line(size_t start) {
        ++line_;
        line_start_ = start;
        out_.line_starts.push_back(static_cast<uint32_t>(start));
    }

    void step() {
        count_splices();
        const char c = peek();
        if (c == '\n') {
            if (directive_) end_directive();
            advance(at_ + 1);
        } else if (is_blank(c)) {
            advance(at_ + 1);
        } else if (c == '/' && peek(1) == '/') {
            comment(std::min(text_.find('\n', at_), text_.size()));
        } else if (c == '/' && peek(1) == '*') {
            const size_t close = text_.find("*/", at_ + 2);
            comment(close == std::string_view::npos ? text_.size() : close + 2);
        } else {
            token();
        }
    }

    void comment(size_t end) {
        const uint32_t first = line_;
        read_suppressions(text_.substr(at_, end - at_), line_, out_.suppressions);
        const bool fresh = line_is_fresh_;
        while (const size_t doubtful = doubtful_splice(end)) {
            advance(doubtful - 1);
            emit(TokenKind::Punctuator, doubtful);
        }
        advance(end);
        line_is_fresh_ = fresh;  // `/* a */ #define` is a directive
        out_.comments.push_back({first, line_});
    }

    /// After a sign in the comment up to `end` with which some compilers join two lines and others do not: a backslash
    /// with blanks after it, or its trigraph. What is code to the one is a comment to the other; such a sign is a
    /// token, so that nobody can hide an edit behind it. 0 if there is none.
    size_t doubtful_splice(size_t end) const {
        for (size_t at = at_; at < end; ++at) {
            const bool trigraph = text_[at] == '/' && at >= at_ + 2 && text_.substr(at - 2, 2) == "??";
            if (text_[at] != '\\' && !trigraph) continue;
            size_t next = at + 1;
            while (next < text_.size() && is_blank(text_[next])) ++next;
            if (next < text_.size() && text_[next] == '\n') return at + 1;
        }
        return 0;
    }

    void token() {
        const char c = peek();
        if (c == '#' && line_is_fresh_ && !directive_) begin_directive();
        if (is_digit(c) || (c == '.' && is_digit(peek(1)))) return emit(TokenKind::Number, number_end());
        if (starts_identifier(c) || (c == '\\' && spelled_letter(text_, at_).first > 0))
            return identifier_or_prefixed_literal();
        if (c == '"') return emit(TokenKind::String, quoted_end(at_));
        if (c == '\'') return emit(TokenKind::Character, quoted_end(at_));
        if (c == '<' && is_include_line()) return emit(TokenKind::String, header_end());
        const char next = peek(1);
        const bool longer = next == c || next == '=' || next == '>' || c == '.';
        for (size_t i = 0; longer && i < kPunctuators.size(); ++i)
            if (const auto punctuator = kPunctuators[i]; text_.substr(at_).starts_with(punctuator))
                return emit(TokenKind::Punctuator, at_ + punctuator.size());
        emit(TokenKind::Punctuator, at_ + 1);
    }

    void emit(TokenKind kind, size_t end) {
        Token token{static_cast<uint32_t>(at_), static_cast<uint32_t>(end - at_), line_, kind,
                    static_cast<uint8_t>((line_is_fresh_ ? kStartsLine : 0) | (directive_ ? kInDirective : 0))};
        out_.tokens.push_back(token);
        advance(end);
        line_is_fresh_ = false;
    }

    size_t number_end() const {
        size_t end = at_ + 1;
        while (end < text_.size()) {
            const char c = text_[end];
            const char before = text_[end - 1];
            const bool sign_of_exponent = (c == '+' || c == '-') &&
                                          (before == 'e' || before == 'E' || before == 'p' || before == 'P') &&
                                          !is_hexadecimal_integer(end);
            const bool separator = c == '\'' && end + 1 < text_.size() && continues_identifier(text_[end + 1]);
            if (!continues_identifier(c) && c != '.' && !sign_of_exponent && !separator) break;
            ++end;
        }
        return end;
    }

    /// `0xE+1` is a sum, `1E+1` and `0x1p+1` are numbers.
    bool is_hexadecimal_integer(size_t end) const {
        const char before = text_[end - 1];
        return text_[at_] == '0' && at_ + 1 < end && (text_[at_ + 1] | 32) == 'x' && (before | 32) == 'e';
    }

    void identifier_or_prefixed_literal() {
        size_t end = at_;
        bool spelled = false;
        while (end < text_.size()) {
            const size_t letter = text_[end] == '\\' ? spelled_letter(text_, end).first : 0;
            if (letter == 0 && !continues_identifier(text_[end])) break;
            spelled = spelled || letter > 0;
            end += std::max<size_t>(letter, 1);
        }
        if (spelled) write_letters(end);
        const std::string_view word = text_.substr(at_, end - at_);
        const char quote = end < text_.size() ? text_[end] : '\0';
        if (quote == '"' && word.size() <= 3 && word.back() == 'R')
            if (const auto close = raw_string_end(end)) return emit(TokenKind::String, *close);
        if (quote == '"' && (word == "L" || word == "u" || word == "U" || word == "u8" || word == "R"))
            return emit(TokenKind::String, quoted_end(end));
        if (quote == '\'' && (word == "L" || word == "u" || word == "U" || word == "u8"))
            return emit(TokenKind::Character, quoted_end(end));
        emit(TokenKind::Identifier, end);
    }

    /// Writes the letters of a name that are spelled by their numbers as UTF-8, so that it is the same name, and blanks
    /// before it.
    void write_letters(size_t end) {
        std::string name;
        for (size_t i = at_; i < end;) {
            const auto [length, letter] = spelled_letter(text_, i);
            if (length > 0)
                add_utf8(name, letter);
            else
                name += text_[i];
            i += std::max<size_t>(length, 1);
        }
        const size_t first = end - name.size();
        std::fill(out_.text.begin() + static_cast<std::ptrdiff_t>(at_),
                  out_.text.begin() + static_cast<std::ptrdiff_t>(first), ' ');
        std::copy(name.begin(), name.end(), out_.text.begin() + static_cast<std::ptrdiff_t>(first));
        advance(first);
    }

    /// End of the string or character that opens at `open`. One that never closes on its line is cut there; an
    /// apostrophe that cannot be a character (as in `#error don't`) is a token of its own.
    size_t quoted_end(size_t open) {
        const char quote = text_[open];
        if (quote == '\'' && open < lone_apostrophes_until_) return open + 1;
        for (size_t i = open + 1; i < text_.size(); ++i) {
            if (text_[i] == '\\' && i + 1 < text_.size() && text_[i + 1] != '\n')
                ++i;
            else if (text_[i] == quote)
                return i + 1;
            else if (text_[i] == '\n')
                return unclosed_end(open, i);
        }
        return unclosed_end(open, text_.size());
    }

    size_t unclosed_end(size_t open, size_t line_end) {
        if (text_[open] == '"' && !directive_) return line_end;
        // Without this a line of \' \' \' would be searched once for each of them.
        if (text_[open] == '\'') lone_apostrophes_until_ = line_end;
        return open + 1;
    }

    std::optional<size_t> raw_string_end(size_t open) {
        constexpr size_t kLongestDelimiter = 16;
        const size_t length = text_.substr(open + 1, kLongestDelimiter + 1).find('(');
        if (length == std::string_view::npos) return std::nullopt;
        const size_t paren = open + 1 + length;
        std::string close(1, ')');
        close.append(text_.substr(open + 1, length)).push_back('"');
        // One that was not found once is never found later; a handful of such searches keeps the whole linear.
        constexpr size_t kMostFailures = 8;
        if (std::find(unclosed_.begin(), unclosed_.end(), close) != unclosed_.end()) return std::nullopt;
        if (unclosed_.size() >= kMostFailures) return std::nullopt;
        const size_t end = text_.find(close, paren);
        if (end != std::string_view::npos) return end + close.size();
        unclosed_.push_back(close);
        return std::nullopt;
    }

    void begin_directive() {
        directive_ = true;
        out_.directives.push_back({DirectiveKind::Other, static_cast<uint32_t>(out_.tokens.size()), 0, line_, line_});
    }

    void end_directive() {
        Directive& directive = out_.directives.back();
        directive.end_token = static_cast<uint32_t>(out_.tokens.size());
        directive.end_line = line_;
        if (directive.first_token + 1 < directive.end_token)
            directive.kind = directive_kind(out_.view(directive.first_token + 1));
        directive_ = false;
    }

    bool is_include_line() const {
        if (!directive_) return false;
        const uint32_t first = out_.directives.back().first_token;
        return out_.tokens.size() == first + 2 && directive_kind(out_.view(first + 1)) == DirectiveKind::Include;
    }

    size_t header_end() const {
        const size_t close = text_.find_first_of(">\n", at_);
        if (close == std::string_view::npos || text_[close] == '\n') return at_ + 1;
        return close + 1;
    }

    LexedText out_;
    std::string_view text_;
    std::vector<uint32_t> splices_;  ///< sorted, the last one behind all text
    std::vector<std::string> unclosed_;
    size_t at_ = 0;
    size_t line_start_ = 0;
    size_t next_splice_ = 0;
    size_t lone_apostrophes_until_ = 0;
    uint32_t line_ = 1;
    bool line_is_fresh_ = true;
    bool directive_ = false;
};

}  // namespace

LexedText lex(std::string_view file) { return Lexer(file).run(); }

}  // namespace porttool
