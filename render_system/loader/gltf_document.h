// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "render_system/animation/curve.h"
#include "render_system/host_scene.h"
#include "render_system/loader/file_bytes.h"
#include "render_system/loader/tinygltf_model.h"
#include "render_system/loader/uri.h"

namespace render_system {

/// A buffer's bytes, wherever they lie: in a file mapped for the purpose, in the .glb, or decoded from a data URI.
struct GltfBuffer {
    FileBytes file;
    std::vector<std::byte> decoded;
    std::span<const std::byte> bytes;  ///< as long as `byteLength` says
};

/// Where an image comes from; one of the three is set.
struct GltfImage {
    std::string uri;
    int buffer_view = -1;
    std::string mime_type;
};

/// An image that cannot be read: where it stands in the file, and why; each once.
struct UnreadImage {
    std::string place;
    std::string why;
};

/// What a skin hangs on: nodes, and the accessor of their matrices (-1: identities).
struct GltfSkin {
    std::vector<int> joints;
    int inverse_binds = -1;
};

/// One channel of an animation with its sampler.
struct GltfChannel {
    std::string place;
    int animation = 0;
    int input = -1;  ///< accessors
    int output = -1;
    Interpolation interpolation = Interpolation::linear;
    int node = -1;        ///< -1: none
    std::string path;     ///< "translation", "rotation", "scale", "weights" or "pointer"
    std::string pointer;  ///< of KHR_animation_pointer
};

/// What the file asks for and does not get, gathered into one warning: what, and where or how often.
class Omissions {
public:
    void add(const std::string& what, const std::string& place = "");
    bool empty() const { return places_.empty(); }
    /// "points (/meshes/3/primitives/0), skins (2)"
    std::string text() const;

private:
    std::map<std::string, std::set<std::string>> places_;
};

/// A glTF file, parsed and checked: every index in `model` names something that exists. `model.buffers` and
/// `model.images` are empty; `buffers` and `images` stand in their place.
struct GltfDocument {
    std::filesystem::path path;
    Reach reach = Reach::folder;
    FileBytes file;
    std::vector<std::filesystem::path> files;  ///< it and those that it names, read or not, there or not
    tinygltf::Model model;
    std::vector<GltfBuffer> buffers;
    std::vector<GltfImage> images;
    std::map<int, std::vector<std::byte>> decoded_views;  ///< of views that are packed in the file
    std::vector<std::array<int, 4>> uv_sets;  ///< by material: the file's numbers of the sets it reads; -1: none
    std::optional<Sky> sky;                   ///< of EXT_lights_image_based
    std::vector<GltfSkin> skins;
    std::vector<std::string> animations;  ///< their names
    std::vector<GltfChannel> channels;    ///< of all animations, in the file's order
    uint64_t geometry_bytes = 0;          ///< what the meshes and curves read so far take, at least
    Omissions omissions;
    Omissions mended;  ///< what was wrong in the file, and shown all the same
    std::vector<UnreadImage> unread_images;

    /// Throws LoadError where the view does not lie in its buffer: one that nobody reads does no harm.
    std::span<const std::byte> view_bytes(int buffer_view) const;
    /// Counts what is about to be read. Throws LoadError where it all would be more than the machine's memory: parts of
    /// a file may share their bytes, so that a small one can ask for any amount.
    void take_memory(uint64_t bytes, const std::string& place);
    /// Lets go of the memory of file bytes already converted.
    void release_pages() const;
};

/// Reads and checks a .gltf or .glb file, or what the importer makes of an .obj or .fbx, and opens its buffers;
/// primitives have the materials of the variant of that name, if one is given. Throws LoadError, also where a buffer or
/// an image lies beyond `reach`.
GltfDocument open_gltf(const std::filesystem::path& path, Reach reach, const std::string& variant);

}  // namespace render_system
