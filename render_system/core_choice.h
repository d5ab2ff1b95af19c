// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "render_system/core_registry.h"
#include "render_system/render_system.h"

namespace render_system {

/// Which core works, and one line that says why it was taken.
struct CoreChoice {
    std::string core;
    std::string reason;  ///< e.g. "core target: core source needs 412 MiB, 64 MiB are allowed"
};

/// The first real work with a core: set target and settings, render at least one sample. It must be repeatable: it
/// starts from nothing for each core tried.
using FirstRender = std::function<Status(RenderSystem&)>;

/// Tries the cores `ids` in order: creates one, calls Init(options), hands it to `system` and calls `first_render`.
/// The first for which all this succeeds stays in `system`, its first picture taken. A core that answers no_core,
/// no_device or out_of_memory at any step is passed over for the next; any other failure is answered at once. If none
/// is left, answers the last status with the reasons of all. With one id this is "use that core, or say why not".
/// With `options.still` the scene is given back (RenderSystem::give_back) as the last of them is sent it.
Result<CoreChoice> choose_core(const CoreRegistry& registry, const std::vector<std::string>& ids,
                               const CoreOptions& options, RenderSystem& system, const FirstRender& first_render);

}  // namespace render_system
