// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render_system/core_data.h"
#include "render_system/path_watch.h"

// What a kernel leaves of one path, in the same form for every core.

namespace application {

/// What is held side by side. `queue`: one core ran the kernel for this path and the other did not.
enum class PathField : uint8_t {
    queue,
    hit,
    radiance,
    shadow_ray,
    shadow_direction,
    shadow_distance,
    shadow_contribution,
    shadow_origin,
    continues,
    ray_direction,
    pdf,
    throughput,
    ray_origin,
    cone_width,
    cone_growth,
    pixel
};
constexpr uint32_t PATH_FIELDS = 16;

const char* field_name(PathField field);
const char* kernel_name(render_system::PathKernel kernel);

/// Rows of one path, by what they hold.
enum class PathRow : uint8_t {
    radiance,
    shadow_origin,
    shadow_direction,
    shadow_contribution,
    origin,
    direction,
    throughput,
    mean
};
constexpr uint32_t PATH_ROWS = 8;

/// One path after a kernel. Rows that the kernel did not make for it are null.
struct PathView {
    uint32_t path = 0;  ///< in the wave
    uint32_t instance = render_system::NONE;
    uint32_t primitive = render_system::NONE;
    bool goes_on = false;
    std::array<const float*, PATH_ROWS> rows{};

    const float* row(PathRow which) const { return rows[static_cast<size_t>(which)]; }
    bool has_shadow_ray() const { return row(PathRow::shadow_origin) != nullptr; }
};

/// The paths that a kernel worked on, each once, in order of the wave.
std::vector<PathView> paths_of(const render_system::PathStates& states);

/// How closely two cores have to agree.
struct PathTolerance {
    /// Of the largest number in a field; 0: every bit. Native arithmetic rounds otherwise on other devices.
    float relative = 0.0f;
};
constexpr float NATIVE_TOLERANCE = 1.0e-3f;

/// The first field of `kernel`, in the order in which it works, that differs; none: `PATH_FIELDS`.
uint32_t first_different_field(render_system::PathKernel kernel, const PathView& a, const PathView& b,
                               PathTolerance tolerance);

}  // namespace application
