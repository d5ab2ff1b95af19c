// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "application/options.h"

namespace CLI {
class App;
}

// Which options each subcommand takes. The values land in `options`, which has to outlive the parsing.

namespace application {

/// Options that come before the subcommand or after it.
void declare_common(CLI::App& app, Options& options);

void declare_render(CLI::App& app, Options& options);
void declare_compare(CLI::App& app, Options& options);
void declare_merge(CLI::App& app, Options& options);
void declare_bench(CLI::App& app, Options& options);
void declare_view(CLI::App& app, Options& options);
void declare_info(CLI::App& app, Options& options);

}  // namespace application
