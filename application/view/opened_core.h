// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "render_system/render_system.h"

namespace application {

/// A core that has the scene. Of a scene that moves each core has a copy of its own, which it follows at its own pace;
/// one that stands still is not kept twice.
struct OpenedCore {
    std::unique_ptr<render_system::CoreAPI> core;           ///< null where `system` has it
    std::unique_ptr<render_system::RenderSystem> system{};  ///< null where nothing moves

    render_system::CoreAPI* get() const { return system ? &system->core() : core.get(); }
    render_system::CoreAPI* operator->() const { return get(); }
    explicit operator bool() const { return system != nullptr || core != nullptr; }

    /// Brings core and scene to `seconds`. Fails as HostScene::play and the core's Set* do.
    render_system::Status play(double seconds) const {
        if (!system) return render_system::Status::success();
        if (auto status = system->scene().play(seconds); !status.ok()) return status;
        return system->synchronize();
    }
};

}  // namespace application
