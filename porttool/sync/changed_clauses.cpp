// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/changed_clauses.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>

#include "porttool/compare/runtime_calls.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/bare_declaration.h"
#include "porttool/sync/elsewhere_changes.h"
#include "porttool/sync/launch_manner.h"
#include "porttool/sync/operands.h"
#include "porttool/sync/renamings.h"
#include "porttool/sync/word_changes.h"

namespace porttool {
namespace {

constexpr double kSure = 0.45;  ///< clauses less alike may stand for something else

class ClauseChanger : EditReading {
public:
    ClauseChanger(const EditReading& reading, const InsertedUses& uses, Transplant& out)
        : EditReading(reading),
          uses_(uses),
          out_(out),
          words_(reading, uses, out),
          elsewhere_(reading, uses, out),
          renamings_(reading, uses) {}

    std::vector<WordsReplaced> run() {
        find_renamed();
        for (size_t c = 0; c < origin_.size(); ++c)
            if (origin_[c] != kNothing) change(origin_[c], c);
        leave_strange();
        renamings_.add_to(out_.replaced);
        return std::move(words_.respelled());
    }

private:
    void find_renamed() {
        for (size_t c = 0; c < origin_.size(); ++c) {
            if (origin_[c] == kNothing) continue;
            for (const Hunk& hunk : words_.hunks_of(before(origin_[c]), now(c)))
                if (hunk.is_word_for_word()) renamings_.note(hunk.first, hunk.now_first);
        }
    }

    bool is_renaming(const Hunk& hunk) const {
        return hunk.is_word_for_word() && renamings_.has(hunk.first, hunk.now_first);
    }

