// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_accessors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "render_system/loader/load_error.h"
#include "render_system/texel.h"

namespace render_system {

namespace {

using Bytes = std::span<const std::byte>;

// An accessor without a buffer view costs nothing in the file, so its size has to have an end of its own.
constexpr uint64_t MOST_ZEROS = uint64_t{1} << 24;

size_t component_size(int type) {
    switch (type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return 1;
        case TINYGLTF_COMPONENT_TYPE_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return 2;
        default:
            return 4;
    }
}

// The bytes of `count` elements, one every `stride` bytes.
struct Elements {
    const std::byte* data = nullptr;
    uint64_t count = 0;
    size_t stride = 0;

    const std::byte* operator[](uint64_t i) const { return data + i * stride; }
};

Elements elements_in(Bytes view, uint64_t offset, uint64_t count, size_t element_size, size_t stride,
                     const std::string& place) {
    if (stride == 0) stride = element_size;
    if (stride < element_size) {
        fail_at(place, "its elements of " + std::to_string(element_size) + " bytes overlap at a byteStride of " +
                           std::to_string(stride) + EXPORT_AGAIN);
    }
    // The last element need not fill its stride.
    const uint64_t room = offset <= view.size() ? view.size() - offset : 0;
    const uint64_t fitting = room < element_size ? 0 : 1 + (room - element_size) / stride;
    if (count > fitting) {
        fail_at(place, "has " + std::to_string(count) + " elements, but its buffer view has room for " +
                           std::to_string(fitting) + EXPORT_AGAIN);
    }
    return {view.data() + offset, count, stride};
}

// An accessor with its bounds checked. Element i comes from `base`, unless `sparse_index` holds i.
struct Accessor {
    std::string place;
    int component = 0;
    size_t components = 0;
    bool normalized = false;
    uint64_t count = 0;
    Elements base;          // data == nullptr: zeros
    Elements sparse_index;  // ascending
    Elements sparse_values;
    int sparse_component = 0;
};

uint32_t read_unsigned(const std::byte* bytes, int component) {
    uint32_t value = 0;
    std::memcpy(&value, bytes, component_size(component));  // little-endian, as are all machines this runs on
    return value;
}

void open_sparse(const GltfDocument& document, const tinygltf::Accessor& source, size_t element_size,
                 Accessor& accessor) {
    const auto& sparse = source.sparse;
    const uint64_t count = static_cast<uint64_t>(sparse.count);
    accessor.sparse_component = sparse.indices.componentType;
    accessor.sparse_index =
        elements_in(document.view_bytes(sparse.indices.bufferView), static_cast<uint64_t>(sparse.indices.byteOffset),
                    count, component_size(sparse.indices.componentType), 0, accessor.place + "/sparse/indices");
    accessor.sparse_values =
        elements_in(document.view_bytes(sparse.values.bufferView), static_cast<uint64_t>(sparse.values.byteOffset),
                    count, element_size, 0, accessor.place + "/sparse/values");
    for (uint64_t i = 0; i < count; ++i) {
        const uint32_t index = read_unsigned(accessor.sparse_index[i], accessor.sparse_component);
        if (index < accessor.count) continue;
        fail_at(accessor.place + "/sparse/indices",
                "names element " + std::to_string(index) + " of " + std::to_string(accessor.count) + EXPORT_AGAIN);
    }
}

Accessor open_accessor(const GltfDocument& document, int index) {
    const tinygltf::Accessor& source = document.model.accessors[static_cast<size_t>(index)];
    Accessor accessor;
    accessor.place = accessor_place(index);
    accessor.component = source.componentType;
    accessor.components = static_cast<size_t>(tinygltf::GetNumComponentsInType(static_cast<uint32_t>(source.type)));
    accessor.normalized = source.normalized;
    accessor.count = source.count;
    const size_t element_size = accessor.components * component_size(source.componentType);
    if (source.bufferView >= 0) {
        const size_t stride = document.model.bufferViews[static_cast<size_t>(source.bufferView)].byteStride;
        accessor.base = elements_in(document.view_bytes(source.bufferView), source.byteOffset, source.count,
                                    element_size, stride, accessor.place);
    } else if (source.count > MOST_ZEROS) {
        fail_at(accessor.place, "has " + std::to_string(source.count) + " elements, but no buffer view" + EXPORT_AGAIN);
    }
    if (source.sparse.isSparse) open_sparse(document, source, element_size, accessor);
    return accessor;
}

// glTF 2.0, 3.6.2.2: how normalised integers map to floats.
template <class T>
float to_float(T value, bool normalized) {
    if constexpr (!std::is_floating_point_v<T>) {
        if (normalized) {
            const float scaled = static_cast<float>(value) / static_cast<float>(std::numeric_limits<T>::max());
            return std::max(scaled, -1.0f);
        }
    }
    return static_cast<float>(value);
}

// An element of any number of components.
template <int Length>
struct Components {
    float values[Length];

