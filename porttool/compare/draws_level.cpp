// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/draws_level.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "porttool/compare/alignment.h"
#include "porttool/compare/hints.h"
#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

bool is_name_or_number(std::string_view word) { return is_word_token(word) || is_number_token(word); }

/// What is computed, other than by names: a sign that came must stand in the other text as well.
template <class AnyText>
bool is_operator(const AnyText& words, size_t i) {
    const std::string_view word = words[i];
    const bool binary = i > 0 && (is_name_or_number(words[i - 1]) || words[i - 1] == ")" || words[i - 1] == "]");
    if (word == "*" || word == "&") return binary && i > 1 && !is_type_word(words[i - 1]);
    constexpr std::string_view kSigns = "+-/%<>=!|^~?";
    return word != "->" && (word == "&&" || kSigns.find(word[0]) != std::string_view::npos);
}

/// The names and numbers that an edit brought in and took away.
struct EditedWords {
    EditedWords(const Words& before, const Words& now) {
        for (const DiffStep& step : diff(before, now)) {
            if (step.kind == DiffStep::Add && is_name_or_number(now[step.now])) gained.push_back(now[step.now]);
            if (step.kind == DiffStep::Remove && is_name_or_number(before[step.before]))
                lost.push_back(before[step.before]);
        }
    }

    Words gained, lost;
};

/// The other side's words without their order: asked first, since laying texts side by side is dear.
class OthersWords {
public:
    OthersWords(const Words& words, const Dialect& dialect) : dialect_(dialect) {
        for (const std::string_view word : words) ++times_[is_number_token(word) ? in_common(word) : std::string(word)];
        for (const std::string_view word : words)
            if (is_word_token(word)) known_.insert(in_common(word));
    }

    /// False if more came that is foreign to the other side than what is not, or went and was foreign.
    bool may_be_nearer(const EditedWords& edit) const {
        std::unordered_map<std::string_view, long> change;
        for (const std::string_view word : edit.gained) ++change[word];
        for (const std::string_view word : edit.lost) --change[word];
        long nearer = 0, foreign = 0;
        for (const auto& [word, times] : change) {
            const bool has = has_like(word);
            if ((times > 0) == has) nearer += std::abs(times);
            if (times > 0 && !has) foreign += times;
        }
        return foreign <= nearer;
    }

    /// False if a number or an operator came that must stand alone: more often than before and than the other has it.
    bool may_match(const Words& before, const Words& now) const {
        std::unordered_map<std::string_view, size_t> then, today;
        const auto count = [](const Words& words, std::unordered_map<std::string_view, size_t>& out) {
            for (size_t i = 0; i < words.size(); ++i)
                if (is_number_token(words[i]) || is_operator(words, i)) ++out[words[i]];
        };
        count(before, then);
        count(now, today);
        return std::all_of(today.begin(), today.end(), [&](const auto& each) {
            const auto [word, times] = each;
            const auto had = then.find(word);
            const auto has = times_.find(is_number_token(word) ? in_common(word) : std::string(word));
            return times <= (had == then.end() ? 0 : had->second) + (has == times_.end() ? 0 : has->second);
        });
    }

private:
    std::string in_common(std::string_view word) const {
        std::string common = common_word(word, dialect_);
        return common.empty() ? std::string(word) : common;
    }
    bool has_like(std::string_view word) const {
        return is_number_token(word) ? times_.contains(in_common(word)) : known_.contains(in_common(word));
    }

    const Dialect& dialect_;
    std::unordered_map<std::string, size_t> times_;  ///< numbers by their value
    std::unordered_set<std::string> known_;          ///< names, as common words
};

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

/// A text laid beside another: which of its words have their like there.
class Beside {
public:
    Beside(const Text& here, const Text& there, const AlignedText& a, const AlignedText& b)
        : here_(here), there_(there), a_(a), b_(b), laid_(align(a, b, {})), alike_(here.size()) {
        learn();
        for (size_t i = 0; i < here.size(); ++i) {
            alike_[i] = is_alike(i);
            if (is_name_or_number(here[i])) balance_ += alike_[i] ? 1 : -1;
        }
    }

