// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "porttool/measure/ledger.h"
#include "porttool/measure/performance.h"
#include "porttool/measure/portability.h"
#include "porttool/measure/target_matrix.h"

namespace porttool {

/// The report at the merge base, to show changes against.
struct BaseReport {
    std::string revision;
    PortabilityReport report;
    std::optional<Summary> drift;  ///< none where nothing was recorded then
};

/// All that `porttool report` prints, whatever the format.
struct WholeReport {
    const MapFile& map;
    const PortabilityReport& report;
    const Judgement& judgement;
    DriftLedger ledger;
    std::string today;
    std::optional<BaseReport> base;
    Performance performance;
    TargetMatrix matrix;
    bool is_recorded = true;  ///< false: there is no portmap.lock, so nothing is said about drift
};

/// How the figures of a block changed; those that one of the two has not stay absent.
struct BlockChange {
    BySide<std::optional<double>> lines, shared, moss;
    std::optional<double> degree;
};
BlockChange change_of(const BlockReport& now, const BlockReport& then);

/// The block of that name, or nullptr.
const BlockReport* find_block(const std::vector<BlockReport>& blocks, const std::string& name);

/// The figures of a block, which history has as well: its name, lines, shared lines, percentages and degree.
nlohmann::ordered_json measured_block_json(const MeasuredBlock& block);

/// The parts of a block by what its lines are, and the lines of each file that were counted.
void add_details(nlohmann::ordered_json& out, const BlockReport& block);

/// As the contract has it, with every figure's lines.
nlohmann::ordered_json portability_json(const WholeReport& whole);

}  // namespace porttool
