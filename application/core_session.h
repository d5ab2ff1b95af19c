// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "application/console.h"
#include "application/options.h"
#include "application/picture.h"
#include "application/sampling/interrupt.h"
#include "application/sampling/sample_sums.h"
#include "application/sampling/scene_digest.h"
#include "application/scene_setup.h"
#include "render_system/core_choice.h"
#include "render_system/embree_probe.h"
#include "render_system/render_system.h"

namespace application {

/// One scene, one view, one picture size; the cores come and go.
class CoreSession {
public:
    CoreSession(const Options& options, SceneSetup setup, Console& console);

    /// Takes the first of the cores `ids` that can render the scene, and with it the first sample of `picture`, which
    /// has to stay where it is until the next start.
    render_system::Result<render_system::CoreChoice> start(const std::vector<std::string>& ids, Picture& picture);

    /// The seed from the next start on; without it that of the options.
    void set_seed(uint32_t seed) { seed_ = seed; }

    /// Begins the picture anew with another seed and renders that many samples in one call.
    render_system::Status restart(uint32_t seed, uint32_t samples);

    /// Renders on until the picture has `samples` samples in all; the bar moves from `samples_before` up. Where a bar
    /// is shown or a signal heard, samples come in portions of about a quarter of a second, which changes no bit of the
    /// picture.
    render_system::Status render_up_to(uint32_t samples) { return render_up_to(samples, stats().core); }
    render_system::Status render_up_to(uint32_t samples, const std::string& label);

    /// From then on render_up_to ends early, and with success, where a signal came.
    void stop_on(const KeptInterrupt* interrupt) { interrupt_ = interrupt; }

    /// Brings an animated scene to `seconds`, and the view with it where that is a camera of the scene.
    render_system::Status show(double seconds);

    /// From the next start on samples go into `sums` in place of the picture; `first_sample` is the index of the first.
    /// The sums have to stay where they are.
    void sum_into(SampleSums* sums, uint32_t first_sample);

    /// Nothing will be edited, and there is one start: what only more of these would need is given back.
    void stand_still();

    /// From the next start on that takes a sample of one pixel alone, to see that the core can do it.
    void only_try() { only_tries_ = true; }

    /// Samples [first_sample, first_sample + samples) of the pixels [first_pixel, first_pixel + sums.size()), into sums
    /// and, unless empty, squares.
    render_system::Status render_part(std::span<render_system::PixelSum> sums, std::span<double> squares,
                                      uint32_t first_pixel, uint32_t first_sample, uint32_t samples);

    uint32_t width() const { return options_.width; }
    uint32_t height() const { return options_.height; }

    /// The next samples are those from `sample` on, whatever came before.
    render_system::Status go_on_from(uint32_t sample);

    /// From the next start on `watch` is shown what the core's kernels do.
    void set_watch(render_system::PathWatch* watch) { watch_ = watch; }

    std::vector<render_system::KernelText> kernel_texts() { return system_.core().GetKernelTexts(); }
    const render_system::HostScene& scene() const { return system_.scene(); }
    /// Its scene_digest, which is known also where the scene has been given back.
    std::string scene_content() const { return still_ ? content_ : scene_digest(scene()); }
    const render_system::ViewPyramid& view() const { return view_; }

    /// `samples` samples more, or from the first again, in one call of the core.
    render_system::Status render(render_system::Convergence convergence, uint32_t samples);

    /// Takes noise out of the picture of those samples, in place. `variances` of its luminance may be empty. Where it
    /// is called off the picture stays as it is.
    render_system::Status filter(Picture& picture, std::span<const float> variances, SampleRange samples,
                                 std::function<bool()> is_called_off,
                                 render_system::FilterHistory history = render_system::FilterHistory::none);

    /// What filters with a history have left of frames so far.
    render_system::Result<render_system::CoreHistory> history() { return system_.core().GetHistory(); }

    /// The next of them goes on from there: the scene as the core has it is that of the frame filtered last.
    render_system::Status go_on_with(const render_system::CoreHistory& history) {
        return system_.core().SetHistory(view_, history);
    }

    /// Brings the core in step with the scene without a sample.
    render_system::Status synchronize() { return system_.synchronize(); }

    render_system::CoreStats stats() { return system_.core().GetCoreStats(); }

    /// Embree's part in it; zeros where the core is not the target core.
    render_system::EmbreeFigures embree_figures();

    /// From the next call of render on, Embree alone traces the same rays once more. False where the core has none.
    bool measure_embree_limit();

private:
    render_system::CoreSettings settings() const;

    const Options& options_;
    Console& console_;
    render_system::RenderSystem system_;
    std::optional<uint32_t> followed_;
    render_system::ViewPyramid view_;
    render_system::PathWatch* watch_ = nullptr;
    uint32_t seed_;
    SampleSums* sums_ = nullptr;
    const KeptInterrupt* interrupt_ = nullptr;
    uint32_t first_sample_ = 0;
    bool restart_ = false;  // with the next samples
    bool only_tries_ = false;
    bool still_ = false;
    std::string content_;          // of a scene that stands still
    std::span<glm::vec4> pixels_;  // of the target
};

/// What the options ask of any core.
render_system::CoreSettings core_settings(const Options& options, uint32_t seed);

/// A failed call as one line for the user, with the option that helps; `other_core`: --core may name another.
std::string explain(const render_system::Status& status, bool other_core = true);

}  // namespace application
