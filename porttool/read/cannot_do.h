// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>

namespace porttool {

/// What cannot be done, with its remedy: one or two lines, exit code 2.
struct CannotDo : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace porttool
