// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/sync_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "porttool/text/sink/json.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

ordered_json patch_or_null(const std::string& text) {
    return text.empty() ? ordered_json(nullptr) : ordered_json(text);
}

ordered_json verified_or_null(const std::optional<Verification>& verification) {
    if (!verification) return nullptr;
    constexpr double kMilliseconds = 1000;
    return {{"command", verification->command},
            {"exit_code", verification->exit_code},
            {"seconds", std::round(verification->seconds * kMilliseconds) / kMilliseconds},
            {"output_tail", verification->output_tail}};
}

/// A patch, or what a command printed, for a reader: its line ends act, nothing else does.
void add_lines(std::string_view patch, std::string& out) {
    for (size_t first = 0; first < patch.size();) {
        const size_t next = std::min(patch.find('\n', first), patch.size());
        const size_t end = next > first && patch[next - 1] == '\r' ? next - 1 : next;
        out += terminal_code_line("    ", patch.substr(first, end - first)) + '\n';
        first = next + 1;
    }
}

/// Where an item stands, for a reader; nothing for one of no line, as a verification that failed.
std::string lines_of(const LeftItem& item) {
    std::string out;
    if (item.source_line > 0) out += fmt::format(", source line {}", item.source_line);
    if (item.target_line > 0) out += fmt::format(", port line {}", item.target_line);
    return out;
}

/// What was done and why, and what a person may have to do.
ordered_json reasons_of(const Proposal& proposal) {
    ordered_json out = proposal.why;
    for (const LeftItem& item : proposal.perhaps) out.push_back("perhaps" + lines_of(item) + ": " + item.message);
    return out;
}

}  // namespace

std::string sync_json(const SyncResult& result, const std::optional<Verification>& verification) {
    ordered_json proposals = ordered_json::array();
    for (Proposal one : result.proposals) {
        if (!is_utf8(one.patch) || !is_utf8(one.record_patch)) {  // JSON cannot hold it
            one.patch.clear();
            one.record_patch.clear();
            one.state = ProposalState::Refused;
            one.left.push_back({"the patch has bytes that are no UTF-8; --format patch prints it, --apply writes it"});
        }
        ordered_json left = ordered_json::array();
        for (const LeftItem& item : one.left)
            left.push_back(
                {{"message", item.message}, {"source_line", item.source_line}, {"target_line", item.target_line}});
        proposals.push_back({{"source", one.id.source},
                             {"target", one.id.target},
                             {"state", proposal_state_name(one.state)},
                             {"patch", patch_or_null(whole_patch(one))},
                             {"map_patch", patch_or_null(map_patch(one))},
                             {"left", std::move(left)},
                             {"why", reasons_of(one)}});
    }
    return json_text({{"proposals", std::move(proposals)}, {"verified", verified_or_null(verification)}}, 1) + "\n";
}

bool fits_json(const SyncResult& result) {
    return std::all_of(result.proposals.begin(), result.proposals.end(),
                       [](const Proposal& one) { return is_utf8(one.patch) && is_utf8(one.record_patch); });
}

std::string sync_patch(const SyncResult& result) {
    std::string out;
    for (const Proposal& one : result.proposals) out += whole_patch(one);
    return out;
}

std::string sync_table(const SyncResult& result, const std::optional<Verification>& verification) {
    std::string out;
    std::array<size_t, kProposalStates.size()> counts{};
    for (const Proposal& one : result.proposals) {
        ++counts.at(static_cast<size_t>(one.state));
        out += fmt::format("{}: {} = {}", proposal_state_name(one.state), terminal_text(one.id.source),
                           terminal_text(one.id.target));
        for (const std::string& why : one.why) out += "; " + terminal_text(why);
        out += "\n";
        for (const LeftItem& item : one.left)
            out += "    left for you" + lines_of(item) + ": " + terminal_text(item.message) + "\n";
        for (const LeftItem& item : one.perhaps)
            out += "    perhaps for you" + lines_of(item) + ": " + terminal_text(item.message) + "\n";
        add_lines(one.patch, out);
        if (!one.record_patch.empty())
            out += "    with what changes of it in portmap.toml, portmap.lock, portmap.base/\n";
    }
    if (verification) {
        out += fmt::format("{} in {:.1f} s: {}\n", verification->passed() ? "verified" : "failed",
                           verification->seconds, terminal_text(verification->command));
        if (!verification->passed()) add_lines(verification->output_tail, out);
    }
    return out + fmt::format("{} proposed, {} in part, {} left for you, {} not due\n", counts[0], counts[1], counts[2],
                             counts[3]);
}

}  // namespace porttool
