// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/said_otherwise.h"

#include <algorithm>
#include <iterator>
#include <map>

#include "porttool/audit/aside.h"
#include "porttool/language/words.h"
#include "porttool/normal/statements.h"

namespace porttool {
namespace {

/// A statement with all names alike, and what leads to a member left out: `if ( lid != best [ bid ] )` and
/// `if ( threadIdx . x != best [ blockIdx . x ] )` have one shape.
std::string shape_of(const std::vector<std::string>& words) {
    std::string out;
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == ".") {
            ++i;
            continue;
        }
        const bool name = is_word_token(words[i]) && !word_is(words[i], kKeyword) && !is_type_word(words[i]);
        out += name ? "a" : words[i];
        out += ' ';
    }
    return out;
}

std::vector<std::string> numbers_in(const std::vector<std::string>& words) {
    std::vector<std::string> out;
    std::copy_if(words.begin(), words.end(), std::back_inserter(out),
                 [](const std::string& word) { return is_number_token(word); });
    return out;
}

}  // namespace

float SaidOtherwise::lacking(Side side, size_t index) const {
    constexpr float kOwnRuntime = 0.3f;
    return (moves_memory(texts_.sides[side].words[index]) ? kOwnRuntime : 1.0f) * said_in_one(side, index) *
           known_names(side, index) * (0.35f + 0.65f * neighbours(side, index)) *
           (is_label(side, index) ? 1.0f : told_by(texts_.sides[side].weighed[index].sum)) * lacks_words(side, index) *
           in_common_calls(side, index) * sets_new(side, index) * sets_own_local(side, index) *
           runs_threads(side, index) * (begins_own_class(side, index) ? 0.3f : 1.0f) *
           (sizes_launch(texts_.sides[side].words[index]) ? 0.3f : 1.0f) *
           (governs_the_same(texts_.sides[side], index, texts_.sides[other(side)]) ||
                    is_left_otherwise(texts_.sides[side], index, texts_.sides[other(side)])
                ? 0.3f
                : 1.0f);
}

bool SaidOtherwise::names_value(Side side, size_t index) const {
    const std::vector<std::string>& words = texts_.sides[side].words[index];
    if (words.size() < 3 || words[1] != "=" || !texts_.held[side].contains(words[0])) return false;
    const auto& there = texts_.sides[other(side)].words;
    return std::none_of(there.begin(), there.end(), [&](const std::vector<std::string>& one) {
        return one.size() > 2 && one[0] == words[0] && one[1] == "=";
    });
}

bool SaidOtherwise::has_in_shape(Side side, size_t index) const {
    const std::vector<std::string>& own = texts_.sides[side].words[index];
    if (is_label(side, index) || own.size() < 6) return false;
    const std::string shape = shape_of(own);
    const ReadSide &here = texts_.sides[side], &there = texts_.sides[other(side)];
    for (size_t i = 1; i < there.words.size(); ++i) {
        const auto& words = there.words[i];
        if (words[0] != own[0] && !(is_word_token(words[0]) && is_word_token(own[0]))) continue;
        if (shape_of(words) != shape) continue;
        const bool shares = std::any_of(own.begin(), own.end(), [&](const std::string& word) {
            return word.size() >= 3 && is_word_token(word) && !word_is(word, kKeyword) && !is_type_word(word) &&
                   std::find(words.begin(), words.end(), word) != words.end();
        });
        if (!shares) continue;
        const float far = distance(there.weighed[i], here.weighed[index]);
        bool nearest_one = true;
        for (size_t k = 0; k < here.words.size() && nearest_one; ++k)
            nearest_one = here.words[k] == own || distance(there.weighed[i], here.weighed[k]) >= far ||
                          shape_of(here.words[k]) != shape;
        if (nearest_one) return true;
    }
    return false;
}

