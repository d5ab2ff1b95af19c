// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/normal_form.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>

#include "porttool/language/words.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

/// The tokens of a unit that belong to it: without holes and dead branches.
std::vector<uint32_t> own_tokens(const ScannedFile& file, const Unit& unit) {
    std::vector<uint32_t> own;
    if (unit.holes.empty()) own.reserve(unit.tokens.end - unit.tokens.first);  // else most may be somebody else's
    size_t hole = 0;
    for (uint32_t i = unit.tokens.first; i < unit.tokens.end; ++i) {
        while (hole < unit.holes.size() && unit.holes[hole].end <= i) ++hole;
        if (hole < unit.holes.size() && unit.holes[hole].first <= i) {
            i = unit.holes[hole].end - 1;
            continue;
        }
        if ((file.lexed.tokens[i].flags & kDead) == 0) own.push_back(i);
    }
    return own;
}

/// Writes statements out with braces around each that an `if`, a loop or an `else` controls.
class BraceWriter {
public:
    BraceWriter(const LexedText& lexed, const std::vector<uint32_t>& tokens, const NormalSink& sink,
                uint32_t name_token)
        : lexed_(lexed), tokens_(tokens), sink_(sink), name_token_(name_token) {}

    void run(uint32_t body_first) {
        while (at_ < tokens_.size() && tokens_[at_] < body_first) emit();
        while (at_ < tokens_.size()) {
            const size_t before = at_;
            statement(0);
            if (at_ == before) emit();  // a lone closing brace
        }
    }

private:
    static constexpr int kDeepest = 200;

    std::string_view word() const { return at_ < tokens_.size() ? lexed_.view(tokens_[at_]) : std::string_view(); }
    bool in_directive() const {
        return at_ < tokens_.size() && (lexed_.tokens[tokens_[at_]].flags & kInDirective) != 0;
    }

    void emit() {
        const Token& token = lexed_.tokens[tokens_[at_]];
        if (token.kind == TokenKind::Number)
            sink_(normal_number(lexed_.view(token)), tokens_[at_]);
        else
            sink_(tokens_[at_] == name_token_ ? std::string_view("@") : lexed_.view(token), tokens_[at_]);
        ++at_;
    }

    void insert(const char* text) { sink_(text, tokens_[std::min(at_, tokens_.size() - 1)]); }

    void directives() {
        while (in_directive()) emit();
    }

    /// A word of one character, or 0.
    char sign() const { return word().size() == 1 ? word()[0] : '\0'; }

    std::string_view word_at(size_t at) const {
        return at < tokens_.size() ? lexed_.view(tokens_[at]) : std::string_view();
    }

    /// `[unroll]` or `__attribute__((...))` before a loop or a condition.
    void attributes() {
        constexpr size_t kLongest = 32;
        const bool named = word() == "__attribute__" && word_at(at_ + 1) == "(";
        if (!named && sign() != '[') return;
        size_t end = at_ + (named ? 1 : 0);
        int depth = 0;
        for (; end < at_ + kLongest; ++end) {
            const std::string_view text = word_at(end);
            if (text == "(" || text == "[") ++depth;
            if ((text == ")" || text == "]") && --depth == 0) break;
        }
        if (depth == 0 && word_is(word_at(end + 1), kControls))
            while (at_ <= end) emit();
    }

    /// Copies a bracketed group as it stands.
    void group() {
        int depth = 0;
        while (at_ < tokens_.size()) {
            if (!in_directive()) {
                const char c = sign();
                if (c == '(' || c == '[' || c == '{') ++depth;
                if (c == ')' || c == ']' || c == '}') --depth;
            }
            emit();
            if (depth <= 0) return;
        }
    }

    void block(int depth) {
        emit();  // the opening brace
        while (at_ < tokens_.size() && sign() != '}') statement(depth);
        if (at_ < tokens_.size()) emit();
    }

    void controlled(int depth) {
        directives();
        if (word() == "{") return block(depth + 1);
        insert("{");
        statement(depth + 1);
        insert("}");
    }

