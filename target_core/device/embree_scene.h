// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <span>
#include <string>
#include <vector>

#include "target_core/device/embree_callbacks.h"

namespace target_core {

/// Embree's device and the acceleration structure over all instances. Move-only by being held in place.
///
/// Native mode: a baked instance is a triangle mesh of the top scene, other instances refer to one scene per mesh.
/// Exact mode: every instance is user geometry in world space that runs the shared triangle test over padded boxes.
/// Geometry ids are instance numbers in both.
class EmbreeScene {
public:
    EmbreeScene() = default;
    ~EmbreeScene();
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    /// Opens Embree with `threads` build threads; false with a message if it cannot.
    bool open(uint threads, std::string& message);

    /// Gives everything back.
    void close();

    /// Builds from nothing. The geometry must stay where it is until the next build. Call inside the task arena whose
    /// threads shall build. What is `alive` will be changed: meshes then have trees of their own, so that one can
    /// follow without the others. False with Embree's message if it fails (out of memory).
    bool build(std::span<const InstanceGeometry> geometry, bool exact, bool alive, std::string& message);

    /// Follows `moved` instances, none of them baked, and `deformed` meshes, whose trees are fitted to their vertices
    /// or, where they are `worn`, built anew. Not in exact mode. Call and fails as build.
    bool update(std::span<const InstanceGeometry> geometry, std::span<const uint> moved, std::span<const uint> deformed,
                std::span<const uint> worn, std::string& message);

    /// Whether `update` will not do: what is baked was built to stand still.
    bool stands_still() const { return has_baked_ && !alive_; }

    /// Of the scene's box, in magnitude.
    float largest_coordinate() const;

    RTCScene scene() const { return scene_; }
    RTCDevice device() const { return device_; }

    /// Wall time of Embree's part of the last build.
    double build_ms() const { return build_ms_; }

    /// Bytes that Embree holds now.
    uint64_t memory_bytes() const { return static_cast<uint64_t>(memory_.load(std::memory_order_relaxed)); }

private:
    void release_scenes();
    RTCScene mesh_scene(const InstanceGeometry& geometry);
    RTCGeometry triangle_geometry(const InstanceGeometry& geometry);
    void attach(const InstanceGeometry& geometry, uint instance, bool exact);
    void attach_all(std::span<const InstanceGeometry> geometry, bool exact);
    bool check(std::string& message);

    RTCDevice device_ = nullptr;
    RTCScene scene_ = nullptr;
    std::vector<RTCScene> mesh_scenes_;  // by mesh, null where not needed
    bool has_baked_ = false;
    bool alive_ = false;
    std::atomic<int64_t> memory_{0};
    double build_ms_ = 0.0;
};

}  // namespace target_core
