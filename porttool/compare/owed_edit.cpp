// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/owed_edit.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/compare/common_ground.h"
#include "porttool/normal/diff.h"

namespace porttool {
namespace {

/// A part of a whole; where there is none, what stands in for it.
double share_of(size_t part, size_t all, double otherwise) {
    return all == 0 ? otherwise : static_cast<double>(part) / static_cast<double>(all);
}

/// Of the words of the text before an edit, which count, went, and stand near what came or went.
struct TouchedWords {
    std::vector<bool> counts, went, near;

    explicit TouchedWords(const SideEdit& edit) : went(edit.before.size()), near(edit.before.size()) {
        const size_t head = end_of_head(edit.before);
        for (size_t i = 0; i < edit.before.size(); ++i)
            counts.push_back(is_name_or_number(edit.before[i]) || is_operator(edit.before, i, head));
        size_t at = 0;
        for (const DiffStep& step : diff(edit.before, edit.now)) {
            if (step.kind != DiffStep::Add) at = step.before;
            if (step.kind == DiffStep::Remove && counts[at]) went[at] = true;
            if (step.kind != DiffStep::Keep) mark_around(at);
        }
    }

private:
    void mark_around(size_t at) {
        constexpr size_t kNear = 12;
        const size_t first = at - std::min(at, kNear), end = std::min(near.size(), at + kNear + 1);
        std::fill(near.begin() + static_cast<std::ptrdiff_t>(first), near.begin() + static_cast<std::ptrdiff_t>(end),
                  true);
    }
};

/// Of the names that came, the share that the other side's text has.
double known_names(LaidEdit& laid) {
    constexpr double kNone = 0.5;
    size_t came = 0, known = 0;
    for (const std::string& word : laid.edit().gained) {
        if (!is_word_token(word) || laid.edit().lost.contains(word)) continue;
        ++came;
        known += laid.other().has.contains(word) ? 1 : 0;
    }
    return share_of(known, came, kNone);
}

size_t words_in(const std::map<std::string, size_t>& counts) {
    size_t out = 0;
    for (const auto& [word, times] : counts) out += times;
    return out;
}

/// True if what went has gone to another place, or one number took the place of another. In a long edit numbers come
/// and go with what they stand in.
bool reorders_or_retunes_words(const SideEdit& edit) {
    constexpr size_t kLong = 24;
    const auto any_number = [](const std::set<std::string>& words) {
        return std::any_of(words.begin(), words.end(), [](const std::string& word) { return is_number_token(word); });
    };
    return edit.gained == edit.lost || (edit.size < kLong && any_number(edit.gained) && any_number(edit.lost));
}

/// How much of all words of a text before its edit, and of the other side's, has its like in the other; 0 to 1.
double alike_share_of_texts(LaidEdit& laid) {
    const size_t words = words_in(laid.edit().had) + words_in(laid.other().has);
    return 1 - std::min(1.0, share_of(laid.before().unlike(), words, 1));
}

/// How much of a text before its edit has its like in the other side's: of all words of both, of those within a dozen
/// words of the edit, and of those that went; 0 to 1.
struct AlikeShares {
    double of_texts, of_place, of_lost;
};

AlikeShares alike_shares(LaidEdit& laid) {
    const SideEdit& edit = laid.edit();
    const SideBySide& beside = laid.before();
    const TouchedWords touched(edit);
    size_t went = 0, went_alike = 0, around = 0, around_alike = 0;
    for (size_t i = 0; i < edit.before.size(); ++i) {
        if (!touched.counts[i]) continue;
        const size_t alike = beside.has_like(i) ? 1 : 0;
        if (touched.went[i]) {
            ++went;
            went_alike += alike;
        } else if (touched.near[i]) {
            ++around;
            around_alike += alike;
        }
    }
    const double of_texts = alike_share_of_texts(laid);
    const double of_place = share_of(around_alike, around, of_texts);
    return {of_texts, of_place, share_of(went_alike, went, of_place)};
}

/// What speaks for an edit that is owed, as a logistic regression sums it up: 0 is even for an edit of which nothing
/// else is known. How much of the two texts is alike, how much around the edit, how much of what went, and which of the
/// names that came are known there. Of texts that can be laid side by side.
///
///     before      y[i] = k * x[i];                                      port
///     now         y[i] = k * x[i] + lim;                                all that stands around has its like
///     or now      y[i] = k * x[i]; log.push(ticks, "done", where());    what came is beside it, of names unknown there
///     other       z[i] = k * x[i]; z[i] += lim;                         source
double weight_of_evidence(LaidEdit& laid) {
    const AlikeShares alike = alike_shares(laid);
    // Counted on edits of eight projects that were read, and on edits of both sides with one of them taken back; each
    // project was held against what the others gave.
    return -3.6 + 1.5 * alike.of_texts + 1.55 * alike.of_place + 1.35 * alike.of_lost + 1.15 * known_names(laid);
}

}  // namespace

bool are_mostly_alike(LaidEdit& laid) {
    constexpr double kHalf = 0.5;
    return !laid.can_be_laid() || alike_share_of_texts(laid) >= kHalf;
}

bool is_likely_owed(LaidEdit& laid, const OwedBy& by) {
    constexpr size_t kMeant = 12;   // words of an edit that is no slip
    constexpr size_t kLeast = 64;   // words of a text whose likeness tells much
    constexpr size_t kFewest = 16;  // ... and of one where it tells anything
    if (!laid.can_be_laid()) return true;
    const size_t shorter = std::min(words_in(laid.edit().had), words_in(laid.other().has));
    const bool is_work = words_edited(laid.texts().before, laid.texts().now) > kMeant && !touches_what_counts(laid) &&
                         !reorders_or_retunes_words(laid.edit()) && shorter >= kLeast;
    if (!is_work && shorter < kFewest) return true;
    constexpr double kEven = 0;         // of ports in words of their own
    constexpr double kLikely = -0.5;    // of work of somebody's own
    constexpr double kPossible = -1.0;  // of what may be a slip, and of what is never silent
    const double weight = weight_of_evidence(laid);
    if (weight >= kEven) return true;
    const bool may_be = weight >= (is_work ? kLikely : kPossible) || (!is_work && by.are_namesakes());
    return may_be && !by.is_of_own_words();
}

}  // namespace porttool
