// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "target_core/device/embree_scene.h"

#include <algorithm>
#include <chrono>

#include "target_core/device/coincident.h"

namespace target_core {

namespace {

// Scenes up to this size are built with spatial splits.
constexpr uint64_t SPLIT_TRIANGLES = 400'000;
// How many references to triangles these may make of one; Embree's own is 1.2.
constexpr const char* SPLIT_REPLICATIONS = "2";

uint64_t count_triangles(std::span<const InstanceGeometry> geometry) {
    uint64_t count = 0;
    for (const InstanceGeometry& instance : geometry) count += instance.triangle_count;
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

bool EmbreeScene::build(std::span<const InstanceGeometry> geometry, bool exact, std::string& message) {
    auto start = std::chrono::steady_clock::now();
    release_scenes();
    shared_ = {geometry, {}};
    thinned_.clear();
    attach_all(geometry, exact);
    if (!exact) shared_.triangles = find_shared_triangles(scene_, geometry);
    if (!shared_.triangles.empty()) {
        release_scenes();
        const std::vector<InstanceGeometry> rest = without_shared(geometry);
        attach_all(rest, false);
        attach_shared();
        rtcCommitScene(scene_);
    }
    build_ms_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return check(message);
}

void EmbreeScene::attach_all(std::span<const InstanceGeometry> geometry, bool exact) {
    scene_ = rtcNewScene(device_);
    // Spatial splits save pica a fifth of its tracing for 50 ms of building; on a million triangles they save a
    // twentieth and cost a third of a second.
    rtcSetSceneBuildQuality(
        scene_, count_triangles(geometry) <= SPLIT_TRIANGLES ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    // Exact mode must visit every box that the ray may touch.
    rtcSetSceneFlags(scene_, exact ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE);
    for (uint instance = 0; instance < geometry.size(); ++instance) {
        if (geometry[instance].triangle_count > 0) {
            attach(geometry[instance], instance, exact);
        }
    }
    rtcCommitScene(scene_);
}

// Embree reads the triangles by their numbers, so those that stand elsewhere stay as triangles without an area.
std::vector<InstanceGeometry> EmbreeScene::without_shared(std::span<const InstanceGeometry> geometry) {
    std::vector<InstanceGeometry> rest(geometry.begin(), geometry.end());
    std::vector<SharedTriangle> all;
    thinned_.resize(geometry.size());
    for (const SharedTriangle& shared : shared_.triangles) {
        const InstanceGeometry& whole = geometry[shared.instance];
        if (whole.baked) {
            std::vector<uvec4>& triangles = thinned_[shared.instance];
            if (triangles.empty()) triangles.assign(whole.triangles, whole.triangles + whole.triangle_count);
            uvec4& triangle = triangles[shared.primitive];
            triangle = uvec4(triangle.x, triangle.x, triangle.x, triangle.w);
            all.push_back(shared);
            rest[shared.instance].triangles = triangles.data();
        } else if (rest[shared.instance].triangle_count > 0) {
            rest[shared.instance].triangle_count = 0;
            for (uint i = 0; i < whole.triangle_count; ++i) all.push_back({shared.instance, i});
        }
    }
    shared_.triangles = std::move(all);
    return rest;
}

void EmbreeScene::attach_shared() {
    RTCGeometry attached = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(attached, static_cast<uint>(shared_.triangles.size()));
    rtcSetGeometryUserData(attached, &shared_);
    rtcSetGeometryBoundsFunction(attached, bound_shared_triangle, nullptr);
    rtcSetGeometryIntersectFunction(attached, intersect_shared_triangle);
    rtcSetGeometryOccludedFunction(attached, occlude_shared_triangle);
    rtcCommitGeometry(attached);
    rtcAttachGeometryByID(scene_, attached, static_cast<uint>(shared_.geometry.size()));
    rtcReleaseGeometry(attached);
}

}  // namespace target_core
