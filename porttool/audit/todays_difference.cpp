// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/todays_difference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "porttool/audit/around.h"
#include "porttool/audit/aside.h"
#include "porttool/audit/declaration_edit.h"
#include "porttool/audit/replaced_statement.h"
#include "porttool/audit/same_value.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/diff.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

constexpr float kSameStatement = 0.7f;
constexpr size_t kTellingName = 5;  ///< letters of a name that is part of another one's

bool is_operator_of_operand(const std::string& word) {
    return is_one_of(word, {"+", "-", "*", "/", "%", "&&", "||", "&", "|", "^"});
}

bool compares(const std::string& word) { return is_one_of(word, {"<", ">", "<=", ">="}); }

bool is_bound(const std::string& word) { return is_one_of(word, {"min", "max", "clamp"}); }

bool is_keyword(const std::string& word) {
    return word_is(word, kKeyword) || is_type_word(word) ||
           is_one_of(word, {"return", "else", "case", "true", "false"});
}

/// The names of some words.
std::vector<std::string> names_in(const Text& words) {
    std::vector<std::string> out;
    for (const std::string& word : words)
        if (is_word_token(word) && !is_keyword(word)) out.push_back(word);
    return out;
}

bool has_all(const Text& words, const std::vector<std::string>& of) {
    return std::all_of(of.begin(), of.end(), [&](const std::string& one) {
        return std::find(words.begin(), words.end(), one) != words.end();
    });
}

/// The blocks of words that a diff of two texts takes out of the first.
std::vector<Text> blocks_more(const Text& longer, const Text& shorter) {
    std::vector<Text> out;
    bool goes_on = false;
    for (const DiffStep& step : diff(longer, shorter)) {
        if (step.kind == DiffStep::Add) return {};
        if (step.kind == DiffStep::Remove) {
            if (!goes_on) out.emplace_back();
            out.back().push_back(longer[step.before]);
        }
        goes_on = step.kind == DiffStep::Remove;
    }
    return out;
}

/// True for two statements that differ in nothing but one `true` for a `false`.
bool differ_in_truth(const Text& a, const Text& b) {
    if (a.size() != b.size()) return false;
    size_t other = 0;
    bool truth = true;
    for (size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) continue;
        ++other;
        truth = truth && is_one_of(a[i], {"true", "false"}) && is_one_of(b[i], {"true", "false"});
    }
    return other == 1 && truth;
}

/// The place of the one member by which two statements differ, which is longer than a component's name; 0 for others.
size_t member_that_differs(const Text& a, const Text& b) {
    if (a.size() != b.size()) return 0;
    size_t out = 0;
    for (size_t i = 1; i < a.size(); ++i) {
        if (a[i] == b[i]) continue;
        const bool members = a[i - 1] == "." && is_word_token(a[i]) && is_word_token(b[i]) && a[i].size() > 2 &&
                             b[i].size() > 2 && (i + 1 == a.size() || a[i + 1] != "(");
        if (!members || out != 0) return 0;
        out = i;
    }
    return a[0] == b[0] ? out : 0;
}

/// True where what differs are numbers of a size by which nothing is meant but next to nothing, or next to everything.
bool differ_in_guards(const Text& a, const Text& b) {
    constexpr double kSmall = 1e-4, kGreat = 1e4;
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) continue;
        if (!is_number_token(a[i]) || !is_number_token(b[i])) return false;
        const double one = std::abs(std::strtod(a[i].c_str(), nullptr)),
                     two = std::abs(std::strtod(b[i].c_str(), nullptr));
        const bool small = one <= kSmall && two <= kSmall && one > 0 && two > 0;
        if (!small && !(one >= kGreat && two >= kGreat)) return false;
    }
    return true;
}

