// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

#include "render_system/loader/gltf_accessors.h"
#include "render_system/loader/load_error.h"
#include "render_system/loader/tangents.h"
#include "render_system/scene_limits.h"

namespace render_system {

namespace {

constexpr int MISSING = -1;
constexpr std::vector<glm::vec2> HostMesh::*kUvSets[] = {&HostMesh::uv0, &HostMesh::uv1, &HostMesh::uv2,
                                                         &HostMesh::uv3};

bool has_triangles(const tinygltf::Primitive& primitive) {
    return primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
           primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
}

int attribute(const tinygltf::Primitive& primitive, const std::string& name) {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? MISSING : found->second;
}

uint32_t material_of(const GltfDocument& document, const tinygltf::Primitive& primitive) {
    return static_cast<uint32_t>(primitive.material >= 0 ? static_cast<size_t>(primitive.material)
                                                         : document.model.materials.size());
}

// Triangle number `i` of a list, strip or fan, as places in the index list (glTF 2.0, 3.7.2.1). All wind alike.
glm::uvec3 corners_of(int mode, uint32_t i) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) return {i, i + 1 + i % 2, i + 2 - i % 2};
    if (mode == TINYGLTF_MODE_TRIANGLE_FAN) return {i + 1, i + 2, 0};
    return {3 * i, 3 * i + 1, 3 * i + 2};
}

uint64_t triangle_count(int mode, uint64_t corners) {
    if (mode == TINYGLTF_MODE_TRIANGLES) return corners / 3;
    return corners < 3 ? 0 : corners - 2;
}

// Adds the primitives of one glTF mesh to one HostMesh.
class MeshReader {
public:
    MeshReader(GltfDocument& document, int mesh, bool skinned, const HostScene& scene)
        : document_(document),
          source_(document.model.meshes[static_cast<size_t>(mesh)]),
          scene_(scene),
          mesh_place_("/meshes/" + std::to_string(mesh)),
          influences_(skinned ? influences_of(source_) : 0) {}

    LoadedMesh read() {
        mesh_.name = source_.name;
        for (const tinygltf::Primitive& primitive : source_.primitives) {
            if (has_triangles(primitive))
                rest_.targets.resize(std::max(rest_.targets.size(), primitive.targets.size()));
        }
        reserve();
        for (size_t i = 0; i < source_.primitives.size(); ++i) {
            place_ = mesh_place_ + "/primitives/" + std::to_string(i);
            note_omissions(source_.primitives[i]);
            if (has_triangles(source_.primitives[i])) add(source_.primitives[i]);
        }
        LoadedMesh loaded;
        loaded.joints = used_joints_;
        if (influences_ > 0 || !rest_.targets.empty()) loaded.rest = finish_rest();
        loaded.mesh = std::move(mesh_);
        return loaded;
    }

private:
    // Growing by doubling would cost as much again as the mesh itself. Primitives may share their accessors, so that a
    // small file can ask for more than any machine has: that is found here, before memory is taken.
    void reserve() {
        uint64_t vertices = 0;
        uint64_t triangles = 0;
        for (const tinygltf::Primitive& primitive : source_.primitives) {
            const int positions = attribute(primitive, "POSITION");
            if (!has_triangles(primitive) || positions == MISSING) continue;
            const uint64_t count = accessor_count(document_, positions);
            const uint64_t corners = primitive.indices >= 0 ? accessor_count(document_, primitive.indices) : count;
            const uint64_t own = triangle_count(primitive.mode, corners);
            triangles += own;
            vertices += attribute(primitive, "NORMAL") == MISSING ? 3 * own : count;
        }
        const uint64_t deforming = rest_.targets.size() * 3 * sizeof(glm::vec3) + influences_ * 6;
        document_.take_memory(vertices * (2 * sizeof(glm::vec3) + deforming) + triangles * sizeof(glm::uvec4),
                              mesh_place_);
        constexpr uint64_t WORTH_IT = 1 << 16;
        if (vertices < WORTH_IT && triangles < WORTH_IT) return;
        mesh_.positions.reserve(vertices);
        mesh_.normals.reserve(vertices);
        mesh_.triangles.reserve(triangles);
    }

