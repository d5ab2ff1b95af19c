// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

namespace application {

/// Answers other ranks while this one renders. Over networks that cannot reach into a machine's memory by themselves
/// (TCP), what others want of the windows of a rank waits until it calls MPI, and so do the answers to what it has
/// asked for itself. MPI must have been initialised for MPI_THREAD_SERIALIZED.
class Answering {
public:
    /// `on`: there is a thread for it.
    explicit Answering(bool on);
    ~Answering();
    Answering(const Answering&) = delete;
    Answering& operator=(const Answering&) = delete;

    /// From here to end() the caller does not call MPI.
    void begin();
    void end();

private:
    void run();

    std::mutex mutex_;  // held by whoever calls MPI from that thread
    std::condition_variable change_;
    bool answers_ = false;
    bool ends_ = false;
    std::thread thread_;
};

}  // namespace application
