// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/changed_clauses.h"

#include <algorithm>
#include <iterator>
#include <optional>

#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"
#include "porttool/sync/renamings.h"

namespace porttool {
namespace {

constexpr double kSure = 0.45;  ///< clauses less alike may stand for something else

/// A run of words that the edit took away, and the run that came in its place.
struct Hunk {
    size_t first = 0, end = 0;          ///< before
    size_t now_first = 0, now_end = 0;  ///< now
};

class ClauseChanger : EditReading {
public:
    ClauseChanger(const EditReading& reading, const InsertedUses& uses, Transplant& out)
        : EditReading(reading), uses_(uses), out_(out), renamings_(reading, uses) {}

    std::vector<WordsReplaced> run() {
        find_renamed();
        for (size_t c = 0; c < origin_.size(); ++c)
            if (origin_[c] != kNothing) change(origin_[c], c);
        leave_strange();
        renamings_.add_to(out_.replaced);
        return std::move(respelled_);
    }

private:
    static bool is_word_for_word(const Hunk& hunk) {
        return hunk.end == hunk.first + 1 && hunk.now_end == hunk.now_first + 1;
    }

    void find_renamed() {
        for (size_t c = 0; c < origin_.size(); ++c) {
            if (origin_[c] == kNothing) continue;
            for (const Hunk& hunk : hunks_of(before(origin_[c]), now(c)))
                if (is_word_for_word(hunk)) renamings_.note(hunk.first, hunk.now_first);
        }
    }

    bool is_renaming(const Hunk& hunk) const {
        return is_word_for_word(hunk) && renamings_.has(hunk.first, hunk.now_first);
    }

