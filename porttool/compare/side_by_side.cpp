// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/side_by_side.h"

#include <algorithm>

#include "porttool/language/words.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// A name without the last or the first of its words: what two sides may spell in two manners.
std::vector<std::pair<std::string, std::string>> manners(const std::string& a, const std::string& b) {
    std::vector<std::pair<std::string, std::string>> out;
    const size_t most = std::min(a.size(), b.size());
    size_t front = 0, back = 0;
    while (front < most && a[front] == b[front]) ++front;
    while (back < most && a[a.size() - 1 - back] == b[b.size() - 1 - back]) ++back;
    while (front > 0 && a[front - 1] != '_') --front;
    while (back > 0 && a[a.size() - back] != '_') --back;
    if (front > 1) out.emplace_back(a.substr(front), b.substr(front));
    if (back > 1) out.emplace_back(a.substr(0, a.size() - back) + "*", b.substr(0, b.size() - back) + "*");
    return out;
}

}  // namespace

bool is_operator(const Text& words, size_t i, size_t end_of_head) {
    const std::string_view word = words[i];
    const bool binary = i > 0 && (is_name_or_number(words[i - 1]) || words[i - 1] == ")" || words[i - 1] == "]");
    if (word == "*" || word == "&") return i > end_of_head && binary && i > 1 && !is_type_word(words[i - 1]);
    constexpr std::string_view kSigns = "+-/%<>=!|^~?";
    return word != "->" && (word == "&&" || kSigns.find(word[0]) != std::string_view::npos);
}

size_t end_of_head(const Text& words) {
    return static_cast<size_t>(std::find(words.begin(), words.end(), "{") - words.begin());
}

SideBySide::SideBySide(const Text& here, const Text& there, const AlignedText& a, const AlignedText& b)
    : here_(here),
      there_(there),
      a_(a),
      b_(b),
      laid_(align(a, b, {})),
      alike_(here.size()),
      in_like_clause_(here.size()),
      head_(end_of_head(here)),
      other_head_(end_of_head(there)) {
    learn();
    for (size_t i = 0; i < here.size(); ++i) alike_[i] = is_alike(i);
    constexpr double kMostlySame = 0.6;
    for (size_t c = 0; c < a.clauses.size(); ++c)
        if (laid_.clause_of[c] != Alignment::kNone && laid_.likeness[c] >= kMostlySame)
            std::fill(in_like_clause_.begin() + static_cast<std::ptrdiff_t>(a.clauses[c].first),
                      in_like_clause_.begin() + static_cast<std::ptrdiff_t>(a.clauses[c].end), true);
}

size_t SideBySide::unlike() const {
    size_t out = 0;
    for (size_t i = 0; i < here_.size(); ++i)
        out += !alike_[i] && (is_name_or_number(here_[i]) || is_operator(here_, i, head_)) ? 1 : 0;
    const std::set<size_t> has_like = covered();
    for (size_t k = 0; k < there_.size(); ++k)
        out += !has_like.contains(k) && (is_name_or_number(there_[k]) || is_operator(there_, k, other_head_)) ? 1 : 0;
    return out;
}

std::map<std::string_view, size_t> SideBySide::alone() const {
    std::map<std::string_view, size_t> out;
    for (size_t i = 0; i < here_.size(); ++i)
        if (!alike_[i] && (is_number_token(here_[i]) || is_operator(here_, i, head_))) ++out[here_[i]];
    return out;
}

std::map<std::string_view, size_t> SideBySide::alone_there() const {
    std::map<std::string_view, size_t> out;
    const std::set<size_t> has_like = covered();
    for (size_t k = 0; k < there_.size(); ++k)
        if (!has_like.contains(k) && (is_number_token(there_[k]) || is_operator(there_, k, other_head_)))
            ++out[there_[k]];
    return out;
}

BySide<std::vector<size_t>> SideBySide::misplaced() const {
    std::set<std::string_view> known_here(there_.begin(), there_.end()), known_there(here_.begin(), here_.end());
    for (size_t i = 0; i < here_.size(); ++i) {
        if (!alike_[i]) continue;
        known_here.insert(here_[i]);
        known_there.insert(there_[laid_.word_of[i]]);
    }
    const auto is_known = [](const Text& text, size_t i, size_t end_of_head, const auto& known) {
        const std::string_view word = text[i];
        if (!is_word_token(word)) return is_number_token(word) || is_operator(text, i, end_of_head);
        return !is_type_word(word) && known.contains(word);
    };
    std::vector<bool> wrong_here(here_.size()), wrong_there(there_.size());
    const std::set<size_t> has_like = covered();
    for (size_t k = 0; k < there_.size(); ++k)
        wrong_there[k] = !has_like.contains(k) && is_known(there_, k, other_head_, known_there);
    for (size_t i = 0; i < here_.size(); ++i) {
        wrong_here[i] = !alike_[i] && is_known(here_, i, head_, known_here);
        const size_t k = laid_.word_of[i];
        if (alike_[i] || k == Alignment::kNone || !is_word_token(here_[i]) || !is_word_token(there_[k])) continue;
        wrong_here[i] = wrong_there[k] = wrong_here[i] || wrong_there[k];  // one of the two is
    }
    BySide<std::vector<size_t>> out;
    for (size_t i = 0; i < here_.size(); ++i)
        if (wrong_here[i]) out.source.push_back(i);
    for (size_t k = 0; k < there_.size(); ++k)
        if (wrong_there[k]) out.target.push_back(k);
    return out;
}

