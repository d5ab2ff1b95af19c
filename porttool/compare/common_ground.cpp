// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/common_ground.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/declared_otherwise.h"
#include "porttool/compare/hints.h"
#include "porttool/compare/phrases.h"
#include "porttool/compare/runtime_calls.h"
#include "porttool/compare/side_by_side.h"
#include "porttool/compare/side_edit.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

constexpr size_t kLeastEdited = 6;  // words of an edit that is nobody's slip
constexpr size_t kMeant = 12;       // words of an edit that is more than a mend
constexpr size_t kLong = 24;        // words of an edit that is work of its own

/// How many names came and went, and how many of them the other side's text has.
struct EditedNames {
    size_t all = 0, known = 0;

    EditedNames(const SideEdit& edit, const SideEdit& other) {
        for (const std::string& word : edit.gained) count(word, other);
        for (const std::string& word : edit.lost)
            if (!edit.gained.contains(word)) count(word, other);
    }

    /// True if the other side has less than half of them.
    bool are_foreign() const { return all > 0 && 2 * known < all; }

    /// True if it has hardly any of many.
    bool are_unheard_of() const { return all >= kLeastEdited && 8 * known < all; }

private:
    void count(const std::string& word, const SideEdit& other) {
        if (!is_word_token(word)) return;
        ++all;
        known += other.has.contains(word) ? 1 : 0;
    }
};

/// How a text launches kernels, and with what; that is never silent either.
std::vector<std::string> launches_of(const Words& text) {
    const std::vector<std::string> plain = with_plain_launches({text.begin(), text.end()});
    std::vector<std::string> out;
    bool inside = false;
    for (const std::string& word : plain) {
        inside = word == "hipLaunchKernelGGL" || (inside && word != ";");
        if (inside) out.push_back(word);
    }
    return out;
}

/// True if the edit only put the same words into another order, or one number in the place of another: a value that
/// somebody chose for this side. In a long edit of a text apart numbers come and go with what they stand in.
bool reorders_or_retunes(const SideEdit& edit, bool is_apart) {
    if (is_apart && edit.size >= kLong) return edit.gained == edit.lost;
    const auto any_number = [](const std::set<std::string>& words) {
        return std::any_of(words.begin(), words.end(), [](const std::string& word) { return is_number_token(word); });
    };
    return edit.gained == edit.lost || (any_number(edit.gained) && any_number(edit.lost));
}

/// True for words that are never silent. Branches for the compiler are told by what stands in them.
bool touches_guarded_words(const SideEdit& edit, const LoneTexts& texts) {
    const auto directives = [](const Words& text, std::string_view kind) {
        size_t out = 0;
        for (size_t i = 0; i + 1 < text.size(); ++i) out += text[i] == "#" && text[i + 1].starts_with(kind) ? 1 : 0;
        return out;
    };
    for (const std::string_view kind : {"def", "undef", "err", "inc", "line"})
        if (directives(texts.before, kind) != directives(texts.now, kind)) return true;
    return std::any_of(edit.guarded.begin(), edit.guarded.end(), [](const auto& each) { return each.first != "#"; });
}

/// True of what a person would change by mistake: one word in the place of another, wherever it stands, or a word that
/// came or went. Told by the texts as they are, since the arms of a switch change places with their labels.
bool is_of_few_words(const LoneTexts& texts) {
    constexpr size_t kFew = 3;
    std::set<std::string_view> edited;
    size_t tokens = 0;
    for (const DiffStep& step : diff(texts.before, texts.now)) {
        if (step.kind == DiffStep::Keep) continue;
        edited.insert(step.kind == DiffStep::Add ? texts.now[step.now] : texts.before[step.before]);
        ++tokens;
    }
    return tokens <= kFew || edited.size() < kFew;
}

/// True if hardly a third of both texts' words have their like in the other: a port that does it in another way.
bool are_apart(const SideEdit& edit, const SideEdit& other, const SideBySide& laid) {
    size_t words = 0;
    for (const auto* counts : {&edit.had, &other.has})
        for (const auto& [word, times] : *counts) words += times;
    constexpr size_t kMostAlike = 35, kAll = 100;
    return kAll * laid.unlike() > (kAll - kMostAlike) * words;
}

/// Goes through the edit, word by word, beside the other side's text. In texts that are apart single words have their
/// like by chance: there only clauses that are mostly the same count.
class GroundReader {
public:
    GroundReader(const SideEdit& edit, const SideBySide& laid, bool are_apart)
        : edit_(edit), laid_(laid), heads_{end_of_head(edit.before), end_of_head(edit.now)}, are_apart_(are_apart) {}

