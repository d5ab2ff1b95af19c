// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/plain_updates.h"

#include <algorithm>
#include <utility>

#include "porttool/compare/brackets.h"
#include "porttool/compare/casts.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

using UpdateText = std::vector<std::string>;

std::ptrdiff_t distance_to(size_t i) { return static_cast<std::ptrdiff_t>(i); }

void write_step_first(UpdateText& words, size_t first, size_t end) {
    if (end <= first + 1 || (words[end - 1] != "++" && words[end - 1] != "--")) return;
    for (size_t i = first; i + 1 < end; ++i)
        if (!is_word_token(words[i]) && !is_number_token(words[i]) && words[i] != "." && words[i] != "[" &&
            words[i] != "]")
            return;
    std::rotate(words.begin() + distance_to(first), words.begin() + distance_to(end) - 1,
                words.begin() + distance_to(end));
}

/// How tightly a sign binds, from 1; 0 for another word.
int tightness(std::string_view sign) {
    if (is_one_of(sign, {"*", "/", "%"})) return 5;
    if (is_one_of(sign, {"+", "-"})) return 4;
    if (is_one_of(sign, {"<", ">", "<=", ">=", "==", "!="})) return 3;
    if (is_one_of(sign, {"&", "^", "|"})) return 2;
    return is_one_of(sign, {"&&", "||", "?", ":", ","}) ? 1 : 0;
}

/// True if all that is joined in [first, end) is joined more tightly than `sign` joins.
bool is_taken_before(const UpdateText& words, size_t first, size_t end, std::string_view sign) {
    int depth = 0;
    for (size_t i = first; i < end; ++i) {
        depth += deeper(words[i]);
        if (depth < 0) return false;
        const bool is_binary = i > first && (is_word_token(words[i - 1]) || is_number_token(words[i - 1]) ||
                                             words[i - 1] == ")" || words[i - 1] == "]");
        if (depth > 0 || !is_binary) continue;
        const bool joins = tightness(words[i]) > 0;
        if (joins && (tightness(sign) < 4 || tightness(words[i]) <= tightness(sign))) return false;
        if (words[i].ends_with('=')) return false;
    }
    return depth == 0 && first < end;
}

bool is_whole_type(std::string_view word) {
    return is_one_of(word, {"int", "uint", "int32_t", "uint32_t", "size_t", "long", "ulong", "int64_t", "uint64_t"});
}

}  // namespace

void write_steps_first(UpdateText& words) {
    if (words.empty()) return;
    if (words[0] != "for") return write_step_first(words, 0, words.size());
    if (words.back() != ")") return;
    size_t last = words.size() - 1;
    int depth = 0;
    while (last > 0 && (depth > 0 || words[last - 1] != ";")) {
        --last;
        if (words[last] == ")" || words[last] == "]") ++depth;
        if (words[last] == "(" || words[last] == "[") --depth;
        if (depth == 0 && words[last] == ",") return;
    }
    write_step_first(words, last, words.size() - 1);
}

void write_plain_update(UpdateText& words) {
    const auto sign = static_cast<size_t>(std::find(words.begin(), words.end(), "=") - words.begin());
    if (sign == 0 || 2 * sign + 2 >= words.size() || !is_word_token(words[0])) return;
    for (size_t i = 0; i < sign; ++i) {
        const bool is_place = is_word_token(words[i]) || is_number_token(words[i]) ||
                              is_one_of(words[i], {".", "->", "[", "]", "+", "-", "*"});
        const bool is_declared = i > 0 && is_word_token(words[i]) && is_word_token(words[i - 1]);
        if (!is_place || is_declared || words[i] != words[sign + 1 + i]) return;
    }
    if (sign > 1 && words[1] == "*") return;  // `T * x = x`
    const size_t joins = 2 * sign + 1;
    if (!is_one_of(words[joins], {"+", "-", "*", "/", "%", "&", "|", "^"})) return;
    if (!is_taken_before(words, joins + 1, words.size(), words[joins])) return;
    const bool is_bracketed = words[joins + 1] == "(" && call_arguments(words, joins + 1).end == words.size();
    UpdateText out(words.begin(), words.begin() + distance_to(sign));
    out.push_back(words[joins] + "=");
    out.insert(out.end(), words.begin() + distance_to(joins) + (is_bracketed ? 2 : 1),
               words.end() - (is_bracketed ? 1 : 0));
    words = std::move(out);
}

