// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "application/bias/bias_report.h"
#include "application/comparison/figures.h"
#include "application/comparison/picture_file.h"
#include "application/console.h"
#include "application/exit_code.h"
#include "application/options.h"

// What the kinds of `compare` share, and those that take image files.

namespace application {

/// Says on stderr which pixels of the picture of that name are NaN or infinite, if any are.
void warn_of(const std::string& name, const OddPixels& odd, Console& console);

/// Tests two sets of pictures; says on stderr how many pixels were no numbers.
BiasReport test_for_bias(const metrics::TileMeans& a, const metrics::TileMeans& b, double alpha, Console& console);

constexpr const char* BIAS_PICTURE = "bias.png";

/// That picture, in the folder of `-o`.
render_system::Status write_bias_map(const Options& options, const BiasReport& report);

/// Prints the figures of the mean pictures and the verdict; the exit code is that of the verdict and of --limit-ssim.
ExitCode deliver_bias(const Options& options, Json figures, const std::vector<Figures>& rows, const BiasReport& report,
                      Console& console);

/// `compare A B`: two image files.
ExitCode compare_images(const Options& options, Console& console);

/// `compare --bias A... -- B...`: two sets of image files.
ExitCode compare_sets(const Options& options, Console& console);

}  // namespace application