/// `o . f = ...` as object and field; both "" for others.
std::pair<std::string, std::string> member_set(const Text& words) {
    const bool sets = words.size() > 4 && is_word_token(words[0]) && words[1] == "." && is_word_token(words[2]) &&
                      words[3] == "=" && words[2].size() > 1;
    return sets ? std::pair(words[0], words[2]) : std::pair<std::string, std::string>();
}

/// The words that two statements have of their own, each with a mark of whose it is.
Text words_that_differ(const Text& a, const Text& b) {
    Text out;
    for (const DiffStep& step : diff(a, b))
        if (step.kind != DiffStep::Keep)
            out.push_back(step.kind == DiffStep::Add ? "+" + b[step.now] : "-" + a[step.before]);
    std::sort(out.begin(), out.end());
    return out;
}

/// True for `if ( ! a || ! b )`: which of its pointers a side tests is its own affair.
bool asks_for_null_alone(const Text& words) {
    return words.size() > 4 && words[0] == "if" &&
           std::all_of(words.begin(), words.end(),
                       [](const std::string& word) {
                           return is_word_token(word) || is_one_of(word, {"(", ")", "!", "||"});
                       }) &&
           std::count(words.begin(), words.end(), "!") == std::count(words.begin(), words.end(), "||") + 1;
}

bool has_call(const Text& words) {
    for (size_t i = 0; i + 1 < words.size(); ++i)
        if (words[i + 1] == "(" && is_word_token(words[i]) && !is_keyword(words[i])) return true;
    return false;
}

/// The names that a question is about: the last of each way, `inside` of `! hit . inside`.
Text members_in(const Text& words) {
    Text out;
    for (size_t i = 0; i < words.size(); ++i)
        if (is_word_token(words[i]) && !is_keyword(words[i]) && (i + 1 == words.size() || words[i + 1] != "."))
            out.push_back(words[i]);
    return out;
}

/// A call of a statement, with all its words.
struct CallThere {
    size_t statement = 0;
    Text words;
};

/// The calls of a side that take more than one argument and are not overly long.
std::vector<CallThere> calls_of(const ReadSide& read) {
    constexpr size_t kMostWords = 64;
    std::vector<CallThere> out;
    for (size_t i = 1; i < read.words.size(); ++i) {
        const Text& words = read.words[i];
        for (size_t first = 0; first + 1 < words.size(); ++first) {
            if (words[first + 1] != "(" || !is_word_token(words[first]) || is_keyword(words[first])) continue;
            size_t end = first + 1, commas = 0;
            for (int depth = 0; end < words.size() && end - first < kMostWords; ++end) {
                depth += is_one_of(words[end], {"(", "["}) ? 1 : is_one_of(words[end], {")", "]"}) ? -1 : 0;
                commas += depth == 1 && words[end] == "," ? 1 : 0;
                if (depth == 0) break;
            }
            if (end < words.size() && commas > 0 && end - first < kMostWords)
                out.push_back({i, Text(words.begin() + static_cast<ptrdiff_t>(first),
                                       words.begin() + static_cast<ptrdiff_t>(end) + 1)});
        }
    }
    return out;
}

/// What `a && b && c` asks for, without brackets around each. Empty for other statements.
std::vector<Text> questions_of(const Text& words) {
    size_t first = 0;
    if (words.size() > 3 && words[0] == "if" && words[1] == "(") first = 2;
    if (words.size() > 3 && is_word_token(words[0]) && words[1] == "=") first = 2;
    if (words.size() > 2 && words[0] == "return") first = 1;
    if (first == 0) return {};
    const size_t end = words[0] == "if" ? words.size() - 1 : words.size();
    std::vector<Text> out(1);
    int depth = 0;
    for (size_t i = first; i < end; ++i) {
        depth += is_one_of(words[i], {"(", "[", "{"}) ? 1 : is_one_of(words[i], {")", "]", "}"}) ? -1 : 0;
        if (depth == 0 && is_one_of(words[i], {"||", "?", ";", ","})) return {};
        if (depth < 0) break;
        if (depth == 0 && words[i] == "&&")
            out.emplace_back();
        else
            out.back().push_back(words[i]);
    }
    return out.size() > 1 ? out : std::vector<Text>();
}

