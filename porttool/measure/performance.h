// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace porttool {

/// One platform, as `pathtracer bench --format json` measured it. Rates are in millions of rays per second.
struct PlatformSpeed {
    std::string name;             ///< core and device
    double achieved = 0;          ///< all rays over wall time
    std::optional<double> limit;  ///< what the platform can do: the file's Embree limit, or the user's word
    std::optional<double> efficiency() const;
};

/// How much of each platform's speed the program reaches.
struct Performance {
    std::vector<PlatformSpeed> platforms;
    /// Pennycook's harmonic mean; none where a limit is unknown, or without platforms.
    std::optional<double> portability() const;
};

/// A platform, or the error with its remedy.
struct ReadSpeed {
    PlatformSpeed platform;
    std::string error;
};

/// Reads the text of a bench file. `limit` overrules the file's own.
ReadSpeed read_speed(const std::string& path, const std::string& text, std::optional<double> limit);

}  // namespace porttool
