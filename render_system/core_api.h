// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "render_system/core_data.h"
#include "render_system/path_watch.h"
#include "render_system/status.h"

namespace render_system {

/// The only seam through which a render core is driven. The names are those of the thesis's listing and the only
/// PascalCase functions of the project.
///
/// Order: Init once, then any Set* and Setting in any order, then Render; Set* may come again between two Render
/// calls and takes effect with the next one. Every call but Init answers wrong_order before Init and after Shutdown.
/// Memory: a core copies what it is given before the call returns, but for the pixels of SetTarget.
/// Failure: a Status; a failed Set* leaves what was set before. Nothing in a core prints or exits or throws.
/// Threads: one thread drives one core; different cores may be driven from different threads.
class CoreAPI {
public:
    virtual ~CoreAPI() = default;

    /// Counters and times since the last Restart. Never fails; zeros before the first Render.
    virtual CoreStats GetCoreStats() const = 0;

    /// The texts of all kernels that this core runs, as they were compiled; after Init. None where it has no kernels.
    virtual std::vector<KernelText> GetKernelTexts() const = 0;

    /// Opens the device. Fails with no_device (the message has one reason per device looked at). A second call
    /// answers wrong_order.
    virtual Status Init(const CoreOptions& options) = 0;

    /// Where Render writes. Fails with invalid_argument if a side is 0, the span's length is not width * height, or the
    /// sums reach past the picture. A change of size drops the samples taken.
    virtual Status SetTarget(const CoreTarget& target) = 0;

    /// Seed, path length and switches for the next Render. Fails with invalid_argument if max_path_length is 0.
    virtual Status Setting(const CoreSettings& settings) = 0;

    /// Replaces all textures. Fails with invalid_argument if a texture's texel count is not that of its mip chain.
    virtual Status SetTextures(std::span<const CoreTexture> textures) = 0;

    /// Replaces the materials [first, first + materials.size()), growing the table where needed. Fails with
    /// invalid_argument if that leaves a gap. Texture indices are checked at Render.
    virtual Status SetMaterials(uint32_t first, std::span<const CoreMaterial> materials) = 0;

    /// Replaces all lights. Fails with invalid_argument if lights and table differ in length, or a light is not finite
    /// or too far off.
    virtual Status SetLights(const CoreLights& lights) = 0;

    /// Replaces the sky. Fails with invalid_argument if the map's size and spans disagree.
    virtual Status SetSkyData(const CoreSky& sky) = 0;

    /// Sets mesh `mesh`; ids are dense, a new mesh has the next free id. Fails with invalid_argument on an index past
    /// the vertices, spans of unequal length or an element that is not finite. What does not fit the budget is refused
    /// by Render, which knows all of it. Fails with wrong_order after the first Render of a core that is still.
    virtual Status SetGeometry(uint32_t mesh, const CoreMesh& data) = 0;

    /// Puts mesh `mesh` into the scene as instance `instance` (dense ids), or moves it there. NONE as mesh hides it.
    /// Fails with invalid_argument if the mesh does not exist, or the matrix is not finite, or cannot be inverted where
    /// the core needs that; a RenderSystem sends no such matrix. Fails with wrong_order as SetGeometry does.
    virtual Status SetInstance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) = 0;

    /// From the next Render on `watch` is shown every path after every kernel, or with null no longer. It stays valid
    /// until then or Shutdown. Slower, and the picture is the same. A core without paths has nothing to show.
    virtual Status SetWatch(PathWatch* watch) = 0;

    /// Takes `samples` more samples per pixel, at least 1, and writes the mean of all to the target. What has been set
    /// since the last call is built and uploaded first; out_of_memory is answered before anything is uploaded. Fails
    /// with wrong_order without a target, invalid_argument on 0 samples, dangling ids, or a view or placed mesh past
    /// the limits in scene_limits.h. Answers called_off soon after the target says that it is not wanted any more; the
    /// samples taken are dropped then.
    virtual Status Render(const ViewPyramid& view, Convergence convergence, uint32_t samples) = 0;

    /// Takes noise out of a picture of the scene and view rendered last, by albedo, normal and depth of what the camera
    /// rays of its samples met, which are traced once more for that. Samples already taken stay. With a history also by
    /// the frames filtered before: where what is seen now was seen then is told by both views, by the transforms of the
    /// instances at both times, and by the vertices of meshes that were set again with the same triangles. Another size
    /// begins anew. Fails as Render does, and with invalid_argument on spans of another size than the target. Answers
    /// called_off soon after it is not wanted any more; `filtered` is then as it was, and so is the history, unless it
    /// was to begin: then there is none.
    virtual Status Filter(const ViewPyramid& view, const CoreFilter& filter) = 0;

    /// What Filter has kept for the next call that goes on, as plain numbers. Fails as Render does where the device
    /// does.
    virtual Result<CoreHistory> GetHistory() = 0;

    /// Filter goes on from there, as the core would that gave it: the scene that was set, as seen from `view`, is that
    /// of the frame filtered last. Fails as Render does, and with invalid_argument where it is that of another size or
    /// kind of core; then, as with a history of no frames, there is none.
    virtual Status SetHistory(const ViewPyramid& view, const CoreHistory& history) = 0;

    /// Gives everything back. A second call does nothing.
    virtual void Shutdown() = 0;
};

}  // namespace render_system
