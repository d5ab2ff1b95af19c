// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/commands/frame_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "application/commands/command_steps.h"
#include "application/counted.h"
#include "application/file_output.h"
#include "application/sampling/take_samples.h"

namespace application {

using render_system::Convergence;
using render_system::Status;

FrameSequence::FrameSequence(const Options& options, const std::string& pattern, ImageKind kind, SceneSetup setup,
                             Console& console, bool sums_here)
    : options_(options),
      pattern_(pattern),
      console_(console),
      session_(options, std::move(setup), console),
      picture_(options.width, options.height),
      sums_(sums_here ? options.width : 0, options.height, keeps_squares(options)),
      kind_(kind),
      text_(sequence_text(options, session_.scene())) {
    session_.stop_on(&interrupt_);
    session_.sum_into(&sums_, 0);
}

std::string FrameSequence::progress() const {
    return fmt::format("interrupted by {}: {} of {} frames are done; {}", name_of_signal(signal()), kept_ + rendered_,
                       frame_count(), how_to_go_on());
}

std::string FrameSequence::summary() const {
    std::string text = fmt::format("{} to {}: {} of {}x{}, {} per pixel", file_of(0), file_of(frame_count() - 1),
                                   counted(kept_ + rendered_, "frame"), options_.width, options_.height,
                                   counted(options_.spp.front(), "sample"));
    if (kept_ > 0) text += fmt::format(", {} of them kept", kept_);
    return text + "\n";
}

std::string FrameSequence::label_of(uint64_t place) const {
    return fmt::format("frame {} ({}/{})", number_of(place), place + 1, frame_count());
}

Status FrameSequence::show(uint64_t place) {
    const Status status = session_.show(frame_time(options_, number_of(place)));
    return status.ok() ? status : named(place, status);
}

std::string FrameSequence::text_of(uint64_t place) const {
    return frame_text(text_, session_.scene(), session_.view(), frame_time(options_, number_of(place)));
}

bool FrameSequence::holds(uint64_t place) const { return holds_frame(file_of(place), kind_, text_of(place)); }

Status FrameSequence::start() {
    sums_.clear();
    const auto choice = start_chosen_core(session_, options_, picture_, console_);
    started_ = choice.ok();
    return choice.status;
}

Status FrameSequence::begin(uint64_t place, uint32_t first_sample) {
    sums_.clear();
    Status status = session_.go_on_from(first_sample);
    if (status.ok()) status = session_.render(Convergence::Restart, 1);
    return status.ok() ? status : named(place, status);
}

void FrameSequence::tell_times(uint64_t place, std::chrono::steady_clock::time_point began) {
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - began;
    const render_system::CoreStats stats = session_.stats();
    console_.detail(
        fmt::format("frame {}: {:.2f} ms until the scene was in place, {:.2f} of them for trees; {:.2f} ms "
                    "for its first sample",
                    number_of(place), taken.count() - stats.total_ms, stats.build_ms, stats.total_ms));
}

void FrameSequence::take_mean() {
    const Picture mean = mean_picture(sums_);
    std::copy(mean.pixels.begin(), mean.pixels.end(), picture_.pixels.begin());  // the core knows where they are
}

Status FrameSequence::write(uint64_t place) {
    const auto bytes = encode_frame(picture_, kind_, options_, text_of(place));
    return bytes.ok() ? write_file(file_of(place), *bytes) : bytes.status;
}

Status FrameSequence::named(uint64_t place, Status status) const {
    status.message = fmt::format("{}: frame {}: {}", options_.scene, number_of(place), status.message);
    return status;
}

}  // namespace application
