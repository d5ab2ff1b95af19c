// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/judge/renamed_names.h"
#include "porttool/normal/units_by_id.h"
#include "porttool/read/evidence_file.h"
#include "porttool/read/lock_file.h"
#include "porttool/read/map_file.h"
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

/// What programs saw of a finding: an input, a kernel of a picture, or both.
struct FindingEvidence {
    std::string example_json;          ///< a counterexample of difftest; "" for none
    std::optional<SeenKernel> kernel;  ///< in which the pictures part
    std::string folder;                ///< where its pictures lie
};

struct Finding {
    Rule rule = Rule::SourceChanged;
    Level level = Level::Error;
    std::optional<ChangeKind> change;
    std::optional<Place> source, target;
    std::string message, remedy;
    std::string map_source, map_target;  ///< the ids of its pair in portmap.toml; outside pairs its subject and ""
    Side side = Side::Source;            ///< outside pairs: of the unit that it is about
    std::string target_set;              ///< the port that it is about, where [sides.targets] names several
    std::string fingerprint;  ///< stable: of the rule, the ids, and the subject where a rule finds several on one pair
    std::optional<Verdict> verdict;  ///< Defer or Ignore where a person settled it
    std::string verdict_reason;
    bool settled_in_source = false;                   ///< by a comment, not by the ledger
    uint32_t map_line = 1;                            ///< of its pair in portmap.toml
    std::vector<std::string> details;                 ///< what is missing on which side
    std::vector<std::string> causes;                  ///< what others may have in common with it, to be told once
    std::shared_ptr<const FindingEvidence> evidence;  ///< mostly none, and larger than the rest of a finding
};

/// The cause of an edit that only adds other texts for a macro begins so.
inline constexpr std::string_view kBuiltWith = "built with ";

/// The cause of an edit of which it is in doubt that the other side owes it.
inline constexpr std::string_view kInDoubt = "in doubt";
inline bool is_in_doubt(const Finding& finding) {
    return !finding.causes.empty() && finding.causes.front() == kInDoubt;
}

/// True for a finding that is to be acted on: its rule is not off, and nobody has settled it.
inline bool is_open(const Finding& finding) { return finding.level != Level::Off && !finding.verdict; }

/// How a pair stands, by the worst finding that nothing settles, or by what settles all of them.
enum class PairStanding : uint8_t { InStep, Review, Drifted, Deferred, Ignored };
inline constexpr std::array<std::string_view, 5> kPairStandingNames = {"in_step", "review", "drifted", "deferred",
                                                                       "ignored"};
constexpr std::string_view pair_standing_name(PairStanding standing) {
    return kPairStandingNames.at(static_cast<size_t>(standing));
}

/// Each pair counts once, at its worst.
struct Summary {
    size_t pairs = 0, in_step = 0, drifted = 0, review = 0, deferred = 0, ignored = 0;
    size_t recorded = 0;          ///< of the pairs: as in step, by init or without a look at each
    size_t verified = 0;          ///< of the pairs: compared by a person or a program when they were recorded
    size_t units = 0;             ///< of the reference's side
    size_t unported = 0;          ///< of these, outside the pairs
    size_t unpaired = 0;          ///< of these, without anybody having said why: nothing watches them
    size_t unpaired_changed = 0;  ///< of these, new or edited since they were recorded
};

/// A pair as the map and the lock name it today, for the commands that settle findings.
struct JudgedPair {
    BySide<std::string> id;              ///< in portmap.toml
    BySide<const UnitState*> unit = {};  ///< today's, if there
    uint32_t map_line = 1;               ///< where the pair stands in portmap.toml
    bool changed = false;
    bool equivalent = false;      ///< both sides changed alike
    bool is_of_own_part = false;  ///< one side alone changed, in what the other has nothing like
    std::string macro_edit = {};  ///< how macros changed what its words say: equal for pairs that one look settles
    PairStanding standing = PairStanding::InStep;
};

/// A unit that no pair leads to, on a side that is the contract.
struct LoneUnit {
    Side side = Side::Source;
    const UnitState* unit = nullptr;
    /// Why it needs no counterpart: the baseline, or what a person said; nullptr for no excuse. Many share one.
    std::shared_ptr<const std::string> excuse;
    std::optional<size_t> line;  ///< of the lock's baseline: the one that excuses it
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

/// What programs that ran both sides saw of a project, for its judgement.
struct RunEvidence {
    std::set<std::pair<std::string, std::string>> same;  ///< pairs of the map, source and target
    /// Differences that no finding explains, with what is said of them: of pairs, and of kernels outside pairs.
    std::map<std::pair<std::string, std::string>, std::string> pairs;
    std::map<std::string, std::string> kernels;
};

struct Judgement {
    std::vector<Finding> findings;  ///< sorted by place
    Summary summary;
    Reference reference = Reference::Source;
    std::vector<JudgedPair> pairs;      ///< in the order of the map
    std::vector<LoneUnit> lone;         ///< by side, then id
    std::vector<BroughtIn> brought_in;  ///< where a base was given
    BySide<RenamedNames> renamed;       ///< of units that pairs lead to
    GateResult result() const;          ///< by the worst finding that nothing settles
};

}  // namespace porttool
