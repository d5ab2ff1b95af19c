// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A core of another's: the null core, as a module.
#include "render_system/core_interface.h"
#include "render_system/core_module.h"
#include "render_system/null_core.h"

const render_system::CoreModule* pathtracer_core() {
    static constexpr render_system::CoreModule module = {
        .interface = render_system::core_interface(),
        .id = "dark",
        .create = [](const render_system::CoreCreation&) { return render_system::create_null_core(); },
        .runs_in_software = nullptr,
    };
    return &module;
}
