// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/block_figures.h"

#include <algorithm>

#include "porttool/measure/port_cost.h"
#include "porttool/read/glob.h"

namespace porttool {
namespace {

constexpr double kPercent = 100;

}  // namespace

void BlockFigures::plan(const FilePairs& pairs) {
    links_ = {};
    for (const auto& [left, right] : pairs) {
        links_[0][left].insert(right);
        links_[1][right].insert(left);
    }
    blocks_.clear();
    for (const MapBlock& block : map_.blocks) blocks_.push_back(plan_of(block));
    if (map_.blocks.empty())
        for (const auto& [left, right] : pairs) {
            Plan block;
            block.name = left + "=" + right;
            block.sides = {Selection{{left, {}}}, Selection{{right, {}}}};
            blocks_.push_back(std::move(block));
        }
    everything_ = {};
    for (size_t side = 0; side < 2; ++side)
        for (const auto& [path, blob] : files_[side]) everything_.sides[side][path];
}

/// A pattern takes the files that it matches, or, where it matches none, the units whose ids it matches.
BlockFigures::Plan BlockFigures::plan_of(const MapBlock& block) {
    Plan out;
    out.name = block.name;
    const std::array<const std::vector<std::string>*, 2> patterns = {&block.source, &block.target};
    for (size_t side = 0; side < 2; ++side)
        for (const std::string& text : *patterns[side]) {
            const Glob pattern(text);
            bool any = false;
            for (const auto& [path, blob] : files_[side]) {
                if (!pattern.matches(path) && text != path + ":@file") continue;
                out.sides[side][path] = {};
                any = true;
            }
            if (any) continue;
            out.names_units = true;
            for (const auto& [path, blob] : files_[side]) select_units(out.sides[side], side, path, text);
        }
    return out;
}

void BlockFigures::select_units(Selection& selection, size_t side, const std::string& path, const std::string& text) {
    const auto there = selection.find(path);
    if (there != selection.end() && there->second.empty()) return;  // all of it, already
    const Glob pattern(text);
    for (const UnitFacts& unit : blobs_.facts(version(side, path)).units) {
        const std::string id = path + ":" + unit.name;
        if (unit.kind == UnitKind::File || (id != text && !pattern.matches(id))) continue;
        std::vector<std::string>& names = selection[path];
        if (std::find(names.begin(), names.end(), unit.name) == names.end()) names.push_back(unit.name);
    }
}

/// Blocks of units follow the units that come and go within their files.
void BlockFigures::touch(const Paths& touched) {
    if (touched.empty()) return;
    for (size_t i = 0; i < blocks_.size(); ++i) {
        Plan& block = blocks_[i];
        if (block.names_units && i < map_.blocks.size() && !block.touched) block = plan_of(map_.blocks[i]);
        for (const std::string& path : touched)
            block.touched |= block.sides[0].contains(path) || block.sides[1].contains(path);
    }
}

BlockPoint BlockFigures::figures_of(const Plan& block) {
    BlockPoint point;
    point.name = block.name;
    const std::array<SideFigures, 2> found = {side_figures(block, 0), side_figures(block, 1)};
    point.sides = {found[0].all, found[1].all};
    point.too_short = found[0].too_short || found[1].too_short;
    if (point.sides[0].lines > 0 && !point.too_short)
        point.degree = degree_of_portability(found[1].counted, map_.weights);
    return point;
}

BlockFigures::FileShare BlockFigures::share_of(const Plan& block, size_t side, const std::string& path,
                                               const std::vector<std::string>& units) {
    FileShare out;
    const BlobFacts& facts = blobs_.facts(version(side, path));
    out.lines = facts.lines;
    out.tokens = facts.tokens;
    if (!units.empty()) {
        out.lines = 0;
        for (const UnitFacts& unit : facts.units)
            if (std::find(units.begin(), units.end(), unit.name) != units.end()) out.lines += unit.lines;
        // Until it is measured: its part of the file's.
        out.tokens = facts.lines > 0 ? static_cast<uint32_t>(uint64_t{facts.tokens} * out.lines / facts.lines) : 0;
    }
    const auto links = links_[side].find(path);
    if (links == links_[side].end()) return out;
    for (const std::string& other : links->second) {
        const auto piece = block.sides[1 - side].find(other);
        if (piece == block.sides[1 - side].end()) continue;
        const BlobFactsSource::Piece here{version(side, path), units}, there{version(1 - side, other), piece->second};
        const PieceMeasure& both = side == 0 ? blobs_.measure(here, there) : blobs_.measure(there, here);
        add_measure(side == 0 ? both.source : both.target, out);
        out.too_short = !out.measured && both.source.measure.lines > 0 && both.target.measure.lines > 0;
    }
    return out;
}

void BlockFigures::add_measure(const PieceSide& piece, FileShare& out) {
    const SideMeasure& measure = piece.measure;
    out.lines = measure.lines;
    out.tokens = measure.tokens;
    out.shared.resize(measure.lines);
    for (size_t i = 0; i < piece.shared.size() && i < out.shared.size(); ++i)
        if (piece.shared[i]) out.shared[i] = true;
    if (!measure.moss_percent) return;
    out.measured = true;
    const auto covered = [&](const std::optional<double>& percent) {
        return measure.tokens * percent.value_or(0) / kPercent;
    };
    out.kept = std::max(out.kept, covered(measure.moss_percent));
    out.raw = std::max(out.raw, covered(measure.moss_percent_raw));
    out.blind = std::max(out.blind, covered(measure.moss_percent_blind));
}

BlockFigures::SideFigures BlockFigures::side_figures(const Plan& block, size_t side) {
    SideFigures figures;
    SideMeasure &all = figures.all, &out = figures.counted;
    double kept = 0, raw = 0, blind = 0;
    bool measured = false;
    for (const auto& [path, units] : block.sides[side]) {
        const FileShare share = share_of(block, side, path, units);
        all.lines += share.lines;
        all.tokens += share.tokens;
        if (share.too_short) continue;  // neither shared nor novel
        out.lines += share.lines;
        out.tokens += share.tokens;
        out.shared_lines += static_cast<uint32_t>(std::count(share.shared.begin(), share.shared.end(), true));
        kept += share.kept;
        raw += share.raw;
        blind += share.blind;
        measured |= share.measured;
    }
    figures.too_short = all.lines > 0 && out.lines == 0;
    all.shared_lines = out.shared_lines;
    if (!measured || out.tokens == 0) return figures;
    out.moss_percent = kPercent * kept / out.tokens;
    out.moss_percent_raw = kPercent * raw / out.tokens;
    out.moss_percent_blind = kPercent * blind / out.tokens;
    all.moss_percent = out.moss_percent;
    all.moss_percent_raw = out.moss_percent_raw;
    all.moss_percent_blind = out.moss_percent_blind;
    return figures;
}

std::vector<BlockPoint> BlockFigures::blocks() {
    std::vector<BlockPoint> out;
    for (Plan& block : blocks_) {
        if (block.touched) block.point = figures_of(block);
        block.touched = false;
        out.push_back(block.point);
    }
    return out;
}

}  // namespace porttool
