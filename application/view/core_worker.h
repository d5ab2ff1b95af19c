// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "application/picture.h"
#include "render_system/core_api.h"
#include "render_system/hot_kernels.h"

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
};

/// One core in a thread of its own: it draws the view asked for last, sample after sample, a coarse pass first where a
/// whole one takes long. A pass that has begun is finished.
class CoreWorker {
public:
    /// Opens the core and gives it the scene; called once, in the worker's thread, when the core is first needed.
    using Open = std::function<render_system::Result<std::unique_ptr<render_system::CoreAPI>>()>;

    CoreWorker(std::string id, Open open, uint32_t most_samples);
    ~CoreWorker();
    CoreWorker(const CoreWorker&) = delete;
    CoreWorker& operator=(const CoreWorker&) = delete;

    const std::string& id() const { return id_; }

    /// From here on it draws this view, from the first sample on.
    void show(const render_system::ViewPyramid& view, uint32_t width, uint32_t height, uint64_t request);
    /// While it rests it draws nothing, and keeps what it has.
    void rest();

    /// Takes what was drawn since the last call; false where nothing was.
    bool take(CorePicture& out);
    /// Why the core cannot draw; success as long as it can.
    render_system::Status status();
    /// Tries once more what failed.
    void retry();

    /// The kernels that can be compiled again, while the worker lives; null where the core has none or is not open yet.
    render_system::HotKernels* hot_kernels();

private:
    struct Request {
        render_system::ViewPyramid view;
        uint32_t width = 0, height = 0;
        uint64_t number = 0;
    };
    void run();
    render_system::Status draw(const Request& request, bool fresh);
    render_system::Status pass(const Request& request, uint32_t divisor, render_system::Convergence convergence,
                               uint32_t samples);

    const std::string id_;
    const Open open_;
    const uint32_t most_samples_;

    std::mutex mutex_;
    std::condition_variable wake_;
    Request wanted_;  // guarded by the mutex, as are those that follow
    bool runs_ = false, ends_ = false, has_news_ = false;
    CorePicture drawn_;
    render_system::Status status_ = render_system::Status::success();
    render_system::HotKernels* hot_kernels_ = nullptr;

    // Of the thread alone.
    std::unique_ptr<render_system::CoreAPI> core_;
    std::unique_ptr<Picture> target_;
    double sample_ms_ = 1e9;  // of a whole pass of one sample
    std::thread thread_;
};

}  // namespace application
