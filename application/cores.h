// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "application/options.h"
#include "render_system/core_registry.h"

namespace application {

/// The cores built into this program, in order of preference: source, target, null. Each is created with what the
/// options say to it alone.
render_system::CoreRegistry make_registry(const Options& options);

/// The cores to try, in this order, and why in this one.
struct CoreOrder {
    std::vector<std::string> ids;
    std::string reason;  ///< of the order that `auto` stands for; empty where there is nothing to say
};

/// What `--core` asks for. `auto` takes the source core first where it has a GPU, else the target core: in software
/// the source core is several times slower than its port.
CoreOrder core_order(const Options& options);

}  // namespace application
