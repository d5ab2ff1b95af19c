// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <functional>
#include <thread>

#include "tests/render_system/core_contract_suite.h"

// What core_api.h promises of a filter's history that is taken from one core and given to another.

namespace render_system::testing {

template <class Core>
class CoreHistorySuite : public CoreContractSuite<Core> {
protected:
    using Base = CoreContractSuite<Core>;

    static ViewPyramid view_of(uint32_t frame) {
        ViewPyramid view = contract_view();
        for (glm::vec3* point : {&view.eye, &view.top_left, &view.top_right, &view.bottom_left})
            point->x += 0.03f * static_cast<float>(frame);
        return view;
    }

    /// As a fresh core has the scene of frame 0.
    void open_scene() {
        this->send(ContractScene());
        Base::expect_ok(this->core_->SetTarget(this->target()));
    }

    /// The wall stands still for two frames, then it moves and changes its shape.
    void pose(uint32_t frame) {
        if (frame < 2) return;
        CoreTransform transform;
        transform.rows[0].w = 0.05f * static_cast<float>(frame);
        Base::expect_ok(this->core_->SetInstance(0, 0, transform));
        ContractScene scene;
        scene.positions[2].y += 0.1f * static_cast<float>(frame);
        Base::expect_ok(this->core_->SetGeometry(0, scene.mesh()));
    }

    void pose_as_at_first() {
        Base::expect_ok(this->core_->SetInstance(0, 0, {}));
        Base::expect_ok(this->core_->SetGeometry(0, ContractScene().mesh()));
    }

    /// The wall's vertices moved by `shift`, then its instance turned about the view and moved.
    void place(const glm::vec3& shift, float angle, const glm::vec3& move) {
        ContractScene scene;
        for (glm::vec3& position : scene.positions) position += shift;
        Base::expect_ok(this->core_->SetGeometry(0, scene.mesh()));
        place_instance(angle, move);
    }

    void place_instance(float angle, const glm::vec3& move) {
        CoreTransform transform;
        transform.rows[0] = {std::cos(angle), -std::sin(angle), 0, move.x};
        transform.rows[1] = {std::sin(angle), std::cos(angle), 0, move.y};
        transform.rows[2].w = move.z;
        Base::expect_ok(this->core_->SetInstance(0, 0, transform));
    }

    /// Light of noise over frames in which `place_frame` has put the wall somewhere.
    std::vector<glm::vec4> last_of_frames(const std::function<void(uint32_t)>& place_frame) {
        this->core_ = Core::create();
        EXPECT_TRUE(this->opened());
        open_scene();
        std::vector<glm::vec4> last;
        for (uint32_t frame = 0; frame < 3; ++frame) {
            place_frame(frame);
            std::vector<glm::vec4> picture = frame_of_noise(frame);
            Base::expect_ok(this->core_->Filter(contract_view(),
                                                {.means = picture,
                                                 .variances = {},
                                                 .first_sample = frame,
                                                 .filtered = picture,
                                                 .history = frame == 0 ? FilterHistory::begin : FilterHistory::go_on}));
            last = picture;
        }
        return last;
    }

    static float farthest_apart(const std::vector<glm::vec4>& a, const std::vector<glm::vec4>& b) {
        float most = 0.0f;
        for (size_t i = 0; i < a.size(); ++i)
            for (int c = 0; c < 3; ++c) most = std::max(most, std::abs(a[i][c] - b[i][c]));
        return most;
    }

    std::vector<glm::vec4> frame_of_noise(uint32_t frame) {
        std::mt19937 random(frame);
        std::uniform_real_distribution<float> noise(0.0f, 1.0f);
        std::vector<glm::vec4> picture(this->pixels_.size());
        for (glm::vec4& pixel : picture) pixel = {noise(random), noise(random), noise(random), 1.0f};
        return picture;
    }

    Status filter(std::vector<glm::vec4>& picture, uint32_t frame, FilterHistory history,
                  std::function<bool()> is_called_off = {}) {
        return this->core_->Filter(view_of(frame / 2), {.means = picture,
                                                        .variances = {},
                                                        .first_sample = frame,
                                                        .filtered = picture,
                                                        .history = history,
                                                        .is_called_off = std::move(is_called_off)});
    }

