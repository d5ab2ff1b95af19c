// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "application/command_table.h"
#include "application/declare_options.h"
#include "metrics/text/suggest.h"

namespace application {
namespace {

const char* const DESCRIPTION = "Path tracing on two cores that draw the same picture: Vulkan compute and Embree.";

Invocation usage_error(const std::string& where, const std::string& what) {
    Invocation invocation;
    invocation.text = "pathtracer: error: " + what + "\nsee '" + where + " --help'\n";
    invocation.exit_code = FAILED;
    return invocation;
}

/// `--seed -1` is meant as a value, not as an option: joins it with the option before it.
std::vector<std::string> join_negative_numbers(std::span<const std::string> arguments) {
    std::vector<std::string> joined;
    for (const std::string& argument : arguments) {
        const bool number = argument.size() > 1 && argument[0] == '-' &&
                            (argument[1] == '.' || (argument[1] >= '0' && argument[1] <= '9'));
        const bool after_option =
            !joined.empty() && joined.back().starts_with("--") && joined.back().find('=') == std::string::npos;
        if (number && after_option) {
            joined.back() += "=" + argument;
        } else {
            joined.push_back(argument);
        }
    }
    return joined;
}

/// The first argument that is neither an option nor the value of one: the subcommand's place.
const std::string* first_word(const std::vector<std::string>& arguments) {
    for (size_t i = 0; i < arguments.size(); ++i) {
        if (arguments[i] == "--color") {
            ++i;
        } else if (!arguments[i].starts_with("-")) {
            return &arguments[i];
        }
    }
    return nullptr;
}

/// `compare --bias A... -- B...`: takes the words behind the `--` out. Without --bias it means what it does elsewhere.
std::vector<std::string> take_second_set(std::vector<std::string>& words) {
    const auto mark = std::find(words.begin(), words.end(), "--");
    if (mark == words.end() || std::find(words.begin(), mark, "--bias") == mark) return {};
    std::vector<std::string> second(mark + 1, words.end());
    words.erase(mark, words.end());
    return second;
}

/// The first of the words behind `--` that was meant as an option: no file has that name.
std::string option_behind_mark(const std::vector<std::string>& words) {
    std::error_code error;
    const auto option = std::find_if(words.begin(), words.end(), [&error](const std::string& word) {
        return word.starts_with("-") && !std::filesystem::exists(word, error);
    });
    return option == words.end() ? "" : *option;
}

std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

/// Names the first argument nobody asked for.
std::string describe_extras(const CLI::App& app) {
    const std::vector<std::string> extras = app.remaining(true);
    if (extras.empty() && app.get_name() == "compare")  // what a -- parts is no argument to CLI11
        return "--: two sets of image files are for --bias; give it too";
    if (extras.empty()) return "unexpected arguments";
    const std::string& word = extras.front();
    if (!word.starts_with("-")) return "unexpected argument '" + word + "'";
    const auto near = metrics::suggest(word.substr(0, word.find('=')), option_names(app));
    return "unknown option '" + word + "'" + (near ? "; did you mean '" + *near + "'?" : "");
}

std::string unknown_command(const std::string& word) {
    std::vector<std::string> names;
    std::string list;
    for (const Command& command : command_table()) {
        names.push_back(command.name);
        list += (list.empty() ? "" : ", ") + command.name;
    }
    const auto near = metrics::suggest(word, names);
    return "unknown command '" + word + "'; " + (near ? "did you mean '" + *near + "'?" : "there are " + list);
}

void configure(CLI::App& app) {
    app.get_formatter()->column_width(32);
    app.set_help_flag("-h,--help", "Print this help");
    app.option_defaults()->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
}

}  // namespace

Invocation parse_command_line(std::span<const std::string> arguments) {
    Invocation invocation;
    CLI::App app(DESCRIPTION, "pathtracer");
    configure(app);
    app.require_subcommand(0, 1);
    declare_common(app, invocation.options);
    for (const Command& command : command_table()) {
        CLI::App* sub = app.add_subcommand(command.name, command.help);
        configure(*sub);
        command.declare(*sub, invocation.options);
        declare_common(*sub, invocation.options);
    }

    std::vector<std::string> words = join_negative_numbers(arguments);
    const std::string* word = first_word(words);
    const Command* command = word != nullptr ? find_command(*word) : nullptr;
    if (word != nullptr && command == nullptr) return usage_error("pathtracer", unknown_command(*word));
    const CLI::App* used = command != nullptr ? app.get_subcommand(command->name) : &app;
    const size_t words_before = words.size();
    if (command != nullptr && command->name == "compare") invocation.options.images_b = take_second_set(words);
    if (words.size() < words_before && invocation.options.images_b.empty())
        return usage_error("pathtracer compare", "--: no image files behind it; give --bias A... -- B...");
    if (const std::string option = option_behind_mark(invocation.options.images_b); !option.empty()) {
        return usage_error("pathtracer compare",
                           option + ": stands behind --, where only image files do; give it before them");
    }
    const std::string where = command != nullptr ? "pathtracer " + command->name : "pathtracer";

    try {
        std::reverse(words.begin(), words.end());  // CLI11 takes them from the back
        app.parse(words);
    } catch (const CLI::CallForHelp&) {
        return {nullptr, {}, used->help(command != nullptr ? "pathtracer" : "", CLI::AppFormatMode::Normal), DONE};
    } catch (const CLI::CallForVersion& version) {
        return {nullptr, {}, std::string(version.what()) + "\n", DONE};
    } catch (const CLI::ExtrasError&) {
        return usage_error(where, describe_extras(*used));
    } catch (const CLI::ParseError& error) {
        return usage_error(where, error.what());
    }
    if (command == nullptr) return usage_error("pathtracer", "no command given");
    if (invocation.options.quiet && invocation.options.verbose) {
        return usage_error(where, "--quiet and --verbose contradict each other; give one of them");
    }
    invocation.command = command;
    return invocation;
}

}  // namespace application
