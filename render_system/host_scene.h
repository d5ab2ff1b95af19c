// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render_system/animation/deformation.h"
#include "render_system/camera.h"
#include "render_system/core_data.h"
#include "render_system/status.h"

namespace render_system {

struct Animation;

/// A box in space; empty (contains nothing) as long as lower > upper.
struct Box {
    glm::vec3 lower{1e30f};
    glm::vec3 upper{-1e30f};

    bool empty() const { return lower.x > upper.x; }
    glm::vec3 center() const { return 0.5f * (lower + upper); }
    void extend(const glm::vec3& point);
};

/// A triangle mesh that owns its memory; see CoreMesh for the meaning of each array.
struct HostMesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec4> tangents;
    std::vector<glm::vec2> uv0;
    std::vector<glm::vec2> uv1;
    std::vector<glm::vec2> uv2;
    std::vector<glm::vec2> uv3;
    std::vector<glm::vec4> colors;
    std::vector<glm::uvec4> triangles;

    CoreMesh view() const;  ///< spans into this mesh
    /// By the number that CoreTextureSlot::uv_set has.
    const std::vector<glm::vec2>& uv(uint32_t set) const;
};

/// A texture that owns its texels; see CoreTexture.
struct HostTexture {
    std::string name;
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t levels = 1;
    TexelFormat format = TexelFormat::rgba8;
    TextureWrap wrap_s = TextureWrap::repeat;
    TextureWrap wrap_t = TextureWrap::repeat;
    bool nearest = false;
    std::vector<uint32_t> texels;

    CoreTexture view() const;  ///< spans into this texture
};

/// A material with its name. The scene sets core.emission_weight; what a caller writes there is ignored.
struct HostMaterial {
    std::string name;
    CoreMaterial core;
    bool unlit = false;  ///< its emission is what one sees of it, and not meant as a light
};

/// A mesh at a place.
struct HostInstance {
    uint32_t mesh = NONE;  ///< NONE: hidden
    CoreTransform transform;
};

/// A light without extent, as KHR_lights_punctual has it.
struct PunctualLight {
    std::string name;
    LightKind kind = LightKind::point;  ///< point, spot or directional
    glm::vec3 position{0.0f};
    glm::vec3 direction{0.0f, 0.0f, -1.0f};  ///< the way that light travels, unit length
    glm::vec3 emission{0.0f};                ///< point, spot: radiant intensity; directional: irradiance
    float inner_cone = 0.0f;                 ///< spot: full intensity inside this angle from the axis, radians
    float outer_cone = 0.7853982f;           ///< spot: dark outside
};

/// The environment: an equirectangular map, or without texels a constant radiance. See CoreSky.
struct Sky {
    glm::vec3 radiance{0.0f};
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::vec4> texels;
};

struct HostCamera {
    std::string name;
    Camera camera;
};

/// A node of the hierarchy. Parents come before their children.
struct HostNode {
    std::string name;
    uint32_t parent = NONE;
    glm::dmat4 local{1.0};  ///< to the parent's space
    uint32_t instance = NONE;
    uint32_t mesh = NONE;    ///< what that instance shows: while the node is scaled to nothing, it is hidden
    uint32_t light = NONE;   ///< into punctual_lights()
    uint32_t camera = NONE;  ///< into cameras()
};

/// Where a node goes.
struct NodeMove {
    uint32_t node = NONE;
    glm::dmat4 local{1.0};  ///< to the parent's space
};

/// The weights of a deformer's morph targets, from the first on.
struct NewWeights {
    uint32_t deformer = NONE;
    std::span<const double> weights;
};

/// The nodes that pull at skinned meshes, and what takes a mesh's vertices into each one's space.
struct Skin {
    std::vector<uint32_t> joints;
    std::vector<glm::dmat4> inverse_binds;  ///< one a joint
};

/// A mesh that is made of another by weights and joints, anew whenever these change. A skinned mesh lies in world
/// space: its instance stands where it was put, and no node places it.
struct HostDeformer {
    uint32_t mesh = NONE;  ///< what it makes; has the triangles and all that does not change
    std::shared_ptr<const RestMesh> rest;
    std::vector<double> weights;       ///< of the morph targets
    std::shared_ptr<const Skin> skin;  ///< null: none
};

