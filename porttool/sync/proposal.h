// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/scan/side.h"

namespace porttool {

/// What there is to say of a pair: a port of the whole edit, of a part of it, none, or that none is due.
enum class ProposalState : uint8_t { Proposed, Partial, Refused, Already };
inline constexpr std::array<std::string_view, 4> kProposalStates = {"proposed", "partial", "refused", "already"};
constexpr std::string_view proposal_state_name(ProposalState state) {
    return kProposalStates.at(static_cast<size_t>(state));
}

/// Something that a person must do; lines are those of the files as they stand, 0 where none is known.
struct LeftItem {
    std::string message;
    uint32_t source_line = 0, target_line = 0;
    bool is_sure = true;  ///< false where the port has nothing that resembles it: whether it is owed is not told
};

/// Units of the side that is written, by their ids, each with a function that gives nothing back there, whatever the
/// source's does now.
using Valueless = std::set<std::pair<std::string, std::string>>;

struct Proposal {
    BySide<std::string> id;
    ProposalState state = ProposalState::Refused;
    std::string patch;          ///< of the side that is written, relative to its root; "" for none
    std::string record_patch;   ///< of the project's own files, relative to its root: the pairs that come with it
    bool is_elsewhere = false;  ///< the side that is written has a root of its own
    std::vector<LeftItem> left;
    std::vector<LeftItem> perhaps;  ///< of what is left, what the port has nothing for, and may not owe
    std::vector<std::string> why;
    bool comes_last = false;  ///< its patch applies behind those of all that have not
};

}  // namespace porttool
