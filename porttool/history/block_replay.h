// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "porttool/history/blob_facts_source.h"
#include "porttool/history/history.h"
#include "porttool/history/in_turn.h"
#include "porttool/measure/blocks.h"
#include "porttool/measure/passage_measure.h"

namespace porttool {

/// The files of both sides at one commit, path to blob.
using SideBlobs = BySide<std::map<std::string, std::string>>;

/// The figures of blocks from commit to commit, measured as `report` does. What a commit does not touch is known.
class BlockReplay {
public:
    /// All must outlive it; `map` and `tree` are looked at anew in each call.
    BlockReplay(BlobFactsSource& blobs, BlobCache& cache, const MapFile& map, const SideBlobs& tree)
        : blobs_(blobs), measurer_(cache), map_(map), tree_(tree) {}

    /// Finds out what the blocks take. To be called when the map, the pairs of files or the set of files has changed.
    void plan(const FilePairs& pairs);
    /// True if what the blocks take changes with the contents of files, too.
    bool follow_units() const { return plan_->blocks.name_units; }

    /// The blocks of the map, or without any in it one for each pair of files, named SOURCE=TARGET, and both sides as a
    /// whole. They are measured in another thread, while the caller goes on to the next commit.
    std::future<BlockFigures> figures();

private:
    struct Plan {
        Blocks blocks;
        Block everything;
    };
    /// A block with all that measuring it takes.
    struct Task {
        std::string name;
        BySide<PartedPassage> passages;
    };

    Task task_of(const Block& block) const;
    PartedPassage passage(const Block& block, Side side) const;
    MeasuredBlock measured(const Task& task, const metrics::LineWeights& weights);

    BlobFactsSource& blobs_;
    PassageMeasurer measurer_;  ///< only for the other thread
    const MapFile& map_;
    const SideBlobs& tree_;
    std::shared_ptr<const Plan> plan_ = std::make_shared<const Plan>();
    InTurn<BlockFigures> measuring_;
};

}  // namespace porttool
