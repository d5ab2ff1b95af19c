// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/null_core.h"

#include <algorithm>

#include "render_system/core_checks.h"

namespace render_system {

namespace {

class NullCore final : public CoreAPI {
public:
    CoreStats GetCoreStats() const override { return stats_; }

    Status Init(const CoreOptions&) override {
        if (Status status = contract_.check_init(); !status.ok()) return status;
        contract_.accept_init();
        stats_.core = "null";
        stats_.device = "none";
        stats_.threads = 1;
        return Status::success();
    }

    Status SetTarget(const CoreTarget& target) override {
        if (Status status = contract_.check_target(target); !status.ok()) return status;
        if (target.width != target_.width || target.height != target_.height) restart();
        target_ = target;
        contract_.accept_target();
        return Status::success();
    }

    Status Setting(const CoreSettings& settings) override { return contract_.check_settings(settings); }

    Status SetTextures(std::span<const CoreTexture> textures) override {
        if (Status status = contract_.check_textures(textures); !status.ok()) return status;
        contract_.accept_textures(textures);
        return Status::success();
    }

    Status SetMaterials(uint32_t first, std::span<const CoreMaterial> materials) override {
        if (Status status = contract_.check_materials(first, materials); !status.ok()) return status;
        contract_.accept_materials(first, materials);
        return Status::success();
    }

    Status SetLights(const CoreLights& lights) override {
        if (Status status = contract_.check_lights(lights); !status.ok()) return status;
        contract_.accept_lights(lights);
        return Status::success();
    }

    Status SetSkyData(const CoreSky& sky) override { return contract_.check_sky(sky); }

    Status SetGeometry(uint32_t mesh, const CoreMesh& data) override {
        if (Status status = contract_.check_geometry(mesh, data); !status.ok()) return status;
        contract_.accept_geometry(mesh, data);
        return Status::success();
    }

    Status SetInstance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) override {
        if (Status status = contract_.check_instance(instance, mesh, transform); !status.ok()) return status;
        contract_.accept_instance(instance, mesh, transform);
        return Status::success();
    }

    Status Render(const ViewPyramid& view, Convergence convergence, uint32_t samples) override {
        if (Status status = contract_.check_render(view, samples); !status.ok()) return status;
        if (convergence == Convergence::Restart) restart();
        stats_.triangles = contract_.triangles();
        stats_.samples += samples;
        stats_.primary_rays += static_cast<uint64_t>(samples) * target_.pixels.size();
        std::fill(target_.pixels.begin(), target_.pixels.end(), glm::vec4(0.0f, 0.0f, 0.0f, 1.0f));
        return Status::success();
    }

    void Shutdown() override {
        contract_.accept_shutdown();
        target_ = {};
    }

private:
    void restart() {
        stats_.samples = 0;
        stats_.primary_rays = 0;
    }

    CoreContract contract_;
    CoreTarget target_;
    CoreStats stats_;
};

}  // namespace

std::unique_ptr<CoreAPI> create_null_core() { return std::make_unique<NullCore>(); }

}  // namespace render_system
