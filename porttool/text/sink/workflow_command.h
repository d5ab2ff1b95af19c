// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// Text in a workflow command of GitHub Actions, `::name key=value::data` ("Workflow commands for GitHub Actions",
/// escapes as actions/toolkit has them). `kWorkflowLineBreak` is a line break of ours in the data; those of values are
/// visible.
inline constexpr const char* kWorkflowLineBreak = "%0A";
std::string workflow_data(std::string_view text);

/// The value of a property. The runner reads line breaks back, as in the path of a file.
std::string workflow_property(std::string_view text);

}  // namespace porttool
