// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// A unit's name without namespaces and without the number of an overload.
std::string_view plain_name(const Unit& unit);

/// The names that a whole family of files gives to its entry points: `main`, `run`, `process`. They say what a function
/// is for and not what it does; that is what its file is named after. Copies of one helper in many files bear one name,
/// too, but are of one length.
class EntryNames {
public:
    explicit EntryNames(const std::vector<ScannedFile>& files);

    bool contains(std::string_view name) const { return names_.contains(std::string(name)); }

    /// What a file is about: its name, or that of its folder where many files are called alike (`sort-cuda/main.cu`).
    std::string subject(std::string_view path) const;

private:
    std::unordered_set<std::string> names_;
    std::unordered_map<std::string, uint32_t> stems_;  ///< how many files have this name
};

}  // namespace porttool
