// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/host_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render_system/animation/animation.h"
#include "render_system/light_table.h"
#include "render_system/scene_limits.h"
#include "render_system/texture.h"

namespace render_system {

namespace {

bool any_of(const std::vector<bool>& flags) { return std::find(flags.begin(), flags.end(), true) != flags.end(); }

bool same_slot(const CoreTextureSlot& a, const CoreTextureSlot& b) {
    return a.texture == b.texture && a.uv_set == b.uv_set && a.row_u == b.row_u && a.row_v == b.row_v;
}

// Whether the light table holds the same of both materials.
bool same_emission(const CoreMaterial& a, const CoreMaterial& b) {
    if (a.emission_weight == 0.0f && b.emission_weight == 0.0f) return true;
    return a.emission == b.emission && a.emission_weight == b.emission_weight && a.double_sided == b.double_sided &&
           same_slot(a.emission_texture, b.emission_texture);
}

Box box_of(const HostMesh& mesh) {
    Box box;
    for (const glm::vec3& position : mesh.positions) box.extend(position);
    return box;
}

// A camera placed by a node: its scale is ignored, its directions made perpendicular again (glTF 2.0, 3.10.2).
Camera placed_camera(const Camera& camera, const glm::dmat4& world) {
    const glm::vec3 forward(-glm::dvec3(world[2]));
    Camera placed = look_at(glm::vec3(0.0f), forward, glm::vec3(world[1]), camera.vertical_fov);
    placed.position = glm::vec3(world[3]);
    placed.parallel_height = camera.parallel_height;
    return placed;
}

// A light placed by a node shines along its -z.
PunctualLight placed_light(PunctualLight light, const glm::dmat4& world) {
    const glm::dvec3 way = -glm::dvec3(world[2]);
    light.position = glm::vec3(world[3]);
    if (glm::length(way) > 0.0) light.direction = glm::vec3(glm::normalize(way));
    return light;
}

}  // namespace

void Box::extend(const glm::vec3& point) {
    lower = glm::min(lower, point);
    upper = glm::max(upper, point);
}

CoreMesh HostMesh::view() const { return {positions, normals, tangents, uv0, uv1, uv2, uv3, colors, triangles}; }

const std::vector<glm::vec2>& HostMesh::uv(uint32_t set) const {
    constexpr std::vector<glm::vec2> HostMesh::*kSets[] = {&HostMesh::uv0, &HostMesh::uv1, &HostMesh::uv2,
                                                           &HostMesh::uv3};
    return this->*kSets[set];
}

CoreTexture HostTexture::view() const { return {width, height, levels, format, wrap_s, wrap_t, nearest, texels}; }

bool SceneChanges::any() const {
    return textures || lights || sky || any_of(meshes) || any_of(instances) || any_of(materials);
}

uint32_t HostScene::add_texture(HostTexture texture) {
    texture_means_.emplace_back();
    textures_.push_back(std::move(texture));
    changes_.textures = true;
    return static_cast<uint32_t>(textures_.size() - 1);
}

uint32_t HostScene::add_material(HostMaterial material) {
    material.core.emission_weight = emission_weight(material.core);
    materials_.push_back(std::move(material));
    changes_.materials.push_back(true);
    return static_cast<uint32_t>(materials_.size() - 1);
}

uint32_t HostScene::add_mesh(HostMesh mesh) {
    meshes_.push_back(std::move(mesh));
    mesh_boxes_.emplace_back();
    mesh_materials_.emplace_back();
    changes_.meshes.push_back(true);
    describe_mesh(static_cast<uint32_t>(meshes_.size() - 1));
    return static_cast<uint32_t>(meshes_.size() - 1);
}

uint32_t HostScene::add_instance(uint32_t mesh, const CoreTransform& transform) {
    instances_.push_back({mesh, transform});
    changes_.instances.push_back(true);
    if (mesh != NONE && is_emissive(mesh)) changes_.lights = true;
    return static_cast<uint32_t>(instances_.size() - 1);
}

uint32_t HostScene::add_punctual_light(PunctualLight light) {
    lights_.push_back(std::move(light));
    changes_.lights = true;
    return static_cast<uint32_t>(lights_.size() - 1);
}

uint32_t HostScene::add_camera(HostCamera camera) {
    cameras_.push_back(std::move(camera));
    return static_cast<uint32_t>(cameras_.size() - 1);
}

uint32_t HostScene::add_node(HostNode node) {
    nodes_.push_back(std::move(node));
    node_worlds_.emplace_back(1.0);
    flattened_.push_back(false);
    const uint32_t id = static_cast<uint32_t>(nodes_.size() - 1);
    if (const uint32_t carried = nodes_[id].instance; carried != NONE) {
        if (carriers_.size() <= carried) carriers_.resize(carried + 1, NONE);
        carriers_[carried] = id;
        if (nodes_[id].mesh == NONE) nodes_[id].mesh = instances_[carried].mesh;
    }
    place(id);
    return id;
}

uint32_t HostScene::add_deformer(HostDeformer deformer) {
    deformers_.push_back(std::move(deformer));
    out_of_shape_.push_back(false);
    deform_mesh(deformers_.back());
    return static_cast<uint32_t>(deformers_.size() - 1);
}

void HostScene::set_texture(uint32_t id, HostTexture texture) {
    if (id < removed_.textures.size()) removed_.textures[id] = false;
    texture_means_[id].reset();
    textures_[id] = std::move(texture);
    changes_.textures = true;
    update_emission_weights(id);
}

void HostScene::set_material(uint32_t id, const CoreMaterial& material) {
    if (id < removed_.materials.size()) removed_.materials[id] = false;
    CoreMaterial next = material;
    next.emission_weight = emission_weight(material);
    if (!same_emission(materials_[id].core, next)) changes_.lights = true;
    materials_[id].core = next;
    changes_.materials[id] = true;
}

void HostScene::set_mesh(uint32_t id, HostMesh mesh) {
    if (id < removed_.meshes.size()) removed_.meshes[id] = false;
    for (HostDeformer& deformer : deformers_) {
        if (deformer.mesh == id) deformer = {};
    }
    const bool was_emissive = is_emissive(id);
    meshes_[id] = std::move(mesh);
    changes_.meshes[id] = true;
    describe_mesh(id);
    if (was_emissive || is_emissive(id)) changes_.lights = true;
}

void HostScene::set_instance_mesh(uint32_t id, uint32_t mesh) {
    if (id < removed_.instances.size()) removed_.instances[id] = false;
    const uint32_t node = carrier(id);
    if (node != NONE) nodes_[node].mesh = mesh;
    show(id, node != NONE && flattened_[node] ? NONE : mesh);
}

void HostScene::show(uint32_t id, uint32_t mesh) {
    const uint32_t before = std::exchange(instances_[id].mesh, mesh);
    changes_.instances[id] = true;
    if ((before != NONE && is_emissive(before)) || (mesh != NONE && is_emissive(mesh))) changes_.lights = true;
}

uint32_t HostScene::carrier(uint32_t instance) const {
    return instance < carriers_.size() ? carriers_[instance] : NONE;
}

void HostScene::set_instance_transform(uint32_t id, const CoreTransform& transform) {
    instances_[id].transform = transform;
    changes_.instances[id] = true;
    if (instances_[id].mesh != NONE && is_emissive(instances_[id].mesh)) changes_.lights = true;
}

void HostScene::set_punctual_light(uint32_t id, PunctualLight light) {
    if (id < removed_.lights.size()) removed_.lights[id] = false;
    lights_[id] = std::move(light);
    changes_.lights = true;
}

void HostScene::set_camera(uint32_t id, const Camera& camera) { cameras_[id].camera = camera; }

void HostScene::set_sky(Sky sky) {
    // A constant sky is in no table, so replacing one by another leaves the lights alone.
    if (!sky_.texels.empty() || !sky.texels.empty()) changes_.lights = true;
    sky_ = std::move(sky);
    changes_.sky = true;
}

void HostScene::set_node_transform(uint32_t id, const glm::dmat4& local) {
    const NodeMove move{id, local};
    set_poses({&move, 1}, {});
}

void HostScene::set_poses(std::span<const NodeMove> moves, std::span<const NewWeights> weights) {
    for (const auto& [id, changed] : weights) {
        std::vector<double>& own = deformers_[id].weights;
        if (std::equal(own.begin(), own.end(), changed.begin(), changed.end())) continue;
        own.assign(changed.begin(), changed.end());
        out_of_shape_[id] = true;
    }
    move_nodes(moves);
    for (size_t i = 0; i < deformers_.size(); ++i) {
        if (out_of_shape_[i]) deform_mesh(deformers_[i]);
        out_of_shape_[i] = false;
    }
}

void HostScene::move_nodes(std::span<const NodeMove> moves) {
    uint32_t first = NONE;
    for (const NodeMove& move : moves) {
        if (nodes_[move.node].local != move.local) first = std::min(first, move.node);
    }
    if (first == NONE) return;
    std::vector<bool> moved(nodes_.size() - first, false);  // from `first` on
    for (const NodeMove& move : moves) {
        if (nodes_[move.node].local == move.local) continue;
        nodes_[move.node].local = move.local;
        moved[move.node - first] = true;
    }
    place_below(first, std::move(moved));
}

// Parents come first, so one pass over what follows finds all that hangs below.
void HostScene::place_below(uint32_t first, std::vector<bool> moved) {
    for (uint32_t i = first; i < nodes_.size(); ++i) {
        const uint32_t parent = nodes_[i].parent;
        if (parent != NONE && parent >= first && moved[parent - first]) moved[i - first] = true;
        if (moved[i - first]) place(i);
    }
    follow_joints(first, moved);
}

void HostScene::place(uint32_t id) {
    const HostNode& node = nodes_[id];
    const glm::dmat4 world = node.parent == NONE ? node.local : node_worlds_[node.parent] * node.local;
    node_worlds_[id] = world;
    if (node.instance != NONE) place_instance(id, core_transform(world));
    if (node.camera != NONE) set_camera(node.camera, placed_camera(cameras_[node.camera].camera, world));
    if (node.light != NONE) set_punctual_light(node.light, placed_light(lights_[node.light], world));
}

// What is scaled to nothing has no normals and no way back into the mesh's space: it is hidden for as long.
void HostScene::place_instance(uint32_t id, const CoreTransform& transform) {
    const HostNode& node = nodes_[id];
    const bool flat = is_scaled_to_nothing(transform);
    if (flat != flattened_[id]) {
        flattened_[id] = flat;
        show(node.instance, flat ? NONE : node.mesh);
    }
    set_instance_transform(node.instance, transform);
}

void HostScene::follow_joints(uint32_t first, const std::vector<bool>& moved) {
    for (size_t i = 0; i < deformers_.size(); ++i) {
        if (!deformers_[i].skin) continue;
        const std::vector<uint32_t>& joints = deformers_[i].skin->joints;
        out_of_shape_[i] = out_of_shape_[i] || std::any_of(joints.begin(), joints.end(), [&](uint32_t joint) {
                               return joint >= first && moved[joint - first];
                           });
    }
}

void HostScene::deform_mesh(const HostDeformer& deformer) {
    if (deformer.mesh == NONE) return;  // it has been removed, or given another shape
    std::vector<glm::mat4> matrices;
    for (size_t i = 0; deformer.skin && i < deformer.skin->joints.size(); ++i)
        matrices.emplace_back(node_worlds_[deformer.skin->joints[i]] * deformer.skin->inverse_binds[i]);
    HostMesh& mesh = meshes_[deformer.mesh];
    deform(*deformer.rest, deformer.weights, matrices, mesh);
    mesh_boxes_[deformer.mesh] = box_of(mesh);
    changes_.meshes[deformer.mesh] = true;
    if (is_emissive(deformer.mesh)) changes_.lights = true;
}

void HostScene::set_animation(Animation animation) {
    animation_ = std::make_shared<const Animation>(std::move(animation));
}

bool HostScene::is_animated() const { return animation_ && !animation_->empty(); }

double HostScene::duration() const { return is_animated() ? animation_->duration() : 0.0; }

Status HostScene::play(double time) {
    return is_animated() ? play_animation(*animation_, time, *this) : Status::success();
}

uint64_t HostScene::triangle_count() const {
    uint64_t count = 0;
    for (const HostInstance& instance : instances_) {
        if (instance.mesh != NONE) count += meshes_[instance.mesh].triangles.size();
    }
    return count;
}

Box HostScene::bounds() const {
    Box box;
    for (const HostInstance& instance : instances_) {
        if (instance.mesh == NONE || mesh_boxes_[instance.mesh].empty()) continue;
        const Box& local = mesh_boxes_[instance.mesh];
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 point((corner & 1) ? local.upper.x : local.lower.x,
                                  (corner & 2) ? local.upper.y : local.lower.y,
                                  (corner & 4) ? local.upper.z : local.lower.z);
            box.extend(transform_point(instance.transform, point));
        }
    }
    return box;
}

