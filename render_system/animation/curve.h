// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

namespace render_system {

/// How values between two keys come about (glTF 2.0, appendix C).
enum class Interpolation { step, linear, cubic_spline };

/// Floats that several curves may share.
using SharedFloats = std::shared_ptr<const std::vector<float>>;

/// A value over time.
struct Curve {
    Interpolation interpolation = Interpolation::linear;
    bool is_rotation =
        false;            ///< quaternions (x, y, z, w): linear is along the sphere, what comes out is of unit length
    uint32_t width = 0;   ///< numbers in one value
    SharedFloats times;   ///< seconds, one a key and at least one, none before the one before it
    SharedFloats values;  ///< `width` a key; of a cubic spline its in-tangent, the value and its out-tangent
};

/// The value at `time` seconds: `width` numbers into `value`. Before the first key it is the first key's, after the
/// last the last's. Worked out in double precision: a key's own value comes out as it stands.
void sample_curve(const Curve& curve, double time, std::vector<double>& value);

}  // namespace render_system
