// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "application/options.h"
#include "application/picture.h"
#include "application/view/opened_core.h"
#include "render_system/core_api.h"
#include "render_system/hot_kernels.h"
#include "render_system/pixel_sum.h"

namespace application {

/// What a core has drawn so far of a view.
struct CorePicture {
    Picture picture{1, 1};
    render_system::CoreStats stats;
    render_system::ViewPyramid view;
    uint64_t request = 0;  ///< which one it answers
    bool coarse = false;   ///< a first pass at a part of the size
    double pass_ms = 0.0;  ///< wall time of the last pass
    double mrays_per_s = 0.0;
    std::string unfiltered;  ///< why it did not go through the filter that was asked for; empty where it did
};

/// One core in a thread of its own: it draws the view asked for last, sample after sample; where one takes long, a
/// coarse pass comes first. The next request calls the others off, and as a core may have no ear for that while it is
/// at work, they are taken part by part, so that it never waits for a whole one.
class CoreWorker {
public:
    /// Opens the core and gives it the scene; called once, in the worker's thread, when the core is first needed.
    using Open = std::function<render_system::Result<OpenedCore>()>;

    CoreWorker(std::string id, Open open, const render_system::CoreSettings& settings, uint32_t most_samples);
    ~CoreWorker();
    CoreWorker(const CoreWorker&) = delete;
    CoreWorker& operator=(const CoreWorker&) = delete;

    const std::string& id() const { return id_; }

    /// From here on it draws this view, at this moment of what moves, from the first sample on. With a filter only
    /// pictures that went through it are shown: the first ones, then those of 2, 4, 8 samples and so on.
    void show(const render_system::ViewPyramid& view, double seconds, uint32_t width, uint32_t height, uint64_t request,
              FilterMode filter);
    /// While it rests it draws nothing, and keeps what it has.
    void rest();

    /// Takes what was drawn since the last call; false where nothing was.
    bool take(CorePicture& out);
    /// Why the core cannot draw; success as long as it can.
    render_system::Status status();
    /// Tries once more what failed.
    void retry();

    /// False until it was first asked to show something: only then the core is opened.
    bool was_needed();

    /// Has the core compile its kernels again (render_system/hot_kernels.h); may be called from another thread. None
    /// where it has no such kernels or is not open yet.
    std::optional<render_system::Result<render_system::RecompiledKernels>> compile_again();

    /// Opens the core anew, whose module became another one; may be called from another thread. Until the new core has
    /// the scene, and where it cannot be opened, that which is there goes on; so both are in memory for a moment.
    void reopen(std::chrono::steady_clock::time_point written_at);
    /// What came of it.
    struct Reopened {
        render_system::Status status;
        double open_ms = 0.0;
        std::chrono::steady_clock::time_point written_at;
    };
    std::optional<Reopened> take_reopened();

private:
    struct Request {
        render_system::ViewPyramid view;
        double seconds = 0.0;
        uint32_t width = 0, height = 0;
        uint64_t number = 0;
        FilterMode filter = FilterMode::none;
    };
    void run();
    bool open_anew();
    void take_over(OpenedCore core);
    render_system::Status draw(const Request& request, bool fresh);
    render_system::Status draw_coarsely(const Request& request);
    render_system::Status take_samples(const Request& request);
    render_system::Status take_sample_in_parts(const Request& request);
    render_system::Status point_at(const Request& request, uint32_t divisor, std::function<bool()> is_called_off);
    std::function<bool()> away_from(const Request& request);
    uint32_t first_sample(const Request& request) const;
    double first_picture_ms(const Request& request) const;
    render_system::Status filter(const Request& request, Picture& picture, uint32_t samples, bool first);
    void note_noise(const Picture& mean);
    std::vector<float> variances() const;
    bool is_to_be_shown(const Request& request) const;
    bool waits_for_more(const Request& request);
    bool ends();
    bool is_called_away(uint64_t request);
    render_system::Status called_away(const render_system::Status& status);
    render_system::Status show_drawn(const Request& request, Picture picture, const render_system::CoreStats& taken,
                                     bool coarse, double took_ms);

    const std::string id_;
    const Open open_;
    const render_system::CoreSettings settings_;
    const uint32_t most_samples_;

    std::mutex mutex_;
    std::condition_variable wake_;
    Request wanted_;  // guarded by the mutex, as are those that follow
    bool runs_ = false, ends_ = false, has_news_ = false;
    CorePicture drawn_;
    render_system::Status status_ = render_system::Status::success();
    bool reopens_ = false;
    std::chrono::steady_clock::time_point written_at_;
    std::optional<Reopened> reopened_;

    std::mutex kernels_mutex_;
    render_system::HotKernels* hot_kernels_ = nullptr;  // guarded by that mutex, and so is the core's end

    // Of the thread alone.
    OpenedCore core_;
    std::unique_ptr<Picture> target_;
    uint32_t samples_ = 0;    // of the request that is drawn
    double sample_ms_ = 1e3;  // of one sample of the whole picture; until one was taken, a guess
    double filter_ms_ = 0.0;  // of filtering it; 0 before it was
    std::string unfiltered_;  // why it is not
    bool in_parts_ = false;
    bool was_coarse_ = false;              // what is shown of the request that is drawn
    std::vector<glm::vec4> sample_, sum_;  // in parts: the sample that is being taken, and those that are whole
    std::vector<render_system::PixelSum> part_;
    // Of the luminance of the samples of the request that is drawn, which come in batches: their sums and, weighted,
    // the squares of the batches' means.
    std::vector<double> sums_, squares_;
    uint32_t batches_ = 0, noted_ = 0;  // and how many samples are in them
    std::thread thread_;
};

}  // namespace application
