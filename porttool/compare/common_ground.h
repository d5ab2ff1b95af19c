// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "porttool/compare/laid_edit.h"

namespace porttool {

/// Whether an edit of one side alone, of more than a word or two, touches nothing that the two sides have in common: of
/// what it took away nothing has its like on the other side, what it brought in stands beside no word that has, and
/// of its names the other side's text knows less than half. What is the other side's as well is not behind then. `No`
/// where that is not sure: edits of words that are never silent, and texts too long to lay side by side, unless the
/// other side knows hardly any of many names.
/// Where hardly a third of the two texts is alike, only clauses that are mostly the same are common ground: words have
/// their like there by chance, and of two dozen words or more the names need not be foreign. `Perhaps` of such, and of
/// an edit of a dozen words or less: the mend of a fault of both is as short. `Hardly` of launches, and of branches for
/// the compiler in texts that are alike: it is less likely an error than others, a warning
/// then and never a note.
///
///     before      q.wait(); y[i] = k * x[i];                                                      port
///     now         if (is_shared) { advise(y, q.get_device()); } q.wait(); y[i] = k * x[i];        off it
///     or now      q.wait(); y[i] = k * x[i]; if (y[i] > lim) { y[i] = lim; }                      on it
///     other       y[i] = k * x[i]; z[i] = y[i] + lim;                                             source
enum class OffGround : uint8_t { No, Hardly, Perhaps, Surely };
OffGround off_common_ground(LaidEdit& laid);

/// True if an edit touches words that are never silent, other than branches for the compiler.
bool touches_what_counts(LaidEdit& laid);

/// True if an edit changes how kernels are launched, and with what.
bool changes_launches(const LoneTexts& texts);

/// True if the edited side drives a runtime that the other does not call, and the other has no name or number that went
/// for good, and hardly any name that came: of a dozen words or more that are no print, check or timing.
///
///     - err = clEnqueueNDRangeKernel(q, k, 1, NULL, all, some, 0, 0, 0)            port; the source launches in CUDA
///     + err = clEnqueueNDRangeKernel(q, k, 1, NULL, all, some, 0, 0, &events[2])
bool only_concerns_own_runtime(LaidEdit& laid);

}  // namespace porttool
