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
constexpr uint32_t UNPLACED = 0xFFFFFFFFu;

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

class GeometryBuilder {
public:
    GeometryBuilder(const std::vector<CoreMeshCopy>& meshes, const std::vector<CoreInstance>& instances,
                    const OpacityOf& opacity_of, uint32_t threads)
        : meshes_(meshes), instances_(instances), opacity_of_(opacity_of), threads_(threads) {}

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
        return std::move(tables_);
    }

private:
    struct MeshTree {
        WideTree tree;
        Box box;
        uint32_t first_slot = 0;
        uint32_t first_node = 0;
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
            const bool has_record = shares_its_mesh(instances_[i]) && invert(instances_[i].transform).usable;
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
        const float opacity = opacity_of_(mesh.triangles[primitive].w, mesh.has_colors);
        tables_.features |= opacity < 1.0f ? FEATURE_ALPHA : 0u;
        tables_.features |= opacity < 0.0f ? FEATURE_ALPHA_TEXTURES : 0u;
        tables_.triangles.push_back(glm::vec4(triangle.vertices[0], opacity));
        tables_.triangles.push_back(glm::vec4(triangle.vertices[1], as_float(primitive)));
        tables_.triangles.push_back(glm::vec4(triangle.vertices[2], as_float(instance)));
    }

    void build_mesh_trees() {
        mesh_trees_.resize(meshes_.size());
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
            for (const uint32_t primitive : result.tree.order) {
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
        for (const uint32_t i : baked_) {
            const uint32_t count = static_cast<uint32_t>(meshes_[instances_[i].mesh].triangles.size());
            for (uint32_t primitive = 0; primitive < count; ++primitive) {
                const Triangle triangle = place({i, primitive});
                if (is_reachable(triangle)) {
                    primitives.push_back(primitive_of(triangle, static_cast<uint32_t>(baked.size())));
                    baked.push_back({i, primitive});
                }
            }
        }
        for (uint32_t k = 0; k < recorded_.size(); ++k) {
            const CoreInstance& instance = instances_[recorded_[k]];
            if (mesh_trees_[instance.mesh].is_empty) {
                continue;
            }
            const Box box = transform_box(instance.transform, mesh_trees_[instance.mesh].box);
            primitives.push_back({box.lower, k, box.upper, 1});
        }
        for (const BuildPrimitive& primitive : primitives) {
            tables_.extent = glm::max(tables_.extent, glm::max(glm::abs(primitive.lower), glm::abs(primitive.upper)));
        }
        const uint32_t limit = STACK_SIZE - 1 - mesh_stack_need_;
        const WideTree scene = build_wide_tree(std::move(primitives), threads_, limit);
        stack_need_ = 1 + mesh_stack_need_ + scene.stack_need;

        const uint32_t first_slot = static_cast<uint32_t>(tables_.triangles.size() / TRIANGLE_ROWS);
        for (const uint32_t id : scene.order) {
            add_slot(place(baked[id]), baked[id].primitive, baked[id].instance,
                     meshes_[instances_[baked[id].instance].mesh]);
        }
        append_trees(scene, first_slot);
    }

    // The scene's nodes first, then those of the meshes, then the records.
    void append_trees(const WideTree& scene, uint32_t first_slot) {
        size_t count = scene.nodes.size();
        for (MeshTree& mesh : mesh_trees_) {
            mesh.first_node = static_cast<uint32_t>(count);
            count += mesh.tree.nodes.size();
        }
        append_nodes(scene.nodes, 0, first_slot, static_cast<uint32_t>(count));
        for (const MeshTree& mesh : mesh_trees_) {
            append_nodes(mesh.tree.nodes, mesh.first_node, mesh.first_slot, 0);
        }
        for (const uint32_t i : recorded_) {
            const CoreInstance& instance = instances_[i];
            const MeshTree& mesh = mesh_trees_[instance.mesh];
            tables_.nodes.push_back(make_record(invert(instance.transform), transform_box(instance.transform, mesh.box),
                                                mesh.first_node, i));
        }
    }

    void append_nodes(const std::vector<WideNode>& nodes, uint32_t first_node, uint32_t first_slot,
                      uint32_t first_record) {
        for (WideNode node : nodes) {
            for (uint32_t& word : node.children) {
                const uint32_t leaf_count = (word >> LEAF_COUNT_SHIFT) & LEAF_COUNT_MASK;
                if ((word & LEAF) == 0) {
                    word += first_node;
                } else if (leaf_count != 0) {
                    word += leaf_count == LEAF_INSTANCE ? first_record : first_slot;
                }
            }
            tables_.nodes.push_back(node);
        }
    }

    void pack_meshes() {
        std::vector<uint32_t> first_triangle(meshes_.size());
        std::vector<uint32_t> first_vertex(meshes_.size());
        for (size_t m = 0; m < meshes_.size(); ++m) {
            const CoreMeshCopy& mesh = meshes_[m];
            first_triangle[m] = static_cast<uint32_t>(tables_.mesh_triangles.size());
            first_vertex[m] = static_cast<uint32_t>(tables_.vertices.size() / VERTEX_ROWS);
            tables_.mesh_triangles.insert(tables_.mesh_triangles.end(), mesh.triangles.begin(), mesh.triangles.end());
            tables_.vertices.insert(tables_.vertices.end(), mesh.vertex_rows.begin(), mesh.vertex_rows.end());
            tables_.tangents.insert(tables_.tangents.end(), mesh.tangents.begin(), mesh.tangents.end());
            tables_.features |= mesh.has_colors ? FEATURE_VERTEX_COLORS : 0u;
        }
        tables_.instances.assign(instances_.size() * INSTANCE_ROWS, glm::vec4(0.0f));
        for (size_t i = 0; i < instances_.size(); ++i) {
            const CoreInstance& instance = instances_[i];
            if (instance.mesh != render_system::NONE) {
                pack_instance(instance.transform, first_triangle[instance.mesh], first_vertex[instance.mesh],
                              meshes_[instance.mesh].has_tangents, &tables_.instances[i * INSTANCE_ROWS]);
            }
        }
    }

    const std::vector<CoreMeshCopy>& meshes_;
    const std::vector<CoreInstance>& instances_;
    const OpacityOf& opacity_of_;
    uint32_t threads_;
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

uint64_t least_bytes(uint64_t triangles, uint64_t vertices) {
    const uint64_t row = sizeof(glm::vec4);
    return triangles * (TRIANGLE_ROWS * row + row) + vertices * (VERTEX_ROWS * row + sizeof(uint32_t));
}

Result<GeometryTables> build_geometry(const std::vector<CoreMeshCopy>& meshes,
                                      const std::vector<CoreInstance>& instances, const OpacityOf& opacity_of,
                                      uint32_t threads) {
    return GeometryBuilder(meshes, instances, opacity_of, threads).build();
}

}  // namespace source_core
