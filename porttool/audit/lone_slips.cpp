// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/lone_slips.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "porttool/audit/aside.h"
#include "porttool/audit/operands.h"
#include "porttool/audit/past_edit.h"
#include "porttool/audit/sibling_slips.h"
#include "porttool/language/words.h"
#include "porttool/normal/declaration_words.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

std::string quoted_words(StatementWords words) {
    std::string out;
    for (const std::string& word : words) (out.empty() ? out : out += ' ') += word;
    return "`" + out + "`";
}

/// True for a way to a value that is more than a name: `p . x`, `m [ i ]`. What calls, or counts on, may give something
/// else the second time.
bool is_plain_way(StatementWords words) {
    return words.size() > 2 && is_word_token(words[0]) &&
           std::none_of(words.begin(), words.end(), [](const std::string& word) {
               return is_one_of(word, {"(", "::", "++", "--", "="});
           });
}

/// `p . x - p . x`, `a [ i ] >= a [ i ]`.
std::optional<LoneSlip> operand_twice(const Text& words, const BracketPartners& partners) {
    for (size_t i = 1; i + 1 < words.size(); ++i) {
        if (!is_one_of(words[i], {"-", "/", "%", "<", ">", "<=", ">="})) continue;
        const auto operands = operands_at(words, partners, i);
        if (operands && are_same(operands->left, operands->right) && is_plain_way(operands->left))
            return LoneSlip{0, "has " + quoted_words(operands->left) + " on both sides of `" + words[i] + "`",
                            "say the other operand, or leave it"};
    }
    return std::nullopt;
}

/// `max ( a , a )`
std::optional<LoneSlip> argument_twice(const Text& words, const BracketPartners& partners) {
    for (size_t i = 0; i + 1 < words.size(); ++i) {
        if (words[i + 1] != "(" || !is_one_of(words[i], {"min", "max", "fmin", "fmax", "fminf", "fmaxf"})) continue;
        const std::vector<StatementWords> arguments = parts_of(words, partners, i + 1, ",");
        const bool calls = arguments.size() == 2 && are_same(arguments[0], arguments[1]) &&
                           !is_number_token(arguments[0][0]) &&
                           std::none_of(arguments[0].begin(), arguments[0].end(), [](const std::string& word) {
                               return is_one_of(word, {"++", "--"});
                           });
        if (calls)
            return LoneSlip{0, "takes the `" + words[i] + "` of " + quoted_words(arguments[0]) + " and itself",
                            "say the other argument, or leave it"};
    }
    return std::nullopt;
}

/// True for a question that has one answer, however often it is asked.
bool asks_plainly(StatementWords question) {
    const bool compares = std::any_of(question.begin(), question.end(), [](const std::string& word) {
        return is_one_of(word, {"<", ">", "<=", ">=", "==", "!="});
    });
    for (size_t i = 0; i < question.size(); ++i) {
        if (is_one_of(question[i], {"=", "+=", "-=", "++", "--", "?", "{", ";"})) return false;
        const bool calls = i + 1 < question.size() && is_word_token(question[i]) && question[i + 1] == "(";
        if (calls && !is_one_of(question[i], {"isnan", "isinf", "isfinite", "fabs", "fabsf", "abs"})) return false;
    }
    return compares || (question.size() > 3 && question[1] == "(");
}

/// `a > 0 && b > 0 && a > 0`
std::optional<LoneSlip> question_twice(const Text& words, const BracketPartners& partners) {
    for (size_t i = 0; i < words.size(); ++i) {
        const bool opens = words[i] == "(";
        if (!opens) continue;
        for (const char* joint : {"&&", "||"}) {
            const std::vector<StatementWords> questions = parts_of(words, partners, i, joint);
            if (questions.size() < 2) continue;
            std::set<StatementWords, ShorterFirst> asked;
            for (const StatementWords one : questions)
                if (!asked.insert(one).second && asks_plainly(one))
                    return LoneSlip{0, "asks " + quoted_words(one) + " twice in one condition",
                                    "ask the other question, or leave it"};
        }
    }
    return std::nullopt;
}

