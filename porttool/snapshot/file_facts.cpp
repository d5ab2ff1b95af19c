// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/file_facts.h"

#include <utility>

#include "porttool/scan/scan.h"
#include "porttool/snapshot/merge_marks.h"
#include "porttool/text/packed_bytes.h"
#include "porttool/text/text_numbers.h"

namespace porttool {
namespace {

void pack_units(ByteWriter& out, const std::vector<UnitState>& states) {
    TextNumbers numbers;
    std::vector<uint32_t> names, ends;  // of all units, and where those of each end
    std::vector<size_t> last_of;        // the last unit that has a name, counted from 1
    for (size_t i = 0; i < states.size(); ++i) {
        states[i].text.each_name([&](std::string_view name) {
            const auto number = static_cast<uint32_t>(numbers.number(name));
            if (number >= last_of.size()) last_of.resize(number + size_t{1});
            if (std::exchange(last_of[number], i + 1) != i + 1) names.push_back(number);
        });
        ends.push_back(static_cast<uint32_t>(names.size()));
    }
    out.number(static_cast<uint32_t>(numbers.size()));
    for (uint32_t i = 0; i < numbers.size(); ++i) out.text(numbers.text(i));
    out.number(static_cast<uint32_t>(states.size()));
    for (size_t i = 0; i < states.size(); ++i) {
        const UnitState& state = states[i];
        out.text(state.name);
        out.number(state.kind);
        out.number(state.start_line);
        out.number(state.end_line);
        for (const Print print : {state.prints.written, state.prints.renamed, state.prints.blanked})
            out.number(print.bits());
        out.number(static_cast<uint32_t>(state.text.size()));
        const uint32_t first = i == 0 ? 0 : ends[i - 1];
        out.number(ends[i] - first);
        for (uint32_t at = first; at < ends[i]; ++at) out.number(names[at]);
    }
}

/// Comments of one line share their list of units, which stands once.
void pack_suppressions(ByteWriter& out, const std::vector<Suppression>& suppressions) {
    out.number(static_cast<uint32_t>(suppressions.size()));
    const std::vector<std::string>* last = nullptr;
    for (const Suppression& comment : suppressions) {
        out.text(comment.rule);
        out.text(comment.reason);
        out.number(comment.line);
        const bool is_new = comment.units.get() != last;
        out.number<uint8_t>(is_new);
        if (!is_new) continue;
        last = comment.units.get();
        out.number(static_cast<uint32_t>(last->size()));
        for (const std::string& unit : *last) out.text(unit);
    }
}

/// A count of things that take at least so many bytes each: a false one makes the reader unsound, not large.
uint32_t count(ByteReader& in, size_t least_bytes) {
    const auto count = in.number<uint32_t>();
    if (count > in.left() / least_bytes) in.take(in.left() + uint64_t{1});
    return in.sound() ? count : 0;
}

KnownUnit read_unit(ByteReader& in) {
    KnownUnit unit;
    unit.name = in.text();
    unit.kind = in.number<UnitKind>();
    if (unit.kind > UnitKind::File) in.take(in.left() + uint64_t{1});
    unit.start_line = in.number<uint32_t>();
    unit.end_line = in.number<uint32_t>();
    for (Print* print : {&unit.prints.written, &unit.prints.renamed, &unit.prints.blanked})
        *print = Print(in.number<uint64_t>());
    unit.words = in.number<uint32_t>();
    return unit;
}

/// Passes the units, which have places of so many names. Returns where each begins.
std::vector<uint32_t> places_of_units(ByteReader& in, std::string_view bytes, size_t names) {
    std::vector<uint32_t> units(count(in, 8 * sizeof(uint32_t)));
    for (uint32_t& unit : units) {
        unit = static_cast<uint32_t>(bytes.size() - in.left());
        read_unit(in);
        for (uint32_t left = count(in, sizeof(uint32_t)); left > 0; --left)
            if (in.number<uint32_t>() >= names) in.take(in.left() + uint64_t{1});
    }
    return units;
}

void pass_macros(ByteReader& in) {
    for (uint32_t left = count(in, 2 * sizeof(uint64_t)); left > 0; --left) {
        in.text();
        in.text();
        in.number<uint32_t>();
    }
}

std::vector<MacroLine> read_macros(ByteReader& in) {
    std::vector<MacroLine> macros(count(in, 2 * sizeof(uint64_t)));
    for (MacroLine& line : macros) {
        line.word = in.text();
        line.text = in.text();
        line.line = in.number<uint32_t>();
    }
    return macros;
}

std::vector<Suppression> read_suppressions(ByteReader& in) {
    std::vector<Suppression> comments(count(in, 2 * sizeof(uint64_t)));
    auto last = std::make_shared<const std::vector<std::string>>();
    for (Suppression& comment : comments) {
        comment.rule = in.text();
        comment.reason = in.text();
        comment.line = in.number<uint32_t>();
        if (in.number<uint8_t>() != 0) {
            std::vector<std::string> units(count(in, sizeof(uint64_t)));
            for (std::string& unit : units) unit = in.text();
            last = std::make_shared<const std::vector<std::string>>(std::move(units));
        }
        comment.units = last;
    }
    return comments;
}

}  // namespace

void visit_states(const ScannedFile& file, bool with_whole, const std::function<void(UnitState)>& visit) {
    for (const Unit& unit : file.units) visit(unit_state(file, unit));
    if (file.units.empty() || with_whole) visit(unit_state(file, whole_file_unit(file)));
}

std::vector<UnitState> states_of(const ScannedFile& file, bool with_whole) {
    std::vector<UnitState> out;
    out.reserve(file.units.size() + 1);
    visit_states(file, with_whole, [&](UnitState state) { out.push_back(std::move(state)); });
    return out;
}

UnitState state_of(const ScannedFile& file, uint32_t unit) {
    return unit_state(file, unit < file.units.size() ? file.units[unit] : whole_file_unit(file));
}

std::string FileFacts::pack(const ScannedFile& file, const std::vector<UnitState>& states) {
    std::string bytes;
    ByteWriter out(bytes);
    out.number<uint64_t>(file.lexed.tokens.size());
    out.number(porttool::unfinished_merge(file.lexed.text).value_or(0));
    pack_units(out, states);
    pack_suppressions(out, file.lexed.suppressions);
    const FileMacros macros = file_macros(file);
    out.number(static_cast<uint32_t>(macros.lines.size()));
    for (const MacroLine& line : macros.lines) {
        out.text(line.word);
        out.text(line.text);
        out.number(line.line);
    }
    out.number(static_cast<uint32_t>(macros.includes.size()));
    for (const std::string& name : macros.includes) out.text(name);
    return bytes;
}

std::optional<FileFacts> FileFacts::read(std::shared_ptr<const std::string> owner, std::string_view bytes) {
    FileFacts facts;
    facts.owner_ = std::move(owner);
    facts.bytes_ = bytes;
    if (bytes.size() > UINT32_MAX) return std::nullopt;  // no file that is read has so much
    ByteReader in(bytes);
    facts.tokens_ = in.number<uint64_t>();
    if (const auto line = in.number<uint32_t>(); line > 0) facts.unfinished_merge_ = line;
    facts.names_.resize(count(in, sizeof(uint64_t)));
    for (std::string_view& name : facts.names_) name = in.text();
    facts.units_ = places_of_units(in, bytes, facts.names_.size());
    facts.suppressions_ = read_suppressions(in);
    facts.macros_ = bytes.size() - in.left();
    pass_macros(in);
    facts.includes_.resize(count(in, sizeof(uint64_t)));
    for (std::string& name : facts.includes_) name = in.text();
    return in.sound() && in.at_end() ? std::optional(std::move(facts)) : std::nullopt;
}

KnownUnit FileFacts::unit(uint32_t i) const {
    ByteReader in(bytes_.substr(units_[i]));
    return read_unit(in);
}

void FileFacts::each_name(uint32_t unit, const std::function<void(std::string_view)>& visit) const {
    ByteReader in(bytes_.substr(units_[unit]));
    read_unit(in);
    for (auto left = in.number<uint32_t>(); left > 0; --left) visit(names_[in.number<uint32_t>()]);
}

std::vector<MacroLine> FileFacts::macros() const {
    ByteReader in(bytes_.substr(macros_));
    return read_macros(in);
}

}  // namespace porttool
