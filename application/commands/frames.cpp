// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <optional>

#include "application/cluster/team.h"
#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/file_output.h"
#include "application/frame_files.h"
#include "application/option_values.h"
#include "application/sampling/interrupt.h"
#include "application/sampling/run_identity.h"
#include "application/sampling/take_samples.h"

namespace application {
namespace {

using render_system::Convergence;
using render_system::FilterHistory;
using render_system::Result;
using render_system::Status;

/// A sequence on its way.
class Sequence {
public:
    Sequence(const Options& options, const std::string& pattern, ImageKind kind, SceneSetup setup, Console& console)
        : options_(options),
          pattern_(pattern),
          kind_(kind),
          console_(console),
          text_(sequence_text(options, setup.scene)),
          session_(options, std::move(setup), console),
          picture_(options.width, options.height),
          sums_(options.width, options.height, keeps_squares(options)) {
        session_.stop_on(&interrupt_);
        session_.sum_into(&sums_, 0);
    }

    /// Renders what is not there yet; stops at the first frame that cannot be done, or with a signal. Those before it
    /// stay.
    Status render() {
        return team() ? render_on(*team()) : render_frames([next = 0U]() mutable { return next++; });
    }

    /// The signal that ended it before its last frame, or 0.
    int interrupted() const { return kept_ + rendered_ < frame_count() ? interrupt_.signal() : 0; }

    /// What a sequence that was interrupted has.
    std::string progress() const {
        return fmt::format("interrupted by {}: {} of {} frames are done; {}",
                           interrupt_.signal() == SIGINT ? "Ctrl-C" : "SIGTERM", kept_ + rendered_, frame_count(),
                           options_.filter == FilterMode::temporal ? "frames of --filter temporal start from the first"
                                                                   : "--resume goes on from there");
    }

    std::string summary() const {
        const uint32_t last = options_.frames->end - 1;
        std::string text = fmt::format("{} to {}: {} frames of {}x{}, {} samples per pixel",
                                       *frame_file(pattern_, options_.frames->first), *frame_file(pattern_, last),
                                       kept_ + rendered_, options_.width, options_.height, options_.spp.front());
        if (kept_ > 0) text += fmt::format(", {} of them kept", kept_);
        return text + "\n";
    }

private:
    uint32_t frame_count() const { return options_.frames->end - options_.frames->first; }

    /// Each rank takes the next frame when it is done with one.
    Status render_on(Team& ranks) {
        Status status = session_.show(frame_time(options_, options_.frames->first));
        if (status.ok()) status = start();
        if (status = ranks.agree(status); !status.ok()) return status;
        if (status = ranks.agree_on(run_identity(options_, session_)); !status.ok()) return status;
        ranks.open_tasks();
        status = render_frames([&ranks] { return ranks.next_task(); });
        if (!status.ok()) ranks.skip_tasks(frame_count());
        status = ranks.agree(status);
        uint64_t done[] = {kept_, rendered_};
        ranks.add_up(done);
        kept_ = static_cast<uint32_t>(done[0]);
        rendered_ = static_cast<uint32_t>(done[1]);
        return status;
    }

    /// The frames that `next` names, from 0 on, as long as there are such.
    template <class Next>
    Status render_frames(Next next) {
        for (uint64_t place = next(); place < frame_count(); place = next()) {
            const uint32_t number = options_.frames->first + static_cast<uint32_t>(place);
            const std::string file = *frame_file(pattern_, number);
            if (interrupt_.signal() != 0) return Status::success();
            const double seconds = frame_time(options_, number);
            if (Status status = session_.show(seconds); !status.ok()) return named(number, status);
            const std::string text = frame_text(text_, session_.scene(), session_.view(), seconds);
            if (options_.resume && holds_frame(file, kind_, text)) {
                ++kept_;
                continue;
            }
            if (Status status = render_frame(number); !status.ok()) return status;
            if (interrupt_.signal() != 0) return Status::success();
            const auto bytes = encode_frame(picture_, kind_, options_, text);
            if (!bytes.ok()) return bytes.status;
            if (Status status = write_file(file, *bytes); !status.ok()) return status;
            ++rendered_;
        }
        return Status::success();
    }

    /// The core takes its first sample, of the frame that is shown.
    Status start() {
        sums_.clear();
        const auto choice = start_chosen_core(session_, options_, picture_, console_);
        started_ = choice.ok();
        return choice.status;
    }

