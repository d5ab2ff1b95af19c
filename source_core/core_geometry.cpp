// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/core_geometry.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>

#include "source_core/core_tables.h"

namespace source_core {

using render_system::CoreTransform;
using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

namespace {

constexpr float FARTHEST = 1.0e18f;            // triangles beyond cannot be hit: their products overflow
constexpr double PAD_SCALE = 1.0 / (1 << 21);  // as in trace.glsl
constexpr double BOX_SLACK = 1.0 / (1 << 20);  // for the rounding of transformed vertices
constexpr uint32_t MESH_STACK_LIMIT = 30;
constexpr uint32_t ENTER_INSTANCE_STACK = 2;
constexpr uint32_t TOP_STACK_LIMIT = 24;    // with medians enough for 4^8 instances
constexpr uint32_t MOST_IN_TOP = 1u << 16;  // of more instances each move builds all anew
constexpr double WORN_COST = 1.4;           // of a tree, in its cost when it was built

float as_float(uint32_t bits) { return std::bit_cast<float>(bits); }

// The arithmetic of transform_point in kernels/intersect.glsl: baked and instanced vertices agree in every bit.
glm::vec3 transform_point(const CoreTransform& transform, const glm::vec3& p) {
    const glm::vec4* rows = transform.rows;
    return glm::vec3(((rows[0].x * p.x + rows[0].y * p.y) + rows[0].z * p.z) + rows[0].w,
                     ((rows[1].x * p.x + rows[1].y * p.y) + rows[1].z * p.z) + rows[1].w,
                     ((rows[2].x * p.x + rows[2].y * p.y) + rows[2].z * p.z) + rows[2].w);
}

struct Triangle {
    glm::vec3 vertices[3];
};

struct Box {
    glm::vec3 lower{FARTHEST};
    glm::vec3 upper{-FARTHEST};

    void include(const glm::vec3& p) {
        lower = glm::min(lower, p);
        upper = glm::max(upper, p);
    }
};

bool is_reachable(const Triangle& triangle) {
    for (const glm::vec3& p : triangle.vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            if (!(std::fabs(p[axis]) < FARTHEST)) {
                return false;
            }
        }
    }
    return true;
}

Triangle triangle_of(const CoreMeshCopy& mesh, uint32_t primitive) {
    const glm::uvec4& corners = mesh.triangles[primitive];
    return {{mesh.positions[corners.x], mesh.positions[corners.y], mesh.positions[corners.z]}};
}

BuildPrimitive primitive_of(const Triangle& triangle, uint32_t id) {
    Box box;
    for (const glm::vec3& p : triangle.vertices) {
        box.include(p);
    }
    return {box.lower, id, box.upper, 0};
}

// The inverse of the transform's matrix and where it takes the origin to; not usable where the matrix is singular.
struct Inverse {
    double rows[3][4];
    bool usable;
};

Inverse invert(const CoreTransform& transform) {
    glm::dmat3 matrix;  // columns
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            matrix[c][r] = transform.rows[r][c];
        }
    }
    const double determinant = glm::determinant(matrix);
    Inverse result{{}, std::fabs(determinant) > 1e-30};
    const glm::dmat3 inverse = glm::inverse(matrix);
    for (int r = 0; r < 3; ++r) {
        double moved = 0.0;
        for (int c = 0; c < 3; ++c) {
            result.rows[r][c] = inverse[c][r];
            moved -= inverse[c][r] * transform.rows[c].w;
            result.usable = result.usable && std::fabs(inverse[c][r]) < 1e15;
        }
        result.rows[r][3] = moved;
        result.usable = result.usable && std::fabs(moved) < 1e15;
    }
    return result;
}

