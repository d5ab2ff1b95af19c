// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/core_geometry.h"

#include <algorithm>
#include <string>

#include "source_core/core_geometry_parts.h"
#include "source_core/core_tables.h"

namespace source_core {

using render_system::CoreTransform;
using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

namespace {

constexpr uint32_t ENTER_INSTANCE_STACK = 2;
constexpr uint32_t TOP_STACK_LIMIT = 24;    // with medians enough for 4^8 instances
constexpr uint32_t MOST_IN_TOP = 1u << 16;  // of more instances each move builds all anew

// The arithmetic of transform_point in kernels/intersect.glsl: baked and instanced vertices agree in every bit.
glm::vec3 transform_point(const CoreTransform& transform, const glm::vec3& p) {
    const glm::vec4* rows = transform.rows;
    return glm::vec3(((rows[0].x * p.x + rows[0].y * p.y) + rows[0].z * p.z) + rows[0].w,
                     ((rows[1].x * p.x + rows[1].y * p.y) + rows[1].z * p.z) + rows[1].w,
                     ((rows[2].x * p.x + rows[2].y * p.y) + rows[2].z * p.z) + rows[2].w);
}

Box box_of(const std::vector<BuildPrimitive>& primitives) {
    Box box;
    for (const BuildPrimitive& primitive : primitives) {
        box.include(primitive.lower);
        box.include(primitive.upper);
    }
    return box;
}

class GeometryBuilder {
public:
    GeometryBuilder(const std::vector<CoreMeshCopy>& meshes, const std::vector<CoreInstance>& instances,
                    const OpacityOf& opacity_of, uint32_t threads, const MovingParts& moving)
        : meshes_(meshes), instances_(instances), opacity_of_(opacity_of), threads_(threads), moving_(moving) {}

    Result<GeometryTables> build() {
        sort_instances();
        build_mesh_trees();
        build_scene_tree();
        if (tables_.triangles.size() / TRIANGLE_ROWS > MOST_SLOTS || tables_.nodes.size() > MOST_SLOTS) {
            return Status::invalid("the scene has " + std::to_string(tables_.triangles.size() / TRIANGLE_ROWS) +
                                   " triangles; the core can count up to " + std::to_string(MOST_SLOTS));
        }
        if (stack_need_ > STACK_SIZE) {
            return Status::error(StatusCode::internal, "a walk through the scene's tree would need a stack of " +
                                                           std::to_string(stack_need_) + " entries");
        }
        pack_meshes();
        finish_plan();
        return std::move(tables_);
    }

private:
    struct MeshTree {
        WideTree tree;
        Box box;
        uint32_t first_slot = 0;
        uint32_t first_node = 0;
        uint32_t node_room = 0;
        bool is_empty = true;
    };

    bool shares_its_mesh(const CoreInstance& instance) const { return uses_[instance.mesh] > 1; }

    // Decides which instances are baked and which get a record.
    void sort_instances() {
        uses_.assign(meshes_.size(), 0);
        for (const CoreInstance& instance : instances_) {
            if (instance.mesh != render_system::NONE) {
                ++uses_[instance.mesh];
                tables_.triangle_count += meshes_[instance.mesh].triangles.size();
            }
        }
        needs_tree_.assign(meshes_.size(), false);
        for (uint32_t i = 0; i < instances_.size(); ++i) {
            if (instances_[i].mesh == render_system::NONE || meshes_[instances_[i].mesh].triangles.empty()) {
                continue;
            }
            const bool moves = moving_.moves(i, instances_[i].mesh);
            const bool has_record = (shares_its_mesh(instances_[i]) || moves) && invert(instances_[i].transform).usable;
            layered_ = layered_ || moves;
            if (has_record) {
                needs_tree_[instances_[i].mesh] = true;
                recorded_.push_back(i);
            } else {
                baked_.push_back(i);
            }
        }
        tables_.features |= recorded_.empty() ? 0u : FEATURE_INSTANCES;
    }

