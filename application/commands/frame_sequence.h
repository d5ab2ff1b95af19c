// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "application/console.h"
#include "application/core_session.h"
#include "application/frame_files.h"
#include "application/options.h"
#include "application/sampling/interrupt.h"
#include "application/sampling/sample_sums.h"

namespace application {

/// The frames of --frames on their way to their files. Places count from 0, numbers are those of the files.
class FrameSequence {
public:
    virtual ~FrameSequence() = default;
    FrameSequence(const FrameSequence&) = delete;
    FrameSequence& operator=(const FrameSequence&) = delete;

    /// Renders what is not there yet; stops at the first frame that cannot be done, or with a signal. Those before it
    /// stay.
    virtual render_system::Status render() = 0;

    /// The signal that ended it before its last frame, or 0.
    int interrupted() const { return kept_ + rendered_ < frame_count() ? signal() : 0; }

    /// What a sequence that was interrupted has.
    std::string progress() const;

    std::string summary() const;

protected:
    /// `sums_here`: samples are added up in this process.
    FrameSequence(const Options& options, const std::string& pattern, ImageKind kind, SceneSetup setup,
                  Console& console, bool sums_here);

    uint32_t frame_count() const { return options_.frames->end - options_.frames->first; }
    uint32_t number_of(uint64_t place) const { return options_.frames->first + static_cast<uint32_t>(place); }
    std::string file_of(uint64_t place) const { return *frame_file(pattern_, number_of(place)); }
    std::string label_of(uint64_t place) const;
    bool stopped() const { return interrupt_.signal() != 0; }
    /// The one that came here, or to another member of a team.
    int signal() const { return stopped() ? interrupt_.signal() : signal_elsewhere_; }
    bool started() const { return started_; }

    /// Brings scene and view to the time of that frame.
    render_system::Status show(uint64_t place);
    /// Whether the file of the frame that is shown is there as it would be written.
    bool holds(uint64_t place) const;
    /// The core takes its first sample, of the frame that is shown.
    render_system::Status start();
    /// Starts anew with the samples from `first_sample` on of the frame that is shown, and takes one.
    render_system::Status begin(uint64_t place, uint32_t first_sample);
    /// Says how long scene and first sample of a frame took that `began` then.
    void tell_times(uint64_t place, std::chrono::steady_clock::time_point began);
    /// The mean of the samples becomes the picture.
    void take_mean();
    /// Writes the picture as the frame that is shown.
    render_system::Status write(uint64_t place);
    render_system::Status named(uint64_t place, render_system::Status status) const;
    /// What --resume goes on from, for progress().
    virtual std::string how_to_go_on() const = 0;

    const Options& options_;
    const std::string& pattern_;
    Console& console_;
    CoreSession session_;
    Picture picture_;
    KeptInterrupt interrupt_;
    SampleSums sums_;
    uint32_t kept_ = 0;
    uint32_t rendered_ = 0;
    int signal_elsewhere_ = 0;

private:
    std::string text_of(uint64_t place) const;

    ImageKind kind_;
    std::string text_;
    bool started_ = false;
};

}  // namespace application
