// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "render_system/animation/animation.h"
#include "render_system/loader/gltf_animations.h"
#include "render_system/loader/gltf_document.h"
#include "render_system/loader/gltf_instancing.h"
#include "render_system/loader/gltf_materials.h"
#include "render_system/loader/gltf_meshes.h"
#include "render_system/loader/gltf_skins.h"
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
    const NodePose pose = pose_of(node);
    if (!(glm::length(pose.rotation) > 0.0)) fail_at(place + "/rotation", "has no length" + EXPORT_AGAIN);
    return pose_matrix(pose);
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

class SceneReader {
public:
    SceneReader(const std::filesystem::path& path, const LoadOptions& options)
        : document_(open_gltf(path, options.allow_outside ? Reach::anywhere : Reach::folder, options.variant)),
          time_(options.time) {
        choose_animation(document_, options.animation);
    }

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
        for (size_t i : order) add_deformers(static_cast<uint32_t>(i));
        scene().set_animation(read_animation(document_, parts_, scene()));
        if (Status status = scene().play(time_); !status.ok()) fail_at("", status.message + EXPORT_AGAIN);
        check_hidden();
        check_moved();
        if (document_.sky) scene().set_sky(std::move(*document_.sky));
        write_warnings();
        loaded_.files = std::move(document_.files);
        return std::move(loaded_);
    }

