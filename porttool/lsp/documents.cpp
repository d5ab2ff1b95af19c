// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/documents.h"

#include <algorithm>

namespace porttool::lsp {

void apply_change(std::string& text, const DocumentChange& change) {
    if (!change.range) {
        text = change.text;
        return;
    }
    const TextPlaces places(text);
    const size_t first = places.offset_of(change.range->start), end = places.offset_of(change.range->end);
    text.replace(std::min(first, end), std::max(first, end) - std::min(first, end), change.text);
}

}  // namespace porttool::lsp
