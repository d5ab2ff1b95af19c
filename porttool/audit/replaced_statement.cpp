// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/replaced_statement.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>
#include <string_view>

#include "porttool/audit/same_value.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

std::string head_of(const std::vector<std::string>& words) { return words.empty() ? "" : words[0]; }

}  // namespace

bool ReplacedStatement::tells(Side side, const std::string& word) const {
    constexpr size_t kLeast = 4;
    return is_word_token(word) && word.size() >= kLeast && !is_type_word(word) && !word_is(word, kKeyword) &&
           !texts_.own_names[side].contains(word);
}

bool ReplacedStatement::says_what_is_gained(Side side, const std::vector<std::string>& before,
                                            const std::vector<std::string>& now) const {
    bool any = false;
    for (const std::string& word : now) {
        if (!tells(side, word) || std::find(before.begin(), before.end(), word) != before.end()) continue;
        any = true;
        if (!texts_.unit_words[other(side)].contains(word)) return false;
        const auto uses = [&](Side where, bool beside_edit) {
            ptrdiff_t count = 0;
            for (const auto& words : texts_.sides[where].words)
                if (!beside_edit || (&words != &now && words != now))
                    count += std::count(words.begin(), words.end(), word);
            return count;
        };
        if (uses(side, true) > 0 && uses(other(side), false) < uses(side, false)) return false;
    }
    return any;
}

bool ReplacedStatement::same_head(Side side, const MissingPlace& place) const {
    return head_of(texts_.translated(place.before, side, true)) == head_of(texts_.translated(place.now, side, true));
}

bool ReplacedStatement::turns_round(Side side, const MissingPlace& place, uint32_t commit) const {
    return pair_[side].lineage->places_edited(commit) > 1 &&
           (is_turned_round(words_of_statement(place.before), words_of_statement(place.now)) ||
            ask_the_opposite(texts_.translated(place.before, side, true), texts_.translated(place.now, side, true)));
}

bool ReplacedStatement::brings_call(Side side, const MissingPlace& place) const {
    const std::vector<std::string> before = texts_.translated(place.before, side, true),
                                   now = texts_.translated(place.now, side, true);
    for (size_t i = 0; i + 1 < now.size(); ++i)
        if (now[i + 1] == "(" && is_word_token(now[i]) && !is_type_word(now[i]) &&
            !pair_[other(side)].uses->contains(now[i]) &&
            std::find(before.begin(), before.end(), now[i]) == before.end())
            return true;
    return false;
}

bool fits_narrower_type(const WrittenStatement& was, const WrittenStatement& now, const WrittenStatement& there) {
    constexpr double kGuard = 1e-4;
    std::vector<std::string> old_words = words_of_statement(was);
    const std::vector<std::string> words = words_of_statement(now), others = words_of_statement(there);
    if (old_words.size() != words.size()) return false;
    for (size_t i = 0; i + 2 < words.size(); ++i)  // the type may have another name
        if (words[i + 2] == "=" && words[i + 1] == old_words[i + 1] && is_word_token(words[i]) &&
            is_word_token(old_words[i]))
            old_words[i] = words[i];
    std::set<std::string_view> values;  // of before
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string &before = old_words[i], &after = words[i];
        if (after == before) continue;
        if (!is_number_token(after) || !is_number_token(before)) return false;
        const double small = std::abs(std::strtod(before.c_str(), nullptr)),
                     great = std::abs(std::strtod(after.c_str(), nullptr));
        if (after.back() != 'f' || small <= 0 || small >= great || great > kGuard) return false;
        values.insert(before.back() == 'f' ? std::string_view(before).substr(0, before.size() - 1)
                                           : std::string_view(before));
    }
    return std::any_of(others.begin(), others.end(), [&](const std::string& word) { return values.contains(word); });
}

