// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "render_system/core_api.h"
#include "render_system/host_scene.h"
#include "render_system/light_table.h"

namespace render_system {

/// Owns the host scene and one core, and keeps the core in step with the scene: after an edit only what changed is
/// sent. Edits go through the scene's setters, which raise flags; `synchronize` lowers them.
class RenderSystem {
public:
    explicit RenderSystem(HostScene scene);

    HostScene& scene() { return scene_; }
    const HostScene& scene() const { return scene_; }

    /// Takes a core that has been through Init; everything counts as changed for it.
    void use_core(std::unique_ptr<CoreAPI> core);
    CoreAPI& core() { return *core_; }
    /// Gives the core away; it keeps what it was sent. Then there is none.
    std::unique_ptr<CoreAPI> take_core() { return std::move(core_); }

    /// Of what the core at hand is sent the scene keeps no copy where only an edit would need it: nothing can be edited
    /// then, and no other core can take the scene.
    void give_back() { gives_back_ = true; }

    /// Sends what changed since the last call. Fails as the core's Set* do.
    Status synchronize();

    /// synchronize, then CoreAPI::Render. Converge becomes Restart where the scene changed.
    Status render(const ViewPyramid& view, Convergence convergence, uint32_t samples);

private:
    Status send_lights_and_sky();

    HostScene scene_;
    std::unique_ptr<CoreAPI> core_;
    SkyTable sky_table_;
    float sky_probability_ = 0.0f;  // as in the light table last sent
    float radius_ = 0.0f;           // the scene's, as in the light table last sent
    bool radius_matters_ = false;
    bool gives_back_ = false;
    bool restart_ = false;  // what the core has gathered belongs to an older scene
};

}  // namespace render_system
