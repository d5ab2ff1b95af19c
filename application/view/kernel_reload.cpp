// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/kernel_reload.h"

#include <utility>

#include "application/core_session.h"

namespace application {

KernelReload::KernelReload(std::string folder, std::vector<CoreWorker*> workers)
    : folder_(std::move(folder)), workers_(std::move(workers)), watch_(folder_), thread_([this] { run(); }) {}

KernelReload::~KernelReload() {
    watch_.end();
    thread_.join();
}

std::optional<KernelNews> KernelReload::take() {
    const std::lock_guard lock(mutex_);
    if (news_.empty()) return std::nullopt;
    KernelNews out = std::move(news_.front());
    news_.erase(news_.begin());
    return out;
}

void KernelReload::run() {
    while (true) {
        const FolderWatch::Saved saved = watch_.wait();
        if (saved.names.empty()) return;
        for (size_t i = 0; i < workers_.size(); ++i) {
            KernelNews news{i, {saved.names.begin(), saved.names.end()}, {}, "", true, saved.at};
            auto compiled = workers_[i]->compile_again();
            const bool has_failed = !workers_[i]->status().ok();
            if (!compiled && !has_failed) continue;  // it has none, or reads them when it starts
            news.is_tried = compiled.has_value();
            if (compiled && compiled->ok()) news.done = std::move(**compiled);
            if (compiled && !compiled->ok()) news.error = explain(compiled->status);
            const std::lock_guard lock(mutex_);
            news_.push_back(std::move(news));
        }
    }
}

}  // namespace application
