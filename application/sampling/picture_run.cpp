// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/picture_run.h"

#include <fmt/format.h>

#include <utility>

#include "application/cluster/team.h"
#include "application/counted.h"
#include "application/file_output.h"
#include "application/sampling/checkpoint.h"
#include "application/sampling/sum_file.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;
using render_system::StatusCode;
using std::filesystem::path;

bool is_exr(const path& file) {
    const auto kind = image_kind(file.string());
    return kind.ok() && *kind == ImageKind::exr;
}

}  // namespace

Status check_sampling(const Options& options, const path& file, Console& console) {
    const SamplingOptions& sampling = options.sampling;
    if (sampling.range && options.filter != FilterMode::none)
        return Status::invalid(
            "--samples: parts of a picture are added first, and a filtered one cannot be added to; leave --filter out");
    if (sampling.range && !is_exr(file))
        console.note("a PNG of some samples cannot be added to others: pathtracer merge takes .exr");
    if (!sampling.checkpoint && !options.resume) return Status::success();
    const path checkpoint = checkpoint_of(file);
    if (Status status = check_writable(checkpoint); !status.ok()) return status;
    for (const path& written : {file, checkpoint}) remove_abandoned(written);
    std::error_code error;
    if (!options.resume && std::filesystem::exists(checkpoint, error))
        console.warning(fmt::format("{} is there: this run starts anew and will replace it; --resume goes on from it",
                                    checkpoint.string()));
    return Status::success();
}

PictureRun::PictureRun(const Options& options, path file, CoreSession& session, SampleSums& sums,
                       const KeptInterrupt& interrupt, Console& console)
    : options_(options),
      file_(std::move(file)),
      checkpoint_(checkpoint_of(file_)),
      session_(session),
      sums_(sums),
      interrupt_(interrupt),
      console_(console),
      wanted_(wanted_samples(options)) {
    if (is_exr(file_) || keeps_checkpoints() || team()) run_ = run_identity(options, session);
    if (options.filter == FilterMode::temporal)
        passes_.emplace(
            session, sums, wanted_.first,
            [this] {
                const Status status = take_samples_of_all(1);
                collect();
                return status;
            },
            [this] { return is_pass_called_off(); });
}

/// The first pass is not called off by the limit: there would be no filtered picture.
bool PictureRun::is_pass_called_off() const {
    if (interrupt_.signal() != 0) return true;
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start_;
    const auto& limit = options_.sampling.time_limit;
    return limit && taken.count() > *limit && passes_->count() > 0;
}

Status PictureRun::take_samples_of_all(uint32_t count) {
    if (team()) return team()->render(session_, sums_, wanted_.first + sums_.samples, count);
    return session_.render(render_system::Convergence::Converge, count);
}

void PictureRun::collect() {
    if (team()) team()->collect(sums_);
}

Status PictureRun::resume() {
    if (!options_.resume) return Status::success();
    auto read = read_checkpoint(checkpoint_);
    if (!read.ok()) return read.status;
    if (!*read) {
        console_.note(fmt::format("there is no {}: the picture starts from its first sample", checkpoint_.string()));
        return Status::success();
    }
    Checkpoint& checkpoint = **read;
    const auto refuse = [&](const std::string& what) {
        return Status::invalid(
            fmt::format("--resume: {} is of another run: {}; give what it was made with, or delete it",
                        checkpoint_.string(), what));
    };
    if (const std::string other = first_difference(checkpoint.run, *run_, "was", "is"); !other.empty())
        return refuse(other);
    if (checkpoint.first_sample != wanted_.first)
        return refuse(fmt::format("its first sample was {} and is {}", checkpoint.first_sample, wanted_.first));
    if (checkpoint.sums.samples > wanted_.count())
        return refuse(
            fmt::format("it has {}, {} are wanted", counted(checkpoint.sums.samples, "sample"), wanted_.count()));
    if (checkpoint.passes.has_value() != passes_.has_value())
        return refuse(fmt::format("--filter temporal {} given", passes_ ? "was not" : "was"));
    if (checkpoint.sums.squares.size() != sums_.squares.size())
        return refuse(fmt::format("--noise or --filter {} given", sums_.squares.empty() ? "was" : "was not"));
    // In place: the core knows where the sums are.
    sums_.samples = checkpoint.sums.samples;
    std::copy(checkpoint.sums.pixels.begin(), checkpoint.sums.pixels.end(), sums_.pixels.begin());
    std::copy(checkpoint.sums.squares.begin(), checkpoint.sums.squares.end(), sums_.squares.begin());
    console_.note(fmt::format("{}: going on after {}", checkpoint_.string(), counted(sums_.samples, "sample")));
    if (passes_)
        if (Status status = passes_->go_on_after(std::move(*checkpoint.passes)); !status.ok()) return status;
    return session_.go_on_from(wanted_.first + sums_.samples);
}

