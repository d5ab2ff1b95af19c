// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "render_system/loader/gltf_document.h"

namespace render_system {

/// Decodes KHR_draco_mesh_compression, all streams in one run of the importer: each primitive gets accessors of its own
/// on what came out. Primitives that the file holds plain as well are left as they are. Throws LoadError.
void decode_draco_primitives(GltfDocument& document);

}  // namespace render_system
