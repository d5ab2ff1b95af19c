// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/core_session.h"

#include <algorithm>
#include <utility>

#include "application/cores.h"
#include "application/progress_bar.h"

namespace application {
namespace {

using render_system::Convergence;
using render_system::CoreChoice;
using render_system::CoreStats;
using render_system::RenderSystem;
using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

constexpr double PORTION_MS = 250.0;  // between two moves of the bar

uint64_t rays(const CoreStats& stats) { return stats.primary_rays + stats.extension_rays + stats.shadow_rays; }

}  // namespace

CoreSession::CoreSession(const Options& options, SceneSetup setup, Console& console)
    : options_(options),
      console_(console),
      system_(std::move(setup.scene)),
      followed_(setup.followed),
      view_(render_system::view_pyramid(setup.camera, options.width, options.height)),
      seed_(options.seed) {}

render_system::CoreSettings core_settings(const Options& options, uint32_t seed) {
    return {.seed = seed,
            .max_path_length = options.max_path_length,
            .russian_roulette = options.russian_roulette,
            .next_event_estimation = options.next_event_estimation,
            .indirect_limit = options.indirect_limit};
}

render_system::CoreSettings CoreSession::settings() const {
    render_system::CoreSettings settings = core_settings(options_, seed_);
    settings.first_sample = first_sample_;
    return settings;
}

void CoreSession::sum_into(SampleSums* sums, uint32_t first_sample) {
    sums_ = sums;
    first_sample_ = first_sample;
}

Status CoreSession::render_part(std::span<render_system::PixelSum> sums, std::span<double> squares,
                                uint32_t first_pixel, uint32_t first_sample, uint32_t samples) {
    first_sample_ = first_sample;
    Status status = system_.core().SetTarget({options_.width, options_.height, pixels_, sums, squares, first_pixel});
    if (status.ok()) status = system_.core().Setting(settings());
    return status.ok() ? system_.render(view_, Convergence::Restart, samples) : status;
}

void CoreSession::stand_still() {
    content_ = scene_digest(scene());
    still_ = true;
}

Status CoreSession::go_on_from(uint32_t sample) {
    first_sample_ = sample;
    restart_ = true;
    return system_.core().Setting(settings());
}

Result<CoreChoice> CoreSession::start(const std::vector<std::string>& ids, Picture& picture) {
    const auto first_sample = [&](RenderSystem& system) {
        pixels_ = picture.pixels;
        render_system::CoreTarget target{picture.width, picture.height, pixels_};
        render_system::PixelSum one_pixel;
        if (only_tries_) target.sums = {&one_pixel, 1};
        if (sums_ && !only_tries_) {
            sums_->clear();  // a core tried before may have left some
            target.sums = sums_->pixels;
            target.squares = sums_->squares;
        }
        Status status = system.core().SetTarget(target);
        if (status.ok()) status = system.core().Setting(settings());
        if (status.ok()) status = system.core().SetWatch(watch_);
        if (status.ok()) status = system.render(view_, Convergence::Restart, 1);
        if (sums_ && !only_tries_ && status.ok()) sums_->samples = 1;
        return status;
    };
    auto choice =
        choose_core(make_registry(options_), ids,
                    {.threads = options_.threads, .exact = options_.exact, .still = still_}, system_, first_sample);
    if (choice.ok()) console_.detail("core " + choice->core + ": " + stats().device);
    return choice;
}

Status CoreSession::restart(uint32_t seed, uint32_t samples) {
    set_seed(seed);
    Status status = system_.core().Setting(core_settings(options_, seed_));
    return status.ok() ? render(Convergence::Restart, samples) : status;
}

Status CoreSession::render(Convergence convergence, uint32_t samples) {
    if (std::exchange(restart_, false)) convergence = Convergence::Restart;
    Status status = system_.render(view_, convergence, samples);
    if (sums_ && status.ok()) sums_->samples += samples;
    return status;
}

Status CoreSession::filter(Picture& picture, std::span<const float> variances, SampleRange samples,
                           std::function<bool()> is_called_off, render_system::FilterHistory history) {
    return system_.core().Filter(view_, {.means = picture.pixels,
                                         .variances = variances,
                                         .first_sample = samples.first,
                                         .samples = samples.count(),
                                         .filtered = picture.pixels,
                                         .history = history,
                                         .is_called_off = std::move(is_called_off)});
}

render_system::EmbreeFigures CoreSession::embree_figures() {
    const auto* probe = dynamic_cast<const render_system::EmbreeProbe*>(&system_.core());
    return probe ? probe->embree_figures() : render_system::EmbreeFigures();
}

bool CoreSession::measure_embree_limit() {
    auto* probe = dynamic_cast<render_system::EmbreeProbe*>(&system_.core());
    if (probe) probe->measure_embree_limit(true);
    return probe != nullptr;
}

Status CoreSession::show(double seconds) {
    if (Status status = system_.scene().play(seconds); !status.ok()) return status;
    if (!followed_) return Status::success();
    const auto camera = followed_camera(options_, system_.scene(), *followed_);
    if (camera.ok()) view_ = render_system::view_pyramid(*camera, options_.width, options_.height);
    return camera.status;
}

Status CoreSession::render_up_to(uint32_t samples, const std::string& label) {
    ProgressBar bar(console_, label);
    while (true) {
        const CoreStats now = stats();
        if (now.samples >= samples || (interrupt_ && interrupt_->signal() != 0)) return Status::success();
        bar.show(now.samples, samples, rays(now), now.total_ms * 1e-3);
        const auto left = static_cast<uint32_t>(samples - now.samples);
        uint32_t portion = left;
        if (console_.shows_progress() || interrupt_) {
            const double sample_ms = std::max(now.total_ms / static_cast<double>(now.samples), 1e-3);
            portion = static_cast<uint32_t>(std::clamp(PORTION_MS / sample_ms, 1.0, static_cast<double>(left)));
        }
        if (Status status = render(Convergence::Converge, portion); !status.ok()) return status;
    }
}

std::string explain(const Status& status, bool other_core) {
    std::string line = status.message;
    std::replace(line.begin(), line.end(), '\n', ' ');
    if (status.code != StatusCode::out_of_memory) return line;
    // A core with a budget is the source core; the target core has all of the machine's memory.
    const bool budget = status.allowed_bytes > 0;
    const bool tried = !other_core || line.find("core target") != std::string::npos;
    if (budget) line += tried ? "; raise --gpu-memory-limit" : "; use --core target, or raise --gpu-memory-limit";
    if (!budget || tried) line += "; or give a smaller scene or --size";
    return line;
}

}  // namespace application
