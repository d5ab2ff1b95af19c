// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "render_system/hot_kernels.h"
#include "source_core/device/kernel_set.h"

namespace source_core {

/// The kernels of a core: their texts, and what was compiled of them for each variant that was asked for.
class KernelStore {
public:
    using Files = std::map<std::string, std::string>;  ///< texts by name

    /// `directory` as read_kernel_files takes it.
    KernelStore(std::string directory, Files files) : directory_(std::move(directory)), files_(std::move(files)) {}

    /// The kernels for a variant, compiled where they were not yet; they stay until the next call. `renewed`, where
    /// they come from other texts than at the last call. Fails with internal where a kernel does not compile.
    struct Found {
        const KernelSet* kernels = nullptr;
        bool renewed = false;
    };
    Result<Found> find(const Device& device, const KernelVariant& variant);

    /// Compiles those of the kernels that only a filter runs which one without or with a history needs, for the variant
    /// that find was asked for last, unless they are there. Fails as find does.
    Status add_filter(const Device& device, bool with_history);

    /// As HotKernels::compile_again: for the variant that was asked for last; where none was, no further than that the
    /// device would take them, with all that a scene can have.
    Result<render_system::RecompiledKernels> compile_again(const Device& device);

    /// Those of the texts that run.
    Files texts_that_run() const;

private:
    /// What compile_again made and find has not taken yet.
    struct Fresh {
        Files files;
        std::shared_ptr<KernelSet> set;  // whose layout the pipelines have; none while nothing was asked for
        bool is_whole = false;           // it is the first one that compiled
        std::vector<std::pair<Kernel, Handle<VkPipeline>>> pipelines;
    };
    void take_fresh();
    Result<render_system::RecompiledKernels> check(Files files);

    const std::string directory_;
    mutable std::mutex mutex_;
    Files files_;  // guarded by the mutex, as are those that follow
    std::map<KernelVariant, std::shared_ptr<KernelSet>> sets_;
    std::optional<KernelVariant> asked_;  // of find, the last time
    std::shared_ptr<KernelSet> in_use_;
    std::optional<Fresh> fresh_;
    bool renewed_ = false;  // since find last answered
    // Of compile_again alone: the texts of each kernel that were last seen to compile.
    std::array<Files, KERNEL_COUNT> checked_;
};

}  // namespace source_core
