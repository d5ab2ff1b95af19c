// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/sink/csv.h"

#include <algorithm>
#include <array>

#include "porttool/text/visible.h"

namespace porttool {
namespace {

bool is_formula(std::string_view text) {
    constexpr std::array<std::string_view, 8> kSigns = {"=", "+", "-", "@", "\uFF1D", "\uFF0B", "\uFF0D", "\uFF20"};
    text.remove_prefix(leading_blanks(text));
    return std::any_of(kSigns.begin(), kSigns.end(), [&](std::string_view sign) { return text.starts_with(sign); });
}

}  // namespace

std::string csv_field(std::string_view text) {
    // Judged as given: a tab before the sign, which a spreadsheet would skip, is visible afterwards.
    std::string safe = visible(text);
    if (is_formula(text)) safe.insert(0, "'");
    const bool command = std::string_view(safe).substr(leading_blanks(safe)).starts_with("::");  // first in a line
    if (!command && safe.find_first_of(",;\"") == std::string::npos) return safe;
    std::string out = "\"";
    for (const char c : safe) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

}  // namespace porttool
