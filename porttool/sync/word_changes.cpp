// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/word_changes.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "porttool/language/words.h"
#include "porttool/normal/normal_form.h"
#include "porttool/normal/normal_text.h"
#include "porttool/normal/statements.h"
#include "porttool/sync/operands.h"
#include "porttool/sync/text_literals.h"

namespace porttool {
namespace {

/// What is called with a word among its arguments; "" for none.
std::string callee_around(const std::vector<std::string>& words, size_t i) {
    int depth = 0;
    while (i-- > 1) {
        if (is_one_of(words[i], {";", "{", "}"})) return {};
        depth += is_one_of(words[i], {")", "]"}) ? 1 : is_one_of(words[i], {"(", "["}) ? -1 : 0;
        if (depth < 0) return words[i] == "(" && is_name(words[i - 1]) ? words[i - 1] : std::string();
    }
    return {};
}

bool is_real_number(const std::string& number) {
    return !number.starts_with("0x") && number.find_first_of(".eEf") != std::string::npos;
}

}  // namespace

void WordChanger::change_words(const std::vector<Hunk>& hunks, size_t was, size_t is, size_t there) {
    const size_t made = out_.replaced.size(), left = out_.left.size(), spelled = respelled_.size();
    for (const Hunk& hunk : hunks) change_run(hunk, was, there);
    const bool respells_too = respelled_.size() > spelled;
    if (out_.replaced.size() > made) take_spellings(hunks, spelled);
    if (out_.left.size() > left) return out_.replaced.resize(made);
    if (const std::string why = manner_.doubt_of_calls(before(was), now(is)); !why.empty() && !hunks.empty()) {
        out_.replaced.resize(made);
        return leave_run(hunks.front(), target(there).first, why);
    }
    // Where the target says the clause word for word it has to say the new one so, too.
    const Clause& other = target(there);
    if (out_.replaced.size() == made || was == 0 || respells_too ||
        !says(other.first, other.end, carry_old(before(was).first, before(was).end).words) ||
        translator_.calls_otherwise(texts_.now.words, now(is).first, now(is).end))
        return;
    const CarriedWords now_said = carry_new(now(is).first, now(is).end);
    if (!now_said.unknown.empty() || result_of(other, made) == texts_of(now_said.words)) return;
    if (!uses_.doubt_within(now_said.words, now(is).end, other.first).empty()) return;
    out_.replaced.resize(made);
    out_.replaced.push_back({target(there).first, target(there).end, now_said.words, now(is).first, now(is).end});
}

bool WordChanger::respells(const std::vector<Hunk>& hunks) const {
    return !hunks.empty() && std::all_of(hunks.begin(), hunks.end(), [&](const Hunk& hunk) {
        return hunk.is_word_for_word() && is_name(texts_.now.words[hunk.now_first]) && is_neutral(hunk) &&
               is_spelled_alike(hunk) && translator_.knows_there(texts_.now.words[hunk.now_first]);
    });
}

std::vector<std::string> WordChanger::result_of(const Clause& clause, size_t made) const {
    std::vector<WordsReplaced> edits(out_.replaced.begin() + static_cast<std::ptrdiff_t>(made), out_.replaced.end());
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

std::vector<Hunk> WordChanger::hunks_of(const Clause& was, const Clause& is) const {
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
        // What picks a member of what changed goes with it, where the target has that otherwise.
        while (hunk.end < was.end && (!kept(hunk.end) || (hunk.end > i && picks_otherwise(hunk.end)))) ++hunk.end;
        hunk.now_end = hunk.end < was.end ? texts_.edit.word_of[hunk.end] : is.end;
        out.push_back(hunk);
        i = hunk.end;
        k = hunk.now_end;
    }
    return out;
}

bool WordChanger::picks_otherwise(size_t i) const {
    return is_accessor(texts_.before.words[i]) && word_of(i) != kNothing &&
           texts_.target.words[word_of(i)] != texts_.before.words[i];
}

void WordChanger::change_run(Hunk hunk, size_t was, size_t there) {
    const size_t left = out_.left.size();
    change_words_of(hunk, was, there);
    // What only says more of the same values is due nowhere: it comes where it has a place.
    if (says_no_value(hunk)) out_.left.resize(left);
}

bool WordChanger::says_restrict(const Hunk& hunk) const {
    return std::any_of(texts_.now.words.begin() + static_cast<std::ptrdiff_t>(hunk.now_first),
                       texts_.now.words.begin() + static_cast<std::ptrdiff_t>(hunk.now_end),
                       [](const std::string& word) { return word != "const" && word_is(word, kQualifier); });
}

bool WordChanger::says_no_value(const Hunk& hunk) const {
    const auto all = [](const std::vector<std::string>& words, size_t first, size_t end) {
        return std::all_of(words.begin() + static_cast<std::ptrdiff_t>(first),
                           words.begin() + static_cast<std::ptrdiff_t>(end), [](const std::string& word) {
                               return is_one_of(word, {"const", "restrict", "__restrict", "__restrict__"});
                           });
    };
    if (all(texts_.before.words, hunk.first, hunk.end) && all(texts_.now.words, hunk.now_first, hunk.now_end))
        return true;
    return named_values_.only_name(texts_.now, {hunk.now_first, hunk.now_end}, texts_.before, {hunk.first, hunk.end});
}

void WordChanger::change_words_of(Hunk hunk, size_t was, size_t there) {
    if (was == 0 && loses_way_out(hunk))
        return leave_run(hunk, target(there).first, "nothing tells how the port hands a value back so");
    if (is_neutral(hunk)) return respell(hunk);
    if (is_idle_bracket(hunk)) return;
    if (hunk.first == hunk.end ? insert_run(hunk, was, there)
                               : replace_run(hunk) || drop_elements(hunk) || (was == 0 && drop_parameter(hunk)))
        return;
    const Clause &here = before(was), &other = target(there);
    // Out to words that stand for words of the target.
    const Hunk told = hunk;
    while (hunk.first > here.first && word_of(hunk.first - 1) == kNothing) {
        if (hunk.now_first == 0 || texts_.edit.word_of[hunk.first - 1] != hunk.now_first - 1)
            return leave_run(told, other.first, "the port says otherwise what else changed beside it");
        --hunk.first, --hunk.now_first;
    }
    while (hunk.end < here.end && word_of(hunk.end) == kNothing) {
        if (texts_.edit.word_of[hunk.end] != hunk.now_end)
            return leave_run(told, other.first, "the port says otherwise what else changed beside it");
        ++hunk.end, ++hunk.now_end;
    }
    const size_t first = hunk.first == here.first ? other.first : word_of(hunk.first - 1) + 1;
    const size_t end = hunk.end == here.end ? other.end : word_of(hunk.end);
    const CarriedWords now = carry_new(hunk.now_first, hunk.now_end);
    if (end < first) return leave_run(hunk, first, "its neighbours stand in another order there");
    if (says(first, end, now.words) && !(now.words.empty() && first == end && hunk.first != hunk.end)) {
        ++out_.already;
        return;
    }
    if (hunk.first == hunk.end && first != end) return leave_run(hunk, first, "the port has words of its own there");
    const bool says_old = says(first, end, carry_old(hunk.first, hunk.end).words, true);
    if (!says_old && !is_text_alike(hunk, first, end) && change_text_alike(hunk, first, end)) return;
    if (!says_old && !is_name_alone(hunk, first, end) && !is_text_alike(hunk, first, end))
        return leave_run(hunk, first,
                         "the port says `" + shown(texts_.target.words, first, end) + "` there, not `" +
                             shown(texts_.before.words, hunk.first, hunk.end) + "`");
    put(hunk, first, end, now);
}

void WordChanger::put(const Hunk& hunk, size_t first, size_t end, const CarriedWords& now) {
    // The scope that a name is taken from stays: `Light :: kSun` for `kSun`.
    if (hunk.end == hunk.first + 1 && !now.unknown.empty() && end > first + 2 && texts_.target.words[end - 2] == "::" &&
        texts_.target.words[end - 1] == texts_.before.words[hunk.first])
        first = end - 1;
    if (!now.unknown.empty() && !is_renamed_elsewhere(hunk, first, end))
        return leave_run(hunk, first, "nothing tells how the port says " + listed(now.unknown));
    if (hunk.end == hunk.first + 1 && hunk.now_end == hunk.now_first + 1 && end == first + 1 &&
        !uses_.is_local(hunk.now_first) &&
        translator_.declares_alone(texts_.target.words[first], texts_.now.words[hunk.now_first]))
        return leave_run(hunk, first, "the port declares `" + texts_.target.words[first] + "` itself");
    if (cuts_type(hunk, first, end)) return leave_run(hunk, first, "the port has another type there");
    if (takes_whole_numbers(hunk, first))
        return leave_run(
            hunk, first,
            "the port calls `" + callee_around(texts_.target.words, first) + "` there, which takes whole numbers");
    const auto goes_on_at = [](const std::vector<std::string>& words, size_t i) {
        return i < words.size() && is_accessor(words[i]);
    };
    if (hunk.end > hunk.first && end > first && goes_on_at(texts_.target.words, end) &&
        !goes_on_at(texts_.before.words, hunk.end) && is_word_token(texts_.target.words[end - 1]))
        return leave_run(hunk, first, "the port has an object `" + texts_.target.words[end - 1] + "` there");
    if (const std::string own = own_idiom(hunk, first, end, now); !own.empty())
        return leave_run(hunk, first, "the port has `" + own + "` in another form");
    if (const std::string name = indexed_otherwise(now.words); !name.empty())
        return leave_run(hunk, first, "the port has `" + name + "` with other indices");
    if (const std::string why = uses_.doubt_within(now.words, hunk.now_end, first); !why.empty())
        return leave_run(hunk, first, why);
    out_.replaced.push_back({first, end, now.words, hunk.now_first, hunk.now_end});
}

std::string WordChanger::own_idiom(const Hunk& hunk, size_t first, size_t end, const CarriedWords& now) const {
    const std::vector<std::string>& there = texts_.target.words;
    const auto has = [](const auto& words, size_t from, size_t to, const std::string& word) {
        const auto begin = words.begin() + static_cast<std::ptrdiff_t>(from);
        return std::find(begin, words.begin() + static_cast<std::ptrdiff_t>(to), word) !=
               words.begin() + static_cast<std::ptrdiff_t>(to);
    };
    if (end - first == hunk.end - hunk.first) return {};
    const std::vector<std::string> made = texts_of(now.words);
    const bool brings_name = std::any_of(made.begin(), made.end(), [&](const std::string& word) {
        return is_name(word) && !has(there, 0, there.size(), word) && !translator_.is_declared(word) &&
               !has(texts_.before.words, hunk.first, hunk.end, word);
    });
    if (!brings_name) return {};
    for (size_t i = first; i < end; ++i)
        if (is_name(there[i]) && i + 1 < there.size() && there[i + 1] == "(" &&
            !has(texts_.before.words, hunk.first, hunk.end, there[i]) && !has(made, 0, made.size(), there[i]))
            return there[i];
    return {};
}

bool WordChanger::cuts_type(const Hunk& hunk, size_t first, size_t end) const {
    const std::vector<std::string>&old = texts_.before.words, &there = texts_.target.words;
    for (size_t i = hunk.first; i < hunk.end; ++i)
        if (!is_type_word(old[i])) return false;
    if (hunk.first == hunk.end) return false;
    const bool own_before = first > 0 && word_is(there[first - 1], kTypePart) &&
                            (hunk.first == 0 || old[hunk.first - 1] != there[first - 1]);
    const bool own_behind =
        end < there.size() && word_is(there[end], kTypePart) && (hunk.end >= old.size() || old[hunk.end] != there[end]);
    return own_before || own_behind;
}

bool WordChanger::is_text_alike(const Hunk& hunk, size_t first, size_t end) const {
    return hunk.end == hunk.first + 1 && hunk.now_end > hunk.now_first && end == first + 1 &&
           may_replace_literal(
               {texts_.before.words[hunk.first], texts_.now.words[hunk.now_first], texts_.target.words[first]});
}

bool WordChanger::change_text_alike(const Hunk& hunk, size_t first, size_t end) {
    if (!hunk.is_word_for_word() || end != first + 1) return false;
    const std::string &was = texts_.before.words[hunk.first], &is = texts_.now.words[hunk.now_first];
    const std::string made = literal_changed_alike({was, is, texts_.target.words[first]});
    if (made.empty()) return false;
    const std::vector<std::string> had = small_words_of(was);
    std::string fresh = "\"";
    for (const std::string& word : small_words_of(is))
        if (std::find(had.begin(), had.end(), word) == had.end()) fresh += word + ' ';
    if (translator_.names_one_side(fresh + '"')) return false;
    out_.replaced.push_back({first, end, {{made, CarriedWord::kNoSource}}, hunk.now_first, hunk.now_end});
    return true;
}

bool WordChanger::loses_way_out(const Hunk& hunk) const {
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

bool WordChanger::is_renamed_elsewhere(const Hunk& hunk, size_t first, size_t end) const {
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

bool WordChanger::replace_run(const Hunk& hunk) {
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

bool WordChanger::drop_elements(const Hunk& hunk) {
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

bool WordChanger::drop_parameter(const Hunk& hunk) {
    if (hunk.now_first != hunk.now_end || hunk.end < hunk.first + 3) return false;
    const std::vector<std::string>&was = texts_.before.words, &words = texts_.target.words;
    const bool comma_first = was[hunk.first] == ",", comma_last = was[hunk.end - 1] == ",";
    if (comma_first == comma_last) return false;
    const size_t first = hunk.first + (comma_first ? 1 : 0), name = hunk.end - (comma_last ? 2 : 1);
    const size_t head_end = target(0).end;
    // One parameter as a whole.
    int depth = 0;
    for (size_t i = first; i <= name; ++i) {
        depth += is_one_of(was[i], {"(", "[", "<"}) ? 1 : is_one_of(was[i], {")", "]", ">"}) ? -1 : 0;
        if (depth < 0 || (depth == 0 && was[i] == ",")) return false;
    }
    const bool stands_so =
        (was[first - 1] == "," || was[first - 1] == "(") && (was[name + 1] == "," || was[name + 1] == ")");
    if (depth != 0 || !stands_so || !is_name(was[name])) return false;
    size_t there = kNothing, times = 0;
    for (size_t i = 1; i + 1 < head_end; ++i)
        if (words[i] == was[name] && is_one_of(words[i + 1], {",", ")"})) there = i, ++times;
    if (times != 1) return false;
    size_t begin = start_of_parameter(there), end = there + 1;
    if (begin == kNothing) return false;
    if (words[end] == ",")
        ++end;
    else if (words[begin - 1] == ",")
        --begin;
    out_.replaced.push_back({begin, end, {}, hunk.now_first, hunk.now_end});
    return true;
}

size_t WordChanger::start_of_parameter(size_t name) const {
    const std::vector<std::string>& words = texts_.target.words;
    int depth = 0;
    for (size_t i = name; i > 0; --i) {
        const std::string& word = words[i - 1];
        if (depth == 0 && (word == "," || word == "(")) return i;
        depth += is_one_of(word, {")", "]", ">"}) ? 1 : is_one_of(word, {"(", "[", "<"}) ? -1 : 0;
        if (is_one_of(word, {"{", "}", ";"})) break;
    }
    return kNothing;
}

bool WordChanger::says_alike(size_t i) const {
    const std::string &here = texts_.before.words[i], &there = texts_.target.words[word_of(i)];
    if (is_word_token(here)) return is_word_token(there);
    if (is_number_token(here)) return is_number_token(there) && number_value(here) == number_value(there);
    return here == there || texts_.before.common[i] == texts_.target.common[word_of(i)] || here == "." || here == "->";
}

bool WordChanger::has_own_prefix(size_t i, size_t there) const {
    const auto picks = [](const std::vector<std::string>& words, size_t at) {
        return at > 0 && (words[at - 1] == "::" || words[at - 1] == "." || words[at - 1] == "->");
    };
    return picks(texts_.target.words, there) && !picks(texts_.before.words, i);
}

bool WordChanger::stands_between_counterparts(const Hunk& hunk, size_t first, size_t end) const {
    const bool left = hunk.first > 0 && first > 0 && word_of(hunk.first - 1) == first - 1;
    return left && hunk.end < texts_.before.words.size() && word_of(hunk.end) == end;
}

size_t WordChanger::before_scope(size_t first, size_t word) const {
    while (word >= first + 2 && texts_.target.words[word - 1] == "::" && is_word_token(texts_.target.words[word - 2]))
        word -= 2;
    return word;
}

Hunk WordChanger::from_start_of_element(Hunk hunk, size_t first) const {
    const std::vector<std::string>&old = texts_.before.words, &now = texts_.now.words;
    const Hunk told = hunk;
    const auto is_bracket = [&](size_t i) { return is_one_of(old[i], {"(", ")", "[", "]", "{", "}", ";"}); };
    const auto starts = [&] { return old[hunk.first - 1] == "," || now[hunk.now_first] == ","; };
    while (hunk.first > first + 1 && !starts()) {
        if (is_bracket(hunk.first - 1) || old[hunk.first - 1] != now[hunk.now_end - 1]) return told;
        --hunk.first, --hunk.end, --hunk.now_first, --hunk.now_end;
    }
    return hunk.first > first + 1 ? hunk : told;
}

bool WordChanger::insert_run(Hunk hunk, size_t was, size_t there) {
    const Clause &here = before(was), &other = target(there);
    if (std::count(texts_.now.words.begin() + static_cast<std::ptrdiff_t>(hunk.now_first),
                   texts_.now.words.begin() + static_cast<std::ptrdiff_t>(hunk.now_end), ",") > 0)
        hunk = from_start_of_element(hunk, here.first);
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
                                    is_path(texts_.target.words, first, end) && !is_accessor(words[hunk.now_end - 1]);
        if (after_left == before_right && !before_operand) return false;
        place = before_operand ? first : after_left ? end_of_element(first, end) : start_of_element(first, end);
        if (place == kNothing) return false;
    } else if (left != hunk.first && right != hunk.first) {
        return false;
    }
    if (says_no_value(hunk) && says_restrict(hunk) && (place == 0 || texts_.target.words[place - 1] != "*"))
        return true;  // it qualifies pointers alone
    if (goes_on_from_missing(hunk)) {
        leave_run(hunk, place, "the port has nothing there that it goes on from");
        return true;
    }
    if (const size_t listed = place_of_enumerator(hunk); listed != kNothing && now.unknown.empty()) {
        const CarriedWords moved = words[hunk.now_first] == "," ? now : with_comma_in_front(now);
        out_.replaced.push_back({listed, listed, moved.words, hunk.now_first, hunk.now_end});
        return true;
    }
    if (was == 0 && stands_behind_other(hunk, place)) {
        const size_t behind = end_of_parameter_before(hunk);
        if (behind == kNothing || !now.unknown.empty()) {
            leave_run(hunk, place, "the port has its parameters in another order");
            return true;
        }
        put(hunk, behind, behind, words[hunk.now_end - 1] == "," ? with_comma_in_front(now) : now);
        return true;
    }
    if (was == 0 && initializes_beside_other(hunk)) {
        leave_run(hunk, place, "the port initializes something else there");
        return true;
    }
    put(hunk, place, place, now);
    return true;
}

bool WordChanger::goes_on_from_missing(const Hunk& hunk) const {
    const auto joins = [](const std::string& word) {
        return goes_on(word) || is_one_of(word, {"+",  "-",  "*",  "/",  "%", "<<", ">>", "&",  "|", "^",
                                                 "&&", "||", "==", "!=", "<", ">",  "<=", ">=", "?", ":"});
    };
    const std::vector<std::string>&old = texts_.before.words, &now = texts_.now.words;
    const auto is_value = [](const std::string& word) { return is_word_token(word) || is_number_token(word); };
    const bool from_left = hunk.first > 0 && joins(now[hunk.now_first]) && is_value(old[hunk.first - 1]);
    const bool from_right = hunk.first < old.size() && joins(now[hunk.now_end - 1]) && is_value(old[hunk.first]);
    return (from_left && word_of(hunk.first - 1) == kNothing) || (from_right && word_of(hunk.first) == kNothing);
}

size_t WordChanger::start_of_element(size_t first, size_t end) const {
    const std::vector<std::string>& words = texts_.target.words;
    int depth = 0;
    for (size_t i = end; i > 0; --i) {
        const std::string& word = words[i - 1];
        if (depth == 0 && (word == "," || word == "(" || word == "{" || word == ":")) return i;
        if (i == first) break;
        depth += word == ")" || word == "]" || word == "}" ? 1 : word == "(" || word == "[" || word == "{" ? -1 : 0;
    }
    return kNothing;
}

size_t WordChanger::end_of_element(size_t first, size_t end) const {
    const std::vector<std::string>& words = texts_.target.words;
    int depth = 0;
    for (size_t i = first; i <= end && i < words.size(); ++i) {
        const std::string& word = words[i];
        const bool closes = word == ")" || word == "]" || word == "}";
        if (depth == 0 && (word == "," || word == ";" || word == "{" || closes || (word == ">" && i == end))) return i;
        depth += word == "(" || word == "[" || word == "{" ? 1 : closes ? -1 : 0;
    }
    return kNothing;
}

size_t WordChanger::place_of_enumerator(const Hunk& hunk) const {
    const std::vector<std::string>&old = texts_.before.words, &now = texts_.now.words, &there = texts_.target.words;
    const auto is_enumeration = [](const std::vector<std::string>& words) {
        return words.size() > 2 && (words[0] == "enum" || words[1] == "enum");
    };
    if (!is_enumeration(old) || !is_enumeration(there) || hunk.first == 0) return kNothing;
    const bool comma_first = now[hunk.now_first] == ",", comma_last = now[hunk.now_end - 1] == ",";
    if (comma_first == comma_last) return kNothing;
    const size_t last = hunk.first - (comma_last && old[hunk.first - 1] == "," ? 2 : 1);
    if (last >= old.size() || !is_name(old[last])) return kNothing;  // one with a value is where it is counted from
    const size_t times = static_cast<size_t>(std::count(there.begin(), there.end(), old[last]));
    const auto at = static_cast<size_t>(std::find(there.begin(), there.end(), old[last]) - there.begin());
    return times == 1 && at + 1 < there.size() && is_one_of(there[at + 1], {",", "}"}) ? at + 1 : kNothing;
}

CarriedWords WordChanger::with_comma_in_front(CarriedWords element) {
    std::rotate(element.words.begin(), element.words.end() - 1, element.words.end());
    element.words.front().from = CarriedWord::kNoSource;
    return element;
}

std::string WordChanger::parameter_before(const std::vector<std::string>& words, size_t i) {
    while (i > 0 && words[i - 1] == ",") --i;
    const bool ends = i > 1 && is_name(words[i - 1]) && i < words.size() && is_one_of(words[i], {",", ")"});
    return ends ? words[i - 1] : std::string();
}

bool WordChanger::are_called_alike(const std::string& a, const std::string& b) {
    const std::string here = folded(a), there = folded(b);
    return here.starts_with(there) || there.starts_with(here);
}

bool WordChanger::stands_behind_other(const Hunk& hunk, size_t place) const {
    const std::string here = parameter_before(texts_.before.words, hunk.first),
                      there = parameter_before(texts_.target.words, place);
    if (here.empty() || there.empty() || are_called_alike(here, there)) return false;
    for (size_t i = 1; i + 1 < target(0).end; ++i)
        if (is_name(texts_.target.words[i]) && is_one_of(texts_.target.words[i + 1], {",", ")"}) &&
            are_called_alike(here, texts_.target.words[i]))
            return true;
    return false;
}

size_t WordChanger::end_of_parameter_before(const Hunk& hunk) const {
    const std::string name = parameter_before(texts_.before.words, hunk.first);
    const std::vector<std::string>& words = texts_.target.words;
    size_t out = kNothing;
    for (size_t i = 1; i + 1 < target(0).end; ++i) {
        if (!is_name(words[i]) || !is_one_of(words[i + 1], {",", ")"}) || !are_called_alike(name, words[i])) continue;
        if (out != kNothing) return kNothing;
        out = i + 1;
    }
    return out;
}

bool WordChanger::is_idle_bracket(const Hunk& hunk) const {
    return hunk.end == hunk.first + 1 && hunk.now_first == hunk.now_end &&
           is_one_of(texts_.before.words[hunk.first], {"(", ")"}) && word_of(hunk.first) == kNothing;
}

bool WordChanger::initializes_beside_other(const Hunk& hunk) const {
    const std::vector<std::string>&words = texts_.before.words, &is = texts_.now.words;
    // `m_b ( b )` in `m_a ( a ) , m_b ( b ) {` came as `, m_b ( b )` or as `) , m_b ( b`.
    const bool is_shifted = is[hunk.now_first] == ")";
    const size_t comma = hunk.now_first + (is_shifted ? 1 : 0);
    if (hunk.first == 0 || comma >= hunk.now_end || is[comma] != ",") return false;
    if (!is_shifted && words[hunk.first - 1] != ")") return false;
    int depth = is_shifted ? 1 : 0;
    size_t open = hunk.first;
    do {
        --open;
        depth += words[open] == ")" ? 1 : words[open] == "(" ? -1 : 0;
    } while (depth != 0 && open > 0);
    if (open < 2 || !is_word_token(words[open - 1]) || (words[open - 2] != "," && words[open - 2] != ":")) return false;
    const size_t there = word_of(open - 1);
    return there == kNothing || there == 0 || there + 1 >= texts_.target.words.size() ||
           texts_.target.words[there + 1] != "(" || texts_.target.words[there] != words[open - 1];
}

bool WordChanger::is_neutral(const Hunk& hunk) const {
    if (translator_.are_qualifiers(texts_.before.words, hunk.first, hunk.end) &&
        translator_.are_qualifiers(texts_.now.words, hunk.now_first, hunk.now_end))
        return false;  // beside what is due the port gets them, too
    return translator_.meaning(texts_.before.words, hunk.first, hunk.end) ==
           translator_.meaning(texts_.now.words, hunk.now_first, hunk.now_end);
}

void WordChanger::take_spellings(const std::vector<Hunk>& hunks, size_t first_spelling) {
    for (const Hunk& hunk : hunks) {
        if (!is_neutral(hunk) || !is_spelled_alike(hunk) || is_of_own_scope(hunk)) continue;
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

bool WordChanger::is_spelled_alike(const Hunk& hunk) const {
    if (hunk.first == hunk.end || hunk.now_first == hunk.now_end) return false;
    const size_t first = word_of(hunk.first);
    for (size_t i = hunk.first; i < hunk.end; ++i)
        if (first == kNothing || word_of(i) != first + (i - hunk.first) ||
            texts_.target.words[word_of(i)] != texts_.before.words[i])
            return false;
    return true;
}

void WordChanger::respell(const Hunk& hunk) {
    if (hunk.first == hunk.end) return put_scope(hunk);
    if (!is_spelled_alike(hunk)) return;
    if (is_of_own_scope(hunk)) {
        ++out_.already;
        return;
    }
    const size_t first = word_of(hunk.first), size = hunk.end - hunk.first;
    if (takes_whole_numbers(hunk, first))
        return leave_run(
            hunk, first,
            "the port calls `" + callee_around(texts_.target.words, first) + "` there, which takes whole numbers");
    CarriedWords now = carry_new(hunk.now_first, hunk.now_end);
    if (!now.unknown.empty() || marks_otherwise(hunk)) return;
    now.words.clear();
    for (size_t i = hunk.now_first; i < hunk.now_end; ++i) now.words.push_back({written_(i), i});
    respelled_.push_back({first, first + size, std::move(now.words), hunk.now_first, hunk.now_end});
}

bool WordChanger::is_of_own_scope(const Hunk& hunk) const {
    const size_t there = word_of(hunk.first);
    const auto is_scoped = [](const std::vector<std::string>& words, size_t i) {
        return i > 0 && words[i - 1] == "::";
    };
    return hunk.is_word_for_word() && is_name(texts_.before.words[hunk.first]) &&
           is_scoped(texts_.target.words, there) && !is_scoped(texts_.before.words, hunk.first) &&
           !translator_.has_file_there(texts_.now.words[hunk.now_first]);
}

bool WordChanger::takes_whole_numbers(const Hunk& hunk, size_t first) const {
    if (!hunk.is_word_for_word()) return false;
    const std::string &was = texts_.before.words[hunk.first], &is = texts_.now.words[hunk.now_first];
    return is_number_token(was) && is_number_token(is) && !is_real_number(was) && is_real_number(is) &&
           is_one_of(callee_around(texts_.target.words, first), {"pown", "rootn", "ldexp"});
}

bool WordChanger::marks_otherwise(const Hunk& hunk) const {
    if (!hunk.is_word_for_word() || !is_number_token(texts_.before.words[hunk.first])) return false;
    const auto is_marked = [](const std::string& number) { return number.ends_with('f') || number.ends_with('F'); };
    return is_marked(texts_.before.words[hunk.first]) != is_marked(texts_.now.words[hunk.now_first]);
}

void WordChanger::put_scope(const Hunk& hunk) {
    const size_t name = hunk.first, there = name < texts_.before.words.size() ? word_of(name) : kNothing;
    if (hunk.now_first == hunk.now_end || texts_.now.words[hunk.now_end - 1] != "::" || there == kNothing ||
        texts_.target.words[there] != texts_.before.words[name] || has_own_prefix(name, there))
        return;
    CarriedWords scope = carry_new(hunk.now_first, hunk.now_end);
    if (scope.unknown.empty())
        respelled_.push_back({there, there, std::move(scope.words), hunk.now_first, hunk.now_end});
}

bool WordChanger::is_name_alone(const Hunk& hunk, size_t first, size_t end) const {
    return hunk.end == hunk.first + 1 && end == first + 1 && is_word_token(texts_.before.words[hunk.first]) &&
           is_word_token(texts_.target.words[first]);
}

void WordChanger::leave_run(const Hunk& hunk, size_t target_word, const std::string& why) {
    const std::string was = shown(texts_.before.words, hunk.first, hunk.end);
    const std::string is = shown(texts_.now.words, hunk.now_first, hunk.now_end);
    leave((was.empty()  ? "the source gained `" + is + "`"
           : is.empty() ? "the source lost `" + was + "`"
                        : "the source has `" + is + "` for `" + was + "`") +
              "; " + why,
          std::min(hunk.now_first, texts_.now.words.size() - 1), target_word);
}

void WordChanger::leave(std::string message, size_t source_word, size_t target_word) {
    out_.left.push_back({std::move(message), source_word, target_word});
}

}  // namespace porttool
