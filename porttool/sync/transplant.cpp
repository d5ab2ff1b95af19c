// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/transplant.h"

#include <algorithm>
#include <optional>
#include <set>

#include "porttool/language/words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/sync/operands.h"

namespace porttool {
namespace {

constexpr size_t kNothing = Alignment::kNone;
constexpr double kSure = 0.45;  ///< clauses less alike may stand for something else

/// A run of words that the edit took away, and the run that came in its place.
struct Hunk {
    size_t first = 0, end = 0;          ///< before
    size_t now_first = 0, now_end = 0;  ///< now
};

class EditCarrier {
public:
    EditCarrier(const EditTexts& texts, const EditTranslator& translator,
                const std::function<std::string(size_t)>& written)
        : texts_(texts), translator_(translator), written_(written), origin_(texts.now.clauses.size(), kNothing) {
        for (size_t c = 0; c < texts.before.clauses.size(); ++c)
            if (const size_t now = texts.edit.clause_of[c]; now != kNothing) origin_[now] = c;
        stands_for_.insert(texts.across.clause_of.begin(), texts.across.clause_of.end());
        find_doubtful();
    }

    Transplant run() {
        for (size_t c = 0; c < origin_.size();) {
            if (origin_[c] != kNothing) {
                change(origin_[c], c);
                ++c;
                continue;
            }
            size_t end = c;
            while (end < origin_.size() && origin_[end] == kNothing) ++end;
            add(c, end);
            c = end;
        }
        for (size_t c = 0; c < texts_.before.clauses.size(); ++c)
            if (texts_.edit.clause_of[c] == kNothing && !held_.contains(c)) remove(c);
        drop_open_blocks();
        // Beside nothing else an edit of spelling alone is due where somebody asks for it.
        if (out_.empty() && out_.left.empty() && out_.already == 0) out_.replaced = std::move(respelled_);
        for (const size_t was : origin_) out_.stands_for.push_back(was == kNothing ? kNothing : counterpart(was));
        return std::move(out_);
    }

private:
    const Clause& before(size_t c) const { return texts_.before.clauses[c]; }
    const Clause& now(size_t c) const { return texts_.now.clauses[c]; }
    const Clause& target(size_t c) const { return texts_.target.clauses[c]; }
    size_t counterpart(size_t c) const { return texts_.across.clause_of[c]; }

    std::string old_word(size_t i) const { return texts_.before.words[i]; }
    CarriedWords carry_old(size_t first, size_t end) const {
        return translator_.carry(texts_.before.words, first, end, [this](size_t i) { return old_word(i); });
    }
    CarriedWords carry_new(size_t first, size_t end) const {
        return translator_.carry(texts_.now.words, first, end, written_);
    }

    /// True if the target's words [first, end) say just that; with `values` numbers of one value are the same.
    bool says(size_t first, size_t end, const std::vector<CarriedWord>& words, bool values = false) const {
        if (end < first || end - first != words.size()) return false;
        for (size_t i = 0; i < words.size(); ++i) {
            const std::string &there = texts_.target.words[first + i], &here = words[i].text;
            if (there == here) continue;
            if (!is_number_token(there) || !is_number_token(here)) return false;
            if (values ? number_value(there) != number_value(here) : normal_number(there) != normal_number(here))
                return false;
        }
        return true;
    }

    void leave(std::string message, size_t source_word, size_t target_word) {
        out_.left.push_back({std::move(message), source_word, target_word});
    }

    static std::string shown(const std::vector<std::string>& words, size_t first, size_t end) {
        std::string out;
        constexpr size_t kMost = 12;
        for (size_t i = first; i < std::min(end, first + kMost); ++i) out += (i > first ? " " : "") + words[i];
        return end > first + kMost ? out + " ..." : out;
    }

    static std::string listed(std::vector<std::string> words) {
        std::sort(words.begin(), words.end());
        words.erase(std::unique(words.begin(), words.end()), words.end());
        std::string out;
        for (const std::string& word : words) out += (out.empty() ? "`" : ", `") + word + "`";
        return out;
    }