    void add_slot(const Triangle& triangle, uint32_t primitive, uint32_t instance, const CoreMeshCopy& mesh) {
        const float opacity = opacity_of_(mesh.triangles[primitive].w, mesh.has_colors());
        tables_.features |= opacity < 1.0f ? FEATURE_ALPHA : 0u;
        tables_.features |= opacity < 0.0f ? FEATURE_ALPHA_TEXTURES : 0u;
        append_slot(triangle, opacity, primitive, instance, tables_.triangles);
    }

    void build_mesh_trees() {
        mesh_trees_.resize(meshes_.size());
        tables_.plan.mesh_slots.resize(meshes_.size());
        for (uint32_t m = 0; m < meshes_.size(); ++m) {
            if (!needs_tree_[m]) {
                continue;
            }
            const CoreMeshCopy& mesh = meshes_[m];
            MeshTree& result = mesh_trees_[m];
            std::vector<BuildPrimitive> primitives;
            for (uint32_t i = 0; i < mesh.triangles.size(); ++i) {
                const Triangle triangle = triangle_of(mesh, i);
                if (is_reachable(triangle)) {
                    primitives.push_back(primitive_of(triangle, i));
                    result.box.include(primitives.back().lower);
                    result.box.include(primitives.back().upper);
                }
            }
            result.is_empty = primitives.empty();
            result.tree = build_wide_tree(std::move(primitives), threads_, MESH_STACK_LIMIT);
            result.first_slot = static_cast<uint32_t>(tables_.triangles.size() / TRIANGLE_ROWS);
            std::vector<uint32_t>& slots = tables_.plan.mesh_slots[m];
            slots.assign(mesh.triangles.size(), render_system::NONE);
            for (const uint32_t primitive : result.tree.order) {
                slots[primitive] = static_cast<uint32_t>(tables_.triangles.size() / TRIANGLE_ROWS);
                add_slot(triangle_of(mesh, primitive), primitive, render_system::NONE, mesh);
            }
            mesh_stack_need_ = std::max(mesh_stack_need_, ENTER_INSTANCE_STACK + result.tree.stack_need);
        }
    }

    struct BakedTriangle {
        uint32_t instance;
        uint32_t primitive;
    };

    Triangle place(const BakedTriangle& baked) const {
        const CoreInstance& instance = instances_[baked.instance];
        Triangle triangle = triangle_of(meshes_[instance.mesh], baked.primitive);
        for (glm::vec3& p : triangle.vertices) {
            p = transform_point(instance.transform, p);
        }
        return triangle;
    }

    void build_scene_tree() {
        size_t most = 0;
        for (const uint32_t i : baked_) {
            most += meshes_[instances_[i].mesh].triangles.size();
        }
        std::vector<BakedTriangle> baked;
        std::vector<BuildPrimitive> primitives;
        baked.reserve(most);
        primitives.reserve(most + recorded_.size());
        tables_.triangles.reserve(tables_.triangles.size() + most * TRIANGLE_ROWS);
        tables_.plan.baked_slots.resize(instances_.size());
        for (const uint32_t i : baked_) {
            const uint32_t count = static_cast<uint32_t>(meshes_[instances_[i].mesh].triangles.size());
            tables_.plan.baked_slots[i].assign(count, render_system::NONE);
            for (uint32_t primitive = 0; primitive < count; ++primitive) {
                const Triangle triangle = place({i, primitive});
                if (is_reachable(triangle)) {
                    primitives.push_back(primitive_of(triangle, static_cast<uint32_t>(baked.size())));
                    baked.push_back({i, primitive});
                }
            }
        }
        std::vector<BuildPrimitive> records;
        for (uint32_t k = 0; k < recorded_.size(); ++k) {
            const CoreInstance& instance = instances_[recorded_[k]];
            if (mesh_trees_[instance.mesh].is_empty) {
                continue;
            }
            records.push_back(hanging(transform_box(instance.transform, mesh_trees_[instance.mesh].box), k));
        }
        plan_still(primitives);
        tables_.extent = glm::max(tables_.plan.still_extent, extent_of(records));
        const WideTree scene = layered_ ? build_layers(std::move(primitives), std::move(records))
                                        : build_one_tree(std::move(primitives), records);
        const uint32_t first_slot = static_cast<uint32_t>(tables_.triangles.size() / TRIANGLE_ROWS);
        for (const uint32_t id : layered_ ? still_.order : scene.order) {
            tables_.plan.baked_slots[baked[id].instance][baked[id].primitive] =
                static_cast<uint32_t>(tables_.triangles.size() / TRIANGLE_ROWS);
            add_slot(place(baked[id]), baked[id].primitive, baked[id].instance,
                     meshes_[instances_[baked[id].instance].mesh]);
        }
        append_trees(scene, first_slot);
    }

