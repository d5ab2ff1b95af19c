// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/kernel_reload.h"

#include <utility>

#include "application/core_session.h"

namespace application {

KernelReload::KernelReload(std::string folder, std::vector<CoreWorker*> workers, OpenBare open)
    : folder_(std::move(folder)),
      workers_(std::move(workers)),
      open_(std::move(open)),
      bare_(workers_.size()),
      watch_(folder_),
      thread_([this] { run(); }) {}

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

void KernelReload::say(KernelNews news) {
    const std::lock_guard lock(mutex_);
    news_.push_back(std::move(news));
}

/// None where the core has no kernels, or reads them when it opens, which is now or anew.
KernelReload::Compiled KernelReload::compile(size_t core) {
    if (!workers_[core]->was_needed()) return compile_bare(core);
    if (bare_[core].core) bare_[core].core->Shutdown();
    bare_[core].core.reset();
    return workers_[core]->compile_again();
}

KernelReload::Compiled KernelReload::compile_bare(size_t core) {
    BareCore& bare = bare_[core];
    if (bare.has_none) return std::nullopt;
    if (!bare.core) {
        auto opened = open_(workers_[core]->id());
        if (opened.status.code == render_system::StatusCode::not_found) return opened.status;  // a kernel's file
        bare.has_none = !opened.ok() || dynamic_cast<render_system::HotKernels*>(opened->get()) == nullptr;
        if (bare.has_none) return std::nullopt;
        bare.core = std::move(*opened);
    }
    return dynamic_cast<render_system::HotKernels&>(*bare.core).compile_again();
}

void KernelReload::look_at_first() {
    for (size_t i = 0; i < workers_.size(); ++i) {
        if (workers_[i]->was_needed()) continue;
        const auto compiled = compile(i);
        if (compiled && !compiled->ok())
            say({i, {}, {}, explain(compiled->status), true, std::chrono::steady_clock::now()});
    }
}

void KernelReload::run() {
    look_at_first();
    while (true) {
        const FolderWatch::Saved saved = watch_.wait();
        if (saved.names.empty()) return;
        for (size_t i = 0; i < workers_.size(); ++i) {
            KernelNews news{i, {saved.names.begin(), saved.names.end()}, {}, "", true, saved.at};
            auto compiled = compile(i);
            const bool has_failed = !workers_[i]->status().ok();
            if (!compiled && !has_failed) continue;
            news.is_tried = compiled.has_value();
            if (compiled && compiled->ok()) news.done = std::move(**compiled);
            if (compiled && !compiled->ok()) news.error = explain(compiled->status);
            say(std::move(news));
        }
    }
}

}  // namespace application
