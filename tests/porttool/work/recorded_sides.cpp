// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "tests/porttool/work/recorded_sides.h"

#include "porttool/judge/new_words.h"
#include "porttool/normal/word_macros.h"
#include "porttool/scan/scan.h"

namespace porttool::testing {
namespace {

constexpr const char *kSourceFile = "s/a.cu", *kTargetFile = "t/a.cpp";

UnitsById states_of(const ScannedFile& file) {
    UnitsById out;
    for (const Unit& unit : file.units) out.add(unit_state(file, unit));
    if (file.units.empty()) out.add(unit_state(file, whole_file_unit(file)));
    return out;
}

BySide<std::vector<ScannedFile>> scanned(const std::string& source, const std::string& target) {
    BySide<std::vector<ScannedFile>> out;
    out.source.push_back(scan_text(kSourceFile, source));
    out.target.push_back(scan_text(kTargetFile, target));
    return out;
}

BySide<FilesOfSide> views_of(const BySide<std::vector<ScannedFile>>& files) {
    return {FilesOfSide(files.source), FilesOfSide(files.target)};
}

}  // namespace

RecordedSides::RecordedSides(const std::string& text)
    : files_(scanned(text, text)), states_{states_of(files_.source[0]), states_of(files_.target[0])} {
    WordMacros here(file_macros(files_.source)), there(file_macros(files_.target));
    for (const auto& [id, unit] : states_.source) {
        const std::string other = kTargetFile + id.substr(std::string(kSourceFile).size());
        const auto port = states_.target.find(other);
        if (port == states_.target.end()) continue;  // another language may read a broken text otherwise
        map_.pairs.push_back({id, {other}, 1});
        LockedPair pair;
        pair.source = id;
        pair.target = other;
        pair.source_prints = unit.prints;
        pair.target_prints = port->second.prints;
        pair.macros = {here.of(unit.file, unit.text), there.of(kTargetFile, port->second.text)};
        lock_.pairs.push_back(std::move(pair));
        texts_[unit.prints.written] = unit.text;
        texts_[port->second.prints.written] = port->second.text;
    }
}

size_t RecordedSides::check(const std::string& source, const std::string& target) const {
    return judge_sides(source, target, false);
}

size_t RecordedSides::check_against_base(const std::string& source, const std::string& target) const {
    return judge_sides(source, target, true);
}

size_t RecordedSides::judge_sides(const std::string& source, const std::string& target, bool against_base) const {
    const BySide<std::vector<ScannedFile>> files = scanned(source, target);
    const UnitsById here = states_of(files.source[0]), there = states_of(files.target[0]);
    const auto text_of = [&](Print print) {
        const auto found = texts_.find(print);
        return found == texts_.end() ? NormalText() : found->second;
    };
    Case facts{map_, lock_, here, there, skipped_, text_of, "2026-01-01"};
    facts.files.emplace(views_of(files));
    for (const ScannedFile* file : {&files.source[0], &files.target[0]})
        for (const Suppression& comment : file->lexed.suppressions) facts.suppressions.push_back({file->path, comment});
    BySide<NewWords> words;
    if (against_base) {
        const BySide<FilesOfSide> then = views_of(files_);
        for (const Side side : kBothSides) words[side] = new_words((*facts.files)[side], then[side]);
        facts.at_base = {&states_.source, &states_.target};
        facts.new_words = &words;
    }
    return judge(facts).findings.size();
}

}  // namespace porttool::testing
