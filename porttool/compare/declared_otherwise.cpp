// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/declared_otherwise.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "porttool/compare/casts.h"
#include "porttool/compare/hints.h"
#include "porttool/language/words.h"
#include "porttool/normal/directive_end.h"
#include "porttool/scan/side.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

/// A type in one spelling: `unsigned int` and `uint32_t` are `uint`.
std::string plain_type(std::string_view type) {
    constexpr std::pair<std::string_view, std::string_view> kSame[] = {
        {"unsigned", "uint"},  {"uint32_t", "uint"},   {"int32_t", "int"},    {"uint8_t", "uchar"},
        {"int16_t", "short"},  {"uint16_t", "ushort"}, {"int64_t", "long"},   {"longlong", "long"},
        {"uint64_t", "ulong"}, {"size_t", "ulong"},    {"ulonglong", "ulong"}};
    for (const auto& [spelling, plain] : kSame)
        if (type == spelling) return std::string(plain);
    return std::string(type);
}

using Types = std::multiset<std::string>;

/// How a text declares what it has: names with a type of the languages before them.
///
///     const float & x        "float &"
class DeclaredTypes {
public:
    explicit DeclaredTypes(const Words& text) : words_(with_one_word_types(text)) {
        const size_t head = static_cast<size_t>(std::find(words_.begin(), words_.end(), "{") - words_.begin());
        size_t place = 0;
        for (size_t i = 0; i < words_.size(); ++i) {
            const std::string_view word = words_[i];
            if (i < head && (word == "," || word == "(")) ++place;
            const bool is_name = is_word_token(word) && !is_type_word(word);
            const bool is_declared = is_name && i + 1 < words_.size() && ends_declared_name(words_[i + 1]);
            if (word != "@" && !is_declared) continue;  // `@ :: operator ( )` is one name
            std::string type = type_before(i);
            if (type.empty()) continue;
            of_[i < head ? "parameter " + std::to_string(place) : std::string(word)].insert(std::move(type));
        }
        places_ = place;
    }

    /// What things of both texts were before and are now, where these differ.
    std::vector<std::pair<Types, Types>> changes_to(const DeclaredTypes& now) const {
        std::vector<std::pair<Types, Types>> out;
        for (const auto& [name, types] : of_) {
            const auto found = now.of_.find(name);
            const bool is_place = name.starts_with("parameter ") && name != "parameter 0";
            if (found == now.of_.end() || (is_place && places_ != now.places_)) continue;
            Types went, came;
            std::set_difference(types.begin(), types.end(), found->second.begin(), found->second.end(),
                                std::inserter(went, went.end()));
            std::set_difference(found->second.begin(), found->second.end(), types.begin(), types.end(),
                                std::inserter(came, came.end()));
            if (!went.empty() && !came.empty()) out.emplace_back(std::move(went), std::move(came));
        }
        std::sort(out.begin(), out.end());
        return out;
    }

private:
    static bool ends_declared_name(std::string_view word) { return is_one_of(word, {"=", ";", ",", ")", "[", "("}); }

    /// The type that stands before the name at `end`, "" if none does.
    std::string type_before(size_t end) const {
        constexpr size_t kLongest = 12;  // words
        std::vector<std::string> said;
        bool is_type = false;
        for (size_t i = end; i-- > 0 && end - i <= kLongest;) {
            const std::string_view word = words_[i];
            const bool is_part = is_word_token(word) || word == "*" || word == "&" || word == "::";
            if (!is_part || is_one_of(word, {"return", "case", "else", "goto", "new", "sizeof"})) break;
            if (is_type_word(word)) is_type = true;
            if (is_type_word(word) || word == "*" || word == "&") said.push_back(plain_type(word));
        }
        if (!is_type) return {};
        std::string out;
        for (auto word = said.rbegin(); word != said.rend(); ++word) out += (out.empty() ? "" : " ") + *word;
        return out;
    }

    Words words_;
    std::map<std::string, Types> of_;
    size_t places_ = 0;
};

/// How many more of each pragma there are.
std::map<std::string, int> pragmas_gained(const Words& before, const Words& now) {
    std::map<std::string, int> out;
    const auto count = [&](const Words& text, int times) {
        std::string line;
        const auto end_line = [&] {
            if (!line.empty()) out[line] += times;
            line.clear();
        };
        for (const std::string& word : pragmas_of(without_hints(text))) {
            if (word == "#") end_line();
            line += word + ' ';
        }
        end_line();
    };
    count(before, -1);
    count(now, 1);
    std::erase_if(out, [](const auto& each) { return each.second == 0; });
    return out;
}

}  // namespace

std::vector<std::string> pragmas_of(const Words& text) {
    constexpr size_t kReach = 24;
    std::vector<std::string> out;
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] != "#" || text[i + 1] != "pragma") continue;
        const size_t found = directive_end(text, i), end = found > i ? found : std::min(text.size(), i + kReach);
        for (size_t k = i; k < end; ++k) out.emplace_back(text[k]);
    }
    return out;
}

bool is_declared_otherwise(const PairTexts& texts) {
    const DeclaredTypes source(texts.source_before), target(texts.target_before);
    if (source.changes_to(DeclaredTypes(texts.source_now)) != target.changes_to(DeclaredTypes(texts.target_now)))
        return true;
    return pragmas_gained(texts.source_before, texts.source_now) !=
           pragmas_gained(texts.target_before, texts.target_now);
}

}  // namespace porttool