    void plan_still(const std::vector<BuildPrimitive>& primitives) {
        GeometryPlan& plan = tables_.plan;
        const Box box = box_of(primitives);
        plan.still_lower = box.lower;
        plan.still_upper = box.upper;
        plan.still_extent = extent_of(primitives);
        plan.has_still = layered_ && !primitives.empty();
        plan.top_has_records_alone = layered_ || primitives.empty();
    }

    // All in one: the fastest where nothing moves.
    WideTree build_one_tree(std::vector<BuildPrimitive> primitives, const std::vector<BuildPrimitive>& records) {
        primitives.insert(primitives.end(), records.begin(), records.end());
        tables_.plan.top_stack = STACK_SIZE - 1 - mesh_stack_need_;
        WideTree scene = build_wide_tree(std::move(primitives), threads_, tables_.plan.top_stack);
        stack_need_ = 1 + mesh_stack_need_ + scene.stack_need;
        return scene;
    }

    // What is baked as a tree of its own, which hangs on the top as instances do. Answers the top.
    WideTree build_layers(std::vector<BuildPrimitive> primitives, std::vector<BuildPrimitive> records) {
        tables_.plan.top_stack = TOP_STACK_LIMIT;
        if (tables_.plan.has_still) {
            const Box box = box_of(primitives);
            records.push_back(hanging(box, static_cast<uint32_t>(recorded_.size())));
            still_ = build_wide_tree(std::move(primitives), threads_, STACK_SIZE - 1 - TOP_STACK_LIMIT);
        }
        WideTree top = build_wide_tree(std::move(records), threads_, TOP_STACK_LIMIT);
        stack_need_ = 1 + top.stack_need + std::max(mesh_stack_need_, still_.stack_need);
        return top;
    }

    // The scene's nodes first, then those of the meshes, then the records. Nodes for another top are not here: they
    // follow on the device alone.
    void append_trees(const WideTree& scene, uint32_t first_slot) {
        GeometryPlan& plan = tables_.plan;
        plan.recorded = recorded_;
        plan.still_root = static_cast<uint32_t>(scene.nodes.size());
        size_t count = scene.nodes.size() + still_.nodes.size();
        for (uint32_t m = 0; m < mesh_trees_.size(); ++m) {
            MeshTree& mesh = mesh_trees_[m];
            mesh.first_node = static_cast<uint32_t>(count);
            mesh.node_room = static_cast<uint32_t>(mesh.tree.nodes.size());
            mesh.node_room += moving_.deforms(m) ? mesh.node_room / 8 + 4 : 0;
            count += mesh.node_room;
        }
        plan.first_record = static_cast<uint32_t>(count);
        append_nodes(scene.nodes, 0, first_slot, tables_.nodes);
        name_hanging(tables_.nodes, plan);
        append_nodes(still_.nodes, plan.still_root, first_slot, tables_.nodes);
        for (const MeshTree& mesh : mesh_trees_) {
            append_nodes(mesh.tree.nodes, mesh.first_node, mesh.first_slot, tables_.nodes);
            tables_.nodes.resize(mesh.first_node + size_t{mesh.node_room});
        }
        for (const uint32_t i : recorded_) {
            const CoreInstance& instance = instances_[i];
            const MeshTree& mesh = mesh_trees_[instance.mesh];
            tables_.nodes.push_back(make_record(invert(instance.transform), transform_box(instance.transform, mesh.box),
                                                mesh.first_node, i));
        }
        plan.spare_node = static_cast<uint32_t>(tables_.nodes.size());
        plan.spare_count = recorded_.size() <= MOST_IN_TOP ? static_cast<uint32_t>(recorded_.size()) : 0;
    }

