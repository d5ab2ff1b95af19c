// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/named_values.h"

#include <algorithm>
#include <optional>

#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// True if a name of `names` may be written in words from `first` on.
bool may_write_any(const std::vector<std::string>& words, size_t first, const std::vector<std::string>& names) {
    const auto has = [&](const std::string& word) {
        return is_name(word) && std::find(names.begin(), names.end(), word) != names.end();
    };
    for (size_t i = first; i < words.size(); ++i) {
        if (!has(words[i])) continue;
        const bool is_stepped = i > 0 && is_one_of(words[i - 1], {"++", "--"});
        // The address of it, not `a & b`.
        const bool is_handed = i > 1 && words[i - 1] == "&" && !is_word_token(words[i - 2]) && words[i - 2] != ")";
        const bool is_written =
            i + 1 < words.size() &&
            is_one_of(words[i + 1],
                      {"=", "+=", "-=", "*=", "/=", "%=", "<<=", ">>=", "&=", "|=", "^=", "++", "--", "["});
        if (is_stepped || is_handed || is_written) return true;
    }
    return false;
}

/// Where the `*` of a product of two is; nothing for other words.
std::optional<size_t> middle_of_product(const std::vector<std::string>& words) {
    std::optional<size_t> out;
    int depth = 0;
    for (size_t i = 0; i < words.size(); ++i) {
        depth += is_one_of(words[i], {"(", "["}) ? 1 : is_one_of(words[i], {")", "]"}) ? -1 : 0;
        if (depth > 0 || is_word_token(words[i]) || is_number_token(words[i]) ||
            is_one_of(words[i], {")", "]", ".", "->", "::"}))
            continue;
        if (words[i] != "*" || out || i == 0) return std::nullopt;
        out = i;
    }
    return out;
}

/// `n * sizeof ( float )` for `sizeof ( float ) * n`.
bool is_commuted(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    const auto first = middle_of_product(a), second = middle_of_product(b);
    if (!first || !second || a.size() != b.size() || *first + *second + 1 != a.size()) return false;
    const auto middle = static_cast<std::ptrdiff_t>(*first), other = static_cast<std::ptrdiff_t>(*second);
    return std::equal(a.begin(), a.begin() + middle, b.begin() + other + 1, b.end()) &&
           std::equal(a.begin() + middle + 1, a.end(), b.begin(), b.begin() + other);
}

}  // namespace

NamedValues::NamedValues(const AlignedText& now, const std::vector<bool>& is_new) {
    for (size_t c = 0; c < now.clauses.size(); ++c) {
        const Clause& clause = now.clauses[c];
        if (!is_new[c] || clause.opens || clause.closes || clause.size() < 5 || now.words[clause.end - 1] != ";")
            continue;
        size_t equals = clause.first;
        while (equals < clause.end && is_word_token(now.words[equals])) ++equals;
        if (equals < clause.first + 2 || equals >= clause.end || now.words[equals] != "=") continue;
        const std::vector<std::string> value(now.words.begin() + static_cast<std::ptrdiff_t>(equals) + 1,
                                             now.words.begin() + static_cast<std::ptrdiff_t>(clause.end) - 1);
        // A call may give another value each time.
        bool calls = false;
        for (size_t i = 0; i + 1 < value.size(); ++i)
            calls |= value[i + 1] == "(" && is_name(value[i]) && value[i] != "sizeof";
        if (value.size() < 2 || calls || std::find(value.begin(), value.end(), ",") != value.end()) continue;
        std::vector<std::string> names = value;
        names.push_back(now.words[equals - 1]);
        if (!may_write_any(now.words, clause.end, names)) values_[now.words[equals - 1]] = value;
    }
}

bool NamedValues::only_name(const AlignedText& now, const Clause& is, const AlignedText& before,
                            const Clause& was) const {
    if (values_.empty()) return false;
    size_t at = was.first;
    bool any = false;
    const auto take = [&](const std::string& word) { return at < was.end && before.words[at++] == word; };
    for (size_t i = is.first; i < is.end; ++i) {
        const auto found = values_.find(now.words[i]);
        if (found == values_.end()) {
            if (!take(now.words[i])) return false;
            continue;
        }
        any = true;
        // In brackets, or where what stands beside it takes nothing of it.
        const bool is_enclosed = at < was.end && before.words[at] == "(" && found->second.front() != "(";
        const bool is_whole = i > 0 && i + 1 < now.words.size() && is_one_of(now.words[i - 1], {"(", ",", "=", "["}) &&
                              is_one_of(now.words[i + 1], {")", ",", ";", "]"});
        if (!is_enclosed && !is_whole) return false;
        if (is_enclosed) ++at;
        const auto word_at = before.words.begin() + static_cast<std::ptrdiff_t>(at);
        if (at + found->second.size() <= was.end &&
            is_commuted(found->second, {word_at, word_at + static_cast<std::ptrdiff_t>(found->second.size())}))
            at += found->second.size();
        else
            for (const std::string& word : found->second)
                if (!take(word)) return false;
        if (is_enclosed && !take(")")) return false;
    }
    return any && at == was.end;
}

}  // namespace porttool
