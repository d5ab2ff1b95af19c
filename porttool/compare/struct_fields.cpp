// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/struct_fields.h"

#include <algorithm>

namespace porttool {

Words single_fields(const Words& tokens) {
    Words out;
    auto at = std::find(tokens.begin(), tokens.end(), "{");
    out.assign(tokens.begin(), at == tokens.end() ? at : at + 1);
    Words field;
    const auto flush = [&] {
        size_t name = field.size(), depth = 0;
        std::vector<size_t> commas;
        for (size_t i = 0; i < field.size(); ++i) {
            if (field[i] == "(" || field[i] == "[" || field[i] == "<") ++depth;
            if ((field[i] == ")" || field[i] == "]" || field[i] == ">") && depth > 0) --depth;
            if (depth == 0 && field[i] == ",") commas.push_back(i);
        }
        const size_t first_end = commas.empty() ? field.size() : commas[0];
        for (size_t i = 0; i < first_end && name == field.size(); ++i)
            if (i + 1 == first_end || field[i + 1] == "[" || field[i + 1] == "=" || field[i + 1] == ":") name = i;
        commas.push_back(field.size());
        out.insert(out.end(), field.begin(), field.begin() + static_cast<std::ptrdiff_t>(first_end));
        for (size_t c = 0; c + 1 < commas.size(); ++c) {
            out.emplace_back(";");
            out.insert(out.end(), field.begin(), field.begin() + static_cast<std::ptrdiff_t>(name));
            out.insert(out.end(), field.begin() + static_cast<std::ptrdiff_t>(commas[c]) + 1,
                       field.begin() + static_cast<std::ptrdiff_t>(commas[c + 1]));
        }
        field.clear();
    };
    for (at = at == tokens.end() ? at : at + 1; at != tokens.end(); ++at) {
        if (*at == ";" || *at == "{" || *at == "}") {
            flush();
            out.push_back(*at);
            continue;
        }
        if (*at == "int" && !field.empty() && (field.back() == "unsigned" || field.back() == "signed")) {
            field.back() = field.back() == "unsigned" ? "uint" : "int";
            continue;
        }
        field.push_back(*at);
    }
    flush();
    return out;
}

}  // namespace porttool
