// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/comparison/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "application/file_output.h"
#include "metrics/image/error.h"
#include "metrics/image/ssim.h"

namespace application {

using render_system::Status;

namespace {

Json or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

bool all_finite(const Channels<float>& image) {
    return std::all_of(image.rgb.begin(), image.rgb.end(), [](float value) { return std::isfinite(value); });
}

/// The RMSE of what is finite in both.
std::optional<double> rmse_of_finite(const Channels<float>& a, const Channels<float>& b) {
    if (all_finite(a) && all_finite(b)) return metrics::rmse_linear(a.view(), b.view());
    std::vector<float> kept_a, kept_b;
    for (size_t pixel = 0; pixel < a.rgb.size(); pixel += metrics::CHANNELS) {
        bool finite = true;
        for (size_t i = pixel; i < pixel + metrics::CHANNELS; ++i)
            finite = finite && std::isfinite(a.rgb[i]) && std::isfinite(b.rgb[i]);
        for (size_t i = pixel; finite && i < pixel + metrics::CHANNELS; ++i) {
            kept_a.push_back(a.rgb[i]);
            kept_b.push_back(b.rgb[i]);
        }
    }
    if (kept_a.empty()) return std::nullopt;
    const size_t pixels = kept_a.size() / metrics::CHANNELS;
    return metrics::rmse_linear({pixels, 1, kept_a}, {pixels, 1, kept_b});
}

}  // namespace

BothForms both_forms(const Picture& picture) { return {srgb_levels(picture), linear_values(picture)}; }

Figures compare_pictures(std::optional<uint32_t> spp, const BothForms& a, const BothForms& b) {
    return {.spp = spp,
            .rmse = metrics::rmse(a.levels.view(), b.levels.view()),
            .ssim = metrics::ssim(a.levels.view(), b.levels.view()),
            .psnr = metrics::psnr(a.levels.view(), b.levels.view()),
            .rmse_linear = rmse_of_finite(a.linear, b.linear),
            .pixels_off = metrics::pixels_off(a.levels.view(), b.levels.view()),
            .identical_pixels = metrics::identical_pixels(a.linear.view(), b.linear.view())};
}

Json figures_json(const std::vector<Figures>& rows) {
    Json results = Json::array();
    for (const Figures& row : rows) {
        results.push_back({{"spp", row.spp ? Json(*row.spp) : Json(nullptr)},
                           {"rmse", row.rmse},
                           {"ssim", or_null(row.ssim)},
                           {"psnr", or_null(row.psnr)},
                           {"rmse_linear", or_null(row.rmse_linear)},
                           {"pixels_off", row.pixels_off},
                           {"identical_pixels", row.identical_pixels}});
    }
    return results;
}

std::string figures_text(const std::vector<Figures>& rows) {
    std::string text = fmt::format("{:>6}  {:>10}  {:>10}  {:>8}  {:>11}  {:>10}  {:>9}\n", "spp", "RMSE", "SSIM",
                                   "PSNR", "RMSE linear", "pixels off", "identical");
    for (const Figures& row : rows) {
        const std::string spp = row.spp ? fmt::format("{}", *row.spp) : "-";
        const std::string ssim = row.ssim ? fmt::format("{:.7f}", *row.ssim) : "-";
        const std::string psnr = row.psnr ? fmt::format("{:.2f} dB", *row.psnr) : "-";
        const std::string linear = row.rmse_linear ? fmt::format("{:.3e}", *row.rmse_linear) : "-";
        text += fmt::format("{:>6}  {:>10.6f}  {:>10}  {:>8}  {:>11}  {:>10.6f}  {:>8.3f}%\n", spp, row.rmse, ssim,
                            psnr, linear, row.pixels_off, row.identical_pixels * 100.0);
    }
    return text;
}

bool passes(const std::vector<Figures>& rows, const std::optional<double>& limit_ssim) {
    return !limit_ssim || std::all_of(rows.begin(), rows.end(),
                                      [&](const Figures& row) { return row.ssim && *row.ssim >= *limit_ssim; });
}

Status write_png(const Channels<uint8_t>& image, const std::filesystem::path& file) {
    const auto bytes = encode_png(image);
    return bytes.ok() ? write_file(file, *bytes) : bytes.status;
}

Channels<uint8_t> shown_difference(const Channels<uint8_t>& a, const Channels<uint8_t>& b) {
    constexpr int kGain = 16;
    return difference_image(a, b, kGain);
}

}  // namespace application
