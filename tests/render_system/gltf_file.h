// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "render_system/scene_loader.h"

// Writes small glTF files for the loader's tests.

namespace render_system::testing {

/// A folder of its own for each object, gone with it.
class TempFolder {
public:
    TempFolder();
    ~TempFolder();
    TempFolder(const TempFolder&) = delete;
    TempFolder& operator=(const TempFolder&) = delete;

    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

void write_file(const std::filesystem::path& path, const std::string& content);
std::string read_file(const std::filesystem::path& path);
std::string base64(const std::string& bytes);

// Component types and types of accessors, as glTF numbers them.
constexpr int BYTE = 5120, UBYTE = 5121, SHORT = 5122, USHORT = 5123, UINT = 5125, FLOAT = 5126;

/// A glTF document under construction, with one binary buffer. `root` can be edited freely.
class GltfFile {
public:
    nlohmann::json root;
    std::string buffer;

    GltfFile();

    /// Appends bytes as a buffer view, 4-aligned.
    int add_view(const std::string& bytes, int stride = 0);

    template <class T>
    int add_view(const std::vector<T>& values, int stride = 0) {
        return add_view(std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)), stride);
    }

    int add_accessor(int view, int component, const std::string& type, size_t count, bool normalized = false);

    int add(const std::vector<glm::vec2>& v) { return add_accessor(add_view(v), FLOAT, "VEC2", v.size()); }
    int add(const std::vector<glm::vec3>& v) { return add_accessor(add_view(v), FLOAT, "VEC3", v.size()); }
    int add(const std::vector<glm::vec4>& v) { return add_accessor(add_view(v), FLOAT, "VEC4", v.size()); }
    int add(const std::vector<uint16_t>& v) { return add_accessor(add_view(v), USHORT, "SCALAR", v.size()); }

    /// A mesh of one primitive; answers its number.
    int add_mesh(const nlohmann::json& primitive);
    /// A root node of scene 0; answers its number.
    int add_node(const nlohmann::json& node);
    int add_material(const nlohmann::json& material);
    /// An image from a file name or data URI with a texture of its own; answers the texture.
    int add_texture(const std::string& uri);

    std::string text_embedded() const;  ///< .gltf with the buffer as a data URI
    std::string text_external(const std::string& uri) const;
    std::string glb() const;

    /// Writes the embedded form into `folder` and loads it.
    Result<LoadedScene> load(const TempFolder& folder) const;
};

/// One triangle (0,0,0) (1,0,0) (0,1,0) with normals +z, one node. Mesh 0, node 0.
GltfFile one_triangle();
/// The same with so many sets of texture coordinates.
GltfFile textured_triangle(int sets = 1);

/// An 8-bit PNG: grey (1 channel), grey and alpha (2), RGB (3) or RGBA (4).
std::string png(int width, int height, int channels, const std::vector<uint8_t>& pixels);

std::string png_uri(int width, int height, int channels, const std::vector<uint8_t>& pixels);

/// The scene of a file that must load; without warnings unless `warnings` is given.
HostScene loaded(const GltfFile& file, std::vector<std::string>* warnings = nullptr);

/// The message of a file that must not load.
std::string refusal(const GltfFile& file);

}  // namespace render_system::testing