    void finish_plan() {
        GeometryPlan& plan = tables_.plan;
        plan.record_of.assign(instances_.size(), render_system::NONE);
        for (uint32_t k = 0; k < recorded_.size(); ++k) {
            plan.record_of[recorded_[k]] = k;
        }
        for (uint32_t m = 0; m < mesh_trees_.size(); ++m) {
            MeshTree& tree = mesh_trees_[m];
            MeshPlan& mesh = plan.meshes[m];
            mesh.first_slot = tree.first_slot;
            mesh.first_node = tree.first_node;
            mesh.node_room = tree.node_room;
            mesh.is_empty = tree.is_empty;
            mesh.lower = tree.box.lower;
            mesh.upper = tree.box.upper;
            if (moving_.deforms(m) && !tree.is_empty) {
                mesh.built_cost = walk_cost(tree.tree);
                mesh.tree = std::move(tree.tree);
            }
        }
    }

    void pack_meshes() {
        std::vector<MeshPlan>& plans = tables_.plan.meshes;
        plans.resize(meshes_.size());
        size_t vertex_rows = kSpareVertexRows;
        for (const CoreMeshCopy& mesh : meshes_) vertex_rows += mesh.vertex_rows.size();
        tables_.vertices.reserve(vertex_rows);
        for (size_t m = 0; m < meshes_.size(); ++m) {
            const CoreMeshCopy& mesh = meshes_[m];
            plans[m].first_triangle = static_cast<uint32_t>(tables_.mesh_triangles.size());
            plans[m].first_vertex_row = static_cast<uint32_t>(tables_.vertices.size());
            tables_.mesh_triangles.insert(tables_.mesh_triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
            tables_.vertices.insert(tables_.vertices.end(), mesh.vertex_rows.begin(), mesh.vertex_rows.end());
            tables_.features |= mesh.has_colors() ? FEATURE_VERTEX_COLORS : 0u;
        }
        tables_.vertices.insert(tables_.vertices.end(), kSpareVertexRows, glm::vec4(0.0f));
        tables_.instances.assign(instances_.size() * INSTANCE_ROWS, glm::vec4(0.0f));
        for (size_t i = 0; i < instances_.size(); ++i) {
            const CoreInstance& instance = instances_[i];
            if (instance.mesh != render_system::NONE) {
                pack_instance(instance.transform, plans[instance.mesh].first_triangle,
                              plans[instance.mesh].first_vertex_row, meshes_[instance.mesh].flags,
                              &tables_.instances[i * INSTANCE_ROWS]);
            }
        }
    }

    const std::vector<CoreMeshCopy>& meshes_;
    const std::vector<CoreInstance>& instances_;
    const OpacityOf& opacity_of_;
    uint32_t threads_;
    const MovingParts& moving_;
    bool layered_ = false;  // something moves
    WideTree still_;        // of what is baked, where it is a tree of its own
    std::vector<uint32_t> uses_;
    std::vector<bool> needs_tree_;
    std::vector<uint32_t> baked_;     // instances whose triangles go into the scene's tree
    std::vector<uint32_t> recorded_;  // instances that are leaves of it
    std::vector<MeshTree> mesh_trees_;
    uint32_t mesh_stack_need_ = 0;
    uint32_t stack_need_ = 0;
    GeometryTables tables_;
};

}  // namespace

uint64_t least_bytes(uint64_t triangles, uint64_t vertex_rows) {
    const uint64_t row = sizeof(glm::vec4);
    return triangles * (TRIANGLE_ROWS * row + row) + vertex_rows * row;
}

Result<GeometryTables> build_geometry(const std::vector<CoreMeshCopy>& meshes,
                                      const std::vector<CoreInstance>& instances, const OpacityOf& opacity_of,
                                      uint32_t threads, const MovingParts& moving) {
    return GeometryBuilder(meshes, instances, opacity_of, threads, moving).build();
}

}  // namespace source_core
