// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/sink/json_rows.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "porttool/text/row_room.h"
#include "porttool/text/sink/json.h"

namespace porttool {

std::string json_with_rows(const nlohmann::ordered_json& document, size_t count,
                           const std::function<nlohmann::ordered_json(size_t)>& row) {
    std::string out = json_text(document, 1);
    const size_t list = out.rfind("[]"), line = out.rfind('\n', list) + 1;
    const size_t depth = std::min(out.find_first_not_of(' ', line), list) - line;
    const std::string after = out.substr(list + 1);
    const std::string inner = "\n" + std::string(depth + 1, ' ');
    out.resize(list + 1);
    size_t added = 0;
    for (size_t i = 0; i < count; ++i) {
        const nlohmann::ordered_json value = row(i);
        if (value.is_null()) continue;
        out += (added > 0 ? "," : "") + inner;
        for (const char c : json_text(value, 1)) {
            out += c;
            if (c == '\n') out.append(depth + 1, ' ');
        }
        make_room_for_rows(out, ++added, count);
    }
    if (added > 0) out += "\n" + std::string(depth, ' ');
    out += after;
    return out;
}

}  // namespace porttool
