// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/history/blob_facts_source.h"
#include "porttool/measure/blocks.h"
#include "porttool/measure/passage_measure.h"

namespace porttool {

/// The files of both sides at one commit, path to blob.
using SideBlobs = BySide<std::map<std::string, std::string>>;

/// The figures of blocks from commit to commit, measured as `report` does. What a commit does not touch is known.
class BlockReplay {
public:
    /// All must outlive it; `map` and `tree` are looked at anew in each call.
    BlockReplay(BlobFactsSource& blobs, PassageMeasurer& measurer, const MapFile& map, const SideBlobs& tree)
        : blobs_(blobs), measurer_(measurer), map_(map), tree_(tree) {}

    /// Finds out what the blocks take. To be called when the map, the pairs of files or the set of files has changed.
    void plan(const FilePairs& pairs);
    /// True if what the blocks take changes with the contents of files, too.
    bool follow_units() const { return blocks_.name_units; }

    /// The blocks of the map; without any in it, one for each pair of files, named SOURCE=TARGET.
    std::vector<MeasuredBlock> blocks();
    /// Both sides as a whole.
    MeasuredBlock totals() { return point_of(everything_); }

private:
    MeasuredBlock point_of(const Block& block);
    PartedPassage passage(const Block& block, Side side);
    Passage passage_of_file(const FileVersion& file, const std::set<std::string>& names);

    BlobFactsSource& blobs_;
    PassageMeasurer& measurer_;
    const MapFile& map_;
    const SideBlobs& tree_;
    Blocks blocks_;
    Block everything_;
};

}  // namespace porttool
