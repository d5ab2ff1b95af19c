// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/edit_class.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>
#include <vector>

#include "porttool/audit/past_edit.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// The name of the call in whose parentheses each word stands; "" for none.
std::vector<std::string> calls_around(const Text& words) {
    std::vector<std::string> out, open;
    for (size_t i = 0; i < words.size(); ++i) {
        if (words[i] == ")" && !open.empty()) open.pop_back();
        out.push_back(open.empty() ? "" : open.back());
        if (words[i] == "(") open.push_back(i > 0 && is_word_token(words[i - 1]) ? words[i - 1] : "");
    }
    return out;
}

/// True if the words from there on say that what they name is read by a pointer: `p -> x`, `* p`.
bool points(const NormalText& text, size_t first, size_t count) {
    const bool taken = first > 0 && text[first - 1] == "*" && first > 1 && !is_word_token(text[first - 2]);
    return taken || (first + count < text.size() && text[first + count] == "->");
}

bool is_path_word(const std::string& word) {
    return is_word_token(word) || word == "." || word == "->" || word == "::" || word == "[" || word == "]";
}

/// What a condition asks first, without its `!`; empty where that is no plain name.
Text asked_first(const Text& condition) {
    size_t first = 2;  // behind `if (`
    if (first < condition.size() && condition[first] == "!") ++first;
    size_t end = first;
    while (end < condition.size() && is_path_word(condition[end])) ++end;
    if (end == first || end == condition.size() || !is_one_of(condition[end], {")", "&&", "||"})) return {};
    return {condition.begin() + static_cast<ptrdiff_t>(first), condition.begin() + static_cast<ptrdiff_t>(end)};
}

/// Without the type of what it declares: `float a = b` is `a = b`.
Text without_type(const Text& words) {
    const size_t sign = static_cast<size_t>(std::find(words.begin(), words.end(), "=") - words.begin());
    if (sign == words.size() || sign < 2 || !is_word_token(words[sign - 1])) return words;
    if (!is_word_token(words[sign - 2]) && !is_one_of(words[sign - 2], {"*", "&", ">"})) return words;
    return {words.begin() + static_cast<ptrdiff_t>(sign) - 1, words.end()};
}

/// The words that an edit took or brought; of a statement that came or went all.
std::set<std::string> changed_words(const MissingPlace& place) {
    const Text before = words_of_statement(place.before), now = words_of_statement(place.now);
    std::set<std::string> out;
    for (const DiffStep& step : diff(before, now))
        if (step.kind != DiffStep::Keep) out.insert(step.kind == DiffStep::Add ? now[step.now] : before[step.before]);
    return out;
}

}  // namespace

bool only_hands_on(const MissingPlace& place, const std::set<std::string>& own) {
    const Text before = words_of_statement(place.before), now = words_of_statement(place.now);
    const std::vector<std::string> around_before = calls_around(before), around_now = calls_around(now);
    bool any = false;
    size_t came = 0, went = 0;
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Keep) continue;
        const bool adds = step.kind == DiffStep::Add;
        const std::string& word = adds ? now[step.now] : before[step.before];
        if (!own.contains(adds ? around_now[step.now] : around_before[step.before])) return false;
        if (!is_word_token(word) && !is_one_of(word, {",", ".", "->", "&", "*"})) return false;
        any = any || word == ",";
        ++(adds ? came : went);
    }
    return any && (came == 0 || went == 0);
}

bool is_option(const MissingPlace& place, const UnitState& unit) {
    const Text now = words_of_statement(place.now);
    if (now.size() < 2 || now[0] != "case" || now[1].front() != '\'') return false;
    const Words words = unit.text.words();
    return unit.name == "main" || std::any_of(words.begin(), words.end(), [](std::string_view word) {
               return is_one_of(word, {"argv", "argc", "getopt", "getopt_long", "optarg"});
           });
}

bool guards_pointer(const MissingPlace& place, const UnitState& unit) {
    const Text now = words_of_statement(place.now);
    if (now.size() < 4 || now[0] != "if" || now[1] != "(") return false;
    const Text asked = asked_first(now);
    if (asked.empty()) return false;
    for (size_t i = 0; i + asked.size() <= unit.text.size(); ++i) {
        size_t same = 0;
        while (same < asked.size() && unit.text[i + same] == asked[same]) ++same;
        const bool whole = i == 0 || !is_one_of(unit.text[i - 1], {".", "->", "::"});
        if (same == asked.size() && whole && points(unit.text, i, same)) return true;
    }
    return false;
}

