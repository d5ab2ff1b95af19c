// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace source_core {

// Numbers from the SPIR-V specification 1.3, sections 3.20 (decorations), 3.6 (execution modes), 3.31 (capabilities)
// and 3.32 (instructions).
enum Op : uint32_t {
    OP_NAME = 5,
    OP_EXTENSION = 10,
    OP_EXT_INST_IMPORT = 11,
    OP_EXT_INST = 12,
    OP_ENTRY_POINT = 15,
    OP_EXECUTION_MODE = 16,
    OP_CAPABILITY = 17,
    OP_TYPE_FIRST = 19,
    OP_TYPE_FLOAT = 22,
    OP_TYPE_VECTOR = 23,
    OP_TYPE_MATRIX = 24,
    OP_TYPE_POINTER = 32,
    OP_TYPE_LAST = 39,
    OP_FUNCTION = 54,
    OP_FUNCTION_END = 56,
    OP_FUNCTION_CALL = 57,
    OP_VARIABLE = 59,
    OP_LOAD = 61,
    OP_STORE = 62,
    OP_ACCESS_CHAIN = 65,
    OP_IN_BOUNDS_ACCESS_CHAIN = 66,
    OP_DECORATE = 71,
    OP_MEMBER_DECORATE = 72,
    OP_ANNOTATION_LAST = 75,
    OP_COMPOSITE_CONSTRUCT = 80,
    OP_COMPOSITE_EXTRACT = 81,
    OP_FNEGATE = 127,
    OP_FADD = 129,
    OP_FSUB = 131,
    OP_FMUL = 133,
    OP_FDIV = 136,
    OP_FREM = 140,
    OP_FMOD = 141,
    OP_VECTOR_TIMES_SCALAR = 142,
    OP_DOT = 148,
    OP_ATOMIC_LOAD = 227,
    OP_ATOMIC_STORE = 228,
    OP_ATOMIC_EXCHANGE = 229,
    OP_ATOMIC_XOR = 242,
};
constexpr uint32_t DECORATION_NON_WRITABLE = 24;
constexpr uint32_t DECORATION_NON_READABLE = 25;
constexpr uint32_t DECORATION_NO_CONTRACTION = 42;
constexpr uint32_t STORAGE_CLASS_STORAGE_BUFFER = 12;
constexpr size_t BOUND_WORD = 3;  // of the header: one more than the largest id
constexpr size_t HEADER_WORDS = 5;

/// One instruction of a module: its words, the first of which holds opcode and length.
struct Instruction {
    const uint32_t* words;
    size_t at;  ///< index of the first word in the module

    uint32_t op() const { return words[0] & 0xFFFFu; }
    size_t length() const { return words[0] >> 16; }
    uint32_t operator[](size_t i) const { return words[i]; }
};

/// Visits the instructions of a module in order; ends where the words are no module, which spirv-val would say.
void for_each_instruction(const std::vector<uint32_t>& words, const std::function<void(const Instruction&)>& visit);

/// The first word of an instruction of so many words.
constexpr uint32_t first_word(uint32_t op, size_t length) { return static_cast<uint32_t>(length << 16) | op; }

}  // namespace source_core
