// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "application/command_line.h"
#include "application/sampling/run_identity.h"

namespace application {

/// What all members of a team must have been told alike, before the first of them begins: of it hangs which of them
/// waits for which. How many threads each has, and where the scene lies, are its own affair.
RunIdentity team_plan(const Invocation& invocation);

}  // namespace application
