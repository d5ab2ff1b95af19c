// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/learned_words.h"

#include <algorithm>
#include <map>
#include <set>

#include "porttool/compare/alignment.h"
#include "porttool/compare/own_parts.h"
#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
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
        AlignedText a = keys.text(source, false), b = keys.text(target, false);
        join_own_parts(a, b, own_parts({}));
        const Alignment found = align(a, b, {});
        marks_at_.resize(source.size(), Marks::Unknown);
        type_at_.resize(source.size());
        // What a function gives back tells nothing of what it takes: `REAL4 f ( REAL4 z )`, `void f ( Vector & z )`.
        const auto name = std::find(source.begin(), source.end(), "@");
        const size_t first = name == source.end() ? 0 : static_cast<size_t>(name - source.begin());
        for (size_t i = first; i < source.size(); ++i) {
            if (found.word_of[i] == Alignment::kNone) continue;
            const std::string& there = target[found.word_of[i]];
            marks_at_[i] = note(source[i], there);
            if (is_type_word(source[i]) && is_word_token(there)) type_at_[i] = there;
        }
        source_words_.insert(texts.source_before.begin(), texts.source_before.end());
        target_words_.insert(texts.target_before.begin(), texts.target_before.end());
        new_words_.insert(texts.target_now.begin(), texts.target_now.end());
        learn_parts();
    }

    LearnedWords run() const {
        LearnedWords out;
        const Marks usual = learn_marks();
        const auto said_at = [&](std::string_view word, size_t place) {
            const bool known = place != kNoPlace && marks_at_[place] != Marks::Unknown;
            return said(word, known ? marks_at_[place] : usual, place == kNoPlace ? std::string() : type_at_[place],
                        out);
        };
        for (size_t i = 0; i < texts_.source_before.size(); ++i)
            out.before.push_back(said_at(texts_.source_before[i], i));
        const std::vector<size_t> places = places_before();
        for (size_t i = 0; i < texts_.source_now.size(); ++i)
            out.now.push_back(said_at(texts_.source_now[i], places[i]));
        return out;
    }

private:
    enum class Marks : uint8_t { Unknown, Same, Added, Dropped };
    static constexpr size_t kNoPlace = static_cast<size_t>(-1);

    /// Takes in that one word stands for another, and tells how the marks of a number do.
    Marks note(const std::string& here, const std::string& there) {
        if (is_word_token(here) && is_word_token(there)) {
            ++there_of_[here][there];
            ++here_of_[there][here];
        }
        if (!is_number_token(here) || !is_number_token(there) || number_value(here) != number_value(there))
            return Marks::Unknown;
        marks_kept_ += is_float(here) && is_float(there);
        plain_kept_ += is_unmarked_real(here) && is_unmarked_real(there);
        const bool added = is_unmarked_real(here) && is_float(there),
                   dropped = is_float(here) && is_unmarked_real(there);
        marks_added_ += added;
        marks_dropped_ += dropped;
        return added ? Marks::Added : dropped ? Marks::Dropped : Marks::Same;
    }

    /// Where each word of the source stood before. A number has the place of the one that it took the place of.
    std::vector<size_t> places_before() const {
        const auto without_values = [](const Words& text) {
            std::vector<std::string> out;
            for (const std::string_view word : text) out.emplace_back(is_number_token(word) ? "0" : word);
            return out;
        };
        std::vector<size_t> places(texts_.source_now.size(), kNoPlace);
        for (const DiffStep& step : diff(without_values(texts_.source_before), without_values(texts_.source_now)))
            if (step.kind == DiffStep::Keep) places[step.now] = step.before;
        return places;
    }

    /// `there`: the type that the target has at its place, or "".
    std::string_view said(std::string_view word, Marks marks, const std::string& there, LearnedWords& out) const {
        std::string other;
        if (is_type_word(word) && target_words_.contains(word)) {
            other = type_among_several(std::string(word), there);
        } else if (is_word_token(word)) {
            other = counterpart(std::string(word));
            if (other.empty()) other = new_counterpart(std::string(word));
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

    /// Where a name of the source and the target's differ in one part alone (`op_cuda_add`, `op_sycl_add`), that part
    /// stands for the other.
    void learn_parts() {
        std::map<std::string, std::map<std::string, size_t>> parts;
        for (const auto& [word, others] : there_of_)
            for (const auto& [other, times] : others)
                if (const auto [part, there] = other_part(word, other); !part.empty()) ++parts[part][there];
        constexpr size_t kLeast = 3;  // names that tell it
        for (const auto& [part, others] : parts) {
            const std::string there = usual(parts, part);
            if (!there.empty() && others.at(there) >= kLeast) parts_.emplace(part, there);
        }
    }

    /// The one part between underscores in which two names differ, on each side.
    static std::pair<std::string, std::string> other_part(const std::string& a, const std::string& b) {
        const size_t most = std::min(a.size(), b.size());
        size_t front = 0, back = 0;
        while (front < most && a[front] == b[front]) ++front;
        while (front > 0 && a[front - 1] != '_') --front;
        while (back < most - front && a[a.size() - 1 - back] == b[b.size() - 1 - back]) ++back;
        while (back > 0 && a[a.size() - back] != '_') --back;
        const std::string part = a.substr(front, a.size() - back - front),
                          other = b.substr(front, b.size() - back - front);
        const bool whole = front + back == 0 || part.empty() || other.empty() || part == other;
        return whole || (part + other).find('_') != std::string::npos ? std::pair<std::string, std::string>()
                                                                      : std::pair(part, other);
    }

    /// A name that is new on both sides, spelled as the target spells such names; "" if the target has no such name.
    std::string new_counterpart(const std::string& word) const {
        if (parts_.empty() || source_words_.contains(word) || target_words_.contains(word)) return {};
        for (size_t first = 0; first < word.size();) {
            const size_t end = std::min(word.find('_', first), word.size());
            if (const auto found = parts_.find(word.substr(first, end - first)); found != parts_.end()) {
                std::string there = word.substr(0, first) + found->second + word.substr(end);
                const bool is_new = !target_words_.contains(there) && !source_words_.contains(there);
                if (is_new && new_words_.contains(there)) return there;
            }
            first = end + 1;
        }
        return {};
    }

    /// A port that says `double` here and there says `REAL` for most of the source's: what is new is `REAL` there.
    std::string type_among_several(const std::string& word, const std::string& there) const {
        const std::string most = usual(there_of_, word);
        if (most.empty() || most == word || usual(here_of_, most) != word || source_words_.contains(most)) return {};
        return there == word ? word : most;
    }

    /// Whether one side alone marks its floats, but for few, by the numbers that stand for each other.
    Marks learn_marks() const {
        constexpr size_t kMost = 3;
        if (marks_added_ > kMost * plain_kept_) return Marks::Added;
        if (marks_dropped_ > kMost * marks_kept_) return Marks::Dropped;
        return Marks::Same;
    }

    const PairTexts& texts_;
    std::map<std::string, std::map<std::string, size_t>> there_of_, here_of_;
    std::vector<Marks> marks_at_;       ///< of the source's words before
    std::vector<std::string> type_at_;  ///< what stands for each of its types there
    size_t marks_added_ = 0, marks_dropped_ = 0, marks_kept_ = 0, plain_kept_ = 0;
    std::set<std::string, std::less<>> source_words_, target_words_, new_words_;  ///< new: of the target now
    std::map<std::string, std::string> parts_;  ///< of names, that stand for each other
};

}  // namespace

LearnedWords in_words_of_target(const PairTexts& texts, const Dialect& dialect) {
    return WordLearner(texts, dialect).run();
}

}  // namespace porttool
