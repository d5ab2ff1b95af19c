// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "source_core/device/kernel_set.h"
#include "source_core/render_core.h"

namespace source_core {

/// What tests turn to reach every path through the core; users have the defaults. Nothing here changes the picture.
struct CoreTuning {
    uint32_t largest_batch = 1u << 20;        ///< paths on their way at once
    std::optional<TableAccess> table_access;  ///< how all tables are reached, whatever their size
    bool spelled_out_arithmetic = false;      ///< as in exact mode on a device that may round otherwise
    bool assisted_validation = true;          ///< SourceOptions::validate includes the GPU-assisted checks
};

std::unique_ptr<render_system::CoreAPI> create_tuned_core(const CoreTuning& tuning, const SourceOptions& options = {});

}  // namespace source_core