/// `m [ + 1 ]`, where all of `m [ c + 1 ]` was meant.
std::optional<LoneSlip> operand_missing(const Text& words) {
    for (size_t i = 1; i + 2 < words.size(); ++i)
        if (words[i] == "[" && words[i + 1] == "+" && is_word_token(words[i - 1]) &&
            !is_one_of(words[i - 1], {"return", "case"}))
            return LoneSlip{0, "has nothing before the `+` in " + quoted_words(StatementWords(words).subspan(i - 1, 4)),
                            "say the first operand, or leave it"};
    return std::nullopt;
}

/// `for ( int i = 0 ; i < n ; ++ i )` as what each part of it is about; "" where that is not one name.
struct LoopHead {
    std::string begins, asks, goes_on;
};

std::optional<LoopHead> loop_head(const Text& words) {
    if (words.size() < 8 || words[0] != "for" || words[1] != "(") return std::nullopt;
    const std::vector<StatementWords> parts = parts_of(words, BracketPartners(words), 1, ";");
    if (parts.size() != 3 || parts[0].size() < 3 || parts[1].size() < 3 || parts[2].size() < 2) return std::nullopt;
    LoopHead out;
    const auto sets = std::find(parts[0].begin(), parts[0].end(), "=");
    const bool one = sets != parts[0].begin() && sets != parts[0].end() &&
                     std::find(parts[0].begin(), parts[0].end(), ",") == parts[0].end();
    if (one && is_word_token(*std::prev(sets))) out.begins = *std::prev(sets);
    if (is_word_token(parts[1][0]) && is_one_of(parts[1][1], {"<", "<=", ">", ">=", "!="})) out.asks = parts[1][0];
    const bool steps = parts[2].size() == 2 || is_one_of(parts[2][1], {"+=", "-="});
    if (steps && std::find(parts[2].begin(), parts[2].end(), ",") == parts[2].end())
        out.goes_on = is_word_token(parts[2][0]) ? parts[2][0] : parts[2][1];
    return out;
}

bool sets_or_steps(const std::string& word) {
    return is_one_of(word, {"=", "+=", "-=", "*=", "/=", "<<=", ">>=", "++", "--"});
}

/// The loops of a unit, of which one asks or counts what another one counts. What a statement that heads no loop
/// changes may be asked by any.
class Loops {
public:
    explicit Loops(const std::vector<Text>& statements) {
        for (const Text& words : statements) {
            if (const auto head = loop_head(words)) {
                if (!head->begins.empty()) counted_.insert(head->begins);
                continue;
            }
            for (size_t i = 0; i < words.size(); ++i)
                if (is_word_token(words[i]) &&
                    ((i > 0 && sets_or_steps(words[i - 1])) || (i + 1 < words.size() && sets_or_steps(words[i + 1])) ||
                     (i > 0 && words[i - 1] == "&")))
                    changed_.insert(words[i]);
        }
    }

    std::optional<LoneSlip> slip_of(const Text& words) const {
        const auto head = loop_head(words);
        if (!head || head->begins.empty() || head->asks.empty() || head->goes_on.empty()) return std::nullopt;
        const bool asks_other = head->goes_on == head->begins && head->asks != head->begins;
        if (!asks_other && (head->asks != head->begins || head->goes_on == head->begins)) return std::nullopt;
        const std::string& odd = asks_other ? head->asks : head->goes_on;
        const std::vector<StatementWords> parts = parts_of(words, BracketPartners(words), 1, ";");
        const bool names_own =
            asks_other && std::find(parts[1].begin(), parts[1].end(), head->begins) != parts[1].end();
        if (names_own || !counted_.contains(odd) || changed_.contains(odd) || changed_.contains(head->begins))
            return std::nullopt;
        return LoneSlip{0,
                        std::string(asks_other ? "asks" : "counts") + " `" + odd + "` in the head of the loop over `" +
                            head->begins + "`",
                        "name `" + head->begins + "`, or leave it", true};
    }

private:
    std::set<std::string> counted_, changed_;
};

