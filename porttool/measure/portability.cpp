// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/portability.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "porttool/measure/rows.h"
#include "porttool/read/cannot_do.h"

namespace porttool {
namespace {

using FilesByPath = BySide<std::map<std::string, const ScannedFile*>>;

/// The lines of one side of a measurement, excerpts of one file together.
std::vector<FileLines> lines_by_file(const Passage& passage, const PassageSide& found) {
    std::map<std::string, std::pair<std::set<uint32_t>, std::set<uint32_t>>> lines_of;
    const std::vector<std::vector<CodeLine>> lines = measured_lines(passage, found);
    for (size_t i = 0; i < passage.size(); ++i) {
        auto& [code, shared] = lines_of[passage[i].file->path];
        for (const CodeLine& line : lines[i]) {
            code.insert(line.line);
            if (line.shared) shared.insert(line.line);
        }
    }
    const auto spans = [](const std::set<uint32_t>& set) { return spans_of({set.begin(), set.end()}); };
    std::vector<FileLines> out;
    for (const auto& [file, both] : lines_of) out.push_back({file, spans(both.first), spans(both.second)});
    return out;
}

/// Most tokens that blocks may take together, each counted as often as it is taken: these, some ten seconds of
/// measuring, or so many times what both sides have.
constexpr size_t kMostBlockTokens = 20'000'000, kMostTakenTimes = 8;

size_t tokens_of(const Passage& passage) {
    size_t count = 0;
    for (const Excerpt& excerpt : passage)
        count += excerpt.unit != nullptr ? excerpt.unit->tokens.end - excerpt.unit->tokens.first
                                         : excerpt.file->lexed.tokens.size();
    return count;
}

BlockReport measure_block(const Block& block, const BySide<Passage>& passages, const Dialect& dialect,
                          const metrics::LineWeights& weights) {
    BlockReport out{
        measured_block(block.name, measure_passages(passages.source, passages.target, dialect), weights), {}, {}, {}};
    for (const Side side : kBothSides) out.lines[side] = lines_by_file(passages[side], out.found[side]);
    return out;
}

/// Both sides, and the blocks with what was found of them, while lines are counted into them.
class Builder {
public:
    Builder(const PortabilityCase& facts, const Blocks& blocks) : blocks_(blocks.blocks), rows_(rows_of(facts)) {
        const Dialect dialect(facts.map.dialect);
        FilesByPath files;
        Block everything;
        for (const Side side : kBothSides)
            for (const ScannedFile& file : side == Side::Source ? facts.source : facts.target) {
                files[side][file.path] = &file;
                everything.takes[side][file.path];
            }
        out_.blocks_are_file_pairs = blocks.are_file_pairs;
        const BySide<Passage> all = passages_of(everything, files);
        const size_t most_tokens =
            std::max(kMostBlockTokens, kMostTakenTimes * (tokens_of(all.source) + tokens_of(all.target)));
        std::vector<BySide<Passage>> passages;
        size_t tokens = 0;
        for (const Block& block : blocks_) {
            note_takers(block, static_cast<int>(passages.size()));
            passages.push_back(passages_of(block, files));
            tokens += tokens_of(passages.back().source) + tokens_of(passages.back().target);
            if (tokens > most_tokens)
                throw CannotDo(
                    "its blocks (of portmap.toml, or else pairs of files) take the same code again and again, more "
                    "than " +
                    std::to_string(most_tokens) + " tokens together\nLet each block take code of its own");
        }
        for (size_t i = 0; i < blocks_.size(); ++i)
            out_.blocks.push_back(measure_block(blocks_[i], passages[i], dialect, facts.map.weights));
        out_.totals = measure_block(everything, all, dialect, facts.map.weights);
    }

    PortabilityReport run() {
        for (RowReport& row : rows_.rows)
            for (const Side side : kBothSides) {
                if (!row.sides[side]) continue;
                row.sides[side]->blocks = blocks_with(side, row.sides[side]->excerpt);
                row.sides[side]->block = smallest(row.sides[side]->blocks);
            }
        for (const Side side : kBothSides) count(side);
        out_.rows = std::move(rows_.rows);
        return std::move(out_);
    }

private:
    void note_takers(const Block& block, int number) {
        for (const Side side : kBothSides)
            for (const auto& [file, names] : block.takes[side]) {
                if (names.empty()) takers_[side][file].of_all.push_back(number);
                for (const std::string& name : names) takers_[side][file].of_unit[name].push_back(number);
            }
    }

    std::vector<int> blocks_with(Side side, const Excerpt& excerpt) const {
        std::vector<int> blocks;
        const auto takers = takers_[side].find(excerpt.file->path);
        if (takers == takers_[side].end()) return blocks;
        const auto& [of_all, of_unit] = takers->second;
        const auto named = excerpt.unit == nullptr ? of_unit.end() : of_unit.find(excerpt.unit->name);
        if (named == of_unit.end()) return of_all;
        std::merge(of_all.begin(), of_all.end(), named->second.begin(), named->second.end(),
                   std::back_inserter(blocks));
        return blocks;
    }

