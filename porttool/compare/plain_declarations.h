// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A text in which each declaration of numbers declares one, with the value that it gets in the next statement.
///
///     float a = 1 , b ;  b = a + 2 ;                  float a = 1 ;  float b = a + 2 ;
///
/// Pointers, references, functions and all that is of no type of the languages stay as they are.
Words with_plain_declarations(const Words& tokens);

}  // namespace porttool
