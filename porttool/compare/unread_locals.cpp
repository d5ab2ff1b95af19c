// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/unread_locals.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/text/is_one_of.h"
#include "porttool/value_graph/pure_calls.h"

namespace porttool {
namespace {

bool is_any_assignment(std::string_view sign) {
    return sign == "=" || sign == "++" || sign == "--" ||
           (sign.size() > 1 && sign.back() == '=' && !is_one_of(sign, {"==", "!=", "<=", ">="}));
}

/// A text's words, and what stands where statements do: within braces, and in no parentheses or brackets there.
class LocalsReader {
public:
    LocalsReader(const Words& text, const Dialect& dialect) : text_(text), dialect_(dialect) {
        std::vector<int> depths = {0};
        std::vector<size_t> open = {0};  // blocks
        bool in_body = false;
        starts_.assign(text.size(), false);
        block_.assign(text.size(), 0);
        block_end_ = {text.size()};
        for (size_t i = 0; i < text.size(); ++i) {
            const std::string_view before = i > 0 ? text[i - 1] : std::string_view();
            starts_[i] = in_body && depths.back() == 0 && is_one_of(before, {";", "{", "}"});
            block_[i] = open.back();
            if (text[i] == "{") {
                depths.push_back(0);
                open.push_back(block_end_.size());
                block_end_.push_back(text.size());
                in_body = true;
            }
            if (text[i] == "}" && depths.size() > 1) {
                depths.pop_back();
                block_end_[open.back()] = i;
                open.pop_back();
            }
            depths.back() += is_one_of(text[i], {"(", "["}) ? 1 : is_one_of(text[i], {")", "]"}) ? -1 : 0;
        }
    }

    /// The text without numbers and vectors of its own that nothing reads.
    std::vector<std::string_view> without_unread() const {
        std::vector<bool> gone(text_.size(), false);
        constexpr int kChain = 4;  // locals that only one another read
        for (int round = 0; round < kChain && drop_some(gone); ++round) continue;
        std::vector<std::string_view> out;
        for (size_t i = 0; i < text_.size(); ++i)
            if (!gone[i]) out.push_back(text_[i]);
        return out;
    }

    /// True if `name` at `i` is declared there, as a number, alone or among others, and without a value.
    bool is_bare_declarator(size_t i) const {
        if (i == 0 || !is_word_token(text_[i])) return false;
        size_t first = i;
        while (first > 1 && text_[first - 1] == "," && is_word_token(text_[first - 2])) first -= 2;
        size_t type = first;
        while (type > 0 && is_type_word(text_[type - 1])) --type;
        return type < first && starts_[type];
    }

private:
    /// One statement that gives a local a value, or declares it.
    struct Piece {
        size_t first, end;  ///< the words that go with the local
        size_t at;          ///< of its name
        bool declares = false;
    };

    /// True if all that is given a value is the function's own there; pieces are in the order of the text.
    bool are_declared(const std::vector<Piece>& pieces) const {
        size_t known_up_to = 0;
        for (const Piece& piece : pieces) {
            if (piece.declares) known_up_to = std::max(known_up_to, block_end_[block_[piece.at]]);
            if (piece.at >= known_up_to) return false;
        }
        return true;
    }

    /// The names that are declared here, by pieces; each name with a piece for each of its words.
    bool drop_some(std::vector<bool>& gone) const {
        std::map<std::string_view, std::vector<Piece>> pieces;
        std::map<std::string_view, size_t> times;
        std::set<std::string_view> declared;
        for (size_t i = 0; i < text_.size(); ++i) {
            if (gone[i]) continue;
            const bool is_member = i > 0 && is_one_of(text_[i - 1], {".", "->"});
            if (is_word_token(text_[i]) && !is_member) ++times[text_[i]];
            if (!starts_[i]) continue;
            if (!add_declared(i, gone, pieces, declared)) add_given(i, pieces);
        }
        bool any = false;
        for (const std::string_view name : declared) {
            if (pieces[name].size() != times[name] || !are_declared(pieces[name])) continue;
            any = true;
            for (const Piece& piece : pieces[name])
                std::fill(gone.begin() + static_cast<std::ptrdiff_t>(piece.first),
                          gone.begin() + static_cast<std::ptrdiff_t>(piece.end), true);
        }
        return any;
    }

