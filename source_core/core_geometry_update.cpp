// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Brings tables that are on the device up to date.
#include <algorithm>

#include "source_core/core_geometry_parts.h"
#include "source_core/core_tables.h"

namespace source_core {

namespace {

constexpr double WORN_COST = 1.4;  // of a tree, in its cost when it was built

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
    void patch(uint32_t table, uint64_t first_row, std::vector<WideNode> rows) {
        update_.patches.push_back({table, first_row * sizeof(WideNode), std::move(rows)});
    }

    void patch(uint32_t table, uint64_t first_row, std::vector<glm::vec4> rows) {
        update_.patches.push_back({table, first_row * sizeof(glm::vec4), std::move(rows)});
    }

    // The triangles of a mesh as its tree has them; none where one is out of reach, or was when the tree was built.
    std::vector<glm::vec4> slots_of(const CoreMeshCopy& mesh, const WideTree& tree) const {
        std::vector<glm::vec4> rows;
        if (tree.order.size() != mesh.triangles.size()) {
            return rows;
        }
        rows.reserve(tree.order.size() * TRIANGLE_ROWS);
        for (const uint32_t primitive : tree.order) {
            const Triangle triangle = triangle_of(mesh, primitive);
            if (!is_reachable(triangle)) {
                return {};
            }
            append_slot(triangle, opacity_of_(mesh.triangles[primitive].w, mesh.has_colors()), primitive,
                        render_system::NONE, rows);
        }
        return rows;
    }

    bool fit_mesh(uint32_t m) {
        MeshPlan& plan = plan_.meshes[m];
        const CoreMeshCopy& mesh = meshes_[m];
        std::vector<glm::vec4> slots = slots_of(mesh, plan.tree);
        if (slots.empty()) {
            return false;
        }
        refit_wide_tree(plan.tree, slots);
        if (walk_cost(plan.tree) > WORN_COST * plan.built_cost) {
            build_mesh_tree(m);
            slots = slots_of(mesh, plan.tree);
        }
        if (plan.tree.nodes.size() > plan.node_room) {
            return false;
        }
        Box box;
        for (const glm::vec4& vertex : slots) {
            box.include(glm::vec3(vertex));
        }
        plan.lower = box.lower;
        plan.upper = box.upper;
        std::vector<WideNode> nodes;
        nodes.reserve(plan.tree.nodes.size());
        append_nodes(plan.tree.nodes, plan.first_node, plan.first_slot, nodes);
        patch(BINDING_NODES, plan.first_node, std::move(nodes));
        patch(BINDING_TRIANGLES, uint64_t{plan.first_slot} * TRIANGLE_ROWS, std::move(slots));
        update_.patches.push_back({BINDING_VERTICES, plan.first_vertex_row * sizeof(glm::vec4), RowsOfMesh{m}});
        return true;
    }

    // A tree in place of one that is worn, and where it has put each triangle.
    void build_mesh_tree(uint32_t m) {
        MeshPlan& plan = plan_.meshes[m];
        std::vector<BuildPrimitive> primitives;
        for (uint32_t i = 0; i < meshes_[m].triangles.size(); ++i) {
            primitives.push_back(primitive_of(triangle_of(meshes_[m], i), i));
        }
        plan.tree = build_wide_tree(std::move(primitives), threads_, MESH_STACK_LIMIT);
        plan.built_cost = walk_cost(plan.tree);
        uint32_t slot = plan.first_slot;
        for (const uint32_t primitive : plan.tree.order) {
            plan_.mesh_slots[m][primitive] = slot++;
        }
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
        if (!records.empty()) {
            patch(BINDING_NODES, uint64_t{plan_.first_record} + first, std::move(records));
        }
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
        patch(BINDING_INSTANCES, uint64_t{*first} * INSTANCE_ROWS, std::move(rows));
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
        patch(BINDING_NODES, plan_.spare_node, std::move(nodes));
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

std::span<const std::byte> bytes_of(const TablePatch& patch, const std::vector<CoreMeshCopy>& meshes) {
    if (const auto* own = std::get_if<RowsOfMesh>(&patch.rows)) {
        return std::as_bytes(std::span(meshes[own->mesh].vertex_rows));
    }
    if (const auto* nodes = std::get_if<std::vector<WideNode>>(&patch.rows)) {
        return std::as_bytes(std::span(*nodes));
    }
    return std::as_bytes(std::span(std::get<std::vector<glm::vec4>>(patch.rows)));
}

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
