// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/normal/normal_form.h"
#include "porttool/normal/unit_text.h"

namespace porttool {

/// A unit as it stands now, with its text in normal form.
struct UnitState {
    std::string id;
    std::string file;
    std::string name;
    UnitKind kind = UnitKind::Function;
    uint32_t start_line = 0;
    uint32_t end_line = 0;
    Fingerprints prints;
    UnitText text;
};

UnitState unit_state(const ScannedFile& file, const Unit& unit);

/// The names that a unit declares for itself, in order of appearance: parameters and local variables.
std::vector<std::string> local_names(const ScannedFile& file, const Unit& unit);

/// The prints of a text alone. Where it has preprocessor lines, which tell no longer where a local is declared, its
/// locals keep their names.
Fingerprints prints_of_text(const NormalText& text);

}  // namespace porttool
