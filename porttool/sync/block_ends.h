// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/alignment.h"
#include "porttool/sync/unit_words.h"

namespace porttool {

/// Lets the end of a block stand for the end of the block that its head stands for, where the order allows it: of two
/// braces in a row any may have been taken.
///
///     if ( a ) {             if ( a ) {
///     x = 1 ;                if ( b ) {
///     }                      x = 1 ;
///                            }               not this one
///                            else { ... }
///                            }               but this one
void match_block_ends(const AlignedText& first, const AlignedText& second, Alignment& alignment);

/// Lets the last `else` of a chain stand for the last one, where a branch came before it: an `else` and an `if` on one
/// line, whose braces are those of the normal form (`now` tells), are new.
///
///     if ( a ) { x ( ) ; }              if ( a ) { x ( ) ; }
///     else { z ( ) ; }                  else if ( b ) { y ( ) ; }
///                                       else { z ( ) ; }                 this one
void match_last_else(const AlignedText& first, const AlignedText& second, const UnitWords& now, Alignment& alignment);

/// Lets the only clause of a text stand for the only one of another, however unlike: `# define N 32` and
/// `# define N ( 2 * SIZE )`. Of the words those at both ends that are the same stand for each other.
void match_only_clauses(const AlignedText& first, const AlignedText& second, Alignment& alignment);

/// Lets a call stand for one of the same function, however many arguments came or went, where it alone changed between
/// two statements that stayed.
void match_calls(const AlignedText& first, const AlignedText& second, Alignment& alignment);

}  // namespace porttool
