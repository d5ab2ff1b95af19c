// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/verify.h"

#include <fmt/format.h>

#include <charconv>
#include <map>

#include "porttool/sync/verify_tree.h"

namespace porttool {

std::optional<std::chrono::milliseconds> parse_duration(const std::string& text) {
    constexpr int64_t kMinute = 60, kHour = 3600, kLongest = 365 * 24 * kHour, kThousand = 1000;
    int64_t number = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, number);
    if (error != std::errc() || number <= 0 || number > kLongest) return std::nullopt;
    const std::string_view unit(rest, static_cast<size_t>(end - rest));
    if (!unit.empty() && unit != "s" && unit != "m" && unit != "h") return std::nullopt;
    const int64_t seconds = number * (unit == "m" ? kMinute : unit == "h" ? kHour : 1);
    return std::chrono::milliseconds(std::min(seconds, kLongest) * kThousand);
}

Verification verify(const std::vector<WrittenFile>& files, const std::string& command, std::chrono::milliseconds limit,
                    Disk& disk) {
    std::map<std::string, std::string> now;
    for (const WrittenFile& file : files) {
        if (file.place.root != files.front().place.root)
            throw CannotDo(
                "--verify: the proposals write two checkouts, and a command runs in one\nTake one side at a time, with "
                "--to source or --to target");
        now[file.place.path] = file.now;
    }
    const VerifyTree tree = prepare_verify_tree(files.front().place.root, now, disk);
    Verification out;
    static_cast<CommandEnd&>(out) = run_bounded(command, tree.folder, limit);
    out.command = command;
    return out;
}

std::string failure_of(const Verification& verification) {
    if (verification.timed_out)
        return fmt::format("the verification was stopped after {:.0f} s; give it more with --verify-timeout",
                           verification.seconds);
    return fmt::format("the verification failed, with exit code {}; the end of its output says why",
                       verification.exit_code);
}

void take_back(SyncResult& result, const Verification& verification) {
    for (Proposal& one : result.proposals) {
        if (one.state != ProposalState::Proposed) continue;
        one.state = ProposalState::Partial;
        one.left.push_back({failure_of(verification), 0, 0});
    }
}

}  // namespace porttool