/// True for a statement that leaves with nothing computed: `return`, `return -1`.
bool goes_away(const Text& words) {
    if (words.empty() || !is_one_of(words[0], {"return", "continue", "break"})) return false;
    const size_t value = words.size() > 1 && words[1] == "-" ? 2 : 1;
    return std::none_of(words.begin() + static_cast<ptrdiff_t>(value), words.end(), is_operator_of_operand);
}

}  // namespace

std::optional<OperandMore> operand_more(const Text& a, const Text& b) {
    constexpr size_t kMost = 10;  // words
    if (a.empty() || b.empty() || a.front() != b.front()) return std::nullopt;
    OperandMore out;
    out.first_has_it = a.size() > b.size();
    const std::vector<Text> blocks = out.first_has_it ? blocks_more(a, b) : blocks_more(b, a);
    if (blocks.empty() || blocks.size() > 2) return std::nullopt;
    for (const Text& block : blocks) out.words.insert(out.words.end(), block.begin(), block.end());
    if (out.words.size() > kMost) return std::nullopt;
    const Text& last = blocks.back();
    if (blocks.size() == 1) {
        const bool joins = is_operator_of_operand(last.front()) || is_operator_of_operand(last.back());
        const auto opens = std::count(last.begin(), last.end(), "("),
                   closes = std::count(last.begin(), last.end(), ")");
        if (!joins || opens != closes || (last.size() == 1 && last[0] != "-")) return std::nullopt;
        return out;
    }
    const bool bounds =
        blocks[0].size() == 2 && blocks[0][1] == "(" && last[0] == "," && last.back() == ")" && is_bound(blocks[0][0]);
    const bool joins =
        blocks[0] == Text{"("} && last.size() > 2 && is_operator_of_operand(last[0]) && last.back() == ")";
    return bounds || joins ? std::optional(out) : std::nullopt;
}

TodaysDifferences::TodaysDifferences(const CommonTexts& texts, const SaidOtherwise& otherwise)
    : texts_(texts), otherwise_(otherwise) {
    for (const Side side : kBothSides) {
        const ReadSide& read = texts.sides[side];
        for (size_t i = 0; i < read.words.size(); ++i) {
            said_[side].insert(read.words[i]);
            const bool is_switch = !read.written[i].empty() && read.written[i][0] == '#';
            WordsOfSide& words = is_switch ? switch_words_[side] : code_words_[side];
            words.insert(read.words[i].begin(), read.words[i].end());
        }
    }
}

/// True where they say nearly the same, and no other statement of either side does that as well.
bool TodaysDifferences::is_one_statement(size_t source, size_t target, float distance) const {
    const ReadSide &here = texts_.sides.source, &there = texts_.sides.target;
    return 1 - distance / (here.weighed[source].sum + there.weighed[target].sum) >= kSameStatement;
}

/// True where the two differ in nothing that counts.
bool TodaysDifferences::is_no_difference(size_t source, size_t target) const {
    const WrittenStatement &now = texts_.sides.source.written[source], &then = texts_.sides.target.written[target];
    const Text &words = texts_.sides.source.words[source], &others = texts_.sides.target.words[target];
    const Text here = words_of_statement(now), there = words_of_statement(then);
    return renames_what_it_declares(there, here) || is_turned_round(there, here) ||
           give_the_same_value(others, words, has_real_number(here)) || runs_other_threads(here, there) ||
           takes_in_other_order(others, words) || fits_narrower_type(then, now, then) ||
           fits_narrower_type(now, then, now);
}

