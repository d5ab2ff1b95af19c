// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/locals.h"

#include <algorithm>
#include <array>

namespace porttool {
namespace {

bool is_word(std::string_view text) {
    const char c = text.empty() ? '\0' : text[0];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' || static_cast<signed char>(c) < 0;
}

/// Words that stand before a name without being its type.
bool is_no_type(std::string_view text) {
    constexpr std::array<std::string_view, 18> kWords = {
        "return", "else",     "delete",  "goto",   "case",    "using",     "throw", "new",   "do",
        "break",  "continue", "default", "sizeof", "typedef", "namespace", "if",    "while", "operator"};
    return std::find(kWords.begin(), kWords.end(), text) != kWords.end();
}

/// Finds declarations by their shape: a type, then a name, then what may follow a declared name. One pass over the
/// body.
class LocalFinder {
public:
    LocalFinder(const LexedText& lexed, TokenRange parameters, TokenRange body) : lexed_(lexed) {
        take(parameters);
        read_parameters();
        tokens_.clear();
        take(body);
        for (size_t i = 0; i + 1 < tokens_.size(); ++i) {
            read_further(i);
            if (read_declaration(i)) lists_.back() = true;
        }
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
    }

    std::vector<uint32_t> places;

private:
    void take(TokenRange range) {
        for (uint32_t i = range.first; i < range.end; ++i)
            if ((lexed_.tokens[i].flags & (kInDirective | kDead)) == 0) tokens_.push_back(i);
    }
    std::string_view word(size_t i) const { return i < tokens_.size() ? lexed_.view(tokens_[i]) : std::string_view(); }
    bool is_name(size_t i) const {
        return i < tokens_.size() && lexed_.tokens[tokens_[i]].kind == TokenKind::Identifier;
    }

    void declare(size_t i) { places.push_back(tokens_[i]); }

    /// The last word before a comma, a default or an array bound names a parameter; a lone word is its type.
    void read_parameters() {
        int depth = 0;
        size_t words = 0, last = 0;
        bool closed = false;
        auto finish = [&] {
            if (words > 1) declare(last);
            words = 0;
            closed = false;
        };
        for (size_t i = 0; i < tokens_.size(); ++i) {
            const std::string_view text = word(i);
            if (text == "(" || text == "<" || text == "{") ++depth;
            if (text == ")" || text == ">" || text == "}") --depth;
            if (depth > 0) continue;
            if (text == ",")
                finish();
            else if (text == "=" || text == "[" || text == ":")
                closed = true;
            else if (is_name(i) && !closed) {
                ++words;
                last = i;
            }
        }
        finish();
    }

    bool read_declaration(size_t i) {
        // `T x =`, `T* x;`, `T<int>& x :`, `T x[4]`, `T x(1)`
        if (!is_name(i + 1) || is_no_type(word(i + 1))) return false;
        const std::string_view follow = word(i + 2);
        const bool after_type = is_name(i) && !is_no_type(word(i));
        const bool after_mark =
            (word(i) == "*" || word(i) == "&" || word(i) == ">" || word(i) == "&&") && i > 0 && starts_statement(i);
        if (!after_type && !after_mark) return false;
        if (after_type && i > 0 && (word(i - 1) == "." || word(i - 1) == "->")) return false;
        const bool ends = follow == "=" || follow == ";" || follow == "," || follow == "[" || follow == ":" ||
                          follow == "{" || (follow == "(" && after_type) || follow == ")";
        if (!ends) return false;
        declare(i + 1);
        return true;
    }

    /// For `T* x` and `T<U> x`: only if a statement starts with it, as `a * b` is a product.
    bool starts_statement(size_t i) const {
        size_t at = i;
        for (size_t steps = 0; at > 0 && steps < 32; --at, ++steps) {
            const std::string_view text = word(at);
            if (text == ";" || text == "{" || text == "}") return true;
            if (text == "(") return at > 0 && (word(at - 1) == "for" || word(at - 1) == "if");
            if (text == "=" || text == "return" || text == ")" || text == "+" || text == "-") return false;
        }
        return at == 0;
    }

    /// `int a = 1, b, c[2];`: a comma at the depth of a declaration goes on with it while names follow.
    void read_further(size_t i) {
        const std::string_view text = word(i);
        if (text.size() != 1) return;
        switch (text[0]) {
            case '(':
            case '[':
            case '{':
                lists_.push_back(false);
                break;
            case ')':
            case ']':
            case '}':
                if (lists_.size() > 1)
                    lists_.pop_back();
                else
                    lists_.back() = false;
                break;
            case ';':
                lists_.back() = false;
                break;
            case ',':
                if (lists_.back()) lists_.back() = declare_next(i + 1);
                break;
            default:
                break;
        }
    }