// World-space box around the transformed box, with room for the rounding of its vertices.
Box transform_box(const CoreTransform& transform, const Box& box) {
    Box result;
    for (int r = 0; r < 3; ++r) {
        double lower = transform.rows[r].w;
        double upper = lower;
        double reach = std::fabs(lower);
        for (int c = 0; c < 3; ++c) {
            const double a = static_cast<double>(transform.rows[r][c]) * box.lower[c];
            const double b = static_cast<double>(transform.rows[r][c]) * box.upper[c];
            lower += std::min(a, b);
            upper += std::max(a, b);
            reach += std::max(std::fabs(a), std::fabs(b));
        }
        result.lower[r] = static_cast<float>(lower - reach * BOX_SLACK);
        result.upper[r] = static_cast<float>(upper + reach * BOX_SLACK);
    }
    return result;
}

// The node that stands for an instance: see RECORD_PAD in bindings.h.
WideNode make_record(const Inverse& inverse, const Box& world, uint32_t root, uint32_t instance) {
    glm::vec4 rows[NODE_ROWS] = {};
    for (int r = 0; r < 3; ++r) {
        double pad = std::fabs(inverse.rows[r][3]);
        double growth = 0.0;
        for (int c = 0; c < 3; ++c) {
            const double size = std::fabs(inverse.rows[r][c]);
            pad += size * std::max(std::fabs(world.lower[c]), std::fabs(world.upper[c]));
            growth += size * 2.0;
            rows[r][c] = static_cast<float>(inverse.rows[r][c]);
        }
        rows[r].w = static_cast<float>(inverse.rows[r][3]);
        rows[RECORD_PAD][r] = static_cast<float>(pad * PAD_SCALE);
        rows[RECORD_INSTANCE][r] = static_cast<float>(growth * PAD_SCALE);
    }
    rows[RECORD_PAD].w = as_float(root);
    rows[RECORD_INSTANCE].w = as_float(instance);
    return std::bit_cast<WideNode>(rows);
}

// Three rows of the table of triangles.
void append_slot(const Triangle& triangle, float opacity, uint32_t primitive, uint32_t instance,
                 std::vector<glm::vec4>& rows) {
    rows.push_back(glm::vec4(triangle.vertices[0], opacity));
    rows.push_back(glm::vec4(triangle.vertices[1], as_float(primitive)));
    rows.push_back(glm::vec4(triangle.vertices[2], as_float(instance)));
}

// The nodes of a tree as they stand in the table: the tree's own from `first_node` on, its leaves from `first_slot`.
void append_nodes(const std::vector<WideNode>& nodes, uint32_t first_node, uint32_t first_slot,
                  std::vector<WideNode>& table) {
    for (WideNode node : nodes) {
        for (uint32_t& word : node.children) {
            const uint32_t leaf_count = (word >> LEAF_COUNT_SHIFT) & LEAF_COUNT_MASK;
            if ((word & LEAF) == 0) {
                word += first_node;
            } else if (leaf_count != 0 && leaf_count != LEAF_INSTANCE) {
                word += first_slot;
            }
        }
        table.push_back(node);
    }
}

// What hangs on the top of the tree as an instance does, with the number of a record.
BuildPrimitive hanging(const Box& box, uint32_t number) { return {box.lower, number, box.upper, 1}; }

// Turns the leaves of a tree that hang on it into words for records, or for the tree of what stands still.
void name_hanging(std::vector<WideNode>& nodes, const GeometryPlan& plan) {
    for (WideNode& node : nodes) {
        for (uint32_t& word : node.children) {
            if ((word & LEAF) == 0 || ((word >> LEAF_COUNT_SHIFT) & LEAF_COUNT_MASK) != LEAF_INSTANCE) {
                continue;
            }
            const uint32_t number = word & LEAF_FIRST_MASK;
            const bool still = number == plan.recorded.size();
            word = still ? plan.still_root : LEAF | (LEAF_INSTANCE << LEAF_COUNT_SHIFT) | (plan.first_record + number);
        }
    }
}

