// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
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
/// go on drawing with those they have. Of a core that is not shown yet a second one, without a scene, compiles them, at
/// the start too: what is broken is told before anybody looks.
class KernelReload {
public:
    /// A core of that id after Init, without a scene.
    using OpenBare =
        std::function<render_system::Result<std::unique_ptr<render_system::CoreAPI>>(const std::string& id)>;

    /// `workers` outlive it, and what `open` needs.
    KernelReload(std::string folder, std::vector<CoreWorker*> workers, OpenBare open);
    ~KernelReload();
    KernelReload(const KernelReload&) = delete;
    KernelReload& operator=(const KernelReload&) = delete;

    /// The oldest news that was not taken yet.
    std::optional<KernelNews> take();

private:
    using Compiled = std::optional<render_system::Result<render_system::RecompiledKernels>>;
    struct BareCore {
        std::unique_ptr<render_system::CoreAPI> core;
        bool has_none = false;  ///< it has no kernels to compile, or does not open here
    };
    void run();
    void look_at_first();
    Compiled compile(size_t core);
    Compiled compile_bare(size_t core);
    void say(KernelNews news);

    const std::string folder_;
    const std::vector<CoreWorker*> workers_;
    const OpenBare open_;
    std::vector<BareCore> bare_;  // of the thread alone
    FolderWatch watch_;
    std::mutex mutex_;
    std::vector<KernelNews> news_;  // guarded by the mutex
    std::thread thread_;
};

}  // namespace application
