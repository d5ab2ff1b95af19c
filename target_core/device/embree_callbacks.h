// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <embree3/rtcore.h>

#include "target_core/device/instance_geometry.h"

namespace target_core {

/// Embree's callbacks. They run on the thread that traces and read what is bound to it.

/// Filter of native mode: lets a ray pass where meets_surface says so, at u and v of the shared triangle test.
void filter_by_alpha(const RTCFilterFunctionNArguments* arguments);

/// Exact mode: the padded box of one triangle in world space, and the shared triangle test with ties to the lower
/// (instance, primitive).
void bound_triangle(const RTCBoundsFunctionArguments* arguments);
void intersect_exactly(const RTCIntersectFunctionNArguments* arguments);
void occlude_exactly(const RTCOccludedFunctionNArguments* arguments);

}  // namespace target_core
