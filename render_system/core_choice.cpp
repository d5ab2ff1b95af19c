// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/core_choice.h"

#include <utility>

namespace render_system {

namespace {

// Rounded up: what is needed must not read as if it were allowed.
std::string mebibytes(uint64_t bytes) { return std::to_string((bytes + 0xFFFFF) >> 20) + " MiB"; }

std::string why_not(const std::string& id, const Status& status) {
    if (status.code == StatusCode::out_of_memory && status.needed_bytes > 0 && status.allowed_bytes > 0) {
        return "core " + id + " needs " + mebibytes(status.needed_bytes) + ", " +
               std::to_string(status.allowed_bytes >> 20) + " MiB are allowed";
    }
    return "core " + id + ": " + status.message;
}

std::string why(const std::string& id, const CoreStats& stats, const std::string& passed_over) {
    if (!passed_over.empty()) return "core " + id + ": " + passed_over;
    std::string reason = "core " + id + ": the scene fits";
    if (stats.memory_allowed_bytes == 0) return reason;
    return reason + ", it needs " + mebibytes(stats.memory_bytes) + ", " +
           std::to_string(stats.memory_allowed_bytes >> 20) + " MiB are allowed";
}

Status try_core(const CoreRegistry& registry, const std::string& id, const CoreOptions& options, RenderSystem& system,
                const FirstRender& first_render) {
    Result<std::unique_ptr<CoreAPI>> core = registry.CreateCoreAPI(id);
    if (!core.ok()) return core.status;
    if (Status status = (*core)->Init(options); !status.ok()) return status;
    system.use_core(std::move(*core));
    return first_render(system);
}

}  // namespace

Result<CoreChoice> choose_core(const CoreRegistry& registry, const std::vector<std::string>& ids,
                               const CoreOptions& options, RenderSystem& system, const FirstRender& first_render) {
    std::string passed_over;
    Status last = Status::error(StatusCode::not_found, "no core to choose from");
    for (const std::string& id : ids) {
        if (options.still && &id == &ids.back()) system.give_back();  // no other core will ask for it
        last = try_core(registry, id, options, system, first_render);
        if (last.ok()) return CoreChoice{id, why(id, system.core().GetCoreStats(), passed_over)};
        if (last.code != StatusCode::no_core && last.code != StatusCode::no_device &&
            last.code != StatusCode::out_of_memory)
            return last;
        passed_over += (passed_over.empty() ? "" : "; ") + why_not(id, last);
    }
    if (!passed_over.empty()) last.message = passed_over;
    return last;
}

}  // namespace render_system