/// What has changed since the core was last brought up to date: one flag per element.
struct SceneChanges {
    std::vector<bool> meshes;
    std::vector<bool> instances;
    std::vector<bool> materials;
    bool textures = false;
    bool lights = false;  ///< punctual lights, or something emissive
    bool sky = false;

    bool any() const;
};

/// The scene as the render system keeps it. Reading is free; every edit goes through a setter, which raises the flags
/// of just what it touched. Ids are dense and never reused; an instance is hidden by giving it the mesh NONE.
/// Setters require ids that exist and data that core_checks.h accepts; that is the caller's duty.
class HostScene {
public:
    const std::vector<HostTexture>& textures() const { return textures_; }
    const std::vector<HostMaterial>& materials() const { return materials_; }
    const std::vector<HostMesh>& meshes() const { return meshes_; }
    const std::vector<HostInstance>& instances() const { return instances_; }
    const std::vector<PunctualLight>& punctual_lights() const { return lights_; }
    const std::vector<HostCamera>& cameras() const { return cameras_; }
    const std::vector<HostNode>& nodes() const { return nodes_; }
    const Sky& sky() const { return sky_; }
    bool is_removed_material(uint32_t id) const { return id < removed_.materials.size() && removed_.materials[id]; }
    bool is_removed_light(uint32_t id) const { return id < removed_.lights.size() && removed_.lights[id]; }
    const std::vector<HostDeformer>& deformers() const { return deformers_; }

    uint32_t add_texture(HostTexture texture);
    uint32_t add_material(HostMaterial material);
    uint32_t add_mesh(HostMesh mesh);
    uint32_t add_instance(uint32_t mesh, const CoreTransform& transform);
    uint32_t add_punctual_light(PunctualLight light);
    uint32_t add_camera(HostCamera camera);
    /// The node's parent must have been added before. Places what the node carries; no two nodes carry one instance.
    /// Where it names no mesh, it has its instance's.
    uint32_t add_node(HostNode node);
    /// Deforms the mesh at once.
    uint32_t add_deformer(HostDeformer deformer);

    void set_texture(uint32_t id, HostTexture texture);
    void set_material(uint32_t id, const CoreMaterial& material);
    /// Nothing deforms the mesh from then on: weights and joints belong to the vertices that it had.
    void set_mesh(uint32_t id, HostMesh mesh);
    /// An instance whose node is scaled to nothing shows the mesh once that node is not.
    void set_instance_mesh(uint32_t id, uint32_t mesh);
    void set_instance_transform(uint32_t id, const CoreTransform& transform);
    void set_punctual_light(uint32_t id, PunctualLight light);
    void set_camera(uint32_t id, const Camera& camera);
    void set_sky(Sky sky);
    /// Removal. The memory of what is removed is given back, here and in the core with its next picture; all ids stay
    /// as they are, and a removed one is never given to anything else. It may be set anew, which brings it back. Fails
    /// with not_found where there is no such id or it has been removed already, and with invalid_argument where
    /// something that is left uses it: an instance a mesh, a mesh a material, a material a texture.
    Status remove_instance(uint32_t id);
    Status remove_mesh(uint32_t id);
    Status remove_material(uint32_t id);
    Status remove_texture(uint32_t id);
    Status remove_punctual_light(uint32_t id);

    /// Moves a node and everything below it: instances, lights, cameras, and the skins that it is a joint of.
    void set_node_transform(uint32_t id, const glm::dmat4& local);
    /// Many nodes and weights in one pass over the hierarchy, each mesh deformed once; what is as it was raises no
    /// flag.
    void set_poses(std::span<const NodeMove> moves, std::span<const NewWeights> weights);

    /// Gives the scene something to play.
    void set_animation(Animation animation);
    bool is_animated() const;
    const Animation* animation() const { return animation_.get(); }  ///< null: none
    /// Seconds of what there is to play; 0 without an animation.
    double duration() const;
    /// Brings everything to `time` seconds, through the setters above. Without an animation nothing changes. Fails as
    /// play_animation does.
    Status play(double time);