bool SaidOtherwise::stands_alike_in_file(Side side, size_t index) const {
    constexpr float kAlike = 0.85f;
    const auto* there = pair_[other(side)].file_statements;
    const std::vector<std::string>& own = texts_.sides[side].words[index];
    if (there == nullptr || is_label(side, index) || texts_.sides[side].weighed[index].sum < 3) return false;
    return std::any_of(there->begin(), there->end(), [&](const std::vector<std::string>& words) {
        if (words.empty() || words[0] != own[0] || words.size() > 2 * own.size() || own.size() > 2 * words.size())
            return false;
        return likeness_by_endings(own, words) >= kAlike && numbers_in(words) == numbers_in(own);
    });
}

bool SaidOtherwise::only_guards(Side side, size_t index) const {
    const std::vector<std::string>& words = texts_.sides[side].words[index];
    if (words.size() < 4 || words[0] != "if") return false;
    return std::all_of(words.begin() + 1, words.end(), [&](const std::string& word) {
        return word == "(" || word == ")" || word == "!" || texts_.own_names[side].contains(word);
    });
}

bool SaidOtherwise::is_part_of_swap(Side side, size_t index) const {
    const std::vector<std::string>& own = texts_.sides[side].words[index];
    const auto sign = std::find(own.begin(), own.end(), "=");
    const bool moves = std::all_of(own.begin(), own.end(), [](const std::string& word) {
        return word == "=" || word == "." || word == "[" || word == "]" || is_word_token(word) || is_number_token(word);
    });
    if (!moves || sign == own.end()) return false;
    const auto& there = texts_.sides[other(side)].words;
    return std::any_of(there.begin(), there.end(), [&](const std::vector<std::string>& words) {
        return is_swap(words) && (std::search(words.begin(), words.end(), own.begin(), sign) != words.end() ||
                                  std::search(words.begin(), words.end(), sign + 1, own.end()) != words.end());
    });
}

bool SaidOtherwise::is_bound_of_loop(Side side, size_t index) const {
    const std::vector<std::string>& own = texts_.sides[side].words[index];
    const bool guards = own.size() > 5 && own[0] == "if" && own[1] == "(" && (own[3] == ">=" || own[3] == "<");
    if (!guards || !texts_.own_names[side].contains(own[2])) return false;
    std::vector<std::string> end(own.begin() + 3, own.end());
    end.front() = "<";
    const auto& there = texts_.sides[other(side)].words;
    return std::any_of(there.begin(), there.end(), [&](const std::vector<std::string>& words) {
        if (words.empty() || !word_is(words[0], kLoopHead)) return false;
        const auto found = std::search(words.begin(), words.end(), end.begin(), end.end() - 1);  // without its `)`
        const auto after = found == words.end() ? found : found + static_cast<ptrdiff_t>(end.size()) - 1;
        return after != words.end() && (*after == ";" || *after == ")");
    });
}

bool SaidOtherwise::begins_own_class(Side side, size_t index) const {
    const std::vector<std::string>& own = texts_.sides[side].words[index];
    if (own.size() < 5 || own[1] != "." || own[3] != "=" || !texts_.own_names[side].contains(own[0])) return false;
    const bool numbers = std::all_of(
        own.begin() + 4, own.end(), [](const std::string& word) { return !is_word_token(word) || is_type_word(word); });
    const auto class_of = [&](Side where) -> std::string {
        const ReadSide& read = texts_.sides[where];
        for (size_t i = 1; i < read.words.size(); ++i) {
            const std::vector<std::string> written = words_of_statement(read.written[i]);
            if (written.size() == 2 && read.words[i].back() == own[0] && !is_type_word(written[0])) return written[0];
        }
        return {};
    };
    const std::string here = class_of(side), there = class_of(other(side));
    return numbers && !here.empty() && !there.empty() && here != there;
}

