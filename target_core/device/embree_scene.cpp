// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/embree_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace target_core {

namespace {

// Scenes up to this size are built with spatial splits.
constexpr uint64_t SPLIT_TRIANGLES = 400'000;
// How many references to triangles these may make of one; Embree's own is 1.2.
constexpr const char* SPLIT_REPLICATIONS = "2";
// From this size on trees are compact: a sixth of the peak less for a third more of tracing.
constexpr uint64_t COMPACT_TRIANGLES = 16'000'000;

double milliseconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

// What makes Embree keep a tree for each geometry, built or fitted as that asks for.
constexpr RTCBuildQuality kTreeEach = RTC_BUILD_QUALITY_LOW;

uint64_t count_triangles(std::span<const InstanceGeometry> geometry) {
    uint64_t count = 0;
    for (const InstanceGeometry& instance : geometry) count += instance.triangle_count;
    return count;
}

// Those of the scene's own tree; instances have others.
uint64_t count_baked(std::span<const InstanceGeometry> geometry) {
    uint64_t count = 0;
    for (const InstanceGeometry& instance : geometry) count += instance.baked ? instance.triangle_count : 0;
    return count;
}

}  // namespace

EmbreeScene::~EmbreeScene() { close(); }

void EmbreeScene::close() {
    release_scenes();
    if (device_) {
        rtcReleaseDevice(device_);
        device_ = nullptr;
    }
}

bool EmbreeScene::open(uint threads, std::string& message) {
    std::string options =
        "threads=" + std::to_string(threads) + ",max_spatial_split_replications=" + SPLIT_REPLICATIONS;
    device_ = rtcNewDevice(options.c_str());
    if (!device_) {
        message = "Embree could not be opened (error " + std::to_string(rtcGetDeviceError(nullptr)) + ")";
        return false;
    }
    auto count_memory = [](void* pointer, ssize_t bytes, bool) {
        static_cast<EmbreeScene*>(pointer)->memory_.fetch_add(bytes, std::memory_order_relaxed);
        return true;
    };
    rtcSetDeviceMemoryMonitorFunction(device_, count_memory, this);
    return true;
}

void EmbreeScene::release_scenes() {
    if (scene_) {
        rtcReleaseScene(scene_);
        scene_ = nullptr;
    }
    for (RTCScene scene : mesh_scenes_) {
        if (scene) {
            rtcReleaseScene(scene);
        }
    }
    mesh_scenes_.clear();
}

RTCGeometry EmbreeScene::triangle_geometry(const InstanceGeometry& geometry) {
    RTCGeometry triangles = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, geometry.positions, 0,
                               sizeof(PackedVertex), geometry.vertex_count);
    rtcSetSharedGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, geometry.triangles, 0,
                               sizeof(uvec4), geometry.triangle_count);
    if (geometry.lets_rays_pass) {
        rtcSetGeometryIntersectFilterFunction(triangles, filter_by_alpha);
        rtcSetGeometryOccludedFilterFunction(triangles, filter_by_alpha);
    }
    rtcCommitGeometry(triangles);
    return triangles;
}

RTCScene EmbreeScene::mesh_scene(const InstanceGeometry& geometry) {
    if (mesh_scenes_.size() <= geometry.mesh) {
        mesh_scenes_.resize(geometry.mesh + 1, nullptr);
    }
    RTCScene& scene = mesh_scenes_[geometry.mesh];
    if (!scene) {
        scene = rtcNewScene(device_);
        RTCGeometry triangles = triangle_geometry(geometry);
        if (geometry.deforms) {
            rtcSetSceneFlags(scene, RTC_SCENE_FLAG_DYNAMIC);
            rtcSetSceneBuildQuality(scene, kTreeEach);
            rtcSetGeometryBuildQuality(triangles, RTC_BUILD_QUALITY_REFIT);
            rtcCommitGeometry(triangles);
        }
        rtcAttachGeometry(scene, triangles);
        rtcReleaseGeometry(triangles);
        rtcCommitScene(scene);
    }
    return scene;
}

void EmbreeScene::attach(const InstanceGeometry& geometry, uint instance, bool exact) {
    RTCGeometry attached = nullptr;
    if (exact) {
        attached = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
        rtcSetGeometryUserPrimitiveCount(attached, geometry.triangle_count);
        rtcSetGeometryUserData(attached, const_cast<InstanceGeometry*>(&geometry));
        rtcSetGeometryBoundsFunction(attached, bound_triangle, nullptr);
        rtcSetGeometryIntersectFunction(attached, intersect_exactly);
        rtcSetGeometryOccludedFunction(attached, occlude_exactly);
        rtcCommitGeometry(attached);
    } else if (geometry.baked) {
        attached = triangle_geometry(geometry);
    } else {
        attached = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
        rtcSetGeometryInstancedScene(attached, mesh_scene(geometry));
        rtcSetGeometryTransform(attached, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, geometry.rows);
        rtcCommitGeometry(attached);
    }
    rtcAttachGeometryByID(scene_, attached, instance);
    rtcReleaseGeometry(attached);
}

