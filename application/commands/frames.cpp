// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <memory>
#include <utility>

#include "application/cluster/team.h"
#include "application/commands/command_steps.h"
#include "application/commands/commands.h"
#include "application/commands/frame_sequence.h"
#include "application/commands/frames_in_order.h"
#include "application/file_output.h"
#include "application/option_values.h"
#include "application/sampling/checkpoint.h"
#include "application/sampling/run_identity.h"

namespace application {
namespace {

using render_system::Status;

/// Frames that do not know of each other: members of a team take whole ones.
class SeparateFrames final : public FrameSequence {
public:
    SeparateFrames(const Options& options, const std::string& pattern, ImageKind kind, SceneSetup setup,
                   Console& console)
        : FrameSequence(options, pattern, kind, std::move(setup), console, true) {}

    Status render() override {
        return team() ? render_on(*team()) : render_frames([next = 0U]() mutable { return next++; });
    }

private:
    std::string how_to_go_on() const override { return "--resume goes on from there"; }

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
        // A member that was stopped alone has left its frame undone; the others have gone on.
        const auto came = [this](int number) { return signal() == number ? 1U : 0U; };
        uint64_t done[] = {kept_, rendered_, came(SIGINT), came(SIGTERM), came(SIGHUP)};
        ranks.add_up(done);
        kept_ = static_cast<uint32_t>(done[0]);
        rendered_ = static_cast<uint32_t>(done[1]);
        signal_elsewhere_ = done[2] > 0 ? SIGINT : done[3] > 0 ? SIGTERM : done[4] > 0 ? SIGHUP : 0;
        return status;
    }

    /// The frames that `next` names, from 0 on, as long as there are such.
    template <class Next>
    Status render_frames(Next next) {
        for (uint64_t place = next(); place < frame_count() && !stopped(); place = next()) {
            if (Status status = show(place); !status.ok()) return status;
            if (options_.resume && holds(place)) {
                ++kept_;
                continue;
            }
            const Status rendered = render_frame(place);
            if (rendered.code == render_system::StatusCode::called_off) return Status::success();
            if (!rendered.ok()) return rendered;
            if (stopped()) return Status::success();
            if (Status status = write(place); !status.ok()) return status;
            ++rendered_;
        }
        return Status::success();
    }

    Status render_frame(uint64_t place) {
        const auto began = std::chrono::steady_clock::now();
        if (Status status = started() ? begin(place, 0) : start(); !status.ok()) return status;
        tell_times(place, began);
        if (Status status = session_.render_up_to(options_.spp.front(), label_of(place)); !status.ok()) return status;
        if (stopped()) return Status::success();
        take_mean();
        if (options_.filter == FilterMode::none) return Status::success();
        return session_.filter(picture_, variances_of(sums_), {0, sums_.samples}, [this] { return stopped(); });
    }
};

std::unique_ptr<FrameSequence> make_sequence(const Options& options, const std::string& pattern, ImageKind kind,
                                             SceneSetup setup, Console& console) {
    if (options.filter == FilterMode::temporal)
        return std::make_unique<FramesInOrder>(options, pattern, kind, std::move(setup), console);
    return std::make_unique<SeparateFrames>(options, pattern, kind, std::move(setup), console);
}

/// Where what --filter temporal goes on from is to lie.
Status check_checkpoint(const Options& options, const std::string& pattern, Console& console) {
    const std::filesystem::path checkpoint = sequence_checkpoint_of(pattern);
    if (Status status = check_writable(checkpoint); !status.ok()) return status;
    remove_abandoned(checkpoint);
    std::error_code error;
    if (!options.resume && std::filesystem::exists(checkpoint, error))
        console.warning(fmt::format("{} is there: this run starts anew and will replace it; --resume goes on from it",
                                    checkpoint.string()));
    return Status::success();
}

Status check_sequence(const Options& options, const std::string& pattern, Console& console) {
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
    if (options.resume || options.sampling.checkpoint)
        remove_abandoned(std::filesystem::path(pattern).parent_path(),
                         [&](const std::string& name) { return is_frame_name(pattern, *options.frames, name); });
    if (options.filter == FilterMode::temporal && (options.resume || options.sampling.checkpoint))
        if (Status status = check_checkpoint(options, pattern, console); !status.ok()) return status;
    return check_files(options, *first);
}

}  // namespace

ExitCode run_frames(const Options& options, Console& console) {
    const std::string stem = std::filesystem::path(default_picture_name(options.scene)).stem();
    const std::string pattern = options.output.empty() ? stem + "_####.png" : options.output;
    const auto kind = image_kind(pattern);
    const bool leads = !team() || team()->leads();
    Status checked = kind.status;
    if (checked.ok() && leads) checked = check_sequence(options, pattern, console);
    if (checked = agreed(checked); !checked.ok()) return fail_once(console, checked);

    // As frame 0 has it, whichever come: where there is no camera the view frames what is there, and all ranges of a
    // sequence are to be seen from one place.
    Options first = options;
    first.time = frame_time(options, 0);
    auto setup = set_up_scene(first, console, output_files(options, frames_there(pattern, *options.frames)));
    if (Status status = agreed(setup.status); !status.ok()) return fail_once(console, status);
    const auto sequence = make_sequence(options, pattern, *kind, std::move(*setup), console);
    if (Status status = sequence->render(); !status.ok()) return fail_once(console, status);
    if (!leads) return DONE;
    if (const int signal = sequence->interrupted(); signal != 0) {
        console.note(sequence->progress());
        return exit_code_of_signal(signal);
    }
    const std::string text = sequence->summary();
    if (options.output.empty())
        console.result(text);
    else
        console.note(text.substr(0, text.size() - 1));
    return DONE;
}

}  // namespace application
