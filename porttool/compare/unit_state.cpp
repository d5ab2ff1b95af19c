// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/unit_state.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <unordered_set>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

bool is_word(std::string_view text) {
    const char c = text.empty() ? '\0' : text[0];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' || static_cast<signed char>(c) < 0;
}

bool is_number(std::string_view text) {
    return !text.empty() && ((text[0] >= '0' && text[0] <= '9') || text[0] == '.') && text != "." && text != "...";
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

    std::vector<uint32_t> places;  ///< the tokens that declare a name, sorted

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

/// Numbers locals and parameters in the order of their declarations, scope by scope, so that a name that is declared
/// again within a block is another variable there. Words that no declaration in force covers stay as they are. Takes
/// tokens in normal form one after the other, in linear time whatever the nesting.
class LocalNumbers {
public:
    explicit LocalNumbers(const std::vector<uint32_t>& places) : places_(places) {}

    /// What stands for the next token; valid until the next call.
    std::string_view next(std::string_view text, uint32_t token) {
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

private:
    struct Bracket {
        bool scoped = false;
        bool block = false;
    };
    /// What a name stood for before a declaration; 0 for itself.
    struct Shadowed {
        std::string_view name;
        size_t number;
    };

    /// What is declared in these parentheses holds for the block behind them: loops, conditions, a lambda.
    static bool has_own_scope(std::string_view before) {
        constexpr std::array<std::string_view, 6> kHeads = {"for", "if", "while", "switch", "catch", "]"};
        return std::find(kHeads.begin(), kHeads.end(), before) != kHeads.end();
    }

    /// A word's text outlives this: it lies in the file.
    std::string_view numbered(std::string_view text, uint32_t token) {
        if (std::binary_search(places_.begin(), places_.end(), token)) {
            size_t& number = numbers_[text];
            shadowed_.push_back({text, number});
            number = ++count_;
            return written(number);
        }
        const auto found = numbers_.find(text);
        return found == numbers_.end() || found->second == 0 ? text : written(found->second);
    }

    std::string_view written(size_t number) {
        written_ = "%" + std::to_string(number);
        return written_;
    }

    void enter() { scopes_.push_back(shadowed_.size()); }
    void leave() {
        if (scopes_.empty()) return;
        for (; shadowed_.size() > scopes_.back(); shadowed_.pop_back())
            numbers_[shadowed_.back().name] = shadowed_.back().number;
        scopes_.pop_back();
    }

    void open(bool scoped) {
        brackets_.push_back({scoped, false});
        if (scoped) enter();
    }
    /// A block takes over the scope of the head before it.
    void open_block() {
        brackets_.push_back({true, true});
        if (!pending_) enter();
        pending_ = false;
    }
    void close(bool block_follows) {
        if (brackets_.empty()) return;
        const Bracket bracket = brackets_.back();
        brackets_.pop_back();
        if (!bracket.scoped) return;
        if (!bracket.block && block_follows)
            pending_ = true;
        else
            leave();
    }

    const std::vector<uint32_t>& places_;
    std::unordered_map<std::string_view, size_t> numbers_;
    std::vector<Shadowed> shadowed_;
    std::vector<size_t> scopes_;  ///< sizes of shadowed_ where each began
    std::vector<Bracket> brackets_;
    std::string written_;
    size_t count_ = 0;
    bool pending_ = false;
    bool head_closes_ = false;  ///< the token before was `)`
    bool member_ = false;       ///< ... `.`, `->` or `::`
    bool scoped_ = false;       ///< ... a word whose parentheses are a scope
};

/// Puts a unit's text together: one statement a line, tokens apart by blanks.
class TextWriter {
public:
    void add(std::string_view word) {
        const size_t start = text_.size();
        text_ += word;
        std::replace(text_.begin() + static_cast<std::ptrdiff_t>(start), text_.end(), '\n', '\x01');  // raw strings
        std::replace(text_.begin() + static_cast<std::ptrdiff_t>(start), text_.end(), ' ', '\x02');
        if (word == "(") ++parens_;
        if (word == ")") --parens_;
        const bool ends = word == "{" || word == "}" || (word == ";" && parens_ <= 0);
        text_ += ends ? '\n' : ' ';
    }
    std::string take() {
        if (!text_.empty() && text_.back() == ' ') text_.back() = '\n';
        text_.shrink_to_fit();
        return std::move(text_);
    }

private:
    std::string text_;
    int64_t parens_ = 0;
};

}  // namespace

std::vector<std::string> local_names(const ScannedFile& file, const Unit& unit) {
    if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) return {};
    std::vector<std::string> names;
    std::unordered_set<std::string_view> seen;
    for (const uint32_t place : LocalFinder(file.lexed, unit.parameters, unit.body).places)
        if (seen.insert(file.lexed.view(place)).second) names.emplace_back(file.lexed.view(place));
    return names;
}

UnitState unit_state(const ScannedFile& file, const Unit& unit) {
    UnitState state;
    state.id = unit_id(file, unit);
    state.file = file.path;
    state.name = unit.name;
    state.kind = unit.kind;
    state.start_line = unit.start_line;
    state.end_line = unit.end_line;
    const bool code = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
    const LocalFinder locals(file.lexed, code ? unit.parameters : TokenRange(), code ? unit.body : TokenRange());
    LocalNumbers numbers(locals.places);
    Fingerprinter written, renamed, blanked;
    TextWriter text;
    write_normal_form(file, unit, [&](std::string_view word, uint32_t token) {
        ++state.tokens;
        text.add(word);
        written.add(word);
        const std::string_view numbered = numbers.next(word, token);
        renamed.add(numbered);
        blanked.add(is_number(numbered) ? "#" : numbered);
    });
    state.text = text.take();
    state.prints = {written.digits(), renamed.digits(), blanked.digits()};
    return state;
}

std::vector<std::string> read_state_text(const std::string& text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : text) {
        if (c == ' ' || c == '\n') {
            if (!word.empty()) words.push_back(word);
            word.clear();
        } else {
            word += c == '\x01' ? '\n' : c == '\x02' ? ' ' : c;
        }
    }
    if (!word.empty()) words.push_back(word);
    return words;
}

}  // namespace porttool
