// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/judge/judge.h"
#include "porttool/judge/mapped_pair.h"
#include "porttool/judge/watched_units.h"

namespace porttool {

/// The unit in the counterpart's file that no pair watches and that was edited as the pair's `side` was: what one
/// function does here can be done by two there, of which the pair names but one. "" if there is none.
///
///     port        void run() { ... n = size() - taps; for (...) y[i] = fir(x, i, n); }
///     source      void launch() { ... n = size() - taps; kernel<<<...>>>(x, y, n); }      and the kernel, the pair's
///
/// One of the unit and the counterpart calls the other, all statements that came or went did so there as well, one of
/// them says something, and the counterpart has nothing like the place that they came to or went from. Of a unit whose
/// text before is not known (without a merge base, what the baseline has of it) it is enough that it was edited, says
/// all that came and nothing of what went.
std::string same_edit_beside(const Case& facts, WatchedUnits& watched, const JudgedPair& pair, Side side,
                             const NormalText& before, const Dialect& dialect);

}  // namespace porttool