    void note_omissions(const tinygltf::Primitive& primitive) {
        Omissions& omissions = document_.omissions;
        if (primitive.mode == TINYGLTF_MODE_POINTS) omissions.add("points", place_);
        if (!has_triangles(primitive) && primitive.mode != TINYGLTF_MODE_POINTS) omissions.add("lines", place_);
        if (attribute(primitive, "COLOR_0") != MISSING && is_unlit(primitive)) {
            omissions.add("vertex colours of unlit materials", mesh_place_);
        }
        if (attribute(primitive, "COLOR_1") != MISSING) omissions.add("more than one set of colours", mesh_place_);
        if (has_triangles(primitive) && lacks_coordinates(primitive))
            omissions.add("textures whose coordinates a mesh does not have, but for one texel", mesh_place_);
    }

    // Whether some texture of its material goes by a set of coordinates that the file does not have.
    bool lacks_coordinates(const tinygltf::Primitive& primitive) const {
        const uint32_t id = material_of(document_, primitive);
        const CoreMaterial& material = scene_.materials()[id].core;
        return std::any_of(std::begin(kTextureSlots), std::end(kTextureSlots), [&](const auto member) {
            const CoreTextureSlot& slot = material.*member;
            if (slot.texture == NONE) return false;
            const int set = document_.uv_sets[id][slot.uv_set];
            return attribute(primitive, "TEXCOORD_" + std::to_string(set)) == MISSING;
        });
    }

    bool is_unlit(const tinygltf::Primitive& primitive) const {
        const uint32_t material = material_of(document_, primitive);
        return material < document_.model.materials.size() &&
               document_.model.materials[material].extensions.contains("KHR_materials_unlit");
    }

    void add(const tinygltf::Primitive& primitive) {
        const int positions = attribute(primitive, "POSITION");
        if (positions == MISSING) fail_at(place_, "has no POSITION" + EXPORT_AGAIN);
        first_vertex_ = mesh_.positions.size();
        first_triangle_ = mesh_.triangles.size();
        append_vectors(document_, positions, true, mesh_.positions);
        if (mesh_.positions.size() >= NONE) fail_at(place_, "the mesh has more than 2^32 vertices; split it");
        origins_.resize(mesh_.positions.size() - first_vertex_);
        std::iota(origins_.begin(), origins_.end(), 0u);
        const bool flat = attribute(primitive, "NORMAL") == MISSING;
        // Tangents without normals mean nothing (glTF 2.0, 3.7.2.1).
        const bool has_tangents = !flat && attribute(primitive, "TANGENT") != MISSING;
        add_attribute(primitive, "NORMAL", mesh_.normals);
        add_attribute(primitive, has_tangents ? "TANGENT" : "", mesh_.tangents);
        const std::array<int, 4>& uv_sets = document_.uv_sets[material_of(document_, primitive)];
        for (size_t i = 0; i < uv_sets.size(); ++i) add_coordinates(primitive, uv_sets[i], mesh_.*kUvSets[i]);
        add_colors(primitive);
        add_triangles(primitive);
        if (flat)
            make_flat();
        else
            repair_normals();
        make_tangents(primitive, has_tangents);
        add_influences(primitive);
        add_targets(primitive, has_tangents);
        if (flat)
            rest_.flat.push_back(
                {static_cast<uint32_t>(first_triangle_), static_cast<uint32_t>(mesh_.triangles.size())});
        const size_t vertices = mesh_.positions.size();
        if (!mesh_.tangents.empty()) mesh_.tangents.resize(vertices, glm::vec4(0.0f));
        for (const auto set : kUvSets) {
            if (!(mesh_.*set).empty()) (mesh_.*set).resize(vertices, glm::vec2(0.0f));
        }
        if (!mesh_.colors.empty()) mesh_.colors.resize(vertices, glm::vec4(1.0f));
    }

