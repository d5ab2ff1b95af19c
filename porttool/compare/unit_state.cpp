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

bool is_word(const std::string& text) {
    const char c = text.empty() ? '\0' : text[0];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' || static_cast<signed char>(c) < 0;
}

bool is_number(const std::string& text) {
    return !text.empty() && ((text[0] >= '0' && text[0] <= '9') || text[0] == '.') && text != "." && text != "...";
}

/// Words that stand before a name without being its type.
bool is_no_type(std::string_view text) {
    constexpr std::array<std::string_view, 18> kWords = {
        "return", "else",     "delete",  "goto",   "case",    "using",     "throw", "new",   "do",
        "break",  "continue", "default", "sizeof", "typedef", "namespace", "if",    "while", "operator"};
    return std::find(kWords.begin(), kWords.end(), text) != kWords.end();
}

/// Finds declarations by their shape: a type, then a name, then what may follow a declared name.
class LocalFinder {
public:
    LocalFinder(const LexedText& lexed, TokenRange parameters, TokenRange body) : lexed_(lexed) {
        take(parameters);
        read_parameters();
        tokens_.clear();
        take(body);
        for (size_t i = 0; i + 1 < tokens_.size(); ++i) read_declaration(i);
    }

    std::vector<std::string> names;       ///< each once, in order of appearance
    std::unordered_set<uint32_t> places;  ///< the tokens that declare one, also again in another scope

private:
    void take(TokenRange range) {
        for (uint32_t i = range.first; i < range.end; ++i)
            if ((lexed_.tokens[i].flags & (kInDirective | kDead)) == 0) tokens_.push_back(i);
    }
    std::string_view word(size_t i) const { return i < tokens_.size() ? lexed_.view(tokens_[i]) : std::string_view(); }
    bool is_name(size_t i) const {
        return i < tokens_.size() && lexed_.tokens[tokens_[i]].kind == TokenKind::Identifier;
    }

    void declare(size_t i) {
        const std::string name(word(i));
        places.insert(tokens_[i]);
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }

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

    void read_declaration(size_t i) {
        // `T x =`, `T* x;`, `T<int>& x :`, `T x[4]`, `T x(1)`
        if (!is_name(i + 1) || is_no_type(word(i + 1))) return;
        const std::string_view follow = word(i + 2);
        const bool after_type = is_name(i) && !is_no_type(word(i));
        const bool after_mark =
            (word(i) == "*" || word(i) == "&" || word(i) == ">" || word(i) == "&&") && i > 0 && starts_statement(i);
        if (!after_type && !after_mark) return;
        if (after_type && i > 0 && (word(i - 1) == "." || word(i - 1) == "->")) return;
        const bool ends = follow == "=" || follow == ";" || follow == "," || follow == "[" || follow == ":" ||
                          follow == "{" || (follow == "(" && after_type) || follow == ")";
        if (!ends) return;
        declare(i + 1);
        read_further(i + 2);
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

    /// `int a = 1, b, c[2];`
    void read_further(size_t i) {
        int depth = 0;
        constexpr size_t kFarthest = 2000;
        for (const size_t end = i + kFarthest; i < tokens_.size() && i < end; ++i) {
            const std::string_view text = word(i);
            if (text == "(" || text == "[" || text == "{") ++depth;
            if (text == ")" || text == "]" || text == "}") --depth;
            if (depth < 0 || (depth == 0 && text == ";")) return;
            if (depth != 0 || text != ",") continue;
            size_t name = i + 1;
            while (word(name) == "*" || word(name) == "&") ++name;
            const std::string_view follow = word(name + 1);
            if (!is_name(name) || (follow != "=" && follow != "," && follow != ";" && follow != "[" && follow != "("))
                return;
            declare(name);
        }
    }

    const LexedText& lexed_;
    std::vector<uint32_t> tokens_;
};

/// Numbers locals and parameters in the order of their declarations, scope by scope, so that a name that is declared
/// again within a block is another variable there. Words that no declaration in force covers stay as they are.
class LocalNumbers {
public:
    explicit LocalNumbers(const LocalFinder& locals) : locals_(locals) {}

