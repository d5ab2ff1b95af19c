// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "application/locate/path_log.h"
#include "render_system/host_scene.h"

namespace application {

/// What a ray met.
struct PathHit {
    uint32_t instance = render_system::NONE;
    uint32_t primitive = render_system::NONE;
};

/// The paths that parted in one kernel while all that it read was still the same.
struct KernelDifference {
    render_system::PathKernel kernel = render_system::PathKernel::generate;
    uint32_t segment = 0;                        ///< the first in which that happened
    uint32_t pixel = 0;                          ///< one such path's, of that segment
    uint64_t paths = 0;                          ///< in all segments
    std::array<uint64_t, PATH_FIELDS> fields{};  ///< of that segment: how many paths differ there first
    std::map<uint32_t, uint64_t> instances;      ///< how many of the paths were on them
    std::map<uint32_t, uint64_t> materials;

    /// Where most of the paths differ first.
    PathField field() const;
};

/// Where paths parted.
struct PathDifferences {
    std::vector<KernelDifference> kernels;  ///< by segment, then as they run
    uint64_t paths = 0;                     ///< held side by side
    /// By kernel: how often what it gave a path was held side by side; 0 where none ran through it.
    std::array<uint64_t, render_system::PATH_KERNELS> compared{};
    uint64_t explained_by_ties = 0;
    std::vector<uint8_t> parted_in;  ///< of each pixel: 1 + the kernel that parted earliest; TIE; 0: none
    static constexpr uint8_t TIE = 255;
};

/// Holds the paths of a second core against the log of the first, as they come, and follows none any further once it
/// has parted.
class PathComparison final : public render_system::PathWatch {
public:
    /// With a tolerance, hits of different triangles at one distance are ties.
    PathComparison(PathLog& log, const render_system::HostScene& scene, size_t pixels, PathTolerance tolerance);

    void after(const render_system::PathStates& states) override;

    /// Takes in the sample that both cores have just finished; the log is cleared.
    void finish_sample();

    PathDifferences differences() const;

private:
    enum class Fate : uint8_t { same, parted, tied };
    struct Parting {
        Fate fate = Fate::same;
        render_system::PathKernel kernel{};
        PathField field{};
        uint32_t segment = 0;
        PathHit hit;
    };

    void compare(size_t pixel, const render_system::PathStates& states, const PathView& view);
    /// Whether another hit of the path is a tie.
    bool ties(const render_system::PathStates& states, const PathView& a, const PathView& b) const;
    void add(size_t pixel, const Parting& parting);
    uint32_t material_of(const PathHit& hit) const;

    PathLog& log_;
    const render_system::HostScene& scene_;
    const PathTolerance tolerance_;
    std::vector<Parting> partings_;  // of this sample, by pixel; `hit` is kept up to date
    std::vector<bool> sum_differs_;  // of each pixel, since an earlier sample
    std::map<render_system::PathKernel, KernelDifference> kernels_;
    std::vector<uint8_t> parted_in_;
    uint64_t paths_ = 0;
    std::array<uint64_t, render_system::PATH_KERNELS> compared_{};
    uint64_t ties_ = 0;
};

/// Whether a ray (origin and direction of unit length, three numbers each) that one core found on one triangle and one
/// on another could have met either: both lie at the same distance, up to rounding. NONE as an instance: it met
/// nothing.
bool is_tie(const render_system::HostScene& scene, const float* origin, const float* direction, const PathHit& a,
            const PathHit& b);

}  // namespace application
