// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: twin of source_core/kernels/filter.comp.
#include "target_core/kernels/filter.h"

#include "target_core/kernels/kernels.h"

namespace target_core::kernels {

void filter() {
    if (pass.filter_stage == FILTER_CHOOSE) {
        for_each_job<choose_path>(pass.path_count);
    } else if (pass.filter_stage == FILTER_GATHER) {
        for_each_job<gather_light>(pass.path_count);
    } else if (pass.filter_stage == FILTER_DIVIDE) {
        for_each_job<divide_by_albedo>(pass.path_count);
    } else if (pass.filter_stage == FILTER_PREPARE) {
        for_each_job<prepare_filter>(pass.path_count);
    } else if (pass.filter_stage == FILTER_STEADY) {
        for_each_job<steady_filter>(pass.path_count);
    } else if (pass.filter_stage == FILTER_LEVEL) {
        for_each_job<filter_level>(pass.path_count);
    } else {
        for_each_job<finish_filter>(pass.path_count);
    }
}

}  // namespace target_core::kernels