Status PictureRun::take(std::chrono::steady_clock::time_point start) {
    start_ = start;
    const SamplingOptions& sampling = options_.sampling;
    SamplingPlan plan{wanted_, start, sampling.time_limit, sampling.noise, sampling.checkpoint};
    plan.interrupt = &interrupt_;
    plan.collect = [this] { collect(); };
    plan.write_checkpoint = [this] {
        collect();
        save_checkpoint();
    };
    if (team()) plan.portions = kTeamPortions;
    plan.render = [this](uint32_t count) { return passes_ ? passes_->take(count) : take_samples_of_all(count); };
    const auto end = take_samples(session_, sums_, plan, console_);
    if (!end.ok()) return end.status;
    collect();
    end_ = *end;
    if (end_ == SamplingEnd::interrupted)
        console_.note(fmt::format("interrupted by {}: the picture has {} of {} samples",
                                  name_of_signal(interrupt_.signal()), sums_.samples, wanted_.count()));
    else if (end_ == SamplingEnd::time_limit)
        console_.note(fmt::format("the time limit is reached: the picture has {}", counted(sums_.samples, "sample")));
    else if (sampling.noise)
        console_.note(fmt::format("noise {:.4f} after {}{}", noise_of(sums_), counted(sums_.samples, "sample"),
                                  end_ == SamplingEnd::noise ? "" : "; more than asked for, but they are all taken"));
    return Status::success();
}

void PictureRun::save_checkpoint() {
    std::optional<KeptPasses> passes;
    Status status;
    if (passes_) {
        auto kept = passes_->kept();
        status = kept.status;
        if (kept.ok()) passes = std::move(*kept);
    }
    if (status.ok()) status = write_checkpoint(checkpoint_, *run_, wanted_.first, sums_, passes ? &*passes : nullptr);
    // A full disk now need not be one when the picture is done: hours of work are not dropped for it.
    // Once is enough until one was written; the one that a run which was stopped leaves behind counts by itself.
    if (!status.ok() && (!cannot_save_ || interrupted()))
        console_.warning(status.message + "; rendering goes on without a new checkpoint");
    cannot_save_ = !status.ok();
}

Result<Picture> PictureRun::filtered() {
    Picture picture = mean_picture(sums_);
    if (passes_) {
        Result<Picture> last = passes_->picture();
        if (!last.ok()) return last;
        picture = std::move(*last);
    } else {
        const SampleRange taken{wanted_.first, wanted_.first + sums_.samples};
        const Status status =
            session_.filter(picture, variances_of(sums_), taken, [this] { return interrupt_.signal() != 0; });
        if (!status.ok()) return status;
    }
    const render_system::CoreStats stats = session_.stats();
    console_.detail(fmt::format("filter: {:.2f} ms, after {:.2f} ms of camera rays", stats.filter_ms, stats.guide_ms));
    return picture;
}

PictureNotes PictureRun::notes(FilterMode filter) const {
    PictureNotes notes{.samples = sums_.samples};
    notes.ranges = range_text({{wanted_.first, wanted_.first + sums_.samples}});
    if (!run_) return notes;
    RunIdentity run = *run_;
    if (filter != FilterMode::none) run.entries.emplace_back(kFilterEntry, name_of(filter));
    notes.run = run.text();
    return notes;
}

/// A run that has all its samples and not their filtered picture is not done: --resume goes on to it.
void PictureRun::stop_before_filter() {
    console_.note(fmt::format("interrupted by {}: the picture is not filtered", name_of_signal(interrupt_.signal())));
    const bool was_whole = is_whole();
    end_ = SamplingEnd::interrupted;
    if (was_whole && keeps_checkpoints()) save_checkpoint();
}

Status PictureRun::write() {
    const auto kind = image_kind(file_.string());
    if (!kind.ok()) return kind.status;
    if (keeps_checkpoints() && !is_whole()) save_checkpoint();
    FilterMode filter = options_.filter;
    Result<Picture> picture = filter == FilterMode::none ? mean_picture(sums_) : filtered();
    if (picture.status.code == StatusCode::called_off) {
        stop_before_filter();
        filter = FilterMode::none;
        picture = mean_picture(sums_);
    }
    if (!picture.ok()) return picture.status;
    const bool as_sums = options_.sampling.range && is_exr(file_);
    const auto bytes = as_sums ? encode_sums(sums_, notes(filter))
                               : encode_picture(*picture, *kind, options_.exposure, options_.tone_map, notes(filter));
    const Status status = bytes.ok() ? write_file(file_, *bytes) : bytes.status;
    if (!status.ok() && keeps_checkpoints() && is_whole()) save_checkpoint();
    std::error_code error;
    if (status.ok() && keeps_checkpoints() && is_whole()) std::filesystem::remove(checkpoint_, error);
    return status;
}

}  // namespace application
