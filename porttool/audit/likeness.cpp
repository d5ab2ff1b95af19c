// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/likeness.h"

#include <algorithm>
#include <string_view>

namespace porttool {
namespace {

constexpr size_t kMostWordsOfStatement = 256;

float weight_of(std::string_view word) {
    constexpr std::string_view kSlight = "()[]{},;.:=#@";
    constexpr float kLittle = 0.2f;
    const bool slight = word.size() == 1 && kSlight.find(word[0]) != std::string_view::npos;
    return slight || word == "->" || word == "::" || word == "return" ? kLittle : 1.0f;
}

}  // namespace

WeighedWords Weigher::weighed(const std::vector<std::string>& words) {
    WeighedWords out;
    for (size_t i = 0; i < words.size() && i < kMostWordsOfStatement; ++i) {
        out.words.push_back(static_cast<uint32_t>(numbers_.number(words[i])));
        out.weights.push_back(weight_of(words[i]));
        out.sum += out.weights.back();
    }
    return out;
}

float common_weight(const WeighedWords& a, const WeighedWords& b) {
    std::vector<float> row(b.words.size() + 1, 0.0f);
    for (size_t i = 0; i < a.words.size(); ++i) {
        float diagonal = 0;
        for (size_t k = 0; k < b.words.size(); ++k) {
            const float above = row[k + 1];
            row[k + 1] = a.words[i] == b.words[k] ? diagonal + a.weights[i] : std::max(above, row[k]);
            diagonal = above;
        }
    }
    return row.back();
}

float likeness_by_endings(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    constexpr size_t kTelling = 4;  // letters of an ending
    const auto is_same = [](const std::string& one, const std::string& two) {
        return one == two || (one.size() >= kTelling && two.ends_with(one)) ||
               (two.size() >= kTelling && one.ends_with(two));
    };
    std::vector<const std::string*> left, right;
    for (const std::string& word : a)
        if (weight_of(word) >= 1) left.push_back(&word);
    for (const std::string& word : b)
        if (weight_of(word) >= 1) right.push_back(&word);
    std::vector<size_t> row(right.size() + 1, 0);
    for (const std::string* one : left) {
        size_t diagonal = 0;
        for (size_t k = 0; k < right.size(); ++k) {
            const size_t above = row[k + 1];
            row[k + 1] = is_same(*one, *right[k]) ? diagonal + 1 : std::max(above, row[k]);
            diagonal = above;
        }
    }
    const size_t all = left.size() + right.size();
    return all == 0 ? 0 : 2 * static_cast<float>(row.back()) / static_cast<float>(all);
}

}  // namespace porttool
