// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "metrics/text/utf8.h"

namespace porttool {

using metrics::as_utf8;
using metrics::is_utf8;
using metrics::utf8_length;

}  // namespace porttool
