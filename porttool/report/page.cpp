// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/page.h"

#include <utility>

namespace porttool {

std::string filled_page(std::string_view name, const std::map<std::string_view, std::string_view>& values) {
    std::string_view page = page_file(name);
    std::string out;
    while (!page.empty()) {
        size_t at = page.size();
        const std::pair<const std::string_view, std::string_view>* next = nullptr;
        for (const auto& value : values) {
            const size_t found = page.find(value.first);
            if (found < at) {
                at = found;
                next = &value;
            }
        }
        out += page.substr(0, at);
        if (next == nullptr) break;
        out += next->second;
        page.remove_prefix(at + next->first.size());
    }
    return out;
}

}  // namespace porttool
