// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <map>
#include <new>
#include <string>
#include <unordered_set>
#include <vector>

#include "render_system/loader/gltf_document.h"
#include "render_system/loader/gltf_instancing.h"
#include "render_system/loader/gltf_materials.h"
#include "render_system/loader/gltf_meshes.h"
#include "render_system/loader/load_error.h"
#include "render_system/scene_limits.h"
#include "render_system/scene_loader.h"

namespace render_system {

namespace {

constexpr double HALF_PI = 1.57079632679489662;

std::string node_place(int node) { return "/nodes/" + std::to_string(node); }

// glTF 2.0, 3.5.3: a matrix by columns, or T * R * S.
glm::dmat4 local_transform(const tinygltf::Node& node, const std::string& place) {
    glm::dmat4 matrix(1.0);
    if (!node.matrix.empty()) {
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<size_t>(i)];
        if (matrix[0][3] != 0.0 || matrix[1][3] != 0.0 || matrix[2][3] != 0.0 || matrix[3][3] != 1.0) {
            fail_at(place + "/matrix", "its last row is not 0 0 0 1" + EXPORT_AGAIN);
        }
        return matrix;
    }
    if (!node.rotation.empty()) {
        const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
        if (!(glm::length(rotation) > 0.0)) fail_at(place + "/rotation", "has no length" + EXPORT_AGAIN);
        matrix = glm::mat4_cast(glm::normalize(rotation));
    }
    for (int i = 0; i < 3 && !node.scale.empty(); ++i) matrix[i] *= node.scale[static_cast<size_t>(i)];
    for (int i = 0; i < 3 && !node.translation.empty(); ++i) matrix[3][i] = node.translation[static_cast<size_t>(i)];
    return matrix;
}

struct PlacedNode {
    int node = -1;
    uint32_t parent = NONE;  // into the list of placed nodes
    glm::dmat4 world{1.0};
    bool visible = true;
};

// KHR_node_visibility: a node that is not hides all below it.
bool is_shown(const tinygltf::Node& node) {
    const auto found = node.extensions.find("KHR_node_visibility");
    return found == node.extensions.end() || !found->second.Has("visible") || found->second.Get("visible").Get<bool>();
}

bool is_finite(const glm::dmat4& matrix) {
    for (int i = 0; i < 12; ++i) {
        if (!std::isfinite(static_cast<float>(matrix[i / 3][i % 3]))) return false;
    }
    return true;
}

// The nodes of the scene to show, parents first. Refuses what is not a tree.
std::vector<PlacedNode> place_nodes(const tinygltf::Model& model) {
    std::vector<PlacedNode> placed;
    const size_t shown = model.defaultScene >= 0 ? static_cast<size_t>(model.defaultScene) : 0;
    std::vector<bool> seen(model.nodes.size(), false);
    const auto place = [&](int node, uint32_t parent) {
        if (seen[static_cast<size_t>(node)]) {
            fail_at(node_place(node), "is reached twice: nodes must form a tree, without cycles" + EXPORT_AGAIN);
        }
        seen[static_cast<size_t>(node)] = true;
        PlacedNode entry{node, parent, local_transform(model.nodes[static_cast<size_t>(node)], node_place(node))};
        if (parent != NONE) entry.world = placed[parent].world * entry.world;
        entry.visible = is_shown(model.nodes[static_cast<size_t>(node)]) && (parent == NONE || placed[parent].visible);
        if (!is_finite(entry.world)) {
            fail_at(node_place(node), "its transform is past the range of a float" + EXPORT_AGAIN);
        }
        placed.push_back(entry);
    };
    for (int root : model.scenes[shown].nodes) place(root, NONE);
    for (uint32_t i = 0; i < placed.size(); ++i) {
        for (int child : model.nodes[static_cast<size_t>(placed[i].node)].children) place(child, i);
    }
    return placed;
}

// A matrix that flattens everything leaves no normals, and no way back from world to object space.
bool is_scaled_to_nothing(const CoreTransform& world) {
    // What is not invertible for being too large is none of this.
    constexpr float LARGE = 1e9f;
    for (const glm::vec4& row : world.rows) {
        if (!(largest_coordinate(glm::vec3(row)) <= static_cast<double>(LARGE))) return false;
    }
    return !is_invertible(world);
}

class SceneReader {
public:
    SceneReader(const std::filesystem::path& path, const LoadOptions& options)
        : document_(open_gltf(path, options.allow_outside ? Reach::anywhere : Reach::folder, options.variant)) {}

