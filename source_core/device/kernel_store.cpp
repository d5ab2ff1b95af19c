// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/device/kernel_store.h"

#include <algorithm>
#include <chrono>

#include "source_core/device/kernel_compiler.h"
#include "source_core/device/kernel_files.h"

namespace source_core {

using render_system::RecompiledKernels;

Result<KernelStore::Found> KernelStore::find(const Device& device, const KernelVariant& variant) {
    const std::lock_guard lock(mutex_);
    asked_ = variant;
    if (fresh_) {
        take_fresh();
        renewed_ = true;
    }
    auto found = sets_.find(variant);
    if (found == sets_.end()) {
        Result<KernelSet> made = KernelSet::create(device, files_, variant);
        if (!made.ok()) {
            return made.status;
        }
        found = sets_.emplace(variant, std::make_shared<KernelSet>(std::move(*made))).first;
    }
    in_use_ = found->second;
    return Found{in_use_.get(), std::exchange(renewed_, false)};
}

Status KernelStore::add_filter(const Device& device, bool with_history) {
    const std::lock_guard lock(mutex_);
    Status status = Status::success();
    for (uint32_t i = WAVEFRONT_KERNELS; i < KERNEL_COUNT && status.ok(); ++i) {
        const auto kernel = static_cast<Kernel>(i);
        const bool is_needed = with_history || kernel != Kernel::reproject;
        if (is_needed && !in_use_->has(kernel)) {
            status = in_use_->add(device, files_, kernel);
        }
    }
    return status;
}

// What was compiled for another variant than the fresh ones comes from texts that are gone.
void KernelStore::take_fresh() {
    files_ = std::move(fresh_->files);
    std::erase_if(sets_, [&](const auto& entry) { return entry.second != fresh_->set; });
    if (fresh_->is_whole) {
        sets_.emplace(fresh_->set->variant(), fresh_->set);
    }
    for (auto& [kernel, pipeline] : fresh_->pipelines) {
        fresh_->set->replace(kernel, std::move(pipeline));
    }
    fresh_.reset();
}

// The first Render compiles all of them for its scene.
Result<RecompiledKernels> KernelStore::check(Files files) {
    const auto start = std::chrono::steady_clock::now();
    KernelVariant variant;
    variant.features = ~0u;
    RecompiledKernels done;
    for (uint32_t i = 0; i < KERNEL_COUNT; ++i) {
        const std::string name = kernel_name(static_cast<Kernel>(i));
        Files texts = texts_of_kernel(files, static_cast<Kernel>(i));
        if (texts == checked_[i]) {
            continue;
        }
        const auto compiled = compile_kernel(files, name + ".comp", variant.preamble(), variant.arithmetic);
        if (!compiled.ok()) {
            return compiled.status;
        }
        checked_[i] = std::move(texts);
        done.kernels.push_back(name);
    }
    done.compile_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const std::lock_guard lock(mutex_);
    fresh_.reset();
    if (files != files_) {
        fresh_.emplace().files = std::move(files);
    }
    return done;
}

Result<RecompiledKernels> KernelStore::compile_again(const Device& device) {
    const auto start = std::chrono::steady_clock::now();
    Fresh fresh;
    Files before;
    std::optional<KernelVariant> failed;  // all of them are compiled for it: none ever were
    {
        const std::lock_guard lock(mutex_);
        before = files_;
        fresh.set = in_use_;
        failed = in_use_ ? std::nullopt : asked_;
    }
    Result<Files> now = read_kernel_files(directory_);
    if (!now.ok()) {
        return now.status;
    }
    if (!fresh.set && !failed) {
        return check(std::move(*now));
    }
    fresh.files = std::move(*now);
    RecompiledKernels done;
    bool edited = false;
    if (failed) {
        Result<KernelSet> made = KernelSet::create(device, fresh.files, *failed);
        if (!made.ok()) {
            return made.status;
        }
        fresh.set = std::make_shared<KernelSet>(std::move(*made));
        fresh.is_whole = edited = true;
    }
    for (uint32_t i = 0; i < KERNEL_COUNT; ++i) {
        const auto kernel = static_cast<Kernel>(i);
        if (fresh.is_whole && fresh.set->has(kernel)) {
            done.kernels.emplace_back(kernel_name(kernel));
            continue;
        }
        if (texts_of_kernel(before, kernel) == texts_of_kernel(fresh.files, kernel)) {
            continue;
        }
        edited = true;
        if (i >= WAVEFRONT_KERNELS && !fresh.set->has(kernel)) {
            continue;  // compiled where a filter asks for it
        }
        done.kernels.emplace_back(kernel_name(kernel));
        Result<Handle<VkPipeline>> pipeline = fresh.set->compile(device, fresh.files, kernel);
        if (!pipeline.ok()) {
            return pipeline.status;
        }
        fresh.pipelines.emplace_back(kernel, std::move(*pipeline));
    }
    done.compile_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const std::lock_guard lock(mutex_);
    fresh_.reset();  // where the texts became again what runs, there is nothing to take
    if (edited) {
        fresh_ = std::move(fresh);
    }
    return done;
}

KernelStore::Files KernelStore::texts_that_run() const {
    const std::lock_guard lock(mutex_);
    Files texts;
    for (uint32_t i = 0; i < KERNEL_COUNT; ++i) {
        texts.merge(texts_of_kernel(files_, static_cast<Kernel>(i)));
    }
    return texts;
}

}  // namespace source_core
