// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace target_core {

/// Sets what becomes of denormal floats while it lives, on this thread. Always inlined: objects for several instruction
/// sets use it.
class DenormalMode {
public:
    DenormalMode(const DenormalMode&) = delete;
    DenormalMode& operator=(const DenormalMode&) = delete;

protected:
#if defined(__x86_64__)
    [[gnu::always_inline]] explicit DenormalMode(bool flush)
        : before_(_mm_getcsr()), during_(flush ? before_ | FLUSH_BITS : before_ & ~FLUSH_BITS) {
        if (during_ != before_) _mm_setcsr(during_);
    }
    [[gnu::always_inline]] ~DenormalMode() {
        if (during_ != before_) _mm_setcsr(before_);
    }

private:
    static constexpr unsigned FLUSH_BITS = 0x8040;  // results to zero, and denormals that are read
    unsigned before_;
    unsigned during_;
#else
    explicit DenormalMode(bool) {}
    ~DenormalMode() {}
#endif
};

/// For kernels: lavapipe, the source core's reference device, keeps denormals too, and a library may have set a thread
/// of its pool to flush them.
class KeepDenormals : DenormalMode {
public:
    [[gnu::always_inline]] KeepDenormals() : DenormalMode(false) {}
    [[gnu::always_inline]] ~KeepDenormals() = default;
};

/// For Embree's walk of coherent packets, which is slower over denormals.
class FlushDenormals : DenormalMode {
public:
    [[gnu::always_inline]] FlushDenormals() : DenormalMode(true) {}
    [[gnu::always_inline]] ~FlushDenormals() = default;
};

}  // namespace target_core
