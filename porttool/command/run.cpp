// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <map>

#include "porttool/command/commands.h"
#include "porttool/command/suggest.h"

namespace porttool {
namespace {

using Command = Outcome (*)(const Options&, Workplace&);

const std::map<std::string, Command>& commands() {
    static const std::map<std::string, Command> table = {
        {"scan", scan_command},       {"map", map_command},         {"init", init_command},
        {"check", check_command},     {"accept", accept_command},   {"defer", defer_command},
        {"ignore", ignore_command},   {"explain", explain_command}, {"effort", effort_command},
        {"history", history_command}, {"compare", compare_command}, {"report", report_command},
    };
    return table;
}

}  // namespace

std::string find_root(const Disk& disk, const std::string& directory) {
    std::error_code error;
    std::string absolute = std::filesystem::absolute(directory, error).lexically_normal().generic_string();
    if (absolute.size() > 1 && absolute.ends_with('/')) absolute.pop_back();
    for (const char* mark : {"portmap.toml", ".git"}) {
        for (std::filesystem::path at = absolute;; at = at.parent_path()) {
            if (disk.exists(join_path(at.string(), mark))) return at.string();
            if (at == at.parent_path()) break;
        }
    }
    return absolute;
}

void require_format(const std::string& format, std::initializer_list<const char*> known) {
    std::string list;
    for (const char* name : known) {
        if (format == name) return;
        list += (list.empty() ? "" : ", ") + std::string(name);
    }
    throw CannotDo("--format " + format + ": not known here; known are " + list);
}

int run_porttool(int argc, const char* const* argv, Disk& disk, std::ostream& out, std::ostream& err) {
    const ParsedOptions parsed = parse_options(argc, argv);
    if (parsed.done) {
        out << parsed.out;
        err << parsed.err;
        return parsed.exit_code;
    }
    const Options& options = parsed.options;
    try {
        if (!disk.is_directory(options.directory))
            throw CannotDo("-C " + options.directory + ": no such folder; name one that exists");
        Workplace place{disk, err};
        const Outcome outcome = commands().at(options.command)(options, place);
        if (options.output.empty()) {
            out << outcome.text << std::flush;
        } else if (const std::string failure = disk.write(join_path(options.directory, options.output), outcome.text);
                   !failure.empty()) {
            throw CannotDo("-o " + options.output + ": " + failure);
        }
        return outcome.exit_code;
    } catch (const CannotDo& problem) {
        err << "porttool: " << problem.what() << "\n";
        return 2;
    }
}

}  // namespace porttool