    // An array that one primitive of a mesh has, all of them get: filled with `T(0)` for those before.
    template <class T>
    void add_attribute(const tinygltf::Primitive& primitive, const std::string& name, std::vector<T>& array) {
        const int accessor = attribute(primitive, name);
        if (accessor != MISSING) {
            check_count(name, accessor);
            array.resize(first_vertex_, T(0.0f));
            append_vectors(document_, accessor, true, array);
        } else if (!array.empty()) {
            array.resize(mesh_.positions.size(), T(0.0f));
        }
    }

    // Those of the file's number, if the material reads any (-1: none).
    void add_coordinates(const tinygltf::Primitive& primitive, int set, std::vector<glm::vec2>& array) {
        const std::string name = set < 0 ? "" : "TEXCOORD_" + std::to_string(set);
        add_attribute(primitive, name, array);
        if (within_texture(array)) return;
        fail_at(place_ + "/attributes/" + name, "holds a texture coordinate past 1e8" + EXPORT_AGAIN);
    }

    void add_colors(const tinygltf::Primitive& primitive) {
        constexpr glm::vec4 WHITE(1.0f);
        const int accessor = attribute(primitive, "COLOR_0");
        if (accessor != MISSING) {
            check_count("COLOR_0", accessor);
            mesh_.colors.resize(first_vertex_, WHITE);
            append_colors(document_, accessor, mesh_.colors);
        } else if (!mesh_.colors.empty()) {
            mesh_.colors.resize(mesh_.positions.size(), WHITE);
        }
    }

    // Of an attribute of the primitive's, before vertices are made apart.
    void check_count(const std::string& name, int accessor) const {
        check_count(place_ + "/attributes/" + name, accessor, mesh_.positions.size() - first_vertex_);
    }

    void check_count(const std::string& place, int accessor, uint64_t vertices) const {
        const uint64_t count = accessor_count(document_, accessor);
        if (count == vertices) return;
        fail_at(place, "has " + std::to_string(count) + " elements for " + std::to_string(vertices) + " positions" +
                           EXPORT_AGAIN);
    }

    void add_triangles(const tinygltf::Primitive& primitive) {
        const uint32_t material = material_of(document_, primitive);
        const uint32_t base = static_cast<uint32_t>(first_vertex_);
        const uint64_t vertices = mesh_.positions.size() - first_vertex_;
        std::vector<uint32_t> indices;
        if (primitive.indices >= 0) {
            indices = read_indices(document_, primitive.indices);
            check_indices(indices, vertices);
        }
        const uint64_t corners = primitive.indices >= 0 ? indices.size() : vertices;
        const uint64_t count = triangle_count(primitive.mode, corners);
        if (corners > NONE || mesh_.triangles.size() + count >= NONE) {
            fail_at(place_, "the mesh has more than 2^32 corners; split it");
        }
        if (primitive.mode == TINYGLTF_MODE_TRIANGLES ? corners % 3 != 0 : corners < 3) {
            document_.omissions.add("corners that make no whole triangle", place_);
        }
        for (uint32_t i = 0; i < count; ++i) {
            glm::uvec3 t = corners_of(primitive.mode, i);
            if (primitive.indices >= 0) t = {indices[t.x], indices[t.y], indices[t.z]};
            mesh_.triangles.emplace_back(base + t.x, base + t.y, base + t.z, material);
        }
    }

    void check_indices(const std::vector<uint32_t>& indices, uint64_t vertices) const {
        for (size_t i = 0; i < indices.size(); ++i) {
            if (indices[i] < vertices) continue;
            fail_at(place_ + "/indices", "index " + std::to_string(indices[i]) + " (at " + std::to_string(i) +
                                             ") is past the " + std::to_string(vertices) + " vertices" + EXPORT_AGAIN);
        }
    }

