// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace porttool {

/// json_text(document, 1), with rows in the list that is the last of its values, however deep, and empty in `document`.
/// They are asked for one by one: as one document, a hundred thousand of them take a GiB. A row that is null is left
/// out.
std::string json_with_rows(const nlohmann::ordered_json& document, size_t count,
                           const std::function<nlohmann::ordered_json(size_t)>& row);

}  // namespace porttool