bool sets_tolerance(const MissingPlace& place) {
    const Text before = words_of_statement(place.before), now = words_of_statement(place.now);
    if (before.size() != now.size() || now.empty() || now[0] != "if") return false;
    for (size_t i = 0; i < now.size(); ++i)
        if (before[i] != now[i] && !(i > 0 && is_one_of(now[i - 1], {">", ">=", "<", "<="}) &&
                                     is_number_token(before[i]) && is_number_token(now[i])))
            return false;
    for (size_t i = 0; i + 1 < now.size(); ++i)
        if (now[i + 1] == "(" && is_one_of(folded(now[i]), {"abs", "fabs", "fabsf"}) &&
            std::find(now.begin(), now.end(), "-") != now.end())
            return before != now;
    return false;
}

bool names_type(const MissingPlace& place) {
    const Text now = words_of_statement(place.now);
    const size_t begin = now.size() > 2 && now[1] == ":" ? 2 : 0;  // `public :`
    return begin < now.size() && is_one_of(now[begin], {"using", "typedef"});
}

bool keeps_address(const MissingPlace& place) {
    const Text now = words_of_statement(place.now);
    const auto sets = std::find(now.begin(), now.end(), "=");
    return place.kind == MissingPlace::Kind::Added && sets != now.end() && sets + 1 != now.end() && sets[1] == "&" &&
           std::all_of(sets + 2, now.end(),
                       [](const std::string& word) { return is_path_word(word) || is_number_token(word); });
}

bool numbers_label(const MissingPlace& place, const UnitState& there) {
    const Text now = words_of_statement(place.now);
    if (now.size() < 2 || now[0] != "case" || !is_number_token(now[1])) return false;
    bool any = false;
    for (size_t i = 0; i + 1 < there.text.size(); ++i) {
        if (there.text[i] != "case") continue;
        if (!is_word_token(there.text[i + 1])) return false;
        any = true;
    }
    return any;
}

bool guards_launch(const MissingPlace& place) {
    const Text now = words_of_statement(place.now);
    if (place.kind != MissingPlace::Kind::Added || now.size() != 6 || now[0] != "if" || now[4] != "0" ||
        !is_one_of(now[3], {">", "!="}))
        return false;
    const std::string name = folded(now[2]);
    return is_word_token(now[2]) && (name.find("block") != std::string::npos || name.find("grid") != std::string::npos);
}

bool takes_other_local(const MissingPlace& place, const UnitState& unit) {
    const Text before = without_type(words_of_statement(place.before)),
               now = without_type(words_of_statement(place.now));
    if (before.size() != now.size()) return false;
    std::string lost, gained;
    for (size_t i = 0; i < now.size(); ++i) {
        if (before[i] == now[i]) continue;
        const bool reaches = i + 1 < now.size() && is_one_of(now[i + 1], {".", "->", "("});
        const bool member = i > 0 && is_one_of(now[i - 1], {".", "->", "::"});
        if (reaches || member || !is_word_token(before[i]) || !is_word_token(now[i])) return false;
        if (!lost.empty() && (before[i] != lost || now[i] != gained)) return false;
        lost = before[i];
        gained = now[i];
    }
    if (lost.empty()) return false;
    const Words words = unit.text.words();
    return std::find(words.begin(), words.end(), lost) == words.end();
}

bool goes_on_from_itself(const MissingPlace& place, const UnitState& unit) {
    const Text now = without_type(words_of_statement(place.now));
    return now.size() > 3 && now[1] == "=" && takes_other_local(place, unit) &&
           std::find(now.begin() + 2, now.end(), now[0]) != now.end();
}

bool exchanges_in_group(const MissingPlace& place) {
    constexpr std::array<std::string_view, 10> kParts = {"shfl",     "shuffle",    "ballot",   "subgroup",  "subwarp",
                                                         "warpsize", "activemask", "matchany", "wavefront", "lanemask"};
    const std::set<std::string> words = changed_words(place);
    return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
        const std::string name = folded(word);
        return std::any_of(kParts.begin(), kParts.end(),
                           [&](std::string_view part) { return name.find(part) != std::string::npos; });
    });
}

