// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/unused_names.h"

#include <algorithm>
#include <string_view>
#include <unordered_map>

namespace porttool {
namespace {

class UnusedNames {
public:
    explicit UnusedNames(const Words& text) : text_(text) {
        for (const std::string_view word : text) ++times_[word];
    }

    /// The text without them.
    Words run() {
        Words out;
        const size_t body = static_cast<size_t>(std::find(text_.begin(), text_.end(), "{") - text_.begin());
        for (size_t i = 0; i < text_.size();) {
            const size_t end = i < body ? end_of_parameter(i) : end_of_local(i);
            if (end == i) {
                out.push_back(text_[i++]);
                continue;
            }
            const bool leads_list = i < body && end < text_.size() && text_[end] == ",";
            i = leads_list && out.back() == "(" ? end + 1 : end;
        }
        return out;
    }

private:
    std::string_view word(size_t i) const { return i < text_.size() ? text_[i] : std::string_view(); }
    bool is_unused(size_t i) const { return is_word_token(word(i)) && times_.at(text_[i]) == 1; }

    /// Behind the parameter that begins at `i`, with the comma before it, if nothing uses it; else `i`.
    size_t end_of_parameter(size_t i) const {
        const bool follows = word(i) == ",";
        const size_t first = follows ? i + 1 : i;
        if (!follows && (i == 0 || word(i - 1) != "(")) return i;
        int depth = 0;
        for (size_t k = first; k < text_.size(); ++k) {
            const std::string_view each = text_[k];
            if (each == "{" || each == "=") return i;
            depth += each == "(" || each == "<" ? 1 : (each == ")" || each == ">") && depth > 0 ? -1 : 0;
            if (depth == 0 && (each == "," || each == ")") && each != word(first)) {
                const bool typed = k > first + 1;
                return typed && is_unused(k - 1) ? k : i;
            }
        }
        return i;
    }

    /// Behind `T name = ... ;` or `T name ;` at `i`, if nothing uses the name; else `i`.
    size_t end_of_local(size_t i) const {
        const std::string_view before = i > 0 ? word(i - 1) : std::string_view();
        if (before != ";" && before != "{" && before != "}") return i;
        size_t name = i;
        while (is_word_token(word(name)) || word(name) == "::" || word(name) == "*" || word(name) == "&" ||
               word(name) == "<" || word(name) == ">")
            ++name;
        if (name < i + 2 || !is_unused(name - 1) || (word(name) != "=" && word(name) != ";")) return i;
        if (word(i) == "return" || word(i) == "goto" || word(i) == "using" || word(i) == "delete") return i;
        int depth = 0;
        for (size_t k = name; k < text_.size(); ++k) {
            const std::string_view each = text_[k];
            if (each == "{" || each == "}" || each == "#") return i;
            depth += each == "(" ? 1 : each == ")" ? -1 : 0;
            if (depth == 0 && each == ",") return i;
            if (depth == 0 && each == ";") return k + 1;
        }
        return i;
    }

    const Words& text_;
    std::unordered_map<std::string_view, size_t> times_;
};

}  // namespace

bool only_changes_unused_names(const Words& before, const Words& now) {
    return before != now && UnusedNames(before).run() == UnusedNames(now).run();
}

}  // namespace porttool
