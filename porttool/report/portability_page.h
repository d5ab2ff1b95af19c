// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

#include "porttool/report/portability_json.h"

namespace porttool {

/// The texts of both sides' files, by path.
using SideTexts = BySide<std::map<std::string, std::string>>;

/// The report as one HTML file that loads nothing: the parts in porttool/report/page, with the JSON report, the texts
/// and their alignment as data in it.
std::string portability_html(const WholeReport& whole, const SideTexts& texts);

/// A text with line feeds alone, without byte order mark, in UTF-8: a byte that is none becomes U+FFFD.
std::string page_text(std::string_view bytes);

}  // namespace porttool
