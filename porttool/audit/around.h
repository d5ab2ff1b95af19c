// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What the statements around one tell of it.
#pragma once

#include <optional>

#include "porttool/audit/common_texts.h"

namespace porttool {

/// True for the head of a loop or branch that leads to nothing but a message: `for ( i = 0 ; i < n ; i ++ )` before
/// `printf ( ... )`.
bool heads_a_message(const ReadSide& side, size_t index);

/// True for a statement in one branch of an `#if` where another branch has one nearly like it, with a counterpart on
/// the other side: this side can do the same in two ways, and the other has one of them.
bool is_alternative(const ReadSide& side, size_t index, const ReadSide& other);

/// True for a head whose first statement stands on the other side as well, behind a head of the same kind that this
/// side has nothing like: it may ask the same in its own words.
///
///     if ( ! isinf ( pixel [ 3 * at ] ) )       if ( film . has_samples ( at ) )
///         sum += weight * pixel [ at ] ;            sum += weight * pixel [ at ] ;
bool governs_the_same(const ReadSide& side, size_t index, const ReadSide& other);

/// How much of what stands around a statement the other side has as it is, 0 to 1; nothing where nothing stands there.
std::optional<float> shared_around(const ReadSide& side, size_t index, const ReadSide& other);

}  // namespace porttool
