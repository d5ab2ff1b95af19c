// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <istream>
#include <set>
#include <streambuf>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "render_system/importer/glb_builder.h"
#include "render_system/importer/importer.h"
#include "render_system/importer/obj_materials.h"
#include "render_system/importer/obj_text.h"
#include "render_system/loader/file_bytes.h"
#include "render_system/loader/load_error.h"
#include "render_system/loader/uri.h"

namespace importer {

namespace {

using nlohmann::json;
using render_system::FileBytes;

// A text as a stream, without a copy of it.
class TextStream : private std::streambuf, public std::istream {
public:
    explicit TextStream(std::string_view text) : std::istream(this) {
        char* begin = const_cast<char*>(text.data());
        setg(begin, begin, begin + text.size());
    }
};

// Without the mark that some editors put before UTF-8.
std::string_view text_of(const FileBytes& file) {
    const std::string_view text(reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size());
    return text.substr(text.starts_with("\xEF\xBB\xBF") ? 3 : 0);
}

// Reads MTL files through the loader's one way of reading files, and within its bounds.
class BoundedMaterials : public tinyobj::MaterialReader {
public:
    BoundedMaterials(const std::filesystem::path& folder, bool anywhere, GlbBuilder& builder)
        : folder_(folder), anywhere_(anywhere), builder_(builder) {}

    // A line may name several files. tinyobjloader stops at the first that was read, so it is told that none was.
    bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* by_name, std::string* warnings, std::string* errors) override {
        if (name.empty() || !known_.insert(name).second) return false;
        std::string uri;
        for (const char c : name) uri += c == '%' ? "%25" : c == '\\' ? "/" : std::string(1, c);
        const auto reach = anywhere_ ? render_system::Reach::anywhere : render_system::Reach::folder;
        try {
            const std::filesystem::path path = render_system::file_of_uri(uri, folder_, reach, "mtllib");
            builder_.note_file(path.string());
            const std::string text = read(path, name);
            TextStream stream(text);
            tinyobj::LoadMtl(by_name, materials, &stream, warnings, errors);
        } catch (const render_system::LoadError& error) {
            if (error.hostile) throw;
            builder_.leave_out("materials of MTL files", name + ": " + error.message);
        }
        return false;
    }

private:
    std::string read(const std::filesystem::path& path, const std::string& name) {
        try {
            const FileBytes file(path);
            return plain_mtl(text_of(file), name, builder_);
        } catch (render_system::LoadError& error) {
            if (error.hostile) error.message = "mtllib: " + name + " " + error.message;
            throw;
        }
    }

    const std::filesystem::path& folder_;
    bool anywhere_;
    GlbBuilder& builder_;
    std::set<std::string> known_;
};

// A corner as OBJ has it, with the smoothing group where normals are to be made.
struct Corner {
    int vertex = -1;
    int normal = -1;
    int coordinates = -1;
    unsigned smoothing = 0;

    bool operator==(const Corner&) const = default;
};

struct CornerHash {
    size_t operator()(const Corner& corner) const {
        size_t hash = static_cast<size_t>(corner.vertex);
        for (int part : {corner.normal, corner.coordinates, static_cast<int>(corner.smoothing)}) {
            hash = (hash ^ static_cast<size_t>(static_cast<unsigned>(part))) * 0x9E3779B97F4A7C15u;
        }
        return hash ^ hash >> 29;
    }
};

// The faces of one shape that are of one kind.
struct Primitive {
    std::vector<float> positions, normals, coordinates, colors;
    std::vector<uint32_t> corners;
    std::unordered_map<Corner, uint32_t, CornerHash> known;
};

// What the faces of a primitive have in common.
struct FaceKind {
    int material = -1;
    bool has_normals = false;  // or such as are to be made
    bool has_coordinates = false;

