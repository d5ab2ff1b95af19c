// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/reproject.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "reproject.glsl"

void main() {
    uint job = gl_GlobalInvocationID.x;
    if (job >= pass.path_count) {
        return;
    }
    if (pass.filter_stage == REPROJECT_LIGHT) {
        reproject_light(job);
    } else {
        reproject_picture(job);
    }
}
