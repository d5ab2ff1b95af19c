// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/history/history.h"
#include "porttool/read/blob_cache.h"
#include "porttool/snapshot/past.h"

namespace porttool {

/// Walks the first parents of HEAD from the oldest to the newest and tells, for each commit that touched a side, the
/// map or the lock, how alike the blocks were and how much drift was open. Each commit is read with its own
/// portmap.toml, or today's where it has none. `since`: only what came after this commit is kept, but all of it is
/// counted; may be empty. Throws CannotDo.
History history_of(const Past& past, const std::string& since, BlobCache& cache, Workplace& place);

}  // namespace porttool
