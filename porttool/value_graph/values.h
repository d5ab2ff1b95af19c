// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace porttool {

/// A value that a program computes: the number of a node in a ValueTable. Equal numbers are equal values.
using Value = uint32_t;

/// What was not read or became too much: no answer is given then.
struct Unread {};

/// The values of some programs as one graph without copies: an operation on given values is one node, whatever program
/// asks for it (hash-consing, after Tristan, Govereau and Morrisett, "Evaluating value-graph translation validation for
/// LLVM", PLDI 2011). Only rewritings that keep every bit are made: no sum is regrouped.
///
///     a * b + c, b * a + c          one node, for numbers
///     c ? x : y, ! c ? y : x        one node
///     { x , y } . y                 y
class ValueTable {
public:
    ValueTable() = default;
    /// `only_numbers`: nothing is known of what is called a vector, which may be a class of that name, and no product
    /// changes its place in a sum of two, since a compiler may join either with the sum.
    explicit ValueTable(bool only_numbers) : only_numbers_(only_numbers) {}

    /// A node with no type, or the type that is given: "float", "vec3", "" for one that is not known.
    Value node(std::string_view operation, std::vector<Value> parts = {}, std::string_view type = {});

    std::string_view operation(Value value) const { return names_[nodes_[value].operation]; }
    std::string_view type(Value value) const { return names_[nodes_[value].type]; }
    const std::vector<Value>& parts(Value value) const { return nodes_[value].parts; }

    /// `condition ? yes : no`.
    Value choice(Value condition, Value yes, Value no);
    /// The value as a `type`; itself where it is one.
    Value converted(Value value, std::string_view type);
    /// `left operation right`, as numbers are added and compared: of two types both become the wider one.
    Value binary(std::string_view operation, Value left, Value right);
    /// A number as it is written. `shading`: reals without a suffix are floats.
    Value number(std::string_view written, bool shading);

    /// A part of an aggregate: a member by its name (`part` is a node of that name), an element by its index.
    Value part(Value whole, Value part, std::string_view type = {});
    /// The aggregate with one part replaced.
    Value with_part(Value whole, Value part, Value value);

private:
    struct Node {
        uint32_t operation, type;
        std::vector<Value> parts;
        bool operator<(const Node& other) const {
            return std::tie(operation, type, parts) < std::tie(other.operation, other.type, other.parts);
        }
    };

    uint32_t name(std::string_view text);
    bool is_known(std::string_view type) const;
    bool may_swap(std::string_view operation, Value left, Value right) const;
    bool is_number(Value value) const { return operation(value) == "number"; }

    bool only_numbers_ = false;
    std::map<std::string, uint32_t, std::less<>> numbers_of_names_;
    std::deque<std::string> names_;  // deques: what is asked of one value lives on while others are made
    std::deque<Node> nodes_;
    std::map<Node, Value> known_;
};

/// True for the types of numbers and of vectors of them that a value is known to have: "int", "vec3".
bool is_plain_type(std::string_view type);

/// True for types of one number each.
bool is_scalar_type(std::string_view type);

/// True for "float*".
inline bool is_pointer(std::string_view type) { return type.ends_with('*'); }

/// What a pointer points at; "" for what is none.
inline std::string pointed_at(std::string_view type) {
    return std::string(type.substr(0, is_pointer(type) ? type.size() - 1 : 0));
}

}  // namespace porttool