    /// Branches that the port takes on another condition, or that may be the other ones of two: what stands in them
    /// there is not known.
    void find_doubtful() {
        doubtful_.assign(texts_.before.clauses.size(), false);
        find_doubtful_directives();
        for (size_t c = 0; c < doubtful_.size(); ++c) {
            const Clause& clause = before(c);
            if (!clause.opens || counterpart(c) == kNothing) continue;
            const std::string& head = texts_.before.words[clause.first];
            if (head == "else") {
                // Of the branch before it: that ends where this one begins.
                const size_t closing = c == 0 ? Clause::kNone : c - 1;
                const size_t branch = closing == Clause::kNone ? closing : before(closing).partner;
                doubtful_[c] = branch != Clause::kNone && before(closing).closes && doubtful_[branch];
            } else if (head == "if" || head == "while" || head == "switch") {
                const Clause& there = target(counterpart(c));
                doubtful_[c] = !says(there.first, there.end, carry_old(clause.first, clause.end).words, true);
            }
        }
    }

    /// The operators of a clause by which it asks, in order: with the same ones a head asks the same way round.
    static std::vector<std::string> comparisons(const AlignedText& text, const Clause& clause) {
        std::vector<std::string> out;
        for (size_t i = clause.first; i < clause.end; ++i)
            for (const std::string_view word : {"<", ">", "<=", ">=", "==", "!=", "&&", "||", "!", "?"})
                if (text.words[i] == word) out.emplace_back(word);
        return out;
    }

    /// What a text asks its preprocessor, in order: `ifdef FAST`, and of an expression how it begins.
    static std::vector<std::string> conditions_of(const std::vector<std::string>& words) {
        std::vector<std::string> out;
        for (size_t i = 0; i + 2 < words.size(); ++i) {
            const bool asks = words[i + 1].starts_with("if") || words[i + 1].starts_with("elif");
            if (words[i] == "#" && asks)
                out.push_back(shown(words, i + 1, std::min(words.size(), i + (words[i + 1].ends_with("def") ? 3 : 5))));
        }
        return out;
    }

    /// What stands between `#if` and `#endif` where the port has conditions, and others.
    void find_doubtful_directives() {
        in_doubtful_directive_.assign(texts_.before.clauses.size(), false);
        const std::vector<std::string> there = conditions_of(texts_.target.words);
        if (there.empty() || there == conditions_of(texts_.before.words)) return;
        int depth = 0;
        for (size_t c = 0; c < texts_.before.clauses.size(); ++c) {
            for (size_t i = before(c).first; i + 1 < before(c).end; ++i) {
                if (texts_.before.words[i] != "#") continue;
                const std::string& kind = texts_.before.words[i + 1];
                depth += kind.starts_with("if") ? 1 : kind == "endif" ? -1 : 0;
            }
            in_doubtful_directive_[c] = depth > 0;
        }
    }

    /// True for a statement that the target has more often than the source: one of them may not be all.
    bool is_said_more_often(size_t was, size_t there) const {
        constexpr size_t kShortest = 3;
        if (before(was).opens || before(was).closes || before(was).size() < kShortest) return false;
        const auto times = [](const AlignedText& text, const Clause& clause) {
            return std::count_if(text.clauses.begin(), text.clauses.end(), [&](const Clause& other) {
                return other.size() == clause.size() &&
                       std::equal(text.exact.begin() + static_cast<std::ptrdiff_t>(other.first),
                                  text.exact.begin() + static_cast<std::ptrdiff_t>(other.end),
                                  text.exact.begin() + static_cast<std::ptrdiff_t>(clause.first));
            });
        };
        return times(texts_.target, target(there)) > times(texts_.before, before(was));
    }

    /// True if a clause of the source's old text stands in such a branch; `c` may be none.
    bool is_doubtful(size_t c) const {
        if (c != Clause::kNone && in_doubtful_directive_[c]) return true;
        for (; c != Clause::kNone; c = before(c).inside)
            if (doubtful_[c]) return true;
        return false;
    }

    bool is_doubtful_directive(size_t c) const { return in_doubtful_directive_[c]; }

    // A clause that stayed, perhaps with other words.