    /// Names and numbers of this text that the other has less those that it has not.
    long balance() const { return balance_; }

    /// How often each number and operator stands here that has no like in the other text.
    std::map<std::string_view, size_t> alone() const {
        std::map<std::string_view, size_t> out;
        for (size_t i = 0; i < here_.size(); ++i)
            if (!alike_[i] && (is_number_token(here_[i]) || is_operator(here_, i))) ++out[here_[i]];
        return out;
    }

    /// The words of the other text that have their like here.
    std::set<size_t> covered() const {
        std::set<size_t> out;
        for (size_t i = 0; i < here_.size(); ++i)
            if (alike_[i] && (is_name_or_number(here_[i]) || is_operator(here_, i))) out.insert(laid_.word_of[i]);
        return out;
    }

private:
    bool same(size_t i, size_t k) const {
        return a_.exact[i] == b_.exact[k] || (is_name_or_number(here_[i]) && a_.common[i] == b_.common[k]);
    }

    void learn() {
        const std::set<std::string_view> used_here(here_.begin(), here_.end()),
            used_there(there_.begin(), there_.end());
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

    bool is_alike(size_t i) const {
        const size_t k = laid_.word_of[i];
        if (k == Alignment::kNone) return false;
        if (same(i, k)) return true;
        if (!is_word_token(here_[i]) || !is_word_token(there_[k])) return false;
        if (const auto found = names_.find(here_[i]); found != names_.end() && found->second == there_[k]) return true;
        const auto differ = manners(here_[i], there_[k]);
        return std::any_of(differ.begin(), differ.end(), [&](const auto& each) { return manners_.contains(each); });
    }

    const Text &here_, &there_;
    const AlignedText &a_, &b_;
    Alignment laid_;
    std::map<std::string_view, std::string_view> names_;     ///< that stand for each other wherever they stand
    std::set<std::pair<std::string, std::string>> manners_;  ///< in which many names differ
    std::vector<bool> alike_;
    long balance_ = 0;
};

}  // namespace

bool draws_level(const LoneTexts& texts, const Dialect& dialect) {
    constexpr size_t kMost = 16'000;                // words of all texts
    constexpr size_t kLeastGained = 4, kLeast = 6;  // names and numbers that came, and that came or went
    if (texts.before.size() + texts.now.size() + texts.other.size() > kMost) return false;
    const Words plain_before = without_hints(texts.before), plain_now = without_hints(texts.now),
                plain_other = without_hints(texts.other);
    const EditedWords edit(plain_before, plain_now);
    const size_t changed = edit.gained.size() + edit.lost.size();
    if (edit.gained.size() < kLeastGained || changed < kLeast) return false;
    const OthersWords others(plain_other, dialect);
    if (!others.may_be_nearer(edit) || !others.may_match(plain_before, plain_now)) return false;
    const auto text = [](const Words& words) { return Text(words.begin(), words.end()); };
    const Text before = text(plain_before), now = text(plain_now), other = text(plain_other);
    WordKeys keys(dialect);
    const AlignedText was = keys.text(before, false), is = keys.text(now, false), there = keys.text(other, false);
    const Beside then(before, other, was, there), today(now, other, is, there);
    if (3 * (today.balance() - then.balance()) < 2 * static_cast<long>(changed)) return false;
    const std::set<size_t> covered_then = then.covered(), covered_today = today.covered();
    if (!std::includes(covered_today.begin(), covered_today.end(), covered_then.begin(), covered_then.end()))
        return false;
    const auto alone_then = then.alone(), alone_today = today.alone();
    return std::all_of(alone_today.begin(), alone_today.end(), [&](const auto& each) {
        const auto found = alone_then.find(each.first);
        return found != alone_then.end() && found->second >= each.second;
    });
}

}  // namespace porttool
