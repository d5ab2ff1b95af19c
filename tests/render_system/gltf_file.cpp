// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/render_system/gltf_file.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <zlib.h>

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace render_system::testing {

using nlohmann::json;

TempFolder::TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "render_system_XXXXXX").string();
    if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
    path_ = pattern;
}

TempFolder::~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

void write_file(const std::filesystem::path& path, const std::string& content) {
    std::ofstream file(path, std::ios::binary);
    file.write(content.data(), static_cast<std::streamsize>(content.size()));
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

std::string read_file(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    return text.str();
}

std::string base64(const std::string& bytes) {
    static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t j = 0; j < 3; ++j) {
            bits = bits << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
        }
        for (size_t j = 0; j < 4; ++j) text += i + j <= bytes.size() ? digits[bits >> (18 - 6 * j) & 63] : '=';
    }
    return text;
}

GltfFile::GltfFile() {
    root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", json::array()}}}}};
}

int GltfFile::add_view(const std::string& bytes, int stride) {
    while (buffer.size() % 4 != 0) buffer.push_back('\0');
    json view = {{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}};
    if (stride > 0) view["byteStride"] = stride;
    buffer += bytes;
    root["bufferViews"].push_back(view);
    return static_cast<int>(root["bufferViews"].size()) - 1;
}

int GltfFile::add_accessor(int view, int component, const std::string& type, size_t count, bool normalized) {
    json accessor = {{"componentType", component}, {"type", type}, {"count", count}};
    if (view >= 0) accessor["bufferView"] = view;
    if (normalized) accessor["normalized"] = true;
    root["accessors"].push_back(accessor);
    return static_cast<int>(root["accessors"].size()) - 1;
}

int GltfFile::add_mesh(const json& primitive) {
    root["meshes"].push_back({{"primitives", json::array({primitive})}});
    return static_cast<int>(root["meshes"].size()) - 1;
}

int GltfFile::add_node(const json& node) {
    root["nodes"].push_back(node);
    const int id = static_cast<int>(root["nodes"].size()) - 1;
    root["scenes"][0]["nodes"].push_back(id);
    return id;
}

int GltfFile::add_material(const json& material) {
    root["materials"].push_back(material);
    return static_cast<int>(root["materials"].size()) - 1;
}

int GltfFile::add_texture(const std::string& uri) {
    root["images"].push_back({{"uri", uri}});
    root["textures"].push_back({{"source", root["images"].size() - 1}});
    return static_cast<int>(root["textures"].size()) - 1;
}

std::string GltfFile::text_embedded() const {
    return text_external("data:application/octet-stream;base64," + base64(buffer));
}

std::string GltfFile::text_external(const std::string& uri) const {
    json document = root;
    if (!buffer.empty()) document["buffers"] = {{{"byteLength", buffer.size()}, {"uri", uri}}};
    return document.dump();
}

std::string GltfFile::glb() const {
    json document = root;
    document["buffers"] = {{{"byteLength", buffer.size()}}};
    std::string text = document.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::string binary = buffer;
    while (binary.size() % 4 != 0) binary += '\0';
    const auto word = [](size_t value) {
        const uint32_t bits = static_cast<uint32_t>(value);
        return std::string(reinterpret_cast<const char*>(&bits), 4);
    };
    return "glTF" + word(2) + word(12 + 8 + text.size() + 8 + binary.size()) + word(text.size()) + "JSON" + text +
           word(binary.size()) + std::string("BIN\0", 4) + binary;
}

Result<LoadedScene> GltfFile::load(const TempFolder& folder) const {
    write_file(folder / "scene.gltf", text_embedded());
    return load_scene(folder / "scene.gltf");
}

GltfFile one_triangle() {
    GltfFile file;
    const int positions = file.add(std::vector<glm::vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    const int normals = file.add(std::vector<glm::vec3>(3, glm::vec3(0, 0, 1)));
    file.add_mesh({{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
    file.add_node({{"mesh", 0}});
    return file;
}

GltfFile textured_triangle(int sets) {
    GltfFile file = one_triangle();
    json& attributes = file.root["meshes"][0]["primitives"][0]["attributes"];
    for (int set = 0; set < sets; ++set)
        attributes["TEXCOORD_" + std::to_string(set)] = file.add(std::vector<glm::vec2>{{0, 0}, {1, 0}, {0, 1}});
    return file;
}

std::string png(int width, int height, int channels, const std::vector<uint8_t>& pixels) {
    const auto word = [](size_t value) {
        std::string bytes;
        for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift);
        return bytes;
    };
    const auto zlib_bytes = [](const std::string& text) { return reinterpret_cast<const Bytef*>(text.data()); };
    const auto chunk = [&](const std::string& name, const std::string& content) {
        const std::string checked = name + content;
        return word(content.size()) + checked + word(crc32(0, zlib_bytes(checked), static_cast<uInt>(checked.size())));
    };
    constexpr std::array<char, 5> kColorTypes = {0, 0, 4, 2, 6};  // by channels (PNG 1.2, 4.1.1)
    const char depth = 8, color_type = kColorTypes.at(static_cast<size_t>(channels));
    const size_t row = static_cast<size_t>(width) * static_cast<size_t>(channels);
    std::string rows;
    for (size_t y = 0; y < static_cast<size_t>(height); ++y)
        rows += std::string(1, 0) + std::string(reinterpret_cast<const char*>(pixels.data()) + y * row, row);
    uLongf length = compressBound(rows.size());
    std::string packed(length, 0);
    if (compress(reinterpret_cast<Bytef*>(packed.data()), &length, zlib_bytes(rows), rows.size()) != Z_OK)
        throw std::runtime_error("cannot write a PNG");
    packed.resize(length);
    const std::string header =
        word(static_cast<size_t>(width)) + word(static_cast<size_t>(height)) + depth + color_type + std::string(3, 0);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", packed) + chunk("IEND", "");
}

std::string png_uri(int width, int height, int channels, const std::vector<uint8_t>& pixels) {
    return "data:image/png;base64," + base64(png(width, height, channels, pixels));
}

HostScene loaded(const GltfFile& file, std::vector<std::string>* warnings) {
    const TempFolder folder;
    Result<LoadedScene> result = file.load(folder);
    EXPECT_TRUE(result.ok()) << result.status.message;
    if (!result.ok()) return HostScene();
    if (warnings)
        *warnings = result->warnings;
    else
        EXPECT_TRUE(result->warnings.empty()) << result->warnings.front();
    return std::move(result->scene);
}

std::string refusal(const GltfFile& file) {
    const TempFolder folder;
    const Result<LoadedScene> result = file.load(folder);
    EXPECT_FALSE(result.ok());
    const std::string prefix = (folder / "scene.gltf").string() + ": ";
    EXPECT_EQ(result.status.message.substr(0, prefix.size()), prefix);
    EXPECT_EQ(result.status.message.find('\n'), std::string::npos) << result.status.message;
    return result.status.message.substr(std::min(prefix.size(), result.status.message.size()));
}

}  // namespace render_system::testing