std::vector<MissingPlace> TodaysDifferences::few() const {
    constexpr float kTwins = 0.5f;
    constexpr size_t kFew = 8;
    std::vector<MissingPlace> out;
    const ReadSide &source = texts_.sides.source, &target = texts_.sides.target;
    if (texts_.alike() < kTwins && source.words.size() > 1) return out;
    for (size_t i = source.words.size() > 1 ? 1 : 0; i < source.words.size(); ++i) {
        const Nearest near = nearest(source.weighed[i], target.weighed);
        if (!near.any || near.distance <= 0 || source.repeats.contains(i) ||
            said_.source.contains(target.words[near.index]))
            continue;
        const Text here = words_of_statement(source.written[i]), there = words_of_statement(target.written[near.index]);
        if (says_nothing(here) && !declares_another_value(there, here)) continue;
        if (!is_one_statement(i, near.index, near.distance)) continue;
        MissingPlace place;
        place.now = source.written[i];
        place.there = target.written[near.index];
        place.strength = substance_of(target.words[near.index], source.words[i], texts_.known_there(Side::Source));
        if (place.strength < kSameStatement || is_no_difference(i, near.index)) continue;
        out.push_back(std::move(place));
    }
    if (out.size() > kFew) out.clear();
    return out;
}

std::vector<MissingPlace> TodaysDifferences::slips() const {
    std::vector<Slip> found;
    for (size_t i = 1; i < texts_.sides.source.words.size(); ++i) add_slip(i, found);
    add_calls(found);
    add_conditions(found);
    std::map<Text, size_t> times;
    for (const Slip& slip : found) ++times[slip.core];
    constexpr size_t kManner = 3;  // what a pair says otherwise so often it means to
    std::vector<MissingPlace> out;
    for (Slip& slip : found)
        if (times[slip.core] < kManner) out.push_back(std::move(slip.place));
    for (const Side side : kBothSides) {
        add_guards(side, out);
        add_members(side, out);
    }
    add_member_values(out);
    return out;
}

float TodaysDifferences::around(size_t source, size_t target) const {
    const auto here = shared_around(texts_.sides.source, source, texts_.sides.target),
               there = shared_around(texts_.sides.target, target, texts_.sides.source);
    return (here.value_or(texts_.alike()) + there.value_or(texts_.alike())) / 2;
}

void TodaysDifferences::add_slip(size_t source, std::vector<Slip>& out) const {
    const ReadSide &here = texts_.sides.source, &there = texts_.sides.target;
    if (here.repeats.contains(source) || said_.target.contains(here.words[source])) return;
    const Nearest near = nearest(here.weighed[source], there.weighed);
    if (!near.any || near.index == 0 || said_.source.contains(there.words[near.index])) return;
    if (!is_one_statement(source, near.index, near.distance)) return;
    const Nearest back = nearest(there.weighed[near.index], here.weighed);
    if (here.words[back.index] != here.words[source]) return;
    const float worth = worth_of_slip(source, near.index);
    if (worth <= 0 || is_no_difference(source, near.index)) return;
    MissingPlace place;
    place.now = here.written[source];
    place.there = there.written[near.index];
    place.around = around(source, near.index);
    constexpr float kUnlike = 0.1f, kOtherTexts = 0.6f;
    place.strength = worth * (0.4f + 0.6f * place.around) * (texts_.alike() < kUnlike ? kOtherTexts : 1.0f);
    if (member_that_differs(here.words[source], there.words[near.index]) != 0)
        place.strength = worth * (0.5f + 0.5f * place.around);  // few say so much alike and mean another member
    out.push_back({std::move(place), words_that_differ(here.words[source], there.words[near.index])});
}

/// True for two statements that say something which both sides would have to say, in one of their builds.
bool TodaysDifferences::may_slip(size_t source, size_t target) const {
    const Text &now = texts_.sides.source.words[source], &then = texts_.sides.target.words[target];
    return !is_aside(words_of_statement(texts_.sides.source.written[source])) &&
           !is_aside(words_of_statement(texts_.sides.target.written[target])) && !moves_memory(now) &&
           !sizes_launch(now) && !CommonTexts::name_thread(now) && !CommonTexts::name_thread(then) &&
           !is_alternative(texts_.sides.source, source, texts_.sides.target) &&
           !is_alternative(texts_.sides.target, target, texts_.sides.source);
}

