// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/sync/rewrite.h"

namespace porttool {

/// Makes edits of a scanned text, which has neither carriage returns nor spliced lines, in the file as it stands on the
/// disk. New lines end as its first line does. None if a word that goes on after a spliced line would be replaced.
std::optional<std::string> edit_file(std::string_view bytes, std::string_view scanned,
                                     const std::vector<TextEdit>& edits);

}  // namespace porttool
