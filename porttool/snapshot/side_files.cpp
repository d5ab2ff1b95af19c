// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/side_files.h"

#include "porttool/scan/scan.h"
#include "porttool/snapshot/merge_marks.h"

namespace porttool {
namespace {

constexpr size_t kLeastOfLargeFile =
    1u << 20;  // from which on its tokens, some 20 times that, are not kept for one look

}  // namespace

KnownFile::KnownFile(std::string path, std::string bytes, FileFacts facts, ScannedFile scanned,
                     std::vector<UnitState> states)
    : path_(std::move(path)), bytes_(std::move(bytes)), facts_(std::move(facts)) {
    if (bytes_.size() < kLeastOfLargeFile) scanned_ = std::move(scanned);
    for (uint32_t unit = 0; unit < states.size(); ++unit)
        texts_.emplace_hint(texts_.end(), unit, std::move(states[unit].text));
}

bool KnownFile::has_text(uint32_t unit) const {
    const std::lock_guard lock(mutex_);
    return texts_.contains(unit);
}

const ScannedFile& KnownFile::scanned_once() const {
    if (!scanned_) scanned_ = scan_text(path_, bytes_);
    return *scanned_;
}

const ScannedFile& KnownFile::scanned() const {
    const std::lock_guard lock(mutex_);
    return scanned_once();
}

void KnownFile::visit_scanned(const std::function<void(const ScannedFile&)>& visit) const {
    const ScannedFile* kept = nullptr;
    {
        const std::lock_guard lock(mutex_);
        if (scanned_ || bytes_.size() < kLeastOfLargeFile) kept = &scanned_once();
    }
    if (kept != nullptr) return visit(*kept);
    visit(scan_text(path_, bytes_));
}

const NormalText& KnownFile::text(uint32_t unit) const {
    const std::lock_guard lock(mutex_);
    auto known = texts_.find(unit);
    if (known == texts_.end()) known = texts_.emplace(unit, state_of(scanned_once(), unit).text).first;
    return known->second.get();
}

void KnownFile::each_name(uint32_t unit, const std::function<void(std::string_view)>& visit) const {
    facts_.each_name(unit, visit);
}

void add_states(const std::shared_ptr<const KnownFile>& file, UnitsById& out) {
    const FileFacts& facts = file->facts();
    for (uint32_t i = 0; i < facts.units(); ++i) {
        const KnownUnit unit = facts.unit(i);
        UnitState state;
        state.id.reserve(file->path().size() + 1 + unit.name.size());
        state.id.append(file->path()).append(":").append(unit.name);
        state.file = file->path();
        state.name = unit.name;
        state.kind = unit.kind;
        state.start_line = unit.start_line;
        state.end_line = unit.end_line;
        state.prints = unit.prints;
        state.text = UnitText(file, i, unit.words);
        out.add(std::move(state));
    }
}

const std::string& FilesOfSide::path(size_t file) const {
    return scanned_ != nullptr ? (*scanned_)[file].path : (*known_)[file]->path();
}

size_t FilesOfSide::tokens(size_t file) const {
    return scanned_ != nullptr ? (*scanned_)[file].lexed.tokens.size() : (*known_)[file]->facts().tokens();
}

std::vector<std::string_view> FilesOfSide::unit_names(size_t file) const {
    std::vector<std::string_view> out;
    if (scanned_ != nullptr) {
        for (const Unit& unit : (*scanned_)[file].units) out.emplace_back(unit.name);
    } else {
        const FileFacts& facts = (*known_)[file]->facts();
        for (uint32_t i = 0; i < facts.units(); ++i)
            if (const KnownUnit unit = facts.unit(i); unit.kind != UnitKind::File) out.push_back(unit.name);
    }
    return out;
}

const std::vector<Suppression>& FilesOfSide::suppressions(size_t file) const {
    return scanned_ != nullptr ? (*scanned_)[file].lexed.suppressions : (*known_)[file]->facts().suppressions();
}

std::optional<uint32_t> FilesOfSide::unfinished_merge(size_t file) const {
    return scanned_ != nullptr ? porttool::unfinished_merge((*scanned_)[file].lexed.text)
                               : (*known_)[file]->facts().unfinished_merge();
}

const ScannedFile& FilesOfSide::scanned(size_t file) const {
    return scanned_ != nullptr ? (*scanned_)[file] : (*known_)[file]->scanned();
}

void FilesOfSide::visit_scanned(size_t file, const std::function<void(const ScannedFile&)>& visit) const {
    return scanned_ != nullptr ? visit((*scanned_)[file]) : (*known_)[file]->visit_scanned(visit);
}

std::vector<FileMacros> FilesOfSide::macros() const {
    if (scanned_ != nullptr) return file_macros(*scanned_);
    std::vector<FileMacros> out;
    out.reserve(known_->size());
    for (const auto& file : *known_) out.push_back({file->path(), file->facts().macros(), file->facts().includes()});
    return out;
}

}  // namespace porttool
