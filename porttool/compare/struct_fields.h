// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// A struct's text with one declarator a field, and sized types as one word.
///
///     struct @ { float3 o , d ; unsigned int k [ 4 ] ; } ;
///     struct @ { float3 o ; float3 d ; uint k [ 4 ] ; } ;
Words single_fields(const Words& tokens);

}  // namespace porttool
