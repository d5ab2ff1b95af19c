// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/sync/propose.h"

namespace porttool {

std::string sync_json(const SyncResult& result);
/// The patches alone, in the order in which they apply.
std::string sync_patch(const SyncResult& result);
/// Each pair with what is proposed and what is left for a person.
std::string sync_table(const SyncResult& result);

}  // namespace porttool
