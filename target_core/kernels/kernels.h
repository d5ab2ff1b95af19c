// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: one-sided: the entry points; the source core finds its own by file name.
#pragma once

namespace target_core::kernels {

// Each runs over all jobs of the tile bound to this thread.
void generate();
void extend();
void shade();
void connect();
void finalize();
// And those of a filter.
void guide();
void filter();
void reproject();

}  // namespace target_core::kernels
