// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/judge/judgement.h"
#include "porttool/read/disk.h"

namespace porttool {

/// The findings as a page that is complete in itself, with the pictures of the evidence: PNG files that lie beneath
/// the folder of its file. Of others it says why they are not shown.
std::string check_html(const Judgement& judgement, const Disk& disk);

}  // namespace porttool
