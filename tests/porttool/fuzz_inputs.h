// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "porttool/scan/scan.h"

namespace porttool::testing {

/// What strangers can write and porttool reads.
enum class FuzzKind : uint8_t {
    Source,  ///< two texts through scanner, normal form, matching and comparison
    Map,     ///< portmap.toml
    Lock,    ///< portmap.lock
    Base     ///< a command on a whole repository: portmap.base/, lock, map and sources
};

/// The kind of that name (`source`, `map`, `lock`, `base`), if there is one.
std::optional<FuzzKind> fuzz_kind(std::string_view name);

/// One mutated input: its files, and for `Base` what else the repository holds.
using FuzzInput = std::map<std::string, std::string>;

/// The input of a seed; the same on every machine as long as fixtures and mutations are.
FuzzInput fuzz_input(FuzzKind kind, uint64_t seed);

/// Runs an input. "" if all that must hold does, else what does not. A crash is the caller's to see.
std::string fuzz_fault(FuzzKind kind, const FuzzInput& input, uint64_t seed);

/// What is wrong with the files that mutations start from: they must be good, or all inputs end at the first check.
std::string fuzz_seed_fault();

/// What is wrong with a scanned file: units out of order or empty, lines without a class. "" if nothing is.
std::string scan_fault(const ScannedFile& file);

}  // namespace porttool::testing