    bool declare_next(size_t name) {
        while (word(name) == "*" || word(name) == "&") ++name;
        const std::string_view follow = word(name + 1);
        if (!is_name(name) || (follow != "=" && follow != "," && follow != ";" && follow != "[" && follow != "("))
            return false;
        declare(name);
        return true;
    }

    const LexedText& lexed_;
    std::vector<uint32_t> tokens_;
    std::vector<bool> lists_ = {false};  ///< for each open bracket: within the declarators of a declaration
};

/// What is declared in these parentheses holds for the block behind them: loops, conditions, a lambda.
bool has_own_scope(std::string_view before) {
    constexpr std::array<std::string_view, 6> kHeads = {"for", "if", "while", "switch", "catch", "]"};
    return std::find(kHeads.begin(), kHeads.end(), before) != kHeads.end();
}

}  // namespace

std::vector<uint32_t> declaring_tokens(const LexedText& lexed, TokenRange parameters, TokenRange body) {
    return LocalFinder(lexed, parameters, body).places;
}

std::string_view LocalNumbers::next(std::string_view text, uint32_t token) {
    if (head_closes_) close(text == "{");
    head_closes_ = false;
    const std::string_view out = is_word(text) && !member_ ? numbered(text, token) : text;
    if (text == "(") open(scoped_);
    if (text == "{") open_block();
    if (text == ")") head_closes_ = true;
    if (text == "}") close(false);
    member_ = text == "." || text == "->" || text == "::";
    scoped_ = has_own_scope(text);
    return out;
}

std::string_view LocalNumbers::numbered(std::string_view text, uint32_t token) {
    if (std::binary_search(places_.begin(), places_.end(), token)) {
        size_t& number = numbers_[text];
        shadowed_.push_back({text, number});
        number = ++count_;
        return written(number);
    }
    const auto found = numbers_.find(text);
    return found == numbers_.end() || found->second == 0 ? text : written(found->second);
}

std::string_view LocalNumbers::written(size_t number) {
    written_ = "%" + std::to_string(number);
    return written_;
}

void LocalNumbers::enter() { scopes_.push_back(shadowed_.size()); }
void LocalNumbers::leave() {
    if (scopes_.empty()) return;
    for (; shadowed_.size() > scopes_.back(); shadowed_.pop_back())
        numbers_[shadowed_.back().name] = shadowed_.back().number;
    scopes_.pop_back();
}

void LocalNumbers::open(bool scoped) {
    brackets_.push_back({scoped, false});
    if (scoped) enter();
}
/// A block takes over the scope of the head before it.
void LocalNumbers::open_block() {
    brackets_.push_back({true, true});
    if (!pending_) enter();
    pending_ = false;
}
void LocalNumbers::close(bool block_follows) {
    if (brackets_.empty()) return;
    const Bracket bracket = brackets_.back();
    brackets_.pop_back();
    if (!bracket.scoped) return;
    if (!bracket.block && block_follows)
        pending_ = true;
    else
        leave();
}

namespace {

/// A text in normal form as the finder reads files; every token stands for itself.
LexedText as_lexed(const std::vector<std::string>& words) {
    LexedText out;
    for (const std::string& word : words) {
        Token token;
        token.offset = static_cast<uint32_t>(out.text.size());
        token.length = static_cast<uint32_t>(word.size());
        token.kind = is_word(word) ? TokenKind::Identifier : TokenKind::Punctuator;
        out.tokens.push_back(token);
        out.text += word;
    }
    return out;
}

uint32_t find_from(const std::vector<std::string>& words, uint32_t at, const char* word) {
    while (at < words.size() && words[at] != word) ++at;
    return at;
}

}  // namespace

std::vector<size_t> local_numbers(const std::vector<std::string>& words) {
    const auto count = static_cast<uint32_t>(words.size());
    const uint32_t open = find_from(words, find_from(words, 0, "@"), "(");
    if (find_from(words, 0, "#") < count || open >= count) return {};
    uint32_t close = open;
    for (int depth = 0; close < count; ++close) {
        if (words[close] == "(") ++depth;
        if (words[close] == ")" && --depth == 0) break;
    }
    const uint32_t body = find_from(words, close, "{");
    if (body >= count) return {};
    const LexedText lexed = as_lexed(words);
    LocalNumbers numbers(declaring_tokens(lexed, {open + 1, close}, {body + 1, count - 1}));
    std::vector<size_t> out;
    for (uint32_t i = 0; i < count; ++i) {
        const std::string_view shown = numbers.next(lexed.view(i), i);
        const bool local = is_word(words[i]) && shown.starts_with('%');
        out.push_back(local ? static_cast<size_t>(std::stoull(std::string(shown.substr(1)))) : 0);
    }
    return out;
}

}  // namespace porttool
