// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_document.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "render_system/loader/gltf_animations.h"
#include "render_system/loader/gltf_draco.h"
#include "render_system/loader/gltf_extensions.h"
#include "render_system/loader/gltf_image_light.h"
#include "render_system/loader/gltf_meshopt.h"
#include "render_system/loader/gltf_schema.h"
#include "render_system/loader/gltf_skins.h"
#include "render_system/loader/import_process.h"
#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

// Deeper nesting than any real file has; tinygltf walks `extras` by recursion.
constexpr int DEEPEST_JSON = 128;

struct Container {
    std::string_view text;
    Bytes binary;  // the .glb's second chunk
};

uint32_t read_u32(Bytes bytes, size_t offset) {
    const auto at = [&](size_t i) { return static_cast<uint32_t>(bytes[offset + i]); };
    return at(0) | at(1) << 8 | at(2) << 16 | at(3) << 24;
}

std::string_view as_text(Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

Bytes glb_chunk(Bytes bytes, size_t offset, uint32_t type, const char* name) {
    if (bytes.size() - offset < 8)
        fail_at("", std::string("the .glb ends before its ") + name + " chunk; it is cut off");
    const uint64_t length = read_u32(bytes, offset);
    if (read_u32(bytes, offset + 4) != type) {
        fail_at("", std::string("the .glb has another chunk where its ") + name + " chunk should be" + EXPORT_AGAIN);
    }
    if (length > bytes.size() - offset - 8) {
        fail_at("", std::string("the .glb's ") + name + " chunk needs " + std::to_string(length) + " bytes, but " +
                        std::to_string(bytes.size() - offset - 8) + " are there; the file is cut off, copy it again");
    }
    return bytes.subspan(offset + 8, length);
}

// The layout of a .glb: 12 bytes of header, then chunks of length, type and bytes (glTF 2.0, 4.4).
Container open_container(Bytes bytes) {
    constexpr uint32_t JSON_CHUNK = 0x4E4F534A;
    constexpr uint32_t BINARY_CHUNK = 0x004E4942;
    if (bytes.empty()) fail_at("", "the file is empty; copy or export it again");
    if (as_text(bytes).substr(0, 4) != "glTF") return {as_text(bytes), {}};
    if (bytes.size() < 12) fail_at("", "the .glb ends within its header; it is cut off, copy it again");
    if (const uint32_t version = read_u32(bytes, 4); version != 2) {
        fail_at("", "is a .glb of version " + std::to_string(version) + "; convert it to glTF 2.0");
    }
    const uint64_t length = read_u32(bytes, 8);
    if (length > bytes.size()) {
        fail_at("", "the .glb should have " + std::to_string(length) + " bytes, but has " +
                        std::to_string(bytes.size()) + "; it is cut off, copy it again");
    }
    bytes = bytes.first(length);
    Container container;
    container.text = as_text(glb_chunk(bytes, 12, JSON_CHUNK, "JSON"));
    size_t next = 12 + 8 + container.text.size();
    // Padding should be spaces; some exporters write zeros.
    while (!container.text.empty() && container.text.back() == '\0') container.text.remove_suffix(1);
    // Chunks of other kinds are to be passed over (glTF 2.0, 4.4.3).
    while (bytes.size() - std::min(next, bytes.size()) >= 8) {
        const uint32_t type = read_u32(bytes, next + 4);
        const Bytes chunk = glb_chunk(bytes, next, type, type == BINARY_CHUNK ? "BIN" : "next");
        next += 8 + chunk.size();
        if (type != BINARY_CHUNK) continue;
        container.binary = chunk;
        break;
    }
    return container;
}

// Before it is parsed: with a callback for it, the parser goes through the whole list again after each object in it.
void check_depth(std::string_view text) {
    int depth = 0;
    bool quoted = false;
    for (size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '"') quoted = !quoted;
        if (quoted && c == '\\') ++i;
        if (quoted) continue;
        depth += c == '{' || c == '[' ? 1 : c == '}' || c == ']' ? -1 : 0;
        if (depth > DEEPEST_JSON) fail_at("", "its JSON is nested too deeply" + EXPORT_AGAIN);
    }
}

