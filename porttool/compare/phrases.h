// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What ports say in several words that stand for one thing.
#pragma once

#include <string>
#include <vector>

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// Writes phrases of common words in one way:
///
///     local_id ( 0 )                                       local_id . x
///     group_id . x * group_size . x + local_id . x         global_id . x
///     vec4 ( a , a , a , a )                               vec4 ( a )
///     vec2 ( v . x , v . y )                               v . xy
std::vector<std::string> with_common_phrases(const std::vector<std::string>& words);

/// The number of a thread among all in one spelling, whatever the language calls its parts. The rest stays as it is.
std::vector<std::string> with_plain_global_ids(const std::vector<std::string>& words, const Dialect& dialect);

/// `( ray . t ) * 2` is `ray . t * 2`: parentheses around one value that is picked, or a name or number by itself,
/// where they cannot be a cast or a call. So is `( a * b ) + c` of `a * b + c`, which is taken together anyway.
std::vector<std::string> without_idle_parentheses(const std::vector<std::string>& words);

/// `( float4 ) { a , b }` and `( float4 ) ( a , b )`, values of several parts, are `float4 ( a , b )`.
std::vector<std::string> with_constructed_literals(const std::vector<std::string>& words);

/// Writes HIP's and CUDA's two ways to launch a kernel in one: `k < < < g , b > > > ( a )` and
/// `hipLaunchKernelGGL ( k , g , b , 0 , 0 , a )`.
std::vector<std::string> with_plain_launches(const std::vector<std::string>& words);

/// `HIP_CHECK ( hipFree ( p ) )` is `hipFree ( p )`: what only looks at the status that a call of a runtime gives back,
/// as its name says, changes no value. Only where it is the whole statement.
void drop_status_check(std::vector<std::string>& words);

/// `item . barrier ( sycl :: access :: fence_space :: local_space )` is `barrier ( )`: a barrier among the threads of a
/// group, whatever object it is called of. One that names other memory than the group's stays as it is. Only where it
/// is the whole statement.
void write_plain_barrier(std::vector<std::string>& words);

/// `int i = int ( x )`: the value is converted to the variable's type in any case, so the cast goes.
void drop_cast_to_declared_type(std::vector<std::string>& words);

}  // namespace porttool
