// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

namespace porttool {

/// What builds, and where.
struct Workshop {
    std::string compiler;  ///< its path
    std::string folder;    ///< outside of the repository; the caller's to remove
};

/// The text of one function with what it needs, in a namespace of its own.
struct ProgramPart {
    int number = 0;
    std::string text;
    std::set<std::string> headers;  ///< of the standard library: "<vector>"
};

struct BuiltParts {
    std::map<int, std::string> programs;  ///< by number: the program that has it
    std::map<int, std::string> refused;   ///< why a part does not compile
};

/// Builds programs of these parts, of as many at once as compile together. A part with errors is refused with the first
/// of them.
BuiltParts build_parts(const std::vector<ProgramPart>& parts, const Workshop& workshop, const std::string& stem);

/// The compiler that is used: g++, clang++ or c++, whichever PATH has first; "" for none.
std::string find_compiler();

/// Writes the headers that all programs include. Throws CannotDo.
void write_prelude(const Workshop& workshop);

}  // namespace porttool
