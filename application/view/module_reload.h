// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <thread>
#include <vector>

#include "application/view/core_worker.h"
#include "application/view/folder_watch.h"

namespace application {

/// Has the cores whose modules lie in a folder opened anew as their files are written, in a thread of its own. A file
/// that goes is no news: a build may write it again, and the core goes on with what was loaded.
class ModuleReload {
public:
    /// `workers` outlive it.
    ModuleReload(const std::filesystem::path& folder, std::vector<CoreWorker*> workers);
    ~ModuleReload();
    ModuleReload(const ModuleReload&) = delete;
    ModuleReload& operator=(const ModuleReload&) = delete;

private:
    void run();

    const std::vector<CoreWorker*> workers_;
    FolderWatch watch_;
    std::thread thread_;
};

}  // namespace application
