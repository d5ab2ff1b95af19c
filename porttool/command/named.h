// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/judge/settle.h"

namespace porttool {

/// What an id on the command line stands for. Throws CannotDo with "did you mean" where that is nothing.
Named require_named(const Judgement& judgement, const std::string& id);

}  // namespace porttool
