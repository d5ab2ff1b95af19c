// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "render_system/core_api.h"

namespace render_system {

/// The cores that this program knows, by id. Filled explicitly by `application`, in order of preference.
class CoreRegistry {
public:
    /// Fails with no_core where the core's module is missing or refused.
    using Factory = std::function<Result<std::unique_ptr<CoreAPI>>()>;

    void add(std::string id, Factory factory);
    std::vector<std::string> ids() const;

    /// A new core, not yet through Init. Fails with not_found, naming the known ids, and as its factory
    /// does.
    Result<std::unique_ptr<CoreAPI>> CreateCoreAPI(std::string_view id) const;

private:
    struct Entry {
        std::string id;
        Factory factory;
    };
    std::vector<Entry> entries_;
};

}  // namespace render_system
