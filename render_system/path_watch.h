// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

// How a core shows what its kernels do, so that two cores can be held side by side.

namespace render_system {

/// The kernels of a wavefront, in the order in which a segment runs through them.
enum class PathKernel : uint8_t { generate, extend, shade, connect, finalize };
constexpr uint32_t PATH_KERNELS = 5;

/// Some paths after one of their kernels: rows as the kernels keep them, of four numbers each. Path p is that of pixel
/// first_pixel + p. What a kernel cannot have touched may be left empty. A kernel that is wrong may have left anything
/// here: numbers of paths, instances and triangles are to be checked before use.
struct PathStates {
    PathKernel kernel = PathKernel::generate;
    uint32_t segment = 0;  ///< generate: 0; finalize: the last one that was run
    uint32_t sample = 0;   ///< index of the sample
    uint32_t first_pixel = 0;
    uint32_t path_count = 0;

    std::span<const float> origins;      ///< of the path's ray; the cone's width
    std::span<const float> directions;   ///< and the cone's growth
    std::span<const float> throughputs;  ///< and the density of the last direction
    std::span<const float> radiances;
    std::span<const uint32_t> queue;              ///< after extend: paths whose ray was traced; else: paths that go on
    std::span<const uint32_t> surfaces;           ///< after extend, shade: path, instance, triangle in the mesh, 0
    std::span<const float> shadow_origins;        ///< after shade, connect: and the ray's length; one a shadow ray
    std::span<const float> shadow_directions;     ///< and the path as bits
    std::span<const float> shadow_contributions;  ///< what the path gains if nothing is in the way
    std::span<const float> means;                 ///< after finalize: of each pixel
};

/// Is shown the paths of a core. The rows are there for the length of the call only.
class PathWatch {
public:
    virtual ~PathWatch() = default;
    /// Comes after every kernel of every wave or tile; from several threads at once, but for different paths.
    virtual void after(const PathStates& states) = 0;
};

/// The text of a kernel, or of what it includes, that a core runs.
struct KernelText {
    std::string file;  ///< from the root of the project
    std::string text;
};

}  // namespace render_system
