// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace porttool {

/// Gives the text of a file by its path, or nullptr if there is none.
using ShaderFiles = std::function<const std::string*(const std::string& path)>;

enum class ShaderStage {
    Vertex,
    TessControl,
    TessEvaluation,
    Geometry,
    Fragment,
    Compute,
    RayGeneration,
    Intersection,
    AnyHit,
    ClosestHit,
    Miss,
    Callable,
    Task,
    Mesh
};

/// The stage that the suffix of a path names (`shade.comp`, `shade.comp.glsl`); such a file is an entry point.
std::optional<ShaderStage> stage_of_path(const std::string& path);

/// Globs of all entry points below a root.
const std::vector<std::string>& shader_entry_globs();

/// What `#include "name"` in the file `from` leads to: beside it, else in one of the folders `include`; "" if nowhere.
std::string find_include(const ShaderFiles& files, const std::string& from, const std::string& name,
                         const std::vector<std::string>& include);

/// An entry point and all that it includes, in whatever branch.
std::set<std::string> files_included(const ShaderFiles& files, const std::string& entry,
                                     const std::vector<std::string>& include);

}  // namespace porttool
