// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/unit_state.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/rule.h"
#include "porttool/scan/side.h"

namespace porttool {

/// Where a finding points.
struct Place {
    std::string id, file;
    uint32_t line = 0;
    uint32_t end_line = 0;
};

/// What happened to the unit that a finding is about.
enum class ChangeKind : uint8_t { Semantic, Constant, Rename, Moved, Added, Removed };
inline constexpr std::array<std::string_view, 6> kChangeNames = {"semantic", "constant", "rename",
                                                                 "moved",    "added",    "removed"};
constexpr std::string_view change_name(ChangeKind change) { return kChangeNames.at(static_cast<size_t>(change)); }

struct Finding {
    Rule rule = Rule::SourceChanged;
    Level level = Level::Error;
    std::optional<ChangeKind> change;
    std::optional<Place> source, target;
    std::string message, remedy;
    std::string map_source, map_target;  ///< the ids of its pair in portmap.toml; the second empty outside pairs
    std::string fingerprint;  ///< stable: of the rule, the ids, and the subject where a rule finds several on one pair
    std::optional<Verdict> verdict;  ///< Defer or Ignore where a person settled it
    std::string verdict_reason;
    bool settled_in_source = false;    ///< by a comment, not by the ledger
    uint32_t map_line = 1;             ///< of its pair in portmap.toml
    std::vector<std::string> details;  ///< what is missing on which side
};

/// Each pair counts once, at its worst.
struct Summary {
    size_t pairs = 0, in_step = 0, drifted = 0, review = 0, unported = 0, deferred = 0, ignored = 0;
};

/// A pair as the map and the lock name it today, for the commands that settle findings.
struct JudgedPair {
    BySide<std::string> id;              ///< in portmap.toml
    BySide<const UnitState*> unit = {};  ///< today's, if there
    uint32_t map_line = 1;               ///< where the pair stands in portmap.toml
    bool changed = false;
    bool equivalent = false;  ///< both sides changed alike
};

/// The part of the gate that a change touches, in the order of the names.
enum class GatePart : uint8_t { Accept, Defer, Dialect, Ignore, Pair, Rule, Sides, Suppression };
inline constexpr std::array<std::string_view, 8> kGatePartNames = {"accept", "defer", "dialect", "ignore",
                                                                   "pair",   "rule",  "sides",   "suppression"};
constexpr std::string_view gate_part_name(GatePart part) { return kGatePartNames.at(static_cast<size_t>(part)); }

/// Something that a change does to the gate itself, for a reviewer to see.
struct BroughtIn {
    GatePart kind = GatePart::Accept;
    std::string file;
    int line = 1;
    std::string text;
};

/// What the gate answers: nothing to act on, warnings alone, errors.
enum class GateResult : uint8_t { InStep, Review, Drift };
inline constexpr std::array<std::string_view, 3> kGateResultNames = {"in_step", "review", "drift"};
constexpr std::string_view gate_result_name(GateResult result) {
    return kGateResultNames.at(static_cast<size_t>(result));
}

struct Judgement {
    std::vector<Finding> findings;  ///< sorted by place
    Summary summary;
    std::vector<JudgedPair> pairs;      ///< in the order of the map
    std::vector<BroughtIn> brought_in;  ///< where a base was given
    GateResult result() const;          ///< by the worst finding that nothing settles
};

}  // namespace porttool