    // glTF 2.0, 3.7.2.1: without normals each triangle is flat, which gives it vertices of its own.
    void make_flat() {
        const size_t corners = (mesh_.triangles.size() - first_triangle_) * 3;
        if (first_vertex_ + corners >= NONE) fail_at(place_, "has too many triangles for flat normals; split it");
        unshare(mesh_.positions);
        unshare(mesh_.tangents);
        for (const auto set : kUvSets) unshare(mesh_.*set);
        unshare(mesh_.colors);
        unshare_origins();
        mesh_.normals.resize(first_vertex_, glm::vec3(0.0f, 0.0f, 1.0f));
        uint32_t next = static_cast<uint32_t>(first_vertex_);
        for (size_t i = first_triangle_; i < mesh_.triangles.size(); ++i, next += 3) {
            mesh_.triangles[i] = {next, next + 1, next + 2, mesh_.triangles[i].w};
            const glm::vec3 normal =
                flat_normal(mesh_.positions[next], mesh_.positions[next + 1], mesh_.positions[next + 2]);
            mesh_.normals.insert(mesh_.normals.end(), 3, normal);
        }
    }

    template <class T>
    void unshare(std::vector<T>& array) {
        if (array.empty()) return;
        const std::vector<T> shared(array.begin() + static_cast<std::ptrdiff_t>(first_vertex_), array.end());
        array.resize(first_vertex_);
        for (size_t i = first_triangle_; i < mesh_.triangles.size(); ++i) {
            for (int c = 0; c < 3; ++c) array.push_back(shared[mesh_.triangles[i][c] - first_vertex_]);
        }
    }

    void unshare_origins() {
        std::vector<uint32_t> unshared;
        for (size_t i = first_triangle_; i < mesh_.triangles.size(); ++i) {
            for (int c = 0; c < 3; ++c) unshared.push_back(origins_[mesh_.triangles[i][c] - first_vertex_]);
        }
        origins_ = std::move(unshared);
    }

    // Normals to unit length; where a file has none (0, 0, 0), that of a triangle of the vertex.
    void repair_normals() {
        std::vector<bool> broken;
        for (size_t i = first_vertex_; i < mesh_.normals.size(); ++i) {
            const float size = glm::length(mesh_.normals[i]);
            const bool good = size > 0.0f && std::isfinite(size);
            // Lengths within rounding are left alone, so that exporters' bits survive.
            if (good && std::abs(size - 1.0f) > 1e-3f) mesh_.normals[i] /= size;
            if (good) continue;
            broken.resize(mesh_.normals.size(), false);
            broken[i] = true;
            mesh_.normals[i] = glm::vec3(0.0f, 0.0f, 1.0f);
        }
        if (broken.empty()) return;
        document_.omissions.add("normals of no length, which were made anew", place_);
        for (size_t i = first_triangle_; i < mesh_.triangles.size(); ++i) {
            const glm::uvec4& t = mesh_.triangles[i];
            for (int c = 0; c < 3; ++c) {
                if (!broken[t[c]]) continue;
                mesh_.normals[t[c]] = flat_normal(mesh_.positions[t.x], mesh_.positions[t.y], mesh_.positions[t.z]);
            }
        }
    }