private:
    HostScene& scene() { return loaded_.scene; }

    const tinygltf::Node& source(const PlacedNode& placed) const {
        return document_.model.nodes[static_cast<size_t>(placed.node)];
    }

    void add_meshes() {
        std::map<int, bool> used;  // whether a skin hangs on it
        for (size_t i = 0; i < nodes_.size(); ++i) {
            placed_as_[nodes_[i].node] = static_cast<uint32_t>(i);
            const tinygltf::Node& node = source(nodes_[i]);
            if (node.mesh >= 0 && nodes_[i].visible) used[node.mesh] |= node.skin >= 0;
        }
        std::vector<int> meshes;
        for (const auto& entry : used) meshes.push_back(entry.first);
        add_materials(document_, used_materials(document_, meshes), scene());
        constexpr size_t RELEASE_AFTER = size_t{1} << 26;
        size_t triangles = 0;
        for (int mesh : meshes) {
            LoadedMesh loaded = read_mesh(document_, mesh, used[mesh], scene());
            if (loaded.mesh.triangles.empty()) continue;
            triangles += loaded.mesh.triangles.size();
            if (!loaded.rest) fixed_meshes_[{mesh, {}}] = scene().add_mesh(std::move(loaded.mesh));
            meshes_.emplace(mesh, std::move(loaded));
            if (triangles * sizeof(glm::uvec4) < RELEASE_AFTER) continue;
            document_.release_pages();
            triangles = 0;
        }
        moving_weights_ = nodes_with_animated_weights(document_);
    }

    // What a node shows: the scene's mesh, and what deforms it.
    struct Shown {
        uint32_t mesh = NONE;
        bool deforms = false;
        bool skinned = false;
        std::vector<double> weights;
    };

    Shown show(const PlacedNode& placed) {
        const tinygltf::Node& node = source(placed);
        Shown shown;
        const auto found = meshes_.find(node.mesh);
        if (found == meshes_.end() || !placed.visible) return shown;
        const LoadedMesh& loaded = found->second;
        shown.weights = weights_of(placed, loaded);
        shown.skinned = node.skin >= 0 && loaded.joints > 0 && !instancing_of(node);
        if (node.skin >= 0 && !shown.skinned)
            document_.omissions.add("skins of what has no joints", node_place(placed.node));
        if (shown.skinned) check_skin(placed.node, loaded);
        shown.deforms = shown.skinned || (!shown.weights.empty() && moving_weights_.contains(placed.node));
        shown.mesh = shown.deforms ? add_copy(loaded.mesh, placed.node) : fixed_mesh(node.mesh, loaded, shown.weights);
        return shown;
    }

    uint32_t add_copy(const HostMesh& mesh, int node) {
        document_.take_memory(mesh.positions.size() * 8 * sizeof(float) + mesh.triangles.size() * sizeof(glm::uvec4),
                              node_place(node));
        return scene().add_mesh(mesh);
    }

    // Of nodes that show a mesh in the same shape for good, one copy.
    uint32_t fixed_mesh(int number, const LoadedMesh& loaded, const std::vector<double>& weights) {
        const auto [entry, is_new] = fixed_meshes_.try_emplace({number, weights}, NONE);
        if (!is_new) return entry->second;
        HostMesh mesh = loaded.mesh;
        deform(*loaded.rest, weights, {}, mesh);
        return entry->second = scene().add_mesh(std::move(mesh));
    }

    // The node's own weights, else its mesh's, else none: of all morph targets.
    std::vector<double> weights_of(const PlacedNode& placed, const LoadedMesh& loaded) const {
        const size_t targets = loaded.rest ? loaded.rest->targets.size() : 0;
        const tinygltf::Node& node = source(placed);
        const bool own = !node.weights.empty();
        std::vector<double> weights =
            own ? node.weights : document_.model.meshes[static_cast<size_t>(node.mesh)].weights;
        if (weights.empty()) weights.assign(targets, 0.0);
        if (weights.size() != targets)
            fail_at((own ? node_place(placed.node) : "/meshes/" + std::to_string(node.mesh)) + "/weights",
                    "has " + std::to_string(weights.size()) + " numbers for " + std::to_string(targets) +
                        " morph targets" + EXPORT_AGAIN);
        return weights;
    }

    void check_skin(int node, const LoadedMesh& loaded) const {
        const int index = document_.model.nodes[static_cast<size_t>(node)].skin;
        const std::vector<int>& joints = document_.skins[static_cast<size_t>(index)].joints;
        if (loaded.joints > joints.size())
            fail_at(node_place(node) + "/skin", "has " + std::to_string(joints.size()) +
                                                    " joints, but the mesh names joint " +
                                                    std::to_string(loaded.joints - 1) + EXPORT_AGAIN);
        for (const int joint : joints) {
            if (placed_as_.contains(joint)) continue;
            fail_at("/skins/" + std::to_string(index) + "/joints",
                    "names node " + std::to_string(joint) + ", which is not in the scene" + EXPORT_AGAIN);
        }
    }

    // Joints and weights of what the node shows, once all nodes are placed.
    void add_deformers(uint32_t placed_index) {
        const PlacedNode& placed = nodes_[placed_index];
        parts_.nodes[placed.node] = placed_index;
        const auto found = deforming_.find(placed.node);
        if (found == deforming_.end()) return;
        const tinygltf::Node& node = source(placed);
        HostDeformer deformer{found->second.mesh, meshes_.at(node.mesh).rest, found->second.weights, nullptr};
        if (found->second.skinned) deformer.skin = skin_of(node.skin);
        parts_.deformers[placed.node].push_back(scene().add_deformer(std::move(deformer)));
    }

    std::shared_ptr<const Skin> skin_of(int index) {
        std::shared_ptr<const Skin>& known = skins_[index];
        if (known) return known;
        Skin skin;
        for (const int joint : document_.skins[static_cast<size_t>(index)].joints)
            skin.joints.push_back(placed_as_.at(joint));
        skin.inverse_binds = read_inverse_binds(document_, index);
        known = std::make_shared<const Skin>(std::move(skin));
        return known;
    }

    HostNode carry(const PlacedNode& placed) {
        const tinygltf::Node& node = source(placed);
        HostNode host;
        host.name = node.name;
        host.parent = placed.parent;
        host.local = local_transform(node, node_place(placed.node));
        if (!instancing_of(node)) carry_mesh(placed, host);
        if (node.camera >= 0) {
            host.camera = add_camera(placed.node, node.camera);
            parts_.cameras[node.camera].push_back(host.camera);
        }
        const auto light = node.extensions.find("KHR_lights_punctual");
        if (light != node.extensions.end() && placed.visible) {
            const int index = light->second.Get("light").GetNumberAsInt();
            host.light = add_light(index);
            parts_.lights[index].push_back(host.light);
            fail_unless(check_light_position(glm::vec3(placed.world[3])), node_place(placed.node));
        }
        return host;
    }

    // A skinned mesh stays where its joints bring it: the node's own place does not count (glTF 2.0, 3.7.3.3).
    void carry_mesh(const PlacedNode& placed, HostNode& host) {
        const Shown shown = show(placed);
        if (shown.mesh == NONE) return;
        if (shown.deforms) deforming_.emplace(placed.node, shown);
        if (shown.skinned) {
            scene().add_instance(shown.mesh, CoreTransform());
            return;
        }
        host.mesh = shown.mesh;
        host.instance = add_instance(placed.node, shown.mesh, placed.world);
    }

    // An instance that is scaled to nothing is hidden by the node that places it.
    uint32_t add_instance(int node, uint32_t mesh, const glm::dmat4& world) {
        const CoreTransform transform = core_transform(world);
        if (!is_scaled_to_nothing(transform)) check_instance(node, mesh, transform);
        return scene().add_instance(mesh, transform);
    }

    // Where joints and animations have brought what moves, which is known once all is placed.
    void check_moved() {
        for (const auto& [node, shown] : deforming_)
            if (shown.skinned) check_instance(node, shown.mesh, CoreTransform());
        if (!scene().is_animated()) return;
        for (const auto& [node, placed] : placed_as_) {
            const HostNode& host = scene().nodes()[placed];
            if (host.mesh == NONE) continue;
            const HostInstance& instance = scene().instances()[host.instance];
            if (instance.mesh != NONE) check_instance(node, instance.mesh, instance.transform);
        }
    }

    void check_hidden() {
        int first = -1;
        for (const auto& [node, placed] : placed_as_) {
            const HostNode& host = scene().nodes()[placed];
            if (host.mesh == NONE || scene().instances()[host.instance].mesh != NONE) continue;
            document_.omissions.add("instances scaled to nothing", node_place(node));
            if (first < 0) first = node;
        }
        if (hidden_copies_ >= 0) document_.omissions.add("instances scaled to nothing", node_place(hidden_copies_));
        if (scene().triangle_count() > 0) return;
        if (first >= 0 && scene().is_animated()) return;  // what is hidden now may be there later
        if (first < 0) first = hidden_copies_;
        if (first >= 0)
            fail_at(node_place(first), "its mesh is scaled to nothing, and the scene has no other; scale it up");
        fail_at("", "the scene has no triangles; name a file with a mesh in its scene");
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
        if (!instancing) return;
        const uint32_t mesh = show(placed).mesh;
        if (mesh == NONE) return;
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
                copy.mesh = mesh;
                copy.instance = add_instance(placed.node, mesh, world);
                if (is_scaled_to_nothing(transform) && hidden_copies_ < 0) hidden_copies_ = placed.node;
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
        if (!document_.mended.empty()) loaded_.warnings.push_back(file + "mended: " + document_.mended.text());
        if (!document_.unread_images.empty()) loaded_.warnings.push_back(file + unread_images_text());
        if (const std::string far_off = distance_text(); !far_off.empty()) loaded_.warnings.push_back(file + far_off);
    }

    // A ray leaves a surface by some steps that floats have there (docs/decisions/0024-surfaces-in-one-place.md).
    std::string distance_text() {
        constexpr float kLeastShare = 1.0f / 65536.0f;
        const Box box = scene().bounds();
        if (box.empty()) return "";
        const glm::vec3 farthest = glm::max(glm::abs(box.lower), glm::abs(box.upper)), sides = box.upper - box.lower;
        const float reach = std::max({farthest.x, farthest.y, farthest.z});
        const float side = std::max({sides.x, sides.y, sides.z});
        if (side == 0.0f || !(side < reach * kLeastShare)) return "";  // nothing there has light
        char text[200];
        std::snprintf(
            text, sizeof(text),
            "is %.3g wide and lies at coordinates of %.3g, where floats are %.3g apart: its light will be wrong; "
            "move it to the origin before it is exported",
            side, reach, std::nextafter(reach, 2.0f * reach) - reach);
        return text;
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
    double time_ = 0.0;
    std::map<int, uint32_t> placed_as_;                                     // of the file's nodes: where in nodes_
    std::map<int, LoadedMesh> meshes_;                                      // as they were read
    std::map<std::pair<int, std::vector<double>>, uint32_t> fixed_meshes_;  // the scene's, by mesh and weights
    std::set<int> moving_weights_;
    std::map<int, Shown> deforming_;  // by node
    std::map<int, std::shared_ptr<const Skin>> skins_;
    SceneParts parts_;
    int hidden_copies_ = -1;  // the first node one of whose copies is scaled to nothing
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
