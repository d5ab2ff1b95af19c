// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/core_interface.h"
#include "render_system/core_module.h"
#include "target_core/render_core.h"

const render_system::CoreModule* pathtracer_core() {
    static constexpr render_system::CoreModule module = {
        .interface = render_system::core_interface(),
        .id = "target",
        .create = [](const render_system::CoreCreation&) { return target_core::create_core(); },
        .runs_in_software = nullptr,
    };
    return &module;
}
