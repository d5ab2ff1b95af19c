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
    std::vector<std::string> paths;  ///< scan's paths, or ids
    bool force = false;
    bool all = false;
    bool merge = false;
    bool strict = false;
    std::string write;  ///< map: the least score of a suggestion that is written into the map
    bool writes = false;
    bool assess = false;
    std::string owner, until, reason;
    std::vector<std::string> bench;       ///< report's bench files, FILE or FILE=MRAYS each
    std::vector<std::string> fail_under;  ///< report's bars, BLOCK=PERCENT each
    std::string from, to = "HEAD";        ///< effort's revisions
    std::string to_side;                  ///< sync's, as are those that follow
    bool apply = false, partial = false;
    std::string verify, verify_timeout;
    bool verifies = false;
    std::string inputs, ulps, seed, evidence, keep;  ///< difftest's
    std::vector<std::string> defines;                ///< difftest's, as is the next
    bool records = false;
    std::string since;  ///< history's and audit's
    std::string limit;  ///< audit's
    bool runs = false;  ///< audit's --run
    bool no_cache = false;
    bool stdio = false;  ///< lsp's
    bool spirv = false;  ///< ask glslang whether an edit reaches the compiled code
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
