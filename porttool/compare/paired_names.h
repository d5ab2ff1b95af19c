// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/language/dialect.h"
#include "porttool/read/map_file.h"

namespace porttool {

/// The dialect in which edits of a project are compared: its own words, and the names that its pairs give to one thing.
/// A call of `set_rows_cuda` here is one of `set_rows_sycl` there, where these two are a pair, no other pair has either
/// name, and the built-in table knows neither.
Dialect dialect_of_edits(const MapFile& map);

}  // namespace porttool