/// The arrays that a unit declares with a number of elements.
class Arrays {
public:
    explicit Arrays(const std::vector<Text>& statements) {
        for (size_t i = 1; i < statements.size(); ++i)  // the first is the head
            for (size_t at = 1; at + 3 <= statements[i].size(); ++at)
                if (declares(statements[i], at)) {
                    size_t& known = sizes_[statements[i][at]];  // the greatest of several
                    known = std::max<size_t>(known, std::strtoul(statements[i][at + 2].c_str(), nullptr, 0));
                }
    }

    std::optional<LoneSlip> slip_of(const Text& words) const {
        if (sizes_.empty() || declares_list(words)) return std::nullopt;
        for (size_t at = 0; at + 3 < words.size(); ++at) {
            const auto size = sizes_.find(words[at]);
            if (size == sizes_.end() || size->second == 0 || words[at + 1] != "[" || !is_whole(words[at + 2]) ||
                words[at + 3] != "]")
                continue;
            const bool is_it = at == 0 || !(is_word_token(words[at - 1]) || is_one_of(words[at - 1], {"&", ".", "->"}));
            if (is_it && std::strtoul(words[at + 2].c_str(), nullptr, 0) >= size->second)
                return LoneSlip{0,
                                "uses " + quoted_words(StatementWords(words).subspan(at, 4)) + ", and `" + words[at] +
                                    "` has " + std::to_string(size->second) + " elements",
                                "stay within the array, or leave it", true};
        }
        return std::nullopt;
    }

private:
    static bool is_whole(const std::string& word) {
        return !word.empty() && std::all_of(word.begin(), word.end(), [](char c) { return c >= '0' && c <= '9'; });
    }

    /// `T b , a [ 4 ]`
    static bool declares_list(const Text& words) {
        return words.size() > 3 && is_word_token(words[0]) && is_word_token(words[1]) && words[0] != "return" &&
               std::find(words.begin(), words.end(), ",") != words.end();
    }

    /// `T a [ 3 ]`, and no further dimension.
    static bool declares(const Text& words, size_t at) {
        const bool is_array = is_word_token(words[at]) && at + 3 < words.size() && words[at + 1] == "[" &&
                              is_whole(words[at + 2]) && words[at + 3] == "]";
        if (!is_array || !(is_word_token(words[at - 1]) || words[at - 1] == ",")) return false;
        if (is_one_of(words[at - 1], {"return", "case", "goto", "else"})) return false;
        return is_word_token(words[0]) && words[at - 1] != "," &&
               (at + 4 == words.size() || is_one_of(words[at + 4], {",", "=", ";"}));
    }

    std::map<std::string, size_t> sizes_;
};

/// The vectors of built-in types that a unit declares without a value, sets one component after another, and uses as a
/// whole though one was never set:
///
///     float4 t ;  t . x = a ;  t . y = b ;  t . z = c ;  p = p + t ;
class HalfSetVectors {
public:
    explicit HalfSetVectors(const std::vector<Text>& statements) {
        for (size_t i = 1; i < statements.size(); ++i) declare(statements[i]);
        for (size_t i = 1; i < statements.size(); ++i) read(i, statements[i]);
        for (const auto& [name, one] : vectors_) used_at_[one.used_at].push_back(name);
    }

    std::optional<LoneSlip> slip_of(size_t index) const {
        const auto used = used_at_.find(index);
        if (used == used_at_.end()) return std::nullopt;
        for (const std::string& name : used->second) {
            const Vector& one = vectors_.at(name);
            if (one.size == 0 || one.is_whole || one.set.size() < 2) continue;
            for (size_t k = 0; k < one.size; ++k)
                if (const std::string part(1, "xyzw"[k]); !one.set.contains(part))
                    return LoneSlip{0, "uses all of `" + name + "`, of which `" + part + "` is never set",
                                    "set `" + name + "." + part + "`, or leave it", true};
        }
        return std::nullopt;
    }

private:
    struct Vector {
        size_t size = 0;
        std::set<std::string> set;
        size_t used_at = 0;     ///< the first statement that uses all of it
        bool is_whole = false;  ///< set at once, or who knows how
    };

