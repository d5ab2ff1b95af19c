// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/judge/check_project.h"

namespace porttool {

inline constexpr const char* kVersionNumber = "0.1.0";

/// What the command line asked for.
struct Options : CheckChoice {
    std::string command;  ///< "scan", "map", ...; empty if there is only something to print
    std::string format = "text";
    std::string output;
    std::string color = "auto";
    bool quiet = false;
    bool verbose = false;
    std::vector<std::string> paths;       ///< scan's paths, or ids
    bool force = false;                   ///< of init, accept and sync
    bool all = false;                     ///< of accept and sync
    bool merge = false;                   ///< accept's
    bool strict = false;                  ///< check's
    std::string write;                    ///< map's: the least score of a suggestion that is written into the map
    bool writes = false;                  ///< map's: whether --write is there
    bool assess = false;                  ///< init's
    std::string owner, until, reason;     ///< owner and until are defer's; reason is of accept, defer and ignore
    std::vector<std::string> bench;       ///< report's bench files, FILE or FILE=MRAYS each
    std::vector<std::string> fail_under;  ///< report's bars, BLOCK=PERCENT each
    std::string from, to = "HEAD";        ///< effort's revisions
    std::string to_side;                  ///< sync's --to
    bool apply = false, partial = false;  ///< sync's
    std::string verify, verify_timeout;   ///< sync's
    bool verifies = false;                ///< sync's: whether --verify is there
    std::string inputs, ulps, seed, evidence, keep;  ///< difftest's
    std::vector<std::string> defines;                ///< difftest's
    bool records = false;                            ///< difftest's --record
    std::string since;                               ///< of history and audit
    std::string limit;                               ///< audit's
    bool runs = false;                               ///< audit's --run
    bool no_cache = false;                           ///< of check and history
    bool stdio = false;                              ///< lsp's
    bool spirv = false;                              ///< check's: ask glslang whether an edit reaches the compiled code
};

/// The options, or what to print and the exit code: 0 for --help and --version (on stdout), 2 for a usage error.
struct ParsedOptions {
    Options options;
    bool done = false;
    int exit_code = 0;
    std::string out;
    std::string err;
};

ParsedOptions parse_options(int argc, const char* const* argv);

}  // namespace porttool
