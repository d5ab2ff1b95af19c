// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/blob_facts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <sstream>

#include "porttool/measure/code_lines.h"
#include "porttool/normal/diff.h"
#include "porttool/normal/statements.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

UnitFacts unit_facts(const ScannedFile& file, const Unit& unit, const Excerpt& excerpt) {
    return {unit.name, unit.kind, static_cast<uint32_t>(code_lines(excerpt).size()), unit_state(file, unit).prints};
}

std::vector<std::string> split_lines(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

/// The edit of one side: how many lines it touched, and the tokens that it gained ("+word") and lost ("-word") in the
/// common vocabulary, sorted. What stays within an edited line is no part of the edit.
struct SideEdit {
    uint32_t size = 0;
    std::vector<std::string> changed;
};

void add_words(const std::string& line, const Dialect& dialect, std::vector<std::string>& out) {
    for (const Statement& statement : split_statements(NormalText::read(line).words(), dialect))
        if (statement.key != "}") out.insert(out.end(), statement.common.begin(), statement.common.end());
}

void add_changed_words(const std::vector<std::string>& lost, const std::vector<std::string>& gained,
                       std::vector<std::string>& out) {
    for (const DiffStep& step : diff(lost, gained)) {
        if (step.kind == DiffStep::Remove) out.push_back("-" + lost[step.before]);
        if (step.kind == DiffStep::Add) out.push_back("+" + gained[step.now]);
    }
}

SideEdit side_edit(const PairedUnit& unit, const Dialect& dialect) {
    SideEdit out;
    const std::vector<std::string> old_lines = split_lines(unit.before.recorded()),
                                   new_lines = split_lines(unit.now.recorded());
    std::vector<std::string> lost, gained;  // by the lines that were replaced in one place
    const auto end_of_place = [&] {
        add_changed_words(lost, gained, out.changed);
        lost.clear();
        gained.clear();
    };
    for (const DiffStep& step : diff(old_lines, new_lines)) {
        if (step.kind == DiffStep::Keep) {
            end_of_place();
            continue;
        }
        ++out.size;
        if (step.kind == DiffStep::Remove)
            add_words(old_lines[step.before], dialect, lost);
        else
            add_words(new_lines[step.now], dialect, gained);
    }
    end_of_place();
    std::sort(out.changed.begin(), out.changed.end());
    return out;
}

double overlap(const std::vector<std::string>& a, const std::vector<std::string>& b) {
    if (a.empty() || b.empty()) return 0;
    std::vector<std::string> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return 2.0 * static_cast<double>(both.size()) / static_cast<double>(a.size() + b.size());
}

constexpr char kBetweenUnits = '\x1e';

/// Names come from foreign files: what separates entries is no part of them.
std::string plain_name(std::string name) {
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '\n' || c == kBetweenUnits; }, ' ');
    return name;
}

void sort_names(BlobFacts& facts) {
    facts.by_name.resize(facts.units.size());
    std::iota(facts.by_name.begin(), facts.by_name.end(), 0u);
    std::stable_sort(facts.by_name.begin(), facts.by_name.end(),
                     [&](uint32_t a, uint32_t b) { return facts.units[a].name < facts.units[b].name; });
}

}  // namespace

const UnitFacts* BlobFacts::find(std::string_view name) const {
    const auto found = std::lower_bound(by_name.begin(), by_name.end(), name,
                                        [&](uint32_t place, std::string_view n) { return units[place].name < n; });
    return found == by_name.end() || units[*found].name != name ? nullptr : &units[*found];
}

BlobFacts blob_facts(const ScannedFile& file) {
    BlobFacts facts;
    for (const Unit& unit : file.units) facts.units.push_back(unit_facts(file, unit, {&file, &unit}));
    facts.units.push_back(unit_facts(file, whole_file_unit(file), {&file, nullptr}));
    facts.lines = facts.units.back().lines;
    sort_names(facts);
    return facts;
}

EditFacts edit_facts(const BySide<PairedUnit>& pair, const Dialect& dialect, CompareBudget& budget) {
    const PairComparison found = compare_pair(pair, dialect, budget);
    const SideEdit source = side_edit(pair.source, dialect), target = side_edit(pair.target, dialect);
    EditFacts facts;
    facts.in_step = found.standing <= Standing::CaughtUp;
    facts.similarity = overlap(source.changed, target.changed);
    facts.source_size = source.size;
    facts.target_size = target.size;
    facts.size = found.size;
    facts.refused = !found.not_compared.empty();
    return facts;
}

std::string facts_line(const BlobFacts& facts) {
    std::string out = std::to_string(facts.lines);
    for (const UnitFacts& unit : facts.units)
        out += fmt::format("{}{} {} {} {} {} {}", kBetweenUnits, static_cast<int>(unit.kind), unit.lines,
                           unit.prints.written.text(), unit.prints.renamed.text(), unit.prints.blanked.text(),
                           plain_name(unit.name));
    return out;
}

std::optional<BlobFacts> read_blob_facts(const std::string& line) {
    BlobFacts facts;
    std::istringstream head(line.substr(0, line.find(kBetweenUnits)));
    if (!(head >> facts.lines)) return std::nullopt;
    for (size_t at = line.find(kBetweenUnits); at != std::string::npos;) {
        const size_t end = line.find(kBetweenUnits, at + 1);
        std::istringstream stream(line.substr(at + 1, end == std::string::npos ? end : end - at - 1));
        UnitFacts unit;
        int kind = 0;
        std::array<std::string, 3> prints;
        if (!(stream >> kind >> unit.lines >> prints[0] >> prints[1] >> prints[2]) || kind < 0 ||
            kind > static_cast<int>(UnitKind::File))
            return std::nullopt;
        unit.prints = {Print::read(prints[0]), Print::read(prints[1]), Print::read(prints[2])};
        stream.get();
        std::getline(stream, unit.name);
        unit.kind = static_cast<UnitKind>(kind);
        facts.units.push_back(std::move(unit));
        at = end;
    }
    sort_names(facts);
    return facts;
}

std::string facts_line(const EditFacts& facts) {
    return fmt::format("{} {} {} {} {} {}", facts.in_step ? 1 : 0, facts.similarity, facts.source_size,
                       facts.target_size, facts.size.longest, facts.size.sum);
}

std::optional<EditFacts> read_edit_facts(const std::string& line) {
    EditFacts facts;
    std::istringstream stream(line);
    if (!(stream >> facts.in_step >> facts.similarity >> facts.source_size >> facts.target_size >> facts.size.longest >>
          facts.size.sum))
        return std::nullopt;
    return facts;
}

}  // namespace porttool
