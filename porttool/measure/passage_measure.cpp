// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/measure/passage_measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "porttool/measure/port_cost.h"

namespace porttool {
namespace {

std::vector<bool> flags(const std::vector<std::vector<CodeLine>>& lines) {
    std::vector<bool> out;
    for (const auto& excerpt : lines)
        for (const CodeLine& line : excerpt) out.push_back(line.shared);
    return out;
}

std::string percent_text(const std::optional<double>& percent) { return percent ? fmt::format("{}", *percent) : "-"; }

std::optional<double> read_percent(const std::string& text) {
    if (text == "-") return std::nullopt;
    return std::strtod(text.c_str(), nullptr);
}

/// Four lines a hexadecimal digit, the first in the lowest bit.
std::string flags_text(const std::vector<bool>& flags) {
    std::string out = ".";
    for (size_t i = 0; i < flags.size(); i += 4) {
        unsigned digit = 0;
        for (size_t k = 0; k < 4 && i + k < flags.size(); ++k) digit |= (flags[i + k] ? 1u : 0u) << k;
        out += "0123456789abcdef"[digit];
    }
    return out;
}

std::vector<bool> read_flags(const std::string& text, size_t count) {
    std::vector<bool> out(count);
    for (size_t i = 0; i < count && 1 + i / 4 < text.size(); ++i) {
        const char c = text[1 + i / 4];
        const unsigned digit = static_cast<unsigned>(c <= '9' ? c - '0' : c - 'a' + 10);
        out[i] = (digit >> (i % 4) & 1u) != 0;
    }
    return out;
}

std::string side_line(const PassageSide& side) {
    const SideMeasure& m = side.measure;
    return fmt::format("{} {} {} {} {} {}", m.lines, m.tokens, percent_text(m.moss_percent),
                       percent_text(m.moss_percent_blind), percent_text(m.moss_percent_raw), flags_text(side.shared));
}

bool read_side(std::istringstream& stream, PassageSide& side) {
    std::string moss, blind, raw, shared;
    if (!(stream >> side.measure.lines >> side.measure.tokens >> moss >> blind >> raw >> shared)) return false;
    side.measure.moss_percent = read_percent(moss);
    side.measure.moss_percent_blind = read_percent(blind);
    side.measure.moss_percent_raw = read_percent(raw);
    side.shared = read_flags(shared, side.measure.lines);
    side.measure.shared_lines = static_cast<uint32_t>(std::count(side.shared.begin(), side.shared.end(), true));
    return true;
}

/// A passage read part by part.
struct WholePassage {
    explicit WholePassage(const PartedPassage& parted) {
        for (const PassagePart& part : parted) {
            PartText text = part.read();
            passage.insert(passage.end(), text.passage.begin(), text.passage.end());
            files.push_back(std::move(text.file));
        }
    }

    Passage passage;
    std::vector<std::shared_ptr<const ScannedFile>> files;
};

}  // namespace

std::string contents_of(const PartedPassage& passage) {
    std::string all;
    for (const PassagePart& part : passage) all += part.contents;
    return all;
}

PassageMeasure measure_passages(const Passage& source, const Passage& target, const Dialect& dialect) {
    const Similarity found = measure_shares(source, target, dialect);
    return {{found.a, flags(found.a_lines)}, {found.b, flags(found.b_lines)}};
}

bool MeasuredBlock::is_too_short() const {
    const SideMeasure &source = found.source.measure, &target = found.target.measure;
    return source.lines > 0 && target.lines > 0 && !target.moss_percent;
}

MeasuredBlock measured_block(const std::string& name, PassageMeasure found, const metrics::LineWeights& weights) {
    MeasuredBlock block{name, std::move(found), {}};
    const SideMeasure& port = block.found.target.measure;
    if (block.found.source.measure.lines > 0 && port.moss_percent) block.degree = degree_of_portability(port, weights);
    return block;
}

std::vector<std::vector<CodeLine>> measured_lines(const Passage& passage, const PassageSide& found) {
    std::vector<std::vector<CodeLine>> out(passage.size());
    size_t at = 0;
    for (size_t i = 0; i < passage.size(); ++i)
        for (const uint32_t line : code_lines(passage[i])) out[i].push_back({line, found.shared.at(at++)});
    return out;
}

void PassageMeasurer::use_dialect(const std::vector<std::pair<std::string, std::string>>& rows) {
    std::string text;
    for (const auto& [left, right] : rows) text += left + "=" + right + "\n";
    const std::string key = BlobCache::key({text});
    if (key == dialect_key_) return;
    dialect_key_ = key;
    dialect_ = Dialect(rows);
    trackers_.clear();
    parts_.emplace(dialect_);
}

const PassageMeasure& PassageMeasurer::measure(const std::string& name, const PartedPassage& source,
                                               const PartedPassage& target) {
    // Lines that another build kept are not read (BlobCache); "passages" keeps these apart from other entries.
    const std::string key = BlobCache::key({"passages", contents_of(source), contents_of(target), dialect_key_});
    if (const auto known = known_.find(key); known != known_.end()) return known->second;
    std::optional<PassageMeasure> measured;
    if (const std::string* line = cache_.find(key)) measured = read_passage_measure(*line);
    if (!measured) {
        measured = found(name, source, target);
        cache_.put(key, facts_line(*measured));
    }
    return known_.emplace(key, std::move(*measured)).first->second;
}

PassageMeasure PassageMeasurer::found(const std::string& name, const PartedPassage& source,
                                      const PartedPassage& target) {
    if (!parts_) parts_.emplace(dialect_);
    if (auto tracked = trackers_[name].measure({&source, &target}, *parts_)) return std::move(*tracked);
    return measure_passages(WholePassage(source).passage, WholePassage(target).passage, dialect_);
}

std::string facts_line(const PassageMeasure& measure) {
    return side_line(measure.source) + " " + side_line(measure.target);
}

std::optional<PassageMeasure> read_passage_measure(const std::string& line) {
    PassageMeasure measure;
    std::istringstream stream(line);
    if (!read_side(stream, measure.source) || !read_side(stream, measure.target)) return std::nullopt;
    return measure;
}

}  // namespace porttool
