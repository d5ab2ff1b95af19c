// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/core_worker.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace application {
namespace {

using render_system::Convergence;
using render_system::CoreStats;
using render_system::Status;

/// A pass that takes longer is preceded by a coarse one: an answer is wanted within 100 ms.
constexpr double LONG_PASS_MS = 40.0, VERY_LONG_PASS_MS = 300.0;
/// Samples are taken together as long as they take no longer.
constexpr double PASS_MS = 40.0;

uint64_t all_rays(const CoreStats& stats) { return stats.primary_rays + stats.extension_rays + stats.shadow_rays; }

}  // namespace

CoreWorker::CoreWorker(std::string id, Open open, uint32_t most_samples)
    : id_(std::move(id)), open_(std::move(open)), most_samples_(most_samples), thread_([this] { run(); }) {}

CoreWorker::~CoreWorker() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void CoreWorker::show(const render_system::ViewPyramid& view, uint32_t width, uint32_t height, uint64_t request) {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = {view, width, height, request};
        runs_ = true;
    }
    wake_.notify_all();
}

void CoreWorker::rest() {
    const std::lock_guard lock(mutex_);
    runs_ = false;
}

bool CoreWorker::take(CorePicture& out) {
    const std::lock_guard lock(mutex_);
    if (!has_news_) return false;
    has_news_ = false;
    out = drawn_;
    return true;
}

Status CoreWorker::status() {
    const std::lock_guard lock(mutex_);
    return status_;
}

void CoreWorker::retry() {
    {
        const std::lock_guard lock(mutex_);
        status_ = Status::success();
    }
    wake_.notify_all();
}

render_system::HotKernels* CoreWorker::hot_kernels() {
    const std::lock_guard lock(mutex_);
    return hot_kernels_;
}

void CoreWorker::run() {
    uint64_t drawn = 0;
    while (true) {
        Request request;
        {
            std::unique_lock lock(mutex_);
            const auto has_work = [&] {
                const bool is_done = drawn == wanted_.number && core_ && core_->GetCoreStats().samples >= most_samples_;
                return ends_ || (runs_ && status_.ok() && wanted_.number > 0 && !is_done);
            };
            wake_.wait(lock, has_work);
            if (ends_) break;
            request = wanted_;
        }
        Status status = Status::success();
        if (!core_) {
            auto opened = open_();
            status = opened.status;
            if (opened.ok()) {
                core_ = std::move(*opened);
                const std::lock_guard lock(mutex_);
                hot_kernels_ = dynamic_cast<render_system::HotKernels*>(core_.get());
            }
        }
        if (status.ok()) status = draw(request, drawn != request.number);
        drawn = request.number;
        if (status.ok()) continue;
        const std::lock_guard lock(mutex_);
        status_ = std::move(status);
    }
    if (core_) core_->Shutdown();
}

Status CoreWorker::draw(const Request& request, bool fresh) {
    if (!fresh) {
        const double together = std::clamp(PASS_MS / std::max(sample_ms_, 1e-3), 1.0, 64.0);
        const auto left = static_cast<uint32_t>(most_samples_ - core_->GetCoreStats().samples);
        return pass(request, 1, Convergence::Converge, std::min(static_cast<uint32_t>(together), left));
    }
    constexpr uint32_t HALF = 2, QUARTER = 4;
    if (sample_ms_ > LONG_PASS_MS) {
        const uint32_t divisor = sample_ms_ > VERY_LONG_PASS_MS ? QUARTER : HALF;
        if (Status status = pass(request, divisor, Convergence::Restart, 1); !status.ok()) return status;
        const std::lock_guard lock(mutex_);
        if (wanted_.number != request.number) return Status::success();  // it moved on
    }
    return pass(request, 1, Convergence::Restart, 1);
}

Status CoreWorker::pass(const Request& request, uint32_t divisor, Convergence convergence, uint32_t samples) {
    const uint32_t width = std::max(1U, request.width / divisor), height = std::max(1U, request.height / divisor);
    if (!target_ || target_->width != width || target_->height != height) {
        auto target = std::make_unique<Picture>(width, height);
        if (Status status = core_->SetTarget({width, height, target->pixels}); !status.ok()) return status;
        target_ = std::move(target);
        convergence = Convergence::Restart;
    }
    const CoreStats before = convergence == Convergence::Restart ? CoreStats() : core_->GetCoreStats();
    const auto start = std::chrono::steady_clock::now();
    if (Status status = core_->Render(request.view, convergence, samples); !status.ok()) return status;
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
    const CoreStats after = core_->GetCoreStats();
    if (divisor == 1) sample_ms_ = took.count() / samples;

    const std::lock_guard lock(mutex_);
    drawn_.picture = *target_;
    drawn_.stats = after;
    drawn_.view = request.view;
    drawn_.request = request.number;
    drawn_.coarse = divisor > 1;
    drawn_.pass_ms = took.count();
    const double ms = after.total_ms - before.total_ms;
    drawn_.mrays_per_s = ms > 0.0 ? static_cast<double>(all_rays(after) - all_rays(before)) / ms * 1e-3 : 0.0;
    has_news_ = true;
    return Status::success();
}

}  // namespace application
