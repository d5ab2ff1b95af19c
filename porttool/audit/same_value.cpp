// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/same_value.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>

#include "porttool/audit/idle_casts.h"
#include "porttool/language/words.h"
#include "porttool/normal/statements.h"
#include "porttool/text/is_one_of.h"

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// splitmix64, one step (Steele et al. 2014).
uint64_t mixed(uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// A number that bits stand for: of either sign, over forty powers of two, now and then zero, tiny or huge.
double drawn(uint64_t bits) {
    const double sign = (bits & 1u) != 0 ? -1.0 : 1.0;
    const uint64_t rare = bits >> 1 & 31u;
    if (rare < 3) return 0;
    if (rare == 3) return sign * 1e-30;
    if (rare == 4) return sign * 1e30;
    const double fraction = 1.0 + static_cast<double>(bits >> 12) * 0x1p-52;
    return sign * std::ldexp(fraction, static_cast<int>(bits >> 6 & 31u) - 16);
}

/// The number without the digits in which two ways to compute it may differ, as bits.
uint64_t rounded(double number) {
    int power = 0;
    const double fraction = std::frexp(number, &power);
    const auto digits = std::isfinite(number) ? static_cast<int64_t>(std::llround(fraction * 0x1p30)) : INT64_MAX;
    return mixed(static_cast<uint64_t>(digits)) ^ mixed(static_cast<uint64_t>(power) + 77);
}

bool same_number(double a, double b) {
    if (std::isnan(a) || std::isnan(b)) return std::isnan(a) && std::isnan(b);
    if (std::isinf(a) || std::isinf(b)) return a == b;
    return std::abs(a - b) <= 1e-9 * std::max(std::abs(a), std::abs(b));
}

bool is_real(const std::string& word) {
    return is_number_token(word) && !word.starts_with("0x") && word.find_first_of(".eEfF") != std::string::npos;
}

/// What a name says of its own value: M_1_PI_F, INV_TWOPI.
std::optional<double> value_by_name(std::string_view name) {
    constexpr double kPi = 3.14159265358979323846;
    std::string plain = folded(name);
    if (plain.ends_with("f")) plain.pop_back();
    if (plain == "pi" || plain == "mpi") return kPi;
    if (plain == "twopi" || plain == "2pi") return 2 * kPi;
    if (plain == "mpi2") return kPi / 2;
    if (plain == "mpi4") return kPi / 4;
    if (plain == "m1pi" || plain == "invpi" || plain == "1pi") return 1 / kPi;
    if (plain == "m2pi") return 2 / kPi;
    if (plain == "invtwopi" || plain == "inv2pi") return 0.5 / kPi;
    return std::nullopt;
}

struct Operator {
    std::string_view word;
    int level;  ///< binds the tighter the higher
};
constexpr Operator kOperators[] = {{"?", 0},  {"||", 1}, {"&&", 2}, {"|", 3},  {"^", 4},  {"&", 5},  {"==", 6},
                                   {"!=", 6}, {"<", 7},  {">", 7},  {"<=", 7}, {">=", 7}, {"<<", 8}, {">>", 8},
                                   {"+", 9},  {"-", 9},  {"*", 10}, {"/", 10}, {"%", 10}};

const Operator* operator_of(const std::string& word) {
    const auto found = std::find_if(std::begin(kOperators), std::end(kOperators),
                                    [&](const Operator& one) { return one.word == word; });
    return found == std::end(kOperators) ? nullptr : found;
}

/// One reading of a statement with numbers for its names.
class Reading {
public:
    /// `real`: `/` is no division of integers.
    Reading(const Text& words, uint64_t draw, bool real) : words_(words), draw_(draw), real_(real) {}

    /// The values of all expressions, with what stands between them; empty where it cannot be read.
    std::vector<double> values() {
        std::vector<double> out;
        const bool loops = !words_.empty() && word_is(words_[0], kLoopHead);
        while (at_ < words_.size() && !failed_) {
            const std::string& word = words_[at_];
            const bool operand = word == "(" ? !loops : !word_is(word, kKeyword) || is_type_word(word);
            if (operand && begins_operand(word)) {
                out.push_back(expression(0).number);
            } else {
                out.push_back(of_word(word));
                ++at_;
            }
        }
        if (failed_) out.clear();
        return out;
    }

private:
    struct Value {
        double number = 0;
        bool compares = false;  ///< by `<`: then these two
        double smaller = 0, greater = 0;
        bool is_truth = false;  ///< then the opposite truth is the opposite number
    };

    static bool begins_operand(const std::string& word) {
        return is_word_token(word) || is_number_token(word) || word == "(" || word == "-" || word == "+" ||
               word == "!" || word == "~" || word[0] == '"' || word[0] == '\'';
    }
    double of_word(std::string_view word) const {
        if (const auto known = value_by_name(word)) return *known;
        return random_value(word);
    }
    double random_value(std::string_view word) const {
        return drawn(mixed(std::hash<std::string_view>()(word) ^ draw_));
    }
    /// What is no arithmetic: a value by its name and operands alone.
    double opaque(std::string_view name, const std::vector<double>& operands) const {
        uint64_t bits = std::hash<std::string_view>()(name);
        for (const double operand : operands) bits = mixed(bits ^ rounded(operand));
        return drawn(mixed(bits ^ draw_));
    }
    bool is_at(std::string_view word) const { return at_ < words_.size() && words_[at_] == word; }
    void expect(std::string_view word) {
        if (is_at(word))
            ++at_;
        else
            failed_ = true;
    }

    Value expression(int least) {
        if (!goes_deeper()) return {};
        Value left = unary();
        while (!failed_ && at_ < words_.size()) {
            const Operator* found = operator_of(words_[at_]);
            if (found == nullptr || found->level < least) break;
            ++at_;
            left = found->level == 0 ? choice(left) : combined(*found, left, expression(found->level + 1));
        }
        --depth_;
        return left;
    }

    Value choice(const Value& condition) {
        double yes = expression(0).number;
        expect(":");
        double no = expression(0).number;
        const double small = condition.smaller, great = condition.greater;
        if (condition.compares && yes == small && no == great) return {std::min(small, great)};
        if (condition.compares && yes == great && no == small) return {std::max(small, great)};
        const bool sign =
            condition.compares && yes == -no && ((small == 0 && yes == great) || (great == 0 && no == small));
        if (sign) return {std::abs(yes)};
        const bool opposite = condition.is_truth && condition.number < 0;
        if (opposite) std::swap(yes, no);
        return {opaque("?", {opposite ? -condition.number : condition.number, yes, no})};
    }

    Value combined(const Operator& by, const Value& left, const Value& right) const {
        double a = left.number, b = right.number;
        switch (by.word[0]) {
            case '+':
                return {a + b};
            case '-':
                return {a - b};
            case '*':
                return {a * b};
            case '/':
                return real_ ? Value{a / b} : Value{opaque("/", {a, b})};
            default:
                break;
        }
        if (by.level == 7) return ordered(by.word, a, b);
        const bool both = by.word == "&&";  // not (not a or not b)
        if (both) {
            a = left.is_truth ? -a : opaque("!", {a});
            b = right.is_truth ? -b : opaque("!", {b});
        }
        const bool either_way = by.level >= 1 && by.level <= 6;
        if (either_way && b < a) std::swap(a, b);
        const std::string_view name = both ? "||" : by.word == "!=" ? "==" : by.word;
        const double value = opaque(name, {a, b});
        return {both || by.word == "!=" ? -value : value, false, 0, 0, both || is_one_of(by.word, {"||", "==", "!="})};
    }

    /// `a >= b` is the opposite of `a < b`, and `a > b` is `b < a`.
    Value ordered(std::string_view by, double a, double b) const {
        const bool opposite = by == ">=" || by == "<=";
        const bool turned = by == ">" || by == "<=";
        if (turned) std::swap(a, b);
        const double value = opaque("<", {a, b});
        if (opposite) std::swap(a, b);
        return {opposite ? -value : value, true, a, b, true};
    }

    /// Nothing is read beyond a depth that nobody writes: each level is one of the stack as well.
    bool goes_deeper() {
        constexpr int kDeepest = 400;
        failed_ = failed_ || ++depth_ > kDeepest;
        return !failed_;
    }

    Value unary() {
        failed_ = failed_ || at_ >= words_.size();
        if (!goes_deeper()) return {};
        const Value out = operand();
        --depth_;
        return out;
    }

    Value operand() {
        const std::string& word = words_[at_++];
        if (word == "-") return {-unary().number};
        if (word == "+") return unary();
        if (word == "!") {
            const Value of = unary();
            return {of.is_truth ? -of.number : opaque("!", {of.number}), false, 0, 0, of.is_truth};
        }
        if (word == "~") return {opaque(word, {unary().number})};
        Value out;
        if (word == "(") {
            out = expression(0);
            expect(")");
        } else if (is_number_token(word)) {
            out.number = std::strtod(word.c_str(), nullptr);
        } else if (is_at("(")) {
            out.number = call(word);
        } else if (begins_operand(word)) {
            out.number = of_word(word);
        } else {
            failed_ = true;
        }
        return postfix(out);
    }

    Value postfix(Value out) {
        while (!failed_ && at_ < words_.size()) {
            if (is_at(".") && at_ + 1 < words_.size()) {
                out = {opaque("." + words_[at_ + 1], {out.number})};
                at_ += 2;
            } else if (is_at("[")) {
                ++at_;
                out = {opaque("[", {out.number, expression(0).number})};
                expect("]");
            } else if (is_at("(")) {
                std::vector<double> operands = arguments();
                operands.push_back(out.number);
                out = {opaque("()", operands)};
            } else {
                break;
            }
        }
        return out;
    }

    std::vector<double> arguments() {
        std::vector<double> out;
        expect("(");
        while (!failed_ && !is_at(")")) {
            if (!out.empty()) expect(",");
            if (!failed_) out.push_back(expression(0).number);
        }
        expect(")");
        return out;
    }

    double call(const std::string& name) {
        const std::vector<double> of = arguments();
        std::string_view plain = name;
        if (plain.ends_with("f") && plain.size() > 3) plain.remove_suffix(1);
        if (plain.starts_with("f") && (plain == "fmin" || plain == "fmax" || plain == "fabs")) plain.remove_prefix(1);
        if (of.size() == 1) {
            if (plain == "sqrt") return std::sqrt(of[0]);
            if (plain == "rsqrt") return 1 / std::sqrt(of[0]);
            if (plain == "abs") return std::abs(of[0]);
            if (plain == "exp") return std::exp(of[0]);
            if (plain == "log") return std::log(of[0]);
        }
        if (of.size() == 2) {
            if (plain == "min") return std::min(of[0], of[1]);
            if (plain == "max") return std::max(of[0], of[1]);
            if (plain == "pow") return std::pow(of[0], of[1]);
        }
        if (of.size() == 3 && (plain == "fma" || plain == "mad")) return of[0] * of[1] + of[2];
        return opaque(name, of);
    }

    const Text& words_;
    uint64_t draw_;
    bool real_;
    size_t at_ = 0;
    int depth_ = 0;
    bool failed_ = false;
};

}  // namespace

