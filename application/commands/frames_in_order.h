// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "application/cluster/team.h"
#include "application/commands/frame_sequence.h"
#include "application/sampling/sequence_checkpoint.h"

namespace application {

/// Frames of --filter temporal, which follow from each other. A team takes the samples of each together; its leader
/// filters and writes it. What the last frame has left is kept in a checkpoint beside the frames where that is asked
/// for.
class FramesInOrder final : public FrameSequence {
public:
    FramesInOrder(const Options& options, const std::string& pattern, ImageKind kind, SceneSetup setup,
                  Console& console);

    render_system::Status render() override;

private:
    bool keeps_checkpoints() const { return options_.sampling.checkpoint || options_.resume; }
    std::string how_to_go_on() const override;
    render_system::Result<uint32_t> done_before();
    uint32_t frames_that_hold();
    render_system::Status start_after(uint32_t done);
    render_system::Status take_up();
    render_system::Status render_alone();
    render_system::Status lead(Team& ranks);
    render_system::Status follow(Team& ranks);
    render_system::Status take_together(Team& ranks);
    render_system::Status render_frame();
    render_system::Status finish_frame();
    void keep_if_due(double frame_seconds);
    void save_checkpoint();
    uint32_t first_sample() const { return next_ * options_.spp.front(); }
    bool has_all_samples() const { return sums_.samples == options_.spp.front(); }

    std::filesystem::path checkpoint_;
    std::optional<SequenceCheckpoint> found_;
    std::string lost_;   // a frame that it counts on and that is not there, or is of another sequence
    uint32_t next_ = 0;  // the place of the frame at work; those before are filtered and written
    std::chrono::steady_clock::time_point saved_;
    bool cannot_save_ = false;  // the last checkpoint, which was told
};

/// Where the checkpoint of that sequence lies.
std::filesystem::path sequence_checkpoint_of(const std::string& pattern);

}  // namespace application
