// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/history/blob_facts_source.h"
#include "porttool/history/history.h"

namespace porttool {

using Paths = std::set<std::string>;

/// The files of both sides at one commit, path to blob; the source comes first.
using SideFiles = std::array<std::map<std::string, std::string>, 2>;

/// Pairs of files that hold at least one pair of units.
using FilePairs = std::set<std::pair<std::string, std::string>>;

/// The figures of blocks from commit to commit; what a commit does not touch is not measured again. Files are measured
/// pair by pair, against those that they hold pairs of units with.
class BlockFigures {
public:
    /// All three must outlive it; `map` and `files` are looked at anew in each call.
    BlockFigures(BlobFactsSource& blobs, const MapFile& map, const SideFiles& files)
        : blobs_(blobs), map_(map), files_(files) {}

    /// To be called when the map or the set of files has changed.
    void plan(const FilePairs& pairs);
    /// To be called with the files that a commit touched.
    void touch(const Paths& touched);

    /// The blocks of the map; without any in it, one for each pair of files, named SOURCE=TARGET.
    std::vector<BlockPoint> blocks();
    /// Both sides as a whole.
    BlockPoint totals() { return figures_of(everything_); }

private:
    /// What a block takes of each of its files: named units, or all of it if none is named.
    using Selection = std::map<std::string, std::vector<std::string>>;

    struct Plan {
        std::string name;
        std::array<Selection, 2> sides;
        bool names_units = false;  ///< what it takes depends on what the files hold
        bool touched = true;       ///< since its figures were last computed
        BlockPoint point;
    };

    /// What a file shares with those of the other side that it holds pairs with.
    struct FileShare {
        uint32_t lines = 0, tokens = 0;
        std::vector<bool> shared;
        double kept = 0, raw = 0, blind = 0;  ///< tokens in matches, by vocabulary
        bool measured = false;
        bool too_short = false;  ///< held against its counterparts, and nothing could be measured
    };

    /// A side of a block as it is, and without what is too short to be measured.
    struct SideFigures {
        SideMeasure all, counted;
        bool too_short = false;
    };

    Plan plan_of(const MapBlock& block);
    void select_units(Selection& selection, size_t side, const std::string& path, const std::string& pattern);
    BlockPoint figures_of(const Plan& block);
    SideFigures side_figures(const Plan& block, size_t side);
    FileShare share_of(const Plan& block, size_t side, const std::string& path, const std::vector<std::string>& units);
    static void add_measure(const PieceSide& piece, FileShare& out);
    FileVersion version(size_t side, const std::string& path) const { return {path, files_[side].at(path)}; }

    BlobFactsSource& blobs_;
    const MapFile& map_;
    const SideFiles& files_;
    std::array<std::map<std::string, Paths>, 2> links_;  ///< files with pairs between them
    std::vector<Plan> blocks_;
    Plan everything_;
};

}  // namespace porttool
