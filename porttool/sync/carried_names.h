// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "porttool/judge/check_project.h"
#include "porttool/judge/settle.h"
#include "porttool/read/lock_lines.h"
#include "porttool/sync/transplant.h"

namespace porttool {

using Names = std::set<std::string, std::less<>>;

/// True for a struct, and for an enumeration.
bool has_members(const UnitState& unit);

/// The fields, methods and enumerators that one of these has gained on one side. Their types are known otherwise, or
/// not.
Names new_members(const CheckedProject& checked, const LinesByPair& lines, const JudgedPair& pair, Side side);

/// Where a text declares a name behind its type, in whatever block.
std::vector<size_t> declarations_of(const std::vector<std::string>& words, const std::string& name);

/// Names that a text declares in more than one block: which of them a word is, nothing here tells.
std::set<std::string> declared_twice(const std::vector<std::string>& words);

/// Makes names strange that the edit declares where that was not carried. False if there is none.
bool lose_undeclared(const std::vector<std::string>& words, const Transplant& found, const Names& from_elsewhere,
                     Names& brought, Names& lone);

/// The words that come into the port, but for members.
std::set<std::string> words_brought(const Transplant& found);

}  // namespace porttool
