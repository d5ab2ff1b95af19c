// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/core_worker.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <utility>

#include "application/core_session.h"

namespace application {
namespace {

using render_system::Convergence;
using render_system::CoreStats;
using render_system::CoreTarget;
using render_system::Status;
using render_system::StatusCode;

/// Nothing is begun that takes longer, as an answer is wanted within 100 ms: short samples are taken together, long
/// ones in parts, and before the first of these comes a coarse one.
constexpr double PASS_MS = 40.0;
/// Where a filter follows, for all of it: the first picture of a view is shown, whatever comes meanwhile.
constexpr double FILTERED_PASS_MS = 20.0;
/// From here on in parts: they cost a little.
constexpr double LONG_SAMPLE_MS = 50.0;
/// From here on a sample is one part: Mesa's lavapipe (22.3) loses 0.2 MB with each sample, however few its pixels.
constexpr uint32_t SETTLED_SAMPLES = 16;

uint64_t all_rays(const CoreStats& stats) { return stats.primary_rays + stats.extension_rays + stats.shadow_rays; }

using Clock = std::chrono::steady_clock;

double pass_ms(FilterMode filter) { return filter == FilterMode::none ? PASS_MS : FILTERED_PASS_MS; }

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// Whether a pass has gone by since it was first asked, which a core does when all is built and before it traces.
std::function<bool()> after_a_pass() {
    return [start = std::optional<Clock::time_point>()]() mutable {
        if (!start) start = Clock::now();
        return ms_since(*start) > PASS_MS;
    };
}

}  // namespace

CoreWorker::CoreWorker(std::string id, Open open, const render_system::CoreSettings& settings, uint32_t most_samples)
    : id_(std::move(id)), open_(std::move(open)), settings_(settings), most_samples_(most_samples), thread_([this] {
          run();
      }) {}

CoreWorker::~CoreWorker() {
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
    }
    wake_.notify_all();
    thread_.join();
}

void CoreWorker::show(const render_system::ViewPyramid& view, double seconds, uint32_t width, uint32_t height,
                      uint64_t request, FilterMode filter) {
    {
        const std::lock_guard lock(mutex_);
        wanted_ = {view, seconds, width, height, request, filter};
        runs_ = true;
    }
    wake_.notify_all();
}

void CoreWorker::rest() {
    const std::lock_guard lock(mutex_);
    runs_ = false;
}

bool CoreWorker::take(CorePicture& out) {
    const std::lock_guard lock(mutex_);
    if (!has_news_) return false;
    has_news_ = false;
    out = drawn_;
    return true;
}

Status CoreWorker::status() {
    const std::lock_guard lock(mutex_);
    return status_;
}

void CoreWorker::retry() {
    {
        const std::lock_guard lock(mutex_);
        status_ = Status::success();
    }
    wake_.notify_all();
}

bool CoreWorker::was_needed() {
    const std::lock_guard lock(mutex_);
    return wanted_.number > 0;
}

std::optional<render_system::Result<render_system::RecompiledKernels>> CoreWorker::compile_again() {
    const std::lock_guard lock(kernels_mutex_);
    if (hot_kernels_ == nullptr) return std::nullopt;
    return hot_kernels_->compile_again();
}

void CoreWorker::reopen(Clock::time_point written_at) {
    {
        const std::lock_guard lock(mutex_);
        reopens_ = true;
        written_at_ = written_at;
    }
    wake_.notify_all();
}

std::optional<CoreWorker::Reopened> CoreWorker::take_reopened() {
    const std::lock_guard lock(mutex_);
    return std::exchange(reopened_, std::nullopt);
}

void CoreWorker::take_over(OpenedCore core) {
    const std::lock_guard lock(kernels_mutex_);
    if (core_) core_->Shutdown();
    core_ = std::move(core);
    hot_kernels_ = dynamic_cast<render_system::HotKernels*>(core_.get());
}

/// True where another core draws from here on. A core that nobody needed yet is opened from its newest module anyway.
bool CoreWorker::open_anew() {
    if (!core_ && status().ok()) return false;
    const auto start = Clock::now();
    auto opened = open_();
    const bool is_open = opened.ok();
    if (is_open) take_over(std::move(*opened));
    const std::lock_guard lock(mutex_);
    if (is_open) status_ = Status::success();
    reopened_ = {opened.status, ms_since(start), written_at_};
    return is_open;
}

