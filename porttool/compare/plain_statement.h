// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/compare/vector_parts.h"
#include "porttool/language/dialect.h"
#include "porttool/language/language.h"
#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// Translates the statements of one side so that equal words mean the same within that side: what only promises
/// something, or says how a function is linked, is left out, and what can be written in several ways is written in one.
/// What is not sure to change no value stays: `volatile`, `static` but on a function, address spaces, work-group sizes,
/// `uniform` and `varying`, `coherent`, `precise`, another number or built-in.
///
///     static inline __attribute__((always_inline)) float @ (const float* restrict a)       float @ (float* a)
///     const unsigned int n = static_cast<int>(x) ;                                          uint n = int(x)
///     static const float w = 1 ;                                                            static float w = 1
class PlainStatements {
public:
    PlainStatements(UnitKind kind, Language language, const Dialect& dialect)
        : is_code_(kind == UnitKind::Function || kind == UnitKind::Kernel),
          language_(language),
          dialect_(dialect),
          vectors_(language) {}

    /// What a text declares as vectors has components under several names. The text must outlive this.
    void note_vectors_of(const Words& text) { vectors_.note(text); }

    /// `in_body`: not the function's head.
    std::vector<std::string> translate(const Words& statement, bool in_body) const;

private:
    size_t after_idle(const Words& words, size_t i, bool in_head) const;
    std::string spelled(std::string_view word) const;

    bool is_code_;
    Language language_;
    const Dialect& dialect_;
    VectorSpelling vectors_;
};

}  // namespace porttool
