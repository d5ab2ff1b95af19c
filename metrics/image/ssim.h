// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "metrics/image/image_view.h"

namespace metrics {

/// Structural similarity after Wang, Bovik, Sheikh, Simoncelli: "Image Quality Assessment: From Error Visibility to
/// Structural Similarity", IEEE TIP 13(4), 2004, equation 13 with K1 = 0.01, K2 = 0.03, L = 255. Gaussian window of
/// 11 x 11 with sigma 1.5, population covariance, mean over the windows that lie wholly inside the image (borders of 5
/// cropped), then over the three channels. 1 for identical images. None where a side is below 11 pixels.
std::optional<double> ssim(const ImageView8& a, const ImageView8& b);

}  // namespace metrics
