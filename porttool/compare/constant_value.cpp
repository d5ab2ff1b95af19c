// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/constant_value.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "porttool/compare/edits.h"
#include "porttool/normal/normal_form.h"

namespace porttool {
namespace {

/// A scalar, or a list of values by its text.
struct Value {
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

Value whole(int64_t integer, bool is_unsigned) {
    Value out;
    out.integer = is_unsigned ? static_cast<int64_t>(static_cast<uint32_t>(integer)) : integer;
    out.is_unsigned = is_unsigned;
    return out;
}

Value real(double number) {
    Value out;
    out.real = true;
    out.number = number;
    return out;
}

enum class Type : uint8_t { None, Int, Unsigned, Real, Many };

/// A built-in type by its common name; Many for vectors, which are lists of numbers.
Type type_of(std::string_view word, const Dialect& dialect) {
    const std::string* known = dialect.find(word);
    const std::string_view name = known != nullptr && !known->empty() ? *known : word;
    if (name == "int" || name == "short" || name == "long" || name == "char" || name == "signed" || name == "int64" ||
        name == "bool" || name == "size_t" || name == "auto")
        return Type::Int;
    if (name == "uint" || name == "unsigned") return Type::Unsigned;
    if (name == "float" || name == "double" || name == "half") return Type::Real;
    const bool vector = name.size() > 1 && name.back() >= '2' && name.back() <= '4' &&
                        (name.starts_with("float") || name.starts_with("int") || name.starts_with("uint") ||
                         name.starts_with("double") || name.starts_with("vec") || name.starts_with("make_"));
    return vector ? Type::Many : Type::None;
}

constexpr int kDeepest = 200;

class Evaluator {
public:
    Evaluator(const Words& words, const Dialect& dialect) : words_(words), dialect_(dialect) {}