    /// `float a = 1 , b ;`: a piece for each, with a comma, or all of it where it is the last one.
    bool add_declared(size_t first, const std::vector<bool>& gone,
                      std::map<std::string_view, std::vector<Piece>>& pieces,
                      std::set<std::string_view>& declared) const {
        size_t i = first + (text_[first] == "const" ? 1 : 0);
        const size_t type = i;
        while (i < text_.size() && (is_type_word(text_[i]) || text_[i] == "auto")) ++i;
        i = std::max(i, after_pointer_type(type));
        if (i == type) return false;
        std::vector<Piece> found;
        for (size_t from = i; i < text_.size(); ++i) {
            if (gone[i]) {
                from = i + 1;
                continue;
            }
            const size_t end = end_of_value(i + 1, true);
            const bool is_plain = is_word_token(text_[i]) && end < text_.size() &&
                                  (end == i + 1 || (text_[i + 1] == "=" && is_harmless(i + 2, end)));
            if (!is_plain) return false;
            found.push_back({from, end + 1, i, true});
            i = end;
            from = end + 1;
            if (text_[end] == ";") break;
        }
        if (found.empty()) return false;
        if (found.size() == 1) found[0].first = first;
        if (found.size() > 1) {  // the comma goes, the semicolon stays
            --found.back().first;
            --found.back().end;
        }
        for (const Piece& piece : found) {
            pieces[text_[piece.at]].push_back(piece);
            declared.insert(text_[piece.at]);
        }
        return true;
    }

    /// Behind `lib :: Timers * const` where a name with a value follows, since no pointer does anything when it goes;
    /// else `first`.
    size_t after_pointer_type(size_t first) const {
        size_t i = first;
        while (i + 2 < text_.size() && is_word_token(text_[i]) && text_[i + 1] == "::") i += 2;
        if (i + 1 >= text_.size() || !is_word_token(text_[i]) || text_[++i] != "*") return first;
        while (i < text_.size() && is_one_of(text_[i], {"*", "const", "restrict", "__restrict__", "__restrict"})) ++i;
        return i + 1 < text_.size() && is_word_token(text_[i]) && text_[i + 1] == "=" ? i : first;
    }

    /// `a = b * 2 ;`
    void add_given(size_t first, std::map<std::string_view, std::vector<Piece>>& pieces) const {
        if (!is_word_token(text_[first]) || first + 1 >= text_.size() || text_[first + 1] != "=") return;
        const size_t end = end_of_value(first + 2, false);
        if (end < text_.size() && text_[end] == ";" && is_harmless(first + 2, end))
            pieces[text_[first]].push_back({first, end + 1, first});
    }

    /// The semicolon, or comma, behind a value.
    size_t end_of_value(size_t first, bool of_several) const {
        int depth = 0;
        for (size_t i = first; i < text_.size(); ++i) {
            depth += is_one_of(text_[i], {"(", "[", "{"}) ? 1 : is_one_of(text_[i], {")", "]", "}"}) ? -1 : 0;
            if (depth < 0) return text_.size();
            if (depth == 0 && (text_[i] == ";" || (of_several && text_[i] == ","))) return i;
        }
        return text_.size();
    }

    /// True for a value that takes nothing but to reckon it.
    bool is_harmless(size_t first, size_t end) const {
        for (size_t i = first; i < end; ++i) {
            if (is_any_assignment(text_[i]) || is_one_of(text_[i], {"{", "#", "new", "throw", "await"})) return false;
            if (i + 1 >= end || text_[i + 1] != "(" || !is_word_token(text_[i]) || is_type_word(text_[i])) continue;
            const bool asks = i > first && is_one_of(text_[i - 1], {".", "->"}) &&
                              is_one_of(text_[i], {"size", "length", "empty", "begin", "end", "data"});
            if (!asks && !pure_call(text_[i], dialect_).is_pure) return false;
        }
        return true;
    }