bool runs_other_threads(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    const auto asks = [](const std::string& word) {
        const std::string small = in_small_letters(word);
        return is_one_of(small, {"threadidx", "blockidx", "blockdim", "griddim"}) || small.starts_with("get_local_") ||
               small.starts_with("get_global_") || small.starts_with("get_group_") ||
               small.starts_with("omp_get_thread") || small.starts_with("omp_get_team");
    };
    bool any = false;
    for (const DiffStep& step : diff(a, b)) {
        if (step.kind == DiffStep::Keep) continue;
        const std::string& word = step.kind == DiffStep::Add ? b[step.now] : a[step.before];
        any = any || asks(word);
        if (!is_word_token(word) && !is_one_of(word, {".", "(", ")"})) return false;
    }
    return any;
}

bool takes_in_other_order(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    const auto plain = [](const std::vector<std::string>& words) {
        const size_t call = static_cast<size_t>(std::find(words.begin(), words.end(), "(") - words.begin());
        return call > 0 && words.back() == ")" &&
               std::all_of(words.begin() + static_cast<ptrdiff_t>(call), words.end(), [](const std::string& word) {
                   return word == "(" || word == ")" || word == "," || word == "." || is_word_token(word) ||
                          is_number_token(word);
               });
    };
    if (a.size() != b.size() || a.empty() || a[0] != b[0] || !plain(a) || !plain(b)) return false;
    size_t moved = 0;
    for (size_t i = 0; i < a.size(); ++i) moved += a[i] != b[i] ? 1 : 0;
    std::vector<std::string> left = a, right = b;
    std::sort(left.begin(), left.end());
    std::sort(right.begin(), right.end());
    return left == right && moved >= 3;
}

bool numbers_alone(const WrittenStatement& before, const WrittenStatement& now) {
    const std::vector<std::string> a = words_of_statement(before), b = words_of_statement(now);
    if (a.size() != b.size()) return false;
    for (size_t i = 0; i < a.size(); ++i)
        if (a[i] != b[i] && !(is_number_token(a[i]) && is_number_token(b[i]))) return false;
    return true;
}

bool differs_by_a_slip(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    constexpr std::string_view kComponents = "xyzw", kOperators = "+-*/%<>&|^";
    if (a.size() != b.size()) return false;
    const auto is_component = [&](const std::vector<std::string>& words, size_t i) {
        return i > 0 && words[i - 1] == "." && words[i].size() == 1 &&
               kComponents.find(words[i][0]) != std::string_view::npos;
    };
    const auto is_operator = [&](const std::string& word) {
        return kOperators.find(word[0]) != std::string_view::npos || word == "==" || word == "!=";
    };
    size_t first = a.size();
    for (size_t i = 0; i < a.size(); ++i) {
        if (a[i] == b[i]) continue;
        const bool slips = (is_number_token(a[i]) && is_number_token(b[i])) ||
                           (is_component(a, i) && is_component(b, i)) || (is_operator(a[i]) && is_operator(b[i]));
        if (!slips || (first < a.size() && (a[first] != a[i] || b[first] != b[i]))) return false;
        first = std::min(first, i);
    }
    return first < a.size();
}

bool ReplacedStatement::counts_threads_otherwise(const MissingPlace& place) {
    const auto has = [](const WrittenStatement& statement, std::string_view name) {
        const std::vector<std::string> words = words_of_statement(statement);
        return std::find(words.begin(), words.end(), name) != words.end();
    };
    return has(place.now, "dim3") != has(place.there, "dim3") && has(place.now, "range") != has(place.there, "range");
}

bool ReplacedStatement::stands_there(Side side, const MissingPlace& place, const std::vector<std::string>& was,
                                     const std::vector<std::string>& now) const {
    const std::vector<std::string> there = texts_.translated(place.there, other(side), true);
    const auto tells = [](const std::string& word) { return is_word_token(word) || is_number_token(word); };
    bool gains = false;
    for (const DiffStep& step : diff(was, now)) {
        if (step.kind == DiffStep::Keep) continue;
        const std::string& word = step.kind == DiffStep::Add ? now[step.now] : was[step.before];
        if (!tells(word)) continue;
        if (step.kind == DiffStep::Remove) return false;
        if (std::count(there.begin(), there.end(), word) < std::count(now.begin(), now.end(), word)) return false;
        gains = true;
    }
    return gains;
}

