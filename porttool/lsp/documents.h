// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/lsp/positions.h"

namespace porttool::lsp {

/// A file that an editor has open, as it stands there.
struct Document {
    std::string uri;  ///< as the editor writes it
    int64_t version = 0;
    std::string text;
    bool is_followed = true;  ///< else what stands there is not known until it comes as a whole again; `text` is empty
};

/// The open files by absolute path.
using Documents = std::map<std::string, Document>;

/// One change of a document; without a range it is the whole text.
struct DocumentChange {
    std::optional<Range> range;
    std::string text;
};

void apply_change(std::string& text, const DocumentChange& change);

/// Applies what one message changes. What grows beyond the largest source that is read, or would take long, is no
/// longer followed: each change goes through the whole text. "" or what to tell the user then.
std::string apply_changes(Document& document, const std::vector<DocumentChange>& changes);

}  // namespace porttool::lsp
