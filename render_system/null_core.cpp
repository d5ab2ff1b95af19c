// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/null_core.h"

#include <algorithm>

#include "render_system/checked_core.h"

namespace render_system {

namespace {

class NullCore final : public CheckedCore {
public:
    NullCore() : CheckedCore("null") {}

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

    Status render(const ViewPyramid&, uint32_t samples, CallOff&) override {
        stats().primary_rays += uint64_t{samples} * target().pixels.size();
        std::fill(target().pixels.begin(), target().pixels.end(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
        return Status::success();
    }

    Status filter(const ViewPyramid&, const CoreFilter& filter, CallOff&) override {
        std::copy(filter.means.begin(), filter.means.end(), filter.filtered.begin());
        return Status::success();
    }

    void close() override {}
    uint64_t host_bytes() const override { return 0; }
};

}  // namespace

std::unique_ptr<CoreAPI> create_null_core() { return std::make_unique<NullCore>(); }

}  // namespace render_system
