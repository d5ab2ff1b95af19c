// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/read/disk.h"

namespace porttool {

/// Macros with what they stand for, as `-DNAME=VALUE` has them, in their order.
using Macros = std::vector<std::pair<std::string, std::string>>;

/// True for `NAME` and `NAME=VALUE` that a preprocessor takes as one value.
bool is_macro(std::string_view text);

/// `-DNAME` and `-DNAME=VALUE` in the flags of a compiler; what holds a variable of the build's language is left out.
Macros macros_in_flags(std::string_view flags);

/// What the text of a Makefile, or of a CMakeLists.txt, defines whatever the choices of whoever builds.
Macros macros_in_makefile(std::string_view text);
Macros macros_in_cmake(std::string_view text);

/// What a build defines on its command line. Nothing of a build is run: its files are read as texts.
class BuildDefines {
public:
    /// `given`: `NAME` or `NAME=VALUE` of the map and of the command line, for all files. `root`, `disk` must outlive
    /// it.
    BuildDefines(const std::string& root, const Disk& disk, const std::vector<std::string>& given);

    /// Lines `#define NAME VALUE` for a file: what was given, what compile_commands.json says of it, else what the next
    /// Makefile or CMakeLists.txt upwards says.
    const std::string& text_for(const std::string& path) const;

    /// The files of a build that are there and were not read, each with the reason: `Makefile: is not a regular file`.
    const std::vector<std::string>& unread() const { return unread_; }

private:
    std::optional<std::string> read(const std::string& path, uint64_t limit) const;
    void read_commands(const std::string& path);
    const Macros& of_folder(const std::string& folder, int up) const;

    const std::string& root_;
    const Disk& disk_;
    Macros given_;
    std::map<std::string, Macros> commands_;  ///< by path from the root
    mutable std::map<std::string, Macros> folders_;
    mutable std::map<std::string, std::string> texts_;
    mutable std::vector<std::string> unread_;
};

}  // namespace porttool
