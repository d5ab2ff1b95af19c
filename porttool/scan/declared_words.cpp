// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/scan/declared_words.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "porttool/scan/attributes.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// Reads a file's statements outside of units, and the namespaces that they stand in.
class WordReader {
public:
    explicit WordReader(const ScannedFile& file) : lexed_(file.lexed) {
        for (const Unit& unit : file.units)
            if (unit.kind != UnitKind::File) units_.push_back(unit.tokens);
        std::sort(units_.begin(), units_.end(), [](TokenRange a, TokenRange b) { return a.first < b.first; });
    }

    std::vector<DeclaredWord> run() {
        const auto count = static_cast<uint32_t>(lexed_.tokens.size());
        auto unit = units_.begin();
        for (uint32_t at = 0; at < count;) {
            while (unit != units_.end() && unit->end <= at) ++unit;
            if (unit != units_.end() && unit->first <= at) {
                at = unit->end;
                clear();
                continue;
            }
            if ((lexed_.tokens[at].flags & (kInDirective | kDead | kOffStructure)) == 0) read(at);
            ++at;
        }
        read_directives();
        return std::move(out_);
    }

private:
    std::string_view word(size_t i) const { return i < statement_.size() ? lexed_.view(statement_[i]) : ""; }
    bool is_name(size_t i) const {
        return i < statement_.size() && lexed_.tokens[statement_[i]].kind == TokenKind::Identifier;
    }

    /// One token, in order.
    void read(uint32_t at) {
        const std::string_view text = lexed_.view(at);
        if (skipped_ > 0) {  // an initialiser, or what is not known
            skipped_ += text == "{" ? 1 : text == "}" ? -1 : 0;
            if (skipped_ > 0) return;
            if (after_list_) return clear();  // a function that is no unit
        } else if (text == "{") {
            if (opens_namespace()) return;
            skipped_ = 1;
            after_list_ = !statement_.empty() && word(statement_.size() - 1) == ")" && !has_value();
        } else if (text == "}") {
            if (scopes_.size() > 1) scopes_.pop_back();
            return clear();
        } else if (text == ";") {
            finish();
            return clear();
        }
        constexpr size_t kLongest = 256;  // tokens of a declaration that a person wrote
        if (statement_.size() < kLongest) statement_.push_back(at);
    }

    bool opens_namespace() {
        const bool is_inline = word(0) == "inline";
        const size_t first = is_inline ? 1 : 0;
        const bool linkage = word(0) == "extern" && statement_.size() == 2;
        if (word(first) != "namespace" && !linkage) return false;
        constexpr size_t kMostScopes = 16, kMostBytes = 1024;
        auto path = scopes_.back();
        if (!linkage && scopes_.size() < kMostScopes) {
            std::string longer = *path;
            for (size_t i = first + 1; i < statement_.size() && longer.size() + word(i).size() < kMostBytes; ++i)
                if (is_name(i) && word(i) != "inline") longer.append(word(i)).append("::");
            path = std::make_shared<const std::string>(std::move(longer));
        }
        if (is_inline) add(statement_.size() - 1, DeclaredWord::Kind::Opened);
        scopes_.push_back(std::move(path));
        clear();
        return true;
    }

    void finish() {
        const size_t end = statement_.size();
        size_t first = 0;
        if (word(0) == "template") first = past_angles(1);
        if (word(first) == "using") return read_using(first, end);
        if (word(first) == "namespace") return end > first + 2 ? add(first + 1, DeclaredWord::Kind::Type) : void();
        if (is_one_of(word(first), {"struct", "class", "union", "enum"}) && end <= first + 3) return;  // `struct Ray;`
        const size_t before = out_.size();
        read_declarators(first, end,
                         word(first) == "typedef" ? DeclaredWord::Kind::Type
                         : is_linked()            ? DeclaredWord::Kind::Linked
                                                  : DeclaredWord::Kind::Declared);
        if (out_.size() > before && out_[before].kind == DeclaredWord::Kind::Declared) read_attributes(first, end);
    }

