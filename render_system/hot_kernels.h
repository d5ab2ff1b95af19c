// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "render_system/status.h"

namespace render_system {

/// Kernels that were compiled again.
struct RecompiledKernels {
    std::vector<std::string> kernels;  ///< their names; none where no text is another one
    double compile_ms = 0.0;           ///< wall time from reading the texts to what the device takes
};

/// What a core can be asked beside CoreAPI, whose kernels are compiled by the program itself: a dynamic_cast of the
/// core tells.
class HotKernels {
public:
    virtual ~HotKernels() = default;

    /// Reads the texts of the kernels again and compiles those kernels of which one became another, itself or what it
    /// includes. The next Render runs them, from the first sample on; before the first one, which compiles all of them
    /// for its scene, they are compiled to see that they do, and the first call looks at all of them. One thread may
    /// call this while another drives the core, from the end of Init to the beginning of Shutdown. Fails with not_found
    /// where a text is missing, and with internal and the compiler's first messages, each with file and line; the
    /// kernels that were there then go on.
    virtual Result<RecompiledKernels> compile_again() = 0;
};

}  // namespace render_system