bool has_real_number(const Text& words) { return std::any_of(words.begin(), words.end(), is_real); }

bool give_the_same_value(const Text& first, const Text& second, bool real) {
    const auto [a, b] = without_idle_casts(first, second);
    constexpr uint64_t kDraws = 64;
    constexpr int kFewest = 2;  // where all is a number
    real = real || has_real_number(a) || has_real_number(b);
    int finite = 0;
    for (uint64_t draw = 0; draw < kDraws; ++draw) {
        const std::vector<double> left = Reading(a, mixed(draw), real).values(),
                                  right = Reading(b, mixed(draw), real).values();
        if (left.empty() || !std::equal(left.begin(), left.end(), right.begin(), right.end(), same_number))
            return false;
        finite += std::all_of(left.begin(), left.end(), [](double one) { return std::isfinite(one); }) ? 1 : 0;
    }
    return finite >= kFewest;
}

bool ask_the_opposite(const Text& a, const Text& b) {
    if (a.size() < 4 || b.size() < 4 || a[0] != "if" || b[0] != "if" || a[1] != "(" || b[1] != "(") return false;
    Text opposite = {"if", "(", "!"};
    opposite.insert(opposite.end(), b.begin() + 1, b.end());
    opposite.emplace_back(")");
    return give_the_same_value(a, opposite);
}

}  // namespace porttool
