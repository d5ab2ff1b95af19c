// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "metrics/text/visible.h"

namespace porttool {

using metrics::leading_blanks;
using metrics::visible;
using metrics::without_invisible;
using metrics::without_log_commands;

}  // namespace porttool