    LoadedScene read() {
        if (document_.model.scenes.empty()) {
            fail_at("/scenes", "there is no scene, so nothing to show; export the file with one");
        }
        nodes_ = place_nodes(document_.model);
        check_copies();
        add_meshes();
        // What a node carries is numbered by node, whatever the order of the hierarchy.
        std::vector<size_t> order(nodes_.size());
        for (size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::sort(order.begin(), order.end(), [&](size_t a, size_t b) { return nodes_[a].node < nodes_[b].node; });
        std::vector<HostNode> host_nodes(nodes_.size());  // in the hierarchy's order
        for (size_t i : order) host_nodes[i] = carry(nodes_[i]);
        for (HostNode& node : host_nodes) scene().add_node(std::move(node));
        for (size_t i : order) add_copies(static_cast<uint32_t>(i));
        if (scene().triangle_count() == 0) {
            if (first_hidden_ >= 0) {
                fail_at(node_place(first_hidden_),
                        "its mesh is scaled to nothing, and the scene has no other; scale it up");
            }
            fail_at("", "the scene has no triangles; name a file with a mesh in its scene");
        }
        if (document_.sky) scene().set_sky(std::move(*document_.sky));
        write_warnings();
        return std::move(loaded_);
    }

private:
    HostScene& scene() { return loaded_.scene; }

    const tinygltf::Node& source(const PlacedNode& placed) const {
        return document_.model.nodes[static_cast<size_t>(placed.node)];
    }

    void add_meshes() {
        std::map<int, uint32_t> used;
        for (const PlacedNode& node : nodes_) {
            if (source(node).mesh >= 0 && node.visible) used.emplace(source(node).mesh, 0);
        }
        std::vector<int> meshes;
        for (const auto& entry : used) meshes.push_back(entry.first);
        add_materials(document_, used_materials(document_, meshes), scene());
        constexpr size_t RELEASE_AFTER = size_t{1} << 26;
        size_t triangles = 0;
        for (int mesh : meshes) {
            HostMesh host = read_mesh(document_, mesh, scene());
            if (host.triangles.empty()) continue;
            triangles += host.triangles.size();
            mesh_ids_[mesh] = scene().add_mesh(std::move(host));
            if (triangles * sizeof(glm::uvec4) < RELEASE_AFTER) continue;
            document_.release_pages();
            triangles = 0;
        }
    }

    HostNode carry(const PlacedNode& placed) {
        const tinygltf::Node& node = source(placed);
        HostNode host;
        host.name = node.name;
        host.parent = placed.parent;
        host.local = local_transform(node, node_place(placed.node));
        const auto mesh = mesh_ids_.find(node.mesh);
        if (mesh != mesh_ids_.end() && placed.visible && !instancing_of(node)) {
            host.instance = add_instance(placed.node, mesh->second, placed.world);
        }
        if (node.camera >= 0) host.camera = add_camera(placed.node, node.camera);
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light != node.extensions.end() && placed.visible) {
            host.light = add_light(light->second.Get("light").GetNumberAsInt());
            fail_unless(check_light_position(glm::vec3(placed.world[3])), node_place(placed.node));
        }
        return host;
    }

    uint32_t add_instance(int node, uint32_t mesh, const glm::dmat4& world) {
        const CoreTransform transform = core_transform(world);
        const bool hidden = is_scaled_to_nothing(transform);
        if (hidden && first_hidden_ < 0) first_hidden_ = node;
        if (hidden)
            document_.omissions.add("instances scaled to nothing", node_place(node));
        else
            check_instance(node, mesh, transform);
        return scene().add_instance(hidden ? NONE : mesh, transform);
    }

    void check_copies() const {
        uint64_t total = 0;
        for (const PlacedNode& placed : nodes_) {
            const tinygltf::Value* instancing = instancing_of(source(placed));
            if (instancing) total += instance_count(document_, *instancing, node_place(placed.node));
        }
        check_instance_total(total);
    }

    // EXT_mesh_gpu_instancing: the node's mesh once for each element of the attributes, as a child of the node.
    void add_copies(uint32_t parent) {
        const PlacedNode& placed = nodes_[parent];
        const tinygltf::Value* instancing = instancing_of(source(placed));
        const auto mesh = mesh_ids_.find(source(placed).mesh);
        if (!instancing || !placed.visible || mesh == mesh_ids_.end()) return;
        std::unordered_set<std::string> places;
        for (const glm::dmat4& local : instance_transforms(document_, *instancing, node_place(placed.node))) {
            HostNode copy;
            copy.parent = parent;
            copy.local = local;
            const glm::dmat4 world = placed.world * local;
            if (!is_finite(world)) {
                fail_at(node_place(placed.node), "an instance's transform is past the range of a float" + EXPORT_AGAIN);
            }
            const CoreTransform transform = core_transform(world);
            if (!places.emplace(reinterpret_cast<const char*>(&transform), sizeof(transform)).second) {
                // Every ray there would look at them all.
                document_.omissions.add("instances in the place of another", node_place(placed.node));
                copy.instance = scene().add_instance(NONE, transform);
            } else {
                copy.instance = add_instance(placed.node, mesh->second, world);
            }
            scene().add_node(std::move(copy));
        }
    }

