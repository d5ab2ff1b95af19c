// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "porttool/scan/unit.h"

namespace porttool {

/// Scans the text of one file: units in order of appearance, each line's class, all tokens with their places. `path`
/// tells the dialect. Never fails: a text without any unit yields no units.
ScannedFile scan_text(std::string_view path, std::string_view text);

/// The id of a unit: PATH:NAME.
std::string unit_id(const ScannedFile& file, const Unit& unit);

/// The file and the name of an id whose name is `Glass::Evaluate` or `main`, and whose file may be `a:b.cu`.
std::pair<std::string, std::string> split_id(const std::string& id);

/// The last part of a qualified name: `B::f` of `A::B::f` is `f`.
std::string_view leaf_of(std::string_view name);

/// The same without the number of an overload: `f` of `A::B::f#2`.
std::string_view bare_leaf_of(std::string_view name);

/// The unit that stands for a whole file, named `@file`.
Unit whole_file_unit(const ScannedFile& file);

}  // namespace porttool
