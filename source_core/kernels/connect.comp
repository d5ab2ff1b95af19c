// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/connect.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "connect.glsl"

void main() {
    uint job = gl_GlobalInvocationID.x;
    if (job < shadow_job_count()) {
        connect_shadow_ray(job);
    }
}
