// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/importer/glb_builder.h"

#include <limits>

#include "render_system/importer/importer.h"

namespace importer {

namespace {

using nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;

void append_word(std::string& to, size_t value) {
    const uint32_t word = static_cast<uint32_t>(value);
    to.append(reinterpret_cast<const char*>(&word), sizeof(word));
}

}  // namespace

GlbBuilder::GlbBuilder() {
    root = {{"asset", {{"version", "2.0"}}}, {"scene", 0}, {"scenes", {{{"nodes", json::array()}}}}};
    for (const char* list : {"nodes", "meshes", "materials", "images", "textures", "accessors", "bufferViews"}) {
        root[list] = json::array();
    }
}

size_t GlbBuilder::add_view(const void* data, size_t size) {
    while (buffer_.size() % 4 != 0) buffer_.push_back('\0');
    root["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer_.size()}, {"byteLength", size}});
    buffer_.append(static_cast<const char*>(data), size);
    if (buffer_.size() > std::numeric_limits<uint32_t>::max() / 2) {
        throw ImportError{"holds more than 2 GiB of geometry; split it, or convert it to glTF"};
    }
    return root["bufferViews"].size() - 1;
}

size_t GlbBuilder::add_floats(const std::vector<float>& values, const char* type, size_t components) {
    const size_t view = add_view(values.data(), values.size() * sizeof(float));
    root["accessors"].push_back(
        {{"bufferView", view}, {"componentType", kFloat}, {"type", type}, {"count", values.size() / components}});
    return root["accessors"].size() - 1;
}

size_t GlbBuilder::add_corners(const std::vector<uint32_t>& corners) {
    const size_t view = add_view(corners.data(), corners.size() * sizeof(uint32_t));
    root["accessors"].push_back(
        {{"bufferView", view}, {"componentType", kUnsignedInt}, {"type", "SCALAR"}, {"count", corners.size()}});
    return root["accessors"].size() - 1;
}

size_t GlbBuilder::add_image(const std::string& uri) {
    const auto [entry, is_new] = images_.emplace(uri, root["images"].size());
    if (is_new) root["images"].push_back({{"uri", uri}});
    return entry->second;
}

size_t GlbBuilder::add_image(const void* data, size_t size, const std::string& mime_type) {
    const std::string key = "memory:" + std::to_string(reinterpret_cast<uintptr_t>(data));
    const auto [entry, is_new] = images_.emplace(key, root["images"].size());
    if (is_new) root["images"].push_back({{"bufferView", add_view(data, size)}, {"mimeType", mime_type}});
    return entry->second;
}

size_t GlbBuilder::add_texture(int source, bool clamped, const json& pack) {
    json texture = json::object();
    if (source >= 0) texture["source"] = source;
    if (!pack.is_null()) texture["extensions"]["PORTTOOL_pack"] = pack;
    if (clamped) {
        constexpr int kClampToEdge = 33071;
        root["samplers"] = json::array({{{"wrapS", kClampToEdge}, {"wrapT", kClampToEdge}}});
        texture["sampler"] = 0;
    }
    const auto [entry, is_new] = textures_.emplace(texture.dump(), root["textures"].size());
    if (is_new) root["textures"].push_back(texture);
    return entry->second;
}

void GlbBuilder::write() {
    if (!left_out_.empty()) root["asset"]["extras"]["left_out"] = left_out_;
    if (!files_.empty()) root["asset"]["extras"]["files"] = files_;
    root["buffers"] = json::array({{{"byteLength", buffer_.size()}}});
    // Names may be of any encoding.
    std::string text = root.dump(-1, ' ', false, json::error_handler_t::replace);
    while (text.size() % 4 != 0) text += ' ';
    while (buffer_.size() % 4 != 0) buffer_ += '\0';
    std::string head = "glTF";
    append_word(head, 2);
    append_word(head, 12 + 8 + text.size() + 8 + buffer_.size());
    append_word(head, text.size());
    head += "JSON" + text;
    append_word(head, buffer_.size());
    head.append("BIN\0", 4);
    write_out(head.data(), head.size());
    write_out(buffer_.data(), buffer_.size());
}

}  // namespace importer
