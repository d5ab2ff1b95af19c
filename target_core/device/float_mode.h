// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace target_core {

/// Sets what becomes of denormal floats while it lives, on this thread.
class DenormalMode {
public:
    DenormalMode(const DenormalMode&) = delete;
    DenormalMode& operator=(const DenormalMode&) = delete;

protected:
#if defined(__x86_64__)
    explicit DenormalMode(bool flush) : saved_(_mm_getcsr()) {
        _mm_setcsr(flush ? saved_ | FLUSH_TO_ZERO | DENORMALS_ARE_ZERO
                         : saved_ & ~(FLUSH_TO_ZERO | DENORMALS_ARE_ZERO));
    }
    ~DenormalMode() { _mm_setcsr(saved_); }

private:
    static constexpr unsigned FLUSH_TO_ZERO = 0x8000;
    static constexpr unsigned DENORMALS_ARE_ZERO = 0x0040;
    unsigned saved_;
#else
    explicit DenormalMode(bool) {}
    ~DenormalMode() {}
#endif
};

/// For kernels: lavapipe, the source core's reference device, keeps denormals too, and a library may have set a thread
/// of its pool to flush them.
class KeepDenormals : DenormalMode {
public:
    KeepDenormals() : DenormalMode(false) {}
};

/// For Embree where it slows down over denormals of its own making.
class FlushDenormals : DenormalMode {
public:
    FlushDenormals() : DenormalMode(true) {}
};

}  // namespace target_core
