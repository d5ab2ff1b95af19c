// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/drafts.h"

#include "porttool/scan/scan.h"
#include "porttool/sync/unified_diff.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

bool lies_behind_link(const TreePath& place, const Disk& disk) {
    return disk.kind(place) != FileKind::None &&
           !disk.read(TreePath{place.root, place.path, Links::None}, kLargestFile).error.empty();
}

const Unit* unit_named(const ScannedFile& file, const std::string& id) {
    const std::string_view name = std::string_view(id).substr(std::min(id.size(), file.path.size() + 1));
    if (name.empty() || id.compare(0, file.path.size(), file.path) != 0 || id[file.path.size()] != ':') return nullptr;
    for (const Unit& unit : file.units)
        if (unit.name == name) return &unit;
    return nullptr;
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
    Draft draft{read.bytes, read.bytes, scan_text(file.path, read.bytes), place,
                lies_behind_link({root, file.path}, disk_)};
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
    bytes_before_.try_emplace(draft.place, draft.bytes);
    draft.bytes = std::move(bytes);
    draft.scanned = std::move(scanned);
}

void Drafts::begin() {
    bytes_before_.clear();
    records_before_ = records_;
}

void Drafts::take_back() {
    for (auto& [place, bytes] : bytes_before_) {
        Draft& draft = drafts_.at(place);
        draft.bytes = std::move(bytes);
        draft.scanned = scan_text(place.path, draft.bytes);
    }
    bytes_before_.clear();
    records_ = records_before_;
}

std::string Drafts::patch() const {
    std::string out;
    for (const auto& [place, bytes] : bytes_before_) out += unified_diff(place.path, bytes, drafts_.at(place).bytes);
    return out;
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
