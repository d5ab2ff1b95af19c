// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/scan/head.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// Adds the variables that the statement at the positions [first, end) declares outside of functions and classes:
/// `static volatile int ready = 0`, `shared float tile[64]`, `layout(local_size_x = 64) in`. No types, no functions,
/// and what may be a macro's call is no variable. Of functions what is said apart from their definitions: defaults of
/// arguments, attributes that may change what they do, explicit instantiations.
void read_variables(const HeadContext& context, uint32_t first, uint32_t end, std::vector<FileVariable>& out);

/// Of what a class declares only the defaults of arguments and attributes of functions.
void read_member_defaults(const HeadContext& context, uint32_t first, uint32_t end, std::vector<FileVariable>& out);

/// Where a block of variables begins, opens and closes: `layout(std430) coherent buffer Rays { Ray rays[]; } in_rays;`
struct BlockPlace {
    uint32_t first, open, close;
};

/// Adds its instance, or its members where it has none.
void read_block_variables(const HeadContext& context, BlockPlace place, std::vector<FileVariable>& out);

}  // namespace porttool
