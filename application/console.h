// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

#include "application/options.h"

namespace application {

/// Whether escapes are written: `always` and `never` as asked for; else on a terminal, unless NO_COLOR says no
/// (https://no-color.org: set and not empty).
bool use_color(ColorMode mode, bool is_terminal, const char* no_color);

/// Where a command's words go: results to stdout, everything else to stderr.
class Console {
public:
    Console(const Options& options, bool color, bool is_terminal);

    void error(const std::string& message);    ///< always
    void warning(const std::string& message);  ///< unless --quiet
    void note(const std::string& message);     ///< unless --quiet
    void detail(const std::string& message);   ///< with --verbose

    /// On stdout, as it is.
    void result(const std::string& text);

    /// Whether a progress bar is wanted: on a terminal, or asked for; never with --quiet.
    bool shows_progress() const { return progress_; }

    /// Replaces the progress line; an empty text takes it away.
    void progress(const std::string& line);

private:
    void line(const char* color, const std::string& label, const std::string& message);

    bool quiet_;
    bool verbose_;
    bool color_;
    bool progress_;
    size_t progress_width_ = 0;
};

}  // namespace application
