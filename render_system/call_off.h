// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <utility>

#include "render_system/status.h"

namespace render_system {

/// Whether work that takes long is still wanted. Threads that share it ask through it at every step: once one of them
/// has heard that it is called off, all others know without asking.
class CallOff {
public:
    /// Without `asked` the work is wanted to its end.
    explicit CallOff(std::function<bool()> asked) : asked_(std::move(asked)) {}

    bool came() {
        if (!came_.load(std::memory_order_relaxed) && asked_ && asked_()) came_.store(true, std::memory_order_relaxed);
        return came_.load(std::memory_order_relaxed);
    }

    Status status() { return came() ? Status::error(StatusCode::called_off, "it was called off") : Status::success(); }

private:
    std::function<bool()> asked_;
    std::atomic<bool> came_ = false;
};

}  // namespace render_system