    std::vector<glm::vec4> filtered(uint32_t frame, FilterHistory history) {
        std::vector<glm::vec4> picture = frame_of_noise(frame);
        Base::expect_ok(filter(picture, frame, history));
        return picture;
    }

    /// Filters a frame of noise, calls that off when it has asked `after` times, and holds what is left against what
    /// was before. False where it did not ask so often.
    bool calls_off(uint32_t frame, FilterHistory history, uint32_t after) {
        const std::vector<glm::vec4> noise = frame_of_noise(frame);
        std::vector<glm::vec4> picture = noise;
        std::atomic<uint32_t> asked = 0;
        const Status status = filter(picture, frame, history, [&] { return ++asked > after; });
        if (status.ok()) {
            EXPECT_LE(asked, after);
            finished_ = picture;
            return false;
        }
        EXPECT_EQ(status.code, StatusCode::called_off) << status.message;
        EXPECT_LE(asked, after + std::max(1u, std::thread::hardware_concurrency())) << "one of each thread at most";
        EXPECT_EQ(picture, noise);
        return true;
    }

    std::vector<glm::vec4> finished_;  // by calls_off
};

TYPED_TEST_SUITE_P(CoreHistorySuite);

/// Wherever a sequence is cut, another core goes on to the same bits.
TYPED_TEST_P(CoreHistorySuite, AnotherCoreGoesOnToTheSameBits) {
    if (!this->opened()) GTEST_SKIP() << "no device for this core";
    constexpr uint32_t kFrames = 4;
    this->open_scene();
    this->expect_refused(this->core_->SetHistory(this->view_of(0), {1, {1.0f}}));
    ASSERT_TRUE(this->core_->GetHistory().ok());
    EXPECT_EQ(this->core_->GetHistory()->frames, 0u);
    std::vector<std::vector<glm::vec4>> whole;
    std::vector<CoreHistory> histories;
    for (uint32_t frame = 0; frame < kFrames; ++frame) {
        this->pose(frame);
        whole.push_back(this->filtered(frame, frame == 0 ? FilterHistory::begin : FilterHistory::go_on));
        const auto history = this->core_->GetHistory();
        ASSERT_TRUE(history.ok()) << history.status.message;
        histories.push_back(*history);
        EXPECT_EQ(history->frames, frame + 1);
    }
    for (const uint32_t cut : {1u, 3u}) {  // before a frame that stands still, and on the move
        this->core_ = TypeParam::create();
        ASSERT_TRUE(this->opened());
        this->open_scene();
        this->pose(cut - 1);
        this->render();
        this->expect_ok(this->core_->SetHistory(this->view_of((cut - 1) / 2), histories[cut - 1]));
        EXPECT_EQ(this->core_->GetHistory()->planes, histories[cut - 1].planes);
        for (uint32_t frame = cut; frame < kFrames; ++frame) {
            this->pose(frame);
            EXPECT_EQ(this->filtered(frame, FilterHistory::go_on), whole[frame]) << cut << " " << frame;
        }
    }
}

/// What is not of this core and size is refused, and a history of no frames is none: then a sequence begins.
TYPED_TEST_P(CoreHistorySuite, AHistoryOfAnotherSizeIsRefused) {
    if (!this->opened()) GTEST_SKIP() << "no device for this core";
    EXPECT_EQ(this->core_->SetHistory(this->view_of(0), {}).code, StatusCode::wrong_order) << "there is no target yet";
    this->open_scene();
    const std::vector<glm::vec4> first = this->filtered(0, FilterHistory::begin);
    this->filtered(1, FilterHistory::go_on);
    CoreHistory history = *this->core_->GetHistory();
    history.planes.push_back(0.0f);
    this->expect_refused(this->core_->SetHistory(this->view_of(0), history));
    EXPECT_EQ(this->core_->GetHistory()->frames, 0u);
    EXPECT_EQ(this->filtered(0, FilterHistory::go_on), first);
    this->expect_ok(this->core_->SetHistory(this->view_of(0), {}));
    EXPECT_EQ(this->filtered(0, FilterHistory::go_on), first);
    this->core_->Shutdown();
    EXPECT_EQ(this->core_->GetHistory().status.code, StatusCode::wrong_order);
}

/// Wherever it is called off, the next filter goes on as if it had never been asked for.
TYPED_TEST_P(CoreHistorySuite, AFilterThatIsCalledOffLeavesWhatThereWas) {
    if (!this->opened()) GTEST_SKIP() << "no device for this core";
    this->open_scene();
    std::vector<std::vector<glm::vec4>> whole;
    for (uint32_t frame = 0; frame < 3; ++frame) {
        this->pose(frame);
        whole.push_back(this->filtered(frame, frame == 0 ? FilterHistory::begin : FilterHistory::go_on));
    }
    uint32_t times = 0;
    for (uint32_t after = 0; this->calls_off(2, FilterHistory::none, after); after = 2 * after + 1) ++times;
    EXPECT_GE(times, 1u);
    EXPECT_EQ(this->core_->GetHistory()->frames, 3u) << "that was none of it";
    EXPECT_TRUE(this->calls_off(0, FilterHistory::begin, times > 1 ? 1 : 0));
    EXPECT_EQ(this->core_->GetHistory()->frames, 0u);

    this->pose_as_at_first();
    EXPECT_EQ(this->filtered(0, FilterHistory::begin), whole[0]);
    EXPECT_EQ(this->filtered(1, FilterHistory::go_on), whole[1]);
    const CoreHistory history = *this->core_->GetHistory();
    this->pose(2);
    for (uint32_t after = 0; this->calls_off(2, FilterHistory::go_on, after); after = 2 * after + 1) {
        EXPECT_EQ(this->core_->GetHistory()->frames, history.frames);
        EXPECT_EQ(this->core_->GetHistory()->planes, history.planes) << after;
    }
    EXPECT_EQ(this->finished_, whole[2]) << "the one that was not called off";
}

/// A wall that its vertices carry is the wall that its instance carries: what was seen there is found again either way.
TYPED_TEST_P(CoreHistorySuite, VerticesThatMoveAreFollowedAsAnInstanceIs) {
    if (!this->opened()) GTEST_SKIP() << "no device for this core";
    const auto shift = [](uint32_t frame) { return 0.14f * static_cast<float>(frame); };
    const auto angle = [](uint32_t frame) { return 0.05f * static_cast<float>(frame); };
    const glm::vec3 move{-0.05f, 0.03f, 0.1f};
    const auto by_instance = this->last_of_frames([&](uint32_t frame) {
        const glm::vec3 turned{std::cos(angle(frame)) * shift(frame), std::sin(angle(frame)) * shift(frame), 0};
        this->place_instance(angle(frame), turned + move * static_cast<float>(frame));
    });
    const auto by_both = this->last_of_frames([&](uint32_t frame) {
        this->place({7, 7, 0}, 0, move);  // seen by nobody
        this->place({shift(frame), 0, 0}, angle(frame), move * static_cast<float>(frame));
    });
    const auto as_another = this->last_of_frames([&](uint32_t frame) {
        this->expect_ok(this->core_->SetGeometry(0, {}));  // which is not followed
        this->place({shift(frame), 0, 0}, angle(frame), move * static_cast<float>(frame));
    });
    if (by_instance == this->last_of_frames([](uint32_t) {})) return;  // a core that filters nothing
    EXPECT_LT(this->farthest_apart(by_both, by_instance), 1e-4f);
    EXPECT_GT(this->farthest_apart(as_another, by_instance), 1e-2f) << "or nothing was followed at all";
}

REGISTER_TYPED_TEST_SUITE_P(CoreHistorySuite, AnotherCoreGoesOnToTheSameBits, AHistoryOfAnotherSizeIsRefused,
                            AFilterThatIsCalledOffLeavesWhatThereWas, VerticesThatMoveAreFollowedAsAnInstanceIs);

}  // namespace render_system::testing
