// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "render_system/loader/gltf_document.h"

namespace render_system {

/// Which of its two names the extension has in a buffer view that meshoptimizer packed; null where the view is plain.
const char* meshopt_name(const nlohmann::json& view);

/// What the extension says there of how the view is packed; null where it is plain.
const nlohmann::json* meshopt_part(const nlohmann::json& view);

/// Whether the buffer is read by packed views alone, as what they stand for: then it need not exist.
std::vector<bool> meshopt_fallback_buffers(const nlohmann::json& document);

/// Decodes all packed buffer views into `document.decoded_views`. Throws LoadError, with the view's place, where a
/// stream is damaged or promises more than it can hold. The buffers are open; `root` has passed check_gltf_schema.
void decode_meshopt_views(const nlohmann::json& root, GltfDocument& document);

}  // namespace render_system
