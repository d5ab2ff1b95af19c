// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <future>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "porttool/text/parallel.h"

namespace porttool {

/// Does one task after another, in the order in which they were given, in a thread of its own; where none can be had,
/// at once. When it goes, what has not begun is never done.
template <class Result>
class InTurn {
public:
    InTurn() {
        if (!threads_have_room()) return;
        try {
            thread_ = std::thread([this] { run(); });
        } catch (const std::system_error&) {
            // as where a container allows no more threads
        }
    }

    ~InTurn() {
        if (!thread_.joinable()) return;
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        changed_.notify_all();
        thread_.join();
    }

    InTurn(const InTurn&) = delete;
    InTurn& operator=(const InTurn&) = delete;

    /// Waits while kMostWaiting others have not begun, since each may hold much. What the task throws is the future's.
    std::future<Result> add(std::function<Result()> task) {
        Waiting one{std::move(task), {}};
        std::future<Result> result = one.result.get_future();
        if (!thread_.joinable()) {
            one.done();
            return result;
        }
        {
            std::unique_lock lock(mutex_);
            changed_.wait(lock, [this] { return waiting_.size() < kMostWaiting; });
            waiting_.push_back(std::move(one));
        }
        changed_.notify_all();
        return result;
    }

    static constexpr size_t kMostWaiting = 32;

private:
    /// A task and its result: a std::packaged_task would be kept, with all that it holds, for as long as its future is.
    struct Waiting {
        std::function<Result()> task;
        std::promise<Result> result;

        void done() {
            try {
                result.set_value(task());
            } catch (...) {
                result.set_exception(std::current_exception());
            }
        }
    };

    void run() {
        while (std::optional<Waiting> one = next()) {
            changed_.notify_all();
            one->done();
        }
    }

    /// The next task, once there is one; nothing when this object goes. Only moves, so that nothing can be thrown where
    /// nobody would catch it.
    std::optional<Waiting> next() {
        std::unique_lock lock(mutex_);
        changed_.wait(lock, [this] { return ends_ || !waiting_.empty(); });
        if (ends_) return std::nullopt;
        std::optional<Waiting> one(std::move(waiting_.front()));
        waiting_.pop_front();
        return one;
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Waiting> waiting_;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace porttool