glm::vec3 extent_of(const std::vector<BuildPrimitive>& primitives) {
    glm::vec3 extent(0.0f);
    for (const BuildPrimitive& primitive : primitives) {
        extent = glm::max(extent, glm::max(glm::abs(primitive.lower), glm::abs(primitive.upper)));
    }
    return extent;
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
        size_t vertex_rows = 1;
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
        tables_.vertices.push_back(glm::vec4(0.0f));
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

namespace {

class GeometryUpdater {
public:
    GeometryUpdater(const std::vector<CoreMeshCopy>& meshes, const std::vector<CoreInstance>& instances,
                    const OpacityOf& opacity_of, uint32_t threads, GeometryPlan& plan)
        : meshes_(meshes), instances_(instances), opacity_of_(opacity_of), threads_(threads), plan_(plan) {}

    bool update(const std::vector<uint32_t>& moved, const std::vector<uint32_t>& deformed) {
        if (!plan_.top_has_records_alone || plan_.spare_count == 0) {
            return false;
        }
        for (const uint32_t mesh : deformed) {
            if (!fit_mesh(mesh)) {
                return false;
            }
        }
        std::vector<bool> reshaped(meshes_.size(), false);
        for (const uint32_t mesh : deformed) {
            reshaped[mesh] = true;
        }
        std::vector<uint32_t> placed = moved;
        for (uint32_t i = 0; i < instances_.size(); ++i) {
            if (instances_[i].mesh != render_system::NONE && reshaped[instances_[i].mesh]) {
                placed.push_back(i);
            }
        }
        if (!patch_records(placed)) {
            return false;
        }
        patch_instances(placed);
        return build_top();
    }

    GeometryUpdate take() { return std::move(update_); }

private:
    template <class Row>
    void patch(uint32_t table, uint64_t first_row, const std::vector<Row>& rows) {
        const auto bytes = std::as_bytes(std::span(rows));
        update_.patches.push_back({table, first_row * sizeof(Row), {bytes.begin(), bytes.end()}});
    }

    bool fit_mesh(uint32_t m) {
        MeshPlan& plan = plan_.meshes[m];
        const CoreMeshCopy& mesh = meshes_[m];
        if (plan.tree.nodes.empty()) {
            return false;
        }
        std::vector<BuildPrimitive> slots;
        for (const uint32_t primitive : plan.tree.order) {
            const Triangle triangle = triangle_of(mesh, primitive);
            if (!is_reachable(triangle)) {
                return false;
            }
            slots.push_back(primitive_of(triangle, primitive));
        }
        const Box box = box_of(slots);
        plan.lower = box.lower;
        plan.upper = box.upper;
        refit_wide_tree(plan.tree, slots);
        if (walk_cost(plan.tree) > WORN_COST * plan.built_cost) {
            plan.tree = build_wide_tree(std::move(slots), threads_, MESH_STACK_LIMIT);
            plan.built_cost = walk_cost(plan.tree);
        }
        if (plan.tree.nodes.size() > plan.node_room) {
            return false;
        }
        patch_mesh(mesh, plan, plan_.mesh_slots[m]);
        return true;
    }

    void patch_mesh(const CoreMeshCopy& mesh, const MeshPlan& plan, std::vector<uint32_t>& slots) {
        std::vector<WideNode> nodes;
        append_nodes(plan.tree.nodes, plan.first_node, plan.first_slot, nodes);
        patch(BINDING_NODES, plan.first_node, nodes);
        std::vector<glm::vec4> triangles;
        for (const uint32_t primitive : plan.tree.order) {
            slots[primitive] = plan.first_slot + static_cast<uint32_t>(triangles.size() / TRIANGLE_ROWS);
            append_slot(triangle_of(mesh, primitive), opacity_of_(mesh.triangles[primitive].w, mesh.has_colors()),
                        primitive, render_system::NONE, triangles);
        }
        patch(BINDING_TRIANGLES, uint64_t{plan.first_slot} * TRIANGLE_ROWS, triangles);
        patch(BINDING_VERTICES, plan.first_vertex_row, mesh.vertex_rows);
    }

    Box world_box(const CoreInstance& instance) const {
        const MeshPlan& mesh = plan_.meshes[instance.mesh];
        return transform_box(instance.transform, {mesh.lower, mesh.upper});
    }

    // One patch from the first record to the last: copying has a price of its own.
    bool patch_records(const std::vector<uint32_t>& placed) {
        uint32_t first = render_system::NONE, last = 0;
        for (const uint32_t i : placed) {
            const uint32_t record = plan_.record_of[i];
            if (record == render_system::NONE && !meshes_[instances_[i].mesh].triangles.empty()) {
                return false;
            }
            if (record != render_system::NONE) {
                first = std::min(first, record);
                last = std::max(last, record);
            }
        }
        std::vector<WideNode> records;
        for (uint32_t record = first; record != render_system::NONE && record <= last; ++record) {
            const uint32_t i = plan_.recorded[record];
            const Inverse inverse = invert(instances_[i].transform);
            if (!inverse.usable) {
                return false;
            }
            records.push_back(
                make_record(inverse, world_box(instances_[i]), plan_.meshes[instances_[i].mesh].first_node, i));
        }
        patch(BINDING_NODES, uint64_t{plan_.first_record} + (records.empty() ? 0 : first), records);
        return true;
    }

    void patch_instances(const std::vector<uint32_t>& placed) {
        if (placed.empty()) {
            return;
        }
        const auto [first, last] = std::minmax_element(placed.begin(), placed.end());
        std::vector<glm::vec4> rows((*last - *first + 1) * INSTANCE_ROWS, glm::vec4(0.0f));
        for (uint32_t i = *first; i <= *last; ++i) {
            const CoreInstance& instance = instances_[i];
            if (instance.mesh != render_system::NONE) {
                const MeshPlan& mesh = plan_.meshes[instance.mesh];
                pack_instance(instance.transform, mesh.first_triangle, mesh.first_vertex_row,
                              meshes_[instance.mesh].flags, &rows[(i - *first) * INSTANCE_ROWS]);
            }
        }
        patch(BINDING_INSTANCES, uint64_t{*first} * INSTANCE_ROWS, rows);
    }

    // Node 0 stays the root; the others of the new top go behind the table, where the build has left room.
    bool build_top() {
        std::vector<BuildPrimitive> primitives;
        for (uint32_t k = 0; k < plan_.recorded.size(); ++k) {
            const CoreInstance& instance = instances_[plan_.recorded[k]];
            if (!plan_.meshes[instance.mesh].is_empty) {
                primitives.push_back(hanging(world_box(instance), k));
            }
        }
        update_.extent = glm::max(plan_.still_extent, extent_of(primitives));
        if (plan_.has_still) {
            primitives.push_back(
                hanging({plan_.still_lower, plan_.still_upper}, static_cast<uint32_t>(plan_.recorded.size())));
        }
        const WideTree top = build_wide_tree(std::move(primitives), threads_, plan_.top_stack);
        if (top.nodes.size() - 1 > plan_.spare_count || top.stack_need > plan_.top_stack) {
            return false;
        }
        std::vector<WideNode> nodes;
        append_nodes(top.nodes, plan_.spare_node - 1, 0, nodes);  // node 1 is the first spare one
        name_hanging(nodes, plan_);
        patch(BINDING_NODES, 0, std::vector<WideNode>{nodes.front()});
        nodes.erase(nodes.begin());
        patch(BINDING_NODES, plan_.spare_node, nodes);
        return true;
    }

    const std::vector<CoreMeshCopy>& meshes_;
    const std::vector<CoreInstance>& instances_;
    const OpacityOf& opacity_of_;
    uint32_t threads_;
    GeometryPlan& plan_;
    GeometryUpdate update_;
};

}  // namespace

std::optional<GeometryUpdate> update_geometry(const std::vector<CoreMeshCopy>& meshes,
                                              const std::vector<CoreInstance>& instances,
                                              const std::vector<uint32_t>& moved, const std::vector<uint32_t>& deformed,
                                              const OpacityOf& opacity_of, uint32_t threads, GeometryPlan& plan) {
    GeometryUpdater updater(meshes, instances, opacity_of, threads, plan);
    if (!updater.update(moved, deformed)) {
        return {};
    }
    return updater.take();
}

}  // namespace source_core
