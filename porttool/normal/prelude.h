// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// How a file declares the variables that a function of it uses, before its text: what they are is part of what it
/// does, though it stands outside of units.
///
///     ; ; static volatile int ready ; ; float @ ( float x ) { while ( ! ready ) { } return x ; }
///
/// A struct has the `#pragma pack` that holds for it. What a file says of the function itself comes with a word before
/// it: `default @ ( float x , float s = 2f )`, `template void @ < float > ( float * )`, `# pragma STDC FP_CONTRACT
/// OFF`; attributes with its name behind: `__attribute__ ( ( weak ) ) @`.
///
/// `places`: what declaring_tokens() gave; a local of the same name is another variable.
void write_prelude(const ScannedFile& file, const Unit& unit, const std::vector<uint32_t>& places,
                   const std::function<void(std::string_view word)>& sink);

/// A text's prelude, and what follows it.
Words prelude_of(const Words& text);
Words without_prelude(const Words& text);

}  // namespace porttool
