// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "render_system/loader/gltf_document.h"

namespace render_system {

/// JSON pointer of an accessor, for messages.
std::string accessor_place(int accessor);

/// Elements in an accessor. Throws LoadError if they do not lie in their buffer view: the number can be trusted.
uint64_t accessor_count(const GltfDocument& document, int accessor);

/// Appends an accessor's elements to `out` as floats: any component type, normalised or not, any stride, sparse or
/// not; without a buffer view zeros. Throws LoadError if the accessor is of another type (VEC2 for glm::vec2 and so
/// on), reaches past its buffer view, or if `must_be_finite` and an element is not.
void append_vectors(const GltfDocument& document, int accessor, bool must_be_finite, std::vector<glm::vec2>& out);
void append_vectors(const GltfDocument& document, int accessor, bool must_be_finite, std::vector<glm::vec3>& out);
void append_vectors(const GltfDocument& document, int accessor, bool must_be_finite, std::vector<glm::vec4>& out);

/// All of an accessor's numbers one after another, where it has `components` an element: 1 (SCALAR), 2 (VEC2),
/// 3 (VEC3), 4 (VEC4) or 16 (MAT4, by columns). Fails as append_vectors does; all must be finite.
std::vector<float> read_floats(const GltfDocument& document, int accessor, int components);

/// Appends colours (VEC3 or VEC4) as linear RGBA; VEC3 has alpha 1. Values outside 0 to 1 are clamped.
void append_colors(const GltfDocument& document, int accessor, std::vector<glm::vec4>& out);

/// The elements of an accessor of indices: SCALAR, unsigned, not normalised.
std::vector<uint32_t> read_indices(const GltfDocument& document, int accessor);

}  // namespace render_system