    Status render_frame(uint32_t number) {
        const auto began = std::chrono::steady_clock::now();
        if (Status status = started_ ? begin(number) : start(); !status.ok()) return status;
        const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - began;
        const render_system::CoreStats stats = session_.stats();
        console_.detail(
            fmt::format("frame {}: {:.2f} ms until the scene was in place, {:.2f} of them for trees; {:.2f} ms "
                        "for its first sample",
                        number, taken.count() - stats.total_ms, stats.build_ms, stats.total_ms));
        const FrameRange& frames = *options_.frames;
        const std::string label =
            fmt::format("frame {} ({}/{})", number, number - frames.first + 1, frames.end - frames.first);
        if (Status status = session_.render_up_to(options_.spp.front(), label); !status.ok()) return status;
        if (interrupt_.signal() != 0) return Status::success();
        const Picture mean = mean_picture(sums_);
        std::copy(mean.pixels.begin(), mean.pixels.end(), picture_.pixels.begin());  // the core knows where they are
        if (options_.filter == FilterMode::none) return Status::success();
        const uint32_t first = first_sample();
        FilterHistory history = FilterHistory::none;
        if (options_.filter == FilterMode::temporal)
            history = rendered_ == 0 ? FilterHistory::begin : FilterHistory::go_on;
        return session_.filter(picture_, variances_of(sums_), {first, first + sums_.samples}, history);
    }

    Status begin(uint32_t number) {
        sums_.clear();
        if (Status status = session_.go_on_from(first_sample()); !status.ok()) return named(number, status);
        const Status status = session_.render(Convergence::Restart, 1);
        return status.ok() ? status : named(number, status);
    }

    /// Samples are new in each frame that a history goes through: of the same ones nothing more would be learned.
    uint32_t first_sample() const {
        return options_.filter == FilterMode::temporal ? rendered_ * options_.spp.front() : 0;
    }

    Status named(uint32_t number, Status status) const {
        status.message = fmt::format("{}: frame {}: {}", options_.scene, number, status.message);
        return status;
    }

    const Options& options_;
    const std::string& pattern_;
    ImageKind kind_;
    Console& console_;
    std::string text_;
    CoreSession session_;
    Picture picture_;
    KeptInterrupt interrupt_;
    SampleSums sums_;
    bool started_ = false;
    uint32_t kept_ = 0;
    uint32_t rendered_ = 0;
};

Status check_sequence(const Options& options, const std::string& pattern) {
    if (options.filter == FilterMode::temporal && team())
        return Status::invalid(
            "--frames: with --filter temporal each follows from those before it, and ranks take them in no order; "
            "start one rank, or give spatial");
    if (options.filter == FilterMode::temporal && options.resume)
        return Status::invalid(
            "--resume: frames of --filter temporal follow from those before them, of which a file holds too little; "
            "leave "
            "one of both out");
    const uint64_t frames = options.frames->end - options.frames->first;
    if (options.filter == FilterMode::temporal && frames * options.spp.front() > MAX_SAMPLES)
        return Status::invalid(
            fmt::format("--filter temporal: {} frames of {} samples each are more than {} samples; give fewer", frames,
                        options.spp.front(), MAX_SAMPLES));
    if (options.time_given)
        return Status::invalid(
            "--time: each frame of --frames has a time of its own, its number by --fps; give one of both");
    if (!options.stats.empty() || options.format == Format::json)
        return Status::invalid("--stats and --format json tell of one picture; leave them out with --frames");
    const auto first = frame_file(pattern, options.frames->first);
    if (!first.ok()) return first.status;
    if (Status status = check_writable(*first); !status.ok()) return status;
    for (const std::filesystem::path& file : frames_there(pattern, *options.frames)) {
        std::error_code error;
        if (std::filesystem::is_regular_file(file, error)) continue;
        if (Status status = check_writable(file); !status.ok()) return status;
    }
    return check_files(options, *first);
}

}  // namespace

ExitCode run_frames(const Options& options, Console& console) {
    const std::string stem = std::filesystem::path(default_picture_name(options.scene)).stem();
    const std::string pattern = options.output.empty() ? stem + "_####.png" : options.output;
    const auto kind = image_kind(pattern);
    const bool leads = !team() || team()->leads();
    Status checked = kind.status;
    if (checked.ok() && leads) checked = check_sequence(options, pattern);
    if (checked = agreed(checked); !checked.ok()) return fail_once(console, checked);

    Options first = options;
    first.time = frame_time(options, options.frames->first);
    auto setup = set_up_scene(first, console, output_files(options, frames_there(pattern, *options.frames)));
    if (Status status = agreed(setup.status); !status.ok()) return fail_once(console, status);
    Sequence sequence(options, pattern, *kind, std::move(*setup), console);
    if (Status status = sequence.render(); !status.ok()) return fail_once(console, status);
    if (!leads) return DONE;
    if (const int signal = sequence.interrupted(); signal != 0) {
        console.note(sequence.progress());
        return signal == SIGINT ? INTERRUPTED : TERMINATED;
    }
    const std::string text = sequence.summary();
    if (options.output.empty())
        console.result(text);
    else
        console.note(text.substr(0, text.size() - 1));
    return DONE;
}

}  // namespace application
