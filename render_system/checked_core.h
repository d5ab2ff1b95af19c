// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "render_system/call_off.h"
#include "render_system/core_checks.h"
#include "render_system/frame_before.h"

namespace render_system {

/// What a core asks of the matrices of its instances beyond being finite.
enum class InstanceMatrices {
    any,         ///< a mesh may be flattened to nothing
    invertible,  ///< rays are taken into the mesh's own space
};

/// CoreAPI with its contract kept: arguments, the order of calls and the limits of scene_limits.h are checked here, in
/// one place and in the same words for all cores; a core derives from it and does the plain work. What reaches the
/// work has been checked, and what it is given is remembered only once the work is done. Work that runs out of the
/// machine's memory may throw std::bad_alloc: it becomes a status, and what was set before stays.
class CheckedCore : public CoreAPI {
public:
    /// What has been counted so far; a core that holds memory or more figures adds them.
    CoreStats GetCoreStats() const override { return stats_; }

    std::vector<KernelText> GetKernelTexts() const override { return {}; }

    Status Init(const CoreOptions& options) final;
    Status SetTarget(const CoreTarget& target) final;
    Status Setting(const CoreSettings& settings) final;
    Status SetTextures(std::span<const CoreTexture> textures) final;
    Status SetMaterials(uint32_t first, std::span<const CoreMaterial> materials) final;
    Status SetLights(const CoreLights& lights) final;
    Status SetSkyData(const CoreSky& sky) final;
    Status SetGeometry(uint32_t mesh, const CoreMesh& data) final;
    Status SetInstance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) final;
    Status SetWatch(PathWatch* watch) final;
    Status Render(const ViewPyramid& view, Convergence convergence, uint32_t samples) final;
    Status Filter(const ViewPyramid& view, const CoreFilter& filter) final;
    Result<CoreHistory> GetHistory() final;
    Status SetHistory(const ViewPyramid& view, const CoreHistory& history) final;
    void Shutdown() final;

protected:
    /// `id` is the core's name in CoreStats and in messages.
    explicit CheckedCore(std::string id, InstanceMatrices matrices = InstanceMatrices::any);

    const CoreOptions& options() const { return options_; }  ///< `threads` is the number itself, never 0
    const CoreTarget& target() const { return target_; }
    const CoreSettings& settings() const { return settings_; }
    PathWatch* watch() const { return watch_; }
    /// Of the filter at work.
    const FrameBefore& frame_before() const { return before_; }
    CoreStats& stats() { return stats_; }
    const CoreStats& stats() const { return stats_; }

    /// Starts the counters and times anew, and with them the sum of samples.
    void drop_samples();
    /// What filters left of earlier frames is gone.
    void forget_frames() {
        kept_ = {};
        shapes_before_.clear();
    }

private:
    /// Opens the device and answers its name; options() are set. Fails as Init may.
    virtual Result<std::string> open() = 0;
    /// Makes room for the samples of a target of another size, which follows as target().
    virtual void resize(uint32_t width, uint32_t height) = 0;
    virtual void set_textures(std::span<const CoreTexture> textures) = 0;
    virtual void set_materials(uint32_t first, std::span<const CoreMaterial> materials) = 0;
    virtual void set_lights(const CoreLights& lights) = 0;
    virtual void set_sky(const CoreSky& sky) = 0;
    virtual void set_mesh(uint32_t mesh, const CoreMesh& data) = 0;
    /// Where the vertices of a mesh are, if `data`, which is to be set, moves them and changes nothing else; else none.
    /// A core whose filter does not follow them has none.
    virtual std::vector<glm::vec3> positions_before(uint32_t mesh, const CoreMesh& data) const;
    virtual void set_instance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) = 0;
    /// Builds and uploads what was set since the last call. Fails as Render may.
    virtual Status prepare() = 0;
    /// Adds `samples` samples to the stats().samples there are, writes the mean to target() and counts rays and times.
    /// Answers call_off.status() soon after that came.
    virtual Status render(const ViewPyramid& view, uint32_t samples, CallOff& call_off) = 0;
    /// Takes the noise out of filter.means, into filter.filtered; the scene is that of the last render. Answers
    /// call_off.status() soon after that came; what read_history() reads is then that of before.
    virtual Status filter(const ViewPyramid& view, const CoreFilter& filter, CallOff& call_off) = 0;
    /// What it has left for the next one, and back, before that one comes. A core that keeps nothing has no planes.
    virtual Status read_history(std::vector<float>& planes);
    virtual Status write_history(std::span<const float> planes);
    /// Gives everything back. May come before open() and a second time.
    virtual void close() = 0;
    /// Bytes of the machine's own memory that the core holds, for a message.
    virtual uint64_t host_bytes() const = 0;

    template <class Work>
    Status after(const Status& check, Work&& work);
    template <class Work>
    Status change(const Status& check, Work&& work);
    Status settled() const;
    void keep_shape(uint32_t mesh, const CoreMesh& data);
    void look_back(const ViewPyramid& view, FilterHistory history);
    void remember(const ViewPyramid& view);

    std::string id_;
    InstanceMatrices matrices_;
    CoreContract contract_;
    CoreOptions options_;
    CoreTarget target_;
    CoreSettings settings_;
    PathWatch* watch_ = nullptr;
    CoreStats stats_;
    FrameBefore before_;                            // for the filter at work
    FrameBefore kept_;                              // for the next one that goes on
    std::vector<PlacedInstance> instances_before_;  // none until a filter keeps a history
    ShapesBefore shapes_before_;                    // of meshes set since then; none of which is not to be followed
    bool scene_changed_ = true;                     // since then
    bool is_settled_ = false;                       // still, and a Render came
};

}  // namespace render_system
