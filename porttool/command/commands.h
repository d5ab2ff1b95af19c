// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/command/declare.h"
#include "porttool/command/options.h"
#include "porttool/read/cannot_do.h"
#include "porttool/read/workplace.h"

namespace porttool {

/// The outcome of a command: what goes to stdout or to `-o`, and the exit code.
struct Outcome {
    std::string text;
    int exit_code = 0;
    bool is_exact = false;     ///< the bytes of files, whatever their encoding: not made UTF-8
    std::string written = {};  ///< what is on disk by then, for who cannot be given the text: "portmap.lock is written"
};

/// What Outcome::written says of a command that records.
inline constexpr const char* kLockIsWritten = "portmap.lock is written";

// A file for each command has its options, and what carries it out; accept, defer and ignore share settle_command.cpp,
// with what review calls to take a pair out of the map.
void declare_scan(Declare& declare, Options& options);
Outcome run_scan(const Options& options, Workplace& place);
void declare_map(Declare& declare, Options& options);
Outcome run_map(const Options& options, Workplace& place);
void declare_init(Declare& declare, Options& options);
Outcome run_init(const Options& options, Workplace& place);
void declare_check(Declare& declare, Options& options);
Outcome run_check(const Options& options, Workplace& place);
void declare_accept(Declare& declare, Options& options);
Outcome run_accept(const Options& options, Workplace& place);
void declare_defer(Declare& declare, Options& options);
Outcome run_defer(const Options& options, Workplace& place);
void declare_ignore(Declare& declare, Options& options);
Outcome run_ignore(const Options& options, Workplace& place);
/// Takes a pair, SOURCE and TARGET, out of the map; its units are then what the baseline has.
Outcome run_reject(const Options& options, Workplace& place);
void declare_sync(Declare& declare, Options& options);
Outcome run_sync(const Options& options, Workplace& place);
void declare_difftest(Declare& declare, Options& options);
Outcome run_difftest(const Options& options, Workplace& place);
void declare_audit(Declare& declare, Options& options);
Outcome run_audit(const Options& options, Workplace& place);
void declare_review(Declare& declare, Options& options);
Outcome run_review(const Options& options, Workplace& place);
void declare_compare(Declare& declare, Options& options);
Outcome run_compare(const Options& options, Workplace& place);
void declare_explain(Declare& declare, Options& options);
Outcome run_explain(const Options& options, Workplace& place);
void declare_effort(Declare& declare, Options& options);
Outcome run_effort(const Options& options, Workplace& place);
void declare_history(Declare& declare, Options& options);
Outcome run_history(const Options& options, Workplace& place);
void declare_report(Declare& declare, Options& options);
Outcome run_report(const Options& options, Workplace& place);

void declare_watch(Declare& declare, Options& options);
Outcome run_watch(const Options& options, Workplace& place);
void declare_lsp(Declare& declare, Options& options);
Outcome run_lsp(const Options& options, Workplace& place);

/// Writes to stdout at once, so that a full disk or a closed pipe is seen here. Throws CannotDo.
void print(std::ostream& out, const std::string& text);

/// The globs of both sides, for the commands that do without a map.
void declare_sides(Declare& declare, Options& options);

/// Throws CannotDo unless `format` is one of `known`.
void require_format(const std::string& format, std::initializer_list<const char*> known);

}  // namespace porttool
