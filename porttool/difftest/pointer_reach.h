// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "porttool/difftest/definitions.h"

namespace porttool {

/// How many elements behind a pointer a function looks at.
class PointerReach {
public:
    explicit PointerReach(const Definitions& definitions) : definitions_(definitions) {}

    /// 0 if that cannot be told. `depth`: through how many calls the pointer came.
    int of(const Definition& function, std::string_view name, int depth = 0);

private:
    int look(const Definition& function, std::string_view name, int depth);
    int through_call(const Definition& function, uint32_t at, int depth);

    const Definitions& definitions_;
    std::map<std::pair<const Definition*, std::string>, int> seen_;  ///< 1 while one is looked at: it may call itself
};

}  // namespace porttool
