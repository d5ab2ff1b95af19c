// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/command/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

constexpr const char* kVersion = "porttool 0.1.0";

void add_common(CLI::App& app, Options& options) {
    app.add_option("-C", options.directory, "Run as if started in this folder")->type_name("DIR");
    app.add_option("--config", options.config, "The map to use instead of the nearest portmap.toml")->type_name("FILE");
    app.add_option("--format", options.format,
                   "How to print: text, json; check also sarif, junit, github, gitlab, markdown; report also html, "
                   "markdown, csv; history also html, csv; effort also toml")
        ->type_name("FORMAT");
    app.add_option("-o,--output", options.output, "Write there instead of to stdout; - is stdout")->type_name("FILE");
    app.add_option("--color", options.color, "auto, always or never")
        ->check(CLI::IsMember({"auto", "always", "never"}));
    app.add_flag("-q,--quiet", options.quiet, "Print results only");
    app.add_flag("-v,--verbose", options.verbose, "Say more on stderr");
}

void add_sides(CLI::App& app, Options& options) {
    app.add_option("--source", options.source, "Globs of the side that is ported from")->type_name("GLOB");
    app.add_option("--target", options.target, "Globs of the side that is ported to")->type_name("GLOB");
}

/// A revision that may not be empty, as an unset variable of CI would make it.
void add_base(CLI::App& app, Options& options, const char* help) {
    app.add_option("--base", options.base, help)->type_name("REV")->check([](const std::string& text) {
        return text.empty() ? "expected a revision" : "";
    });
}

void add_scan(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("scan", "List the units of files and folders");
    command->add_option("path", options.paths, "Files and folders")->required()->type_name("PATH");
}

void add_map(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("map", "Pair source units with target units");
    add_sides(*command, options);
}

void add_init(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("init", "Write a first portmap.toml and portmap.lock");
    add_sides(*command, options);
    command->add_flag("--force", options.force, "Replace what is there");
}

void add_check(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("check", "Find what changed on one side only, or differently on both");
    add_base(*command, options, "Hold the work tree against merge-base(REV, HEAD)");
    command->add_flag("--trusted-map", options.trusted_map,
                      "With --base: take map, lock and suppressions from there, so that a change cannot settle itself");
    command->add_flag("--staged", options.staged, "Take the index in place of the work tree");
    command->add_flag("--spirv", options.spirv, "Compile edited GLSL; what gives the same SPIR-V is a note");
    command->add_flag("--strict", options.strict, "Exit 1 for warnings too");
}

void add_accept(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("accept", "Record that a pair is in step now");
    command->add_option("id", options.paths, "Ids, SOURCE=TARGET, or fingerprints of findings")->type_name("ID");
    command->add_flag("--all", options.all, "Every pair whose two edits are equivalent");
    command->add_flag("--force", options.force, "With --all: every pair");
    command->add_option("--reason", options.reason, "Why")->type_name("TEXT");
}

void add_defer(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("defer", "Postpone a finding");
    command->add_option("id", options.paths, "Id, SOURCE=TARGET, or fingerprint")->required()->type_name("ID");
    command->add_option("--owner", options.owner, "Who will port it")->required()->type_name("NAME");
    command->add_option("--until", options.until, "YYYY-MM-DD")->required()->type_name("DATE");
    command->add_option("--reason", options.reason, "Why not now")->required()->type_name("TEXT");
}

void add_ignore(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("ignore", "Settle a finding for good");
    command->add_option("id", options.paths, "Id, SOURCE=TARGET, or fingerprint")->required()->type_name("ID");
    command->add_option("--reason", options.reason, "Why")->required()->type_name("TEXT");
}

void add_compare(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("compare", "Measure how much two files or two units share");
    command->add_option("side", options.paths, "Two files, or units as PATH:NAME")
        ->required()
        ->expected(2)
        ->type_name("A B");
}

void add_explain(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("explain", "Show why a finding stands, or what a rule means");
    command->add_option("id", options.paths, "Id, SOURCE=TARGET, fingerprint or rule")
        ->required()
        ->type_name("ID|RULE");
}

void add_effort(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("effort", "Tell what porting a range of commits cost");
    command->add_option("--from", options.from, "The commit before the change")->required()->type_name("REV");
    command->add_option("--to", options.to, "The commit that ends it (HEAD)")->type_name("REV");
}

void add_history(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("history", "Show metrics and drift debt over the git history");
    command->add_option("--since", options.since, "Show only what came after this commit")->type_name("REV");
    command->add_flag("--no-cache", options.no_cache, "Neither use nor keep what was measured before");
}

void add_report(CLI::App& app, Options& options) {
    CLI::App* command = app.add_subcommand("report", "Report what is shared, what drifted, and what porting costs");
    add_base(*command, options, "Show each figure with its change against merge-base(REV, HEAD)");
    command->add_option("--bench", options.bench, "Speed of one platform, for performance portability")
        ->allow_extra_args(false)
        ->type_name("FILE[=MRAYS]");
    command->add_option("--fail-under", options.fail_under, "Exit 1 if a block's target shares less, in Moss percent")
        ->allow_extra_args(false)
        ->type_name("BLOCK=PERCENT");
}

/// CLI11's message without its pointer to --help, with the nearest name of an unknown subcommand.
std::string usage_error(const CLI::App& app, const CLI::ParseError& error, int argc, const char* const* argv) {
    std::string text = terminal_text(error.what());
    std::vector<std::string> names;
    for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
        names.push_back(sub->get_name());
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word.starts_with('-')) continue;
        if (std::find(names.begin(), names.end(), word) != names.end()) break;
        const std::string near = nearest(word, names);
        if (!near.empty()) text += "; did you mean '" + near + "'?";
        break;
    }
    return "porttool: " + text + "\nRun 'porttool --help' for the commands and their options.\n";
}

}  // namespace

ParsedOptions parse_options(int argc, const char* const* argv) {
    ParsedOptions parsed;
    Options& options = parsed.options;
    CLI::App app("Finds what was not ported: pairs the functions of two code bases and watches that they stay in step.",
                 "porttool");
    app.set_version_flag("--version", kVersion);
    app.fallthrough();
    app.require_subcommand(1);
    add_common(app, options);
    for (const auto add : {add_scan, add_map, add_init, add_check, add_accept, add_defer, add_ignore, add_compare,
                           add_explain, add_effort, add_history, add_report})
        add(app, options);
    try {
        app.parse(argc, argv);
        options.command = app.get_subcommands().front()->get_name();
        if (options.output == "-") options.output.clear();
    } catch (const CLI::CallForHelp&) {
        parsed = {options, true, 0, app.help("", CLI::AppFormatMode::Normal), ""};
        for (const CLI::App* sub : app.get_subcommands()) parsed.out = sub->help("porttool");
    } catch (const CLI::CallForVersion&) {
        parsed = {options, true, 0, std::string(kVersion) + "\n", ""};
    } catch (const CLI::ParseError& error) {
        parsed = {options, true, 2, "", usage_error(app, error, argc, argv)};
    }
    return parsed;
}

}  // namespace porttool
