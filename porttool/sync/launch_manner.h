// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// CUDA and HIP start kernels in two ways; a file keeps to one.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// How a file starts its kernels.
///
///     Brackets    k < T > < < < g , b > > > ( a ) ;
///     Function    hipLaunchKernelGGL ( HIP_KERNEL_NAME ( k < T > ) , dim3 ( g ) , dim3 ( b ) , 0 , 0 , a ) ;
struct LaunchManner {
    enum class Form : uint8_t { Unknown, Brackets, Function };
    Form form = Form::Unknown;
    bool wraps_extents = false;  ///< numbers of threads are `dim3 ( n )`
};

/// Unknown where a file starts none, or some in each way.
LaunchManner launch_manner(const ScannedFile& file);

/// The parts of a statement that starts a kernel, each a run of its words.
struct LaunchParts {
    struct Run {
        size_t first = 0, end = 0;
    };
    static constexpr size_t kMostExtents = 4;
    LaunchManner::Form form = LaunchManner::Form::Unknown;
    Run kernel;
    std::vector<Run> extents;  ///< groups, threads, and up to two more: bytes of shared memory, stream
    Run arguments;             ///< may be empty
};

/// Nothing for another statement.
std::optional<LaunchParts> parts_of_launch(const std::vector<std::string>& words, size_t first, size_t end);

/// A statement that starts a kernel as words that are the same in whatever form it is written: without `dim3` around a
/// number, and without the zeros that stand for nothing. Nothing for another statement.
std::optional<std::vector<std::string>> launch_in_one_form(const std::vector<std::string>& words, size_t first,
                                                           size_t end);

}  // namespace porttool
