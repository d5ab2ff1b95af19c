// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

namespace source_core {

/// What Vulkan leaves to a device in the arithmetic of floats, and what makes it give the bits of a CPU
/// (docs/decisions/0041-the-same-bits-on-gpus.md). Vulkan rounds + - * correctly; a division may be off by 2.5 units in
/// the last place, a square root by more, a dot product adds in any order, and denormals may be flushed.
struct ExactArithmetic {
    bool spelled_out = false;      ///< divisions and their like go through functions on integers: EXACT_ARITHMETIC_TEXT
    bool keeps_denormals = false;  ///< these three: ask the device for it, which must have it
    bool keeps_zeros_and_nan = false;
    bool rounds_to_nearest = false;

    auto operator<=>(const ExactArithmetic&) const = default;
};

/// GLSL to be read before a kernel's text: the functions that `call_exact_arithmetic` calls. They round as IEEE
/// 754-2019 has it (to nearest, ties to even), denormals included, with whole numbers alone.
extern const char* const EXACT_ARITHMETIC_TEXT;

/// Puts calls of these functions in place of divisions, square roots, dot and cross products, minima and maxima.
/// `words` must be a module with EXACT_ARITHMETIC_TEXT in it and with its names, from before any optimisation.
std::vector<uint32_t> call_exact_arithmetic(const std::vector<uint32_t>& words);

/// Asks for what `wanted` says of denormals, zeros and rounding (SPV_KHR_float_controls) in 32-bit floats.
std::vector<uint32_t> ask_for_float_controls(const std::vector<uint32_t>& words, const ExactArithmetic& wanted);

}  // namespace source_core
