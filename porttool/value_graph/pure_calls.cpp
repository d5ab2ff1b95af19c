// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/value_graph/pure_calls.h"

#include <algorithm>
#include <array>

#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

/// Of each component by itself: what they give has the type of their arguments.
constexpr std::array<std::string_view, 38> kByComponent = {
    "mix",  "fract",      "inversesqrt", "sqrt", "abs",       "fabs",    "min",   "max",     "clamp", "saturate",
    "mod",  "fmod",       "pow",         "exp",  "exp2",      "log",     "log2",  "log10",   "sin",   "cos",
    "tan",  "asin",       "acos",        "atan", "tanh",      "floor",   "ceil",  "round",   "rint",  "trunc",
    "step", "smoothstep", "sign",        "fma",  "normalize", "reflect", "cross", "copysign"};

constexpr std::array<std::string_view, 38> kOthers = {"dot",
                                                      "length",
                                                      "distance",
                                                      "floatBitsToUint",
                                                      "floatBitsToInt",
                                                      "intBitsToFloat",
                                                      "bitCount",
                                                      "findLSB",
                                                      "ffs",
                                                      "findMSB",
                                                      "clz",
                                                      "isnan",
                                                      "isinf",
                                                      "any",
                                                      "all",
                                                      "refract",
                                                      "hypot",
                                                      "cbrt",
                                                      "sinh",
                                                      "cosh",
                                                      "asinh",
                                                      "acosh",
                                                      "atanh",
                                                      "sinpi",
                                                      "cospi",
                                                      "rcbrt",
                                                      "exp10",
                                                      "erf",
                                                      "erfc",
                                                      "tgamma",
                                                      "ldexp",
                                                      "fdim",
                                                      "remainder",
                                                      "isfinite",
                                                      "expm1",
                                                      "log1p",
                                                      "transpose",
                                                      "determinant"};

constexpr std::array<std::string_view, 9> kFixed = {"local_id", "group_id", "group_size", "group_count", "global_id",
                                                    "pi",       "inv_pi",   "two_pi",     "infinity"};

template <class List>
bool holds(const List& list, std::string_view word) {
    return std::find(list.begin(), list.end(), word) != list.end();
}

std::string common(std::string_view name, const Dialect& dialect) {
    if (name.starts_with("std :: ")) name.remove_prefix(7);
    const std::string* known = dialect.meaning(name);
    return known != nullptr && !known->empty() ? *known : std::string(name);
}

}  // namespace

PureCall pure_call(std::string_view name, const Dialect& dialect) {
    std::string known = common(name, dialect);
    const bool pure = holds(kByComponent, known) || holds(kOthers, known) || holds(kFixed, known);
    return {pure, std::move(known)};
}

std::string type_of_call(const PureCall& call, const ValueTable& table, const std::vector<Value>& arguments) {
    if (arguments.empty()) return {};
    const std::string first(table.type(arguments[0]));
    if (is_one_of(call.name, {"dot", "length", "distance"})) return first.starts_with("vec") ? "float" : std::string();
    if (!holds(kByComponent, call.name) || first.empty() || first == "bool") return {};
    const bool alike =
        std::all_of(arguments.begin(), arguments.end(), [&](Value value) { return table.type(value) == first; });
    // Of whole numbers C's functions make double ones.
    return alike && (first == "float" || first == "double" || first.starts_with("vec")) ? first : std::string();
}

bool is_fixed_name(std::string_view name, const Dialect& dialect) { return holds(kFixed, common(name, dialect)); }

}  // namespace porttool
