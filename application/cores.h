// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "application/options.h"
#include "render_system/core_modules.h"
#include "render_system/core_registry.h"

namespace application {

/// The cores that this program knows, in order of preference: source, target, those of other modules, and null, which
/// alone is a part of the program. The module of a core is loaded when one is created, by ModuleSource::copy anew where
/// its file has changed. Each is created with what the options say to it alone.
render_system::CoreRegistry make_registry(const Options& options,
                                          render_system::ModuleSource modules = render_system::ModuleSource::file);

/// The cores to try, in this order, and why in this one.
struct CoreOrder {
    std::vector<std::string> ids;
    std::string reason;  ///< of the order that `auto` stands for; empty where there is nothing to say
};

/// What `--core` asks for. `auto` takes the source core first where it has a GPU, else the target core: in software
/// the source core is several times slower than its port.
CoreOrder core_order(const Options& options, render_system::ModuleSource modules = render_system::ModuleSource::file);

}  // namespace application
