// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "application/locate/path_comparison.h"
#include "application/options.h"
#include "application/picture.h"
#include "application/stats_report.h"

// Where the cores part, for a program, for a person and as a picture.

namespace application {

/// What `compare --locate --format json` has under `locate`.
Json located_json(const PathDifferences& differences, const render_system::HostScene& scene, const Options& options);

/// The same for a person.
std::string located_text(const Json& located);

/// The picture in dark grey; where paths part in the colour of the kernel: generate magenta, extend red, shade yellow,
/// connect cyan, finalize white; ties blue.
Channels<uint8_t> located_image(const PathDifferences& differences, const Picture& picture);

/// What `check --evidence` reads: see docs/evidence.md. `texts`: of both cores; `comparison`: what compare prints, with
/// `locate`; `pictures`: as the file is to name them.
Json evidence_json(const Json& comparison, const Options& options, const std::vector<render_system::KernelText>& texts,
                   const std::vector<std::string>& pictures);

/// The print of a text as docs/evidence.md has it: 16 hexadecimal digits. That of porttool's Fingerprinter.
std::string text_fingerprint(const std::string& text);

}  // namespace application