    static constexpr int length() { return Length; }
    float& operator[](int i) { return values[i]; }
    float operator[](int i) const { return values[i]; }
};

// How glTF calls an element of that many.
struct ElementType {
    int type;
    const char* name;
};

ElementType element_type(int components) {
    switch (components) {
        case 1:
            return {TINYGLTF_TYPE_SCALAR, "SCALAR"};
        case 2:
            return {TINYGLTF_TYPE_VEC2, "VEC2"};
        case 3:
            return {TINYGLTF_TYPE_VEC3, "VEC3"};
        case 4:
            return {TINYGLTF_TYPE_VEC4, "VEC4"};
        default:
            return {TINYGLTF_TYPE_MAT4, "MAT4"};
    }
}

template <class T, class Vec>
void convert(const Elements& from, bool normalized, Vec* out) {
    for (uint64_t i = 0; i < from.count; ++i) {
        T element[Vec::length()];
        std::memcpy(element, from[i], sizeof(element));
        for (int c = 0; c < Vec::length(); ++c) out[i][c] = to_float(element[c], normalized);
    }
}

template <class Vec>
void convert(const Elements& from, int component, bool normalized, Vec* out) {
    switch (component) {
        case TINYGLTF_COMPONENT_TYPE_BYTE:
            return convert<int8_t>(from, normalized, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
            return convert<uint8_t>(from, normalized, out);
        case TINYGLTF_COMPONENT_TYPE_SHORT:
            return convert<int16_t>(from, normalized, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return convert<uint16_t>(from, normalized, out);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
            return convert<uint32_t>(from, normalized, out);
        default:
            return convert<float>(from, normalized, out);
    }
}

template <class Vec>
void check_finite(const Accessor& accessor, const Vec* values) {
    for (uint64_t i = 0; i < accessor.count; ++i) {
        for (int c = 0; c < Vec::length(); ++c) {
            if (std::isfinite(values[i][c])) continue;
            fail_at(accessor.place, "element " + std::to_string(i) + " is not finite (NaN or infinite)" + EXPORT_AGAIN);
        }
    }
}

template <class Vec>
void append(const GltfDocument& document, int index, bool must_be_finite, std::vector<Vec>& out) {
    const Accessor accessor = open_accessor(document, index);
    const ElementType wanted = element_type(Vec::length());
    if (document.model.accessors[static_cast<size_t>(index)].type != wanted.type)
        fail_at(accessor.place, std::string("is not of type ") + wanted.name + EXPORT_AGAIN);
    const size_t first = out.size();
    out.resize(first + accessor.count, Vec{});
    Vec* values = out.data() + first;
    if (accessor.base.data) convert(accessor.base, accessor.component, accessor.normalized, values);
    if (accessor.sparse_index.count > 0) {
        std::vector<Vec> replaced(accessor.sparse_index.count);
        convert(accessor.sparse_values, accessor.component, accessor.normalized, replaced.data());
        for (uint64_t i = 0; i < replaced.size(); ++i) {
            values[read_unsigned(accessor.sparse_index[i], accessor.sparse_component)] = replaced[i];
        }
    }
    if (must_be_finite) check_finite(accessor, values);
}

template <int Length>
std::vector<float> read_elements(const GltfDocument& document, int accessor) {
    std::vector<Components<Length>> elements;
    append(document, accessor, true, elements);
    std::vector<float> floats;
    floats.reserve(elements.size() * Length);
    for (const auto& element : elements) floats.insert(floats.end(), element.values, element.values + Length);
    return floats;
}

}  // namespace

std::string accessor_place(int accessor) { return "/accessors/" + std::to_string(accessor); }

uint64_t accessor_count(const GltfDocument& document, int accessor) { return open_accessor(document, accessor).count; }

void append_vectors(const GltfDocument& document, int accessor, bool must_be_finite, std::vector<glm::vec2>& out) {
    append(document, accessor, must_be_finite, out);
}

void append_vectors(const GltfDocument& document, int accessor, bool must_be_finite, std::vector<glm::vec3>& out) {
    append(document, accessor, must_be_finite, out);
}

void append_vectors(const GltfDocument& document, int accessor, bool must_be_finite, std::vector<glm::vec4>& out) {
    append(document, accessor, must_be_finite, out);
}

std::vector<float> read_floats(const GltfDocument& document, int accessor, int components) {
    switch (components) {
        case 1:
            return read_elements<1>(document, accessor);
        case 2:
            return read_elements<2>(document, accessor);
        case 3:
            return read_elements<3>(document, accessor);
        case 4:
            return read_elements<4>(document, accessor);
        default:
            return read_elements<16>(document, accessor);
    }
}

void append_colors(const GltfDocument& document, int accessor, std::vector<glm::vec4>& out) {
    const size_t first = out.size();
    if (document.model.accessors[static_cast<size_t>(accessor)].type == TINYGLTF_TYPE_VEC3) {
        std::vector<glm::vec3> colors;
        append(document, accessor, true, colors);
        for (const glm::vec3& color : colors) out.push_back(glm::vec4(color, 1.0f));
    } else {
        append(document, accessor, true, out);
    }
    for (size_t i = first; i < out.size(); ++i) out[i] = glm::clamp(out[i], 0.0f, 1.0f);
}

std::vector<uint32_t> read_indices(const GltfDocument& document, int index) {
    const Accessor accessor = open_accessor(document, index);
    const bool is_unsigned = accessor.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                             accessor.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                             accessor.component == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
    if (accessor.components != 1 || !is_unsigned || accessor.normalized) {
        fail_at(accessor.place,
                "holds indices, so it must be of type SCALAR and of an unsigned component type" + EXPORT_AGAIN);
    }
    std::vector<uint32_t> indices(accessor.count, 0);
    if (accessor.base.data) {
        for (uint64_t i = 0; i < accessor.count; ++i) {
            indices[i] = read_unsigned(accessor.base[i], accessor.component);
        }
    }
    for (uint64_t i = 0; i < accessor.sparse_index.count; ++i) {
        indices[read_unsigned(accessor.sparse_index[i], accessor.sparse_component)] =
            read_unsigned(accessor.sparse_values[i], accessor.component);
    }
    return indices;
}

}  // namespace render_system