// Where a number stands, of which the parser says no more than how it is written; `number` ends with a quote.
std::string line_of(std::string_view text, std::string number) {
    number = number.substr(0, number.find('\''));
    bool quoted = false;
    size_t line = 1, line_start = 0;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\n') {
            ++line;
            line_start = i + 1;
        }
        if (text[i] == '"') quoted = !quoted;
        if (quoted && text[i] == '\\') ++i;
        if (quoted || text.substr(i, number.size()) != number) continue;
        return "line " + std::to_string(line) + ", column " + std::to_string(i - line_start + 1);
    }
    return {};
}

json parse_json(std::string_view text) {
    check_depth(text);
    try {
        return json::parse(text.begin(), text.end());
    } catch (const json::out_of_range& error) {
        // "number overflow parsing '1e999'"
        const std::string what = error.what();
        fail_at(line_of(text, what.substr(std::min(what.size(), what.find('\'') + 1))),
                "holds a number past the range of its type (" + what.substr(what.find("number")) + ")" + EXPORT_AGAIN);
    } catch (const json::exception& error) {
        // What the parser says after its own error number: "parse error at line 1, column 2: ..."
        const std::string what = error.what();
        const size_t start = what.find("] ");
        fail_at("", "is not JSON, so no glTF (" + (start == std::string::npos ? what : what.substr(start + 2)) +
                        "); name a .gltf, .glb, .obj or .fbx file");
    }
}

void check_version(const json& document) {
    const std::string version = document["asset"]["version"];
    if (version.substr(0, 2) != "2.") fail_at("/asset/version", "is \"" + version + "\"; convert the file to glTF 2.0");
    const std::string least = document["asset"].value("minVersion", "2.0");
    if (least != "2.0") fail_at("/asset/minVersion", "asks for glTF " + least + "; only 2.0 is supported");
}

GltfBuffer open_buffer(const json& entry, size_t index, GltfDocument& document, Bytes binary) {
    const std::string place = "/buffers/" + std::to_string(index);
    const uint64_t length = entry["byteLength"].get<uint64_t>();
    GltfBuffer buffer;
    std::string source = "its data";
    if (!entry.contains("uri")) {
        if (index != 0 || binary.data() == nullptr) return buffer;  // an error for who reads from it
        source = "the .glb's BIN chunk";
        buffer.bytes = binary;
    } else if (const std::string& uri = entry["uri"].get_ref<const std::string&>(); is_data_uri(uri)) {
        buffer.decoded = decode_data_uri(uri, place + "/uri");
        buffer.bytes = buffer.decoded;
        source = "its data URI";
    } else {
        const std::filesystem::path file =
            file_of_uri(uri, document.path.parent_path(), document.reach, place + "/uri");
        source = file.string();
        document.files.push_back(file);
        try {
            buffer.file = FileBytes(file);
        } catch (LoadError& error) {
            error.message = place + ": " + source + ": " + error.message;
            throw;
        }
        buffer.bytes = buffer.file.bytes();
    }
    if (buffer.bytes.size() < length) {
        fail_at(place, source + " has " + std::to_string(buffer.bytes.size()) + " bytes, but byteLength is " +
                           std::to_string(length) + "; it is cut off, copy or export it again");
    }
    buffer.bytes = buffer.bytes.first(length);
    return buffer;
}

GltfImage image_of(json& entry, const std::string& place) {
    GltfImage image;
    const bool has_uri = entry.contains("uri");
    if (has_uri == entry.contains("bufferView")) {
        fail_at(place,
                std::string(has_uri ? "has both a uri and" : "has neither a uri nor") + " a bufferView" + EXPORT_AGAIN);
    }
    if (has_uri) image.uri = std::move(entry["uri"].get_ref<std::string&>());
    image.buffer_view = entry.value("bufferView", -1);
    image.mime_type = entry.value("mimeType", "");
    return image;
}

// An image that cannot be read has a placeholder in its stead, but one that lies out of reach ends the loading, used or
// not.
void check_reach(GltfDocument& document, const std::string& uri, const std::string& place) {
    if (uri.empty() || is_data_uri(uri)) return;
    try {
        document.files.push_back(file_of_uri(uri, document.path.parent_path(), document.reach, place));
    } catch (const LoadError& error) {
        if (error.hostile) throw;
    }
}

