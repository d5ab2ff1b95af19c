// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>

#include "application/console.h"
#include "application/core_session.h"
#include "application/options.h"
#include "application/sampling/interrupt.h"
#include "application/sampling/run_identity.h"
#include "application/sampling/sample_sums.h"
#include "application/sampling/take_samples.h"
#include "application/sampling/temporal_passes.h"

namespace application {

/// What of --samples, --checkpoint and --resume can be known to be wrong before anything is loaded.
render_system::Status check_sampling(const Options& options, const std::filesystem::path& file, Console& console);

/// One picture from its first sample to its file: taken up where a checkpoint left it, interrupted, written.
/// The session must have its core, and the first sample of `sums` be taken.
class PictureRun {
public:
    PictureRun(const Options& options, std::filesystem::path file, CoreSession& session, SampleSums& sums,
               const KeptInterrupt& interrupt, Console& console);

    /// With --resume, takes the samples of the checkpoint, if there is one. Fails where it is damaged or of another
    /// run, naming what differs.
    render_system::Status resume();

    /// Takes samples until all are there, or a limit or a signal ends it; `start` is what a time limit counts from.
    /// What is to be told of an early end is said on the console.
    render_system::Status take(std::chrono::steady_clock::time_point start);

    /// Writes the picture; a checkpoint goes when all samples are in it, and is renewed when they are not.
    render_system::Status write();

    /// What decides the bits; there is one where a team renders.
    const std::optional<RunIdentity>& identity() const { return run_; }

    bool interrupted() const { return end_ == SamplingEnd::interrupted; }

private:
    bool keeps_checkpoints() const { return options_.sampling.checkpoint || options_.resume; }
    /// Adds so many samples of every pixel to the sums, on the team where there is one.
    render_system::Status take_samples_of_all(uint32_t count);
    /// Brings the sums here that a team has.
    void collect();
    void save_checkpoint();
    bool is_pass_called_off() const;
    bool is_whole() const { return end_ == SamplingEnd::all_taken || end_ == SamplingEnd::noise; }
    /// The picture as it is to be seen, if the filter is not called off.
    render_system::Result<Picture> filtered();
    void stop_before_filter();
    PictureNotes notes(FilterMode filter) const;

    const Options& options_;
    std::filesystem::path file_;
    std::filesystem::path checkpoint_;
    CoreSession& session_;
    SampleSums& sums_;
    const KeptInterrupt& interrupt_;
    Console& console_;
    SampleRange wanted_;
    std::optional<RunIdentity> run_;               // where something is written that says it
    std::optional<TemporalPasses> passes_;         // where each is filtered
    std::chrono::steady_clock::time_point start_;  // of the time limit
    SamplingEnd end_ = SamplingEnd::all_taken;
    bool cannot_save_ = false;  // the last checkpoint, which was told
};

}  // namespace application
