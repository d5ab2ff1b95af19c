// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/whole_vectors.h"

#include <algorithm>
#include <array>

#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

constexpr std::array<std::string_view, 4> kPartLetters = {"x", "y", "z", "w"};
constexpr std::array<std::array<std::string_view, 4>, 4> kMannersOfParts = {
    {{"x", "y", "z", "w"}, {"r", "g", "b", "a"}, {"red", "green", "blue", "alpha"}, {"0", "1", "2", "3"}}};

/// The names of the parts of `whole` in a manner: behind the rest of the name or before it.
std::string name_of_part(std::string_view whole, std::string_view part, bool is_behind) {
    return is_behind ? std::string(whole) + std::string(part) : std::string(part) + std::string(whole);
}

/// How the parts of a type are declared where it is said of the whole: `float`, `int`.
bool is_type_of_parts(std::string_view word) { return is_one_of(word, {"float", "double", "half", "int", "uint"}); }

/// The semicolon that ends the statement at `first`, if it is one without a block; else the end of the text.
size_t end_of_plain_statement(const std::vector<std::string>& text, size_t first) {
    constexpr size_t kLongest = 200;
    int depth = 0;
    for (size_t i = first; i < text.size() && i < first + kLongest; ++i) {
        if (is_one_of(text[i], {"{", "}"})) break;
        depth += is_one_of(text[i], {"(", "["}) ? 1 : is_one_of(text[i], {")", "]"}) ? -1 : 0;
        if (depth == 0 && text[i] == ";") return i;
    }
    return text.size();
}

}  // namespace

WholeVectors::WholeVectors(std::initializer_list<const Words*> own, std::initializer_list<const Words*> others) {
    constexpr size_t kMostWords = 40'000;
    size_t words = 0;
    for (const auto& texts : {own, others})
        for (const Words* text : texts) words += text->size();
    if (words > kMostWords) return;
    Names names, names_there;
    for (const Words* text : own) note(*text, names);
    note_parts(names);
    for (const Words* text : others)
        for (const std::string_view word : *text) names_there.emplace(word);
    for (const Words* text : others) note_members(*text, names, names_there);
}

void WholeVectors::note(const Words& text, Names& names) {
    for (size_t i = 0; i < text.size(); ++i) {
        const bool is_member = i > 0 && is_one_of(text[i - 1], {".", "->", "::"});
        if (is_word_token(text[i]) && !is_member) names.emplace(text[i]);
        if (is_member || i + 1 >= text.size() || !is_word_token(text[i]) || text[i + 1] != "[") continue;
        const bool is_digit = i + 3 < text.size() && text[i + 2].size() == 1 && text[i + 3] == "]" &&
                              text[i + 2] >= "0" && text[i + 2] <= "4";
        const bool is_declared = i > 0 && is_type_word(text[i - 1]);
        const auto known = arrays_.find(text[i]);
        const size_t places = is_digit ? static_cast<size_t>(text[i + 2][0] - '0') : 0;
        if (is_declared && is_digit && places >= 2 && (known == arrays_.end() || known->second == places))
            arrays_[std::string(text[i])] = places;
        else if (!is_digit || known == arrays_.end() || places >= known->second)
            arrays_[std::string(text[i])] = 0;
    }
}

void WholeVectors::note_parts(const Names& names) {
    for (const std::string& name : names)
        for (const auto& manner : kMannersOfParts)
            for (const bool is_behind : {true, false}) {
                const std::string_view first = manner[0];
                const bool is_first =
                    name.size() > first.size() && (is_behind ? name.ends_with(first) : name.starts_with(first));
                if (!is_first) continue;
                std::string whole = is_behind ? name.substr(0, name.size() - first.size()) : name.substr(first.size());
                size_t count = 1;
                while (count < manner.size() && names.contains(name_of_part(whole, manner.at(count), is_behind)))
                    ++count;
                std::string bare = whole;
                while (bare.size() > 1 && bare.back() == '_') bare.pop_back();
                while (bare.size() > 1 && bare.front() == '_') bare.erase(bare.begin());
                if (count < 2 || !is_word_token(bare) || names.contains(bare)) continue;
                for (size_t k = 0; k < count; ++k) {
                    const auto [part, is_new] =
                        parts_.insert({name_of_part(whole, manner.at(k), is_behind), {bare, k, count}});
                    if (!is_new && part->second.whole != bare) part->second.count = 0;  // of two
                    if (!is_new) part->second.count = std::max(part->second.count, count);
                }
            }
    for (const auto& [name, part] : parts_) counts_[part.whole].insert(part.count);
}

