// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace porttool {

/// A value as JSON (RFC 8259); `indent` as for nlohmann's dump. Strings keep their text exactly; a byte that is no
/// UTF-8 becomes U+FFFD. What would act where the document itself is shown, as U+202E or `##[`, is written as \u202e.
std::string json_text(const nlohmann::ordered_json& value, int indent);

}  // namespace porttool
