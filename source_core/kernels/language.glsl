// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// Kind: rewritten; the port is target_core/device/glsl.h: the words in which both kernel texts are written.
#ifndef LANGUAGE_GLSL
#define LANGUAGE_GLSL

// A capital letter says "one value per lane"; float, uint and bool mean "the same for all lanes".
#define Float float
#define Uint uint
#define Int int
#define Mask bool

Float select(Mask where, Float yes, Float no) { return where ? yes : no; }
Uint select(Mask where, Uint yes, Uint no) { return where ? yes : no; }
Int select(Mask where, Int yes, Int no) { return where ? yes : no; }
vec2 select(Mask where, vec2 yes, vec2 no) { return where ? yes : no; }
vec3 select(Mask where, vec3 yes, vec3 no) { return where ? yes : no; }
vec4 select(Mask where, vec4 yes, vec4 no) { return where ? yes : no; }

// Where the rows of an entry of a table begin. Several rows of one entry are fetched from the same Rows: the target
// core works out their addresses once.
#define Rows Uint
Rows rows_from(Uint first) { return first; }

// True if some lane is set: guards work that no lane needs. What stands under it must still be masked.
bool any_lane(Mask where) { return where; }

#endif