    std::vector<std::string> run(const std::vector<NormalToken>& text) {
        std::vector<std::string> out;
        out.reserve(text.size());
        for (size_t i = 0; i < text.size(); ++i) {
            const std::string& word = text[i].text;
            const std::string& before = i > 0 ? text[i - 1].text : none_;
            if (is_word(word)) {
                out.push_back(numbered(text[i], before));
                continue;
            }
            out.push_back(word);
            if (word == "(") open(has_own_scope(before));
            if (word == "{") open_block();
            if (word == ")") close(i + 1 < text.size() && text[i + 1].text == "{");
            if (word == "}") close(false);
        }
        return out;
    }

private:
    using Scope = std::unordered_map<std::string, std::string>;
    struct Bracket {
        bool scoped = false;
        bool block = false;
    };

    /// What is declared in these parentheses holds for the block behind them: loops, conditions, a lambda.
    static bool has_own_scope(const std::string& before) {
        constexpr std::array<std::string_view, 6> kHeads = {"for", "if", "while", "switch", "catch", "]"};
        return std::find(kHeads.begin(), kHeads.end(), before) != kHeads.end();
    }

    std::string numbered(const NormalToken& token, const std::string& before) {
        if (before == "." || before == "->" || before == "::") return token.text;  // a member
        if (locals_.places.contains(token.token)) return scopes_.back()[token.text] = "%" + std::to_string(++count_);
        for (auto scope = scopes_.rbegin(); scope != scopes_.rend(); ++scope)
            if (const auto found = scope->find(token.text); found != scope->end()) return found->second;
        return token.text;
    }

    void open(bool scoped) {
        brackets_.push_back({scoped, false});
        if (scoped) scopes_.emplace_back();
    }
    /// A block takes over the scope of the head before it.
    void open_block() {
        brackets_.push_back({true, true});
        if (!pending_) scopes_.emplace_back();
        pending_ = false;
    }
    void close(bool block_follows) {
        if (brackets_.empty()) return;
        const Bracket bracket = brackets_.back();
        brackets_.pop_back();
        if (!bracket.scoped) return;
        if (!bracket.block && block_follows)
            pending_ = true;
        else if (scopes_.size() > 1)
            scopes_.pop_back();
    }

    const LocalFinder& locals_;
    const std::string none_;
    std::vector<Scope> scopes_ = std::vector<Scope>(1);
    std::vector<Bracket> brackets_;
    size_t count_ = 0;
    bool pending_ = false;
};

std::string print_of(const std::vector<std::string>& words) {
    std::vector<NormalToken> tokens;
    tokens.reserve(words.size());
    for (const std::string& word : words) tokens.push_back({word, 0});
    return fingerprint(tokens);
}

}  // namespace

std::vector<std::string> local_names(const ScannedFile& file, const Unit& unit) {
    if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) return {};
    return LocalFinder(file.lexed, unit.parameters, unit.body).names;
}

UnitState unit_state(const ScannedFile& file, const Unit& unit) {
    UnitState state;
    state.id = unit_id(file, unit);
    state.file = file.path;
    state.name = unit.name;
    state.kind = unit.kind;
    state.start_line = unit.start_line;
    state.end_line = unit.end_line;
    state.text = normal_form(file, unit);
    const bool code = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
    const LocalFinder locals(file.lexed, code ? unit.parameters : TokenRange(), code ? unit.body : TokenRange());
    state.renamed = LocalNumbers(locals).run(state.text);
    std::vector<std::string> blanked = state.renamed;
    for (std::string& word : blanked)
        if (is_number(word)) word = "#";
    state.prints = {fingerprint(state.text), print_of(state.renamed), print_of(blanked)};
    return state;
}

std::string state_text(const UnitState& state) {
    std::string out;
    int parens = 0;
    for (const NormalToken& token : state.text) {
        std::string word = token.text;
        std::replace(word.begin(), word.end(), '\n', '\x01');  // raw strings stay on one line
        std::replace(word.begin(), word.end(), ' ', '\x02');
        out += word;
        if (word == "(") ++parens;
        if (word == ")") --parens;
        const bool ends = word == "{" || word == "}" || (word == ";" && parens <= 0);
        out += ends ? '\n' : ' ';
    }
    if (!out.empty() && out.back() == ' ') out.back() = '\n';
    return out;
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
