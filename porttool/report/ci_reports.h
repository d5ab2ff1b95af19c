// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/judge/judge.h"
#include "porttool/report/sarif_fixes.h"

namespace porttool {

// `folder` is where the root lies in its repository, "sub/folder/" or "": these services look for files from the
// repository's root.

/// SARIF 2.1.0 for code scanning: one rule entry per rule, the changed source as first location, the counterpart as
/// related location, relative URIs under %SRCROOT%, settled findings as suppressions, proposed ports as fixes.
std::string check_sarif(const Judgement& judgement, const std::string& folder = "",
                        const std::vector<ProposedFix>& fixes = {});
/// JUnit XML: one test case a finding, or one that passed.
std::string check_junit(const Judgement& judgement);
/// Workflow commands that GitHub shows as annotations.
std::string check_github(const Judgement& judgement, const std::string& folder = "");
/// GitLab's code quality report.
std::string check_gitlab(const Judgement& judgement, const std::string& folder = "");
/// A comment for a merge request.
std::string check_markdown(const Judgement& judgement);

}  // namespace porttool
