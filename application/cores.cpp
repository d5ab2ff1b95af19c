// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/cores.h"

#include <algorithm>

#include "render_system/null_core.h"

namespace application {

using render_system::CoreAPI;
using render_system::CoreRegistry;
using render_system::ModuleSource;
using render_system::Result;

namespace {

/// Those that `auto` chooses from, found or not: a message then says what is missing.
const std::vector<std::string> OWN_CORES = {"source", "target"};

bool holds(const std::vector<std::string>& ids, const std::string& id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

CoreRegistry make_registry(const Options& options, ModuleSource modules) {
    const render_system::CoreCreation creation{.memory_limit = options.gpu_memory_limit,
                                               .kernels_directory = options.kernels};
    std::vector<std::string> ids = OWN_CORES;
    for (std::string& id : render_system::core_module_ids())
        if (!holds(ids, id)) ids.push_back(std::move(id));
    CoreRegistry registry;
    for (const std::string& id : ids) {
        registry.add(id, [id, creation, modules]() -> Result<std::unique_ptr<CoreAPI>> {
            const auto module = render_system::load_core_module(id, modules);
            if (!module.ok()) return module.status;
            return (*module)->create(creation);
        });
    }
    registry.add("null", render_system::create_null_core);
    return registry;
}

CoreOrder core_order(const Options& options, ModuleSource modules) {
    if (options.cores != std::vector<std::string>{"auto"}) return {options.cores, ""};
    const std::vector<std::string> found = render_system::core_module_ids();
    if (!holds(found, "source")) return {{"target"}, ""};
    if (!holds(found, "target")) return {{"source"}, ""};
    const auto source = render_system::load_core_module("source", modules);
    if (source.ok() && (*source)->runs_in_software != nullptr && (*source)->runs_in_software())
        return {{"target", "source"}, "core source has no GPU here"};
    return {OWN_CORES, ""};
}

}  // namespace application