    /// True if a word went that had its like, or words came beside one that has.
    bool touches() {
        for (const DiffStep& step : diff(edit_.before, edit_.now)) {
            if (step.kind == DiffStep::Add) {
                gained_ = gained_ || counts(edit_.now, step.now, heads_.target);
            } else if (counts(edit_.before, step.before, heads_.source)) {
                const bool alike = are_apart_ ? laid_.has_like_clause(step.before) : laid_.has_like(step.before);
                if (step.kind == DiffStep::Remove && alike) return true;
                if (step.kind == DiffStep::Keep && ends_beside(alike)) return true;
            }
        }
        return ends_beside(false);
    }

private:
    static bool counts(const std::vector<std::string>& text, size_t i, size_t end_of_head) {
        return is_name_or_number(text[i]) || is_operator(text, i, end_of_head);
    }

    /// At a word that stayed, behind all that came since the last one that did.
    bool ends_beside(bool alike_behind) {
        const bool out = gained_ && (alike_before_ || alike_behind);
        gained_ = false;
        alike_before_ = alike_behind;
        return out;
    }

    const SideEdit& edit_;
    const SideBySide& laid_;
    BySide<size_t> heads_;  ///< of the text before, and now
    bool are_apart_;
    bool alike_before_ = false, gained_ = false;
};

/// The runtimes that a text calls, by what their functions begin with.
std::set<std::string> runtimes_of(const Words& text) {
    std::set<std::string> out;
    for (size_t i = 0; i + 1 < text.size(); ++i) {
        if (opens_launch(text, i)) out.emplace("cu");
        if (text[i + 1] == "(" && is_runtime_call(text[i])) out.emplace(text[i].substr(0, 2));
    }
    return out;
}

}  // namespace

bool touches_what_counts(LaidEdit& laid) {
    const LoneTexts& texts = laid.texts();
    return touches_guarded_words(laid.edit(), texts) ||
           pragmas_of(without_hints(texts.before)) != pragmas_of(without_hints(texts.now));
}

bool changes_launches(const LoneTexts& texts) {
    return launches_of(without_hints(texts.before)) != launches_of(without_hints(texts.now));
}

bool only_concerns_own_runtime(LaidEdit& laid) {
    const LoneTexts& texts = laid.texts();
    const std::set<std::string> own = runtimes_of(texts.now), others = runtimes_of(texts.other);
    const bool is_foreign = !own.empty() && std::none_of(own.begin(), own.end(), [&](const std::string& runtime) {
        return others.contains(runtime);
    });
    if (!is_foreign) return false;
    const SideEdit& edit = laid.edit();
    if (edit.size < kMeant || touches_what_counts(laid) || changes_launches(texts)) return false;
    const SideEdit& other = laid.other();
    size_t came = 0, known = 0;
    for (const std::string& word : edit.gained) {
        if (edit.lost.contains(word) || !is_word_token(word)) continue;
        ++came;
        known += other.has.contains(word) ? 1 : 0;
    }
    const bool any_went = std::any_of(edit.lost.begin(), edit.lost.end(), [&](const std::string& word) {
        const bool counts = is_word_token(word) || (is_number_token(word) && word != "0" && word != "1");
        return counts && !edit.gained.contains(word) && other.has.contains(word);
    });
    return came > 0 && 8 * known <= came && !any_went;
}

OffGround off_common_ground(LaidEdit& sides) {
    const LoneTexts& texts = sides.texts();
    const SideEdit& edit = sides.edit();
    if (edit.size < kLeastEdited || is_of_few_words(texts) || touches_what_counts(sides)) return OffGround::No;
    const SideEdit& other = sides.other();
    const EditedNames names(edit, other);
    const bool is_foreign = names.are_foreign();
    if (!is_foreign && edit.size < kLong) return OffGround::No;
    const bool is_plain = !changes_launches(texts);
    const OffGround by_names = is_plain && is_foreign && names.are_unheard_of() && !edit.guarded.contains("#")
                                   ? OffGround::Surely
                                   : OffGround::No;
    if (!sides.can_be_laid()) return by_names;
    const SideBySide& laid = sides.before();
    constexpr size_t kShort = 200;  // longer texts have some words in common, if they could be laid side by side
    if (laid.covered().empty() && edit.before.size() > kShort) return by_names;
    const bool is_apart = are_apart(edit, other, laid);
    if ((!is_foreign && !is_apart) || reorders_or_retunes(edit, is_apart)) return OffGround::No;
    if (GroundReader(edit, laid, is_apart).touches()) return OffGround::No;
    if (!is_plain || (!is_apart && edit.guarded.contains("#"))) return OffGround::Hardly;
    return edit.size < kMeant || !is_foreign ? OffGround::Perhaps : OffGround::Surely;
}

}  // namespace porttool
