// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/alike_spots.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "porttool/compare/alignment.h"
#include "porttool/compare/guarded_words.h"
#include "porttool/compare/side_by_side.h"
#include "porttool/compare/side_edit.h"
#include "porttool/language/words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

constexpr size_t kMostToLayForSpots = 24'000;  // words of all texts

/// A place of a unit's body where words went, or came.
struct BodySpot {
    Text lost, gained;          ///< as common words
    size_t first = 0, end = 0;  ///< in the text before: of what went

    bool only_reaches_otherwise() const {
        const auto is_reach = [](const Text& words) {
            return words.size() == 1 && (words[0] == "." || words[0] == "->");
        };
        return is_reach(lost) && is_reach(gained);
    }
};

bool is_bracket(std::string_view word) { return std::string_view("()[],;").find(word[0]) != std::string_view::npos; }

/// One side's edit: its spots, and what became other names in its head.
class SpotsOfSide {
public:
    SpotsOfSide(const SideEdit& edit, Side side, const Dialect& dialect) : edit_(edit), side_(side), dialect_(dialect) {
        const size_t old_head = end_of_head(edit.before), new_head = end_of_head(edit.now);
        for (size_t i = 0; i < old_head; ++i) --head_[common(edit.before[i])];
        for (size_t i = 0; i < new_head; ++i) ++head_[common(edit.now[i])];
        read_taken(new_head);
        read_body(old_head, new_head);
    }

    const std::vector<BodySpot>& spots() const { return spots_; }

    /// True if the head takes no name that the other side does not have, lost none that it has, and is otherwise as it
    /// was but for types and order.
    bool head_follows(const SideEdit& other) const {
        return std::all_of(head_.begin(), head_.end(), [&](const auto& each) {
            const auto& [word, more] = each;
            if (more == 0 || word.empty() || is_bracket(word) || word == "{" || word == "*" || word == "&") return true;
            if (!is_word_token(word)) return false;
            if (is_type_word(word) || word_is(word, kDropped | kPromise | kHeadPromise)) return true;
            const size_t there = times_in(other.has, word);
            return more > 0 ? there > 0 : there == 0 || other.lost.contains(word);
        });
    }

    /// True if both heads came to take the same, in one order and of one type, or one of the two took it before.
    bool takes_the_same(const SpotsOfSide& other) const {
        return taken_ != other.taken_ ? taken_.empty() || other.taken_.empty()
                                      : taken_.empty() || types_ == other.types_;
    }

private:
    static bool is_taken(const std::string& word) {
        return is_word_token(word) && !is_type_word(word) && !word_is(word, kDropped | kPromise | kHeadPromise);
    }

    /// The names that came into the head, each with the words of its type that mean the same in all languages.
    void read_taken(size_t new_head) {
        std::string type;
        for (size_t i = 0; i < new_head; ++i) {
            const std::string word = common(edit_.now[i]);
            if (word == "," || word == "(") type.clear();
            if (is_type_word(word) || word == "*" || word == "&") type += word + " ";
            if (!is_taken(word) || head_[word] <= 0) continue;
            taken_.push_back(word);
            types_[word] = type;
        }
    }

    std::string common(const std::string& word) const {
        std::string out = common_word(word, dialect_);
        return out.empty() ? word : out;
    }

    /// A word of the target that is the port of something is what it is the port of, and nothing else.
    std::string said(const std::string& word) const {
        if (side_ == Side::Source) return word;
        if (const std::string* name = dialect_.counterpart(word)) return *name;
        return dialect_.has_counterpart(word) ? "the target's " + word : word;
    }

    void read_body(size_t old_head, size_t new_head) {
        const Text before(edit_.before.begin() + static_cast<std::ptrdiff_t>(old_head), edit_.before.end()),
            now(edit_.now.begin() + static_cast<std::ptrdiff_t>(new_head), edit_.now.end());
        bool is_open = false;
        for (const DiffStep& step : diff(before, now)) {
            if (step.kind == DiffStep::Keep) {
                is_open = false;
                continue;
            }
            const std::string& word = step.kind == DiffStep::Add ? now[step.now] : before[step.before];
            if (!is_open) spots_.push_back({{}, {}, old_head + step.before, old_head + step.before});
            is_open = true;
            if (step.kind == DiffStep::Remove) spots_.back().end = old_head + step.before + 1;
            if (word != "const")
                (step.kind == DiffStep::Add ? spots_.back().gained : spots_.back().lost).push_back(said(word));
        }
        std::erase_if(spots_, [](const BodySpot& spot) {
            return (spot.lost.empty() && spot.gained.empty()) || spot.only_reaches_otherwise();
        });
    }

