// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace target_core {

/// Keeps denormal floats while it lives, on this thread: lavapipe, the source core's reference device, keeps them too,
/// and a library may have set a thread of its pool to flush them.
class KeepDenormals {
public:
#if defined(__x86_64__)
    KeepDenormals() : saved_(_mm_getcsr()) { _mm_setcsr(saved_ & ~(FLUSH_TO_ZERO | DENORMALS_ARE_ZERO)); }
    ~KeepDenormals() { _mm_setcsr(saved_); }

private:
    static constexpr unsigned FLUSH_TO_ZERO = 0x8000;
    static constexpr unsigned DENORMALS_ARE_ZERO = 0x0040;
    unsigned saved_;
#else
    KeepDenormals() {}
    ~KeepDenormals() {}

public:
#endif
    KeepDenormals(const KeepDenormals&) = delete;
    KeepDenormals& operator=(const KeepDenormals&) = delete;
};

}  // namespace target_core
