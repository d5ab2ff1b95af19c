// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace importer {

/// The URI of a picture that a file beside `folder` names in its own way: with backslashes, or where it lay on another
/// machine. What is not there is looked for by its name alone, in the folder and in those that pictures commonly lie
/// in.
std::string texture_uri(const std::string& name, const std::filesystem::path& folder);

}  // namespace importer
