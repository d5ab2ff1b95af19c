// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/judge/check_project.h"

namespace porttool {

/// How a source unit stands in one port.
enum class InPort : uint8_t {
    Twin,        ///< the texts are the same, statement by statement
    Equivalent,  ///< they say the same in other words, or somebody compared them
    Recorded,    ///< in step since it was recorded; nobody said that the two said the same then
    Behind,      ///< edits are missing
    Absent,      ///< no pair leads there
    LeftOut,     ///< ... and somebody said why
};
inline constexpr std::array<std::string_view, 6> kInPortNames = {"twin",   "equivalent", "recorded",
                                                                 "behind", "absent",     "left_out"};
constexpr std::string_view in_port_name(InPort state) { return kInPortNames.at(static_cast<size_t>(state)); }

struct MatrixCell {
    InPort state = InPort::Absent;
    std::string target;  ///< the id, where there is a pair; the worst of several
    size_t edits = 0;    ///< that are missing: statements, as the findings list them
};

struct MatrixRow {
    std::string source;
    std::vector<MatrixCell> cells;  ///< one a port
};

/// Source units by port. Without rows where the map names but one port.
struct TargetMatrix {
    std::vector<std::string> targets;
    std::vector<MatrixRow> rows;  ///< sorted by id; [[ignore]]d units are left out
};

TargetMatrix target_matrix(const CheckedProject& checked);

}  // namespace porttool