// Accessors without a buffer view are legal, but tinygltf refuses them as indices: they get a view of their own, which
// forget_made_up_views takes away again.
void make_up_views(json& document) {
    if (!document.contains("accessors")) return;
    const size_t count = document.contains("bufferViews") ? document["bufferViews"].size() : 0;
    bool needed = false;
    for (json& accessor : document["accessors"]) {
        if (accessor.contains("bufferView")) continue;
        accessor["bufferView"] = count;
        needed = true;
    }
    if (needed) document["bufferViews"].push_back({{"buffer", 0}, {"byteLength", 1}});
}

void forget_made_up_views(tinygltf::Model& model, size_t real_views) {
    model.bufferViews.resize(real_views);
    for (tinygltf::Accessor& accessor : model.accessors) {
        if (accessor.bufferView >= static_cast<int>(real_views)) accessor.bufferView = -1;
    }
}

// What a camera or a spot light is stands in a member that is called as its type; tinygltf does not say whose is
// missing.
void check_descriptions(const json& list, const std::string& place) {
    for (size_t i = 0; i < list.size(); ++i) {
        const std::string type = list[i].value("type", "");
        const bool needs_one = type == "perspective" || type == "orthographic" || type == "spot";
        if (needs_one && !list[i].contains(type))
            fail_at(place + "/" + std::to_string(i) + "/" + type, "is missing" + EXPORT_AGAIN);
    }
}

void check_descriptions(const json& document) {
    const json::json_pointer lights("/extensions/KHR_lights_punctual/lights");
    if (document.contains("cameras")) check_descriptions(document["cameras"], "/cameras");
    if (document.contains(lights)) check_descriptions(document[lights], lights.to_string());
}

tinygltf::Model parse_model(json& document) {
    check_descriptions(document);
    const size_t real_views = document.contains("bufferViews") ? document["bufferViews"].size() : 0;
    // Read by this loader, or not at all.
    for (const char* part : {"buffers", "images", "skins", "animations"}) document.erase(part);
    make_up_views(document);
    const std::string text = document.dump();
    if (text.size() > std::numeric_limits<unsigned int>::max()) fail_at("", "its JSON is larger than 4 GiB");
    tinygltf::Model model;
    tinygltf::TinyGLTF parser;
    std::string error;
    std::string warning;
    const bool good = parser.LoadASCIIFromString(&model, &error, &warning, text.data(),
                                                 static_cast<unsigned int>(text.size()), "", tinygltf::NO_REQUIRE);
    if (!good) {
        std::replace(error.begin(), error.end(), '\n', ' ');
        while (!error.empty() && error.back() == ' ') error.pop_back();
        fail_at("", (error.empty() ? "is not a valid glTF" : error) + EXPORT_AGAIN);
    }
    forget_made_up_views(model, real_views);
    return model;
}

// Taken for a scene by those who mean `compare`, or by mistake.
void refuse_picture(Bytes bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const std::string_view start : {"\x89PNG", "v/1\x01", "\xff\xd8\xff", "#?RADIANCE", "#?RGBE"})
        if (text.starts_with(start)) fail_at("", "is a picture, no scene; name a .gltf, .glb, .obj or .fbx file");
}

// The importer's word for what a name's ending says; empty: glTF.
std::string foreign_format(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
    return ending == ".obj" || ending == ".fbx" ? ending.substr(1) : std::string();
}

FileBytes import_file(const std::filesystem::path& path, const std::string& format, Reach reach) {
    ImportRequest request;
    request.format = format;
    request.file_bytes = FileBytes(path).bytes().size();  // also says at once what is no file
    if (request.file_bytes == 0) fail_at("", "the file is empty; copy or export it again");
    request.arguments = {std::filesystem::absolute(path).string()};
    if (reach == Reach::anywhere) request.arguments.push_back("anywhere");
    return run_importer(request);
}

// What the importer could not carry over, and which files it read beside the one that it was given.
void hear_importer(const json& root, GltfDocument& document) {
    const json extras = root["asset"].value("extras", json::object());
    const json left_out = extras.value("left_out", json::object());
    for (const auto& [what, places] : left_out.items()) {
        document.omissions.add(what);
        for (const json& place : places) document.omissions.add(what, place.get<std::string>());
    }
    for (const json& file : extras.value("files", json::array())) document.files.emplace_back(file.get<std::string>());
}

}  // namespace

