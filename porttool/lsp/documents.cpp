// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/documents.h"

#include <algorithm>

#include "porttool/read/source_files.h"

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

std::string apply_changes(Document& document, const std::vector<DocumentChange>& changes) {
    constexpr uint64_t kMostWork = 1ull << 30;  // bytes gone through: a second or two
    const auto whole = std::find_if(changes.rbegin(), changes.rend(), [](const auto& one) { return !one.range; });
    if (whole != changes.rend())
        document.is_followed = true;  // nothing that came before it counts
    else if (!document.is_followed)
        return "";
    uint64_t work = 0;
    for (auto one = whole == changes.rend() ? changes.begin() : whole.base() - 1; one != changes.end(); ++one) {
        work += one->range ? document.text.size() : 0;
        if (work <= kMostWork) apply_change(document.text, *one);
        if (work <= kMostWork && document.text.size() <= kLargestSource) continue;
        document.is_followed = false;
        document.text = {};
        return work > kMostWork ? "too many changes of a large text at once; it is judged as it is saved until it is "
                                  "opened again"
                                : "larger than any source that is read; it is judged as it is saved";
    }
    return "";
}

}  // namespace porttool::lsp
