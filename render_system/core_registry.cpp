// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/core_registry.h"

#include <utility>

namespace render_system {

void CoreRegistry::add(std::string id, Factory factory) { entries_.push_back({std::move(id), std::move(factory)}); }

std::vector<std::string> CoreRegistry::ids() const {
    std::vector<std::string> ids;
    for (const Entry& entry : entries_) ids.push_back(entry.id);
    return ids;
}

Result<std::unique_ptr<CoreAPI>> CoreRegistry::CreateCoreAPI(std::string_view id) const {
    std::string known;
    for (const Entry& entry : entries_) {
        if (entry.id == id) return entry.factory();
        known += (known.empty() ? "" : ", ") + entry.id;
    }
    return Status::error(StatusCode::not_found, "no core is called \"" + std::string(id) + "\"; " +
                                                    (known.empty() ? "this program has none" : "there is " + known));
}

}  // namespace render_system
