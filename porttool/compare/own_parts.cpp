// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/own_parts.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>

#include "porttool/text/letters.h"

namespace porttool {
namespace {

bool is_letter(char c) { return is_small_letter(c) || is_capital_letter(c); }

/// True if name[first, end) begins and ends where words of a name do: `Cuda` of `runCudaVariant`, and not `hip` of
/// `relationship`.
bool is_part(std::string_view name, size_t first, size_t end) {
    const bool begins = first == 0 || !is_letter(name[first - 1]) ||
                        (is_capital_letter(name[first]) && is_small_letter(name[first - 1]));
    const bool ends =
        end == name.size() || !is_letter(name[end]) || (is_capital_letter(name[end]) && is_small_letter(name[end - 1]));
    // `CUDAStream`: capitals up to the next word.
    const bool before_word = end + 1 < name.size() && is_capital_letter(name[end]) && is_small_letter(name[end + 1]);
    return begins && (ends || before_word);
}

std::vector<std::string> pieces_of(const std::string& name) {
    std::vector<std::string> out(1);
    for (const char c : name)
        if (c == '/' || c == ':' || c == '.')
            out.emplace_back();
        else
            out.back() += c;
    std::erase(out, std::string());
    return out;
}

/// What two names have between the same beginning and the same end.
void add_difference(const std::string& source, const std::string& target, OwnParts& out) {
    const size_t least = std::min(source.size(), target.size());
    size_t same = 0, tail = 0;
    while (same < least && source[same] == target[same]) ++same;
    while (tail < least - same && source[source.size() - 1 - tail] == target[target.size() - 1 - tail]) ++tail;
    const size_t end = source.size() - tail, end_there = target.size() - tail;
    constexpr size_t kShortest = 2;
    if (end < same + kShortest || end_there < same + kShortest) return;
    if (!is_part(source, same, end) || !is_part(target, same, end_there)) return;
    const std::string here = in_small_letters(std::string_view(source).substr(same, end - same));
    const std::string there = in_small_letters(std::string_view(target).substr(same, end_there - same));
    const auto is_word = [](const std::string& part) { return std::all_of(part.begin(), part.end(), is_letter); };
    if (is_word(here) && is_word(there)) out.emplace_back(here, there);
}

/// The name with another part in the place of its own.
std::vector<std::string> with_part_there(const std::string& name, const OwnParts& parts) {
    std::vector<std::string> out;
    for (const auto& [here, there] : parts)
        for (size_t manner = 0; manner < 3; ++manner) {
            const std::string part = spellings(here)[manner];
            const size_t first = name.find(part);
            if (first == std::string::npos || !is_part(name, first, first + part.size())) continue;
            out.push_back(name.substr(0, first) + spellings(there)[manner] + name.substr(first + part.size()));
        }
    return out;
}

}  // namespace

std::array<std::string, 3> spellings(const std::string& part) {
    const std::string small = in_small_letters(part);
    std::string first = small, capitals = small;
    if (!first.empty()) first[0] = capital_letter(first[0]);
    std::transform(capitals.begin(), capitals.end(), capitals.begin(), capital_letter);
    return {small, first, capitals};
}

OwnParts own_parts(const BySide<std::vector<std::string>>& names) {
    OwnParts out = {{"cuda", "hip"}, {"hip", "cuda"}};
    for (size_t i = 0; i < std::min(names.source.size(), names.target.size()); ++i) {
        const std::vector<std::string> here = pieces_of(names.source[i]), there = pieces_of(names.target[i]);
        for (size_t k = 0; k < std::min(here.size(), there.size()); ++k)
            add_difference(here[here.size() - 1 - k], there[there.size() - 1 - k], out);
    }
    return out;
}

void join_own_parts(AlignedText& source, AlignedText& target, const OwnParts& parts) {
    std::map<std::string, uint32_t> here, there;
    for (size_t i = 0; i < source.words.size(); ++i) here.emplace(source.words[i], source.common[i]);
    for (size_t i = 0; i < target.words.size(); ++i) there.emplace(target.words[i], target.common[i]);
    std::map<std::string, uint32_t> joined;
    for (const auto& [word, number] : here) {
        if (!is_word_token(word) || there.contains(word)) continue;
        for (const std::string& name : with_part_there(word, parts))
            if (there.contains(name) && !here.contains(name)) joined.emplace(name, number);
    }
    for (size_t i = 0; i < target.words.size(); ++i)
        if (const auto name = joined.find(target.words[i]); name != joined.end()) target.common[i] = name->second;
}

Words with_parts_there(Words words, const Words& there, const OwnParts& parts) {
    const std::set<std::string_view> here(words.begin(), words.end()), other(there.begin(), there.end());
    for (std::string_view& word : words) {
        if (!is_word_token(word) || other.contains(word)) continue;
        for (const std::string& name : with_part_there(std::string(word), parts)) {
            const auto found = other.find(name);
            if (found == other.end() || here.contains(name)) continue;
            word = *found;
            break;
        }
    }
    return words;
}

}  // namespace porttool
