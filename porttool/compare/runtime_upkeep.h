// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/normal/normal_text.h"

namespace porttool {

/// True if all that an edit brought in or took away are whole statements that keep house with a runtime, and the blocks
/// that hold nothing else: memory that is taken and given back, streams, events, properties of devices. None that moves
/// data, launches, waits or returns, and nothing that calls a function of the program's own.
///
///     q = cudaMalloc(&p, n);            upkeep
///     cudaMemset(p, 0, n);              none: data
///     if (is_shared(p)) { cudaFree(p); }    none: a function of its own
bool only_tends_runtime(const Words& before, const Words& now);

/// The same, and the edit only brought such statements in, or only took some away, and the other side's text calls no
/// runtime of that kind.
bool only_tends_foreign_runtime(const Words& before, const Words& now, const Words& other);

/// True if all that an edit did was to drive a device otherwise: upkeep as only_tends_runtime() has it, but for memory,
/// what waits for the device, what checks whether it did what it was told, and, with `streams`, how much memory of its
/// blocks and which stream a launch is given. Nothing that moves data or tells how many threads there are.
///
///     k<<<g, b, n * 4>>>(x);       k<<<g, b, n * 4, stream>>>(x); CHECK(cudaGetLastError());
bool only_drives_device(const Words& before, const Words& now, bool streams);

/// True for a text that drives a device, waits for one (`q.wait()`), or was handed its queue or stream.
bool may_drive_device(const Words& text);

/// True if an edit only made a text wait more often for what it gave a runtime to do.
///
///     q.memcpy(&n, p, 4);          q.memcpy(&n, p, 4).wait();
bool only_waits_more(const Words& before, const Words& now);

}  // namespace porttool
