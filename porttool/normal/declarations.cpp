// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/normal/declarations.h"

#include <algorithm>
#include <unordered_set>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/parameters.h"

namespace porttool {
namespace {

/// Finds declarations where one can stand: at the start of a statement, and in the heads of loops, conditions, handlers
/// and lambdas. What might as well be an expression declares nothing: a local missed costs a false alarm when it is
/// renamed, a global taken for a local hides an edit. One pass over the body.
class BodyReader {
public:
    BodyReader(const BracketedTokens& tokens, Declared& out) : tokens_(tokens), out_(out) { find_last_uses(); }

    void run() {
        bool starts = true;
        for (size_t i = 0; i < tokens_.size(); ++i) {
            if (starts) {
                groups_.back().first = i;
                groups_.back().declares = read_declaration(i);
            }
            starts = step(i);
        }
    }

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

    std::string_view word(size_t i) const { return tokens_.word(i); }

    /// The last use of each word as something else than a function.
    void find_last_uses() {
        for (size_t i = 0; i < tokens_.size(); ++i) {
            if (!tokens_.is_name(i) || word(i + 1) == "(") continue;
            const uint32_t name = used_.number(word(i));
            last_use_.resize(used_.size());
            last_use_[name] = i;
        }
    }

    // -- declarations --

    /// Reads the type that a declaration at `at` would have, and goes past it; false if there is none.
    bool read_type(size_t& at, Type& type) const {
        for (;; ++at) {
            if (word_is(word(at), kQualifier))
                type.certain = true;
            else if (word_is(word(at), kGroupedQualifier) && word(at + 1) == "(")
                at = tokens_.after_group(at + 1) - 1;
            else if (word(at) == "[" && word(at + 1) == "[")
                at = tokens_.after_group(at) - 1;
            else if (!word_is(word(at), kSoftQualifier) || !tokens_.is_name(at + 1))
                break;
        }
        if (word_is(word(at), kRecord)) {
            type.certain = true;
            ++at;
        }
        if (word_is(word(at), kTypeOfValue) && word(at + 1) == "(") {
            type.certain = true;
            at = tokens_.after_group(at + 1);
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
        while (tokens_.is_name(at) && !word_is(word(at), kNoType)) {
            type.name = word(at++);
            if (word(at) == "<") {
                const size_t after = tokens_.after_arguments(at);
                type.composed = type.composed || after > at;
                at = after;
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
            word(at + 4) == "(" && tokens_.may_be_declared(at + 2)) {
            out_.add(tokens_, at + 2);
            return true;
        }
        if (!tokens_.may_be_declared(at) || !declares(group, type, marks > 0, at)) return false;
        if (!type.name.empty()) out_.types.number(type.name);
        out_.add(tokens_, at);
        return true;
    }

    /// `auto [a, b] =`
    bool read_bindings(size_t open) {
        const size_t end = tokens_.after_group(open);
        if (!is_one_of(word(end), {"=", ":", "{", "("})) return false;
        for (size_t i = open + 1; i + 1 < end; ++i)
            if (tokens_.may_be_declared(i)) out_.add(tokens_, i);
        return true;
    }

    /// Is the word at `name`, after a possible type, sure to be declared there?
    bool declares(const Group& group, const Type& type, bool marked, size_t name) const {
        const std::string_view follow = word(name + 1);
        if (group.place == Place::Handler) return follow == ")";
        const bool known = type.certain || (type.composed && !out_.names.contains(type.name)) ||
                           (out_.types.contains(type.name) && !out_.names.contains(type.name));
        if (follow == "=") return known || !marked || !out_.names.contains(type.name);  // no product is assigned to
        if (group.place == Place::Condition) return known && group.clause == 0 && (follow == ";" || follow == "{");
        if (follow == ":") return group.place == Place::For;
        if (follow == "(") return (known || (!marked && is_used(type, name))) && !is_prototype(name + 1);
        return is_one_of(follow, {";", ",", "[", "{"}) && (known || !marked);
    }

    /// `T x(1)` of an unknown T may be a macro before a call, unless x is a value later on.
    bool is_used(const Type& type, size_t name) const {
        const uint32_t used = used_.find(word(name));
        return !is_shouted(type.name) && used != TextNumbers::kNone && last_use_[used] > name;
    }

    /// `float f(int x);` names a function.
    bool is_prototype(size_t open) const {
        if (word(open + 1) == ")" || word(open + 1) == "const") return true;
        return is_type_word(word(open + 1)) && word(open + 2) != "(" && word(open + 2) != "{";
    }

    /// `int a = 1, b, c[2];`: a comma at the depth of a declaration goes on with it while names follow.
    bool declare_next(size_t name) {
        while (is_one_of(word(name), {"*", "&", "&&"}) || word_is(word(name), kQualifier)) ++name;
        if (!tokens_.may_be_declared(name) || !is_one_of(word(name + 1), {"=", ",", ";", "[", "(", "{"})) return false;
        out_.add(tokens_, name);
        return true;
    }

    // -- brackets --

    /// Takes the token at `i` into account; true if a statement or a clause of a head starts after it.
    bool step(size_t i) {
        const std::string_view text = word(i);
        if (text.size() != 1) return false;
        const char sign = text[0];
        Group& group = groups_.back();
        if (sign == '(' || sign == '[' || sign == '{') return open(i);
        if (sign == ')' || sign == ']' || sign == '}') {
            const Place closed = group.place;
            if (groups_.size() > 1) groups_.pop_back();
            return sign == '}' && (closed == Place::Block || closed == Place::Record);
        }
        if (sign == ';') {
            group.declares = false;
            ++group.clause;
            return group.place == Place::Block || group.place == Place::Record ||
                   (group.place == Place::Condition && group.clause == 1);
        }
        if (sign == ':') return group.place == Place::Block && is_one_of(word(group.first), {"case", "default"});
        if (sign == ',' && group.declares && i >= arguments_end_) group.declares = declare_next(i + 1);
        if (sign == '<' && group.declares && i >= arguments_end_) arguments_end_ = tokens_.after_arguments(i);
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
        return !tokens_.is_name(i - 1) && !is_one_of(before, {")", "]", ">", "[", "&", "*"});
    }

    /// The parameters and the place of the body of the lambda at `i`.
    void read_lambda(size_t i) {
        size_t at = tokens_.after_group(i);
        if (word(at) == "(") {
            const size_t end = tokens_.after_group(at);
            read_parameters(tokens_, at + 1, end - 1, out_);
            at = end;
        }
        constexpr size_t kLongest = 32;
        for (size_t k = at; k < at + kLongest && k < tokens_.size(); ++k) {
            if (word(k) == "{") lambda_bodies_.insert(k);
            if (is_one_of(word(k), {"{", ";", ",", ")", "]"})) return;
        }
    }

    const BracketedTokens& tokens_;
    Declared& out_;
    std::vector<Group> groups_ = {Group()};
    TextNumbers used_;
    std::vector<size_t> last_use_;  ///< of each of used_
    std::unordered_set<size_t> lambda_bodies_;
    size_t arguments_end_ = 0;  ///< past the template arguments in an initializer
};

}  // namespace

std::vector<uint32_t> declaring_tokens(const LexedText& lexed, TokenRange parameters, TokenRange body) {
    Declared out;
    const BracketedTokens head(lexed, parameters), code(lexed, body);
    read_parameters(head, 0, head.size(), out);
    BodyReader(code, out).run();
    std::sort(out.places.begin(), out.places.end());
    out.places.erase(std::unique(out.places.begin(), out.places.end()), out.places.end());
    return std::move(out.places);
}

}  // namespace porttool