    // Only a normal map and anisotropy need tangents. Those of the file are taken as they are, made to be of unit
    // length.
    void make_tangents(const tinygltf::Primitive& primitive, bool given) {
        const CoreMaterial& material = scene_.materials()[material_of(document_, primitive)].core;
        const bool bent = material.normal_texture.texture != NONE;
        const bool stretched = material.anisotropy > 0.0f || material.anisotropy_texture.texture != NONE;
        const CoreTextureSlot& slot = bent        ? material.normal_texture
                                      : stretched ? material.anisotropy_texture
                                                  : material.coat_normal_texture;
        if (given) {
            for (size_t i = first_vertex_; i < mesh_.tangents.size(); ++i) {
                glm::vec4& tangent = mesh_.tangents[i];
                const float size = glm::length(glm::vec3(tangent));
                const glm::vec3 direction =
                    size > 0.0f && std::isfinite(size) ? glm::vec3(tangent) / size : any_tangent(mesh_.normals[i]);
                tangent = glm::vec4(direction, tangent.w < 0.0f ? -1.0f : 1.0f);
            }
        } else if (slot.texture != NONE || stretched) {
            mesh_.tangents.resize(first_vertex_);
            mesh_.tangents.resize(mesh_.positions.size(), glm::vec4(0.0f));
            for (const uint32_t split : generate_tangents(mesh_, first_vertex_, first_triangle_, slot))
                origins_.push_back(uint32_t{origins_[split - first_vertex_]});
        }
    }