bool HostScene::has_light() const {
    if (sky_.radiance != glm::vec3(0.0f) && sky_.texels.empty()) return true;
    for (const glm::vec4& texel : sky_.texels) {
        if (glm::vec3(texel) != glm::vec3(0.0f)) return true;
    }
    for (const PunctualLight& light : lights_) {
        if (light.emission != glm::vec3(0.0f)) return true;
    }
    return std::any_of(instances_.begin(), instances_.end(), [&](const HostInstance& instance) {
        return instance.mesh != NONE && is_emissive(instance.mesh);
    });
}

bool HostScene::is_emissive(uint32_t mesh) const {
    const std::vector<uint32_t>& used = mesh_materials_[mesh];
    return std::any_of(used.begin(), used.end(), [&](uint32_t material) {
        return material < materials_.size() && materials_[material].core.emission_weight > 0.0f;
    });
}

void HostScene::mark_all_changed() {
    changes_.meshes.assign(meshes_.size(), true);
    changes_.instances.assign(instances_.size(), true);
    changes_.materials.assign(materials_.size(), true);
    changes_.textures = changes_.lights = changes_.sky = true;
}

float HostScene::emission_weight(const CoreMaterial& material) {
    const float untextured = luminance(material.emission) * even_coverage(material);
    const uint32_t texture = material.emission_texture.texture;
    if (untextured == 0.0f || texture >= textures_.size()) return untextured;
    std::optional<float>& mean = texture_means_[texture];
    if (!mean) mean = luminance(mean_color(textures_[texture]));
    return luminance(material.emission) * *mean * even_coverage(material);
}