    /// Those of a function's declaration that may change what it does.
    void read_attributes(size_t first, size_t end) {
        size_t name = end;  // of the function
        std::vector<std::pair<size_t, size_t>> lists;
        for (size_t i = first; i < end;) {
            const bool in_brackets = word(i) == "[" && word(i + 1) == "[";
            const size_t open = in_brackets ? i : i + 1;
            if (in_brackets || (opens_attributes(word(i)) && word(open) == "(")) {
                if (!is_idle(open + 1, past_brackets(open) - 1)) lists.emplace_back(i, past_brackets(open));
                i = past_brackets(open);
                continue;
            }
            if (word(i) == "(" && name == end && i > first + 1 && is_name(i - 1)) name = i - 1;
            i = is_one_of(word(i), {"(", "[", "{"}) ? past_brackets(i) : i + 1;
        }
        for (const auto& [at, after] : lists)
            if (name != end) add_attribute(name, at, std::min(after, end));
    }

    bool is_idle(size_t first, size_t end) const {
        return are_idle_attributes(
            first, end, [&](size_t i) { return word(i); }, [&](size_t i) { return is_name(i); },
            [&](size_t i) { return word(i) == "(" || word(i) == "[" ? past_brackets(i) : i + 1; });
    }

    /// True behind the `=` of a variable, as of `auto square = [](float x) {`.
    bool has_value() const {
        for (size_t i = 1; i < statement_.size(); ++i) {
            if (word(i) == "=" && word(i - 1) != "operator") return true;
            if (word(i) == "(") i = past_brackets(i) - 1;
        }
        return false;
    }

    /// True where another symbol stands for what is declared.
    bool is_linked() const {
        for (size_t i = 0; i < statement_.size(); ++i)
            if (is_one_of(word(i), {"asm", "__asm", "__asm__", "alias", "__alias__", "ifunc", "__ifunc__", "weakref",
                                    "__weakref__"}) &&
                word(i + 1) == "(")
                return true;
        return false;
    }

    void read_using(size_t first, size_t end) {
        if (word(first + 1) == "namespace") return add(end - 1, DeclaredWord::Kind::Opened);
        if (word(first + 2) == "=" || word(first + 2) == "[") return add(first + 1, DeclaredWord::Kind::Type);
        for (size_t i = first + 1; i < end; ++i)
            if (is_name(i) && (i + 1 == end || word(i + 1) == ",")) add(i, DeclaredWord::Kind::Brought);
    }

    /// The names that stand where a declaration has its names: behind a type, before what ends one or says its value.
    void read_declarators(size_t first, size_t end, DeclaredWord::Kind kind) {
        for (size_t i = first; i < end; ++i) {
            if (is_one_of(word(i), {"decltype", "typeof", "__typeof__", "alignas"}) && word(i + 1) == "(") {
                i = past_brackets(i + 1) - 1;  // a type, or what is said of one
            } else if (word(i) == "<" && is_name(i - (i > 0 ? 1 : 0))) {
                i = past_angles(i) - 1;
            } else if (word(i) == "(" || word(i) == "[") {
                const size_t close = past_brackets(i);
                const bool names = word(i) == "(" && (is_one_of(word(i + 1), {"*", "&", "^"}) ||
                                                      (close == i + 3 && is_one_of(word(close), {"(", "["})));
                for (size_t k = i + 1; names && k < close && word(k) != "("; ++k)
                    if (is_name(k) && is_one_of(word(k + 1), {")", "[", "("})) add(k, kind);
                i = close - 1;
            } else if (word(i) == "=" || word(i) == "{") {
                while (i < end && word(i) != ",") i = is_one_of(word(i), {"(", "[", "{"}) ? past_brackets(i) : i + 1;
            } else if (is_name(i) && follows_type(i, first) && ends_name(i, end)) {
                add(i, kind);
            }
        }
    }

    bool follows_type(size_t i, size_t first) const {
        if (i == first) return statement_.size() == first + 1;  // `struct { ... } name;`
        return is_name(i - 1) || is_one_of(word(i - 1), {"*", "&", "&&", ">", ">>", ",", ")", "]", "}"});
    }
    /// Not what a name in parentheses follows, which is the declarator: `void (*apply)(float)`, `void (step_t)(int)`.
    bool ends_name(size_t i, size_t end) const {
        if (word(i + 1) == "(" && is_one_of(word(past_brackets(i + 1)), {"(", "["})) return false;
        return i + 1 >= end || is_one_of(word(i + 1), {"=", "[", "(", ",", "{", ":"});
    }

    size_t past_angles(size_t i) const {
        int depth = 0;
        for (; i < statement_.size(); ++i) {
            depth += word(i) == "<" ? 1 : word(i) == ">" ? -1 : word(i) == ">>" ? -2 : 0;
            if (depth <= 0) return i + 1;
        }
        return i;
    }
    size_t past_brackets(size_t i) const {
        int depth = 0;
        for (; i < statement_.size(); ++i) {
            depth += is_one_of(word(i), {"(", "[", "{"}) ? 1 : is_one_of(word(i), {")", "]", "}"}) ? -1 : 0;
            if (depth <= 0) return i + 1;
        }
        return i;
    }

