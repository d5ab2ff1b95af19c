// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: one-sided: the target core runs its loops on the host. Turns the counters that generate or shade of this
// segment left behind into the sizes of the dispatches that follow, and adds them to the statistics.
#version 460
#extension GL_GOOGLE_include_directive : require

#include "buffers.glsl"

uint group_count(uint jobs) { return (jobs + (WORK_GROUP_SIZE - 1u)) / WORK_GROUP_SIZE; }

void main() {
    if (gl_GlobalInvocationID.x == 0u) {
        uint extension_jobs = counters[segment_counter(pass.segment + 1u, COUNTER_EXTENSION)];
        uint shadow_jobs = counters[segment_counter(pass.segment, COUNTER_SHADOW)];
        arguments[ARGUMENTS_EXTENSION] = group_count(extension_jobs);
        arguments[ARGUMENTS_EXTENSION + 1u] = 1u;
        arguments[ARGUMENTS_EXTENSION + 2u] = 1u;
        arguments[ARGUMENTS_SHADOW] = group_count(shadow_jobs);
        arguments[ARGUMENTS_SHADOW + 1u] = 1u;
        arguments[ARGUMENTS_SHADOW + 2u] = 1u;
        counters[COUNTER_EXTENSION_TOTAL] += extension_jobs;
        counters[COUNTER_SHADOW_TOTAL] += shadow_jobs;
    }
}
