// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/commands/frames_in_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "application/counted.h"
#include "application/sampling/take_samples.h"

namespace application {
namespace {

using render_system::FilterHistory;
using render_system::Result;
using render_system::Status;
using Clock = std::chrono::steady_clock;

bool leads_here() { return !team() || team()->leads(); }

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

}  // namespace

std::filesystem::path sequence_checkpoint_of(const std::string& pattern) { return pattern + ".checkpoint"; }

FramesInOrder::FramesInOrder(const Options& options, const std::string& pattern, ImageKind kind, SceneSetup setup,
                             Console& console)
    : FrameSequence(options, pattern, kind, std::move(setup), console, leads_here()),
      checkpoint_(sequence_checkpoint_of(pattern)),
      saved_(Clock::now()) {
    if (team()) session_.only_try();
}

std::string FramesInOrder::how_to_go_on() const {
    return keeps_checkpoints() ? "--resume goes on from there"
                               : "frames of --filter temporal start from the first, unless --checkpoint keeps what "
                                 "--resume goes on from";
}

Status FramesInOrder::render() {
    const auto found = leads_here() ? done_before() : Result<uint32_t>(0u);
    if (Status status = agreed(found.status); !status.ok()) return status;
    const uint32_t done = team() ? static_cast<uint32_t>(team()->told(*found)) : *found;
    kept_ = next_ = done;
    Status status;
    if (done < frame_count()) status = start_after(done);
    if (!status.ok()) return status;
    if (done < frame_count()) status = !team() ? render_alone() : leads_here() ? lead(*team()) : follow(*team());
    std::error_code error;
    if (leads_here() && keeps_checkpoints() && next_ == frame_count()) std::filesystem::remove(checkpoint_, error);
    return status;
}

/// How many frames are there and need not be rendered again.
Result<uint32_t> FramesInOrder::done_before() {
    if (!options_.resume) return 0u;
    const uint32_t there = frames_that_hold();
    if (there == frame_count()) return there;
    auto read = read_sequence_checkpoint(checkpoint_);
    if (!read.ok()) return read.status;
    found_ = std::move(*read);
    if (!found_) {
        console_.note(fmt::format("there is no {}: the sequence starts from its first frame", checkpoint_.string()));
        return 0u;
    }
    if (found_->frames <= there) return found_->frames;
    lost_ = file_of(there);
    return 0u;
}

/// From the first one on.
uint32_t FramesInOrder::frames_that_hold() {
    uint32_t place = 0;
    while (place < frame_count() && show(place).ok() && holds(place)) ++place;
    return place;
}

/// Starts the core, with the history of the frames that are done.
Status FramesInOrder::start_after(uint32_t done) {
    Status status = show(done > 0 ? done - 1 : 0);
    if (status.ok()) status = start();
    if (status = agreed(status); !status.ok()) return status;
    if (team())
        if (status = team()->agree_on(sequence_identity(options_, session_)); !status.ok()) return status;
    return agreed(found_ ? take_up() : Status::success());
}

Status FramesInOrder::take_up() {
    const std::string other = first_difference(found_->run, sequence_identity(options_, session_), "was", "is");
    if (!lost_.empty()) {
        console_.note(fmt::format("{} is not {}: it starts from its first frame", lost_,
                                  other.empty() ? "there" : "of this sequence (" + other + ")"));
        found_.reset();
        return Status::success();
    }
    if (!other.empty())
        return Status::invalid(
            fmt::format("--resume: {} is of another sequence: {}; give what it was made with, or delete it",
                        checkpoint_.string(), other));
    if (Status status = session_.go_on_with(found_->history); !status.ok()) return status;
    console_.note(fmt::format("{}: going on after {}", checkpoint_.string(), counted(found_->frames, "frame")));
    found_.reset();
    return Status::success();
}

Status FramesInOrder::render_alone() {
    const bool first_is_taken = next_ == 0;  // one of frame 0, when the core started
    while (next_ < frame_count() && !stopped()) {
        const Clock::time_point began = Clock::now();
        Status status = show(next_);
        if (status.ok() && !(next_ == 0 && first_is_taken)) status = begin(next_, first_sample());
        if (!status.ok()) return status;
        tell_times(next_, began);
        if (status = session_.render_up_to(options_.spp.front(), label_of(next_)); !status.ok()) return status;
        if (!has_all_samples()) break;
        if (status = finish_frame(); !status.ok()) return status;
        keep_if_due(seconds_since(began));
    }
    if (stopped() && next_ < frame_count()) save_checkpoint();
    return Status::success();
}

Status FramesInOrder::lead(Team& ranks) {
    Status status;
    while (next_ < frame_count() && !stopped() && status.ok()) {
        const Clock::time_point began = Clock::now();
        ranks.told(1);
        status = show(next_);
        if (status.ok()) status = session_.synchronize();
        if (status = ranks.agree(status); !status.ok()) return status;
        status = take_together(ranks);
        ranks.end();
        if (!status.ok() || !has_all_samples()) break;
        status = finish_frame();
        if (status.ok()) keep_if_due(seconds_since(began));
    }
    ranks.told(0);
    if (status.ok() && stopped() && next_ < frame_count()) save_checkpoint();
    return status;
}

Status FramesInOrder::follow(Team& ranks) {
    while (ranks.told(0) != 0) {
        Status status = show(next_++);
        if (status.ok()) status = session_.synchronize();
        if (status = ranks.agree(status); !status.ok()) return status;
        if (status = ranks.follow(session_, keeps_squares(options_)); !status.ok()) return status;
    }
    return Status::success();
}

Status FramesInOrder::take_together(Team& ranks) {
    sums_.clear();
    const uint32_t first = first_sample();
    SamplingPlan plan{{first, first + options_.spp.front()}, Clock::now(), {}, {}, {}};
    plan.interrupt = &interrupt_;
    plan.label = label_of(next_);
    plan.portions = kTeamPortions;
    plan.render = [&](uint32_t count) { return ranks.render(session_, sums_, first + sums_.samples, count); };
    const Status status = take_samples(session_, sums_, plan, console_).status;
    if (status.ok()) ranks.collect(sums_);
    return status;
}

/// Filters the samples that are taken, and writes the frame. A signal calls the filter off: then there is no such frame
/// yet, and the history is that of those before.
Status FramesInOrder::finish_frame() {
    take_mean();
    const uint32_t first = first_sample();
    const FilterHistory history = next_ == 0 ? FilterHistory::begin : FilterHistory::go_on;
    Status status = session_.filter(
        picture_, variances_of(sums_), {first, first + sums_.samples}, [this] { return stopped(); }, history);
    if (status.code == render_system::StatusCode::called_off) return Status::success();
    if (status.ok()) status = write(next_);
    if (!status.ok()) return status;
    ++rendered_;
    ++next_;
    return status;
}

void FramesInOrder::keep_if_due(double frame_seconds) {
    const auto& interval = options_.sampling.checkpoint;
    if (!interval || next_ == frame_count() || stopped()) return;  // the end of a stopped one keeps it
    if (seconds_since(saved_) + std::min(frame_seconds, *interval) > *interval) save_checkpoint();
}

/// Of the frames before the one at work.
void FramesInOrder::save_checkpoint() {
    if (!keeps_checkpoints() || next_ == 0) return;
    Status status = show(next_ - 1);
    if (status.ok()) {
        auto history = session_.history();
        status = history.status;
        if (history.ok())
            status = write_sequence_checkpoint(checkpoint_,
                                               {sequence_identity(options_, session_), next_, std::move(*history)});
    }
    // A full disk now need not be one later: the frames that are done are files of their own.
    // Once is enough until one was written; the one that a run which was stopped leaves behind counts by itself.
    if (!status.ok() && (!cannot_save_ || stopped()))
        console_.warning(status.message + "; rendering goes on without a new checkpoint");
    cannot_save_ = !status.ok();
    saved_ = Clock::now();
}

}  // namespace application
