// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "metrics/image/image_view.h"

namespace metrics {

/// Root of the mean squared difference over all pixels and channels, in levels (0 to 255). 0 for empty images.
double rmse(const ImageView8& a, const ImageView8& b);

/// The same over linear radiance. Not finite where the images are not.
double rmse_linear(const ImageViewFloat& a, const ImageViewFloat& b);

/// Peak signal-to-noise ratio in dB for a peak of 255: 20 log10(255 / rmse). None for identical images, where it is
/// infinite.
std::optional<double> psnr(const ImageView8& a, const ImageView8& b);

/// Share (0 to 1) of the pixels with at least one channel off by more than one level.
double pixels_off(const ImageView8& a, const ImageView8& b);

/// Share (0 to 1) of the pixels whose three floats agree in every bit; so 0.0 and -0.0 differ, and a NaN equals
/// itself.
double identical_pixels(const ImageViewFloat& a, const ImageViewFloat& b);

}  // namespace metrics
