// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <map>
#include <string>

#include "porttool/lsp/json_forms.h"
#include "porttool/lsp/project_places.h"

namespace porttool::lsp {

/// What an editor calls the file of an absolute path.
using UriOf = std::function<std::string(const std::string& path)>;

/// The open findings as diagnostics, by absolute path: each in the files of both of its sides, with the other side as
/// related information. What is about the map itself stands there.
std::map<std::string, Json> diagnostics_of(const CheckedProject& project, const ProjectPlaces& places,
                                           const UriOf& uri_of);

/// That a project cannot be judged, as a diagnostic of its map: on the line that the message names, if it does.
Json diagnostic_of_error(const std::string& message, const std::string& map_name);

}  // namespace porttool::lsp