void Omissions::add(const std::string& what, const std::string& place) {
    std::set<std::string>& places = places_[what];
    if (!place.empty()) places.insert(place);
}

std::string Omissions::text() const {
    constexpr size_t SHOWN = 3;
    std::string text;
    for (const auto& [what, places] : places_) {
        text += (text.empty() ? "" : ", ") + what;
        size_t i = 0;
        for (auto place = places.begin(); place != places.end() && i < SHOWN; ++place, ++i) {
            text += (i == 0 ? " (" : ", ") + *place;
        }
        if (places.size() > SHOWN) text += " and " + std::to_string(places.size() - SHOWN) + " more";
        if (!places.empty()) text += ")";
    }
    return text;
}

std::span<const std::byte> GltfDocument::view_bytes(int buffer_view) const {
    const tinygltf::BufferView& view = model.bufferViews[static_cast<size_t>(buffer_view)];
    const auto decoded = decoded_views.find(buffer_view);
    if (decoded != decoded_views.end()) return std::span(decoded->second).first(view.byteLength);
    const size_t size = buffers[static_cast<size_t>(view.buffer)].bytes.size();
    if (view.byteOffset > size || view.byteLength > size - view.byteOffset) {
        fail_at("/bufferViews/" + std::to_string(buffer_view),
                "reaches to byte " + std::to_string(view.byteOffset + view.byteLength) + ", but buffer " +
                    std::to_string(view.buffer) + " has " + std::to_string(size) + EXPORT_AGAIN);
    }
    return buffers[static_cast<size_t>(view.buffer)].bytes.subspan(view.byteOffset, view.byteLength);
}

void GltfDocument::take_memory(uint64_t bytes, const std::string& place) {
    const uint64_t machine =
        static_cast<uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<uint64_t>(sysconf(_SC_PAGE_SIZE));
    geometry_bytes += bytes;
    if (geometry_bytes <= machine) return;
    fail_at(place, "with it the meshes take " + std::to_string(geometry_bytes >> 20) +
                       " MiB, more memory than this machine has; split the scene");
}

void GltfDocument::release_pages() const {
    file.release_pages();
    for (const GltfBuffer& buffer : buffers) buffer.file.release_pages();
}

GltfDocument open_gltf(const std::filesystem::path& path, Reach reach, const std::string& variant) {
    GltfDocument document;
    document.path = path;
    document.reach = reach;
    document.files = {path};
    const std::string foreign = foreign_format(path);
    document.file = foreign.empty() ? FileBytes(path) : import_file(path, foreign, reach);
    refuse_picture(document.file.bytes());
    const Container container = open_container(document.file.bytes());
    json root = parse_json(container.text);
    check_gltf_schema(root);
    if (!foreign.empty()) hear_importer(root, document);
    check_version(root);
    check_extensions(root, document.omissions);
    document.skins = read_skins(root);
    document.animations = animation_names(root);
    document.channels = read_channels(root, document.omissions);
    apply_variant(root, variant);
    take_webp_images(root);
    if (root.contains("buffers")) {
        const std::vector<bool> fallback = meshopt_fallback_buffers(root);
        for (size_t i = 0; i < root["buffers"].size(); ++i) {
            document.buffers.push_back(fallback[i] ? GltfBuffer()
                                                   : open_buffer(root["buffers"][i], i, document, container.binary));
            root["buffers"][i].erase("uri");  // it may have been most of the file
        }
    }
    if (root.contains("images")) {
        for (size_t i = 0; i < root["images"].size(); ++i) {
            const std::string place = "/images/" + std::to_string(i);
            document.images.push_back(image_of(root["images"][i], place));
            check_reach(document, document.images.back().uri, place + "/uri");
        }
    }
    decode_meshopt_views(root, document);
    const json* light = image_light(root);
    const json kept = light ? *light : json();
    document.model = parse_model(root);
    decode_draco_primitives(document);
    if (light) document.sky = read_image_light(kept, document);
    return document;
}

}  // namespace render_system
