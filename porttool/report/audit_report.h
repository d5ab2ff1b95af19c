// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/audit/audit.h"

namespace porttool {

std::string audit_text(const Audit& audit);
std::string audit_json(const Audit& audit);
/// To paste into an issue.
std::string audit_markdown(const Audit& audit);
/// One self-contained page to read.
std::string audit_html(const Audit& audit);

}  // namespace porttool
