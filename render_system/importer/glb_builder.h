// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace importer {

/// A glTF document under construction, with one binary buffer.
class GlbBuilder {
public:
    nlohmann::json root;

    GlbBuilder();

    /// Appends bytes as a buffer view; answers its number.
    size_t add_view(const void* data, size_t size);
    /// An accessor over values of `type` (VEC3, ...), all floats; answers its number.
    size_t add_floats(const std::vector<float>& values, const char* type, size_t components);
    size_t add_corners(const std::vector<uint32_t>& corners);

    /// The image at that URI, or in memory at that place, each once.
    size_t add_image(const std::string& uri);
    size_t add_image(const void* data, size_t size, const std::string& mime_type);

    /// A texture over images; answers its number. `pack` names further images whose first channel is this texture's
    /// green, blue or alpha; -1 as source: white.
    size_t add_texture(int source, bool clamped, const nlohmann::json& pack = nullptr);

    /// What the file has and this cannot carry, and where; told in the loader's one warning.
    void leave_out(const std::string& what) { left_out_[what]; }
    void leave_out(const std::string& what, const std::string& place) { left_out_[what].insert(place); }

    /// A file that was read beside the one that was asked for.
    void note_file(const std::string& path) { files_.insert(path); }

    /// Writes the .glb to stdout.
    void write();

private:
    std::string buffer_;
    std::map<std::string, size_t> images_;
    std::map<std::string, size_t> textures_;
    std::map<std::string, std::set<std::string>> left_out_;  // places by what
    std::set<std::string> files_;
};

}  // namespace importer
