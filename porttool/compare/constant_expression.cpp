// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/constant_expression.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

/// A scalar, or a list of values by its text.
struct Number {
    bool real = false;
    bool is_unsigned = false;
    int64_t integer = 0;
    double number = 0;
    std::string list;  ///< "" for a scalar

    double as_real() const { return real ? number : static_cast<double>(integer); }
    std::string text() const {
        if (!list.empty()) return list;
        const double value = as_real();
        if (!real && std::abs(value) >= 9e15) return std::to_string(integer);
        std::array<char, 40> buffer{};
        const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value == 0 ? 0.0 : value);
        return {buffer.data(), end.ptr};
    }
};

Number whole(int64_t integer, bool is_unsigned) {
    Number out;
    out.integer = is_unsigned ? static_cast<int64_t>(static_cast<uint32_t>(integer)) : integer;
    out.is_unsigned = is_unsigned;
    return out;
}

Number real(double number) {
    Number out;
    out.real = true;
    out.number = number;
    return out;
}

constexpr int kDeepest = 200;

class Evaluator {
public:
    Evaluator(const Words& words, const Dialect& dialect) : words_(words), dialect_(dialect) {}

    std::optional<Number> run() {
        auto out = binary(0);
        if (at_ != words_.size()) return {};
        return out;
    }

private:
    std::string_view word() const { return at_ < words_.size() ? words_[at_] : std::string_view(); }
    bool take(const char* text) {
        if (word() != text) return false;
        ++at_;
        return true;
    }

    static int rank(std::string_view op) {
        constexpr std::array<std::array<const char*, 3>, 6> kRows = {
            {{"|", "", ""}, {"^", "", ""}, {"&", "", ""}, {"<<", ">>", ""}, {"+", "-", ""}, {"*", "/", "%"}}};
        for (size_t i = 0; i < kRows.size() && !op.empty(); ++i)
            if (std::find(kRows[i].begin(), kRows[i].end(), op) != kRows[i].end()) return static_cast<int>(i);
        return -1;
    }

    std::optional<Number> binary(int least) {
        auto left = unary();
        while (left) {
            const std::string_view op = word();
            const int level = rank(op);
            if (level < least) break;
            ++at_;
            const auto right = binary(level + 1);
            left = right ? apply(*left, op, *right) : std::nullopt;
        }
        return left;
    }

    static std::optional<Number> apply(const Number& a, std::string_view op, const Number& b) {
        if (!a.list.empty() || !b.list.empty()) return {};
        if (a.real || b.real) {
            const double x = a.as_real(), y = b.as_real();
            if (op == "+") return real(x + y);
            if (op == "-") return real(x - y);
            if (op == "*") return real(x * y);
            if (op == "/" && y != 0) return real(x / y);
            return {};
        }
        const bool is_unsigned = a.is_unsigned || (b.is_unsigned && op != "<<" && op != ">>");
        const auto x = static_cast<uint64_t>(a.integer), y = static_cast<uint64_t>(b.integer);
        const auto wrap = [&](uint64_t v) { return whole(static_cast<int64_t>(v), is_unsigned); };
        if (op == "+") return wrap(x + y);
        if (op == "-") return wrap(x - y);
        if (op == "*") return wrap(x * y);
        if (op == "|") return wrap(x | y);
        if (op == "&") return wrap(x & y);
        if (op == "^") return wrap(x ^ y);
        if (op == "<<" && y < 63) return wrap(x << y);
        if (op == ">>" && y < 63) return whole(a.integer >> y, is_unsigned);
        if (b.integer == 0 || b.integer == -1) return {};
        if (op == "/") return whole(a.integer / b.integer, is_unsigned);
        if (op == "%") return whole(a.integer % b.integer, is_unsigned);
        return {};
    }

    std::optional<Number> unary() {
        if (++depth_ > kDeepest) return {};
        auto out = operand();
        --depth_;
        return out;
    }

    std::optional<Number> operand() {
        if (take("+")) return unary();
        if (take("-")) {
            const auto value = unary();
            if (!value || !value->list.empty()) return {};
            return value->real
                       ? real(-value->number)
                       : whole(static_cast<int64_t>(0 - static_cast<uint64_t>(value->integer)), value->is_unsigned);
        }
        if (take("~")) {
            const auto value = unary();
            if (!value || !value->list.empty() || value->real) return {};
            return whole(~value->integer, value->is_unsigned);
        }
        if (word() == "{") return list("{", "}");
        if (word() == "(") return cast_or_group();
        if (number_type(word(), dialect_) != NumberType::None) return construct();
        return literal();
    }