void TodaysDifferences::add_calls(std::vector<Slip>& out) const {
    constexpr size_t kFewestNames = 3;  // that both calls have, with that of the function
    constexpr float kKnown = 0.75f, kKnownElsewhere = 0.65f;
    const BySide<std::vector<CallThere>> calls{calls_of(texts_.sides.source), calls_of(texts_.sides.target)};
    BySide<std::set<Text>> said;
    for (const Side side : kBothSides)
        for (const CallThere& call : calls[side]) said[side].insert(call.words);
    std::set<size_t> told;
    for (const CallThere& now : calls.source) {
        if (said.target.contains(now.words) || told.contains(now.statement)) continue;
        const CallThere* twin = nullptr;
        std::optional<OperandMore> more;
        for (const CallThere& there : calls.target) {
            if (there.words.front() != now.words.front() || said.source.contains(there.words)) continue;
            if (auto one = operand_more(now.words, there.words)) {
                twin = &there;
                more = std::move(one);
                break;
            }
        }
        if (twin == nullptr || names_in(more->first_has_it ? twin->words : now.words).size() < kFewestNames) continue;
        const Side lacks = more->first_has_it ? Side::Target : Side::Source;
        const size_t index = more->first_has_it ? twin->statement : now.statement;
        const std::vector<std::string> names = names_in(more->words);
        if (names.empty() || !may_slip(now.statement, twin->statement) || is_said_near(lacks, index, more->words) ||
            !uses_all(lacks, names) || is_no_difference(now.statement, twin->statement))
            continue;
        MissingPlace place;
        place.now = texts_.sides.source.written[now.statement];
        place.there = texts_.sides.target.written[twin->statement];
        place.around = around(now.statement, twin->statement);
        place.strength = (knows(lacks, more->words) ? kKnown : kKnownElsewhere) * (0.5f + 0.5f * place.around);
        told.insert(now.statement);
        out.push_back({std::move(place), words_that_differ(now.words, twin->words)});
    }
}

void TodaysDifferences::add_conditions(std::vector<Slip>& out) const {
    const ReadSide &here = texts_.sides.source, &there = texts_.sides.target;
    for (size_t i = 1; i < here.words.size(); ++i) {
        if (here.repeats.contains(i) || said_.target.contains(here.words[i]) || questions_of(here.words[i]).empty())
            continue;
        const Nearest near = nearest(here.weighed[i], there.weighed);
        if (!near.any || near.index == 0 || said_.source.contains(there.words[near.index])) continue;
        const Nearest back = nearest(there.weighed[near.index], here.weighed);
        if (here.words[back.index] == here.words[i]) add_condition(i, near.index, out);
    }
}

void TodaysDifferences::add_condition(size_t source, size_t target, std::vector<Slip>& out) const {
    constexpr float kSameQuestion = 0.2f, kAlikeInAll = 0.6f;
    const Text &now = texts_.sides.source.words[source], &then = texts_.sides.target.words[target];
    std::vector<Text> here = questions_of(now), there = questions_of(then);
    const bool source_has = here.size() > there.size();
    std::vector<Text>&longer = source_has ? here : there, &shorter = source_has ? there : here;
    if (shorter.empty() || longer.size() != shorter.size() + 1 || now.front() != then.front()) return;
    float sum = 0;
    for (const Text& one : shorter) {
        const auto best = std::max_element(longer.begin(), longer.end(), [&](const Text& a, const Text& b) {
            return likeness_by_endings(one, a) < likeness_by_endings(one, b);
        });
        const float alike = likeness_by_endings(one, *best);
        if (alike < kSameQuestion) return;
        sum += alike;
        longer.erase(best);
    }
    if (sum < kAlikeInAll * static_cast<float>(shorter.size())) return;
    const Text& more = longer.front();
    const Side lacks = source_has ? Side::Target : Side::Source;
    const size_t index = source_has ? target : source;
    const Text members = members_in(more);
    const bool by_switch = std::any_of(members.begin(), members.end(),
                                       [&](const auto& one) { return switch_words_[lacks].contains(one); });
    if (members.empty() || by_switch || !may_slip(source, target) || !uses_all(lacks, members) ||
        is_said_near(lacks, index, members) || is_no_difference(source, target))
        return;
    MissingPlace place;
    place.now = texts_.sides.source.written[source];
    place.there = texts_.sides.target.written[target];
    place.around = around(source, target);
    constexpr float kWorth = 0.6f;
    place.strength = kWorth * (0.5f + 0.5f * place.around);
    out.push_back({std::move(place), more});
}

