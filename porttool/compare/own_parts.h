// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "porttool/compare/alignment.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/side.h"

namespace porttool {

/// What the names of a unit and its port have of their own, in small letters: `cuda` and `hip` of `runCudaVariant` and
/// `runHipVariant`; of two paths, for each folder or file of one name but for that.
using OwnParts = std::vector<std::pair<std::string, std::string>>;

/// A part as names have it: in small letters, with a capital, in capitals.
std::array<std::string, 3> spellings(const std::string& part);

/// `source`, `target`: names with scopes, and paths.
OwnParts own_parts(const BySide<std::vector<std::string>>& names);

/// Gives words one common number that are the same name but for such parts, and each stand in one of the two texts
/// alone: `DATA_SETUP_CUDA` and `DATA_SETUP_HIP`.
void join_own_parts(AlignedText& source, AlignedText& target, const OwnParts& parts);

/// `words` with the other side's name for each that is the same but for such parts, and stands in one text alone:
///
///     words  dim3 t ( SIZE_CUDA , 1 )      there  dim3 t ( SIZE_HIP , 1 )      becomes  dim3 t ( SIZE_HIP , 1 )
Words with_parts_there(Words words, const Words& there, const OwnParts& parts);

}  // namespace porttool