bool SaidOtherwise::is_said_in_call(Side side, size_t index) const {
    constexpr size_t kLeast = 4, kFewest = 2;  // letters of a name, and names: one alone stands anywhere
    const SideOfPair& there = pair_[other(side)];
    if (there.functions == nullptr) return false;
    std::set<std::string> names;
    for (const std::string& word : texts_.sides[side].words[index])
        if (is_word_token(word) && word.size() >= kLeast && !is_type_word(word) && !word_is(word, kKeyword) &&
            !texts_.own_names[side].contains(word) && !texts_.unit_words[other(side)].contains(word))
            names.insert(word);
    if (names.size() < kFewest) return false;
    for (const WordsOfSide& called : there.functions->called_by(*there.unit)) {
        const auto known = static_cast<size_t>(
            std::count_if(names.begin(), names.end(), [&](const auto& name) { return called.contains(name); }));
        if (known >= kFewest && 3 * known >= 2 * names.size()) return true;
    }
    return false;
}

float SaidOtherwise::sets_new(Side side, size_t index) const {
    constexpr float kSetThere = 0.3f;
    const auto is_set = [](const std::vector<std::string>& words) {
        return words.size() > 2 && is_word_token(words[0]) && words[1] == "=";
    };
    const std::vector<std::string>& own = texts_.sides[side].words[index];
    if (!is_set(own)) return 1;
    const auto times = [&](Side where) {
        return std::count_if(texts_.sides[where].words.begin(), texts_.sides[where].words.end(),
                             [&](const auto& words) { return is_set(words) && words[0] == own[0]; });
    };
    return times(other(side)) >= times(side) ? kSetThere : 1;
}

float SaidOtherwise::sets_own_local(Side side, size_t index) const {
    constexpr float kOwn = 0.3f;
    const std::vector<std::string>& own = texts_.sides[side].words[index];
    if (own.size() < 3 || !is_word_token(own[0])) return 1;
    const KnownThere there = texts_.known_there(side);
    if (there.unit->contains(own[0]) || there.file->contains(own[0])) return 1;
    size_t end = 1;
    while (end + 1 < own.size() && own[end] == "." && is_word_token(own[end + 1])) end += 2;
    return end < own.size() && own[end] == "=" ? kOwn : 1;
}

bool SaidOtherwise::is_label_by_ending(Side side, size_t index) const {
    constexpr size_t kLeast = 6;  // letters
    constexpr double kShare = 0.6;
    const auto label = [](const std::vector<std::string>& words) {
        return words.size() >= 2 && words[0] == "case" && is_word_token(words[1]) ? words[1] : std::string();
    };
    const std::string own = label(texts_.sides[side].words[index]);
    const auto &here = texts_.sides[side].words, &there = texts_.sides[other(side)].words;
    return own.size() >= kLeast && std::any_of(there.begin(), there.end(), [&](const auto& words) {
               const std::string name = label(words);
               const auto [less, more] = std::minmax(name.size(), own.size());
               const bool ends = own.ends_with(name) || name.ends_with(own);
               return ends && less >= kLeast && static_cast<double>(less) >= kShare * static_cast<double>(more) &&
                      std::find(here.begin(), here.end(), words) == here.end();
           });
}

bool SaidOtherwise::is_label(Side side, size_t index) const {
    const std::vector<std::string>& words = texts_.sides[side].words[index];
    return words.size() > 2 && words[0] == "case";
}

float SaidOtherwise::runs_threads(Side side, size_t index) const {
    constexpr float kTurns = 0.3f;
    const std::vector<std::string>& own = texts_.sides[side].words[index];
    const bool loops = !own.empty() && word_is(own[0], kLoopHead);
    return loops && texts_.asks_for_thread(other(side)) && !texts_.asks_for_thread(side) ? kTurns : 1;
}

float SaidOtherwise::in_common_calls(Side side, size_t index) const {
    constexpr float kOwnManner = 0.5f;
    const KnownThere there = texts_.known_there(side);
    const std::vector<std::string>& words = texts_.sides[side].words[index];
    float out = 1;
    for (size_t i = 0; i + 1 < words.size() && out > kOwnManner * kOwnManner; ++i)
        if (words[i + 1] == "(" && is_word_token(words[i]) && there.degree(words[i]) <= 0) out *= kOwnManner;
    return out;
}

float SaidOtherwise::known_names(Side side, size_t index) const {
    const KnownThere there = texts_.known_there(side);
    float names = 0, known = 0;
    for (const std::string& word : texts_.sides[side].words[index]) {
        if (!is_word_token(word)) continue;
        ++names;
        known += there.degree(word);
    }
    return names == 0 ? 0.5f : known / names;
}

