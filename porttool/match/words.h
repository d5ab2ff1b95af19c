// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// Splits a name into small words: `GlossyCoatingMaterial::GetColor_f32` becomes glossy coating material get color f32.
/// Digits stay with the letters before them; the endings of verbs and plurals go (`dequantize` and `dequant` are one).
std::vector<std::string> split_words(std::string_view name);

/// The same in two steps: the parts as they are written, in small letters, and the words that they are.
std::vector<std::string> split_pieces(std::string_view name);
std::vector<std::string> words_of(std::vector<std::string> pieces, std::string_view name);

/// True if a name converts one into another (`hex_to_u8`, `rgb2lab`), so that the order of its words counts.
bool converts(std::string_view name);

/// True for a word, as split_words() gives it, that tells how a function is made and not what it does: types (`f32`,
/// `float4`), platforms (`cuda`, `avx2`), ways of working (`tiled`, `optimized`), verbs that fit everything (`run`).
bool tells_how(std::string_view word);

/// The type of numbers that a word, as split_words() gives it, stands for (`f32`, `float`, `float4`: f32); else empty.
std::string_view type_of_word(std::string_view word);

/// True for a word, as split_words() gives it, that tells for which instruction set a function is written (`avx2`).
bool names_instruction_set(std::string_view word);

/// True for a word, as split_words() gives it, that marks what is computed on the host for comparison (`ref`, `gold`).
bool marks_reference(std::string_view word);

/// The name without words before or behind it that tell for which platform it is: `Forward_gpu`, `cuda_forward` and
/// `forwardCPU` are names of one thing, `copy_to_gpu` and `copy_to_cpu` are not.
std::string_view without_platform(std::string_view name);

/// True for `2`, `v3`.
bool numbers_a_version(std::string_view word);

/// True for a word, as split_words() gives it, of what makes ready, checks or tells and does not do (`load_param`).
bool marks_preparation(std::string_view word);

/// Letters and digits only, small; a leading `k` of a constant's name goes: `kMaxDepth` and `MAX_DEPTH` are one.
std::string fold(std::string_view name);

/// The file's name without folder and suffixes.
std::string_view file_stem(std::string_view path);

/// The one number of three to nine digits that a file's name has; 0 where it has none, or several: `m25600-pure`.
uint32_t number_in(std::string_view stem);

/// The folders of a path.
std::string_view folder_of(std::string_view path);

}  // namespace porttool