void CoreWorker::run() {
    uint64_t drawn = 0;
    while (true) {
        Request request;
        bool is_other_module = false;
        {
            std::unique_lock lock(mutex_);
            const auto has_work = [&] {
                const bool is_done = drawn == wanted_.number && samples_ >= most_samples_;
                return ends_ || reopens_ || (runs_ && status_.ok() && wanted_.number > 0 && !is_done);
            };
            wake_.wait(lock, has_work);
            if (ends_) break;
            request = wanted_;
            is_other_module = std::exchange(reopens_, false);
        }
        if (is_other_module) {
            if (open_anew()) drawn = 0;
            continue;
        }
        Status status = Status::success();
        if (!core_) {
            auto opened = open_();
            status = opened.status;
            if (opened.ok()) take_over(std::move(*opened));
        }
        if (status.ok()) status = draw(request, drawn != request.number);
        drawn = request.number;
        if (status.ok()) continue;
        const std::lock_guard lock(mutex_);
        status_ = std::move(status);
    }
    if (core_) core_->Shutdown();
}

bool CoreWorker::ends() {
    const std::lock_guard lock(mutex_);
    return ends_;
}

bool CoreWorker::is_called_away(uint64_t request) {
    const std::lock_guard lock(mutex_);
    return ends_ || !runs_ || wanted_.number != request;
}

Status CoreWorker::draw(const Request& request, bool fresh) {
    if (fresh) {
        if (Status status = core_.play(request.seconds); !status.ok()) return status;
        samples_ = 0;
        in_parts_ = sample_ms_ > LONG_SAMPLE_MS;
        was_coarse_ = first_picture_ms(request) > pass_ms(request.filter);
        if (was_coarse_)
            if (Status status = draw_coarsely(request); !status.ok()) return status;
        if (is_called_away(request.number) || (was_coarse_ && waits_for_more(request))) return Status::success();
    }
    // What seemed slow, as a first sample does, may not be.
    if (in_parts_ && samples_ > 0 && sample_ms_ < LONG_SAMPLE_MS / 2) {
        samples_ = 0;
        in_parts_ = false;
    }
    return in_parts_ ? take_sample_in_parts(request) : take_samples(request);
}

/// The core's target is the picture of this request, or a part of its size.
Status CoreWorker::point_at(const Request& request, uint32_t divisor, std::function<bool()> is_called_off) {
    const uint32_t width = std::max(1U, request.width / divisor), height = std::max(1U, request.height / divisor);
    auto target = std::make_unique<Picture>(width, height);
    const CoreTarget all{
        .width = width, .height = height, .pixels = target->pixels, .is_called_off = std::move(is_called_off)};
    if (Status status = core_->SetTarget(all); !status.ok()) return status;
    target_ = std::move(target);
    render_system::CoreSettings settings = settings_;
    settings.first_sample += first_sample(request);
    return core_->Setting(settings);
}

/// For a core, whose target outlives the request.
std::function<bool()> CoreWorker::away_from(const Request& request) {
    return [this, number = request.number] { return is_called_away(number); };
}

/// What a core answers in mid-sample: it begins anew with the next request.
Status CoreWorker::called_away(const Status& status) {
    if (status.code != StatusCode::called_off) return status;
    samples_ = 0;
    return Status::success();
}

/// Each view has samples of its own where a history goes through them: of the same ones nothing more would be learned.
uint32_t CoreWorker::first_sample(const Request& request) const {
    constexpr uint64_t VIEWS = 4096, LEAST_APART = 4096;  // in all 2^24 samples
    return request.filter == FilterMode::temporal ? static_cast<uint32_t>(request.number % VIEWS * LEAST_APART) : 0;
}

/// What the samples since the last call say of their noise. When it is called must not hang on how fast a core is: both
/// filter by this.
void CoreWorker::note_noise(const Picture& mean) {
    if (samples_ <= noted_ || sums_.size() != mean.pixels.size()) {
        sums_.assign(mean.pixels.size(), 0.0);
        squares_ = sums_;
        batches_ = noted_ = 0;
    }
    const double more = samples_ - noted_;
    for (size_t i = 0; i < sums_.size(); ++i) {
        const glm::dvec3 color(mean.pixels[i]);
        const double sum = samples_ * glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722)), added = sum - sums_[i];
        sums_[i] = sum;
        squares_[i] += added * added / more;
    }
    ++batches_;
    noted_ = samples_;
}

/// Of the mean of all samples; none where one batch is all there is.
std::vector<float> CoreWorker::variances() const {
    std::vector<float> variances;
    if (batches_ < 2) return variances;
    for (size_t i = 0; i < sums_.size(); ++i) {
        const double spread = squares_[i] - sums_[i] * sums_[i] / noted_;
        variances.push_back(static_cast<float>(std::max(0.0, spread) / (batches_ - 1.0) / noted_));
    }
    return variances;
}