    void add(size_t i, DeclaredWord::Kind kind) {
        if (i >= statement_.size()) return;
        if (!print_) {
            Fingerprinter print;
            print.add(*scopes_.back());
            for (const uint32_t token : statement_) print.add(lexed_.view(token));
            print_ = Print(print);
        }
        out_.push_back({statement_[i], kind, {statement_.front(), statement_.back() + 1}, *print_, scopes_.back()});
    }

    void add_attribute(size_t name, size_t first, size_t end) {
        Fingerprinter print;
        print.add(*scopes_.back());
        print.add(word(name));
        for (size_t i = first; i < end; ++i) print.add(word(i));
        out_.push_back({statement_[name],
                        DeclaredWord::Kind::Attributed,
                        {statement_[first], statement_[end - 1] + 1},
                        Print(print),
                        scopes_.back()});
    }

    void clear() {
        statement_.clear();
        print_.reset();
    }

    void read_directives() {
        for (const Directive& directive : lexed_.directives) {
            const uint32_t first = directive.first_token, end = directive.end_token;
            if (end - first < 3 || (lexed_.tokens[first].flags & kDead) != 0) continue;
            if (directive.kind == DirectiveKind::Define) add_directive(first, end, 2, DeclaredWord::Kind::Macro);
            if (directive.kind != DirectiveKind::Other || end - first < 4 || lexed_.view(first + 1) != "pragma")
                continue;
            if (lexed_.view(first + 2) == "omp" && end - first > 5 && lexed_.view(first + 4) == "variant")
                add_variant(first, end);
            if (!is_one_of(lexed_.view(first + 2), {"redefine_extname", "weak", "push_macro", "pop_macro"})) continue;
            const bool in_quotes = lexed_.view(first + 3) == "(" && end - first > 4;
            add_directive(first, end, in_quotes ? 4 : 3, DeclaredWord::Kind::Pragma);
        }
    }

    /// `#pragma omp declare variant(rough) match(...)`: the word is the function that follows.
    void add_variant(uint32_t first, uint32_t end) {
        constexpr uint32_t kLongest = 64;  // tokens of a head before its parameters
        const auto last = std::min(static_cast<uint32_t>(lexed_.tokens.size()), end + kLongest);
        for (uint32_t at = end; at + 1 < last; ++at) {
            if (lexed_.tokens[at].kind != TokenKind::Identifier || lexed_.view(at + 1) != "(") continue;
            clear();
            for (uint32_t part = first; part < end; ++part) statement_.push_back(part);
            statement_.push_back(at);
            return add(statement_.size() - 1, DeclaredWord::Kind::Pragma);
        }
    }

    void add_directive(uint32_t first, uint32_t end, size_t name, DeclaredWord::Kind kind) {
        clear();
        for (uint32_t at = first; at < end; ++at) statement_.push_back(at);
        add(name, kind);
    }

    const LexedText& lexed_;
    std::vector<TokenRange> units_;
    std::vector<uint32_t> statement_;  ///< the tokens of the one that is being read
    std::optional<Print> print_;       ///< of that
    std::vector<std::shared_ptr<const std::string>> scopes_{std::make_shared<const std::string>()};
    bool after_list_ = false;  ///< the first of them comes after `)`
    int skipped_ = 0;          ///< braces that are open around what is not read
    std::vector<DeclaredWord> out_;
};

}  // namespace

std::vector<DeclaredWord> declared_words(const ScannedFile& file) { return WordReader(file).run(); }

std::string_view word_of(const ScannedFile& file, const DeclaredWord& declared) {
    const std::string_view text = file.lexed.view(declared.name_token);
    return text.size() > 2 && text[0] == '"' ? text.substr(1, text.size() - 2) : text;
}

std::string text_of(const ScannedFile& file, const DeclaredWord& declared) {
    constexpr size_t kMost = 200;
    std::string out;
    for (uint32_t at = declared.tokens.first; at < declared.tokens.end; ++at) {
        if (out.size() + file.lexed.view(at).size() > kMost) return out + " ...";
        out.append(out.empty() ? "" : " ").append(file.lexed.view(at));
    }
    return out;
}

}  // namespace porttool