    /// One or more words of a built-in type: `unsigned int`.
    NumberType type() {
        NumberType out = NumberType::None;
        for (NumberType next = number_type(word(), dialect_); next != NumberType::None;
             next = number_type(word(), dialect_)) {
            if (out != NumberType::Unsigned) out = next;
            ++at_;
        }
        return out;
    }

    static std::optional<Number> converted(std::optional<Number> value, NumberType type) {
        if (!value || !value->list.empty() || type == NumberType::Many) return value;
        if (type == NumberType::Real) return real(value->as_real());
        if (value->real && !(std::abs(value->number) < 9e18)) return {};
        const auto integer = value->real ? static_cast<int64_t>(value->number) : value->integer;
        return whole(integer, type == NumberType::Unsigned);
    }

    std::optional<Number> cast_or_group() {
        ++at_;
        const size_t start = at_;
        if (const NumberType to = type(); to != NumberType::None && take(")")) return converted(unary(), to);
        at_ = start;
        auto inner = binary(0);
        if (!take(")")) return {};
        return inner;
    }

    /// `float(2)`, `vec3(1, 2, 3)`, `float[2](1, 3)`, `int{9}`
    std::optional<Number> construct() {
        NumberType to = type();
        if (take("[")) {
            while (!word().empty() && word() != "]") ++at_;
            if (!take("]")) return {};
            to = NumberType::Many;
        }
        if (word() == "(") return to == NumberType::Many ? list("(", ")") : converted(cast_or_group(), to);
        if (word() == "{") return converted(list("{", "}"), to);
        return {};
    }

    /// A list of one is its value: `int N{9}`.
    std::optional<Number> list(const char* open, const char* close) {
        if (!take(open)) return {};
        std::vector<Number> values;
        while (word() != close) {
            const auto value = binary(0);
            if (!value) return {};
            values.push_back(*value);
            if (!take(",")) break;
        }
        if (!take(close) || values.empty()) return {};
        if (values.size() == 1) return values[0];
        Number out;
        for (const Number& value : values) out.list += (out.list.empty() ? "{" : ",") + value.text();
        out.list += "}";
        return out;
    }

    std::optional<Number> literal() {
        const std::string_view text = word();
        ++at_;
        if (text == "true" || text == "false") return whole(text == "true" ? 1 : 0, false);
        const bool digit = !text.empty() && ((text[0] >= '0' && text[0] <= '9') || text[0] == '.');
        if (!digit) return {};
        const std::string plain = number_value(text);
        const std::string normal = normal_number(text);
        const bool is_real = normal.find_first_of(".fhe") != std::string::npos;
        if (is_real) {
            double value = 0;
            const auto read = std::from_chars(plain.data(), plain.data() + plain.size(), value);
            if (read.ec != std::errc() || read.ptr != plain.data() + plain.size()) return {};
            return real(value);
        }
        uint64_t value = 0;
        const auto read = std::from_chars(plain.data(), plain.data() + plain.size(), value);
        if (read.ec != std::errc() || read.ptr != plain.data() + plain.size()) return {};
        const bool small = normal.ends_with('u') && value <= 0xFFFFFFFFu;
        return whole(static_cast<int64_t>(value), small);
    }

    const Words& words_;
    const Dialect& dialect_;
    size_t at_ = 0;
    int depth_ = 0;
};

}  // namespace

NumberType number_type(std::string_view word, const Dialect& dialect) {
    const std::string* known = dialect.find(word);
    const std::string_view name = known != nullptr && !known->empty() ? *known : word;
    if (name == "int" || name == "short" || name == "long" || name == "char" || name == "signed" || name == "int64" ||
        name == "bool" || name == "size_t" || name == "auto")
        return NumberType::Int;
    if (name == "uint" || name == "unsigned") return NumberType::Unsigned;
    if (name == "float" || name == "double" || name == "half") return NumberType::Real;
    const bool vector = name.size() > 1 && name.back() >= '2' && name.back() <= '4' &&
                        (name.starts_with("float") || name.starts_with("int") || name.starts_with("uint") ||
                         name.starts_with("double") || name.starts_with("vec") || name.starts_with("make_"));
    return vector ? NumberType::Many : NumberType::None;
}

std::string evaluate_constant(const Words& tokens, const Dialect& dialect) {
    const auto value = Evaluator(tokens, dialect).run();
    return value ? value->text() : std::string();
}

}  // namespace porttool
