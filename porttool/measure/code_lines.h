// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "porttool/scan/unit.h"

namespace porttool {

/// A piece of a file to be measured: a unit, or the whole file if `unit` is nullptr. Both must outlive it.
struct Excerpt {
    const ScannedFile* file = nullptr;
    const Unit* unit = nullptr;
};

/// One side of a comparison; each excerpt's text is a sequence of its own.
using Passage = std::vector<Excerpt>;

/// The tokens of an excerpt that count as code (indices into LexedText::tokens), as stretches of consecutive ones.
/// Left out: comments and licence heads, `#if 0`, include guards, and directives that say nothing by themselves:
/// #include, #pragma, #version, #extension, #line, #error, #undef.
std::vector<TokenRange> code_stretches(const Excerpt& excerpt);

/// The lines (from 1, ascending) on which such a token starts: what `lines` counts everywhere.
std::vector<uint32_t> code_lines(const Excerpt& excerpt);

}  // namespace porttool