    BySide<Passage> passages_of(const Block& block, const FilesByPath& files) {
        BySide<Passage> passages;
        for (const Side side : kBothSides)
            passages[side] = passage_of(
                block.takes[side], [&](const std::string& path) -> const ScannedFile& { return *files[side].at(path); },
                units_);
        return passages;
    }

    int smallest(const std::vector<int>& blocks) const {
        const auto size = [&](int block) {
            const PassageMeasure& found = out_.blocks[block].found;
            return found.source.measure.lines + found.target.measure.lines;
        };
        const auto found =
            std::min_element(blocks.begin(), blocks.end(), [&](int a, int b) { return size(a) < size(b); });
        return found == blocks.end() ? -1 : *found;
    }

    /// Counts the code of a side in its rows and blocks. Every line is accounted for, once.
    void count(Side side) {
        std::vector<std::vector<uint32_t>> lines(rows_.rows.size());
        for (const PlacedCode& one : rows_.code[side]) {
            count_code(side, one);
            lines[one.row].insert(lines[one.row].end(), one.code.lines.begin(), one.code.lines.end());
        }
        for (size_t r = 0; r < lines.size(); ++r) {
            std::sort(lines[r].begin(), lines[r].end());
            if (rows_.rows[r].sides[side]) rows_.rows[r].sides[side]->code = spans_of(lines[r]);
        }
        const size_t parts = out_.totals.parts[side].total(), all = out_.totals.found[side].measure.lines;
        if (parts != all)
            throw std::logic_error("the lines of the " + std::string(side == Side::Source ? "source" : "target") +
                                   " do not add up: " + std::to_string(parts) + " accounted for, " +
                                   std::to_string(all) + " there");
    }

    void count_code(Side side, const PlacedCode& one) {
        RowReport& row = rows_.rows[one.row];
        const std::vector<uint32_t>& lines = one.code.lines;
        const std::vector<int> blocks = blocks_with(side, one.code.excerpt);
        row.sides[side]->lines += lines.size();
        out_.totals.parts[side].add(row.share, lines.size());
        for (const int block : blocks) out_.blocks[block].parts[side].add(row.share, lines.size());
        const int alone = smallest(blocks);
        LineCount& count = alone < 0 ? out_.in_no_block[side] : out_.blocks[alone].alone[side];
        const std::set<uint32_t>& shared =
            shared_lines(side, alone < 0 ? out_.totals : out_.blocks[alone], one.code.excerpt.file->path);
        count.lines += lines.size();
        count.shared += static_cast<size_t>(
            std::count_if(lines.begin(), lines.end(), [&](uint32_t line) { return shared.contains(line); }));
    }

    const std::set<uint32_t>& shared_lines(Side side, const BlockReport& block, const std::string& file) {
        const auto [found, is_new] = shared_[side].emplace(std::pair(&block, file), std::set<uint32_t>());
        if (!is_new) return found->second;
        for (const FileLines& lines : block.lines[side])
            if (lines.file == file)
                for (const LineSpan& span : lines.shared)
                    for (uint32_t line = span.first; line <= span.last; ++line) found->second.insert(line);
        return found->second;
    }

    /// The blocks that take a file, or a unit of it by its name, ascending.
    struct Takers {
        std::vector<int> of_all;
        std::unordered_map<std::string_view, std::vector<int>> of_unit;
    };

    const std::vector<Block>& blocks_;
    BySide<std::map<std::string_view, Takers>> takers_;  ///< by file
    UnitsByName units_;
    Rows rows_;
    BySide<std::map<std::pair<const BlockReport*, std::string>, std::set<uint32_t>>> shared_;
    PortabilityReport out_;
};

}  // namespace

Blocks blocks_of(const PortabilityCase& facts) {
    BySide<std::map<std::string, std::vector<std::string>>> names;
    BySide<SideFiles> files;
    for (const Side side : kBothSides) {
        for (const ScannedFile& file : side == Side::Source ? facts.source : facts.target) {
            files[side].paths.push_back(file.path);
            names[side][file.path] = unit_names(file);
        }
        files[side].units = [&of_file = names[side]](const std::string& path) { return of_file.at(path); };
    }
    FilePairs pairs;
    for (const JudgedPair& pair : facts.judgement.pairs)
        if (pair.unit.source != nullptr && pair.unit.target != nullptr)
            pairs.emplace(pair.unit.source->file, pair.unit.target->file);
    Blocks blocks = find_blocks(facts.map, files, pairs);
    blocks.error = error_of(blocks, files);
    return blocks;
}

PortabilityReport portability_report(const PortabilityCase& facts, const Blocks& blocks) {
    return Builder(facts, blocks).run();
}

}  // namespace porttool
