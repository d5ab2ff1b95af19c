// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

namespace render_system {

/// Holds a glTF document against the types, ranges and references of glTF 2.0, as far as this loader reads it. After
/// this every index names an element that exists, so no later stage has to look. Whole numbers written as 3.0 are made
/// integers. Throws LoadError with the JSON pointer of the first thing that is wrong.
void check_gltf_schema(nlohmann::json& document);

}  // namespace render_system