    /// The box of a mesh in its own space.
    const Box& mesh_box(uint32_t mesh) const { return mesh_boxes_[mesh]; }

    /// Triangles in all visible instances.
    uint64_t triangle_count() const;

    /// The world's box: of each visible instance the box of its mesh, transformed. Contains every vertex.
    Box bounds() const;

    /// Whether anything at all gives light: an emissive visible triangle, a punctual light or a sky that is not black.
    bool has_light() const;

    /// Whether a triangle of that mesh has a material that emits.
    bool is_emissive(uint32_t mesh) const;

    /// Gives back what a core has its own copy of: vertices and triangles of a mesh that gives no light, texels of all
    /// textures. Names, boxes and materials stay. For a scene that goes to one core and is not edited again.
    void give_back_mesh(uint32_t id);
    void give_back_textures();

    const SceneChanges& changes() const { return changes_; }
    SceneChanges& changes() { return changes_; }
    void mark_all_changed();

private:
    float emission_weight(const CoreMaterial& material);
    void describe_mesh(uint32_t id);
    void update_emission_weights(uint32_t texture);
    void move_nodes(std::span<const NodeMove> moves);
    void place_below(uint32_t first, std::vector<bool> moved);
    void place(uint32_t node);
    void place_instance(uint32_t node, const CoreTransform& transform);
    void show(uint32_t instance, uint32_t mesh);
    /// The node that carries an instance, or NONE.
    uint32_t carrier(uint32_t instance) const;
    void follow_joints(uint32_t first, const std::vector<bool>& moved);
    void deform_mesh(const HostDeformer& deformer);

    std::vector<HostTexture> textures_;
    std::vector<std::optional<float>> texture_means_;  // luminance of level 0, of those that light something
    std::vector<HostMaterial> materials_;
    std::vector<HostMesh> meshes_;
    std::vector<Box> mesh_boxes_;
    std::vector<std::vector<uint32_t>> mesh_materials_;  // sorted, each once
    std::vector<HostInstance> instances_;
    std::vector<PunctualLight> lights_;
    std::vector<HostCamera> cameras_;
    std::vector<HostNode> nodes_;
    std::vector<glm::dmat4> node_worlds_;  // to world space
    std::vector<bool> flattened_;          // by node: its instance is hidden, since it is scaled to nothing
    std::vector<uint32_t> carriers_;       // by instance, no longer than need be: the node that carries it
    struct Removed {
        std::vector<bool> instances, meshes, materials, textures, lights;
    };
    Removed removed_;  // by id, no longer than need be
    std::vector<HostDeformer> deformers_;
    std::vector<bool> out_of_shape_;  // by deformer
    std::shared_ptr<const Animation> animation_;
    Sky sky_;
    SceneChanges changes_;
};

/// The default field of view: 40 degrees.
constexpr float kDefaultFov = 0.6981317f;

/// A view by two points, y up: as `--look-at` takes it.
struct FramingView {
    glm::vec3 eye;
    glm::vec3 target;
};

/// The default view: from direction (1, 0.75, 1.5), y up, with the scene's box just inside a picture of that aspect
/// (width / height) and vertical field of view. A box less than a tenth as thick as it is wide either way is seen from
/// at least 30 degrees off its plane.
FramingView framing_view(const HostScene& scene, float aspect, float vertical_fov = kDefaultFov);

/// The camera of that view.
Camera framing_camera(const HostScene& scene, float aspect = 16.0f / 9.0f);

/// Rows of `matrix` (object to world, last row 0 0 0 1) in the form that cores take.
CoreTransform core_transform(const glm::dmat4& matrix);

/// A point through an instance's matrix: ((r.x * p.x + r.y * p.y) + r.z * p.z) + r.w a row, in this order, in float.
/// Cores that build world-space triangles use the same expression and so get the same bits.
glm::vec3 transform_point(const CoreTransform& transform, const glm::vec3& point);

/// Relative luminance of linear RGB with the primaries of sRGB (ITU-R BT.709).
float luminance(const glm::vec3& color);

}  // namespace render_system