bool is_taken_by_runtime(const MissingPlace& place) {
    constexpr std::array<std::string_view, 9> kRuntimes = {"cuda", "hip",    "cublas",    "cufft", "cusparse",
                                                           "cub",  "hipcub", "clEnqueue", "clSet"};
    const auto is_runtime = [&](const std::string& name) {
        return std::any_of(kRuntimes.begin(), kRuntimes.end(), [&](std::string_view start) {
            return name.size() > start.size() && name.starts_with(start) && name[start.size()] >= 'A' &&
                   name[start.size()] <= 'Z';
        });
    };
    const Text before = words_of_statement(place.before), now = words_of_statement(place.now);
    const std::vector<std::string> around_before = calls_around(before), around_now = calls_around(now);
    bool any = false;
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Keep) continue;
        const bool adds = step.kind == DiffStep::Add;
        if (!is_runtime(adds ? around_now[step.now] : around_before[step.before])) return false;
        any = true;
    }
    return any && !before.empty() && !now.empty();
}

bool asks_for_type(const MissingPlace& place) {
    const Text now = words_of_statement(place.now);
    return now.size() > 1 && now[0] == "if" && now[1] == "constexpr";
}

bool lies_behind_lambda(const MissingPlace& place) {
    const Text now = words_of_statement(place.now);
    return !now.empty() && now[0] == ",";
}

bool asks_for_memory(const MissingPlace& place) {
    if (place.before.empty() || place.now.empty()) return false;
    const std::set<std::string> words = changed_words(place);
    const auto is_memory = [](const std::string& word) {
        const std::string name = folded(word);
        return name.starts_with("get") && (name.ends_with("data") || name.ends_with("values") || name.ends_with("ptr"));
    };
    return words.contains("&&") && std::any_of(words.begin(), words.end(), is_memory) &&
           std::all_of(words.begin(), words.end(), [&](const std::string& word) {
               return is_memory(word) || is_one_of(word, {"&&", "(", ")", "->", "."}) ||
                      (is_word_token(word) && words_of_statement(place.before).size() > 2);
           });
}

bool names_expression(const MissingPlace& place, const UnitState& there) {
    constexpr size_t kExpression = 3;  // words
    const Text before = words_of_statement(place.before), now = words_of_statement(place.now);
    std::string gained;
    size_t lost = 0;
    for (const DiffStep& step : diff(before, now)) {
        if (step.kind == DiffStep::Remove && !is_one_of(before[step.before], {"(", ")"})) ++lost;
        if (step.kind != DiffStep::Add || is_one_of(now[step.now], {"(", ")"})) continue;
        if (!gained.empty() || !is_word_token(now[step.now])) return false;
        gained = now[step.now];
    }
    const Words words = there.text.words();
    return !gained.empty() && lost >= kExpression && std::find(words.begin(), words.end(), gained) != words.end();
}

bool takes_macro_of_host(const MissingPlace& place, const std::set<std::string>& given) {
    const Text there = words_of_statement(place.there), now = words_of_statement(place.now);
    return std::any_of(there.begin(), there.end(), [&](const std::string& word) {
        return given.contains(word) && std::find(now.begin(), now.end(), word) == now.end();
    });
}

void add_macros_of_host(const ScannedFile& file, std::set<std::string>& out) {
    constexpr std::string_view kDefines = "-D";
    for (const Token& token : file.lexed.tokens) {
        if (token.kind != TokenKind::String) continue;
        const std::string_view text = file.lexed.view(token);
        for (size_t at = text.find(kDefines); at != std::string_view::npos; at = text.find(kDefines, at + 1)) {
            size_t first = at + kDefines.size();
            while (first < text.size() && text[first] == ' ') ++first;
            size_t end = first;
            while (end < text.size() && (std::isalnum(static_cast<unsigned char>(text[end])) != 0 || text[end] == '_'))
                ++end;
            if (end < text.size() && text[end] == '=' && end > first) out.emplace(text.substr(first, end - first));
        }
    }
}

bool only_waits(const WrittenStatement& statement) {
    const Text words = words_of_statement(statement);
    if (words.size() < 3 || words.back() != ")") return false;
    const size_t call = static_cast<size_t>(std::find(words.begin(), words.end(), "(") - words.begin());
    const std::string name = call == 0 ? "" : folded(words[call - 1]);
    return name.find("barrier") != std::string::npos || name.starts_with("syncthreads") || name.starts_with("syncwarp");
}

}  // namespace porttool