bool ReplacedStatement::is_one_component(Side side, const std::vector<std::string>& now,
                                         const std::vector<std::string>& there) const {
    constexpr std::string_view kComponents = "xyzw";
    const auto is_swizzle = [&](const std::vector<std::string>& words, size_t i) {
        return i > 0 && words[i - 1] == "." && words[i].find_first_not_of(kComponents) == std::string::npos;
    };
    const auto whole = [&](const std::vector<std::string>& words) {
        std::vector<std::string> out;
        for (size_t i = 0; i < words.size(); ++i)
            if (is_swizzle(words, i))
                out.pop_back();
            else
                out.push_back(words[i]);
        return out;
    };
    std::vector<std::string> next = now;  // the same of `y`
    for (size_t i = 0; i < now.size(); ++i) {
        if (is_swizzle(now, i) && now[i] != "x") return false;
        if (is_swizzle(now, i)) next[i] = "y";
    }
    for (size_t i = 0; i < there.size(); ++i)
        if (is_swizzle(there, i) && there[i].size() == 1) return false;
    const auto& here = texts_.sides[side].words;
    return next != now && whole(now) == whole(there) && std::find(here.begin(), here.end(), next) != here.end();
}

bool ReplacedStatement::takes_own_thread(Side side, const std::vector<std::string>& was,
                                         const std::vector<std::string>& now) const {
    const auto counts_threads = [&](const std::string& local) {
        const auto value = texts_.held[side].find(local);
        return value == texts_.held[side].end() || CommonTexts::name_thread(value->second);
    };
    size_t came = 0, went = 0;
    for (const DiffStep& step : diff(was, now)) {
        if (step.kind == DiffStep::Keep) continue;
        const bool adds = step.kind == DiffStep::Add;
        const std::string& word = adds ? now[step.now] : was[step.before];
        const bool known = texts_.own_names[other(side)].contains(word);
        if (!is_word_token(word) || known == adds) return false;
        if (adds && !(texts_.own_names[side].contains(word) && counts_threads(word))) return false;
        ++(adds ? came : went);
    }
    return came > 0 && came == went;
}

bool ReplacedStatement::is_loop_of_threads(Side side, const MissingPlace& place) const {
    const std::vector<std::string> there = texts_.translated(place.there, other(side), true);
    return !there.empty() && word_is(there[0], kLoopHead) &&
           std::any_of(there.begin(), there.end(), [&](const std::string& word) {
               const auto value = texts_.held[other(side)].find(word);
               return value != texts_.held[other(side)].end() && CommonTexts::name_thread(value->second);
           });
}

bool ReplacedStatement::lies_otherwise(const std::vector<std::string>& was, const std::vector<std::string>& now) {
    bool joins = false;
    int multiplies = 0, adds = 0;
    for (const DiffStep& step : diff(was, now)) {
        if (step.kind == DiffStep::Keep) continue;
        const std::string& word = step.kind == DiffStep::Add ? now[step.now] : was[step.before];
        if (step.kind == DiffStep::Remove) {
            if (word != "[" && word != "]") return false;
            joins = true;
            continue;
        }
        multiplies += word == "*" ? 1 : 0;
        adds += word == "+" ? 1 : 0;
        if (word != "*" && word != "+" && word != "(" && word != ")" && !is_word_token(word) && !is_number_token(word))
            return false;
    }
    return joins && multiplies == adds && adds > 0;
}

bool ReplacedStatement::keeps_copy(Side side, const std::vector<std::string>& was,
                                   const std::vector<std::string>& now) const {
    const auto first = std::find(now.begin(), now.end(), "=");
    if (first == now.end() || first + 1 == now.end() || now.size() <= was.size()) return false;
    const auto second = std::find(first + 1, now.end(), "=");
    if (second == now.end() || !is_word_token(first[1]) || texts_.unit_words[other(side)].contains(first[1]))
        return false;
    std::vector<std::string> without(now.begin(), first);
    without.insert(without.end(), second, now.end());
    return without == was;
}

