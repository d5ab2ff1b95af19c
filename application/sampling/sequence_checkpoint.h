// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "application/sampling/run_identity.h"
#include "render_system/core_data.h"

// Frames of --filter temporal follow from each other: beside their files lies what the last of them has left, as
// <name of the frames, with its #>.checkpoint, there whole or not at all.

namespace application {

/// A sequence between two frames.
struct SequenceCheckpoint {
    RunIdentity run;      ///< with the scene as the last frame shows it
    uint32_t frames = 0;  ///< of the range, that are done; at least 1
    render_system::CoreHistory history;
};

/// What decides the bits of a sequence's next frame, with the scene that the core of the session has now.
RunIdentity sequence_identity(const Options& options, CoreSession& session);

/// Writes it in place of one that is there. Fails as write_file does.
render_system::Status write_sequence_checkpoint(const std::filesystem::path& file,
                                                const SequenceCheckpoint& checkpoint);

/// Reads it; nothing where there is none. Fails where it is torn, altered or of another format, naming the remedy.
render_system::Result<std::optional<SequenceCheckpoint>> read_sequence_checkpoint(const std::filesystem::path& file);

}  // namespace application