/// Where the other side has `q . lo`, `q_lo` and `qlo` are that, if neither side has the other's names.
void WholeVectors::note_members(const Words& other, const Names& names, const Names& names_there) {
    for (size_t i = 0; i + 2 < other.size(); ++i) {
        const bool is_member = is_word_token(other[i]) && is_one_of(other[i + 1], {".", "->"}) &&
                               is_word_token(other[i + 2]) && (i == 0 || !is_one_of(other[i - 1], {".", "->", "::"}));
        if (!is_member || names.contains(other[i])) continue;
        const std::string object(other[i]), member(other[i + 2]);
        for (const std::string& name : {object + "_" + member, object + member})
            if (names.contains(name) && !names_there.contains(name)) members_.try_emplace(name, object, member);
    }
}

/// `cy` and `c [ 1 ]` as `c . y`.
WholeVectors::PartText WholeVectors::with_members(const Words& text) const {
    PartText out;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool is_member = i > 0 && is_one_of(text[i - 1], {".", "->", "::"});
        const auto part = is_member ? parts_.end() : parts_.find(text[i]);
        const auto array = is_member ? arrays_.end() : arrays_.find(text[i]);
        const bool is_declared = i > 0 && is_type_word(text[i - 1]);
        const auto member = is_member ? members_.end() : members_.find(text[i]);
        if (member != members_.end()) {
            out.insert(out.end(), {member->second.first, ".", member->second.second});
        } else if (part != parts_.end() && part->second.count > 0) {
            out.insert(out.end(), {part->second.whole, ".", std::string(kPartLetters.at(part->second.place))});
        } else if (array != arrays_.end() && array->second > 0 && !is_declared && i + 3 < text.size() &&
                   text[i + 1] == "[") {
            const auto place = static_cast<size_t>(text[i + 2][0] - '0');
            out.insert(out.end(), {std::string(text[i]), ".", std::string(kPartLetters.at(place))});
            i += 3;
        } else {
            out.emplace_back(text[i]);
        }
    }
    return out;
}

/// True if the word at `i` is the letter of a part, and of the one at `place`.
bool WholeVectors::says_part(const PartText& text, size_t i, size_t place) const {
    return i > 1 && text[i - 1] == "." && text[i] == kPartLetters.at(place);
}

/// How many statements from `first` on say of one part after the other what the one there, of `count` words, says of
/// the first.
size_t WholeVectors::parts_said(const PartText& text, size_t first, size_t count) const {
    for (size_t i = first; i < first + count; ++i)
        for (size_t place = 1; place < kPartLetters.size(); ++place)
            if (says_part(text, i, place)) return 0;
    size_t said = 1;
    for (; said < kPartLetters.size(); ++said) {
        const size_t begin = first + said * count;
        if (begin + count > text.size()) break;
        bool any = false, same = true;
        for (size_t i = 0; same && i < count; ++i) {
            const bool is_part = says_part(text, first + i, 0);
            any = any || is_part;
            same = is_part ? says_part(text, begin + i, said) : text[begin + i] == text[first + i];
        }
        if (!same || !any) break;
    }
    return said > 1 ? said : 0;
}

std::vector<std::string> WholeVectors::written(const Words& text) const {
    const PartText words = with_members(text);
    PartText out;
    for (size_t i = 0; i < words.size(); ++i) {
        const bool starts = i > 0 && is_one_of(words[i - 1], {";", "{", "}"});
        const size_t end = starts ? end_of_plain_statement(words, i) : words.size();
        const size_t count = end < words.size() ? end + 1 - i : 0;
        const size_t said = count > 3 ? parts_said(words, i, count) : 0;
        std::set<size_t> expected;  // as many parts as what is said of has
        for (size_t k = i; said > 0 && k + 2 < end; ++k) {
            if (words[k + 1] != ".") continue;
            if (const auto known = counts_.find(words[k]); known != counts_.end())
                expected.insert(known->second.begin(), known->second.end());
            if (const auto array = arrays_.find(words[k]); array != arrays_.end()) expected.insert(array->second);
        }
        const bool is_whole = said > 0 && (expected.empty() || (expected.size() == 1 && *expected.begin() == said));
        if (!is_whole) {
            out.push_back(words[i]);
            continue;
        }
        for (size_t k = i; k <= end; ++k) {
            const bool is_part = k + 1 <= end && words[k] == "." && says_part(words, k + 1, 0);
            if (is_part) {
                ++k;
            } else if (k == i && is_type_of_parts(words[k])) {
                const std::string prefix = words[k] == "int" ? "ivec" : words[k] == "uint" ? "uvec" : "vec";
                out.push_back(prefix + std::to_string(said));
            } else {
                out.push_back(words[k]);
            }
        }
        i += said * count - 1;
    }
    return out;
}

}  // namespace porttool
