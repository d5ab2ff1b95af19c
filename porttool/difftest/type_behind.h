// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "porttool/difftest/cpp_text.h"

namespace porttool {

/// What a function takes a `void*` for, by the first cast or declaration in which it says so: `Block` of
/// `(const Block*) name`, `static_cast<Block*>(name)` and `Block* b = name;`. "" where it does not say.
std::string type_behind(const Definition& function, std::string_view name, const CppManner& manner);

}  // namespace porttool
