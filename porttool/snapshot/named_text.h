// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "porttool/read/disk.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// A file that a user named, scanned, or one of its units.
struct NamedText {
    ScannedFile file;
    std::optional<size_t> unit;  ///< an index into ScannedFile::units

    std::string id() const;  ///< PATH:NAME, or PATH:@file
};

/// Reads PATH or PATH:NAME; a path is relative to `directory` or, where nothing is there, to `root`. Throws CannotDo
/// with what was meant instead.
NamedText read_named_text(const Disk& disk, const std::string& directory, const std::string& root,
                          const std::string& argument);

}  // namespace porttool