float TodaysDifferences::worth_of_slip(size_t source, size_t target) const {
    constexpr float kTelling = 7, kTellingEnough = 5;
    const Text &now = texts_.sides.source.words[source], &then = texts_.sides.target.words[target];
    const float sum = std::max(texts_.sides.source.weighed[source].sum, texts_.sides.target.weighed[target].sum);
    const Text here = words_of_statement(texts_.sides.source.written[source]),
               there = words_of_statement(texts_.sides.target.written[target]);
    if (asks_for_null_alone(now) && asks_for_null_alone(then)) return 0;
    if (is_aside(here) || is_aside(there) || moves_memory(now) || sizes_launch(now) || differ_in_guards(now, then) ||
        CommonTexts::name_thread(now) || CommonTexts::name_thread(then))
        return 0;
    if (is_alternative(texts_.sides.source, source, texts_.sides.target) ||
        is_alternative(texts_.sides.target, target, texts_.sides.source))
        return 0;
    if (differ_in_truth(now, then)) return 0.6f;
    if (const size_t at = member_that_differs(now, then)) {
        const bool known = uses_all(Side::Source, {then[at]}) && uses_all(Side::Target, {now[at]});
        return known && sum >= kTelling ? 0.65f : 0;
    }
    if (differs_by_a_slip(then, now))
        return sum >= kTelling && substance_of(then, now, texts_.known_there(Side::Source)) >= kSameStatement ? 0.38f
                                                                                                              : 0;
    const auto more = operand_more(now, then);
    if (!more || sum < kTellingEnough) return 0;
    const Side lacks = more->first_has_it ? Side::Target : Side::Source;
    const size_t index = more->first_has_it ? target : source;
    return knows(lacks, more->words) && !is_said_near(lacks, index, more->words) ? 0.8f : 0;
}

/// True if the side's code uses all names, and no switch of the preprocessor goes by one of them.
bool TodaysDifferences::knows(Side side, const Text& words) const {
    std::vector<std::string> names = names_in(words);
    std::erase_if(names, is_bound);
    return std::all_of(names.begin(), names.end(), [&](const std::string& name) {
        return code_words_[side].contains(name) && !switch_words_[side].contains(name);
    });
}

/// True if the side says what a statement of it lacks in another one a few places off, which asks for it or sets what
/// the statement takes: `b *= k ; a = b`.
bool TodaysDifferences::is_said_near(Side side, size_t index, const Text& more) const {
    constexpr size_t kBefore = 8, kBehind = 4;
    const ReadSide& read = texts_.sides[side];
    std::vector<std::string> wanted = names_in(more);
    std::erase_if(wanted, is_bound);
    for (const std::string& word : more)
        if (is_number_token(word)) wanted.push_back(word);
    if (wanted.empty()) return false;
    const Text& lacks = read.words[index];
    const size_t end = std::min(read.words.size(), index + kBehind + 1);
    for (size_t i = index - std::min(index, kBefore); i < end; ++i) {
        const Text& words = read.words[i];
        if (i == index || i == 0 || words.empty() || !has_all(words, wanted)) continue;
        if (words[0] == "if" || std::find(lacks.begin(), lacks.end(), words[0]) != lacks.end()) return true;
    }
    return false;
}