/// The first picture of a view goes by those of views before, and what is of the view itself by itself: it is better
/// than any memory as soon as there are a few samples. A hand that moves would have none if that could be called off;
/// later ones are as soon as another view is wanted.
Status CoreWorker::filter(const Request& request, Picture& picture, uint32_t samples, bool first) {
    // As many as there are samples, which a picture that is the first of a view has few of.
    constexpr uint32_t FEWEST_RAYS = 2, MOST_RAYS = 8;
    const uint32_t rays = std::clamp(samples, FEWEST_RAYS, MOST_RAYS);
    unfiltered_.clear();
    if (request.filter == FilterMode::none) return Status::success();
    const bool remembers = first && request.filter == FilterMode::temporal;
    const std::vector<float> noise = first ? std::vector<float>() : variances();
    const auto start = Clock::now();
    const Status status = core_->Filter(
        request.view, {.means = picture.pixels,
                       .variances = noise,
                       .first_sample = settings_.first_sample + first_sample(request),
                       .samples = samples,
                       .filtered = picture.pixels,
                       .history = remembers ? render_system::FilterHistory::go_on : render_system::FilterHistory::none,
                       .most_rays = rays,
                       .is_called_off = [&] { return first ? ends() : is_called_away(request.number); }});
    if (status.code == StatusCode::out_of_memory) {  // noise is better than no picture
        unfiltered_ = explain(status);
        filter_ms_ = 0.0;
        return Status::success();
    }
    if (!status.ok()) return status;
    const double share = static_cast<double>(picture.pixels.size()) / (1.0 * request.width * request.height);
    filter_ms_ = ms_since(start) / share * FEWEST_RAYS / rays;  // of a first picture: rays are nearly all of it
    return status;
}

bool CoreWorker::is_to_be_shown(const Request& request) const {
    constexpr uint32_t FEW_SAMPLES = 4;
    if (request.filter == FilterMode::none || samples_ >= most_samples_) return true;
    const bool is_memory_better = !was_coarse_ && request.filter == FilterMode::temporal && samples_ > 1;
    return std::has_single_bit(samples_) && !(is_memory_better && samples_ < FEW_SAMPLES);
}

/// A hand that moves goes on: after a coarse picture a moment is left to it, as a whole one would end the history.
bool CoreWorker::waits_for_more(const Request& request) {
    constexpr auto MOMENT = std::chrono::milliseconds(60);
    if (request.filter != FilterMode::temporal) return false;
    std::unique_lock lock(mutex_);
    return wake_.wait_for(lock, MOMENT, [&] { return ends_ || !runs_ || wanted_.number != request.number; });
}

/// Of a whole picture of one sample, ready to be shown.
double CoreWorker::first_picture_ms(const Request& request) const {
    return sample_ms_ + (request.filter == FilterMode::none ? 0.0 : filter_ms_);
}

Status CoreWorker::draw_coarsely(const Request& request) {
    constexpr uint32_t COARSEST = 16;
    uint32_t divisor = 2;
    while (divisor < COARSEST && first_picture_ms(request) > pass_ms(request.filter) * divisor * divisor) divisor *= 2;
    const auto start = Clock::now();
    Status status = Status::success();
    do {  // what one takes may be ten times what it took in the view before
        status = point_at(request, divisor, divisor < COARSEST ? after_a_pass() : std::function<bool()>());
        if (status.ok()) status = core_->Render(request.view, Convergence::Restart, 1);
        divisor *= 2;
    } while (status.code == StatusCode::called_off);
    if (!status.ok()) return status;
    const CoreStats taken = core_->GetCoreStats();
    sample_ms_ = taken.total_ms * request.width * request.height / static_cast<double>(target_->pixels.size());
    return show_drawn(request, *target_, taken, true, ms_since(start));
}

