// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "render_system/core_api.h"
#include "render_system/null_core.h"

namespace render_system::testing {

/// A null core that writes down the calls that reach it, and can be told to fail.
class CountingCore final : public CoreAPI {
public:
    /// What a test keeps hold of while the render system owns the core.
    struct Log {
        std::vector<std::string> calls;  ///< "SetMaterials 3+2": first and count; "SetInstance 4"
        Convergence last_convergence = Convergence::Converge;
        float total_weight = 0.0f;
        float sky_probability = 0.0f;
        Status init_status;
        Status geometry_status;
        Status render_status;
        CoreStats stats;
    };

    explicit CountingCore(std::shared_ptr<Log> log) : log_(std::move(log)) {}

    CoreStats GetCoreStats() const override { return log_->stats; }
    std::vector<KernelText> GetKernelTexts() const override { return {}; }
    Status SetWatch(PathWatch* watch) override { return null_->SetWatch(watch); }

    Status Init(const CoreOptions& options) override {
        note("Init");
        return log_->init_status.ok() ? null_->Init(options) : log_->init_status;
    }
    Status SetTarget(const CoreTarget& target) override {
        note("SetTarget");
        return null_->SetTarget(target);
    }
    Status Setting(const CoreSettings& settings) override {
        note("Setting");
        return null_->Setting(settings);
    }
    Status SetTextures(std::span<const CoreTexture> textures) override {
        note("SetTextures " + std::to_string(textures.size()));
        return null_->SetTextures(textures);
    }
    Status SetMaterials(uint32_t first, std::span<const CoreMaterial> materials) override {
        note("SetMaterials " + std::to_string(first) + "+" + std::to_string(materials.size()));
        return null_->SetMaterials(first, materials);
    }
    Status SetLights(const CoreLights& lights) override {
        note("SetLights " + std::to_string(lights.lights.size()));
        log_->total_weight = lights.total_weight;
        return null_->SetLights(lights);
    }
    Status SetSkyData(const CoreSky& sky) override {
        note("SetSkyData");
        log_->sky_probability = sky.light_probability;
        return null_->SetSkyData(sky);
    }
    Status SetGeometry(uint32_t mesh, const CoreMesh& data) override {
        note("SetGeometry " + std::to_string(mesh));
        return log_->geometry_status.ok() ? null_->SetGeometry(mesh, data) : log_->geometry_status;
    }
    Status SetInstance(uint32_t instance, uint32_t mesh, const CoreTransform& transform) override {
        note("SetInstance " + std::to_string(instance));
        return null_->SetInstance(instance, mesh, transform);
    }
    Status Render(const ViewPyramid& view, Convergence convergence, uint32_t samples) override {
        note("Render");
        log_->last_convergence = convergence;
        return log_->render_status.ok() ? null_->Render(view, convergence, samples) : log_->render_status;
    }
    Status Filter(const ViewPyramid& view, const CoreFilter& filter) override {
        note("Filter");
        return null_->Filter(view, filter);
    }
    Result<CoreHistory> GetHistory() override { return null_->GetHistory(); }
    Status SetHistory(const ViewPyramid& view, const CoreHistory& history) override {
        note("SetHistory");
        return null_->SetHistory(view, history);
    }
    void Shutdown() override { null_->Shutdown(); }

private:
    void note(std::string call) { log_->calls.push_back(std::move(call)); }

    std::shared_ptr<Log> log_;
    std::unique_ptr<CoreAPI> null_ = create_null_core();
};

}  // namespace render_system::testing