void HostScene::update_emission_weights(uint32_t texture) {
    for (uint32_t i = 0; i < materials_.size(); ++i) {
        if (materials_[i].core.emission_texture.texture == texture) set_material(i, materials_[i].core);
    }
}

void HostScene::describe_mesh(uint32_t id) {
    mesh_boxes_[id] = box_of(meshes_[id]);
    std::vector<uint32_t> used;
    for (const glm::uvec4& triangle : meshes_[id].triangles) {
        if (used.empty() || used.back() != triangle.w) used.push_back(triangle.w);
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    mesh_materials_[id] = std::move(used);
}

namespace {

// From where the default view looks at a box of that size: unit length.
glm::dvec3 framing_direction(const glm::dvec3& size) {
    constexpr double kFlat = 0.1, kLeastSine = 0.5;
    glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, 0.75, 1.5));
    for (int thin = 0; thin < 3; ++thin) {
        const double others = std::min(size[(thin + 1) % 3], size[(thin + 2) % 3]);
        if (!(size[thin] < kFlat * others) || direction[thin] >= kLeastSine) continue;
        direction[thin] = 0.0;
        direction = glm::normalize(direction) * std::sqrt(1.0 - kLeastSine * kLeastSine);
        direction[thin] = kLeastSine;
    }
    return direction;
}

}  // namespace