UpdateText with_plain_limits(const UpdateText& words, const std::string& zero, const std::string& one) {
    constexpr size_t kMost = 16;  // calls within each other: each is written anew
    UpdateText out = words;
    size_t written = 0;
    for (size_t i = 0; i + 1 < out.size() && written < kMost; ++i) {
        const bool is_call = out[i + 1] == "(" && (i == 0 || (out[i - 1] != "." && out[i - 1] != "->"));
        if (!is_call || (out[i] != "clamp" && out[i] != "saturate")) continue;
        const auto [arguments, end] = call_arguments(out, i + 1);
        if (arguments.size() != (out[i] == "clamp" ? 3 : 1)) continue;
        const auto said = [&](size_t k) {
            return UpdateText(out.begin() + distance_to(arguments[k].first),
                              out.begin() + distance_to(arguments[k].second));
        };
        UpdateText limited = {"min", "(", "max", "("};
        const UpdateText least = arguments.size() == 3 ? said(1) : UpdateText{zero},
                         most = arguments.size() == 3 ? said(2) : UpdateText{one}, value = said(0);
        limited.insert(limited.end(), value.begin(), value.end());
        limited.emplace_back(",");
        limited.insert(limited.end(), least.begin(), least.end());
        limited.insert(limited.end(), {")", ","});
        limited.insert(limited.end(), most.begin(), most.end());
        limited.emplace_back(")");
        UpdateText next(out.begin(), out.begin() + distance_to(i));
        next.insert(next.end(), limited.begin(), limited.end());
        next.insert(next.end(), out.begin() + distance_to(end), out.end());
        out = std::move(next);
        ++written;
    }
    return out;
}

void PlainCounters::note(const Words& written) {
    constexpr size_t kLongestHead = 100;
    const Words text = with_one_word_types(written);
    const auto word = [&](size_t i) { return i < text.size() ? text[i] : std::string_view(); };
    std::vector<bool> in_own_head(text.size());
    for (size_t i = 0; i + 8 < text.size(); ++i) {
        if (text[i] != "for" || text[i + 1] != "(" || !is_whole_type(text[i + 2]) || !is_word_token(text[i + 3]))
            continue;
        const std::string_view name = text[i + 3];
        const bool starts = text[i + 4] == "=" && is_number_token(text[i + 5]) && text[i + 6] == ";";
        const bool is_bound = starts && text[i + 7] == name && is_one_of(text[i + 8], {"<", "<=", "!="});
        size_t end = i + 9;
        int depth = 0;
        bool is_plain = is_bound;
        for (; end < std::min(text.size(), i + kLongestHead) && (depth > 0 || text[end] != ";"); ++end) {
            depth += deeper(text[end]);
            is_plain = is_plain && depth >= 0 && text[end] != "-" && text[end] != name;
        }
        const bool steps = (word(end + 1) == "++" && word(end + 2) == name && word(end + 3) == ")") ||
                           (word(end + 1) == name && word(end + 2) == "++" && word(end + 3) == ")");
        if (!is_plain || !steps) {
            others_.emplace(name);
            continue;
        }
        counters_.emplace(name);
        std::fill(in_own_head.begin() + distance_to(i), in_own_head.begin() + distance_to(end) + 3, true);
    }
    // What is done with it elsewhere: it picks an element, or is handed on by itself.
    std::vector<std::string_view> open;
    for (size_t i = 0; i < text.size(); ++i) {
        if (is_one_of(text[i], {"(", "["})) open.push_back(text[i]);
        if (is_one_of(text[i], {")", "]"}) && !open.empty()) open.pop_back();
        if (in_own_head[i] || !counters_.contains(text[i])) continue;
        const std::string_view before = i > 0 ? text[i - 1] : std::string_view(), after = word(i + 1);
        const bool is_member = before == "." || before == "->";
        const bool is_alone = is_one_of(before, {"(", ",", "["}) && is_one_of(after, {")", ",", "]"});
        const bool in_index = !open.empty() && open.back() == "[" && is_one_of(before, {"[", "+", "*"}) &&
                              is_one_of(after, {"]", "+", "*"});
        if (!is_member && !is_alone && !in_index) others_.emplace(text[i]);
    }
}

void PlainCounters::write_plain(UpdateText& head) const {
    if (head.size() < 6 || head[0] != "for" || head[1] != "(" || !is_whole_type(head[2])) return;
    if (counters_.contains(head[3]) && !others_.contains(head[3])) head[2] = "int";
}

}  // namespace porttool
