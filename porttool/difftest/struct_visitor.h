// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "porttool/difftest/cpp_text.h"
#include "porttool/difftest/definitions.h"

namespace porttool {

/// The names of the classes that a class is made from.
std::vector<std::string> bases_of(const Definition& one);

/// The names of a struct's fields, in their order.
std::vector<std::string> fields_of(const Definition& one);

/// `struct NAME;`, so that what stands before it may name it; "" where it has no name of its own.
std::string announced(const Definition& one, const CppManner& manner);

/// The function of the harness that goes through a struct's fields, those of its bases first. `words`: of those that
/// are not among them nothing is looked at, so that they need not be filled.
std::string visitor(const Definition& one, const CppManner& manner, const std::set<std::string, std::less<>>& words);

}  // namespace porttool
