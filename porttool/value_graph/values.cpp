// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/value_graph/values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "porttool/normal/declaration_words.h"

namespace porttool {
namespace {

constexpr size_t kMostValues = 10'000;

/// Numbers by how wide they are: of two, arithmetic happens in the later one. Narrower integers are none of these,
/// since they become int first.
constexpr std::array<std::string_view, 4> kScalars = {"int", "uint", "float", "double"};

size_t width_of(std::string_view type) {
    return static_cast<size_t>(std::find(kScalars.begin(), kScalars.end(), type) - kScalars.begin());
}

/// The components of "vec3", "ivec2"; 0 for what is no vector.
size_t components_of(std::string_view type) {
    if (!type.starts_with("vec") && !type.starts_with("ivec") && !type.starts_with("uvec")) return 0;
    const char last = type.back();
    return last >= '2' && last <= '4' ? static_cast<size_t>(last - '0') : 0;
}

/// The type of a vector's component.
std::string_view component_type(std::string_view type) {
    return type.starts_with("ivec") ? "int" : type.starts_with("uvec") ? "uint" : "float";
}

/// The place of a component that is named by one letter, or 4.
size_t component_at(std::string_view name) {
    return name.size() == 1 ? std::min<size_t>(std::string_view("xyzw").find(name[0]), 4) : 4;
}

bool compares(std::string_view operation) { return is_one_of(operation, {"<", "<=", "==", "!="}); }

/// The same bits whichever operand stands first, for numbers and vectors of them.
bool is_commutative(std::string_view operation) { return is_one_of(operation, {"+", "*", "==", "!=", "&", "|", "^"}); }

/// The type of an operation on two numbers or vectors of one type, or a vector and a number; "" if it is not known.
std::string_view type_of_result(std::string_view left, std::string_view right) {
    if (left == right) return left;
    if (components_of(left) != 0 && right == component_type(left)) return left;
    if (components_of(right) != 0 && left == component_type(right)) return right;
    return {};
}

}  // namespace

bool is_scalar_type(std::string_view type) { return width_of(type) < kScalars.size(); }

bool is_plain_type(std::string_view type) { return is_scalar_type(type) || type == "bool" || components_of(type) != 0; }

uint32_t ValueTable::name(std::string_view text) {
    const auto found = numbers_of_names_.find(text);
    if (found != numbers_of_names_.end()) return found->second;
    names_.emplace_back(text);
    return numbers_of_names_.emplace(text, static_cast<uint32_t>(names_.size() - 1)).first->second;
}

Value ValueTable::node(std::string_view operation, std::vector<Value> parts, std::string_view type) {
    Node made{name(operation), name(type), std::move(parts)};
    const auto found = known_.find(made);
    if (found != known_.end()) return found->second;
    if (nodes_.size() >= kMostValues) throw Unread();
    nodes_.push_back(made);
    return known_.emplace(std::move(made), static_cast<Value>(nodes_.size() - 1)).first->second;
}

Value ValueTable::choice(Value condition, Value yes, Value no) {
    if (yes == no) return yes;
    const std::vector<Value>& of_condition = parts(condition);
    if (operation(condition) == "!") return choice(of_condition[0], no, yes);
    if (operation(condition) == "&&") return choice(of_condition[0], choice(of_condition[1], yes, no), no);
    if (operation(condition) == "||") return choice(of_condition[0], yes, choice(of_condition[1], yes, no));
    const auto decided = [&](Value value, size_t way) {
        return operation(value) == "?:" && parts(value)[0] == condition ? parts(value)[way] : value;
    };
    yes = decided(yes, 1);
    no = decided(no, 2);
    if (yes == no) return yes;
    const std::string type(this->type(yes) == this->type(no) ? this->type(yes) : std::string_view());
    return node("?:", {condition, yes, no}, type);
}

Value ValueTable::converted(Value value, std::string_view type) {
    const std::string here(this->type(value));
    if (type.empty() || here == type) return value;
    if (operation(value) == "?:") {
        const std::vector<Value>& ways = parts(value);
        return choice(ways[0], converted(ways[1], type), converted(ways[2], type));
    }
    if (is_number(value) && is_scalar_type(here) && is_scalar_type(type)) {
        const std::string text(operation(parts(value)[0]));
        const double exact = std::strtod(text.c_str(), nullptr);
        const bool short_enough = type == "float" && width_of(here) < width_of("float") && std::fabs(exact) < 1 << 24;
        const bool rounds_once =
            type == "float" && here == "double" && std::strtof(text.c_str(), nullptr) == static_cast<float>(exact);
        const bool keeps = type == "double" || (type == "uint" && here == "int") || short_enough || rounds_once;
        if (keeps && here != "float") return node("number", {parts(value)[0]}, type);
    }
    return node("as " + std::string(type), {value}, type);
}

bool ValueTable::is_known(std::string_view type) const {
    return only_numbers_ ? is_scalar_type(type) : is_plain_type(type);
}

bool ValueTable::may_swap(std::string_view operation, Value left, Value right) const {
    if (!is_known(type(left)) || !is_known(type(right)) || !is_commutative(operation)) return false;
    if (!only_numbers_ || operation != "+" || type(left) == "int" || type(left) == "uint") return true;
    const auto may_be_product = [&](Value value) {
        const std::string_view made = this->operation(value);
        return made == "*" || made == "negative" || made == "?:" || made.starts_with("as ");
    };
    return !may_be_product(left) || !may_be_product(right);
}

Value ValueTable::binary(std::string_view operation, Value left, Value right) {
    if (operation == ">" || operation == ">=") {
        const bool known = is_known(type(left)) && is_known(type(right));
        if (known) return binary(operation == ">" ? "<" : "<=", right, left);
    }
    if (operation == "&&" || operation == "||") return node(operation, {left, right}, "bool");
    const bool shifts = operation == "<<" || operation == ">>";
    if (!shifts && is_scalar_type(type(left)) && is_scalar_type(type(right))) {
        const std::string_view wider = width_of(type(left)) < width_of(type(right)) ? type(right) : type(left);
        const std::string common(wider);
        left = converted(left, common);
        right = converted(right, common);
    }
    const bool plain = is_known(type(left)) && is_known(type(right));
    if (operation == "!=" && plain) return node("!", {binary("==", left, right)}, "bool");
    // Of whole numbers one is less or the other is not more.
    const auto whole = [&](Value value) { return type(value) == "int" || type(value) == "uint"; };
    if (operation == "<=" && whole(left) && whole(right)) return node("!", {binary("<", right, left)}, "bool");
    std::string result(plain && !shifts ? type_of_result(type(left), type(right)) : std::string_view());
    const bool moves_pointer = (operation == "+" || operation == "-") && type(left).ends_with('*');
    if ((shifts && is_scalar_type(type(left))) || moves_pointer) result = type(left);
    if (compares(operation) && is_scalar_type(type(left))) result = "bool";
    if (result == "bool" && !compares(operation)) result = "int";
    if (right < left && may_swap(operation, left, right)) std::swap(left, right);
    return node(operation, {left, right}, result);
}

Value ValueTable::number(std::string_view written, bool shading) {
    std::string digits(written);
    std::string suffix;
    const bool hexadecimal = digits.starts_with("0x") || digits.starts_with("0X");
    const std::string_view suffixes = hexadecimal ? "uUlL" : "uUlLfFhH";
    while (!digits.empty() && suffixes.find(digits.back()) != std::string_view::npos) {
        suffix.insert(suffix.begin(), digits.back());
        digits.pop_back();
    }
    const auto has = [&](std::string_view letters) { return suffix.find_first_of(letters) != std::string::npos; };
    const bool real = !hexadecimal && (digits.find_first_of(".eE") != std::string::npos || has("fFhH"));
    std::string_view type = "int";
    const bool wide = !real && std::strtod(digits.c_str(), nullptr) > 2147483647.0;
    if (wide || has("lLhH"))
        type = {};
    else if (real)
        type = shading || has("fF") ? "float" : "double";
    else if (has("uU"))
        type = "uint";
    if (real && !digits.empty() && digits.find_first_of("eE") == std::string::npos &&
        digits.find('.') != std::string::npos) {
        while (digits.back() == '0') digits.pop_back();
        if (digits.back() == '.') digits.pop_back();
    }
    return node("number", {node(type.empty() ? std::string(written) : digits)}, type);
}

Value ValueTable::part(Value whole, Value part, std::string_view type) {
    const std::string_view of_whole = this->type(whole);
    const size_t place = component_at(operation(part));
    const std::string known(place < components_of(of_whole) ? component_type(of_whole) : type);
    if (operation(whole) == "with") {
        const Value replaced = parts(whole)[1];
        if (replaced == part) return parts(whole)[2];
        const auto letter = [&](Value value) { return parts(value).empty() && component_at(operation(value)) < 4; };
        const bool apart = (letter(replaced) && letter(part)) || (is_number(replaced) && is_number(part));
        if (apart) return this->part(parts(whole)[0], part, known);
    }
    // A vector that was made of as many values as it has components is made of numbers.
    if (place < 4 && components_of(of_whole) == parts(whole).size() && operation(whole) == of_whole)
        return converted(parts(whole)[place], component_type(of_whole));
    return node("part", {whole, part}, known);
}

Value ValueTable::with_part(Value whole, Value part, Value value) {
    const std::string type(this->type(whole));
    if (components_of(type) > component_at(operation(part))) value = converted(value, component_type(type));
    if (operation(whole) == "with" && parts(whole)[1] == part) whole = parts(whole)[0];
    return node("with", {whole, part, value}, type);
}

}  // namespace porttool