    // Joints at a vertex, of all primitives with triangles; 0 where none has any.
    static uint32_t influences_of(const tinygltf::Mesh& mesh) {
        uint32_t most = 0;
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            uint32_t sets = 0;
            while (has_triangles(primitive) && attribute(primitive, "JOINTS_" + std::to_string(sets)) != MISSING)
                ++sets;
            most = std::max(most, 4 * sets);
        }
        return most;
    }

    uint64_t file_vertices(const tinygltf::Primitive& primitive) const {
        return accessor_count(document_, attribute(primitive, "POSITION"));
    }

    void add_influences(const tinygltf::Primitive& primitive) {
        if (influences_ == 0) return;
        const size_t first = first_vertex_ * influences_;
        rest_.joints.resize(mesh_.positions.size() * influences_, 0);
        rest_.weights.resize(mesh_.positions.size() * influences_, 0.0f);
        for (uint32_t set = 0; set < influences_ / 4; ++set) {
            const std::string number = std::to_string(set);
            const int joints = attribute(primitive, "JOINTS_" + number);
            const int weights = attribute(primitive, "WEIGHTS_" + number);
            if (joints == MISSING) break;
            if (weights == MISSING)
                fail_at(place_, "has JOINTS_" + number + ", but no WEIGHTS_" + number + EXPORT_AGAIN);
            read_influences(primitive, joints, weights, number, first + 4 * set);
        }
        for (size_t vertex = first_vertex_; vertex < mesh_.positions.size(); ++vertex) even_out(vertex);
    }

    // One set of 4 of each vertex, to every `influences_`-th place from `at` on.
    void read_influences(const tinygltf::Primitive& primitive, int joints, int weights, const std::string& number,
                         size_t at) {
        const uint64_t count = file_vertices(primitive);
        const std::string joints_place = place_ + "/attributes/JOINTS_" + number;
        const std::string weights_place = place_ + "/attributes/WEIGHTS_" + number;
        check_count(joints_place, joints, count);
        check_count(weights_place, weights, count);
        const int type = document_.model.accessors[static_cast<size_t>(joints)].componentType;
        if (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE && type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT)
            fail_at(joints_place, "must hold unsigned bytes or shorts" + EXPORT_AGAIN);
        const std::vector<float> numbers = read_floats(document_, joints, 4),
                                 pulls = read_floats(document_, weights, 4);
        for (size_t i = 0; i < origins_.size(); ++i, at += influences_) {
            for (size_t c = 0; c < 4; ++c) {
                const float pull = pulls[origins_[i] * size_t{4} + c];
                if (!(pull >= 0.0f))
                    fail_at(weights_place, "vertex " + std::to_string(origins_[i]) + " has a weight of " +
                                               std::to_string(pull) + "; weights are not negative" + EXPORT_AGAIN);
                rest_.weights[at + c] = pull;
                rest_.joints[at + c] = static_cast<uint16_t>(numbers[origins_[i] * size_t{4} + c]);
                used_joints_ = std::max(used_joints_, uint32_t{rest_.joints[at + c]} + 1);
            }
        }
    }

    // glTF 2.0, 3.7.3.3: the weights of a vertex add up to 1. Where they do not, they are made to.
    void even_out(size_t vertex) {
        constexpr float kRounding = 2e-3f;  // half a step of bytes, four times
        float* const weights = &rest_.weights[vertex * influences_];
        float sum = 0.0f;
        for (uint32_t i = 0; i < influences_; ++i) sum += weights[i];
        if (!(std::abs(sum - 1.0f) <= kRounding))
            document_.mended.add("weights of joints that do not add up to 1, which were made to", place_);
        if (!std::isfinite(sum)) {  // of finite numbers: shares of them add up
            sum = 0.0f;
            for (uint32_t i = 0; i < influences_; ++i) sum += weights[i] /= static_cast<float>(influences_ + 1);
        }
        if (!(sum > 0.0f)) weights[0] = sum = 1.0f;
        for (uint32_t i = 0; i < influences_ && sum != 1.0f; ++i) weights[i] /= sum;
    }

    void add_targets(const tinygltf::Primitive& primitive, bool has_tangents) {
        for (size_t i = 0; i < primitive.targets.size(); ++i) {
            MorphTarget& target = rest_.targets[i];
            const std::string place = place_ + "/targets/" + std::to_string(i);
            for (const auto& [name, accessor] : primitive.targets[i]) {
                if (name == "POSITION")
                    add_offsets(primitive, place, name, accessor, target.positions);
                else if (name == "NORMAL")
                    add_offsets(primitive, place, name, accessor, target.normals);
                else if (name != "TANGENT")
                    document_.omissions.add("morphed colours and texture coordinates", mesh_place_);
                else if (has_tangents)
                    add_offsets(primitive, place, name, accessor, target.tangents);
            }
        }
    }

    void add_offsets(const tinygltf::Primitive& primitive, const std::string& place, const std::string& name,
                     int accessor, std::vector<glm::vec3>& offsets) {
        check_count(place + "/" + name, accessor, file_vertices(primitive));
        std::vector<glm::vec3> read;
        append_vectors(document_, accessor, true, read);
        offsets.resize(first_vertex_, glm::vec3(0.0f));
        for (const uint32_t origin : origins_) offsets.push_back(read[origin]);
    }

    std::shared_ptr<const RestMesh> finish_rest() {
        rest_.positions = mesh_.positions;
        rest_.normals = mesh_.normals;
        rest_.tangents = mesh_.tangents;
        rest_.influences = influences_;
        for (MorphTarget& target : rest_.targets) {
            for (std::vector<glm::vec3>* offsets : {&target.positions, &target.normals, &target.tangents}) {
                if (!offsets->empty()) offsets->resize(mesh_.positions.size(), glm::vec3(0.0f));
            }
        }
        return std::make_shared<const RestMesh>(std::move(rest_));
    }

    GltfDocument& document_;
    const tinygltf::Mesh& source_;
    const HostScene& scene_;
    std::string mesh_place_;
    std::string place_;
    HostMesh mesh_;
    RestMesh rest_;
    uint32_t influences_ = 0;  // joints at a vertex
    uint32_t used_joints_ = 0;
    std::vector<uint32_t> origins_;  // of the primitive's vertices: which of the file's each one is
    size_t first_vertex_ = 0;        // of the primitive at hand
    size_t first_triangle_ = 0;      // of the primitive at hand
};

}  // namespace

std::vector<bool> used_materials(const GltfDocument& document, const std::vector<int>& meshes) {
    std::vector<bool> used(document.model.materials.size() + 1, false);
    for (int mesh : meshes) {
        for (const tinygltf::Primitive& primitive : document.model.meshes[static_cast<size_t>(mesh)].primitives) {
            if (has_triangles(primitive)) used[material_of(document, primitive)] = true;
        }
    }
    return used;
}

LoadedMesh read_mesh(GltfDocument& document, int mesh, bool skinned, const HostScene& scene) {
    return MeshReader(document, mesh, skinned, scene).read();
}

}  // namespace render_system
