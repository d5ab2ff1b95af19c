// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/view_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "application/core_session.h"
#include "application/cores.h"
#include "application/file_output.h"
#include "application/view/camera_text.h"

namespace application {

using render_system::CoreAPI;
using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

ViewSession::ViewSession(const Options& options, SceneSetup setup, ViewLog& log)
    : options_(options),
      log_(log),
      system_(std::move(setup.scene)),
      registry_(make_registry(options, render_system::ModuleSource::copy)),
      bounds_(system_.scene().bounds()),
      followed_(setup.followed),
      seconds_(options.time),
      first_camera_(setup.camera, bounds_),
      camera_(first_camera_),
      filter_(options.filter),
      image_{1, 1, {0, 0, 0}} {
    std::vector<std::string> ids = core_order(options, render_system::ModuleSource::copy).ids;
    for (const char* other : {"source", "target"}) {
        if (render_system::find_core_module(other).ok() && std::find(ids.begin(), ids.end(), other) == ids.end())
            ids.emplace_back(other);
    }
    pictures_.resize(ids.size());
    problems_.resize(ids.size());
    unfiltered_.resize(ids.size());
    module_errors_.resize(ids.size());
    for (const std::string& id : ids)
        workers_.push_back(std::make_unique<CoreWorker>(
            id, [this, id] { return open_core(id); }, core_settings(options, options.seed), options.spp.front()));
    begin();
    watch_files();
}

void ViewSession::watch_files() {
    std::vector<CoreWorker*> workers;
    for (const auto& worker : workers_) workers.push_back(worker.get());
    if (!options_.kernels.empty())
        kernel_reload_ = std::make_unique<KernelReload>(options_.kernels, workers,
                                                        [this](const std::string& id) { return open_bare_core(id); });
    for (const std::filesystem::path& folder : render_system::module_folders()) {
        std::error_code error;
        if (std::filesystem::is_directory(folder, error))
            module_reloads_.push_back(std::make_unique<ModuleReload>(folder, workers));
    }
}

Result<std::unique_ptr<CoreAPI>> ViewSession::open_bare_core(const std::string& id) {
    auto core = registry_.CreateCoreAPI(id);
    if (!core.ok()) return core.status;
    if (Status status = (*core)->Init({.threads = options_.threads, .exact = options_.exact}); !status.ok())
        return status;
    return core;
}

/// The cores take turns at the one host scene: each is sent all of it, and keeps it. What moves each has of its own.
Result<OpenedCore> ViewSession::open_core(const std::string& id) {
    const std::lock_guard lock(scene_mutex_);
    auto core = open_bare_core(id);
    if (!core.ok()) return core.status;
    if (Status status = (*core)->Setting(core_settings(options_, options_.seed)); !status.ok()) return status;
    if (is_animated()) {
        OpenedCore own{nullptr, std::make_unique<render_system::RenderSystem>(system_.scene())};
        own.system->use_core(std::move(*core));
        if (Status status = own.system->synchronize(); !status.ok()) return status;
        return own;
    }
    system_.use_core(std::move(*core));
    if (Status status = system_.synchronize(); !status.ok()) return status;
    return OpenedCore{system_.take_core()};
}

void ViewSession::note_input(const char* kind) {
    log_.say("input", {{"kind", kind}});
    await(active_, log_.now_ms());
}

void ViewSession::await(size_t core, double since_ms) {
    if (is_answered_ || core != awaited_) {
        asked_at_ms_ = since_ms;
        asked_request_ = request_ + 1;  // which begins next
    }
    awaited_ = core;
    is_answered_ = false;
}

void ViewSession::begin() {
    ++request_;
    const auto view = render_system::view_pyramid(camera_.camera(), options_.width, options_.height);
    for (size_t i = 0; i < workers_.size(); ++i) {
        if (is_needed(i))
            workers_[i]->show(view, seconds_, options_.width, options_.height, request_, filter_);
        else
            workers_[i]->rest();
    }
}

void ViewSession::frame_all() {
    move("frame",
         [&](ViewCamera& camera) { camera.frame(bounds_, static_cast<double>(options_.width) / options_.height); });
}

void ViewSession::next_camera() {
    const auto& cameras = system_.scene().cameras();
    move("camera", [&](ViewCamera& camera) {
        camera = next_camera_ < cameras.size() ? ViewCamera(cameras[next_camera_].camera, bounds_) : first_camera_;
        next_camera_ = next_camera_ < cameras.size() ? next_camera_ + 1 : 0;
    });
}

void ViewSession::switch_core() {
    active_ = (active_ + 1) % workers_.size();
    note_input("switch");
    log_.say("switch", {{"core", core_name(active_)}});
    is_stale_ = true;
    begin();
}

void ViewSession::play_or_pause() {
    if (!is_animated()) return;
    is_playing_ = !is_playing_;
    log_.say("input", {{"kind", is_playing_ ? "play" : "pause"}, {"seconds", seconds_}});
}

void ViewSession::scrub(double seconds) {
    if (!is_animated()) return;
    is_playing_ = false;
    show_moment(std::clamp(seconds, 0.0, duration()));
    log_.say("input", {{"kind", "scrub"}, {"seconds", seconds_}});
}

void ViewSession::play_on(double elapsed) {
    if (!is_playing_) return;
    for (size_t i = 0; i < workers_.size(); ++i)
        if (is_needed(i) && problems_[i].empty() && pictures_[i].request != request_) return;
    const double next = seconds_ + elapsed;
    show_moment(next > duration() ? 0.0 : next);
}

void ViewSession::show_moment(double seconds) {
    const std::lock_guard lock(scene_mutex_);
    seconds_ = seconds;
    probe_.reset();
    // What cannot be shown each core says of its own scene.
    if (!system_.scene().play(seconds).ok()) return begin();
    if (followed_) {
        const auto camera = followed_camera(options_, system_.scene(), *followed_);
        if (camera.ok()) camera_ = ViewCamera(*camera, bounds_);
    }
    await(active_, log_.now_ms());
    begin();
}

void ViewSession::set_show(Show show) {
    if (workers_.size() < 2) return;
    composition_.show = show;
    note_input(show == Show::One ? "one" : show == Show::Split ? "split" : "difference");
    is_stale_ = true;
    begin();
}

void ViewSession::set_split(float split) {
    composition_.split = std::clamp(split, 0.0f, 1.0f);
    is_stale_ = true;
}

void ViewSession::set_gain(int gain) {
    constexpr int MOST = 256;
    composition_.gain = std::clamp(gain, 1, MOST);
    is_stale_ = true;
}

void ViewSession::set_filter(FilterMode filter) {
    filter_ = filter;
    note_input("filter");
    begin();
}

bool ViewSession::update() {
    for (size_t i = 0; i < workers_.size(); ++i) {
        const Status status = workers_[i]->status();
        if (!status.ok() && problems_[i].empty()) {
            problems_[i] = explain(status);
            log_.say("error", {{"core", core_name(i)}, {"message", problems_[i]}});
            if (i == active_ && !is_stuck()) switch_core();
        }
        if (!workers_[i]->take(pictures_[i])) continue;
        is_stale_ = is_stale_ || is_needed(i);
        const CorePicture& now = pictures_[i];
        note_unfiltered(i);
        if (now.request < asked_request_ || i != awaited_ || is_answered_) continue;
        is_answered_ = true;
        log_.say("pixels", {{"core", core_name(i)},
                            {"samples", now.stats.samples},
                            {"coarse", now.coarse},
                            {"answered_ms", std::round(log_.now_ms() - asked_at_ms_)}});
    }
    if (!is_stale_) return false;
    compose();
    is_stale_ = false;
    return true;
}

/// Coarse pictures say nothing: they may be small enough for a filter that whole ones are too large for.
void ViewSession::note_unfiltered(size_t core) {
    const CorePicture& now = pictures_[core];
    if (now.coarse || now.unfiltered == unfiltered_[core]) return;
    unfiltered_[core] = now.unfiltered;
    if (!now.unfiltered.empty()) log_.say("error", {{"core", core_name(core)}, {"message", now.unfiltered}});
}

bool ViewSession::is_stuck() const {
    return std::none_of(problems_.begin(), problems_.end(), [](const std::string& one) { return one.empty(); });
}

bool ViewSession::take_news() {
    bool is_new = false;
    while (kernel_reload_) {
        const auto news = kernel_reload_->take();
        if (!news) break;
        note_kernels(*news);
        is_new = true;
    }
    for (size_t i = 0; i < workers_.size(); ++i) {
        const auto news = workers_[i]->take_reopened();
        if (!news) continue;
        note_module(i, *news);
        is_new = true;
    }
    return is_new;
}

void ViewSession::note_module(size_t core, const CoreWorker::Reopened& news) {
    std::string& error = module_errors_[core];
    error = news.status.ok() ? "" : explain(news.status);
    if (!error.empty()) return log_.say("error", {{"core", core_name(core)}, {"message", error}});
    log_.say("reload", {{"core", core_name(core)},
                        {"module", render_system::core_module_name(core_name(core))},
                        {"open_ms", std::round(news.open_ms)}});
    problems_[core].clear();
    if (!is_needed(core)) return;
    await(core, log_.ms_of(news.written_at));
    begin();
}

const std::string& ViewSession::reload_error() const {
    if (!kernel_error_.empty()) return kernel_error_;
    const auto is_error = [](const std::string& one) { return !one.empty(); };
    const auto found = std::find_if(module_errors_.begin(), module_errors_.end(), is_error);
    return found == module_errors_.end() ? kernel_error_ : *found;
}

/// Both cores begin anew, so that what is compared has as many samples on either side.
void ViewSession::note_kernels(const KernelNews& news) {
    const bool is_same_error = news.error == kernel_error_, had_error = !kernel_error_.empty();
    kernel_error_ = news.error;
    const std::string& name = core_name(news.core);
    if (!news.error.empty()) {
        if (!is_same_error) log_.say("error", {{"core", name}, {"message", news.error}});
        return;
    }
    const bool has_failed = !problems_[news.core].empty();
    const bool is_as_it_was = news.done.kernels.empty() && !has_failed;
    if (is_as_it_was && !had_error) return;
    if (news.is_tried)
        log_.say("reload", {{"core", name},
                            {"files", news.files},
                            {"kernels", news.done.kernels},
                            {"compile_ms", std::round(news.done.compile_ms)}});
    if (is_as_it_was) return;
    problems_[news.core].clear();
    workers_[news.core]->retry();
    if (!is_needed(news.core)) return;
    await(news.core, log_.ms_of(news.saved_at));
    begin();
}

/// In split and difference the first core of the list is always the first picture. A core that has not drawn yet does
/// not take the place of one that has, nor an older picture that of a newer one. A hand may ask for more views than are
/// drawn: it is shown those that are.
void ViewSession::compose() {
    const auto levels = [&](size_t core) {
        return srgb_levels(pictures_[core].picture, options_.exposure, options_.tone_map);
    };
    // While it plays two moments are never held against each other.
    if (composition_.show != Show::One && is_playing_ && pictures_[0].request != pictures_[1].request) return;
    if (composition_.show != Show::One && has_drawn(0) && has_drawn(1)) {
        image_ = composed(levels(0), levels(1), composition_);
        has_shown_ = true;
    } else if (is_shown_by_front()) {
        image_ = levels(active_);
        shown_request_ = pictures_[active_].request;
        has_shown_ = true;
    }
}

/// Or will be: its picture is none that is older than what another core shows.
bool ViewSession::is_shown_by_front() const {
    return has_drawn(active_) && (composition_.show != Show::One || pictures_[active_].request >= shown_request_);
}

std::optional<Picked> ViewSession::pick_at(double x, double y) {
    const auto view = render_system::view_pyramid(camera_.camera(), options_.width, options_.height);
    if (!probe_) probe_.emplace(system_.scene());
    return pick(system_.scene(), *probe_, view, x, y);
}

Result<std::string> ViewSession::save_values(const std::string& file) const {
    const CorePicture& front = pictures_[active_];
    if (!is_shown_by_front())
        return Status::error(
            StatusCode::wrong_order,
            fmt::format("nothing is saved: the {} core has not drawn this view yet", core_name(active_)));
    const auto bytes =
        encode_exr(linear_values(front.picture), {.samples = static_cast<uint32_t>(front.stats.samples)});
    if (!bytes.ok()) return bytes.status;
    if (Status status = write_file(file, *bytes); !status.ok()) return status;
    return coarse_note(front.picture.width, front.picture.height, options_.width, options_.height);
}

Result<std::string> ViewSession::save_camera(const std::string& file) const {
    const auto text = camera_text(camera_.camera(), options_.camera.file);
    if (!text.ok()) return text.status;
    if (Status status = write_file(file, *text); !status.ok()) return status;
    return std::string();
}

Result<std::string> ViewSession::save(const std::string& file) const {
    if (!has_shown_) return Status::error(StatusCode::wrong_order, "nothing is saved: no core has drawn anything yet");
    const auto bytes = encode_png(image_);
    if (!bytes.ok()) return bytes.status;
    if (Status status = write_file(file, *bytes); !status.ok()) return status;
    return coarse_note(image_.width, image_.height, options_.width, options_.height);
}

}  // namespace application
