// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/drafts.h"

#include <algorithm>
#include <utility>

#include "porttool/scan/scan.h"
#include "porttool/sync/unified_diff.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

bool lies_behind_link(const TreePath& place, const Disk& disk) {
    return disk.kind(place) != FileKind::None &&
           !disk.read(TreePath{place.root, place.path, Links::None}, kLargestFile).error.empty();
}

namespace {

/// What an id names in a file; "" for one of another file.
std::string_view name_in(const ScannedFile& file, const std::string& id) {
    const std::string_view name = std::string_view(id).substr(std::min(id.size(), file.path.size() + 1));
    if (name.empty() || id.compare(0, file.path.size(), file.path) != 0 || id[file.path.size()] != ':') return {};
    return name;
}

}  // namespace

const Unit* unit_named(const ScannedFile& file, const std::string& id) {
    const std::string_view name = name_in(file, id);
    if (name.empty()) return nullptr;
    for (const Unit& unit : file.units)
        if (unit.name == name) return &unit;
    return nullptr;
}

UnitPlaces::UnitPlaces(const ScannedFile& file) {
    for (size_t i = 0; i < file.units.size(); ++i) places_.emplace(file.units[i].name, i);
}

const Unit* UnitPlaces::find(const ScannedFile& file, const std::string& id) const {
    const auto found = places_.find(std::string(name_in(file, id)));
    return found == places_.end() || found->first.empty() ? nullptr : &file.units.at(found->second);
}

const Unit* Draft::unit(const std::string& id) {
    if (!units) units.emplace(scanned);
    return units->find(scanned, id);
}

std::string Draft::indent() {
    if (!indents) indents.emplace(scanned.lexed);
    return indents->unit();
}

bool Draft::has_scanned_text() {
    if (!is_as_scanned) is_as_scanned = bytes == scanned.lexed.text;
    return *is_as_scanned;
}

ProposedPlace Drafts::place_of(Side side, const std::string& path) const {
    return {path, side == Side::Target && target_root(checked_.project) != checked_.project.root};
}

Draft& Drafts::of(Side side, const ScannedFile& file) {
    ProposedPlace place = place_of(side, file.path);
    auto found = drafts_.find(place);
    if (found != drafts_.end()) return found->second;
    const std::string root = side == Side::Target ? target_root(checked_.project) : checked_.project.root;
    FileText read = disk_.read(TreePath{root, file.path}, kLargestSource);
    if (!read.error.empty()) throw CannotDo(terminal_text(file.path) + " " + read.error);
    Draft draft;
    draft.bytes = draft.original = read.bytes;
    draft.scanned = scan_text(file.path, read.bytes);
    draft.place = place;
    draft.is_linked = lies_behind_link({root, file.path}, disk_);
    if (draft.scanned.lexed.text != file.lexed.text)
        throw CannotDo(terminal_text(file.path) +
                       " is not as it was judged: with --staged the index and the work tree differ\n"
                       "Stage it, or sync without --staged");
    return drafts_.emplace(std::move(place), std::move(draft)).first->second;
}

const Draft* Drafts::find(Side side, const std::string& path) const {
    const auto found = drafts_.find(place_of(side, path));
    return found == drafts_.end() ? nullptr : &found->second;
}

void Drafts::write(Draft& draft, std::string bytes, ScannedFile scanned) {
    const auto [before, is_first] = before_.try_emplace(draft.place);
    if (is_first)
        before->second = {draft.bytes, std::nullopt};
    else if (before->second.lines)
        before->second = {whole(before->second, draft.bytes), std::nullopt};
    draft.bytes = std::move(bytes);
    draft.scanned = std::move(scanned);
    draft.units.reset();
    draft.indents.reset();
    draft.is_as_scanned.reset();
}

void Drafts::write_rescanned(Draft& draft, const RescannedLines& lines) {
    const size_t length = lines.end - lines.first;
    const auto [before, is_first] = before_.try_emplace(draft.place);
    if (is_first)
        before->second = {draft.bytes.substr(lines.first, length), lines};
    else if (before->second.lines)
        before->second = {whole(before->second, draft.bytes), std::nullopt};
    if (draft.indents) draft.indents->remove(draft.bytes, lines.first, lines.end);
    draft.bytes.replace(lines.first, length, draft.scanned.lexed.text, lines.first, lines.now);
    if (draft.indents) draft.indents->add(draft.bytes, lines.first, lines.first + lines.now);
}

/// What a draft was that is `now` another one.
std::string Drafts::whole(const Before& before, const std::string& now) {
    if (!before.lines) return before.bytes;
    std::string out = now;
    return out.replace(before.lines->first, before.lines->now, before.bytes);
}

void Drafts::begin() {
    before_.clear();
    records_before_ = records_;
}

void Drafts::take_back() {
    const std::map<ProposedPlace, Before> written = std::exchange(before_, {});
    for (const auto& [place, before] : written) {
        Draft& draft = drafts_.at(place);
        std::string bytes = whole(before, draft.bytes);
        ScannedFile scanned = scan_text(place.path, bytes);
        write(draft, std::move(bytes), std::move(scanned));
    }
    before_.clear();
    records_ = records_before_;
}

std::string Drafts::patch() const {
    std::string out;
    for (const auto& [place, before] : before_) {
        const Draft& draft = drafts_.at(place);
        out += before.lines ? patch_of_lines(before, draft) : unified_diff(place.path, before.bytes, draft.bytes);
    }
    return out;
}

/// From the lines around alone.
std::string Drafts::patch_of_lines(const Before& before, const Draft& draft) {
    constexpr size_t kAround = 8;  // more than a patch shows
    const std::string_view bytes = draft.bytes;
    const std::vector<uint32_t>& starts = draft.scanned.lexed.line_starts;
    const size_t end = before.lines->first + before.lines->now;
    const auto line_of = [&](size_t byte) {
        return static_cast<size_t>(std::lower_bound(starts.begin(), starts.end(), byte) - starts.begin());
    };
    const size_t line = line_of(before.lines->first), first_line = line - std::min(line, kAround);
    const size_t line_behind = line_of(end) + kAround;
    const size_t first = starts.at(first_line), last = line_behind < starts.size() ? starts[line_behind] : bytes.size();
    const std::string_view above = bytes.substr(first, before.lines->first - first),
                           below = bytes.substr(end, last - end);
    return unified_diff(draft.place.path, std::string(above) + before.bytes + std::string(below),
                        bytes.substr(first, last - first), false, first_line);
}

std::string Drafts::record_patch() const {
    std::string out;
    for (const auto& [path, file] : records_) {
        const auto before = records_before_.find(path);
        const bool was_written = before != records_before_.end();
        out +=
            unified_diff(path, was_written ? before->second.now : file.before, file.now, file.is_new && !was_written);
    }
    return out;
}

ProposedFiles Drafts::files() const {
    ProposedFiles out;
    for (const auto& [place, draft] : drafts_)
        if (draft.bytes != draft.original) out[place] = {draft.original, draft.bytes};
    for (const auto& [path, file] : records_) out[{path, false}] = {file.before, file.now};
    return out;
}

}  // namespace porttool