    const Words& text_;
    const Dialect& dialect_;
    std::vector<bool> starts_;       ///< of statements in the body
    std::vector<size_t> block_;      ///< of each word
    std::vector<size_t> block_end_;  ///< of each block
};

constexpr size_t kMostForLocals = 20'000;  // words of both texts

/// The parameters of a function's head, each with its words.
struct Parameters {
    size_t open = 0, close = 0;  ///< the parentheses; 0 for a text without a head
    std::vector<Words> each;

    explicit Parameters(const Words& text) {
        const auto name = std::find(text.begin(), text.end(), "@");
        const size_t at = static_cast<size_t>(name - text.begin()) + 1;
        if (at >= text.size() || text[at] != "(") return;
        int depth = 0;
        std::vector<Words> found(1);
        for (size_t i = at + 1; i < text.size(); ++i) {
            if (depth == 0 && text[i] == ")") {
                open = at;
                close = i;
                if (found.size() > 1 || !found[0].empty()) each = std::move(found);
                return;
            }
            depth += is_one_of(text[i], {"(", "[", "<"}) ? 1 : is_one_of(text[i], {")", "]", ">"}) ? -1 : 0;
            if (depth == 0 && text[i] == ",")
                found.emplace_back();
            else
                found.back().push_back(text[i]);
        }
    }

    bool have_values() const {
        return std::any_of(each.begin(), each.end(), [](const Words& parameter) {
            return std::find(parameter.begin(), parameter.end(), "=") != parameter.end();
        });
    }
};

/// True for a parameter whose name stands there alone, as `const Hit * hit` has it.
bool is_unread(const Words& parameter, const Words& text) {
    if (parameter.size() < 2 || !is_word_token(parameter.back()) || is_type_word(parameter.back())) return false;
    return std::count(text.begin(), text.end(), parameter.back()) == 1;
}

}  // namespace

bool only_concerns_unread_locals(const Words& before, const Words& now, const Dialect& dialect) {
    if (before.size() + now.size() > kMostForLocals) return false;
    return LocalsReader(before, dialect).without_unread() == LocalsReader(now, dialect).without_unread();
}

bool only_concerns_unread_parameters(const Words& before, const Words& now) {
    if (before.size() > now.size()) return only_concerns_unread_parameters(now, before);
    const Parameters few(before), many(now);
    if (few.open == 0 || few.open != many.open || few.each.size() >= many.each.size()) return false;
    const auto at = [](const Words& text, size_t i) { return text.begin() + static_cast<std::ptrdiff_t>(i); };
    if (!std::equal(before.begin(), at(before, few.open), now.begin(), at(now, many.open)) ||
        !std::equal(at(before, few.close), before.end(), at(now, many.close), now.end()) || many.have_values())
        return false;
    size_t kept = 0;
    return std::all_of(many.each.begin(), many.each.end(),
                       [&](const Words& parameter) {
                           if (kept < few.each.size() && few.each[kept] == parameter) return ++kept > 0;
                           return is_unread(parameter, now);
                       }) &&
           kept == few.each.size();
}

bool only_gives_first_values(const Words& before, const Words& now) {
    if (before.size() + now.size() > kMostForLocals) return false;
    const Dialect none;
    const LocalsReader then(before, none);
    std::vector<std::string_view> came;
    size_t behind = 0;  // the word before which these came
    const auto is_first_value = [&] {
        if (came.empty()) return true;
        const bool is_nothing = came.size() == 2 && came[0] == "{" && came[1] == "}";
        const bool is_zero =
            came.size() == 2 && came[0] == "=" && is_number_token(came[1]) && number_value(came[1]) == "0";
        came.clear();
        return (is_nothing || is_zero) && behind > 0 && then.is_bare_declarator(behind - 1) &&
               is_one_of(before[behind], {";", ","});
    };
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Remove) return false;
        if (step.kind == DiffStep::Keep) {
            behind = step.before;
            if (!is_first_value()) return false;
        } else {
            came.push_back(now[step.now]);
        }
    }
    return came.empty();
}

}  // namespace porttool
