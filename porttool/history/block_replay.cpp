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
    const PassageMeasure& found =
        measurer_.measure(block.name, passage(block, Side::Source), passage(block, Side::Target));
    return measured_block(block.name, found, map_.weights);
}

PartedPassage BlockReplay::passage(const Block& block, Side side) {
    PartedPassage out;
    for (const auto& [path, names] : block.takes[side]) {
        const FileVersion file{path, tree_[side].at(path)};
        std::string contents = version_key(file) + "\n";
        for (const std::string& name : names) contents += " " + name + "\n";
        out.push_back({path, std::move(contents), [this, file, &names] { return passage_of_file(file, names); }});
    }
    return out;
}

Passage BlockReplay::passage_of_file(const FileVersion& file, const std::set<std::string>& names) {
    return passage_of({{file.path, names}},
                      [&](const std::string&) -> const ScannedFile& { return blobs_.scanned(file); });
}

}  // namespace porttool
