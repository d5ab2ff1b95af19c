// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Where host code hands work to a device: one statement here, a block around the kernel there.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "porttool/compare/alignment.h"

namespace porttool {

/// What hands work to a device, with all that belongs to it.
struct Launch {
    size_t first = 0, last = 0;  ///< clauses
    bool waits = false;          ///< it goes on only once the work is done
};

/// The launches of a text in order, those within another one left out:
///
///     k < < < g , b > > > ( a ) ;                                      hipLaunchKernelGGL ( k , g , b , 0 , 0 , a ) ;
///     q . submit ( [ & ] ( handler & h ) { ... } ) ;                   # pragma omp target teams ... for ( ... ) { ...
///     }
std::vector<Launch> launches_in(const AlignedText& text);

/// A launch of one text and what stands for it in another.
struct LaunchPair {
    Launch here, there;
};

/// Each launch of the first text with its like in the second, where both have as many and what stands around each
/// agrees; none where one of the two has more. Launches that are a statement on both sides are left to the alignment.
std::vector<LaunchPair> paired_launches(const AlignedText& first, const AlignedText& second,
                                        const Alignment& alignment);

/// `dim3 ( n )` of a launch is `n`: words without the former.
std::vector<std::string> with_plain_extents(const std::vector<std::string>& words, size_t first, size_t end);

}  // namespace porttool
