// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "porttool/lsp/diagnostics.h"
#include "porttool/lsp/project_places.h"

namespace porttool::lsp {

/// The counterparts of the unit that a line of a file (from 1) stands in: of the innermost one that has any.
struct Counterparts {
    std::optional<PlacedUnit> unit;
    std::vector<const JudgedPair*> pairs;
};
Counterparts counterparts_at(const ProjectPlaces& places, const std::string& path, uint32_t line);

/// What there is to know of that unit, in Markdown: its counterparts, how each pair stands and why, how much the two
/// share, and what is found. "" where it has none.
std::string hover_text(const CheckedProject& project, const ProjectPlaces& places, const Counterparts& found,
                       const UriOf& uri_of);

}  // namespace porttool::lsp
