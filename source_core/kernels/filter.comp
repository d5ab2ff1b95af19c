// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of target_core/kernels/filter.cpp.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "filter.glsl"

void main() {
    uint job = gl_GlobalInvocationID.x;
    if (job >= pass.path_count) {
        return;
    }
    if (pass.filter_stage == FILTER_CHOOSE) {
        choose_path(job);
    } else if (pass.filter_stage == FILTER_GATHER) {
        gather_light(job);
    } else if (pass.filter_stage == FILTER_DIVIDE) {
        divide_by_albedo(job);
    } else if (pass.filter_stage == FILTER_PREPARE) {
        prepare_filter(job);
    } else if (pass.filter_stage == FILTER_STEADY) {
        steady_filter(job);
    } else if (pass.filter_stage == FILTER_LEVEL) {
        filter_level(job);
    } else {
        finish_filter(job);
    }
}
