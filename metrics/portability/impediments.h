// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

namespace metrics {

/// The impediments to a port, each a number that the same person gave all ports alike (0: none): alpha_p of the program
/// itself, alpha_H of the hardware and alpha_E of the environment that it moves to.
struct Impediments {
    double program = 0, hardware = 0, environment = 0;
    std::array<double, 3> all() const { return {program, hardware, environment}; }
};

}  // namespace metrics