    auto operator<=>(const FaceKind&) const = default;
};

float linear_of(float encoded) {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

class ObjConverter {
public:
    ObjConverter(const std::filesystem::path& path, bool anywhere) : folder_(path.parent_path()) {
        const FileBytes file(path);
        const std::string joined = joined_lines(text_of(file));
        const std::string_view text = joined.empty() ? text_of(file) : joined;
        const std::map<std::string, size_t> asked = check_obj(text, builder_);
        const std::string closed = closed_corners(text);
        TextStream stream(closed.empty() ? text : closed);
        BoundedMaterials reader(folder_, anywhere, builder_);
        std::string warnings, errors;
        if (!tinyobj::LoadObj(&attributes_, &shapes_, &materials_, &warnings, &errors, &stream, &reader, true, false)) {
            throw ImportError{"is no OBJ that can be read (" + errors.substr(0, errors.find('\n')) +
                              "); export it again"};
        }
        note_unknown(asked);
        check_finite(attributes_.vertices, 3, "v");
        check_finite(attributes_.normals, 3, "vn");
        check_finite(attributes_.texcoords, 2, "vt");
    }

    void write() {
        for (const tinyobj::material_t& material : materials_) {
            builder_.root["materials"].push_back(gltf_material(material, folder_, builder_));
        }
        leave_out_missing(&tinyobj::index_t::normal_index, attributes_.normals.size() / 3, "vn");
        leave_out_missing(&tinyobj::index_t::texcoord_index, attributes_.texcoords.size() / 2, "vt");
        for (tinyobj::shape_t& shape : shapes_) {
            add_shape(shape);
            shape = {};  // its memory is of use to the next
        }
        builder_.write();
    }

private:
    void note_unknown(const std::map<std::string, size_t>& asked) {
        std::set<std::string> defined;
        for (const tinyobj::material_t& material : materials_) defined.insert(material.name);
        for (const auto& [name, line] : asked) {
            if (defined.contains(name)) continue;
            builder_.leave_out("materials that no MTL file defines", name + " in line " + std::to_string(line));
        }
    }

    static void check_finite(const std::vector<float>& values, size_t components, const char* what) {
        for (size_t i = 0; i < values.size(); ++i) {
            if (std::isfinite(values[i])) continue;
            throw ImportError{std::string(what) + " number " + std::to_string(i / components + 1) +
                              " is not finite (NaN or infinite); export the file again"};
        }
    }

    static std::string named_of(const char* what, int index, size_t count) {
        return std::string(what) + " " + std::to_string(int64_t{index} + 1) + " of " + std::to_string(count);
    }

    // A shape has its form without normals and texture coordinates, too. The largest index that is missing is named.
    void leave_out_missing(int tinyobj::index_t::*part, size_t count, const char* what) {
        int largest = -1;
        for (tinyobj::shape_t& shape : shapes_) {
            for (tinyobj::index_t& index : shape.mesh.indices) {
                if (index.*part < 0 || static_cast<size_t>(index.*part) < count) continue;
                largest = std::max(largest, std::exchange(index.*part, -1));
            }
        }
        if (largest < 0) return;
        builder_.leave_out("normals and texture coordinates that faces name and the file does not have",
                           named_of(what, largest, count));
    }

    int checked_vertex(int index) const {
        const size_t count = attributes_.vertices.size() / 3;
        if (index >= 0 && static_cast<size_t>(index) < count) return index;
        throw ImportError{"a face names " + named_of("v", index, count) + "; export the file again"};
    }

    Corner corner_of(const tinyobj::index_t& index, unsigned smoothing) const {
        Corner corner;
        corner.vertex = checked_vertex(index.vertex_index);
        corner.normal = std::max(index.normal_index, -1);
        corner.coordinates = std::max(index.texcoord_index, -1);
        if (corner.normal < 0) corner.smoothing = smoothing;
        return corner;
    }

    void add_shape(const tinyobj::shape_t& shape) {
        const tinyobj::mesh_t& mesh = shape.mesh;
        if (!shape.lines.indices.empty()) builder_.leave_out("lines");
        if (!shape.points.indices.empty()) builder_.leave_out("points");
        smooth(mesh);
        std::map<FaceKind, Primitive> primitives;
        for (size_t face = 0; 3 * face + 2 < mesh.indices.size(); ++face) {
            const tinyobj::index_t* indices = &mesh.indices[3 * face];
            const unsigned smoothing = face < mesh.smoothing_group_ids.size() ? mesh.smoothing_group_ids[face] : 0;
            FaceKind kind;
            kind.material = face < mesh.material_ids.size() ? mesh.material_ids[face] : -1;
            kind.has_normals = smoothing != 0 || all_have(indices, &tinyobj::index_t::normal_index);
            kind.has_coordinates = all_have(indices, &tinyobj::index_t::texcoord_index);
            add_face(primitives[kind], indices, smoothing);
        }
        if (primitives.empty()) return;
        json list = json::array();
        for (auto& [kind, primitive] : primitives) list.push_back(gltf_primitive(kind, primitive));
        builder_.root["meshes"].push_back({{"name", shape.name}, {"primitives", list}});
        const size_t node = builder_.root["nodes"].size();
        builder_.root["nodes"].push_back({{"name", shape.name}, {"mesh", builder_.root["meshes"].size() - 1}});
        builder_.root["scenes"][0]["nodes"].push_back(node);
    }

    static bool all_have(const tinyobj::index_t* indices, int tinyobj::index_t::*part) {
        return indices[0].*part >= 0 && indices[1].*part >= 0 && indices[2].*part >= 0;
    }

    void add_face(Primitive& primitive, const tinyobj::index_t* indices, unsigned smoothing) {
        for (size_t i = 0; i < 3; ++i) {
            const Corner corner = corner_of(indices[i], smoothing);
            const auto [entry, is_new] =
                primitive.known.emplace(corner, static_cast<uint32_t>(primitive.positions.size() / 3));
            if (is_new) add_vertex(primitive, corner);
            primitive.corners.push_back(entry->second);
        }
    }

    void add_vertex(Primitive& primitive, const Corner& corner) {
        const auto copy = [](std::vector<float>& to, const std::vector<float>& from, int index, int count) {
            for (int c = 0; c < count; ++c)
                to.push_back(index < 0 ? 0.0f : from[static_cast<size_t>(count * index + c)]);
        };
        copy(primitive.positions, attributes_.vertices, corner.vertex, 3);
        if (corner.smoothing == 0) {
            copy(primitive.normals, attributes_.normals, corner.normal, 3);
        } else {
            const auto& normal = smoothed_[key_of(static_cast<size_t>(corner.vertex), corner.smoothing)];
            primitive.normals.insert(primitive.normals.end(), normal.begin(), normal.end());
        }
        copy(primitive.coordinates, attributes_.texcoords, corner.coordinates, 2);
        if (corner.coordinates >= 0) primitive.coordinates.back() = 1.0f - primitive.coordinates.back();
        if (attributes_.colors.size() != attributes_.vertices.size()) return;
        for (size_t c = 0; c < 3; ++c) {
            primitive.colors.push_back(linear_of(attributes_.colors[3 * static_cast<size_t>(corner.vertex) + c]));
        }
    }

    // A smoothing group's normals are the sum of its faces' at a vertex, each as long as its face is large; across
    // seams of texture coordinates and materials.
    void smooth(const tinyobj::mesh_t& mesh) {
        smoothed_.clear();
        for (size_t face = 0; 3 * face + 2 < mesh.indices.size(); ++face) {
            const unsigned group = face < mesh.smoothing_group_ids.size() ? mesh.smoothing_group_ids[face] : 0;
            const tinyobj::index_t* indices = &mesh.indices[3 * face];
            if (group == 0 || indices[0].normal_index >= 0) continue;
            size_t at[3];
            for (size_t i = 0; i < 3; ++i) at[i] = 3 * static_cast<size_t>(corner_of(indices[i], group).vertex);
            const std::vector<float>& v = attributes_.vertices;
            float a[3], b[3];
            for (size_t c = 0; c < 3; ++c) {
                a[c] = v[at[1] + c] - v[at[0] + c];
                b[c] = v[at[2] + c] - v[at[0] + c];
            }
            const float normal[3] = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
            for (size_t i = 0; i < 3; ++i) {
                std::array<float, 3>& sum = smoothed_[key_of(at[i] / 3, group)];
                for (size_t c = 0; c < 3; ++c) sum[c] += normal[c];
            }
        }
    }

    static uint64_t key_of(size_t vertex, unsigned group) { return uint64_t{vertex} << 32 | group; }

    json gltf_primitive(const FaceKind& kind, Primitive& primitive) {
        json attributes = {{"POSITION", builder_.add_floats(primitive.positions, "VEC3", 3)}};
        if (kind.has_normals) attributes["NORMAL"] = builder_.add_floats(normalized(primitive.normals), "VEC3", 3);
        if (kind.has_coordinates) attributes["TEXCOORD_0"] = builder_.add_floats(primitive.coordinates, "VEC2", 2);
        if (!primitive.colors.empty()) attributes["COLOR_0"] = builder_.add_floats(primitive.colors, "VEC3", 3);
        json result = {{"attributes", attributes}, {"indices", builder_.add_corners(primitive.corners)}};
        const bool known = kind.material >= 0 && static_cast<size_t>(kind.material) < materials_.size();
        result["material"] = known ? static_cast<size_t>(kind.material) : plain_material();
        return result;
    }

    // For faces without one: glTF's own default would be a metal.
    size_t plain_material() {
        json& materials = builder_.root["materials"];
        if (materials.size() == materials_.size()) {
            const json pbr = {{"baseColorFactor", {0.8, 0.8, 0.8, 1}}, {"metallicFactor", 0}};
            materials.push_back({{"name", "default"}, {"doubleSided", true}, {"pbrMetallicRoughness", pbr}});
        }
        return materials_.size();
    }

    // The loader makes anew what stays without a length.
    static const std::vector<float>& normalized(std::vector<float>& normals) {
        for (size_t i = 0; i < normals.size(); i += 3) {
            const double x = static_cast<double>(normals[i]), y = static_cast<double>(normals[i + 1]),
                         z = static_cast<double>(normals[i + 2]);
            const double size = std::sqrt(x * x + y * y + z * z);
            for (size_t c = 0; c < 3; ++c) {
                normals[i + c] = size > 0.0 && std::isfinite(size)
                                     ? static_cast<float>(static_cast<double>(normals[i + c]) / size)
                                     : 0.0f;
            }
        }
        return normals;
    }

    std::filesystem::path folder_;
    GlbBuilder builder_;
    tinyobj::attrib_t attributes_;
    std::vector<tinyobj::shape_t> shapes_;
    std::vector<tinyobj::material_t> materials_;
    std::unordered_map<uint64_t, std::array<float, 3>> smoothed_;  // of the shape at hand, by key_of
};

}  // namespace

void import_obj(const std::filesystem::path& path, bool anywhere) { ObjConverter(path, anywhere).write(); }

}  // namespace importer
