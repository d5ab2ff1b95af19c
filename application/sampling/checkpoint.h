// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "application/sampling/run_identity.h"
#include "application/sampling/sample_sums.h"
#include "application/sampling/temporal_passes.h"

// A checkpoint lies beside the picture that it is of, as <picture>.checkpoint: the sums of the samples so far, what
// filtered passes have left, what decides their bits, and a checksum. It is there whole or not at all.

namespace application {

/// Where the checkpoint of that picture lies.
std::filesystem::path checkpoint_of(const std::filesystem::path& picture);

struct Checkpoint {
    RunIdentity run;
    uint32_t first_sample = 0;
    SampleSums sums{0, 0, false};
    std::optional<KeptPasses> passes;  ///< where each is filtered
};

/// A core's history has no more numbers for each pixel.
constexpr uint64_t MAX_HISTORY_PLANES = 256;

/// Writes it in place of one that is there; `passes` may be null. Fails as write_file does.
render_system::Status write_checkpoint(const std::filesystem::path& file, const RunIdentity& run, uint32_t first_sample,
                                       const SampleSums& sums, const KeptPasses* passes);

/// Reads it; nothing where there is none. Fails where it is torn, altered or of another format, naming the remedy.
render_system::Result<std::optional<Checkpoint>> read_checkpoint(const std::filesystem::path& file);

/// Removes what runs that were killed have left in a folder of files that they wrote, whose names `is_ours` knows.
void remove_abandoned(const std::filesystem::path& folder, const std::function<bool(const std::string&)>& is_ours);
/// The same of one file.
void remove_abandoned(const std::filesystem::path& file);

}  // namespace application
