// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "porttool/command/command_table.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

/// Options that stand before the subcommand or after it.
void declare_common(Declare declare, Options& options) {
    declare.text("-C", options.directory, "DIR", "Run as if started in this folder");
    declare.text("--config", options.config, "FILE", "The map to use instead of the nearest portmap.toml")
        .not_empty("a file");
    declare.text("--format", options.format, "FORMAT",
                 "How to print: text, json (not accept, defer, ignore, explain, lsp); check also sarif, junit, github, "
                 "gitlab, markdown, html; "
                 "report also html, markdown, csv; history also html, csv; effort also csv, toml; sync also patch; "
                 "audit also html, markdown");
    declare.text("-o,--output", options.output, "FILE", "Write there instead of to stdout; - is stdout")
        .not_empty("a file; - is stdout");
    declare.choice("--color", options.color, {"auto", "always", "never"}, "auto, always or never");
    declare.flag("-q,--quiet", options.quiet, "Print results only");
    declare.flag("-v,--verbose", options.verbose, "Say more on stderr");
}

/// The first argument that is neither an option nor the value of a common one: where the subcommand stands.
std::string first_word(const CLI::App& app, int argc, const char* const* argv) {
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (!word.starts_with('-')) return word;
        const CLI::Option* option = app.get_option_no_throw(word);
        if (option != nullptr && option->get_expected_min() > 0) ++i;
    }
    return {};
}

/// Whether a word of the line is the name. The options of a command that is not named cannot be asked for, and a start
/// that declares those of all takes twice as long from here to the command.
bool is_word(std::string_view name, int argc, const char* const* argv) {
    return std::find(argv + std::min(argc, 1), argv + argc, name) != argv + argc;
}

/// What is wrong with a line that names no command of the table: one line.
std::string unknown_command(const std::string& word) {
    std::vector<std::string> names;
    std::string list;
    for (const Command& command : command_table()) {
        names.emplace_back(command.name);
        list += (list.empty() ? "" : ", ") + names.back();
    }
    const std::string near = nearest(word, names);
    return "porttool: unknown command '" + terminal_text(word) + "'; " +
           (near.empty() ? "there are " + list : "did you mean '" + near + "'?") + "\n";
}

std::vector<std::string> long_options(const CLI::App& app) {
    std::vector<std::string> out;
    for (const CLI::Option* option : app.get_options())
        for (const std::string& name : option->get_lnames()) out.push_back("--" + name);
    return out;
}

/// What to say of an option that nobody knows: the one of the command, or of all, that is most like it, else which the
/// command has; "" where it is no option.
std::string instead_of_option(const CLI::App& app, const CLI::App& command) {
    const std::vector<std::string> words = app.remaining(true);
    const auto unknown =
        std::find_if(words.begin(), words.end(), [](const std::string& word) { return word.starts_with('-'); });
    if (unknown == words.end()) return {};
    const std::vector<std::string> own = long_options(command);
    std::vector<std::string> names = long_options(app);
    names.insert(names.end(), own.begin(), own.end());
    if (const std::string near = nearest(unknown->substr(0, unknown->find('=')), names); !near.empty())
        return "; did you mean '" + near + "'?";
    std::string list;
    for (const std::string& name : own)
        if (name != "--help") list += (list.empty() ? "" : ", ") + name;
    return "; " + command.get_name() + " has " + list;
}

/// What a command cannot do without and was not given, or not as often as it has to be: `--owner NAME, --until DATE`.
std::string lacking(const CLI::App& command) {
    std::string out;
    for (const CLI::Option* option : command.get_options()) {
        const int given = static_cast<int>(option->count());
        if (!option->get_required() ||
            (given >= option->get_items_expected_min() && given <= option->get_items_expected_max()))
            continue;
        const std::string name = option->get_positional() ? "" : option->get_name() + " ";
        out += (out.empty() ? "" : ", ") + name + option->get_type_name();
    }
    return out;
}

/// What is wrong with the words behind a command, with the nearest name of an unknown option.
std::string wrong_words(const CLI::App& app, const CLI::App& command, const CLI::ParseError& error) {
    const auto is = [&](CLI::ExitCodes code) { return error.get_exit_code() == static_cast<int>(code); };
    if (is(CLI::ExitCodes::RequiredError) || is(CLI::ExitCodes::ArgumentMismatch))
        if (const std::string names = lacking(command); !names.empty()) return command.get_name() + " needs " + names;
    return terminal_text(error.what()) + (is(CLI::ExitCodes::ExtrasError) ? instead_of_option(app, command) : "");
}

/// What is wrong with a command line, and which --help tells more: two lines, or one for an unknown command.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, const std::string& word) {
    const auto commands = app.get_subcommands();
    if (!commands.empty())
        return "porttool: " + wrong_words(app, *commands.front(), error) + "\nRun 'porttool " +
               commands.front()->get_name() + " --help' for its options.\n";
    if (!word.empty()) return unknown_command(word);
    const bool lacks = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::RequiredError);
    std::string unknown;
    for (const std::string& left : app.remaining(true)) unknown += (unknown.empty() ? " beside " : " ") + left;
    return "porttool: " + (lacks ? "no command given" + terminal_text(unknown) : terminal_text(error.what())) +
           "\nRun 'porttool --help' for the commands, and 'porttool COMMAND --help' for the options of one.\n";
}

}  // namespace

void declare_sides(Declare& declare, Options& options) {
    declare.texts("--source", options.source, "GLOB", "Globs of the side that is ported from");
    declare.texts("--target", options.target, "GLOB", "Globs of the side that is ported to");
}

ParsedOptions parse_options(int argc, const char* const* argv) {
    ParsedOptions parsed;
    Options& options = parsed.options;
    CLI::App app("Finds what was not ported: pairs the functions of two code bases and watches that they stay in step.",
                 "porttool");
    const std::string version = std::string("porttool ") + kVersionNumber;
    app.set_version_flag("--version", version);
    app.fallthrough();
    app.require_subcommand(1);
    declare_common(Declare(app), options);
    for (const Command& command : command_table()) {
        Declare declare(*app.add_subcommand(std::string(command.name), command.help));
        if (is_word(command.name, argc, argv)) command.declare(declare, options);
    }
    const std::string word = first_word(app, argc, argv);
    try {
        app.parse(argc, argv);
        options.command = app.get_subcommands().front()->get_name();
        if (options.output == "-") options.output.clear();
    } catch (const CLI::CallForHelp&) {
        const auto commands = app.get_subcommands();
        if (commands.empty() && !word.empty())
            parsed = {options, true, 2, "", unknown_command(word)};
        else if (commands.empty())
            parsed = {options, true, 0, app.help("", CLI::AppFormatMode::Normal), ""};
        else
            parsed = {options, true, 0, commands.back()->help("porttool"), ""};
    } catch (const CLI::CallForVersion&) {
        parsed = {options, true, 0, version + "\n", ""};
    } catch (const CLI::ParseError& error) {
        parsed = {options, true, 2, "", usage_error(app, error, word)};
    }
    return parsed;
}

}  // namespace porttool
