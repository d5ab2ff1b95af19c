// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/module_reload.h"

#include <utility>

#include "render_system/core_modules.h"

namespace application {

ModuleReload::ModuleReload(const std::filesystem::path& folder, std::vector<CoreWorker*> workers)
    : workers_(std::move(workers)), watch_(folder.string(), FolderWatch::What::Written), thread_([this] { run(); }) {}

ModuleReload::~ModuleReload() {
    watch_.end();
    thread_.join();
}

void ModuleReload::run() {
    while (true) {
        const FolderWatch::Saved saved = watch_.wait();
        if (saved.names.empty()) return;
        for (CoreWorker* worker : workers_)
            if (saved.names.contains("") || saved.names.contains(render_system::core_module_name(worker->id())))
                worker->reopen(saved.at);
    }
}

}  // namespace application