    void change(size_t was, size_t is) {
        const std::vector<Hunk> hunks = hunks_of(before(was), now(is));
        if (hunks.empty()) return;
        const size_t there = counterpart(was);
        if (there != kNothing && is_said_more_often(was, there))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port says that in more places",
                         now(is).first, target(there).first);
        const bool asks_alike = there != kNothing && before(was).opens &&
                                comparisons(texts_.before, before(was)) == comparisons(texts_.target, target(there));
        if (there != kNothing && is_doubtful(asks_alike ? before(was).inside : was))
            return leave("the source has `" + shown(texts_.now.words, now(is).first, now(is).end) + "` for `" +
                             shown(texts_.before.words, before(was).first, before(was).end) +
                             "`; the port's condition there is another one",
                         now(is).first, target(there).first);
        if (there == kNothing || texts_.across.likeness[was] < kSure) {
            if (there == kNothing && stands_in_target(is)) {
                ++out_.already;
                return;
            }
            if (there != kNothing && was == 0) return change_words(hunks, was, is, there);
            if ((there == kNothing && change_result(was, is)) || change_type(hunks, was) || change_value(hunks, was))
                return;
            leave("the port has nothing that clearly stands for `" +
                      shown(texts_.before.words, before(was).first, before(was).end) + "`, which became `" +
                      shown(texts_.now.words, now(is).first, now(is).end) + "`",
                  now(is).first, near(was));
            return;
        }
        if (const CarriedWords whole = carry_new(now(is).first, now(is).end);
            says(target(there).first, target(there).end, whole.words)) {
            ++out_.already;
            return;
        }
        change_words(hunks, was, is, there);
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
        const Clause old = value_of(texts_.before.words, before(was));
        const CarriedWords said = carry_old(old.first, old.end);
        if (old.size() < kShortest || !said.unknown.empty() || said.words.size() != old.size()) return false;
        if (hunks.front().first < old.first || hunks.back().end > old.end) return false;
        const std::optional<size_t> at = only_place_of(said.words);
        if (!at || times_in_source(old) != 1) return false;
        const size_t made = out_.replaced.size();
        for (const Hunk& hunk : hunks) {
            const CarriedWords words = carry_new(hunk.now_first, hunk.now_end);
            if (!words.unknown.empty()) {
                out_.replaced.resize(made);
                return false;
            }
            out_.replaced.push_back({*at + (hunk.first - old.first), *at + (hunk.end - old.first), words.words,
                                     hunk.now_first, hunk.now_end});
        }
        return true;
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

    /// Where the target says the words, if it does so once.
    std::optional<size_t> only_place_of(const std::vector<CarriedWord>& words) const {
        std::optional<size_t> out;
        for (size_t i = 0; i + words.size() <= texts_.target.words.size(); ++i) {
            if (!says(i, i + words.size(), words, true)) continue;
            if (out) return std::nullopt;
            out = i;
        }
        return out;
    }

    size_t times_in_source(const Clause& clause) const {
        const auto word = [&](size_t i) { return texts_.before.exact.begin() + static_cast<std::ptrdiff_t>(i); };
        size_t out = 0;
        for (auto at = texts_.before.exact.begin();; ++at, ++out) {
            at = std::search(at, texts_.before.exact.end(), word(clause.first), word(clause.end));
            if (at == texts_.before.exact.end()) return out;
        }
    }

    /// A clause is changed as a whole or not at all.
    void change_words(const std::vector<Hunk>& hunks, size_t was, size_t is, size_t there) {
        const size_t made = out_.replaced.size(), left = out_.left.size();
        for (const Hunk& hunk : hunks) change_run(hunk, was, there);
        if (out_.left.size() > left) return out_.replaced.resize(made);
        // Where the target says the clause word for word it has to say the new one so, too.
        const Clause& other = target(there);
        if (out_.replaced.size() == made || was == 0 ||
            !says(other.first, other.end, carry_old(before(was).first, before(was).end).words))
            return;
        const CarriedWords now_said = carry_new(now(is).first, now(is).end);
        if (!now_said.unknown.empty() || result_of(other, made) == texts_of(now_said.words)) return;
        out_.replaced.resize(made);
        out_.replaced.push_back({target(there).first, target(there).end, now_said.words, now(is).first, now(is).end});
    }

