// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Any parenthesis with a name before it may be the list of parameters. The one is taken after which only trailers stand
// up to the body:
//
//   __launch_bounds__ (256)   float3  Glass :: sample (const Ray& ray)   const noexcept (true)   {
//   takes arguments of its own        the name         the parameters    trailers
//
// What makes it hard are macros. `LAUNCH(256) shade(int a) {` begins with a list that could be the one, and so it is
// left for the next; `KERNEL(shade)(int a) {`, `KERNEL(shade, int a) {` and `STRUCT(Ray) {` hide the name in theirs.
#include "porttool/scan/function_head.h"

#include <optional>

#include "porttool/language/words.h"

namespace porttool {
namespace {

/// What cannot be a function's name before its parenthesis.
bool is_no_name(std::string_view word) { return word_is(word, kNoFunctionName | kTakesArguments); }

class FunctionReader {
public:
    explicit FunctionReader(const HeadItems& items) : items_(items) {}

    void read(Head& head) {
        std::vector<Candidate> candidates;
        bool assigned = false;
        for (size_t i = 0; i < items_.size(); ++i) {
            if (items_.word(i) == "operator") {
                if (const auto candidate = operator_at(i)) candidates.push_back(*candidate);
                break;
            }
            assigned = assigned || items_.word(i) == "=";
            if (items_.is_paren(i))
                if (const auto name = name_before(i)) candidates.push_back({i, *name});
        }
        if (!candidates.empty())
            accept(choose(candidates), head);
        else if (!assigned)
            read_nested_declarator(head);
    }

private:
    struct Candidate {
        size_t group;  ///< item of the parameter list
        size_t name;   ///< item where the name starts
    };

    std::optional<Candidate> operator_at(size_t keyword) const {
        size_t group = keyword + 1;
        const bool calls =
            group < items_.size() && items_.is_paren(group) && items_.close(group) == items_.position(group) + 1;
        if (calls) ++group;
        while (group < items_.size() && !items_.is_paren(group)) ++group;
        if (group >= items_.size()) return std::nullopt;
        return Candidate{group, name_start(keyword)};
    }

    /// The item where the name before the parenthesis `group` starts, if it can be a function's name.
    std::optional<size_t> name_before(size_t group) const {
        if (group == 0) return std::nullopt;
        size_t last = group - 1;
        if (items_.is_paren(last)) {  // NAME(foo)(int a)
            if (last == 0 || !items_.is_name(last - 1) || is_no_name(items_.word(last - 1))) return std::nullopt;
            return last - 1;
        }
        if (items_.word(last) == ">") {  // f<int>(int a)
            const size_t open = items_.open_angle(last);
            if (open == 0 || open == items_.size()) return std::nullopt;
            last = open - 1;
        }
        if (!items_.is_name(last) || is_no_name(items_.word(last))) return std::nullopt;
        return name_start(last);
    }

    /// Walks back over `~` and `A<T>::B::`.
    size_t name_start(size_t last) const {
        size_t at = last;
        if (at > 0 && items_.word(at - 1) == "~") --at;
        while (at >= 2 && items_.word(at - 1) == "::") {
            size_t before = at - 2;
            if (items_.word(before) == ">") {
                const size_t open = items_.open_angle(before);
                if (open == 0 || open == items_.size()) break;
                before = open - 1;
            }
            if (!items_.is_name(before)) break;
            at = before;
        }
        return at;
    }

    const Candidate& choose(const std::vector<Candidate>& candidates) const {
        const Candidate* first_fit = nullptr;
        for (const Candidate& candidate : candidates) {
            if (!ends_head(candidate.group + 1)) continue;
            // MACRO(256) f(int a): what starts the head without a type is a macro if another list follows
            const bool bare =
                candidate.name == 0 && is_macro_like(items_.word(0)) && items_.is_name(candidate.group + 1);
            if (first_fit == nullptr || !bare) first_fit = &candidate;
            if (!bare) break;
        }
        return first_fit != nullptr ? *first_fit : candidates.back();
    }

    /// True if only what may follow a parameter list stands from `item` to the body.
    bool ends_head(size_t item) const {
        for (size_t i = item; i < items_.size(); ++i) {
            const std::string_view text = items_.word(i);
            if (text == "->" || text == ":" || text == "requires") return true;
            if (items_.is_paren(i)) {
                const std::string_view before = items_.word(i - 1);
                if (i == item || !(word_is(before, kTakesArguments) || is_macro_like(before))) return false;
                continue;
            }
            if (!is_trailer(text) && !word_is(text, kTakesArguments) && !is_macro_like(text)) return false;
        }
        return true;
    }

    void accept(const Candidate& chosen, Head& head) const {
        head.kind = HeadKind::Function;
        head.parameters = items_.position(chosen.group);
        head.name_at = items_.position(chosen.name);
        head.first = items_.signature_start(chosen.name);
        const std::string_view macro = items_.word(chosen.name);
        const MacroTable& macros = items_.context().macros;
        MadeHead made;
        if (items_.is_paren(chosen.group - 1) && !has_operator(chosen)) {
            made = head_made_by(macros, macro, items_.arguments(chosen.group - 1), false);
        } else if (chosen.name == 0 && chosen.group == 1 && !items_.context().in_class &&
                   (macros.contains(macro) || is_macro_like(macro))) {
            made = head_made_by(macros, macro, items_.arguments(1), true);
            if (opens_type(macros, macro)) head.kind = HeadKind::Struct;
        } else {
            made.name = plain_name(chosen);
        }
        head.name = made.name;
        head.kernel = made.kernel;
    }

    bool has_operator(const Candidate& chosen) const {
        for (size_t i = chosen.name; i < chosen.group; ++i)
            if (items_.word(i) == "operator") return true;
        return false;
    }

    /// The items of the name, without template arguments; words are kept apart by a blank.
    std::string plain_name(const Candidate& chosen) const {
        std::string name;
        bool in_operator = false;
        for (size_t i = chosen.name; i < chosen.group;) {
            const std::string_view text = items_.word(i);
            if (!in_operator && text == "<") {
                i = items_.after_angles(i);
                continue;
            }
            const bool after_word = !name.empty() && ((name.back() >= 'a' && name.back() <= 'z') || name.back() == '_');
            if (after_word && items_.is_name(i)) name += ' ';
            name += text;
            if (items_.is_group(i)) name += text == "(" ? ")" : "]";
            in_operator = in_operator || text == "operator";
            ++i;
        }
        return name;
    }

    /// `int (*f(int a))(float) {`: the name is inside the first parenthesis.
    void read_nested_declarator(Head& head) const {
        for (size_t i = 1; i < items_.size(); ++i) {
            const uint32_t first = items_.position(i) + 1;
            if (!items_.is_paren(i) || (items_.word_at(first) != "*" && items_.word_at(first) != "&")) continue;
            for (uint32_t at = first + 1; at + 1 < items_.close(i); ++at) {
                if (!items_.is_name_at(at) || items_.word_at(at + 1) != "(") continue;
                head.kind = HeadKind::Function;
                head.name = items_.word_at(at);
                head.name_at = at;
                head.parameters = at + 1;
                head.first = items_.signature_start(i);
                return;
            }
        }
    }

    const HeadItems& items_;
};

}  // namespace

void read_function_head(const HeadItems& items, Head& head) { FunctionReader(items).read(head); }

}  // namespace porttool
