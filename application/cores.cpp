// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/cores.h"

#include "render_system/null_core.h"
#ifdef PORTTOOL_HAS_SOURCE_CORE
#include "source_core/render_core.h"
#endif
#ifdef PORTTOOL_HAS_TARGET_CORE
#include "target_core/render_core.h"
#endif

namespace application {

render_system::CoreRegistry make_registry([[maybe_unused]] const Options& options) {
    render_system::CoreRegistry registry;
#ifdef PORTTOOL_HAS_SOURCE_CORE
    const source_core::SourceOptions source{.memory_limit = options.gpu_memory_limit,
                                            .kernels_directory = options.kernels};
    registry.add("source", [source] { return source_core::create_core(source); });
#endif
#ifdef PORTTOOL_HAS_TARGET_CORE
    registry.add("target", target_core::create_core);
#endif
    registry.add("null", render_system::create_null_core);
    return registry;
}

CoreOrder core_order(const Options& options) {
    if (options.cores != std::vector<std::string>{"auto"}) return {options.cores, ""};
#if defined(PORTTOOL_HAS_SOURCE_CORE) && defined(PORTTOOL_HAS_TARGET_CORE)
    if (source_core::has_software_device()) return {{"target", "source"}, "core source has no GPU here"};
    return {{"source", "target"}, ""};
#elif defined(PORTTOOL_HAS_SOURCE_CORE)
    return {{"source"}, ""};
#else
    return {{"target"}, ""};
#endif
}

}  // namespace application
