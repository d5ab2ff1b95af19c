// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/shade.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "shade.glsl"

void main() {
    uint job = gl_GlobalInvocationID.x;
    if (job < surface_job_count()) {
        shade_path(job);
    }
}