MissingPlace TodaysDifferences::place_of(Side side, size_t index) const {
    MissingPlace place;
    place.kind = MissingPlace::Kind::Added;
    (side == Side::Source ? place.now : place.there) = texts_.sides[side].written[index];
    const auto shared = shared_around(texts_.sides[side], index, texts_.sides[other(side)]);
    place.around = shared.value_or(texts_.alike());
    return place;
}

void TodaysDifferences::add_guards(Side side, std::vector<MissingPlace>& out) const {
    constexpr float kCounterpart = 0.5f, kSomeAlike = 0.15f;
    const ReadSide &own = texts_.sides[side], &others = texts_.sides[other(side)];
    if (texts_.alike() < kSomeAlike) return;
    std::vector<WeighedWords> alone;  // a guard that both have is no counterpart of another one
    for (size_t i = 0; i < others.words.size(); ++i)
        if (!said_[side].contains(others.words[i])) alone.push_back(others.weighed[i]);
    for (size_t i = 1; i + 1 < own.words.size(); ++i) {
        const Text& words = own.words[i];
        if (words.empty() || words[0] != "if" || !goes_away(own.words[i + 1]) || CommonTexts::name_thread(words))
            continue;
        if (std::none_of(words.begin(), words.end(), compares)) continue;
        const bool by_number = std::any_of(words.begin(), words.end(), is_number_token);
        const std::vector<std::string> names = names_in(words);
        if (!by_number || names.empty() || !uses_all(other(side), names)) continue;
        if (std::none_of(names.begin(), names.end(),
                         [&](const auto& one) { return code_words_[other(side)].contains(one); }))
            continue;
        const Nearest near = nearest(own.weighed[i], alone);
        if (said_[other(side)].contains(words) ||
            (near.any && likeness(own.weighed[i], alone[near.index]) > kCounterpart))
            continue;
        if (otherwise_.is_said_in_unit(side, i) || otherwise_.is_said_in_call(side, i) ||
            is_left_otherwise(own, i, others))
            continue;
        MissingPlace place = place_of(side, i);
        place.strength = 0.35f + 0.2f * place.around;
        out.push_back(std::move(place));
    }
}

/// True if all names are in use on the side, in its unit or elsewhere.
bool TodaysDifferences::uses_all(Side side, const std::vector<std::string>& names) const {
    const KnownThere there = texts_.known_there(other(side));
    return std::all_of(names.begin(), names.end(), [&](const std::string& one) {
        return there.unit->contains(one) || there.file->contains(one) || there.side->contains(one);
    });
}

TodaysDifferences::Members TodaysDifferences::members_of(Side side) const {
    Members out;
    const ReadSide& read = texts_.sides[side];
    for (size_t i = 1; i < read.words.size(); ++i) {
        const auto [object, field] = member_set(read.words[i]);
        if (!object.empty()) out[object][field].push_back(i);
    }
    return out;
}

/// True where a neighbour sets another member of the same object, as the other side does, too, and beside that no
/// member which this side does not know: it may be the same by another name.
bool TodaysDifferences::stands_beside_twin(const Members& here, const Members& there, Side side, size_t index) const {
    const ReadSide &own = texts_.sides[side], &others = texts_.sides[other(side)];
    const auto member = [](const ReadSide& read, size_t i) {
        return i < read.words.size() ? member_set(read.words[i]) : std::pair<std::string, std::string>();
    };
    const std::string object = member(own, index).first;
    for (const bool forward : {false, true}) {
        const auto [beside, field] = member(own, forward ? index + 1 : index - 1);
        if (beside != object || !there.at(object).contains(field)) continue;
        const size_t twin = there.at(object).at(field).front();
        const auto [across, unknown] = member(others, forward ? twin - 1 : twin + 1);
        if (across != object || here.at(object).contains(unknown)) return true;
    }
    return false;
}

