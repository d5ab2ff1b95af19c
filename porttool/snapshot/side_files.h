// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/units_by_id.h"
#include "porttool/snapshot/file_facts.h"

namespace porttool {

/// A file of a side by its facts. It is scanned, and texts of its units are written in normal form, when somebody asks.
class KnownFile final : public TextSource {
public:
    KnownFile(std::string path, std::string bytes, FileFacts facts)
        : path_(std::move(path)), bytes_(std::move(bytes)), facts_(std::move(facts)) {}
    /// One that was scanned just now for its facts and may be kept so, with the texts of its units.
    KnownFile(std::string path, std::string bytes, FileFacts facts, ScannedFile scanned, std::vector<UnitState> states);

    const std::string& path() const { return path_; }
    const std::string& bytes() const { return bytes_; }
    const FileFacts& facts() const { return facts_; }
    const ScannedFile& scanned() const;
    /// Hands the scanned file to `visit`. That of a large one, if nobody asked for it yet, is gone afterwards.
    void visit_scanned(const std::function<void(const ScannedFile&)>& visit) const;
    const NormalText& text(uint32_t unit) const override;
    /// Whether text() need not write it first.
    bool has_text(uint32_t unit) const;
    void each_name(uint32_t unit, const std::function<void(std::string_view)>& visit) const override;

private:
    const ScannedFile& scanned_once() const;

    std::string path_, bytes_;
    FileFacts facts_;
    mutable std::mutex mutex_;
    mutable std::optional<ScannedFile> scanned_;
    mutable std::map<uint32_t, UnitText> texts_;
};

using KnownSide = std::vector<std::shared_ptr<const KnownFile>>;

/// Adds the states of a known file's units, their texts still with it.
void add_states(const std::shared_ptr<const KnownFile>& file, UnitsById& out);

/// The files of one side, as a judgement asks for them: all scanned, or known by their facts. What they are made of
/// must outlive it.
class FilesOfSide {
public:
    explicit FilesOfSide(const std::vector<ScannedFile>& scanned) : scanned_(&scanned) {}
    explicit FilesOfSide(const KnownSide& known) : known_(&known) {}

    size_t size() const { return scanned_ != nullptr ? scanned_->size() : known_->size(); }
    const std::string& path(size_t file) const;
    size_t tokens(size_t file) const;
    /// The names of the file's units, in order.
    std::vector<std::string_view> unit_names(size_t file) const;
    const std::vector<Suppression>& suppressions(size_t file) const;
    std::optional<uint32_t> unfinished_merge(size_t file) const;
    const ScannedFile& scanned(size_t file) const;
    void visit_scanned(size_t file, const std::function<void(const ScannedFile&)>& visit) const;
    /// The file as it was read or, where it was scanned at once, without what scanning leaves out.
    std::string_view text(size_t file) const {
        return scanned_ != nullptr ? std::string_view((*scanned_)[file].lexed.text) : (*known_)[file]->bytes();
    }
    std::vector<FileMacros> macros() const;

private:
    const std::vector<ScannedFile>* scanned_ = nullptr;
    const KnownSide* known_ = nullptr;
};

}  // namespace porttool