bool ReplacedStatement::only_fills_with_zeros(const MissingPlace& place) {
    const std::vector<std::string> before = words_of_statement(place.before), now = words_of_statement(place.now);
    if (std::find(now.begin(), now.end(), "vector") == now.end()) return false;
    bool fills = false;
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Keep) continue;
        if (step.kind == DiffStep::Remove) return false;
        const std::string& word = now[step.now];
        const bool zero = is_number_token(word) && std::strtod(word.c_str(), nullptr) == 0;
        if (!zero && word != ",") return false;
        fills = true;
    }
    return fills;
}

bool ReplacedStatement::is_added_later(Side side, const MissingPlace& place,
                                       const std::vector<std::string>& now) const {
    const auto sign_in = [](const std::vector<std::string>& words) {
        return std::find(words.begin(), words.end(), "=");
    };
    const auto adds_up = [&](const std::vector<std::string>& words) {  // `a = a + E`
        const auto sign = sign_in(words);
        const auto length = sign - words.begin();
        return sign != words.end() && words.end() - sign > length + 1 && *(sign + 1 + length) == "+" &&
               std::equal(words.begin(), sign, sign + 1);
    };
    const std::vector<std::string> there = texts_.translated(place.there, other(side), true);
    if (!adds_up(now) || adds_up(there) || sign_in(there) == there.end()) return false;
    const auto& others = texts_.sides[other(side)].words;
    return std::any_of(others.begin(), others.end(), [&](const std::vector<std::string>& words) {
        return adds_up(words) && std::find(sign_in(words) + 1, words.end(), there[0]) != words.end() &&
               words[0] != there[0];
    });
}

bool ReplacedStatement::names_second_value(Side side, const std::vector<std::string>& was,
                                           const std::vector<std::string>& now) const {
    if (was.size() != now.size()) return false;
    std::string old_name, new_name;
    for (size_t i = 0; i < now.size(); ++i) {
        if (was[i] == now[i]) continue;
        if (!new_name.empty() && (was[i] != old_name || now[i] != new_name)) return false;
        old_name = was[i];
        new_name = now[i];
    }
    if (new_name.empty() || !texts_.own_names[side].contains(new_name)) return false;
    const auto &here = texts_.sides[side].words, &there = texts_.sides[other(side)].words;
    return std::any_of(here.begin(), here.end(), [&](std::vector<std::string> words) {
        if (words.size() < 3 || words[0] != new_name || words[1] != "=") return false;
        words[0] = old_name;
        return std::find(there.begin(), there.end(), words) != there.end();
    });
}

float anchored(const std::vector<std::string>& before, const std::vector<std::string>& now,
               const std::vector<std::string>& there) {
    std::vector<bool> stands(before.size(), false);
    for (const DiffStep& step : diff(before, there))
        if (step.kind == DiffStep::Keep) stands[step.before] = true;
    size_t asked = 0, known = 0;
    const auto ask = [&](size_t i) {
        ++asked;
        known += stands[i] ? 1 : 0;
    };
    const auto is_telling = [&](size_t i) { return is_word_token(before[i]) || is_number_token(before[i]); };
    const std::vector<DiffStep> steps = diff(before, now);
    for (size_t k = 0; k < steps.size(); ++k) {
        if (steps[k].kind == DiffStep::Keep) continue;
        if (steps[k].kind == DiffStep::Remove) ask(steps[k].before);
        const bool first = k == 0 || steps[k - 1].kind == DiffStep::Keep;
        const bool last = k + 1 == steps.size() || steps[k + 1].kind == DiffStep::Keep;
        const size_t at = steps[k].before + (steps[k].kind == DiffStep::Remove ? 1 : 0);
        size_t left = std::min(steps[k].before, before.size()), right = std::min(at, before.size());
        while (left > 0 && !is_telling(left - 1)) --left;
        while (right < before.size() && !is_telling(right)) ++right;
        if (first && left > 0) ask(left - 1);
        if (last && right < before.size()) ask(right);
    }
    return asked == 0 ? 1 : 0.3f + 0.7f * static_cast<float>(known) / static_cast<float>(asked);
}

}  // namespace porttool
