// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/scan/side.h"

namespace porttool {

/// What a number of an input or output is.
enum class NumberKind : uint8_t { Float, Double, Half, Bool, Signed, Unsigned };

/// One number that goes into a function, or comes out of it.
struct Leaf {
    int parameter = -1;  ///< -1: what the function returns
    NumberKind kind = NumberKind::Float;
    int bytes = 4;
    std::string path;  ///< "bsdf.f0.x", "" for a number that is returned
    bool is_real() const { return kind <= NumberKind::Half; }
};

/// What a function takes and gives, as its program lists it.
struct Leaves {
    std::vector<Leaf> in, out;
    std::string guess;   ///< a pointer in a struct behind which an array of a guessed length stands; "" for none
    std::string reason;  ///< why it cannot be run; "" if it can
};

/// Reads what `PROGRAM list` printed, by the number of the function.
std::map<int, Leaves> read_leaves(std::string_view text);

/// Which number of the target each number of the source is, or why they do not fit each other.
struct LeafMatch {
    std::vector<BySide<size_t>> in, out;  ///< places among the leaves; what stands in none is 0, and not compared
    std::string zeroed;                   ///< a mark that one side alone keeps, which is 0; "" for none
    BySide<std::vector<size_t>> marks;    ///< the places of such marks among what each side takes
    std::string lone;                     ///< a parameter that one side alone has, which is 0; "" for none
    std::string ordered;                  ///< of the numbers that were paired by their order one; "" for none
    std::string reason;
};
LeafMatch match_leaves(const Leaves& source, const Leaves& target);

/// What a side's texts say of what it takes.
struct TextOfSide {
    std::set<std::string, std::less<>> words;  ///< fields that none of them names are neither read nor written
    std::set<int> unwritten;                   ///< parameters that nothing writes to, though it could
};

/// The same where the two hold more than they look at: what one side alone has and never names fits nothing, and need
/// not. Numbers go by their names then.
LeafMatch match_used_leaves(const Leaves& source, const Leaves& target, const BySide<TextOfSide>& texts);

}  // namespace porttool