    /// How many components a type of its name has; 0 for others.
    static size_t size_of_type(const std::string& type) {
        const size_t size = type.empty() ? 0 : static_cast<size_t>(type.back() - '0');
        if (size < 2 || size > 4) return 0;
        std::string kind;
        for (const char c : type.substr(0, type.size() - 1))
            kind += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        return is_one_of(kind, {"float", "double", "half", "int", "uint", "vec", "dvec", "ivec", "uvec", "real"}) ? size
                                                                                                                  : 0;
    }

    void declare(const Text& words) {
        if (words.size() < 2) return;
        const size_t size = size_of_type(words[0]);
        if (size == 0 || !is_word_token(words[1])) return;
        for (size_t i = 1; i < words.size(); i += 2) {
            const bool ends = i + 1 == words.size() || words[i + 1] == ",";
            if (!is_word_token(words[i])) return;
            Vector& one = vectors_[words[i]];
            one.is_whole = one.is_whole || one.size != 0 || !ends;  // declared twice: which one is meant?
            one.size = size;
            if (!ends) return;
        }
    }

    void read(size_t index, const Text& words) {
        if (!words.empty() && size_of_type(words[0]) != 0 && words.size() > 1 && vectors_.contains(words[1])) return;
        for (size_t i = 0; i < words.size(); ++i) {
            const auto found = vectors_.find(words[i]);
            if (found == vectors_.end() || (i > 0 && is_one_of(words[i - 1], {".", "->", "::"}))) continue;
            Vector& one = found->second;
            const std::string next = i + 1 < words.size() ? words[i + 1] : "";
            if (next == "." && i + 2 < words.size()) {
                const bool sets = i == 0 && i + 3 < words.size() && words[i + 3] == "=";
                if (words[i + 2].size() > 1) one.is_whole = true;
                if (sets) one.set.insert(words[i + 2]);
                if (!sets && i + 3 < words.size() && sets_or_steps(words[i + 3])) one.is_whole = true;
                continue;
            }
            const std::string before = i > 0 ? words[i - 1] : "";
            const bool adds =
                is_one_of(next, {"+", "*"}) || is_one_of(before, {"+", "*", "-"}) || (before == "=" && next.empty());
            if (!adds || sets_or_steps(next)) one.is_whole = true;
            if (one.used_at == 0) one.used_at = index;
        }
    }

    std::map<std::string, Vector> vectors_;
    std::map<size_t, std::vector<std::string>> used_at_;  ///< by the first statement that uses all of them
};

bool has_name(StatementWords words) { return std::any_of(words.begin(), words.end(), is_word_token); }

/// `return a ? b : b`
std::optional<LoneSlip> choice_of_one(const Text& words) {
    for (size_t i = 1; i + 3 < words.size(); ++i) {
        if (words[i] != "?") continue;
        const auto branches = branches_at(words, i);
        if (branches && are_same(branches->left, branches->right) && has_name(branches->left))
            return LoneSlip{0, "gives " + quoted_words(branches->left) + " whatever it asks",
                            "say the other value, or leave it"};
    }
    return std::nullopt;
}

}  // namespace

std::vector<LoneSlip> lone_slips(const std::vector<WrittenStatement>& statements) {
    std::vector<Text> words;
    for (const WrittenStatement& one : statements) words.push_back(words_of_statement(one));
    const Loops loops(words);
    const Arrays arrays(words);
    const HalfSetVectors vectors(words);
    std::map<size_t, LoneSlip> found;
    for (size_t i = 1; i < words.size(); ++i) {
        if (words[i].empty() || words[i][0] == "#" || is_aside(words[i])) continue;
        const BracketPartners partners(words[i]);
        for (auto slip : {operand_twice(words[i], partners), argument_twice(words[i], partners),
                          question_twice(words[i], partners), operand_missing(words[i]), choice_of_one(words[i]),
                          loops.slip_of(words[i]), arrays.slip_of(words[i]), vectors.slip_of(i)}) {
            if (!slip) continue;
            slip->statement = i;
            found.try_emplace(i, std::move(*slip));
        }
    }
    for (LoneSlip& slip : sibling_slips(words)) found.try_emplace(slip.statement, std::move(slip));
    std::vector<LoneSlip> out;
    for (auto& [at, slip] : found) out.push_back(std::move(slip));
    return out;
}

}  // namespace porttool