    void change(size_t was, size_t is) {
        const std::vector<Hunk> hunks = words_.hunks_of(before(was), now(is));
        if (std::all_of(hunks.begin(), hunks.end(), [&](const Hunk& hunk) { return is_renaming(hunk); })) return;
        const size_t there = counterpart(was);
        if (only_names_extents(was, is, there)) return;
        if (only_groups_names(was, is, there) || only_checks_status(was, is) ||
            (there != kNothing && was != 0 && texts_.across.likeness[was] < kSure && says_now(is, there))) {
            ++out_.already;
            return;
        }
        if (there != kNothing && is_said_more_often(was, there))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port says that in more places",
                         now(is).first, target(there).first);
        if (there != kNothing && returns_in_more_places(was))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port gives its value back in more places",
                         now(is).first, target(there).first);
        if (there != kNothing && is_in_other_loop(was, there))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port does that in another of its loops",
                         now(is).first, target(there).first);
        const bool asks_alike = there != kNothing && before(was).opens &&
                                comparisons(texts_.before, before(was)) == comparisons(texts_.target, target(there));
        if (there != kNothing && is_doubtful(asks_alike ? before(was).inside : was))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port's condition there is another one",
                         now(is).first, target(there).first);
        if (there == kNothing || texts_.across.likeness[was] < kSure || gives_another(was, there)) {
            if (there == kNothing &&
                (stands_in_target(is) || named_values_.only_name(texts_.now, now(is), texts_.before, before(was)))) {
                ++out_.already;
                return;
            }
            if (there != kNothing && was == 0) return words_.change_words(hunks, was, is, there);
            if ((there == kNothing && (elsewhere_.change_elsewhere(hunks, was) || elsewhere_.change_result(was, is))) ||
                elsewhere_.change_type(hunks, was) || elsewhere_.change_value(hunks, was))
                return;
            strange_.emplace_back(was, is);
            return;
        }
        if (const CarriedWords whole = carry_new(now(is).first, now(is).end);
            says(target(there).first, target(there).end, whole.words)) {
            if (words_.respells(hunks)) return words_.change_words(hunks, was, is, there);
            ++out_.already;
            return;
        }
        if (counts_to_other_end(was, there, hunks))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port's loop there runs to another end",
                         now(is).first, target(there).first);
        if (repeats_something_else(was, there))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port's loop there has nothing of what the source's has",
                         now(is).first, target(there).first);
        if (const std::string why = uses_.doubt_of_step(was); !why.empty())
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) + "`; " + why,
                         now(is).first, target(there).first);
        words_.change_words(hunks, was, is, there);
    }

    /// True for names that are declared together, or apart, as they were not before, where the port gives them a value
    /// at once, or does without.
    bool only_groups_names(size_t was, size_t is, size_t there) const {
        if (there != kNothing && bare_declaration(texts_.target, target(there))) return false;
        const auto old = bare_declaration(texts_.before, before(was)), fresh = bare_declaration(texts_.now, now(is));
        return old && fresh && declares_all(texts_.now, *old) && declares_all(texts_.before, *fresh);
    }

    /// True for a call of a run time whose status is looked at now, as it was not before, or in another way, where the
    /// port calls no run time that has one.
    bool only_checks_status(size_t was, size_t is) const {
        const Clause old = checked_call(texts_.before, before(was)), fresh = checked_call(texts_.now, now(is));
        const bool differs = old.size() != before(was).size() || fresh.size() != now(is).size();
        return differs && old.size() > 0 && is_runtime_call(texts_.before.words[old.first]) &&
               plain_call(texts_.before, old) == plain_call(texts_.now, fresh) &&
               std::none_of(texts_.target.words.begin(), texts_.target.words.end(),
                            [](const std::string& word) { return is_runtime_call(word); });
    }

    /// The call within `CHECK ( call ( a ) ) ;`; else the statement without its end.
    static Clause checked_call(const AlignedText& text, const Clause& clause) {
        Clause out = clause;
        if (clause.opens || clause.closes || clause.size() < 4 || text.words[clause.end - 1] != ";") {
            out.end = out.first;
            return out;
        }
        --out.end;
        if (says_that_it_checks(text.words[out.first]) && text.words[out.first + 1] == "(" &&
            closing_bracket(text.words, out.first + 1, out.end) == out.end - 1)
            out.first += 2, --out.end;
        return out;
    }

    /// A call without casts to `void * *`, which change nothing that it gets.
    static std::vector<std::string> plain_call(const AlignedText& text, const Clause& clause) {
        std::vector<std::string> out;
        constexpr std::array<std::string_view, 5> kCast = {"(", "void", "*", "*", ")"};
        for (size_t i = clause.first; i < clause.end; ++i)
            if (i + kCast.size() <= clause.end &&
                std::equal(kCast.begin(), kCast.end(), text.words.begin() + static_cast<std::ptrdiff_t>(i)))
                i += kCast.size() - 1;
            else
                out.push_back(text.words[i]);
        return out;
    }

    /// True for statements that speak to people alone, of which a port without them owes nothing for sure.
    bool only_speaks(size_t was, size_t is) const {
        return speaks_to_people(texts_.before, before(was)) && speaks_to_people(texts_.now, now(is));
    }

    /// True for a launch that is written in another form, or says how many threads it is for with `dim3 ( n )` or with
    /// `n`, as it did not before, of which the port says nothing.
    bool only_names_extents(size_t was, size_t is, size_t there) const {
        const std::vector<std::string>& words = texts_.before.words;
        const Clause &old = before(was), &clause = now(is);
        const auto launch_of = [](const AlignedText& text, const Clause& one) {
            return launch_in_one_form(text.words, one.first, one.end);
        };
        if (const auto launch = launch_of(texts_.before, old); launch && launch == launch_of(texts_.now, clause))
            if (there == kNothing || !launch_of(texts_.target, target(there))) return true;
        const auto says_extent = [](const std::vector<std::string>& text, const Clause& one) {
            return std::find(text.begin() + static_cast<std::ptrdiff_t>(one.first),
                             text.begin() + static_cast<std::ptrdiff_t>(one.end),
                             "dim3") != text.begin() + static_cast<std::ptrdiff_t>(one.end);
        };
        return (says_extent(words, old) || says_extent(texts_.now.words, clause)) &&
               (there == kNothing || !says_extent(texts_.target.words, target(there))) &&
               with_plain_extents(words, old.first, old.end) ==
                   with_plain_extents(texts_.now.words, clause.first, clause.end);
    }

    /// True for a loop that counts in another type or from another value, and whose counterpart asks for another end:
    /// that may be another loop.
    bool counts_to_other_end(size_t was, size_t there, const std::vector<Hunk>& hunks) const {
        const Clause here = condition_of(texts_.before.words, before(was)),
                     other = condition_of(texts_.target.words, target(there));
        if (here.size() == 0 || other.size() == 0 || hunks.empty() || hunks.back().end > here.first) return false;
        const auto has_there = [&](const std::string& word) {
            return is_name(word) &&
                   std::find(texts_.target.words.begin(), texts_.target.words.end(), word) != texts_.target.words.end();
        };
        for (size_t k = 0; k < std::min(here.size(), other.size()); ++k) {
            const std::string& word = texts_.before.words[here.first + k];
            if (word != texts_.target.words[other.first + k] && has_there(word)) return true;
        }
        return !says(other.first, other.end, carry_old(here.first, here.end).words, true);
    }

    /// True where one of the two stands in a loop that both have, and the other outside of it: they are not done as
    /// often.
    bool is_in_other_loop(size_t was, size_t there) const {
        const auto loops = [](const std::string& head) { return head == "for" || head == "while"; };
        std::set<size_t> around;  // loops of the port that stand for those around the source's statement
        for (size_t c = before(was).inside; c != Clause::kNone; c = before(c).inside)
            if (loops(texts_.before.words[before(c).first]) && counterpart(c) != kNothing)
                around.insert(counterpart(c));
        for (size_t c = target(there).inside; c != Clause::kNone; c = target(c).inside) {
            if (!loops(texts_.target.words[target(c).first]) || around.erase(c) > 0) continue;
            if (stands_for_something(c)) return true;
        }
        return !around.empty();
    }

    /// True for a loop of which nothing within has its counterpart within the port's: that may be another loop.
    bool repeats_something_else(size_t was, size_t there) const {
        constexpr double kSameWork = 0.7;  // `use ( a [ i ] ) ;` resembles `sum += a [ i ] ;` by 0.6
        const Clause &here = before(was), &other = target(there);
        const std::string& head = texts_.before.words[here.first];
        if ((head != "for" && head != "while") || !here.opens || here.partner == Clause::kNone) return false;
        if (other.partner == Clause::kNone) return false;
        // What a device is handed a port may call, or have in a block of its own.
        const std::vector<Launch> launches = launches_in(texts_.before);
        const auto is_launched = [&](size_t c) {
            return std::any_of(launches.begin(), launches.end(),
                               [&](const Launch& one) { return one.first <= c && c <= one.last; });
        };
        bool any = false;
        for (size_t c = was + 1; c < here.partner; ++c) {
            const size_t stands = counterpart(c);
            const bool is_sure = before(c).opens || texts_.across.likeness[c] >= kSameWork;
            if (stands != kNothing && is_sure && there < stands && stands < other.partner) return false;
            if (is_launched(c)) return false;
            any |= !before(c).closes;
        }
        return any;
    }

    /// The second part of `for ( a ; b ; c )`; empty for none.
    static Clause condition_of(const std::vector<std::string>& words, const Clause& clause) {
        Clause out;
        if (words[clause.first] != "for") return out;
        const auto end = words.begin() + static_cast<std::ptrdiff_t>(clause.end);
        const auto first = std::find(words.begin() + static_cast<std::ptrdiff_t>(clause.first), end, ";");
        if (first == end) return out;
        out.first = static_cast<size_t>(first - words.begin()) + 1;
        out.end = static_cast<size_t>(std::find(first + 1, end, ";") - words.begin());
        return out;
    }

    /// Statements that changed side by side, and that the port has nothing for at one place, are one item.
    void leave_strange() {
        for (size_t i = 0; i < strange_.size();) {
            const auto [was, is] = strange_[i];
            const auto [there, is_alike] = place_of_strange(was, is);
            size_t end = i + 1;
            while (end < strange_.size() && strange_[end].second <= strange_[end - 1].second + 2 &&
                   place_of_strange(strange_[end].first, strange_[end].second).word == there)
                ++end;
            const auto [last_was, last_is] = strange_[end - 1];
            leave("the port has nothing that clearly stands for `" +
                      shown(texts_.before.words, before(was).first, before(last_was).end) + "`, which became `" +
                      shown(texts_.now.words, now(is).first, now(last_is).end) + "`",
                  now(is).first, there);
            out_.left.back().statements = end - i;
            out_.left.back().is_sure =
                is_alike && !std::all_of(strange_.begin() + static_cast<std::ptrdiff_t>(i),
                                         strange_.begin() + static_cast<std::ptrdiff_t>(end),
                                         [&](const auto& one) { return only_speaks(one.first, one.second); });
            i = end;
        }
    }

    /// Where the port has another statement that changed in the same words; else what resembles this one.
    Nearby place_of_strange(size_t was, size_t is) const {
        const auto distance = [&](size_t other) { return other > is ? other - is : is - other; };
        const std::string edit = edit_of(was, is);
        size_t best = kNothing;
        for (size_t c = 0; c < origin_.size(); ++c)
            if (origin_[c] != kNothing && counterpart(origin_[c]) != kNothing && edit_of(origin_[c], c) == edit &&
                (best == kNothing || distance(c) < distance(best)))
                best = c;
        return best == kNothing ? near(was) : Nearby{target(counterpart(origin_[best])).first};
    }

    /// The words that went from a clause and came to it; those of a renaming are not told.
    std::string edit_of(size_t was, size_t is) const {
        std::string out;
        for (const Hunk& hunk : words_.hunks_of(before(was), now(is))) {
            if (is_renaming(hunk)) continue;
            for (size_t i = hunk.first; i < hunk.end; ++i) out += texts_.before.words[i] + ' ';
            out += '\n';
            for (size_t i = hunk.now_first; i < hunk.now_end; ++i) out += texts_.now.words[i] + ' ';
            out += '\n';
        }
        return out;
    }

    /// True for a `return` of a value where the target has more of them than the source.
    bool returns_in_more_places(size_t was) const {
        const auto returns = [](const AlignedText& text, const Clause& clause) {
            return text.words[clause.first] == "return" && clause.size() > 2;
        };
        const auto count = [&](const AlignedText& text) {
            return std::count_if(text.clauses.begin(), text.clauses.end(),
                                 [&](const Clause& clause) { return returns(text, clause); });
        };
        return returns(texts_.before, before(was)) && count(texts_.target) > count(texts_.before);
    }

    /// True where the target's statement writes another variable, and resembles the source's no more than any may.
    bool gives_another(size_t was, size_t there) const {
        constexpr double kSame = 0.8;
        const auto written_at = [](const std::vector<std::string>& words, const Clause& clause) {
            size_t i = clause.first;
            while (i < clause.end && words[i] != "=" && words[i] != "(" && words[i] != "[") ++i;
            return i < clause.end && words[i] == "=" && i > clause.first ? i - 1 : kNothing;
        };
        if (texts_.across.likeness[was] >= kSame) return false;
        const size_t here = written_at(texts_.before.words, before(was));
        const size_t other = written_at(texts_.target.words, target(there));
        if (here == kNothing || other == kNothing || texts_.before.words[here] == texts_.target.words[other])
            return false;
        const std::vector<CarriedWord> said = carry_old(here, here + 1).words;
        return said.empty() || said.back().text != texts_.target.words[other];
    }

    /// True if a clause of the target says what the source says now, word for word.
    bool says_now(size_t is, size_t there) const {
        return says(target(there).first, target(there).end, carry_new(now(is).first, now(is).end).words);
    }

    /// True if the target has a clause like that of the source's new text which stands for none of its old one.
    bool stands_in_target(size_t is) const {
        const CarriedWords words = carry_new(now(is).first, now(is).end);
        for (const Clause& clause : texts_.target.clauses)
            if (says(clause.first, clause.end, words.words)) return true;
        return false;
    }

    void leave(std::string message, size_t source_word, size_t target_word) {
        out_.left.push_back({std::move(message), source_word, target_word});
    }

    const InsertedUses& uses_;
    Transplant& out_;
    WordChanger words_;
    ElsewhereChanger elsewhere_;
    Renamings renamings_;
    std::vector<std::pair<size_t, size_t>> strange_;  ///< clauses that changed without a counterpart: before, and now
};

}  // namespace

std::vector<WordsReplaced> carry_changed_clauses(const EditReading& reading, const InsertedUses& uses,
                                                 Transplant& out) {
    return ClauseChanger(reading, uses, out).run();
}

}  // namespace porttool