    const SideEdit& edit_;
    Side side_;
    const Dialect& dialect_;
    std::map<std::string, long> head_;          ///< how many more of each word there are in the head
    std::map<std::string, std::string> types_;  ///< of the names that came into the head
    Text taken_;                                ///< these, in their order
    std::vector<BodySpot> spots_;
};

/// Whether a place of the one text before is a place of the other, told by the words next to it.
class Places {
public:
    Places(const Text& source, const Text& target, const Dialect& dialect) : source_(source), target_(target) {
        WordKeys keys(dialect);
        const AlignedText a = keys.text(source, false), b = keys.text(target, false);
        word_of_ = align(a, b, {}).word_of;
    }

    bool are_one(const BodySpot& here, const BodySpot& there) const {
        if (here.first == here.end && there.first == there.end)
            return lies_in_order(here.first, there.first) &&
                   (meets_before(here.first, there.first) || meets_behind(here.first, there.first));
        bool any = false;  // what went on both sides: the same words, each of the other
        for (size_t i = here.first; i < here.end; ++i) {
            if (is_bracket(source_[i]) || word_of_[i] == Alignment::kNone) continue;
            if (word_of_[i] < there.first || word_of_[i] >= there.end) return false;
            any = true;
        }
        return any;
    }

private:
    /// No word before the one place stands for a word behind the other.
    bool lies_in_order(size_t here, size_t there) const {
        for (size_t i = here; i-- > 0;)
            if (word_of_[i] != Alignment::kNone && !is_bracket(source_[i])) {
                if (word_of_[i] >= there) return false;
                break;
            }
        for (size_t i = here; i < word_of_.size(); ++i)
            if (word_of_[i] != Alignment::kNone && !is_bracket(source_[i])) return word_of_[i] >= there;
        return true;
    }

    /// The next words before the two places stand for each other, with the same brackets between: `f(a) * k` and
    /// `f(a * k)` have their new words behind `a`, and at two places.
    bool meets_before(size_t here, size_t there) const {
        while (here > 0 && there > 0 && is_bracket(source_[here - 1]) && source_[here - 1] == target_[there - 1]) {
            --here;
            --there;
        }
        return here > 0 && there > 0 && word_of_[here - 1] == there - 1 && !is_bracket(source_[here - 1]);
    }

    bool meets_behind(size_t here, size_t there) const {
        while (here < source_.size() && there < target_.size() && is_bracket(source_[here]) &&
               source_[here] == target_[there]) {
            ++here;
            ++there;
        }
        return here < source_.size() && there < target_.size() && word_of_[here] == there && !is_bracket(source_[here]);
    }

    const Text &source_, &target_;
    std::vector<size_t> word_of_;
};

}  // namespace

bool edits_spot_by_spot(const PairTexts& texts, const Dialect& dialect) {
    const size_t words =
        texts.source_before.size() + texts.source_now.size() + texts.target_before.size() + texts.target_now.size();
    if (words > kMostToLayForSpots || !guarded_difference(texts).empty()) return false;
    const SideEdit source(texts.source_before, texts.source_now, dialect),
        target(texts.target_before, texts.target_now, dialect);
    if (source.guarded != target.guarded) return false;
    const SpotsOfSide here(source, Side::Source, dialect), there(target, Side::Target, dialect);
    const std::vector<BodySpot>&a = here.spots(), &b = there.spots();
    if (a.empty() || a.size() != b.size() || !here.head_follows(target) || !there.head_follows(source) ||
        !here.takes_the_same(there))
        return false;
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i].lost != b[i].lost || a[i].gained != b[i].gained) return false;
    const Places places(source.before, target.before, dialect);
    for (size_t i = 0; i < a.size(); ++i)
        if (!places.are_one(a[i], b[i])) return false;
    return true;
}

}  // namespace porttool
