// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/unit_state.h"

#include <algorithm>
#include <array>
#include <unordered_map>

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

    std::vector<std::string> names;

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

std::vector<std::string> number_locals(const std::vector<NormalToken>& text, const std::vector<std::string>& names) {
    std::unordered_map<std::string, std::string> numbers;
    const std::vector<std::string> known(names);
    std::vector<std::string> out;
    out.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const std::string& word = text[i].text;
        const bool member = i > 0 && (text[i - 1].text == "." || text[i - 1].text == "->" || text[i - 1].text == "::");
        if (member || !is_word(word) || std::find(known.begin(), known.end(), word) == known.end()) {
            out.push_back(word);
            continue;
        }
        const auto number = numbers.emplace(word, "%" + std::to_string(numbers.size() + 1)).first;
        out.push_back(number->second);
    }
    return out;
}

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
    state.renamed = number_locals(state.text, local_names(file, unit));
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