    std::optional<Value> run() {
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

    std::optional<Value> binary(int least) {
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

    static std::optional<Value> apply(const Value& a, std::string_view op, const Value& b) {
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

    std::optional<Value> unary() {
        if (++depth_ > kDeepest) return {};
        auto out = operand();
        --depth_;
        return out;
    }

    std::optional<Value> operand() {
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
        if (type_of(word(), dialect_) != Type::None) return construct();
        return literal();
    }

    /// One or more words of a built-in type: `unsigned int`.
    Type type() {
        Type out = Type::None;
        for (Type next = type_of(word(), dialect_); next != Type::None; next = type_of(word(), dialect_)) {
            if (out != Type::Unsigned) out = next;
            ++at_;
        }
        return out;
    }

    static std::optional<Value> converted(std::optional<Value> value, Type type) {
        if (!value || !value->list.empty() || type == Type::Many) return value;
        if (type == Type::Real) return real(value->as_real());
        if (value->real && !(std::abs(value->number) < 9e18)) return {};
        const auto integer = value->real ? static_cast<int64_t>(value->number) : value->integer;
        return whole(integer, type == Type::Unsigned);
    }

    std::optional<Value> cast_or_group() {
        ++at_;
        const size_t start = at_;
        if (const Type to = type(); to != Type::None && take(")")) return converted(unary(), to);
        at_ = start;
        auto inner = binary(0);
        if (!take(")")) return {};
        return inner;
    }

    /// `float(2)`, `vec3(1, 2, 3)`, `float[2](1, 3)`, `int{9}`
    std::optional<Value> construct() {
        Type to = type();
        if (take("[")) {
            while (!word().empty() && word() != "]") ++at_;
            if (!take("]")) return {};
            to = Type::Many;
        }
        if (word() == "(") return to == Type::Many ? list("(", ")") : converted(cast_or_group(), to);
        if (word() == "{") return converted(list("{", "}"), to);
        return {};
    }

    /// A list of one is its value: `int N{9}`.
    std::optional<Value> list(const char* open, const char* close) {
        if (!take(open)) return {};
        std::vector<Value> values;
        while (word() != close) {
            const auto value = binary(0);
            if (!value) return {};
            values.push_back(*value);
            if (!take(",")) break;
        }
        if (!take(close) || values.empty()) return {};
        if (values.size() == 1) return values[0];
        Value out;
        for (const Value& value : values) out.list += (out.list.empty() ? "{" : ",") + value.text();
        out.list += "}";
        return out;
    }

    std::optional<Value> literal() {
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

/// The tokens of a constant's value: behind the first `=`, from the first `{`, or behind a macro's name. Empty for a
/// macro with parameters.
Words value_words(const Words& tokens) {
    auto first = tokens.begin();
    auto end = tokens.end();
    if (tokens.size() > 3 && tokens[0] == "#")
        first += 3;
    else
        first = std::find_if(first, end, [](const auto& t) { return t == "=" || t == "{"; });
    if (first != end && *first == "=") ++first;
    while (first < end && *(end - 1) == ";") --end;
    Words out;
    for (; first != end; ++first) {
        const bool second = !out.empty() && (*first == "<" || *first == ">") && out.back() == *first;
        if (second)
            out.back() = *first == "<" ? "<<" : ">>";  // normal form has shifts as two tokens
        else
            out.push_back(*first);
    }
    return out;
}

/// The declared type of a constant, which converts its value: `const float A = 1`.
Type declared_type(const Words& tokens, const Dialect& dialect) {
    if (!tokens.empty() && tokens[0] == "#") return Type::None;
    Type out = Type::None;
    for (const std::string_view word : tokens) {
        if (word == "=" || word == "{") break;
        if (word == "[") return Type::Many;
        if (out == Type::None || type_of(word, dialect) == Type::Unsigned)
            out = type_of(word, dialect) == Type::None ? out : type_of(word, dialect);
        if (word == "auto") out = Type::None;
    }
    return out;
}

std::string shown(const Words& words) {
    std::string out;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string_view before = i > 0 ? words[i - 1] : "(", previous = i > 1 ? words[i - 2] : "(";
        const auto opens = [](std::string_view w) { return w == "(" || w == "[" || w == "{"; };
        const auto is_sign = [](std::string_view w) { return w == "-" || w == "+" || w == "~"; };
        const bool behind_sign =
            is_sign(before) && (opens(previous) || previous == "," || previous.find_first_of("+-*/%<>&|^") == 0);
        const bool tight = i == 0 || opens(before) || words[i] == ")" || words[i] == "]" || words[i] == "}" ||
                           words[i] == "," || words[i] == ";" || words[i] == "[" || behind_sign ||
                           (words[i] == "(" && (std::isalpha(static_cast<unsigned char>(before[0])) || before == "]"));
        out += tight ? "" : " ";
        out += words[i];
    }
    constexpr size_t kLongest = 80;
    if (out.size() > kLongest) out = out.substr(0, kLongest) + "...";
    return "'" + out + "'";
}

/// The fields of a struct, one declarator each and sized types as one word: `float3 o, d;` and `unsigned int k;` become
/// `float3 o; float3 d; uint k;`.
Words single_fields(const Words& tokens) {
    Words out;
    auto at = std::find(tokens.begin(), tokens.end(), "{");
    out.assign(tokens.begin(), at == tokens.end() ? at : at + 1);
    Words field;
    const auto flush = [&] {
        size_t name = field.size(), depth = 0;
        std::vector<size_t> commas;
        for (size_t i = 0; i < field.size(); ++i) {
            if (field[i] == "(" || field[i] == "[" || field[i] == "<") ++depth;
            if ((field[i] == ")" || field[i] == "]" || field[i] == ">") && depth > 0) --depth;
            if (depth == 0 && field[i] == ",") commas.push_back(i);
        }
        const size_t first_end = commas.empty() ? field.size() : commas[0];
        for (size_t i = 0; i < first_end && name == field.size(); ++i)
            if (i + 1 == first_end || field[i + 1] == "[" || field[i + 1] == "=" || field[i + 1] == ":") name = i;
        commas.push_back(field.size());
        out.insert(out.end(), field.begin(), field.begin() + static_cast<std::ptrdiff_t>(first_end));
        for (size_t c = 0; c + 1 < commas.size(); ++c) {
            out.emplace_back(";");
            out.insert(out.end(), field.begin(), field.begin() + static_cast<std::ptrdiff_t>(name));
            out.insert(out.end(), field.begin() + static_cast<std::ptrdiff_t>(commas[c]) + 1,
                       field.begin() + static_cast<std::ptrdiff_t>(commas[c + 1]));
        }
        field.clear();
    };
    for (at = at == tokens.end() ? at : at + 1; at != tokens.end(); ++at) {
        if (*at == ";" || *at == "{" || *at == "}") {
            flush();
            out.push_back(*at);
            continue;
        }
        if (*at == "int" && !field.empty() && (field.back() == "unsigned" || field.back() == "signed")) {
            field.back() = field.back() == "unsigned" ? "uint" : "int";
            continue;
        }
        field.push_back(*at);
    }
    flush();
    return out;
}

ComparedValues compare_structs(const Words& left, const Words& right, const Dialect& dialect) {
    ComparedValues out;
    const Words left_fields = single_fields(left), right_fields = single_fields(right);
    out.same = value_in_common_words(left_fields, dialect, true) == value_in_common_words(right_fields, dialect, true);
    const auto plain = [](const Words& words) {  // nothing but fields: no functions, bases or access words
        return std::find_if(words.begin(), words.end(),
                            [](const auto& w) { return w == "(" || w == ":" || w == "<" || w == "#"; }) == words.end();
    };
    out.certain = plain(left_fields) && plain(right_fields);
    const auto body = [](const Words& words) {
        auto first = std::find(words.begin(), words.end(), "{");
        auto end = words.end();
        if (first != end) ++first;
        while (first < end && (*(end - 1) == ";" || *(end - 1) == "}")) --end;
        return shown({first, end});
    };
    out.says = "the fields are " + body(left) + " in the source and " + body(right) + " in the port";
    return out;
}

}  // namespace

std::string evaluate_constant(const Words& tokens, const Dialect& dialect) {
    const auto value = Evaluator(tokens, dialect).run();
    return value ? value->text() : std::string();
}

ComparedValues compare_values(UnitKind kind, const Words& left, const Words& right, const Dialect& dialect) {
    if (kind == UnitKind::Struct) return compare_structs(left, right, dialect);
    const auto value_of = [&](const Words& tokens) {
        Words words = value_words(tokens);
        const Type type = declared_type(tokens, dialect);
        if (type == Type::Real || type == Type::Unsigned || type == Type::Int) {
            words.insert(words.begin(), type == Type::Real ? "float" : type == Type::Int ? "int" : "uint");
            words.insert(words.begin() + 1, "(");
            words.emplace_back(")");
        }
        return evaluate_constant(words, dialect);
    };
    ComparedValues out;
    const std::string a = value_of(left), b = value_of(right);
    out.certain = !a.empty() && !b.empty();
    out.same = out.certain
                   ? a == b
                   : value_in_common_words(left, dialect, false) == value_in_common_words(right, dialect, false);
    Words left_shown = value_words(left), right_shown = value_words(right);
    for (Words* words : {&left_shown, &right_shown})
        if (words->size() == 3 && words->front() == "{") *words = {(*words)[1]};
    out.says = "the value is " + shown(left_shown) + " in the source and " + shown(right_shown) + " in the port";
    return out;
}

}  // namespace porttool
