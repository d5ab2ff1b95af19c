// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "porttool/sync/propose.h"
#include "porttool/sync/verify.h"

namespace porttool {

std::string sync_json(const SyncResult& result, const std::optional<Verification>& verification);
/// True if JSON can hold all patches; one with bytes that are no UTF-8 is left out there, and left for a person.
bool fits_json(const SyncResult& result);
/// The patches alone, in the order in which they apply.
std::string sync_patch(const SyncResult& result);
/// Each pair with what is proposed and what is left for a person, and how the verification ended, if there was one.
std::string sync_table(const SyncResult& result, const std::optional<Verification>& verification);

}  // namespace porttool
