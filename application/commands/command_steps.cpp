// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/commands/command_steps.h"

#include <fmt/format.h>

#include "application/cluster/team.h"
#include "application/cores.h"
#include "application/file_output.h"

namespace application {

using render_system::CoreChoice;
using render_system::Result;
using render_system::Status;
using render_system::StatusCode;

ExitCode fail(Console& console, const Status& status, bool other_core) {
    console.error(explain(status, other_core));
    return FAILED;
}

ExitCode fail_once(Console& console, const Status& status) {
    return team() && !team()->leads() ? FAILED : fail(console, status);
}

namespace {

// The same file under two options: the second to be written would take the first one's place.
Status check_distinct(const char* option, const std::string& a, const std::string& b) {
    std::error_code error;
    const auto file_of = [&](const std::string& name) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(name), error);
    };
    if (a.empty() || b.empty() || file_of(a) != file_of(b)) return Status::success();
    return Status::invalid(
        fmt::format("{} {}: another option writes that file; give each a name of its own", option, a));
}

}  // namespace

Status check_files(const Options& options, const std::string& output) {
    if (Status status = check_distinct("--stats", options.stats, output); !status.ok()) return status;
    if (Status status = check_distinct("--evidence", options.evidence, options.stats); !status.ok()) return status;
    if (!options.stats.empty()) {
        if (Status status = check_writable(options.stats); !status.ok()) return status;
    }
    std::error_code error;
    if (!options.kernels.empty() && !std::filesystem::is_directory(options.kernels, error)) {
        return Status::error(
            StatusCode::not_found,
            fmt::format("--kernels: there is no folder {}; leave it out for the kernels built in", options.kernels));
    }
    return Status::success();
}

std::vector<OutputFile> output_files(const Options& options, const std::vector<std::filesystem::path>& pictures) {
    std::vector<OutputFile> outputs = {
        {"--stats", options.stats}, {"--evidence", options.evidence}, {"--log", options.log}};
    for (const std::filesystem::path& picture : pictures) outputs.push_back({"-o", picture});
    return outputs;
}

bool changes_colors(const Options& options) { return options.exposure != 0.0f || options.tone_map != ToneMap::none; }

Result<CoreChoice> start_chosen_core(CoreSession& session, const Options& options, Picture& picture, Console& console) {
    const CoreOrder order = core_order(options);
    if (!options.kernels.empty() && (order.ids.front() == "target" || order.ids.front() == "null"))
        return Status::invalid(
            fmt::format("--kernels: core {} is taken here, which reads none; give --core source", order.ids.front()));
    auto choice = session.start(order.ids, picture);
    if (choice.ok() && choice->core == order.ids.front() && !order.reason.empty())
        choice->reason += "; " + order.reason;
    if (choice.ok() && (order.ids.size() > 1 || !options.core_given)) console.note(choice->reason);
    return choice;
}

std::string json_text(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Status write_stats(const Options& options, const Json& stats, const std::string& written) {
    if (options.stats.empty()) return Status::success();
    Status status = write_file(options.stats, json_text(stats));
    if (!status.ok() && !written.empty()) status.message += "; what -o names is written: " + written;
    return status;
}

ExitCode deliver(const Options& options, Console& console, const std::string& text) {
    if (options.output.empty()) {
        console.result(text);
        return DONE;
    }
    const Status status = write_file(options.output, text);
    return status.ok() ? DONE : fail(console, status);
}

}  // namespace application
