// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/locals.h"

#include <algorithm>
#include <initializer_list>
#include <unordered_set>

#include "porttool/language/words.h"

namespace porttool {
namespace {

bool is_word(std::string_view text) {
    const char c = text.empty() ? '\0' : text[0];
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '$' || static_cast<signed char>(c) < 0;
}

bool is_one_of(std::string_view text, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), text) != words.end();
}

bool is_shouted(std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// Finds declarations where one can stand: at the start of a statement, and in the heads of loops, conditions, handlers
/// and lambdas. What might as well be an expression declares nothing: a local missed costs a false alarm when it is
/// renamed, a global taken for a local hides an edit. One pass over the body.
class LocalFinder {
public:
    LocalFinder(const LexedText& lexed, TokenRange parameters, TokenRange body) : lexed_(lexed) {
        take(parameters);
        read_parameters(0, tokens_.size());
        tokens_.clear();
        take(body);
        find_last_uses();
        bool starts = true;
        for (size_t i = 0; i < tokens_.size(); ++i) {
            if (starts) {
                groups_.back().first = i;
                groups_.back().declares = read_declaration(i);
            }
            starts = step(i);
        }
        std::sort(places.begin(), places.end());
        places.erase(std::unique(places.begin(), places.end()), places.end());
    }

    std::vector<uint32_t> places;

private:
    enum class Place : uint8_t { Block, Record, For, Condition, Handler, Other };
    /// An open bracket.
    struct Group {
        Place place = Place::Block;
        size_t first = 0;       ///< where the statement or clause in it begins
        int clause = 0;         ///< semicolons before it, in a head
        bool declares = false;  ///< within the declarators of a declaration
        bool lambda = false;    ///< `[` that begins a lambda
    };
    /// What stands before a declared name.
    struct Type {
        std::string_view name;  ///< its last word
        bool certain = false;   ///< a keyword says so
        bool composed = false;  ///< `A::B`, `A<B>`
        bool deduced = false;   ///< `auto`
    };

    void take(TokenRange range) {
        for (uint32_t i = range.first; i < range.end; ++i)
            if ((lexed_.tokens[i].flags & (kInDirective | kDead)) == 0) tokens_.push_back(i);
        match_brackets();
    }
    std::string_view word(size_t i) const { return i < tokens_.size() ? lexed_.view(tokens_[i]) : std::string_view(); }
    bool is_name(size_t i) const {
        return i < tokens_.size() && lexed_.tokens[tokens_[i]].kind == TokenKind::Identifier;
    }
    bool may_be_declared(size_t i) const {
        const std::string_view text = word(i);
        const bool type = is_type_word(text) && text != "half";  // half of something, where there is no such type
        return is_name(i) && !type && !word_is(text, kNoType | kQualifier | kRecord);
    }

    void declare(size_t i) {
        places.push_back(tokens_[i]);
        declared_.insert(word(i));
    }

    /// The last use of each word as something else than a function.
    void find_last_uses() {
        for (size_t i = 0; i < tokens_.size(); ++i)
            if (is_name(i) && word(i + 1) != "(") last_use_[word(i)] = i;
    }

    /// The token behind the bracket that closes the one at `i`; the end if none does.
    size_t behind_group(size_t i) const { return i < behind_.size() ? behind_[i] : tokens_.size(); }

    void match_brackets() {
        behind_.assign(tokens_.size(), tokens_.size());
        std::vector<size_t> open;
        for (size_t i = 0; i < tokens_.size(); ++i) {
            const std::string_view text = word(i);
            if (text == "(" || text == "[" || text == "{") open.push_back(i);
            if (open.empty() || (text != ")" && text != "]" && text != "}")) continue;
            behind_[open.back()] = i + 1;
            open.pop_back();
        }
    }

    /// The token behind the template arguments that begin with the `<` at `i`, or `i` if it is a comparison. Within
    /// bounds, so that the whole stays linear.
    size_t behind_arguments(size_t i) const {
        constexpr size_t kLongest = 64;
        int depth = 0;
        for (size_t at = i; at < tokens_.size() && at < i + kLongest; ++at) {
            const std::string_view text = word(at);
            if (text == "<") ++depth;
            if (text == ">") --depth;
            if (text == ">>") depth -= 2;
            if (depth <= 0) return depth == 0 ? at + 1 : i;
            const bool fits = is_name(at) || lexed_.tokens[tokens_[at]].kind == TokenKind::Number ||
                              is_one_of(text, {"<", ">", ">>", ",", "::", "*", "&", "...", "[", "]", "(", ")"});
            if (!fits || word_is(text, kNoType)) return i;
        }
        return i;
    }

    // -- parameters --

    /// The last word before a comma, a default or an array bound names a parameter if its type stands before it.
    void read_parameters(size_t first, size_t end) {
        bool typed = false, closed = false;
        size_t last = end, type = end;
        const auto finish = [&] {
            if (last < end && typed) {
                declare(last);
                if (type < end) types_.insert(word(type));
            }
            typed = closed = false;
            last = type = end;
        };
        for (size_t i = first; i < end; ++i) {
            const std::string_view text = word(i);
            if (text == ",") {
                finish();
            } else if (text == "=" || text == "[" || text == ":") {
                if (text != "[" || word(i + 1) != "[" || last < end || typed) closed = true;
                if (text == "[") i = std::min(behind_group(i), end) - 1;
            } else if (text == "(" && !closed && is_one_of(word(i + 1), {"*", "&", "^"}) && word(i + 3) == ")" &&
                       word(i + 4) == "(" && may_be_declared(i + 2)) {
                typed = typed || last < end;
                last = i + 2;
                closed = true;
                i = std::min(behind_group(i), end) - 1;
            } else if (text == "(" || text == "{") {
                if (!closed && last < end && word_is(word(last), kTypeOfValue)) typed = true;
                if (!closed) last = end;
                i = std::min(behind_group(i), end) - 1;
            } else if (text == "<" && !closed) {
                const size_t behind = behind_arguments(i);
                if (behind > i) i = std::min(behind, end) - 1;
            } else if (text == "::" && !closed) {
                last = end;
                ++i;  // `A::B` is a type
                typed = true;
                type = i;
            } else if (is_name(i) && !closed) {
                read_parameter_word(i, typed, last, type, end);
            }
        }
        finish();
    }

    void read_parameter_word(size_t i, bool& typed, size_t& last, size_t& type, size_t end) const {
        const std::string_view text = word(i);
        if (word_is(text, kQualifier | kRecord)) return;
        if (last < end) {
            typed = typed || !word_is(word(last), kSoftQualifier);
            type = last;
        }
        last = end;
        if (is_type_word(text))
            typed = true;
        else if (!word_is(text, kNoType))
            last = i;
    }

    // -- declarations --

    /// Reads the type that a declaration at `at` would have, and goes behind it; false if there is none.
    bool read_type(size_t& at, Type& type) const {
        for (;; ++at) {
            if (word_is(word(at), kQualifier))
                type.certain = true;
            else if (word_is(word(at), kGroupedQualifier) && word(at + 1) == "(")
                at = behind_group(at + 1) - 1;
            else if (word(at) == "[" && word(at + 1) == "[")
                at = behind_group(at) - 1;
            else if (!word_is(word(at), kSoftQualifier) || !is_name(at + 1))
                break;
        }
        if (word_is(word(at), kRecord)) {
            type.certain = true;
            ++at;
        }
        if (word_is(word(at), kTypeOfValue) && word(at + 1) == "(") {
            type.certain = true;
            at = behind_group(at + 1);
        } else if (is_type_word(word(at))) {
            type.certain = true;
            type.deduced = word(at) == "auto";
            type.name = word(at++);
            while (word_is(word(at), kTypePart) || word(at) == "double") ++at;
        } else if (!read_named_type(at, type)) {
            return false;
        }
        for (; word_is(word(at), kQualifier); ++at) type.certain = true;
        return true;
    }

    bool read_named_type(size_t& at, Type& type) const {
        if (word(at) == "::") ++at;
        while (is_name(at) && !word_is(word(at), kNoType)) {
            type.name = word(at++);
            if (word(at) == "<") {
                const size_t behind = behind_arguments(at);
                type.composed = type.composed || behind > at;
                at = behind;
            }
            if (word(at) != "::") return true;
            type.composed = true;
            ++at;
        }
        return false;
    }

    bool read_declaration(size_t at) {
        const Group group = groups_.back();
        if (group.place == Place::Record || group.place == Place::Other) return false;
        Type type;
        if (!read_type(at, type)) return false;
        size_t marks = 0;
        for (; is_one_of(word(at), {"*", "&", "&&", "^"}) || (marks > 0 && word_is(word(at), kQualifier)); ++at)
            ++marks;
        if (type.deduced && word(at) == "[") return read_bindings(at);
        if (type.certain && word(at) == "(" && is_one_of(word(at + 1), {"*", "&"}) && word(at + 3) == ")" &&
            word(at + 4) == "(" && may_be_declared(at + 2)) {
            declare(at + 2);
            return true;
        }
        if (!may_be_declared(at) || !declares(group, type, marks > 0, at)) return false;
        if (!type.name.empty()) types_.insert(type.name);
        declare(at);
        return true;
    }

    /// `auto [a, b] =`
    bool read_bindings(size_t open) {
        const size_t end = behind_group(open);
        if (!is_one_of(word(end), {"=", ":", "{", "("})) return false;
        for (size_t i = open + 1; i + 1 < end; ++i)
            if (may_be_declared(i)) declare(i);
        return true;
    }

    /// Is the word at `name`, behind a possible type, sure to be declared there?
    bool declares(const Group& group, const Type& type, bool marked, size_t name) const {
        const std::string_view follow = word(name + 1);
        if (group.place == Place::Handler) return follow == ")";
        const bool known = type.certain || (type.composed && !declared_.contains(type.name)) ||
                           (types_.contains(type.name) && !declared_.contains(type.name));
        if (follow == "=") return known || !marked || !declared_.contains(type.name);  // no product is assigned to
        if (group.place == Place::Condition) return known && group.clause == 0 && (follow == ";" || follow == "{");
        if (follow == ":") return group.place == Place::For;
        if (follow == "(") return (known || (!marked && is_used(type, name))) && !is_prototype(name + 1);
        return is_one_of(follow, {";", ",", "[", "{"}) && (known || !marked);
    }

    /// `T x(1)` of an unknown T may be a macro before a call, unless x is a value later on.
    bool is_used(const Type& type, size_t name) const {
        const auto found = last_use_.find(word(name));
        return !is_shouted(type.name) && found != last_use_.end() && found->second > name;
    }

    /// `float f(int x);` names a function.
    bool is_prototype(size_t open) const {
        if (word(open + 1) == ")" || word(open + 1) == "const") return true;
        return is_type_word(word(open + 1)) && word(open + 2) != "(" && word(open + 2) != "{";
    }

    /// `int a = 1, b, c[2];`: a comma at the depth of a declaration goes on with it while names follow.
    bool declare_next(size_t name) {
        while (is_one_of(word(name), {"*", "&", "&&"}) || word_is(word(name), kQualifier)) ++name;
        if (!may_be_declared(name) || !is_one_of(word(name + 1), {"=", ",", ";", "[", "(", "{"})) return false;
        declare(name);
        return true;
    }

    // -- brackets --

    /// Takes the token at `i` into account; true if a statement or a clause of a head starts behind it.
    bool step(size_t i) {
        const std::string_view text = word(i);
        Group& group = groups_.back();
        if (text == "(" || text == "[" || text == "{") return open(i);
        if (text == ")" || text == "]" || text == "}") {
            const Place closed = group.place;
            if (groups_.size() > 1) groups_.pop_back();
            return text == "}" && (closed == Place::Block || closed == Place::Record);
        }
        if (text == ";") {
            group.declares = false;
            ++group.clause;
            return group.place == Place::Block || group.place == Place::Record ||
                   (group.place == Place::Condition && group.clause == 1);
        }
        if (text == ":") return group.place == Place::Block && is_one_of(word(group.first), {"case", "default"});
        if (text == "," && group.declares && i >= arguments_end_) group.declares = declare_next(i + 1);
        if (text == "<" && group.declares && i >= arguments_end_) arguments_end_ = behind_arguments(i);
        return false;
    }

    bool open(size_t i) {
        Group group;
        if (word(i) == "(")
            group.place = place_of_head(i);
        else if (word(i) == "{")
            group.place = place_of_braces(i);
        else
            group.place = Place::Other;
        if (word(i) == "[") group.lambda = begins_lambda(i);
        if (word(i) == "[" && group.lambda) read_lambda(i);
        groups_.push_back(group);
        return group.place != Place::Other;
    }

    Place place_of_head(size_t i) const {
        const std::string_view before = i > 0 ? word(i - (word(i - 1) == "constexpr" && i > 1 ? 2 : 1)) : "";
        if (word_is(before, kLoopHead)) return Place::For;
        if (word_is(before, kConditionHead)) return Place::Condition;
        return before == "catch" ? Place::Handler : Place::Other;
    }

    /// A block, the fields of a record, or a list of values.
    Place place_of_braces(size_t i) const {
        const Group& group = groups_.back();
        if (i == 0) return Place::Block;
        const std::string_view before = word(i - 1);
        if (lambda_bodies_.contains(i)) return Place::Block;
        if (group.place == Place::Other || group.place == Place::For || group.place == Place::Condition)
            return Place::Other;
        if (word_is(word(group.first), kRecord)) return Place::Record;
        if (is_one_of(before, {")", ";", "{", "}", ":", "else", "do", "try"})) return Place::Block;
        return Place::Other;
    }

    bool begins_lambda(size_t i) const {
        if (word(i + 1) == "[") return false;
        if (i == 0) return true;
        const std::string_view before = word(i - 1);
        if (is_one_of(before, {"return", "co_return", "co_yield"})) return true;
        return !is_name(i - 1) && !is_one_of(before, {")", "]", ">", "[", "&", "*"});
    }

    /// The parameters and the place of the body of the lambda at `i`.
    void read_lambda(size_t i) {
        size_t at = behind_group(i);
        if (word(at) == "(") {
            const size_t end = behind_group(at);
            read_parameters(at + 1, end - 1);
            at = end;
        }
        constexpr size_t kLongest = 32;
        for (size_t k = at; k < at + kLongest && k < tokens_.size(); ++k) {
            if (word(k) == "{") lambda_bodies_.insert(k);
            if (is_one_of(word(k), {"{", ";", ",", ")", "]"})) return;
        }
    }

    const LexedText& lexed_;
    std::vector<uint32_t> tokens_;
    std::vector<size_t> behind_;  ///< for each opening bracket: the token behind the one that closes it
    std::vector<Group> groups_ = {Group()};
    std::unordered_map<std::string_view, size_t> last_use_;
    std::unordered_set<std::string_view> declared_, types_;  ///< words declared, and used as types, so far
    std::unordered_set<size_t> lambda_bodies_;
    size_t arguments_end_ = 0;  ///< behind the template arguments in an initializer
};

}  // namespace

