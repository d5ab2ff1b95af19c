// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/core_worker.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "render_system/checked_core.h"

namespace core_worker_test {
namespace {

using application::CorePicture;
using application::CoreWorker;
using application::FilterMode;
using application::OpenedCore;
using namespace render_system;
using Clock = std::chrono::steady_clock;

constexpr uint32_t kWidth = 64, kHeight = 36;
/// A core whose samples of more pixels than these take longer than anybody waits, unless they are called off.
constexpr size_t kQuickPixels = 10;
constexpr auto kForever = std::chrono::seconds(60);
/// What the others take: of the whole picture that would be 3.5 s.
constexpr auto kQuick = std::chrono::milliseconds(12);

/// What a test keeps hold of.
struct Seen {
    std::atomic<int> whole = 0;   ///< samples of the whole picture, or of a part of it, that were begun
    std::atomic<int> coarse = 0;  ///< of fewer pixels, but too many
};

class SlowCore final : public CheckedCore {
public:
    explicit SlowCore(Seen& seen) : CheckedCore("slow"), seen_(seen) {}

private:
    Result<std::string> open() override { return std::string("none"); }
    void resize(uint32_t, uint32_t) override {}
    void set_textures(std::span<const CoreTexture>) override {}
    void set_materials(uint32_t, std::span<const CoreMaterial>) override {}
    void set_lights(const CoreLights&) override {}
    void set_sky(const CoreSky&) override {}
    void set_mesh(uint32_t, const CoreMesh&) override {}
    void set_instance(uint32_t, uint32_t, const CoreTransform&) override {}
    Status prepare() override { return Status::success(); }
    Status render(const ViewPyramid&, uint32_t, CallOff& call_off) override {
        const auto start = Clock::now();
        const bool is_whole = target().width == kWidth;
        if (is_whole) ++seen_.whole;
        if (!is_whole && target().pixels.size() > kQuickPixels) ++seen_.coarse;
        std::this_thread::sleep_for(kQuick);
        while (target().pixels.size() > kQuickPixels && Clock::now() < start + kForever && !call_off.came())
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        stats().total_ms += std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        return call_off.status();
    }
    Status filter(const ViewPyramid&, const CoreFilter&, CallOff&) override { return Status::success(); }
    void close() override {}
    uint64_t host_bytes() const override { return 0; }

    Seen& seen_;
};

/// The next picture; false where none comes for a long time.
bool take_picture(CoreWorker& worker, CorePicture& picture) {
    const auto end = Clock::now() + kForever / 2;
    while (!worker.take(picture)) {
        if (Clock::now() > end) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
}

TEST(CoreWorker, ANewViewWaitsForNoSampleAndForNoCoarsePictureThatTakesLong) {
    Seen seen;
    const auto open = [&]() -> Result<OpenedCore> {
        auto core = std::make_unique<SlowCore>(seen);
        if (Status status = core->Init({.threads = 1}); !status.ok()) return status;
        return OpenedCore{std::move(core)};
    };
    CoreWorker worker("slow", open, {}, 16);
    EXPECT_FALSE(worker.was_needed());
    CorePicture picture;
    for (uint64_t request = 1; request <= 3; ++request) {
        const int begun = seen.whole;
        worker.show({}, 0.0, kWidth, kHeight, request, FilterMode::none);
        EXPECT_TRUE(worker.was_needed());
        ASSERT_TRUE(take_picture(worker, picture)) << request;
        EXPECT_EQ(picture.request, request);
        EXPECT_TRUE(picture.coarse);
        EXPECT_LE(picture.picture.pixels.size(), kQuickPixels);
        // Then the whole picture is begun, which the next request has to call off.
        const auto end = Clock::now() + kForever / 2;
        while (seen.whole == begun && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        ASSERT_GT(seen.whole, begun) << request;
    }
    // What was too much of a picture the first time is not tried again, as the one that was there says what it takes.
    EXPECT_EQ(seen.coarse, 1);
    EXPECT_TRUE(worker.status().ok()) << worker.status().message;
}

}  // namespace
}  // namespace core_worker_test
