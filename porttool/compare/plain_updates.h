// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Steps, updates, limits and counters, each in one manner.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// `i ++` whose value nobody takes, as a statement or as the step of a loop, is `++ i`.
void write_steps_first(std::vector<std::string>& words);

/// `x = x + a * b` is `x += a * b`, where what stands behind the sign is taken together before it. Of `x` that names
/// members and elements alone; not the other way round, since a product of matrices has an order.
void write_plain_update(std::vector<std::string>& words);

/// `clamp ( x , a , b )` is `min ( max ( x , a ) , b )`, and `saturate ( x )` is that of `zero` and `one`.
std::vector<std::string> with_plain_limits(const std::vector<std::string>& words, const std::string& zero,
                                           const std::string& one);

/// Counters of loops whose whole type is a matter of manner: they go up from a number, and nothing is made of them that
/// could have a sign.
///
///     for ( uint i = 0 ; i < n ; ++ i ) { y [ i ] = x [ i + 1 ] ; }          not with    x [ i - 1 ]    or    i * k
class PlainCounters {
public:
    void note(const Words& text);

    /// Gives the counter that a loop's head declares the type `int`.
    void write_plain(std::vector<std::string>& head) const;

private:
    std::set<std::string, std::less<>> counters_, others_;
};

}  // namespace porttool