std::vector<uint32_t> declaring_tokens(const LexedText& lexed, TokenRange parameters, TokenRange body) {
    return LocalFinder(lexed, parameters, body).places;
}

size_t LocalNumbers::next(std::string_view text, uint32_t token) {
    if (head_closes_) close(text == "{");
    head_closes_ = false;
    const size_t number = is_word(text) && !member_ ? number_of(text, token) : 0;
    if (text == "(") open(scoped_);
    if (text == "{") open_block();
    if (text == ")") head_closes_ = true;
    if (text == "}") close(false);
    member_ = text == "." || text == "->" || text == "::";
    scoped_ = text == "]" || word_is(text, kOwnScope);  // behind `]` a lambda's parameters
    return number;
}

size_t LocalNumbers::number_of(std::string_view text, uint32_t token) {
    if (std::binary_search(places_.begin(), places_.end(), token)) {
        size_t& number = numbers_[text];
        shadowed_.push_back({text, number});
        return number = ++count_;
    }
    const auto found = numbers_.find(text);
    return found == numbers_.end() ? 0 : found->second;
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
LexedText as_lexed(const Words& words) {
    LexedText out;
    for (const std::string_view word : words) {
        Token token;
        token.offset = static_cast<uint32_t>(out.text.size());
        token.length = static_cast<uint32_t>(word.size());
        token.kind = is_word(word) ? TokenKind::Identifier : TokenKind::Punctuator;
        out.tokens.push_back(token);
        out.text += word;
    }
    return out;
}

uint32_t find_from(const Words& words, uint32_t at, std::string_view word) {
    while (at < words.size() && words[at] != word) ++at;
    return at;
}

}  // namespace

std::vector<size_t> local_numbers(const Words& words) {
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
    for (uint32_t i = 0; i < count; ++i) out.push_back(numbers.next(words[i], i));
    return out;
}

}  // namespace porttool
