// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace porttool {

/// A file of porttool/report/page, embedded by the build; `script.js` is all scripts in their order.
std::string_view page_file(std::string_view name);

/// A page that is complete in itself: a file with each @NAME@ replaced once, in one pass. What is put in is never
/// looked at again.
std::string filled_page(std::string_view name, const std::map<std::string_view, std::string_view>& values);

}  // namespace porttool
