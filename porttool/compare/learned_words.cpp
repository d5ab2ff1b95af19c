// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/learned_words.h"

#include <map>
#include <set>

#include "porttool/compare/alignment.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

bool is_float(std::string_view number) { return number.ends_with('f') && !number.starts_with("0x"); }
bool is_unmarked_real(std::string_view number) {
    return !number.starts_with("0x") && number.find_first_of(".e") != std::string_view::npos && !is_float(number);
}

class WordLearner {
public:
    WordLearner(const PairTexts& texts, const Dialect& dialect) : texts_(texts) {
        const std::vector<std::string> source(texts.source_before.begin(), texts.source_before.end());
        const std::vector<std::string> target(texts.target_before.begin(), texts.target_before.end());
        WordKeys keys(dialect);
        const AlignedText a = keys.text(source, false), b = keys.text(target, false);
        const Alignment found = align(a, b, {});
        for (size_t i = 0; i < source.size(); ++i)
            if (found.word_of[i] != Alignment::kNone) note(source[i], target[found.word_of[i]]);
        source_words_.insert(texts.source_before.begin(), texts.source_before.end());
        target_words_.insert(texts.target_before.begin(), texts.target_before.end());
    }

    LearnedWords run() const {
        LearnedWords out;
        const Marks marks = learn_marks();
        for (const std::string_view word : texts_.source_before) out.before.push_back(said(word, marks, out));
        for (const std::string_view word : texts_.source_now) out.now.push_back(said(word, marks, out));
        return out;
    }

private:
    enum class Marks : uint8_t { Same, Added, Dropped };

    void note(const std::string& here, const std::string& there) {
        if (is_word_token(here) && is_word_token(there)) {
            ++there_of_[here][there];
            ++here_of_[there][here];
        }
        if (!is_number_token(here) || !is_number_token(there) || number_value(here) != number_value(there)) return;
        marks_added_ += is_unmarked_real(here) && is_float(there);
        marks_dropped_ += is_float(here) && is_unmarked_real(there);
        marks_kept_ += is_float(here) && is_float(there);
        plain_kept_ += is_unmarked_real(here) && is_unmarked_real(there);
    }

    std::string_view said(std::string_view word, Marks marks, LearnedWords& out) const {
        std::string other;
        if (is_word_token(word)) {
            other = counterpart(std::string(word));
        } else if (is_number_token(word) && marks == Marks::Added && is_unmarked_real(word)) {
            other = normal_number(std::string(word) + "f");
        } else if (is_number_token(word) && marks == Marks::Dropped && is_float(word)) {
            other = normal_number(number_value(word) +
                                  (number_value(word).find_first_of(".e") == std::string::npos ? ".0" : ""));
        }
        if (other.empty() || other == word) return word;
        out.any = true;
        out.owned.push_back(std::move(other));
        return out.owned.back();
    }

    /// The word that nearly always stands for another one; "" if none does.
    static std::string usual(const std::map<std::string, std::map<std::string, size_t>>& words,
                             const std::string& word) {
        const auto found = words.find(word);
        if (found == words.end()) return {};
        size_t all = 0;
        for (const auto& [text, times] : found->second) all += times;
        for (const auto& [text, times] : found->second)
            if (4 * times >= 3 * all) return text;
        return {};
    }

    std::string counterpart(const std::string& word) const {
        const std::string there = usual(there_of_, word);
        if (there.empty() || usual(here_of_, there) != word) return {};
        return source_words_.contains(there) || target_words_.contains(word) ? std::string() : there;
    }

    /// Whether one side alone marks its floats, by the numbers that stand for each other.
    Marks learn_marks() const {
        if (marks_added_ > 0 && plain_kept_ == 0) return Marks::Added;
        if (marks_dropped_ > 0 && marks_kept_ == 0) return Marks::Dropped;
        return Marks::Same;
    }

    const PairTexts& texts_;
    std::map<std::string, std::map<std::string, size_t>> there_of_, here_of_;
    size_t marks_added_ = 0, marks_dropped_ = 0, marks_kept_ = 0, plain_kept_ = 0;
    std::set<std::string, std::less<>> source_words_, target_words_;
};

}  // namespace

LearnedWords in_words_of_target(const PairTexts& texts, const Dialect& dialect) {
    return WordLearner(texts, dialect).run();
}

}  // namespace porttool
