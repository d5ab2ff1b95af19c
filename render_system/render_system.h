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

    /// Sends what changed since the last call. Fails as the core's Set* do.
    Status synchronize();

    /// synchronize, then CoreAPI::Render. Converge becomes Restart where the scene changed.
    Status render(const ViewPyramid& view, Convergence convergence, uint32_t samples);

private:
    HostScene scene_;
    std::unique_ptr<CoreAPI> core_;
};

}  // namespace render_system