    static std::vector<std::string> texts_of(const std::vector<CarriedWord>& words) {
        std::vector<std::string> out;
        for (const CarriedWord& word : words) out.push_back(word.text);
        return out;
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
        if (hunk.first == hunk.end ? insert_run(hunk, was, there) : replace_run(hunk)) return;
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

    /// How many indices follow a word: 2 for `m [ i ] [ j ]`.
    template <class WordAt>
    static size_t indices_after(size_t i, size_t end, const WordAt& at) {
        size_t count = 0;
        for (++i; i < end && at(i) == "["; ++count) {
            int depth = 0;
            for (; i < end; ++i) {
                depth += at(i) == "[" ? 1 : at(i) == "]" ? -1 : 0;
                if (depth == 0) break;
            }
            ++i;
        }
        return count;
    }

    /// A name that the new words index otherwise than the target always does: a flat array that is one of rows there.
    std::string indexed_otherwise(const std::vector<CarriedWord>& words) const {
        const auto here = [&](size_t i) -> const std::string& { return words[i].text; };
        const auto there = [&](size_t i) -> const std::string& { return texts_.target.words[i]; };
        for (size_t i = 0; i + 1 < words.size(); ++i) {
            if (!is_word_token(words[i].text) || words[i + 1].text != "[") continue;
            const size_t count = indices_after(i, words.size(), here);
            bool any = false, same = false;
            for (size_t k = 0; k + 1 < texts_.target.words.size() && !same; ++k) {
                if (there(k) != words[i].text || there(k + 1) != "[") continue;
                any = true;
                same = indices_after(k, texts_.target.words.size(), there) == count;
            }
            if (any && !same) return words[i].text;
        }
        return {};
    }

    size_t word_of(size_t i) const { return texts_.across.word_of[i]; }

    void put(const Hunk& hunk, size_t first, size_t end, const CarriedWords& now) {
        if (!now.unknown.empty() && !is_renamed_elsewhere(hunk, first, end))
            return leave_run(hunk, first, "nothing tells how the port says " + listed(now.unknown));
        if (hunk.end == hunk.first + 1 && hunk.now_end == hunk.now_first + 1 && end == first + 1 &&
            translator_.declares_alone(texts_.target.words[first], texts_.now.words[hunk.now_first]))
            return leave_run(hunk, first, "the port declares `" + texts_.target.words[first] + "` itself");
        if (const std::string name = indexed_otherwise(now.words); !name.empty())
            return leave_run(hunk, first, "the port has `" + name + "` with other indices");
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

    /// True where both sides call a function by one name, which neither declares, and the source calls it by a new one
    /// throughout: what both have from elsewhere was renamed there.
    bool is_renamed_elsewhere(const Hunk& hunk, size_t first, size_t end) const {
        if (hunk.end != hunk.first + 1 || hunk.now_end != hunk.now_first + 1 || end != first + 1) return false;
        const std::string &was = texts_.before.words[hunk.first], &is = texts_.now.words[hunk.now_first];
        if (texts_.target.words[first] != was || !translator_.is_from_elsewhere(was, is)) return false;
        const auto is_called = [](const std::vector<std::string>& words, size_t i) {
            return i + 3 < words.size() && (words[i + 1] == "(" || (words[i + 1] == "<" && words[i + 2] == "<"));
        };
        const std::vector<std::string>& words = texts_.now.words;
        return is_called(words, hunk.now_first) && is_called(texts_.target.words, first) &&
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

    /// New words go between the nearest words that stand for some of the target's, if it has nothing of its own there.
    /// Else an argument goes beside the one that it stands beside in the source.
    /// Where a word of the target begins with the scope that it is called in: `std` of `std :: sqrt`, not before
    /// `first`.
    size_t before_scope(size_t first, size_t word) const {
        while (word >= first + 2 && texts_.target.words[word - 1] == "::" &&
               is_word_token(texts_.target.words[word - 2]))
            word -= 2;
        return word;
    }

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

    /// A neutral edit of words that the target spells as the source did.
    void respell(const Hunk& hunk) {
        if (hunk.first == hunk.end || hunk.now_first == hunk.now_end) return;
        const size_t first = word_of(hunk.first), size = hunk.end - hunk.first;
        for (size_t i = 0; i < size; ++i)
            if (word_of(hunk.first + i) != first + i || first == kNothing ||
                texts_.target.words[first + i] != texts_.before.words[hunk.first + i])
                return;
        CarriedWords now = carry_new(hunk.now_first, hunk.now_end);
        if (!now.unknown.empty()) return;
        now.words.clear();
        for (size_t i = hunk.now_first; i < hunk.now_end; ++i) now.words.push_back({written_(i), i});
        respelled_.push_back({first, first + size, std::move(now.words), hunk.now_first, hunk.now_end});
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

    // Clauses that came.

    /// The counterpart of the nearest clause at or before c that has one, within the block that c stands in.
    size_t target_before(size_t c) const {
        while (counterpart(c) == kNothing) {
            if (before(c).opens || c == 0) return kNothing;
            const size_t from = before(c).closes && before(c).partner != Clause::kNone ? before(c).partner : c;
            if (from == 0) return kNothing;
            c = from - 1;
        }
        return counterpart(c);
    }
    size_t target_after(size_t c) const {
        while (counterpart(c) == kNothing) {
            if (before(c).closes) return kNothing;
            const size_t from = before(c).opens && before(c).partner != Clause::kNone ? before(c).partner : c;
            if (from + 1 >= texts_.before.clauses.size()) return kNothing;
            c = from + 1;
        }
        return counterpart(c);
    }

    /// A word of the target near where a clause of the source's old text would stand.
    size_t near(size_t c) const {
        for (size_t i = c + 1; i-- > 0;)
            if (counterpart(i) != kNothing) return target(counterpart(i)).first;
        return 0;
    }

    /// True if the target has a clause like that of the source's new text which stands for none of its old one.
    bool stands_in_target(size_t is) const {
        const CarriedWords words = carry_new(now(is).first, now(is).end);
        for (const Clause& clause : texts_.target.clauses)
            if (says(clause.first, clause.end, words.words)) return true;
        return false;
    }

    void add(size_t first, size_t end) {
        const size_t was_before = first == 0 ? kNothing : origin_[first - 1];
        const size_t was_after = end == origin_.size() ? kNothing : origin_[end];
        const size_t left = was_before == kNothing ? kNothing : target_before(was_before);
        const size_t right = was_after == kNothing ? kNothing : target_after(was_after);
        const std::string what = shown(texts_.now.words, now(first).first, now(end - 1).end);
        const size_t close = was_before == kNothing ? 0 : near(was_before);
        const auto give_up = [&](const std::string& why) {
            for (size_t c = was_before == kNothing ? 0 : was_before + 1; c < before_end(was_after); ++c)
                held_.insert(c);
            leave("the source gained `" + what + "`; " + why, now(first).first, close);
        };
        const size_t block = was_before == kNothing     ? Clause::kNone
                             : before(was_before).opens ? was_before
                                                        : before(was_before).inside;
        if (is_doubtful(block) || (was_before != kNothing && is_doubtful_directive(was_before)))
            return give_up("the port's condition there is another one");
        if (left == kNothing && right == kNothing)
            return give_up("the port has nothing that stands for its neighbours");
        if (left != kNothing && right != kNothing && right <= left)
            return give_up("its neighbours stand in another order in the port");
        std::vector<ClauseAdded> clauses = carried_clauses(first, end);
        if (was_before != kNothing && was_after != kNothing && depends_on_merged(first, end, was_before, was_after))
            return give_up("the port has one of its neighbours within another statement");
        // What the port has of its own between the two neighbours.
        std::vector<size_t> own;
        const size_t from = left == kNothing ? own_start(right) : left + 1;
        const size_t to = right == kNothing ? own_end(left) : right;
        for (size_t c = from; c < to; ++c)
            if (!stands_for_something(c)) own.push_back(c);
        if (!own.empty() && drop_those_there(own, clauses)) {
            if (clauses.empty()) return;
            return give_up("the port has a part of it already");
        }
        std::optional<size_t> place = place_among(left, right, own, clauses, was_before, was_after);
        if (!place) return give_up("the port has statements of its own there, and which comes first matters");
        if (!is_in_counterpart(block, *place)) return give_up("the block around it has no counterpart in the port");
        if (leaves_loop(first, end, *place))
            return give_up("the port has a loop of its own around it, which it would leave");
        std::vector<std::string> unknown;
        for (size_t c = first; c < end; ++c) {
            if (moved_from(c)) continue;
            const CarriedWords carried = carry_new(now(c).first, now(c).end);
            unknown.insert(unknown.end(), carried.unknown.begin(), carried.unknown.end());
        }
        for (const ClauseAdded& clause : clauses)
            if (const std::string name = indexed_otherwise(clause.words); !name.empty())
                return give_up("the port has `" + name + "` with other indices");
        if (!unknown.empty()) return give_up("nothing tells how the port says " + listed(unknown));
        for (size_t c = first; c < end; ++c)
            if (const auto source = moved_from(c)) moved_.insert(*source);
        out_.added.push_back({*place, std::move(clauses)});
    }

    /// A block comes whole or not at all: what opens one goes with what closes it.
    void drop_open_blocks() {
        const auto lacks_partner = [&](const ClausesAdded& one) {
            return std::any_of(one.clauses.begin(), one.clauses.end(), [&](const ClauseAdded& clause) {
                const size_t partner = now(clause.source).partner;
                return partner != Clause::kNone && origin_[partner] == kNothing && !is_added(partner);
            });
        };
        for (auto found = out_.added.begin();;) {
            found = std::find_if(out_.added.begin(), out_.added.end(), lacks_partner);
            if (found == out_.added.end()) return;
            const Clause& first = now(found->clauses.front().source);
            leave("the source gained `" + shown(texts_.now.words, first.first, first.end) +
                      "`; the other end of its block has no sure place in the port",
                  first.first, std::min(found->before, texts_.target.words.size() - 1));
            out_.added.erase(found);
        }
    }

    bool is_added(size_t clause) const {
        return std::any_of(out_.added.begin(), out_.added.end(), [&](const ClausesAdded& one) {
            return std::any_of(one.clauses.begin(), one.clauses.end(),
                               [&](const ClauseAdded& added) { return added.source == clause; });
        });
    }

    /// The head of the block of the target that a place is in.
    size_t block_at(size_t place) const {
        size_t c = 0;
        while (c < texts_.target.clauses.size() && target(c).first < place) ++c;
        if (c == texts_.target.clauses.size()) return Clause::kNone;
        return target(c).closes ? target(c).partner : target(c).inside;
    }

    /// True if the nearest block around a place that stands for one of the source's stands for `block`.
    bool is_in_counterpart(size_t block, size_t place) const {
        size_t there = block_at(place);
        while (there != Clause::kNone && !stands_for_something(there)) there = target(there).inside;
        // Blocks of the source that came with the edit, or that the port never had, are passed over as well.
        return block == Clause::kNone ? there == Clause::kNone : counterpart(block) == there && there != Clause::kNone;
    }

    /// True if new clauses end what is around them, and that is a loop which the port alone has.
    bool leaves_loop(size_t first, size_t end, size_t place) const {
        bool leaves_unit = false, leaves_nearest = false;
        for (size_t i = now(first).first; i < now(end - 1).end; ++i) {
            leaves_unit |= texts_.now.words[i] == "return";
            leaves_nearest |= texts_.now.words[i] == "break" || texts_.now.words[i] == "continue";
        }
        if (!leaves_unit && !leaves_nearest) return false;
        bool is_nearest = true;
        for (size_t c = block_at(place); c != Clause::kNone; c = target(c).inside) {
            const std::string& head = texts_.target.words[target(c).first];
            if (!word_is(head, kLoopHead) && head != "do" && (head != "switch" || !is_nearest)) continue;
            if (!stands_for_something(c)) {
                if (is_nearest || leaves_unit || !holds_all_beside(c, first)) return true;
            }
            is_nearest = false;
        }
        return false;
    }

    /// True if a loop that the port alone has holds what the source has beside its own loop around the new clause
    /// `is`, as one over all threads does; a tile's does not.
    bool holds_all_beside(size_t loop, size_t is) const {
        size_t own = now(is).inside;
        while (own != Clause::kNone && !word_is(texts_.now.words[now(own).first], kLoopHead)) own = now(own).inside;
        if (own == Clause::kNone) return false;
        bool any = false;
        for (size_t c = 0; c < origin_.size(); ++c) {
            if (c == own || now(c).inside != now(own).inside || now(c).closes || origin_[c] == kNothing) continue;
            const size_t there = counterpart(origin_[c]);
            if (there == kNothing || there == 0) continue;
            size_t around = target(there).inside;
            while (around != Clause::kNone && around != loop) around = target(around).inside;
            if (around != loop) return false;
            any = true;
        }
        return any;
    }

    /// True if a neighbour without a counterpart, which the port may have within another statement, shares names.
    bool depends_on_merged(size_t first, size_t end, size_t was_before, size_t was_after) const {
        std::set<std::string> names;
        for (size_t i = now(first).first; i < now(end - 1).end; ++i)
            if (is_name(texts_.now.words[i])) names.insert(texts_.now.words[i]);
        const auto shares = [&](size_t c) {
            const Clause& clause = before(c);
            if (counterpart(c) != kNothing || clause.closes || clause.opens || texts_.edit.clause_of[c] == kNothing)
                return false;
            // What the source gives back the port may hand back through a reference.
            if (texts_.before.words[clause.first] == "return" && !only_result(texts_.target)) return false;
            for (size_t i = clause.first; i < clause.end; ++i)
                if (names.contains(texts_.before.words[i])) return true;
            return false;
        };
        return shares(was_before) || shares(was_after);
    }

    size_t before_end(size_t was_after) const {
        return was_after == kNothing ? texts_.before.clauses.size() : was_after;
    }

    size_t own_start(size_t right) const {
        size_t c = right;
        while (c > 0 && !target(c - 1).opens && !stands_for_something(c - 1)) --c;
        return c;
    }
    size_t own_end(size_t left) const {
        size_t c = left + 1;
        while (c < texts_.target.clauses.size() && !target(c).closes && !stands_for_something(c)) ++c;
        return c;
    }

    bool stands_for_something(size_t there) const { return stands_for_.contains(there); }

    /// A clause that went elsewhere with the same words: the target's words for it are known.
    std::optional<size_t> moved_from(size_t is) const {
        for (size_t c = 0; c < texts_.before.clauses.size(); ++c) {
            if (texts_.edit.clause_of[c] != kNothing || counterpart(c) == kNothing || before(c).closes) continue;
            if (before(c).size() != now(is).size() || before(c).size() < 4) continue;
            bool same = true;
            for (size_t k = 0; k < now(is).size() && same; ++k)
                same = texts_.before.exact[before(c).first + k] == texts_.now.exact[now(is).first + k];
            if (same) return c;
        }
        return std::nullopt;
    }

    std::vector<ClauseAdded> carried_clauses(size_t first, size_t end) const {
        std::vector<ClauseAdded> out;
        for (size_t c = first; c < end; ++c) {
            ClauseAdded one{{}, c};
            if (const auto from = moved_from(c)) {
                const Clause& there = target(counterpart(*from));
                const bool same = there.size() == now(c).size();
                for (size_t i = there.first; i < there.end; ++i)
                    one.words.push_back({written_number(texts_.target.words[i]),
                                         same ? now(c).first + (i - there.first) : CarriedWord::kNoSource});
            } else {
                one.words = carry_new(now(c).first, now(c).end).words;
            }
            out.push_back(std::move(one));
        }
        return out;
    }

    /// Drops clauses that stand among the target's own; true if any does.
    bool drop_those_there(const std::vector<size_t>& own, std::vector<ClauseAdded>& clauses) {
        const size_t all = clauses.size();
        size_t at = 0;
        std::erase_if(clauses, [&](const ClauseAdded& clause) {
            const std::string& head = texts_.now.words[now(clause.source).first];
            if (now(clause.source).closes || head == "break" || head == "continue") return false;
            for (size_t i = at; i < own.size(); ++i)
                if (says(target(own[i]).first, target(own[i]).end, clause.words)) {
                    at = i + 1;
                    return true;
                }
            return false;
        });
        if (clauses.size() < all &&
            std::all_of(clauses.begin(), clauses.end(), [&](const ClauseAdded& c) { return now(c.source).closes; }))
            clauses.clear();
        if (clauses.empty()) ++out_.already;
        return clauses.size() < all;
    }

    /// Before which word of the target new clauses go, between the counterparts of their neighbours; none if the order
    /// among the port's own clauses there matters.
    std::optional<size_t> place_among(size_t left, size_t right, const std::vector<size_t>& own,
                                      const std::vector<ClauseAdded>& clauses, size_t was_before,
                                      size_t was_after) const {
        if (own.empty()) return left != kNothing ? target(left).end : target(right).first;
        const bool beside_left = left != kNothing && counterpart(was_before) == left;
        const bool beside_right = right != kNothing && counterpart(was_after) == right;
        if (!beside_left && !beside_right) return std::nullopt;
        // Behind a `return` of the port's own nothing would run.
        if (beside_left && own[0] == left + 1 && texts_.target.words[target(own[0]).first] == "return")
            return target(own[0]).first;
        std::set<std::string> names;
        for (const ClauseAdded& clause : clauses)
            for (const CarriedWord& word : clause.words)
                if (is_name(word.text)) names.insert(word.text);
        for (const size_t c : own)
            for (size_t i = target(c).first; i < target(c).end; ++i)
                if (names.contains(texts_.target.words[i])) return std::nullopt;
        // What a new block goes around begins with its right neighbour, and not with what the port has before that.
        const bool goes_around =
            now(clauses.back().source).opens &&
            std::none_of(own.begin(), own.end(), [&](size_t c) { return target(c).opens || target(c).closes; });
        return beside_left && !(goes_around && beside_right) ? target(left).end : target(right).first;
    }

    // Clauses that went.

    void remove(size_t was) {
        const Clause& clause = before(was);
        const size_t there = counterpart(was);
        if (there == kNothing) {
            if (clause.closes) return;
            leave("the source lost `" + shown(texts_.before.words, clause.first, clause.end) +
                      "`; the port has nothing that clearly stands for it",
                  place_now(was), near(was));
            return;
        }
        if (!clause.closes &&
            (is_said_more_often(was, there) || is_doubtful(clause.inside) || is_doubtful_directive(was)))
            return leave("the source lost `" + shown(texts_.before.words, clause.first, clause.end) +
                             "`; the port says that in more places, or under another condition",
                         place_now(was), target(there).first);
        if (!clause.closes) {
            const CarriedWords old = carry_old(clause.first, clause.end);
            if (texts_.across.likeness[was] < 0.8 && !moved_.contains(was) &&
                !says(target(there).first, target(there).end, old.words, true)) {
                leave("the source lost `" + shown(texts_.before.words, clause.first, clause.end) +
                          "`; whether the port's `" +
                          shown(texts_.target.words, target(there).first, target(there).end) +
                          "` is to go is not certain",
                      place_now(was), target(there).first);
                return;
            }
        }
        out_.removed.push_back(there);
    }

    /// A word of the source's new text near where a clause of its old one stood.
    size_t place_now(size_t was) const {
        for (size_t i = was; i-- > 0;)
            if (texts_.edit.clause_of[i] != kNothing) return now(texts_.edit.clause_of[i]).first;
        return 0;
    }

    const EditTexts& texts_;
    const EditTranslator& translator_;
    const std::function<std::string(size_t)>& written_;
    std::vector<bool> in_doubtful_directive_;  ///< clauses of the source's old text
    std::vector<bool> doubtful_;               ///< heads of the source's old text
    std::set<size_t> held_;                    ///< clauses of the source's old text whose successor is left
    std::set<size_t> stands_for_;              ///< clauses of the target that have a counterpart
    std::set<size_t> moved_;                   ///< clauses of the source's old text that stand elsewhere in its new one
    std::vector<size_t> origin_;               ///< of each clause of now, the one before
    std::vector<WordsReplaced> respelled_;
    Transplant out_;
};

}  // namespace

Transplant transplant(const EditTexts& texts, const EditTranslator& translator,
                      const std::function<std::string(size_t)>& written) {
    return EditCarrier(texts, translator, written).run();
}

}  // namespace porttool
