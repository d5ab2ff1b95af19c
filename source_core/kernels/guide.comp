// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/guide.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "guide.glsl"

void main() {
    uint job = gl_GlobalInvocationID.x;
    if (job < surface_job_count()) {
        guide_path(job);
    }
}
