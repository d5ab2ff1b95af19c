// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/history/history.h"

namespace porttool {

std::string history_table(const History& history);
std::string history_json(const History& history);
/// One line a commit and block; the line of all blocks together, with the debt, has the name `*`.
std::string history_csv(const History& history);
/// One self-contained page with charts.
std::string history_html(const History& history);

}  // namespace porttool
