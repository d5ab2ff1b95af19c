// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/run.h"

#include <cerrno>
#include <cstring>
#include <new>

#include "porttool/command/command_table.h"
#include "porttool/command/output_file.h"
#include "porttool/read/glob.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/utf8.h"

namespace porttool {

void require_format(const std::string& format, std::initializer_list<const char*> known) {
    std::string list;
    for (const char* name : known) {
        if (format == name) return;
        list += (list.empty() ? "" : ", ") + std::string(name);
    }
    throw CannotDo("--format " + terminal_text(format) + ": not known here; known are " + list);
}

void print(std::ostream& out, const std::string& text) {
    errno = 0;
    out << text << std::flush;
    if (out) return;
    const std::string reason = errno != 0 ? std::strerror(errno) : "the stream is closed";
    throw CannotDo("stdout cannot be written: " + reason);
}

namespace {

/// Runs the command that was asked for; returns its exit code. Throws CannotDo.
int run_command(const Options& options, Disk& disk, std::ostream& out, std::ostream& err) {
    if (!disk.is_directory(options.directory))
        throw CannotDo("-C " + terminal_text(options.directory) + ": no such folder; name one that exists");
    const bool to_file = !options.output.empty();
    const std::string path = join_path(options.directory, options.output),
                      option = "-o " + terminal_text(options.output);
    if (to_file) require_output(options, option, path, disk);
    Workplace place{disk, err, &out};
    const Outcome outcome = find_command(options.command)->run(options, place);
    // A source in Latin-1 must not break the format, unless the format is the source's own.
    const std::string text = outcome.is_exact ? outcome.text : as_utf8(outcome.text);
    try {
        if (!to_file)
            print(out, text);
        else if (const std::string failure = disk.write(path, text); !failure.empty())
            throw CannotDo(option + ": " + failure + "; name another file");
    } catch (const CannotDo& problem) {
        if (outcome.written.empty()) throw;
        throw CannotDo(std::string(problem.what()) + "; but " + outcome.written + ": do not repeat the command");
    }
    return outcome.exit_code;
}

/// Runs what `parse` returns; every exception ends in exit 2 with a line.
template <class Parse>
int run_guarded(const Parse& parse, Disk& disk, std::ostream& out, std::ostream& errors) {
    TerminalBuffer printable(errors.rdbuf());  // what a message echoes never acts
    std::ostream err(&printable);
    try {
        const ParsedOptions& parsed = parse();
        if (!parsed.done) return run_command(parsed.options, disk, out, err);
        err << parsed.err;
        if (!parsed.out.empty()) print(out, parsed.out);
        return parsed.exit_code;
    } catch (const CannotDo& problem) {
        err << "porttool: " << problem.what() << "\n";
    } catch (const GlobTooLarge& problem) {
        err << "porttool: " << terminal_lines(problem.what()) << "\n";
    } catch (const std::bad_alloc&) {
        err << "porttool: not enough memory; take the largest files out of [sides], or give it more\n";
    } catch (const std::exception& problem) {
        err << "porttool: stopped by an error of its own: " << terminal_text(problem.what()) << "; please report it\n";
    } catch (...) {
        err << "porttool: stopped by an error of its own; please report it\n";
    }
    return 2;
}

}  // namespace

int run_porttool(int argc, const char* const* argv, Disk& disk, std::ostream& out, std::ostream& err) {
    return run_guarded([&] { return parse_options(argc, argv); }, disk, out, err);
}

int run_porttool(const ParsedOptions& parsed, Disk& disk, std::ostream& out, std::ostream& err) {
    return run_guarded([&]() -> const ParsedOptions& { return parsed; }, disk, out, err);
}

}  // namespace porttool
