// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "application/options.h"
#include "application/scene_setup.h"
#include "application/view/composition.h"
#include "application/view/core_worker.h"
#include "application/view/kernel_reload.h"
#include "application/view/module_reload.h"
#include "application/view/picking.h"
#include "application/view/view_camera.h"
#include "application/view/view_log.h"
#include "render_system/core_registry.h"
#include "render_system/render_system.h"

namespace application {

/// All of the window but the window: one host scene, the cores that draw it, the camera, and what is shown of them.
class ViewSession {
public:
    ViewSession(const Options& options, SceneSetup setup, ViewLog& log);

    /// The camera, for a person who moves it; `kind` is for the log. What is drawn begins anew.
    template <class Move>
    void move(const char* kind, Move&& move) {
        move(camera_);
        followed_.reset();
        note_input(kind);
        begin();
    }
    void frame_all();
    /// The next camera of the file, and behind the last one the view that was begun with.
    void next_camera();
    /// The other core; the picture of the one before goes on being shown until the first of this one is there.
    void switch_core();

    /// Whether there is something to play, and for how long.
    bool is_animated() const { return system_.scene().is_animated(); }
    double duration() const { return system_.scene().duration(); }
    double seconds() const { return seconds_; }
    bool is_playing() const { return is_playing_; }
    void play_or_pause();
    /// Shows that moment, as a person who goes through the animation by hand; ends playing.
    void scrub(double seconds);
    /// While it plays: on to the moment that `elapsed` seconds of the clock bring, from the beginning again behind the
    /// end; not before all that is shown has been drawn at the moment before.
    void play_on(double elapsed);

    void set_show(Show show);
    void set_split(float split);
    void set_gain(int gain);
    /// What takes noise out of what is drawn; it begins anew.
    void set_filter(FilterMode filter);
    FilterMode filter() const { return filter_; }
    const Composition& composition() const { return composition_; }

    /// Takes what the cores have drawn; true where the picture shown is another one now.
    bool update();
    const Channels<uint8_t>& image() const { return image_; }
    /// True while no pixels have answered the last input.
    bool is_waiting() const { return !is_answered_; }

    /// What stands at a place of the picture, by shares of its sides.
    std::optional<Picked> pick_at(double x, double y);

    /// Each writes a file, and answers what is to be said of it beside its name: the picture that is shown as it is, as
    /// PNG; the linear values of the core in front, as EXR; the camera, as a file for --camera. Fails as write_file
    /// does, and with wrong_order where nothing is shown or the core in front has not drawn what is.
    render_system::Result<std::string> save(const std::string& file) const;
    render_system::Result<std::string> save_values(const std::string& file) const;
    render_system::Result<std::string> save_camera(const std::string& file) const;

    size_t core_count() const { return workers_.size(); }
    size_t active() const { return active_; }
    const std::string& core_name(size_t core) const { return workers_[core]->id(); }
    const CorePicture& picture_of(size_t core) const { return pictures_[core]; }
    /// Why a core cannot draw; "" as long as it can.
    const std::string& problem_of(size_t core) const { return problems_[core]; }
    /// Why its pictures do not go through the filter that was asked for; empty where they do.
    const std::string& unfiltered_of(size_t core) const { return unfiltered_[core]; }
    /// True where no core can draw.
    bool is_stuck() const;

    /// Takes what became of kernels that were saved, and of modules that were written; false where nothing was.
    bool take_news();
    /// Why the kernels that were saved or the module that was written do not run; "" where they do.
    const std::string& reload_error() const;

private:
    render_system::Result<OpenedCore> open_core(const std::string& id);
    render_system::Result<std::unique_ptr<render_system::CoreAPI>> open_bare_core(const std::string& id);
    void show_moment(double seconds);
    void note_input(const char* kind);
    void await(size_t core, double since_ms);
    void note_kernels(const KernelNews& news);
    void note_module(size_t core, const CoreWorker::Reopened& news);
    void watch_files();
    void begin();
    void compose();
    bool has_drawn(size_t core) const { return pictures_[core].request > 0; }
    bool is_shown_by_front() const;
    void note_unfiltered(size_t core);
    bool is_needed(size_t core) const { return core == active_ || composition_.show != Show::One; }

    const Options& options_;
    ViewLog& log_;
    std::mutex scene_mutex_;
    render_system::RenderSystem system_;
    render_system::CoreRegistry registry_;
    std::optional<render_system::RayProbe> probe_;  // none after something moved
    render_system::Box bounds_;
    std::optional<uint32_t> followed_;  ///< the scene's camera that is shown, until a person moves
    double seconds_ = 0.0;
    bool is_playing_ = false;
    ViewCamera first_camera_, camera_;
    size_t next_camera_ = 0;
    std::vector<CorePicture> pictures_;
    std::vector<std::string> problems_, unfiltered_;
    size_t active_ = 0;
    Composition composition_;
    FilterMode filter_;
    Channels<uint8_t> image_;
    uint64_t request_ = 0;
    double asked_at_ms_ = 0.0;    ///< when the first input came that no pixels have answered
    uint64_t asked_request_ = 0;  ///< the first that answers it
    uint64_t shown_request_ = 0;  ///< of the picture of one core that is shown
    size_t awaited_ = 0;          ///< the core whose pixels answer it
    bool is_answered_ = false;
    bool is_stale_ = false;  ///< what is shown is to be made anew
    bool has_shown_ = false;
    std::string kernel_error_;
    std::vector<std::string> module_errors_;
    std::vector<std::unique_ptr<CoreWorker>> workers_;  // they end before what they draw
    std::unique_ptr<KernelReload> kernel_reload_;       // and these before them
    std::vector<std::unique_ptr<ModuleReload>> module_reloads_;
};

}  // namespace application