/// As many as take no longer than a pass may.
Status CoreWorker::take_samples(const Request& request) {
    if (samples_ == 0)
        if (Status status = point_at(request, 1, away_from(request)); !status.ok()) return status;
    const auto together =
        static_cast<uint32_t>(std::clamp(pass_ms(request.filter) / std::max(sample_ms_, 1e-3), 1.0, 64.0));
    uint32_t samples = samples_ == 0 ? 1 : std::min(together, most_samples_ - samples_);
    if (request.filter != FilterMode::none && samples_ > 0)  // none past those that are shown next
        samples = std::min(samples, std::bit_ceil(samples_ + 1) - samples_);
    const CoreStats before = samples_ == 0 ? CoreStats() : core_->GetCoreStats();
    const auto start = Clock::now();
    const Convergence convergence = samples_ == 0 ? Convergence::Restart : Convergence::Converge;
    if (Status status = core_->Render(request.view, convergence, samples); !status.ok()) return called_away(status);
    const double took_ms = ms_since(start);
    sample_ms_ = took_ms / samples;
    CoreStats taken = core_->GetCoreStats();
    samples_ = static_cast<uint32_t>(taken.samples);  // fewer, where the kernels became others
    taken.primary_rays -= std::min(before.primary_rays, taken.primary_rays);
    taken.extension_rays -= std::min(before.extension_rays, taken.extension_rays);
    taken.shadow_rays -= std::min(before.shadow_rays, taken.shadow_rays);
    taken.total_ms -= std::min(before.total_ms, taken.total_ms);
    return show_drawn(request, *target_, taken, false, took_ms);
}

/// The same bits as take_samples, by sums of our own. A sample that is not finished is taken again.
Status CoreWorker::take_sample_in_parts(const Request& request) {
    const uint32_t width = request.width, height = request.height;
    const size_t pixels = size_t{width} * height;
    if (samples_ == 0) {
        if (Status status = point_at(request, 1, away_from(request)); !status.ok()) return status;
        sample_.assign(pixels, glm::vec4(0.0f));
        sum_ = sample_;
    }
    render_system::CoreSettings settings = settings_;
    settings.first_sample += first_sample(request) + samples_;
    if (Status status = core_->Setting(settings); !status.ok()) return status;
    const bool is_settled = samples_ >= SETTLED_SAMPLES;
    const auto parts = is_settled ? size_t{1} : static_cast<size_t>(std::clamp(sample_ms_ / PASS_MS, 2.0, 16.0));
    const size_t length = (pixels + parts - 1) / parts;
    CoreStats taken;
    const auto start = Clock::now();
    for (size_t first = 0; first < pixels; first += length) {
        if (first > 0 && is_called_away(request.number)) return Status::success();
        part_.assign(std::min(length, pixels - first), {});
        Status status = core_->SetTarget(
            {width, height, target_->pixels, part_, {}, static_cast<uint32_t>(first), away_from(request)});
        if (status.ok()) status = core_->Render(request.view, Convergence::Restart, 1);
        if (!status.ok()) return called_away(status);
        for (size_t i = 0; i < part_.size(); ++i) sample_[first + i] = glm::vec4(mean_of(part_[i], 1), 1.0f);
        const CoreStats now = core_->GetCoreStats();
        taken.primary_rays += now.primary_rays;
        taken.extension_rays += now.extension_rays;
        taken.shadow_rays += now.shadow_rays;
        taken.total_ms += now.total_ms;
        taken.memory_bytes = now.memory_bytes;
    }
    sample_ms_ = ms_since(start);
    taken.samples = ++samples_;
    Picture picture(width, height);
    for (size_t i = 0; i < pixels; ++i) {
        sum_[i] += sample_[i];
        picture.pixels[i] = glm::vec4(glm::vec3(sum_[i]) * (1.0f / static_cast<float>(samples_)), 1.0f);
    }
    return show_drawn(request, std::move(picture), taken, false, sample_ms_);
}

/// Takes the noise out where that is asked for; what is called off meanwhile is not shown.
Status CoreWorker::show_drawn(const Request& request, Picture picture, const CoreStats& taken, bool coarse,
                              double took_ms) {
    if (!coarse && request.filter != FilterMode::none && std::has_single_bit(samples_)) note_noise(picture);
    if (!coarse && !is_to_be_shown(request)) return Status::success();
    const bool first = coarse || (!was_coarse_ && samples_ == 1);
    const Status status = filter(request, picture, coarse ? 1 : samples_, first);
    if (status.code == StatusCode::called_off) return Status::success();
    if (!status.ok()) return status;
    const std::lock_guard lock(mutex_);
    drawn_.picture = std::move(picture);
    drawn_.stats = taken;
    drawn_.view = request.view;
    drawn_.request = request.number;
    drawn_.coarse = coarse;
    drawn_.pass_ms = took_ms;
    drawn_.unfiltered = unfiltered_;
    drawn_.mrays_per_s = taken.total_ms > 0.0 ? static_cast<double>(all_rays(taken)) / taken.total_ms * 1e-3 : 0.0;
    has_news_ = true;
    return Status::success();
}

}  // namespace application
