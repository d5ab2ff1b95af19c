// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "porttool/history/history.h"

namespace porttool {

/// Spearman's rank correlation of two lists of one length; equal values share the mean of their ranks. None below three
/// values, or where one list has only one.
std::optional<double> rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

/// Counts in how many commits each block was touched.
class ChurnCount {
public:
    /// Takes in a commit, oldest first.
    void add(const BlockFigures& figures);
    /// Of blocks of the newest commit.
    std::vector<BlockChurn> of(const std::vector<MeasuredBlock>& blocks) const;

private:
    std::map<std::string, std::string> last_;  ///< contents by block
    std::map<std::string, size_t> commits_;
};

/// Whether the blocks that change most are the ones that are alike: over those whose likeness could be measured.
std::optional<double> churn_and_likeness(const std::vector<BlockChurn>& churn,
                                         const std::vector<MeasuredBlock>& blocks);

}  // namespace porttool