FramingView framing_view(const HostScene& scene, float aspect, float vertical_fov) {
    const Box box = scene.bounds();
    const glm::dvec3 lower = box.empty() ? glm::dvec3(0.0) : glm::dvec3(box.lower);
    const glm::dvec3 upper = box.empty() ? glm::dvec3(0.0) : glm::dvec3(box.upper);
    const glm::dvec3 center = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
    const glm::dvec3 towards = framing_direction(upper - lower);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), towards));
    const glm::dvec3 up = glm::cross(towards, right);
    const double slope = std::tan(0.5 * static_cast<double>(vertical_fov));
    double distance = 0.0;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 corner = half * glm::dvec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0);
        const double wide = std::abs(glm::dot(corner, right)) / (slope * static_cast<double>(aspect));
        const double high = std::abs(glm::dot(corner, up)) / slope;
        distance = std::max(distance, glm::dot(corner, towards) + std::max(wide, high));
    }
    if (!(distance > 0.0)) distance = 1.0;
    // Far from the origin eye and target must not round to one point, nor to two that lie askew.
    constexpr double kLeastShare = 0x1p-18;
    const double reach = std::max({std::abs(center.x), std::abs(center.y), std::abs(center.z)});
    distance = std::max(distance, kLeastShare * reach);
    return {glm::vec3(center + towards * distance), glm::vec3(center)};
}

Camera framing_camera(const HostScene& scene, float aspect) {
    const FramingView view = framing_view(scene, aspect);
    return look_at(view.eye, view.target, {0.0f, 1.0f, 0.0f}, kDefaultFov);
}

CoreTransform core_transform(const glm::dmat4& matrix) {
    CoreTransform transform;
    for (int row = 0; row < 3; ++row) {
        transform.rows[row] = glm::vec4(matrix[0][row], matrix[1][row], matrix[2][row], matrix[3][row]);
    }
    return transform;
}

glm::vec3 transform_point(const CoreTransform& transform, const glm::vec3& p) {
    const auto row = [&](const glm::vec4& r) { return ((r.x * p.x + r.y * p.y) + r.z * p.z) + r.w; };
    return {row(transform.rows[0]), row(transform.rows[1]), row(transform.rows[2])};
}

float luminance(const glm::vec3& color) { return 0.2126f * color.x + 0.7152f * color.y + 0.0722f * color.z; }

}  // namespace render_system