    void change(size_t was, size_t is) {
        const std::vector<Hunk> hunks = hunks_of(before(was), now(is));
        if (std::all_of(hunks.begin(), hunks.end(), [&](const Hunk& hunk) { return is_renaming(hunk); })) return;
        const size_t there = counterpart(was);
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
        const bool asks_alike = there != kNothing && before(was).opens &&
                                comparisons(texts_.before, before(was)) == comparisons(texts_.target, target(there));
        if (there != kNothing && is_doubtful(asks_alike ? before(was).inside : was))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port's condition there is another one",
                         now(is).first, target(there).first);
        if (there == kNothing || texts_.across.likeness[was] < kSure || gives_another(was, there)) {
            if (there == kNothing && stands_in_target(is)) {
                ++out_.already;
                return;
            }
            if (there != kNothing && was == 0) return change_words(hunks, was, is, there);
            if ((there == kNothing && (change_elsewhere(hunks, was) || change_result(was, is))) ||
                change_type(hunks, was) || change_value(hunks, was))
                return;
            strange_.emplace_back(was, is);
            return;
        }
        if (const CarriedWords whole = carry_new(now(is).first, now(is).end);
            says(target(there).first, target(there).end, whole.words)) {
            ++out_.already;
            return;
        }
        if (const std::string why = uses_.doubt_of_step(was); !why.empty())
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) + "`; " + why,
                         now(is).first, target(there).first);
        change_words(hunks, was, is, there);
    }

    /// Statements that changed side by side, and that the port has nothing for at one place, are one item.
    void leave_strange() {
        for (size_t i = 0; i < strange_.size();) {
            const auto [was, is] = strange_[i];
            const size_t there = near(was);
            size_t end = i + 1;
            while (end < strange_.size() && strange_[end].second <= strange_[end - 1].second + 2 &&
                   near(strange_[end].first) == there)
                ++end;
            const auto [last_was, last_is] = strange_[end - 1];
            leave("the port has nothing that clearly stands for `" +
                      shown(texts_.before.words, before(was).first, before(last_was).end) + "`, which became `" +
                      shown(texts_.now.words, now(is).first, now(last_is).end) + "`",
                  now(is).first, there);
            out_.left.back().statements = end - i;
            i = end;
        }
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

    /// The port may have the statement at another place.
    bool change_elsewhere(const std::vector<Hunk>& hunks, size_t was) {
        const std::optional<size_t> there = only_statement(was);
        return there && change_there(hunks, before(was).first, target(*there).first);
    }

    /// What both sides give back is the same, however they come to it: `return f ( a ) ;` that became
    /// `return 0.5 * f ( a ) ;` makes `return 0.5f * sum ;` of the port's `return sum ;`.
    bool change_result(size_t was, size_t is) {
        const std::optional<size_t> there = only_result(texts_.target);
        if (only_result(texts_.before) != was || !there || stands_for_something(*there)) return false;
        const Clause old = value_of(texts_.before.words, before(was)), made = value_of(texts_.now.words, now(is));
        const Clause port = value_of(texts_.target.words, target(*there));
        if (made.size() <= old.size() || !is_operand(texts_.before.words, old.first, old.end) || port.size() == 0)
            return false;
        const auto word = [](const AlignedText& text, size_t i) {
            return text.exact.begin() + static_cast<std::ptrdiff_t>(i);
        };
        const auto found = std::search(word(texts_.now, made.first), word(texts_.now, made.end),
                                       word(texts_.before, old.first), word(texts_.before, old.end));
        if (found == word(texts_.now, made.end)) return false;
        const size_t at = static_cast<size_t>(found - texts_.now.exact.begin());
        const size_t after = at + old.size();
        if (at > made.first && is_accessor(texts_.now.words[at - 1])) return false;
        if (after < made.end && goes_on(texts_.now.words[after])) return false;
        CarriedWords front = carry_new(made.first, at);
        const CarriedWords back = carry_new(after, made.end);
        if (!front.unknown.empty() || !back.unknown.empty()) return false;
        if (!uses_.doubt_within(front.words, at, port.first).empty() ||
            !uses_.doubt_within(back.words, made.end, port.first).empty())
            return false;
        const bool bare = is_operand(texts_.target.words, port.first, port.end);
        if (!bare) front.words.push_back({"(", CarriedWord::kNoSource});
        for (size_t i = port.first; i < port.end; ++i)
            front.words.push_back({written_number(texts_.target.words[i]), CarriedWord::kNoSource});
        if (!bare) front.words.push_back({")", CarriedWord::kNoSource});
        front.words.insert(front.words.end(), back.words.begin(), back.words.end());
        out_.replaced.push_back({port.first, port.end, std::move(front.words), made.first, made.end});
        return true;
    }

    /// The port may have the value of a clause in one of another kind, `out [ k ] = E ;` for `return E ;`: there each
    /// word stands for its like. Once on both sides, or it may be another.
    bool change_value(const std::vector<Hunk>& hunks, size_t was) {
        constexpr size_t kShortest = 7;
        const Clause value = value_of(texts_.before.words, before(was)), named = with_name(value, before(was));
        if (value.size() == 0 || hunks.front().first < value.first || hunks.back().end > value.end) return false;
        if (named.first < value.first)
            if (const std::optional<size_t> at = only_counterpart(named); at && ends_there(*at, named.size()))
                return change_there(hunks, named.first, *at);
        const std::optional<size_t> at = value.size() < kShortest ? std::nullopt : only_counterpart(value);
        return at && change_there(hunks, value.first, *at);
    }

    /// What stands from `at` on in the target stands for what stands from `first` on: each word for its like.
    bool change_there(const std::vector<Hunk>& hunks, size_t first, size_t at) {
        const size_t made = out_.replaced.size();
        for (const Hunk& hunk : hunks) {
            const CarriedWords words = carry_new(hunk.now_first, hunk.now_end);
            const size_t place = at + (hunk.first - first);
            if (!words.unknown.empty() || !uses_.doubt_within(words.words, hunk.now_end, place).empty()) {
                out_.replaced.resize(made);
                return false;
            }
            out_.replaced.push_back({place, at + (hunk.end - first), words.words, hunk.now_first, hunk.now_end});
        }
        return true;
    }

    /// The value with the name that it is given to, `most = 0` of `float most = 0 ;`, which the port may have in a
    /// declaration of several, `float e , most = 0 ;`; else the value alone.
    Clause with_name(Clause value, const Clause& clause) const {
        const std::vector<std::string>& words = texts_.before.words;
        const bool named = value.first >= clause.first + 3 && words[value.first - 1] == "=" &&
                           is_name(words[value.first - 2]) && is_word_token(words[value.first - 3]);
        if (named) value.first -= 2;
        return value;
    }

    /// True if `size` words of the target are a whole name with its whole value.
    bool ends_there(size_t at, size_t size) const {
        const std::vector<std::string>& words = texts_.target.words;
        return at > 0 && at + size < words.size() && !is_accessor(words[at - 1]) &&
               (words[at + size] == ";" || words[at + size] == ",");
    }

    /// `int i = get_id ( 0 ) ;` that became `long i = ...` makes a `long` of the port's `int i`, whatever that is.
    bool change_type(const std::vector<Hunk>& hunks, size_t was) {
        const Clause& here = before(was);
        const auto declares_at = [](const std::vector<std::string>& words, const Clause& clause) {
            size_t i = clause.first;
            while (i + 1 < clause.end && is_word_token(words[i]) && words[i + 1] != "=") ++i;
            return i > clause.first && i + 1 < clause.end && words[i + 1] == "=" ? i : kNothing;
        };
        const size_t name = declares_at(texts_.before.words, here);
        if (name == kNothing || hunks.size() != 1 || hunks.back().end > name) return false;
        const CarriedWords said = carry_old(here.first, name + 1);
        const CarriedWords made = carry_new(hunks[0].now_first, hunks[0].now_end);
        if (!said.unknown.empty() || !made.unknown.empty() || said.words.size() != name + 1 - here.first) return false;
        std::optional<size_t> place;
        for (const Clause& clause : texts_.target.clauses) {
            const size_t there = declares_at(texts_.target.words, clause);
            if (there == kNothing || !says(clause.first, there + 1, said.words)) continue;
            if (place) return false;
            place = clause.first;
        }
        if (!place) return false;
        out_.replaced.push_back({*place + (hunks[0].first - here.first), *place + (hunks[0].end - here.first),
                                 made.words, hunks[0].now_first, hunks[0].now_end});
        return true;
    }

    /// True if the target has a clause like that of the source's new text which stands for none of its old one.
    bool stands_in_target(size_t is) const {
        const CarriedWords words = carry_new(now(is).first, now(is).end);
        for (const Clause& clause : texts_.target.clauses)
            if (says(clause.first, clause.end, words.words)) return true;
        return false;
    }

    /// A clause is changed as a whole or not at all.
    void change_words(const std::vector<Hunk>& hunks, size_t was, size_t is, size_t there) {
        const size_t made = out_.replaced.size(), left = out_.left.size(), spelled = respelled_.size();
        for (const Hunk& hunk : hunks) change_run(hunk, was, there);
        if (out_.replaced.size() > made) take_spellings(hunks, spelled);
        if (out_.left.size() > left) return out_.replaced.resize(made);
        // Where the target says the clause word for word it has to say the new one so, too.
        const Clause& other = target(there);
        if (out_.replaced.size() == made || was == 0 ||
            !says(other.first, other.end, carry_old(before(was).first, before(was).end).words))
            return;
        const CarriedWords now_said = carry_new(now(is).first, now(is).end);
        if (!now_said.unknown.empty() || result_of(other, made) == texts_of(now_said.words)) return;
        if (!uses_.doubt_within(now_said.words, now(is).end, other.first).empty()) return;
        out_.replaced.resize(made);
        out_.replaced.push_back({target(there).first, target(there).end, now_said.words, now(is).first, now(is).end});
    }

    /// A clause of the target with what replaces words of it, from the `made`-th replacement on.
    std::vector<std::string> result_of(const Clause& clause, size_t made) const {
        std::vector<WordsReplaced> edits(out_.replaced.begin() + static_cast<std::ptrdiff_t>(made),
                                         out_.replaced.end());
        std::sort(edits.begin(), edits.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<std::string> out;
        size_t at = clause.first;
        const auto copy_to = [&](size_t end) {
            for (; at < end; ++at) out.push_back(texts_.target.words[at]);
        };
        for (const WordsReplaced& edit : edits) {
            copy_to(edit.first);
            for (std::string& word : texts_of(edit.words)) out.push_back(std::move(word));
            at = std::max(at, edit.end);
        }
        copy_to(clause.end);
        return out;
    }

    std::vector<Hunk> hunks_of(const Clause& was, const Clause& is) const {
        std::vector<Hunk> out;
        const auto kept = [&](size_t i) {
            const size_t k = texts_.edit.word_of[i];
            return k != kNothing && texts_.before.exact[i] == texts_.now.exact[k];
        };
        size_t i = was.first, k = is.first;
        while (i < was.end || k < is.end) {
            if (i < was.end && kept(i) && texts_.edit.word_of[i] == k) {
                ++i, ++k;
                continue;
            }
            Hunk hunk{i, i, k, k};
            while (hunk.end < was.end && !kept(hunk.end)) ++hunk.end;
            hunk.now_end = hunk.end < was.end ? texts_.edit.word_of[hunk.end] : is.end;
            out.push_back(hunk);
            i = hunk.end;
            k = hunk.now_end;
        }
        return out;
    }

    void change_run(Hunk hunk, size_t was, size_t there) {
        if (was == 0 && loses_way_out(hunk))
            return leave_run(hunk, target(there).first, "nothing tells how the port hands a value back so");
        if (is_neutral(hunk)) return respell(hunk);
        if (hunk.first == hunk.end ? insert_run(hunk, was, there) : replace_run(hunk) || drop_elements(hunk)) return;
        const Clause &here = before(was), &other = target(there);
        // Out to words that stand for words of the target.
        while (hunk.first > here.first && word_of(hunk.first - 1) == kNothing) --hunk.first, --hunk.now_first;
        while (hunk.end < here.end && word_of(hunk.end) == kNothing) ++hunk.end, ++hunk.now_end;
        const size_t first = hunk.first == here.first ? other.first : word_of(hunk.first - 1) + 1;
        const size_t end = hunk.end == here.end ? other.end : word_of(hunk.end);
        const CarriedWords now = carry_new(hunk.now_first, hunk.now_end);
        if (end < first) return leave_run(hunk, first, "its neighbours stand in another order there");
        if (says(first, end, now.words) && !(now.words.empty() && first == end && hunk.first != hunk.end)) {
            ++out_.already;
            return;
        }
        if (hunk.first == hunk.end && first != end)
            return leave_run(hunk, first, "the port has words of its own there");
        if (!says(first, end, carry_old(hunk.first, hunk.end).words, true) && !is_name_alone(hunk, first, end))
            return leave_run(hunk, first,
                             "the port says `" + shown(texts_.target.words, first, end) + "` there, not `" +
                                 shown(texts_.before.words, hunk.first, hunk.end) + "`");
        put(hunk, first, end, now);
    }

    void put(const Hunk& hunk, size_t first, size_t end, const CarriedWords& now) {
        // The scope that a name is taken from stays: `Light :: kSun` for `kSun`.
        if (hunk.end == hunk.first + 1 && !now.unknown.empty() && end > first + 2 &&
            texts_.target.words[end - 2] == "::" && texts_.target.words[end - 1] == texts_.before.words[hunk.first])
            first = end - 1;
        if (!now.unknown.empty() && !is_renamed_elsewhere(hunk, first, end))
            return leave_run(hunk, first, "nothing tells how the port says " + listed(now.unknown));
        if (hunk.end == hunk.first + 1 && hunk.now_end == hunk.now_first + 1 && end == first + 1 &&
            !uses_.is_local(hunk.now_first) &&
            translator_.declares_alone(texts_.target.words[first], texts_.now.words[hunk.now_first]))
            return leave_run(hunk, first, "the port declares `" + texts_.target.words[first] + "` itself");
        if (const std::string name = indexed_otherwise(now.words); !name.empty())
            return leave_run(hunk, first, "the port has `" + name + "` with other indices");
        if (const std::string why = uses_.doubt_within(now.words, hunk.now_end, first); !why.empty())
            return leave_run(hunk, first, why);
        out_.replaced.push_back({first, end, now.words, hunk.now_first, hunk.now_end});
    }

    /// True for words of a head that hand a value back, where what the port would have of them does not.
    bool loses_way_out(const Hunk& hunk) const {
        const auto hands_back = [](const std::string& word) { return word == "out" || word == "inout"; };
        const auto first = texts_.now.words.begin() + static_cast<std::ptrdiff_t>(hunk.now_first);
        const auto end = texts_.now.words.begin() + static_cast<std::ptrdiff_t>(hunk.now_end);
        const std::vector<std::string> said = texts_of(carry_new(hunk.now_first, hunk.now_end).words);
        const auto says_one_of = [&](std::initializer_list<std::string_view> words) {
            return std::any_of(said.begin(), said.end(), [&](const std::string& word) {
                return std::find(words.begin(), words.end(), word) != words.end();
            });
        };
        if (translator_.lacks_references() && says_one_of({"&"})) return true;
        return std::any_of(first, end, hands_back) && !says_one_of({"&", "*"}) && !translator_.lacks_references();
    }

    /// True where both sides have one name, of a function or of a value, which neither declares, and the source has a
    /// new one throughout: what both have from elsewhere was renamed there.
    bool is_renamed_elsewhere(const Hunk& hunk, size_t first, size_t end) const {
        if (hunk.end != hunk.first + 1 || hunk.now_end != hunk.now_first + 1 || end != first + 1) return false;
        const std::string &was = texts_.before.words[hunk.first], &is = texts_.now.words[hunk.now_first];
        if (texts_.target.words[first] != was || !translator_.is_from_elsewhere(was, is)) return false;
        if (uses_.is_local_there(first)) return false;  // the other side may have it as a field, the port has its own
        const auto is_called = [](const std::vector<std::string>& words, size_t i) {
            return i + 3 < words.size() && (words[i + 1] == "(" || (words[i + 1] == "<" && words[i + 2] == "<"));
        };
        const std::vector<std::string>& words = texts_.now.words;
        return is_called(words, hunk.now_first) == is_called(texts_.target.words, first) &&
               std::find(words.begin(), words.end(), was) == words.end();
    }

    /// Words that each stand for one of the target's are replaced there, whatever stands around these.
    bool replace_run(const Hunk& hunk) {
        const size_t first = word_of(hunk.first);
        for (size_t i = hunk.first; i < hunk.end; ++i)
            if (word_of(i) == kNothing || word_of(i) != first + (i - hunk.first)) return false;
        const size_t end = first + (hunk.end - hunk.first);
        if (has_own_prefix(hunk.first, first)) return false;
        bool lists = false;
        for (size_t i = hunk.first; i < hunk.end; ++i) lists |= texts_.before.words[i] == ",";
        if ((lists || hunk.now_first == hunk.now_end) && !stands_between_counterparts(hunk, first, end)) return false;
        if (!says(first, end, carry_old(hunk.first, hunk.end).words, true) && !is_name_alone(hunk, first, end))
            return false;
        const CarriedWords now = carry_new(hunk.now_first, hunk.now_end);
        if (says(first, end, now.words))
            ++out_.already;
        else
            put(hunk, first, end, now);
        return true;
    }

    /// Arguments or parameters that go, with a comma on one side, go from wherever the target has just these: what
    /// follows them there may be its own.
    bool drop_elements(const Hunk& hunk) {
        if (hunk.now_first != hunk.now_end) return false;
        size_t first = hunk.first, end = hunk.end;
        if (texts_.before.words[end - 1] == ",")
            --end;
        else if (texts_.before.words[first] == ",")
            ++first;
        else
            return false;
        if (first == end || word_of(first) == kNothing) return false;
        size_t there = word_of(first), there_end = there + (end - first);
        for (size_t i = first; i < end; ++i)
            if (word_of(i) != there + (i - first)) return false;
        const std::vector<std::string>& words = texts_.target.words;
        if (there == 0 || there_end >= words.size() || !says(there, there_end, carry_old(first, end).words, true))
            return false;
        const bool opens = words[there - 1] == "(", closes = words[there_end] == ")";
        if ((!opens && words[there - 1] != ",") || (!closes && words[there_end] != ",")) return false;
        if (!closes)
            ++there_end;
        else if (!opens)
            --there;
        out_.replaced.push_back({there, there_end, {}, hunk.now_first, hunk.now_end});
        return true;
    }

    /// True if a word of the source and the one that stands for it are of a kind: both names, or the same.
    bool says_alike(size_t i) const {
        const std::string &here = texts_.before.words[i], &there = texts_.target.words[word_of(i)];
        if (is_word_token(here)) return is_word_token(there);
        if (is_number_token(here)) return is_number_token(there) && number_value(here) == number_value(there);
        return here == there || texts_.before.common[i] == texts_.target.common[word_of(i)] || here == "." ||
               here == "->";
    }

    /// True where the target picks the word of something that the source does not name: `std :: max` for `max`.
    bool has_own_prefix(size_t i, size_t there) const {
        const auto picks = [](const std::vector<std::string>& words, size_t at) {
            return at > 0 && (words[at - 1] == "::" || words[at - 1] == "." || words[at - 1] == "->");
        };
        return picks(texts_.target.words, there) && !picks(texts_.before.words, i);
    }

    /// True if nothing of the target's own stands beside words that are taken away: they may belong together there.
    bool stands_between_counterparts(const Hunk& hunk, size_t first, size_t end) const {
        const bool left = hunk.first > 0 && first > 0 && word_of(hunk.first - 1) == first - 1;
        return left && hunk.end < texts_.before.words.size() && word_of(hunk.end) == end;
    }

    /// Where a word of the target begins with the scope that it is called in: `std` of `std :: sqrt`, not before
    /// `first`.
    size_t before_scope(size_t first, size_t word) const {
        while (word >= first + 2 && texts_.target.words[word - 1] == "::" &&
               is_word_token(texts_.target.words[word - 2]))
            word -= 2;
        return word;
    }

    /// New words go between the nearest words that stand for some of the target's, if it has nothing of its own there.
    /// Else an argument goes beside the one that it stands beside in the source.
    bool insert_run(const Hunk& hunk, size_t was, size_t there) {
        const Clause &here = before(was), &other = target(there);
        size_t left = hunk.first, right = hunk.first;
        while (left > here.first && word_of(left - 1) == kNothing) --left;
        while (right < here.end && word_of(right) == kNothing) ++right;
        const size_t first = left == here.first ? other.first : word_of(left - 1) + 1;
        const size_t end = right == here.end ? other.end : before_scope(first, word_of(right));
        if (end < first) return false;
        if ((left > here.first && !says_alike(left - 1)) || (right < here.end && !says_alike(right))) {
            leave_run(hunk, first, "the port says something else beside it");
            return true;
        }
        const CarriedWords now = carry_new(hunk.now_first, hunk.now_end);
        if (says(first, end, now.words)) {
            ++out_.already;
            return true;
        }
        const std::vector<std::string>& words = texts_.now.words;
        size_t place = first;
        if (first != end) {
            const bool after_left = left == hunk.first && words[hunk.now_first] == ",";
            const bool before_right = right == hunk.first && words[hunk.now_end - 1] == ",";
            const bool before_operand = left == hunk.first && right == hunk.first &&
                                        is_path(texts_.target.words, first, end) &&
                                        !is_accessor(words[hunk.now_end - 1]);
            if (after_left == before_right && !before_operand) return false;
            place = after_left || before_operand ? first : end;
        } else if (left != hunk.first && right != hunk.first) {
            return false;
        }
        put(hunk, place, place, now);
        return true;
    }

    /// True for an edit of words that have no counterpart on the other side, or mean the same there: scopes, address
    /// spaces, spellings.
    bool is_neutral(const Hunk& hunk) const {
        if (translator_.are_qualifiers(texts_.before.words, hunk.first, hunk.end) &&
            translator_.are_qualifiers(texts_.now.words, hunk.now_first, hunk.now_end))
            return false;  // beside what is due the port gets them, too
        return translator_.meaning(texts_.before.words, hunk.first, hunk.end) ==
               translator_.meaning(texts_.now.words, hunk.now_first, hunk.now_end);
    }

    /// Beside what changes in a clause a new spelling is due as well: `atan ( y / x )` that became `atan2 ( y , x )`
    /// is no `atan ( y , x )`, though both names mean the same.
    void take_spellings(const std::vector<Hunk>& hunks, size_t first_spelling) {
        for (const Hunk& hunk : hunks) {
            if (!is_neutral(hunk) || !is_spelled_alike(hunk)) continue;
            const size_t place = word_of(hunk.first);
            const bool known =
                std::any_of(respelled_.begin() + static_cast<std::ptrdiff_t>(first_spelling), respelled_.end(),
                            [&](const WordsReplaced& spelling) { return spelling.first == place; });
            if (!known) leave_run(hunk, place, "nothing tells how the port spells that");
        }
        std::move(respelled_.begin() + static_cast<std::ptrdiff_t>(first_spelling), respelled_.end(),
                  std::back_inserter(out_.replaced));
        respelled_.resize(first_spelling);
    }

    /// True if the target spells the words that went as the source did.
    bool is_spelled_alike(const Hunk& hunk) const {
        if (hunk.first == hunk.end || hunk.now_first == hunk.now_end) return false;
        const size_t first = word_of(hunk.first);
        for (size_t i = hunk.first; i < hunk.end; ++i)
            if (first == kNothing || word_of(i) != first + (i - hunk.first) ||
                texts_.target.words[word_of(i)] != texts_.before.words[i])
                return false;
        return true;
    }

    /// A neutral edit of words that the target spells as the source did.
    void respell(const Hunk& hunk) {
        if (hunk.first == hunk.end) return put_scope(hunk);
        if (!is_spelled_alike(hunk)) return;
        const size_t first = word_of(hunk.first), size = hunk.end - hunk.first;
        CarriedWords now = carry_new(hunk.now_first, hunk.now_end);
        if (!now.unknown.empty() || marks_otherwise(hunk)) return;
        now.words.clear();
        for (size_t i = hunk.now_first; i < hunk.now_end; ++i) now.words.push_back({written_(i), i});
        respelled_.push_back({first, first + size, std::move(now.words), hunk.now_first, hunk.now_end});
    }

    /// True for numbers of which one has a mark of its type and the other has none: the target has its own manner.
    bool marks_otherwise(const Hunk& hunk) const {
        if (!is_word_for_word(hunk) || !is_number_token(texts_.before.words[hunk.first])) return false;
        const auto is_marked = [](const std::string& number) { return number.ends_with('f') || number.ends_with('F'); };
        return is_marked(texts_.before.words[hunk.first]) != is_marked(texts_.now.words[hunk.now_first]);
    }

    /// `std :: min` for `min` that the target spells as the source did.
    void put_scope(const Hunk& hunk) {
        const size_t name = hunk.first, there = name < texts_.before.words.size() ? word_of(name) : kNothing;
        if (hunk.now_first == hunk.now_end || texts_.now.words[hunk.now_end - 1] != "::" || there == kNothing ||
            texts_.target.words[there] != texts_.before.words[name] || has_own_prefix(name, there))
            return;
        CarriedWords scope = carry_new(hunk.now_first, hunk.now_end);
        if (scope.unknown.empty())
            respelled_.push_back({there, there, std::move(scope.words), hunk.now_first, hunk.now_end});
    }

    /// True where one name stands for one name, of which nothing else is known.
    bool is_name_alone(const Hunk& hunk, size_t first, size_t end) const {
        return hunk.end == hunk.first + 1 && end == first + 1 && is_word_token(texts_.before.words[hunk.first]) &&
               is_word_token(texts_.target.words[first]);
    }

    void leave_run(const Hunk& hunk, size_t target_word, const std::string& why) {
        const std::string was = shown(texts_.before.words, hunk.first, hunk.end);
        const std::string is = shown(texts_.now.words, hunk.now_first, hunk.now_end);
        leave((was.empty()  ? "the source gained `" + is + "`"
               : is.empty() ? "the source lost `" + was + "`"
                            : "the source has `" + is + "` for `" + was + "`") +
                  "; " + why,
              std::min(hunk.now_first, texts_.now.words.size() - 1), target_word);
    }

    void leave(std::string message, size_t source_word, size_t target_word) {
        out_.left.push_back({std::move(message), source_word, target_word});
    }

    const InsertedUses& uses_;
    Transplant& out_;
    Renamings renamings_;
    std::vector<WordsReplaced> respelled_;
    std::vector<std::pair<size_t, size_t>> strange_;  ///< clauses that changed without a counterpart: before, and now
};

}  // namespace

std::vector<WordsReplaced> carry_changed_clauses(const EditReading& reading, const InsertedUses& uses,
                                                 Transplant& out) {
    return ClauseChanger(reading, uses, out).run();
}

}  // namespace porttool
