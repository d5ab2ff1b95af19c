// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/retyping.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "porttool/compare/casts.h"
#include "porttool/language/language.h"
#include "porttool/language/spelling.h"
#include "porttool/normal/statements.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

const std::set<std::string>& number_types() {
    static const std::set<std::string> kTypes = {"int",      "uint", "int8_t", "uint8_t", "short",
                                                 "uint16_t", "long", "ulong",  "int64_t", "uint64_t",
                                                 "size_t",   "char", "float",  "double",  "half"};
    return kTypes;
}

std::string number_type(std::string_view word) {
    std::string plain(one_spelling(word, Language::Cpp));
    return number_types().contains(plain) ? plain : std::string();
}

/// The types of numbers that one text has more often than the other.
struct ExchangedTypes {
    std::set<std::string> went, came;

    ExchangedTypes(const Words& before, const Words& now) {
        std::map<std::string, long> more;
        for (const std::string_view word : before) --more[number_type(word)];
        for (const std::string_view word : now) ++more[number_type(word)];
        for (const auto& [type, times] : more)
            if (times != 0 && !type.empty()) (times < 0 ? went : came).insert(type);
    }
};

/// A text without casts to these types.
Words without_casts(const Words& words, const std::set<std::string>& types) {
    Words out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool is_cast = words[i] == "(" && i + 3 < words.size() && words[i + 2] == ")" &&
                             types.contains(number_type(words[i + 1])) &&
                             (is_word_token(words[i + 3]) || is_number_token(words[i + 3]) || words[i + 3] == "(") &&
                             (out.empty() || !is_word_token(out.back()) || out.back() == "return");
        if (is_cast)
            i += 2;
        else
            out.push_back(words[i]);
    }
    return out;
}

/// The name that a type at `i` is given to, in the common vocabulary.
std::string declared_behind(const Words& words, size_t i) {
    for (++i; i < words.size() && is_one_of(words[i], {"*", "&", "const", "restrict", "__restrict__", "__restrict"});
         ++i)
        ;
    return i < words.size() ? folded(words[i]) : std::string();
}

}  // namespace

std::optional<std::vector<Retyped>> only_retypes(const Words& before, const Words& now) {
    const Words then = with_one_word_types(before), today = with_one_word_types(now);
    const std::set<std::string>& all = number_types();
    const ExchangedTypes types(without_casts(then, all), without_casts(today, all));
    if (types.came.empty()) return std::nullopt;
    const Words old_text = without_casts(then, types.went), new_text = without_casts(today, types.came);
    if (old_text.size() != new_text.size()) return std::nullopt;
    std::vector<Retyped> out;
    for (size_t i = 0; i < old_text.size(); ++i) {
        if (old_text[i] == new_text[i]) continue;
        std::string was = number_type(old_text[i]), is = number_type(new_text[i]);
        if (was.empty() || is.empty()) return std::nullopt;
        out.push_back({declared_behind(new_text, i), std::move(was), std::move(is)});
    }
    std::sort(out.begin(), out.end());
    return out;
}

}  // namespace porttool
