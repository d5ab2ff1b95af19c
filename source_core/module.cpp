// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/core_interface.h"
#include "render_system/core_module.h"
#include "source_core/render_core.h"

const render_system::CoreModule* pathtracer_core() {
    static constexpr render_system::CoreModule module = {
        .interface = render_system::core_interface(),
        .id = "source",
        .create =
            [](const render_system::CoreCreation& creation) {
                return source_core::create_core(
                    {.memory_limit = creation.memory_limit, .kernels_directory = creation.kernels_directory});
            },
        .runs_in_software = source_core::has_software_device,
    };
    return &module;
}
