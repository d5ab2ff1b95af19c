// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/block_replay.h"

namespace porttool {

void BlockReplay::plan(const FilePairs& pairs) {
    BySide<SideFiles> files;
    everything_ = {};
    for (const Side side : kBothSides) {
        for (const auto& [path, blob] : tree_[side]) {
            files[side].paths.push_back(path);
            everything_.takes[side][path];
        }
        files[side].units = [this, side](const std::string& path) {
            std::vector<std::string> names;
            for (const UnitFacts& unit : blobs_.facts({path, tree_[side].at(path)}).units)
                if (unit.kind != UnitKind::File) names.push_back(unit.name);
            return names;
        };
    }
    blocks_ = find_blocks(map_, files, pairs);  // a pattern that matches nothing then is no error now
}

std::vector<MeasuredBlock> BlockReplay::blocks() {
    std::vector<MeasuredBlock> out;
    for (const Block& block : blocks_.blocks) out.push_back(point_of(block));
    return out;
}

MeasuredBlock BlockReplay::point_of(const Block& block) {
    const PassageMeasure& found = measurer_.measure(passage(block, Side::Source), passage(block, Side::Target));
    return measured_block(block.name, found, map_.weights);
}

NamedPassage BlockReplay::passage(const Block& block, Side side) {
    const Selection& takes = block.takes[side];
    std::string contents;
    for (const auto& [path, names] : takes) {
        contents += version_key({path, tree_[side].at(path)}) + "\n";
        for (const std::string& name : names) contents += " " + name + "\n";
    }
    const auto file_at = [this, side](const std::string& path) -> const ScannedFile& {
        return blobs_.scanned({path, tree_[side].at(path)});
    };
    return {std::move(contents), [&takes, file_at] { return passage_of(takes, file_at); }};
}

}  // namespace porttool