    void statement(int depth) {
        directives();
        attributes();
        if (sign() == '}' || at_ >= tokens_.size()) return;
        if (depth > kDeepest) return simple();
        if (sign() == '{') return block(depth + 1);
        const std::string_view text = word();
        if (word_is(text, kControls)) {
            emit();
            if (word() == "constexpr") emit();
            if (word() != "(") return simple();
            group();
            controlled(depth);
            directives();
            if ((text == "if" || text == "cif") && word() == "else") {
                emit();
                controlled(depth);
            }
            return;
        }
        if (text == "do" || text == "else") {
            emit();
            controlled(depth);
            directives();
            if (text == "do" && word() == "while") simple();
            return;
        }
        if (text == "switch") {
            emit();
            if (word() == "(") group();
            return controlled(depth);
        }
        simple();
    }

    /// Up to the semicolon, or the brace that closes the block.
    void simple() {
        while (at_ < tokens_.size()) {
            if (in_directive()) {
                emit();
                continue;
            }
            const char c = sign();
            if (c == '}') return;
            if (c == '(' || c == '[' || c == '{') {
                group();
                continue;
            }
            emit();
            if (c == ';' || c == ':') return;
        }
    }

    const LexedText& lexed_;
    const std::vector<uint32_t>& tokens_;
    const NormalSink& sink_;
    uint32_t name_token_;
    size_t at_ = 0;
};

/// Digits, separators gone and letters small; the suffix apart.
std::string plain_digits(std::string_view text) {
    std::string plain;
    for (const char c : text)
        if (c != '\'') plain += small_letter(c);
    return plain;
}

}  // namespace

std::string normal_number(std::string_view text) {
    const std::string plain = plain_digits(text);
    const bool hexadecimal = plain.starts_with("0x");
    const bool binary = plain.starts_with("0b");
    const bool real =
        !binary && (plain.find('.') != std::string::npos || plain.find(hexadecimal ? 'p' : 'e') != std::string::npos ||
                    (!hexadecimal && plain.ends_with('f')));
    if (real) {
        double value = 0;
        const char* first = plain.data() + (hexadecimal ? 2 : 0);
        const char* last = plain.data() + plain.size();
        const auto read =
            std::from_chars(first, last, value, hexadecimal ? std::chars_format::hex : std::chars_format::general);
        if (read.ec != std::errc()) return plain;
        std::array<char, 40> buffer{};
        const auto written = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
        std::string out(buffer.data(), written.ptr);
        const std::string suffix(read.ptr, last);
        // An unmarked whole value keeps its point: 1.0 is no integer.
        if (suffix.empty() && out.find_first_of(".en") == std::string::npos) out += ".0";
        return out + suffix;
    }
    uint64_t value = 0;
    const bool octal =
        !hexadecimal && !binary && plain.size() > 1 && plain[0] == '0' && plain[1] >= '0' && plain[1] <= '7';
    const size_t skip = hexadecimal || binary ? 2 : 0;
    const auto read = std::from_chars(plain.data() + skip, plain.data() + plain.size(), value,
                                      hexadecimal ? 16
                                      : binary    ? 2
                                      : octal     ? 8
                                                  : 10);
    if (read.ec != std::errc()) return plain;
    std::string suffix(read.ptr, plain.data() + plain.size());
    if (suffix.size() <= 3) std::sort(suffix.begin(), suffix.end(), std::greater<>());
    return std::to_string(value) + suffix;
}

std::string number_value(std::string_view text) {
    std::string value = normal_number(text);
    while (!value.empty() && (value.back() == 'f' || value.back() == 'u' || value.back() == 'l' || value.back() == 'h'))
        value.pop_back();
    if (value.ends_with(".0")) value.resize(value.size() - 2);
    return value;
}

void write_normal_form(const ScannedFile& file, const Unit& unit, const NormalSink& sink) {
    const std::vector<uint32_t> own = own_tokens(file, unit);
    const bool code = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
    BraceWriter(file.lexed, own, sink, unit.name_token).run(code ? unit.body.first : unit.tokens.end);
}

NormalText normal_form(const ScannedFile& file, const Unit& unit) {
    NormalText out;
    write_normal_form(file, unit, [&](std::string_view text, uint32_t) { out.add(text); });
    return out;
}

Print fingerprint(const Words& words) {
    Fingerprinter text;
    for (const std::string_view word : words) text.add(word);
    return Print(text);
}

}  // namespace porttool
