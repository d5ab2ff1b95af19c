// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/cluster/answering.h"

#include <mpi.h>

#include <chrono>

namespace application {
namespace {

// Somebody waits half of that for each of three questions a tile; a look takes a hundredth of it.
constexpr std::chrono::microseconds kBetweenLooks(250);

}  // namespace

Answering::Answering(bool on) {
    if (on) thread_ = std::thread([this] { run(); });
}

Answering::~Answering() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    change_.notify_one();
    thread_.join();
}

void Answering::begin() {
    if (!thread_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        answers_ = true;
    }
    change_.notify_one();
}

void Answering::end() {
    if (!thread_.joinable()) return;
    const std::lock_guard lock(mutex_);
    answers_ = false;
}

void Answering::run() {
    std::unique_lock lock(mutex_);
    while (true) {
        change_.wait(lock, [this] { return answers_ || ends_; });
        if (ends_) return;
        int there = 0;
        MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_SELF, &there, MPI_STATUS_IGNORE);  // any call moves all on
        lock.unlock();
        std::this_thread::sleep_for(kBetweenLooks);
        lock.lock();
    }
}

}  // namespace application
