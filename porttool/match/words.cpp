// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/match/words.h"

#include <array>

namespace porttool {
namespace {

bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_alphanumeric(char c) { return is_upper(c) || is_lower(c) || is_digit(c); }
char lower(char c) { return is_upper(c) ? static_cast<char>(c + 32) : c; }

/// The sign of `V::operator+`; of other names nothing. What an operator is named after is its sign.
std::string_view operator_sign(std::string_view name) {
    constexpr std::string_view kOperator = "operator";
    const size_t found = name.rfind(kOperator);
    if (found == std::string_view::npos) return {};
    const std::string_view sign = name.substr(found + kOperator.size());
    return sign.empty() || is_alphanumeric(sign[0]) || sign[0] == '_' ? std::string_view() : sign;
}

/// Cuts common endings, keeping at least four letters.
void stem(std::string& word) {
    constexpr std::array<std::string_view, 9> kEndings = {"izing", "ized", "ize", "ing", "tion", "ed", "es", "s", "e"};
    constexpr size_t kShortest = 4;
    for (const auto ending : kEndings) {
        if (word.size() < ending.size() + kShortest || !word.ends_with(ending)) continue;
        word.resize(word.size() - ending.size());
        return;
    }
}

}  // namespace

std::vector<std::string> split_words(std::string_view name) {
    std::vector<std::string> words;
    std::string word;
    auto finish = [&] {
        if (!word.empty()) {
            stem(word);
            words.push_back(word);
        }
        word.clear();
    };
    for (size_t i = 0; i < name.size(); ++i) {
        const char c = name[i];
        if (!is_alphanumeric(c)) {
            finish();
            continue;
        }
        const char before = i > 0 ? name[i - 1] : '\0';
        const char after = i + 1 < name.size() ? name[i + 1] : '\0';
        // camelCase, and the last capital of BSDFValue
        if (is_upper(c) && (is_lower(before) || is_digit(before) || (is_upper(before) && is_lower(after)))) finish();
        word += lower(c);
    }
    finish();
    if (const auto sign = operator_sign(name); !sign.empty()) words.emplace_back(sign);
    return words;
}

std::string fold(std::string_view name) {
    if (name.size() > 2 && name[0] == 'k' && is_upper(name[1])) name.remove_prefix(1);
    std::string folded;
    for (const char c : name)
        if (is_alphanumeric(c)) folded += lower(c);
    folded += operator_sign(name);
    return folded;
}

std::string_view file_stem(std::string_view path) {
    std::string_view file = path.substr(path.find_last_of('/') + 1);
    while (file.starts_with('.')) file.remove_prefix(1);
    return file.substr(0, file.find('.'));
}

std::string_view folder_of(std::string_view path) {
    const size_t slash = path.find_last_of('/');
    return slash == std::string_view::npos ? std::string_view() : path.substr(0, slash);
}

}  // namespace porttool
