// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/commands/compare_steps.h"

#include <fmt/format.h>

#include <filesystem>

#include "application/commands/command_steps.h"

namespace application {

using render_system::Status;

void warn_of(const std::string& name, const OddPixels& odd, Console& console) {
    for (const std::string& note : notes_of(name, odd)) console.warning(note);
}

BiasReport test_for_bias(const metrics::TileMeans& a, const metrics::TileMeans& b, double alpha, Console& console) {
    if (const size_t left_out = a.pixels_left_out() + b.pixels_left_out(); left_out > 0)
        console.warning(fmt::format("{} pixels of the pictures are NaN or infinite and were left out", left_out));
    BiasReport report;
    report.question.alpha = alpha;
    report.test = metrics::test_bias(a, b, report.question);
    report.grid = a.grid();
    report.batches_a = a.pictures();
    report.batches_b = b.pictures();
    report.at_least = !report.test.samples_needed;
    for (const metrics::TileMeans* means : {&a, &b}) {
        for (size_t channel = 0; channel < metrics::CHANNELS; ++channel) {
            for (const double value : means->values(means->grid().tiles(), channel))
                report.mean += value / static_cast<double>(2 * metrics::CHANNELS * means->pictures());
        }
    }
    return report;
}

Status write_bias_map(const Options& options, const BiasReport& report) {
    return write_png(bias_map(report), std::filesystem::path(options.output) / BIAS_PICTURE);
}

ExitCode deliver_bias(const Options& options, Json figures, const std::vector<Figures>& rows, const BiasReport& report,
                      Console& console) {
    figures["bias"] = bias_json(report);
    console.result(options.format == Format::json ? json_text(figures) : figures_text(rows) + bias_text(report));
    const bool differ = report.test.verdict == metrics::BiasVerdict::differ;
    return !differ && passes(rows, options.limit_ssim) ? DONE : ANSWER_NO;
}

}  // namespace application