bool SaidOtherwise::only_brings(Side side, size_t index) const {
    const KnownThere there = texts_.known_there(side);
    size_t calls = 0;
    const std::vector<std::string> value = value_of(texts_.sides[side].words[index]);
    int depth = 0;  // of brackets: what stands there says which one
    for (size_t i = 0; i < value.size(); ++i) {
        depth += value[i] == "[" ? 1 : value[i] == "]" ? -1 : 0;
        if (depth > 0) continue;
        const bool called = i + 1 < value.size() && value[i + 1] == "(";
        if (called && (!is_word_token(value[i]) || there.degree(value[i]) > 0)) return false;
        calls += called ? 1 : 0;
        const bool slight =
            value[i].size() == 1 && std::string_view("()[].,").find(value[i][0]) != std::string_view::npos;
        if (!slight && !is_word_token(value[i]) && !is_number_token(value[i])) return false;
    }
    return calls <= 1 && value.size() < texts_.sides[side].words[index].size();
}

float SaidOtherwise::said_in_one(Side side, size_t index) const {
    constexpr float kSaid = 0.35f;
    constexpr size_t kShort = 3;
    const KnownThere there = texts_.known_there(side);
    std::vector<std::string> names;
    for (const std::string& word : texts_.sides[side].words[index])
        if (is_word_token(word) && word.size() > kShort && !is_type_word(word) &&
            !texts_.own_names[side].contains(word) && there.degree(word) > 0)
            names.push_back(word);
    if (names.size() < 2) return 1;  // one alone stands anywhere
    for (const auto& words : texts_.sides[other(side)].words)
        if (std::all_of(names.begin(), names.end(), [&](const std::string& name) {
                return std::find(words.begin(), words.end(), name) != words.end();
            }))
            return kSaid;
    return 1;
}

float SaidOtherwise::lacks_words(Side side, size_t index) const {
    constexpr float kSaidOtherwise = 0.4f, kNoWords = 0.7f;
    constexpr size_t kLeast = 3;
    constexpr size_t kTelling = 4;  // letters of a name that another ends with: `clamp`, `spectrumclamp`
    const auto is_in = [](const std::string& one, const std::string& word) {
        return one == word || (word.size() >= kTelling && one.ends_with(word)) ||
               (one.size() >= kTelling && word.ends_with(one));
    };
    const auto count = [&](Side where, const std::string& word) {
        ptrdiff_t out = 0;
        for (const auto& words : texts_.sides[where].words)
            out += std::count_if(words.begin(), words.end(), [&](const auto& one) { return is_in(one, word); });
        return out;
    };
    const KnownThere there = texts_.known_there(side);
    bool any = false;
    for (const std::string& word : texts_.sides[side].words[index]) {
        const bool tells = is_number_token(word) || (is_word_token(word) && word.size() >= kLeast &&
                                                     !texts_.own_names[side].contains(word) && there.degree(word) > 0);
        if (!tells || is_type_word(word)) continue;
        any = true;
        if (count(other(side), word) < count(side, word)) return 1;
    }
    return any ? kSaidOtherwise : kNoWords;
}

float SaidOtherwise::neighbours(Side side, size_t index) const {
    const auto& here = texts_.sides[side].weighed;
    const auto& others = texts_.sides[other(side)].weighed;
    float sum = 0;
    int count = 0;
    for (const int step : {-2, -1, 1, 2}) {
        const auto at = static_cast<ptrdiff_t>(index) + step;
        if (at < 0 || at >= static_cast<ptrdiff_t>(here.size())) continue;
        const WeighedWords& one = here[static_cast<size_t>(at)];
        const Nearest near = nearest(one, others);
        ++count;
        if (near.any) sum += std::max(0.0f, 1 - near.distance / (one.sum + others[near.index].sum));
    }
    return count == 0 ? 0 : sum / static_cast<float>(count);
}

}  // namespace porttool
