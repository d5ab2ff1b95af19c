// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "application/picture.h"
#include "application/stats_report.h"
#include "render_system/status.h"

namespace application {

/// A picture in both of its forms: what a PNG of it holds, and its light.
struct BothForms {
    Channels<uint8_t> levels;
    Channels<float> linear;
};

BothForms both_forms(const Picture& picture);

/// How far two pictures are apart.
struct Figures {
    std::optional<uint32_t> spp;  ///< none: image files, of which nobody knows
    double rmse = 0.0;
    std::optional<double> ssim;
    std::optional<double> psnr;
    std::optional<double> rmse_linear;  ///< over the pixels that are finite in both; none: there are none
    double pixels_off = 0.0;
    double identical_pixels = 0.0;
};

/// Both have the same size.
Figures compare_pictures(std::optional<uint32_t> spp, const BothForms& a, const BothForms& b);

/// The array `results`, and the table.
Json figures_json(const std::vector<Figures>& rows);
std::string figures_text(const std::vector<Figures>& rows);

/// Whether every SSIM reaches the limit, if there is one.
bool passes(const std::vector<Figures>& rows, const std::optional<double>& limit_ssim);

render_system::Status write_png(const Channels<uint8_t>& image, const std::filesystem::path& file);

/// The difference of two pictures as `compare` shows it: one level off is invisible, sixteen are not.
Channels<uint8_t> shown_difference(const Channels<uint8_t>& a, const Channels<uint8_t>& b);

}  // namespace application
