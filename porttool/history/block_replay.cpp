// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/block_replay.h"

namespace porttool {

void BlockReplay::plan(const FilePairs& pairs) {
    BySide<SideFiles> files;
    auto plan = std::make_shared<Plan>();
    for (const Side side : kBothSides) {
        for (const auto& [path, blob] : tree_[side]) {
            files[side].paths.push_back(path);
            plan->everything.takes[side][path];
        }
        files[side].units = [this, side](const std::string& path) {
            std::vector<std::string> names;
            for (const UnitFacts& unit : blobs_.facts({path, tree_[side].at(path)}).units)
                if (unit.kind != UnitKind::File) names.push_back(unit.name);
            return names;
        };
    }
    plan->blocks = find_blocks(map_, files, pairs);  // a pattern that matches nothing then is no error now
    plan_ = std::move(plan);
}

std::future<BlockFigures> BlockReplay::figures() {
    std::vector<Task> blocks;
    for (const Block& block : plan_->blocks.blocks) blocks.push_back(task_of(block));
    return measuring_.add([this, rows = map_.dialect, weights = map_.weights, blocks = std::move(blocks),
                           all = task_of(plan_->everything)] {
        measurer_.use_dialect(rows);
        BlockFigures out;
        for (const Task& block : blocks) {
            out.blocks.push_back(measured(block, weights));
            out.contents.push_back(
                BlobCache::key({contents_of(block.passages.source), contents_of(block.passages.target)}));
        }
        out.totals = measured(all, weights);
        return out;
    });
}

BlockReplay::Task BlockReplay::task_of(const Block& block) const {
    return {block.name, {passage(block, Side::Source), passage(block, Side::Target)}};
}

MeasuredBlock BlockReplay::measured(const Task& task, const metrics::LineWeights& weights) {
    const PassageMeasure& found = measurer_.measure(task.name, task.passages.source, task.passages.target);
    return measured_block(task.name, found, weights);
}

/// Each part holds on to its file where that is at hand: the walk may be commits ahead when it is measured.
PartedPassage BlockReplay::passage(const Block& block, Side side) const {
    PartedPassage out;
    for (const auto& [path, names] : block.takes[side]) {
        const FileVersion version{path, tree_[side].at(path)};
        std::string contents = version_key(version) + "\n";
        for (const std::string& name : names) contents += " " + name + "\n";
        auto read = [&blobs = blobs_, plan = plan_, version, &names, file = blobs_.kept(version)]() {
            PartText text{file ? file : blobs.scanned(version), {}};
            UnitsByName units;
            text.passage = passage_of(
                {{version.path, names}}, [&](const std::string&) -> const ScannedFile& { return *text.file; }, units);
            return text;
        };
        out.push_back({path, std::move(contents), std::move(read)});
    }
    return out;
}

}  // namespace porttool
