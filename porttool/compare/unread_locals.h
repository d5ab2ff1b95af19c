// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// True if all that an edit did was to bring, or take, numbers, vectors and pointers of the function's own that nothing
/// reads, with what they are given. That calls nothing but mathematics and what containers say of their size.
///
///     int n = list.size(); float s; s = k; y[i] = k;        y[i] = k;
bool only_concerns_unread_locals(const Words& before, const Words& now, const Dialect& dialect);

/// True if all that an edit did was to bring, or take, parameters whose names stand nowhere else in the text. Those
/// that both texts have keep their order, and none has a value for calls that leave it out, so no call means another
/// one.
///
///     float @ ( Hit * hit , float k ) { return k ; }        float @ ( float k ) { return k ; }
bool only_concerns_unread_parameters(const Words& before, const Words& now);

/// True if all that an edit did was to give numbers of the function's own a first value where they are declared, which
/// had none there: nothing, or zero. What was read before was written before that, or was nothing at all.
///
///     double t; if (p) { t = now(); }        double t{}; if (p) { t = now(); }
bool only_gives_first_values(const Words& before, const Words& now);

}  // namespace porttool
