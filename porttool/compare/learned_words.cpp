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
#include "porttool/text/name_words.h"

namespace porttool {
namespace {

bool is_float(std::string_view number) { return number.ends_with('f') && !number.starts_with("0x"); }
bool is_unmarked_real(std::string_view number) {
    return !number.starts_with("0x") && number.find_first_of(".e") != std::string_view::npos && !is_float(number);
}

/// A text with one word for a type of several, `unsigned` for `unsigned int`, and where each word stands.
struct WordsOfTypes {
    std::vector<std::string> words;
    std::vector<size_t> places;

    explicit WordsOfTypes(const Words& text) {
        for (size_t i = 0; i < text.size(); ++i) {
            if (i > 0 && word_is(text[i], kTypePart) && word_is(text[i - 1], kTypePart)) continue;
            words.emplace_back(text[i]);
            places.push_back(i);
        }
    }
};

class WordLearner {
public:
    WordLearner(const PairTexts& texts, const Dialect& dialect, const BySide<std::string_view>& ids) : texts_(texts) {
        const WordsOfTypes of_source(texts.source_before), of_target(texts.target_before);
        const std::vector<std::string>&source = of_source.words, &target = of_target.words;
        WordKeys keys(dialect);
        AlignedText a = keys.text(source, false), b = keys.text(target, false);
        join_own_parts(a, b, own_parts({}));
        const Alignment found = align(a, b, {});
        marks_at_.resize(texts.source_before.size(), Marks::Unknown);
        type_at_.resize(texts.source_before.size());
        // What a function gives back tells nothing of what it takes: `REAL4 f ( REAL4 z )`, `void f ( Vector & z )`.
        const auto name = std::find(source.begin(), source.end(), "@");
        const size_t first = name == source.end() ? 0 : static_cast<size_t>(name - source.begin());
        for (size_t i = first; i < source.size(); ++i) {
            if (found.word_of[i] == Alignment::kNone) continue;
            const std::string& there = target[found.word_of[i]];
            const size_t at = of_source.places[i];
            marks_at_[at] = note(source[i], there);
            if (is_type_word(source[i]) && is_word_token(there)) type_at_[at] = there;
        }
        source_words_.insert(texts.source_before.begin(), texts.source_before.end());
        target_words_.insert(texts.target_before.begin(), texts.target_before.end());
        new_words_.insert(texts.target_now.begin(), texts.target_now.end());
        learn_parts();
        learn_parts_of_ids(ids);
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

    /// The one part in which two names differ, on each side.
    static std::pair<std::string, std::string> other_part(const std::string& a, const std::string& b) {
        const std::vector<std::string_view> here = name_pieces(a), there = name_pieces(b);
        if (here.size() != there.size() || here.size() < 2) return {};
        std::pair<std::string, std::string> out;
        for (size_t i = 0; i < here.size(); ++i) {
            if (here[i] == there[i]) continue;
            if (!out.first.empty() || here[i] == "_" || there[i] == "_") return {};
            out = {std::string(here[i]), std::string(there[i])};
        }
        return out;
    }

    /// How the ids of a pair call the two sides: words that took each other's place, in each way to spell them.
    void learn_parts_of_ids(const BySide<std::string_view>& ids) {
        constexpr size_t kLeast = 3;  // letters
        const auto words_of = [](std::string_view id) {
            std::vector<std::string> parts;
            for (const std::string_view piece : name_pieces(id))
                if (piece != "_" && is_word_token(piece)) parts.emplace_back(piece);
            return parts;
        };
        const std::vector<std::string> source = words_of(ids.source), target = words_of(ids.target);
        std::vector<std::string> lost, gained;
        const auto end_of_place = [&] {
            for (size_t i = 0; lost.size() == gained.size() && i < lost.size(); ++i) {
                if (lost[i].size() < kLeast || gained[i].size() < kLeast) continue;
                const std::array<std::string, 3> here = spellings(lost[i]), there = spellings(gained[i]);
                for (size_t k = 0; k < here.size(); ++k) parts_.emplace(here[k], there[k]);
            }
            lost.clear();
            gained.clear();
        };
        for (const DiffStep& step : diff(source, target)) {
            if (step.kind == DiffStep::Keep) end_of_place();
            if (step.kind == DiffStep::Remove) lost.push_back(source[step.before]);
            if (step.kind == DiffStep::Add) gained.push_back(target[step.now]);
        }
        end_of_place();
    }

    /// A name that is new on both sides, spelled as the target spells such names; "" if the target has no such name.
    std::string new_counterpart(const std::string& word) const {
        if (parts_.empty() || source_words_.contains(word) || target_words_.contains(word)) return {};
        std::string there;
        for (const std::string_view piece : name_pieces(word)) {
            const auto found = parts_.find(std::string(piece));
            there += found == parts_.end() ? piece : found->second;
        }
        const bool is_new = there != word && !target_words_.contains(there) && !source_words_.contains(there);
        return is_new && new_words_.contains(there) ? there : std::string();
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

LearnedWords in_words_of_target(const PairTexts& texts, const Dialect& dialect, const BySide<std::string_view>& ids) {
    return WordLearner(texts, dialect, ids).run();
}

}  // namespace porttool