    static void fail_unless(const Status& status, const std::string& place) {
        if (!status.ok()) fail_at(place, status.message);
    }

    void check_instance(int node, uint32_t mesh, const CoreTransform& transform) {
        const std::string place = node_place(node) + mesh_name(scene(), mesh);
        if (!is_invertible(transform)) fail_at(place, "its transform is too large for floats; scale the scene down");
        const Placement placement = placement_of(scene().mesh_box(mesh), transform);
        fail_unless(check_placement(placement), place);
        fail_unless(check_rays_into(placement, placement.reach), place);
    }

    uint32_t add_camera(int node, int index) {
        const tinygltf::Camera& source = document_.model.cameras[static_cast<size_t>(index)];
        const std::string place = "/cameras/" + std::to_string(index);
        HostCamera camera;
        const std::string& node_name = document_.model.nodes[static_cast<size_t>(node)].name;
        camera.name = node_name.empty() ? source.name : node_name;
        if (source.type == "orthographic") {
            camera.camera.parallel_height = 2.0f * std::abs(static_cast<float>(source.orthographic.ymag));
            fail_unless(check_camera(camera.camera), place);
            if (!(camera.camera.parallel_height > 0.0f))
                fail_at(place + "/orthographic/ymag", "must not be 0" + EXPORT_AGAIN);
            return scene().add_camera(std::move(camera));
        }
        if (!(source.perspective.yfov > 0.0 && source.perspective.yfov < 2.0 * HALF_PI)) {
            fail_at(place + "/perspective/yfov", "must be between 0 and pi" + EXPORT_AGAIN);
        }
        camera.camera.vertical_fov = static_cast<float>(source.perspective.yfov);
        return scene().add_camera(std::move(camera));
    }

    uint32_t add_light(int index) {
        const tinygltf::Light& source = document_.model.lights[static_cast<size_t>(index)];
        const std::string place = "/extensions/KHR_lights_punctual/lights/" + std::to_string(index);
        PunctualLight light;
        light.name = source.name;
        for (size_t i = 0; i < 3; ++i) {
            const double color = source.color.size() == 3 ? source.color[i] : 1.0;
            const float emission = static_cast<float>(color * source.intensity);
            light.emission[static_cast<int>(i)] = emission;
        }
        if (!is_light(light.emission))
            fail_at(place, "its colour times intensity is not a number of at least 0 and at most 1e12" + EXPORT_AGAIN);
        if (source.type == "directional") light.kind = LightKind::directional;
        if (source.type == "spot") {
            light.kind = LightKind::spot;
            const double inner = source.spot.innerConeAngle, outer = source.spot.outerConeAngle;
            if (!(inner >= 0.0 && inner <= outer && outer <= HALF_PI + 1e-6)) {
                fail_at(place + "/spot", "needs 0 <= innerConeAngle <= outerConeAngle <= pi / 2" + EXPORT_AGAIN);
            }
            light.inner_cone = static_cast<float>(inner);
            light.outer_cone = static_cast<float>(outer);
        }
        if (source.range > 0.0) document_.omissions.add("ranges of lights", place);
        return scene().add_punctual_light(std::move(light));
    }

    void write_warnings() {
        const std::string file = document_.path.string() + ": ";
        if (!document_.omissions.empty()) {
            loaded_.warnings.push_back(file + "not supported and left out: " + document_.omissions.text());
        }
        if (!document_.unread_images.empty()) loaded_.warnings.push_back(file + unread_images_text());
    }

    // The first with its reason; more are counted.
    std::string unread_images_text() const {
        const std::vector<UnreadImage>& images = document_.unread_images;
        const std::string first = images[0].place + ": " + images[0].why;
        if (images.size() == 1) return first;
        Omissions others;
        const std::string what = std::to_string(images.size() - 1) + " more cannot be read";
        for (size_t i = 1; i < images.size(); ++i) others.add(what, images[i].place);
        return first + "; " + others.text();
    }

    GltfDocument document_;
    LoadedScene loaded_;
    std::vector<PlacedNode> nodes_;
    std::map<int, uint32_t> mesh_ids_;
    int first_hidden_ = -1;  // the first node whose mesh is scaled to nothing
};

}  // namespace

Result<LoadedScene> load_scene(const std::filesystem::path& path, const LoadOptions& options) {
    try {
        return SceneReader(path, options).read();
    } catch (const LoadError& error) {
        return Status::error(error.code, path.string() + ": " + error.message);
    } catch (const std::bad_alloc&) {
        return Status::error(StatusCode::unreadable, path.string() + ": the scene does not fit this machine's memory");
    } catch (const std::exception& error) {
        // tinygltf and OpenImageIO may throw of their own.
        return Status::error(StatusCode::unreadable, path.string() + ": cannot be read (" + error.what() + ")");
    }
}

}  // namespace render_system