void TodaysDifferences::add_members(Side side, std::vector<MissingPlace>& out) const {
    const Members here = members_of(side), there = members_of(other(side));
    std::set<std::string> any_there;
    for (const auto& [object, fields] : there)
        for (const auto& [field, places] : fields) any_there.insert(field);
    for (const auto& [object, fields] : here) {
        if (!there.contains(object)) continue;
        for (const auto& [field, places] : fields) {
            const Text& words = texts_.sides[side].words[places.front()];
            std::vector<std::string> names = names_in(Text(words.begin() + 4, words.end()));
            const bool has_names = !names.empty();  // of which the unit's own may be called otherwise
            std::erase_if(names, [&](const auto& one) { return texts_.own_names[side].contains(one); });
            const bool is_called_otherwise =
                std::any_of(any_there.begin(), any_there.end(), [&, &own = field](const std::string& one) {
                    return one == own || (one.size() >= kTellingName && own.starts_with(one)) ||
                           (own.size() >= kTellingName && one.starts_with(own));
                });
            if (!has_names || is_called_otherwise || !stands_beside_twin(here, there, side, places.front())) continue;
            names.push_back(field);
            if (!uses_all(other(side), names)) continue;
            MissingPlace place = place_of(side, places.front());
            place.strength = 0.3f + 0.2f * place.around;
            out.push_back(std::move(place));
        }
    }
}

/// True where the one of two values that is a plain name of the side was given by a call which the other one has, too.
bool TodaysDifferences::is_set_by_call_of(Side side, const Text& now, const Text& then) const {
    const Text &name = now.size() == 1 ? now : then, &value = now.size() == 1 ? then : now;
    const auto call = std::find(value.begin(), value.end(), "(");
    if (call == value.end() || call == value.begin()) return false;
    return std::any_of(texts_.sides[side].words.begin(), texts_.sides[side].words.end(), [&](const Text& words) {
        return words.size() > 3 && words != name && has_all(words, {name[0], *std::prev(call)}) &&
               (words[1] == "=" ? words[0] == name[0] : words[1] == "(");
    });
}

void TodaysDifferences::add_member_values(std::vector<MissingPlace>& out) const {
    const Members here = members_of(Side::Source), there = members_of(Side::Target);
    const auto value = [&](Side side, const std::vector<size_t>& places) {  // the same in all places; else none
        Text same;
        for (const size_t index : places) {
            const Text& words = texts_.sides[side].words[index];
            Text one(words.begin() + 4, words.end());
            if (!same.empty() && one != same) return Text();
            same = std::move(one);
        }
        return same;
    };
    for (const auto& [object, fields] : here)
        for (const auto& [field, places] : fields) {
            const auto twin = there.find(object);
            if (twin == there.end() || !twin->second.contains(field)) continue;
            const std::vector<size_t>& others = twin->second.at(field);
            const Text now = value(Side::Source, places), then = value(Side::Target, others);
            const bool name_and_call = (now.size() == 1 && has_call(then)) || (then.size() == 1 && has_call(now));
            if (!name_and_call || is_set_by_call_of(now.size() == 1 ? Side::Source : Side::Target, now, then) ||
                !uses_all(Side::Target, names_in(now)) || !uses_all(Side::Source, names_in(then)) ||
                names_in(now).empty() || names_in(then).empty() || is_no_difference(places[0], others[0]))
                continue;
            MissingPlace place;
            place.now = texts_.sides.source.written[places[0]];
            place.there = texts_.sides.target.written[others[0]];
            place.around = around(places[0], others[0]);
            place.strength = 0.3f + 0.2f * place.around;
            out.push_back(std::move(place));
        }
}

}  // namespace porttool