bool EmbreeScene::check(std::string& message) {
    RTCError error = rtcGetDeviceError(device_);
    if (error == RTC_ERROR_NONE) {
        return true;
    }
    message = error == RTC_ERROR_OUT_OF_MEMORY ? "Embree ran out of memory while building"
                                               : "Embree failed to build (error " + std::to_string(error) + ")";
    return false;
}

bool EmbreeScene::build(std::span<const InstanceGeometry> geometry, bool exact, bool alive, std::string& message) {
    auto start = std::chrono::steady_clock::now();
    release_scenes();
    alive_ = alive && !exact;
    has_baked_ = std::any_of(geometry.begin(), geometry.end(), [](const InstanceGeometry& instance) {
        return instance.baked && instance.triangle_count > 0;
    });
    attach_all(geometry, exact);
    build_ms_ = milliseconds_since(start);
    return check(message);
}

void EmbreeScene::attach_all(std::span<const InstanceGeometry> geometry, bool exact) {
    scene_ = rtcNewScene(device_);
    // Spatial splits save pica a fifth of its tracing for 50 ms of building; on a million triangles they save a
    // twentieth and cost a third of a second.
    const bool is_small = count_triangles(geometry) <= SPLIT_TRIANGLES;
    const bool is_huge = count_baked(geometry) >= COMPACT_TRIANGLES;
    const RTCSceneFlags still = is_huge ? RTC_SCENE_FLAG_COMPACT : RTC_SCENE_FLAG_NONE;
    rtcSetSceneBuildQuality(scene_, alive_ ? kTreeEach : is_small ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    // Exact mode must visit every box that the ray may touch.
    rtcSetSceneFlags(scene_, exact ? RTC_SCENE_FLAG_ROBUST : alive_ ? RTC_SCENE_FLAG_DYNAMIC : still);
    for (uint instance = 0; instance < geometry.size(); ++instance) {
        if (geometry[instance].triangle_count > 0) {
            attach(geometry[instance], instance, exact);
        }
    }
    rtcCommitScene(scene_);
}

float EmbreeScene::largest_coordinate() const {
    RTCBounds box;
    rtcGetSceneBounds(scene_, &box);
    const float lower = std::max({std::fabs(box.lower_x), std::fabs(box.lower_y), std::fabs(box.lower_z)});
    return std::max({lower, std::fabs(box.upper_x), std::fabs(box.upper_y), std::fabs(box.upper_z)});
}

bool EmbreeScene::update(std::span<const InstanceGeometry> geometry, std::span<const uint> moved,
                         std::span<const uint> deformed, std::span<const uint> worn, std::string& message) {
    const auto start = std::chrono::steady_clock::now();
    std::vector<bool> reshaped(mesh_scenes_.size(), false);
    for (uint mesh : deformed) {
        if (mesh >= mesh_scenes_.size() || !mesh_scenes_[mesh]) continue;  // not in the scene
        reshaped[mesh] = true;
        RTCGeometry triangles = rtcGetGeometry(mesh_scenes_[mesh], 0);
        const bool anew = std::find(worn.begin(), worn.end(), mesh) != worn.end();
        rtcSetGeometryBuildQuality(triangles, anew ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_REFIT);
        rtcUpdateGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0);
        rtcCommitGeometry(triangles);
        rtcCommitScene(mesh_scenes_[mesh]);
    }
    for (uint instance : moved) {
        if (geometry[instance].triangle_count == 0) continue;
        rtcSetGeometryTransform(rtcGetGeometry(scene_, instance), 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR,
                                geometry[instance].rows);
        rtcCommitGeometry(rtcGetGeometry(scene_, instance));
    }
    for (uint instance = 0; instance < geometry.size() && !deformed.empty(); ++instance) {
        const InstanceGeometry& placed = geometry[instance];
        if (placed.triangle_count > 0 && placed.mesh < reshaped.size() && reshaped[placed.mesh])
            rtcCommitGeometry(rtcGetGeometry(scene_, instance));
    }
    rtcCommitScene(scene_);
    build_ms_ = milliseconds_since(start);
    return check(message);
}

}  // namespace target_core