std::vector<size_t> SideBySide::crossed() const {
    std::map<std::string_view, std::set<std::string_view>> of_here, of_there;
    std::set<uint32_t> common_here(a_.common.begin(), a_.common.end()),
        common_there(b_.common.begin(), b_.common.end());
    std::vector<size_t> unlike, out;
    for (size_t i = 0; i < here_.size(); ++i) {
        if (!is_word_token(here_[i])) continue;
        if (!alike_[i] && !is_type_word(here_[i])) unlike.push_back(i);
        const size_t k = laid_.word_of[i];
        if (k == Alignment::kNone || !is_word_token(there_[k])) continue;
        of_here[here_[i]].insert(there_[k]);
        of_there[there_[k]].insert(here_[i]);
    }
    for (const size_t i : unlike) {
        const size_t k = laid_.word_of[i];
        const bool is_called = i + 1 < here_.size() && here_[i + 1] == "(";
        bool is_known = common_there.contains(a_.common[i]);
        if (k != Alignment::kNone && is_word_token(there_[k]))
            is_known = is_known || common_here.contains(b_.common[k]) ||
                       (!is_called && (of_here[here_[i]].size() > 1 || of_there[there_[k]].size() > 1));
        if (is_known) out.push_back(i);
    }
    return out;
}

std::vector<std::pair<size_t, size_t>> SideBySide::other_names() const {
    std::vector<std::pair<size_t, size_t>> out;
    for (size_t i = 0; i < here_.size(); ++i) {
        size_t k = laid_.word_of[i];
        if (i + 1 < here_.size() && here_[i + 1] == "(") {  // `sinf (` beside `std :: cos (`
            const size_t open = laid_.word_of[i + 1];
            if (open != Alignment::kNone && open > 0 && there_[open] == "(") k = open - 1;
        }
        if (k != Alignment::kNone && !same(i, k) && is_word_token(here_[i]) && is_word_token(there_[k]))
            out.emplace_back(i, k);
    }
    return out;
}

std::set<size_t> SideBySide::covered() const {
    std::set<size_t> out;
    for (size_t i = 0; i < here_.size(); ++i)
        if (alike_[i] && (is_name_or_number(here_[i]) || is_operator(here_, i, head_))) out.insert(laid_.word_of[i]);
    return out;
}

bool SideBySide::same(size_t i, size_t k) const {
    return a_.exact[i] == b_.exact[k] || (is_name_or_number(here_[i]) && a_.common[i] == b_.common[k]);
}

void SideBySide::learn() {
    const std::set<std::string_view> used_here(here_.begin(), here_.end()), used_there(there_.begin(), there_.end());
    std::map<std::pair<std::string, std::string>, std::set<std::string>> cores;
    std::map<std::string_view, std::set<std::string_view>> of_here, of_there;
    std::map<std::string_view, size_t> count;
    for (size_t i = 0; i < here_.size(); ++i) {
        const size_t k = laid_.word_of[i];
        if (k == Alignment::kNone || !is_word_token(here_[i]) || !is_word_token(there_[k])) continue;
        of_here[here_[i]].insert(there_[k]);
        of_there[there_[k]].insert(here_[i]);
        ++count[here_[i]];
        if (!same(i, k))
            for (auto& manner : manners(here_[i], there_[k])) cores[std::move(manner)].insert(here_[i]);
    }
    for (const auto& [name, others] : of_here) {
        const bool is_one = others.size() == 1 && of_there[*others.begin()].size() == 1 && count[name] > 1;
        if (is_one && !used_there.contains(name) && !used_here.contains(*others.begin()))
            names_.emplace(name, *others.begin());
    }
    constexpr size_t kLeast = 3;  // names that differ in one manner
    for (const auto& [manner, each] : cores)
        if (each.size() >= kLeast) manners_.insert(manner);
}

bool SideBySide::is_alike(size_t i) const {
    const size_t k = laid_.word_of[i];
    if (k == Alignment::kNone) return false;
    if (same(i, k)) return true;
    if (!is_word_token(here_[i]) || !is_word_token(there_[k])) return false;
    if (const auto found = names_.find(here_[i]); found != names_.end() && found->second == there_[k]) return true;
    const auto differ = manners(here_[i], there_[k]);
    return std::any_of(differ.begin(), differ.end(), [&](const auto& each) { return manners_.contains(each); });
}

}  // namespace porttool
