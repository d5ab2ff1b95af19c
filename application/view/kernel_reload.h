// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "application/view/core_worker.h"
#include "application/view/folder_watch.h"

namespace application {

/// What became of kernels that were saved.
struct KernelNews {
    size_t core = 0;                 ///< index of the worker
    std::vector<std::string> files;  ///< that were saved
    render_system::RecompiledKernels done;
    std::string error;                               ///< why nothing new runs; empty where it does
    bool is_tried = true;                            ///< false: they are read and compiled once the core opens
    std::chrono::steady_clock::time_point saved_at;  ///< when that was noticed
};

/// Has the cores whose kernels lie in a folder compile them again as they are saved, in a thread of its own: the cores
/// go on drawing with those they have.
class KernelReload {
public:
    /// `workers` outlive it.
    KernelReload(std::string folder, std::vector<CoreWorker*> workers);
    ~KernelReload();
    KernelReload(const KernelReload&) = delete;
    KernelReload& operator=(const KernelReload&) = delete;

    /// The oldest news that was not taken yet.
    std::optional<KernelNews> take();

private:
    void run();

    const std::string folder_;
    const std::vector<CoreWorker*> workers_;
    FolderWatch watch_;
    std::mutex mutex_;
    std::vector<KernelNews> news_;  // guarded by the mutex
    std::thread thread_;
};

}  // namespace application
