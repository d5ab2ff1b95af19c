// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// Splits a name into small words: `GlossyCoatingMaterial::GetColor_f32` becomes glossy coating material get color f32.
/// Digits stay with the letters before them; the endings of verbs and plurals go (`dequantize` and `dequant` are one).
std::vector<std::string> split_words(std::string_view name);

/// Letters and digits only, small; a leading `k` of a constant's name goes: `kMaxDepth` and `MAX_DEPTH` are one.
std::string fold(std::string_view name);

/// The file's name without folder and suffixes.
std::string_view file_stem(std::string_view path);

/// The folders of a path.
std::string_view folder_of(std::string_view path);

}  // namespace porttool
