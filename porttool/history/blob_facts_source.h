// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

#include "porttool/history/blob_facts.h"
#include "porttool/read/blob_cache.h"
#include "porttool/snapshot/past.h"

namespace porttool {

/// A version of a file.
struct FileVersion {
    std::string path;
    std::string blob;
    bool operator==(const FileVersion&) const = default;
};

/// The same for the same content, read in the same dialect, which the suffix tells.
std::string version_key(const FileVersion& file);

/// Gives what is known of versions of files: from memory, from the cache, or by scanning, in that order.
class BlobFactsSource {
public:
    BlobFactsSource(const Past& past, BlobCache& cache) : past_(past), cache_(cache) {}

    /// The vocabulary that edits are told in from now on.
    void use_dialect(const MapFile& map);

    /// Facts of a file; those of one that cannot be scanned (binary) are all zero.
    const BlobFacts& facts(const FileVersion& file);

    /// A file as a whole; the version of it that was asked for last is kept. May be called from several threads.
    std::shared_ptr<const ScannedFile> scanned(const FileVersion& file);
    /// The same where it is kept; otherwise nothing.
    std::shared_ptr<const ScannedFile> kept(const FileVersion& file) const;

    /// A unit of a pair, by the prints of its texts: when last in step, and now.
    struct UnitInTime {
        std::string_view id;
        const Fingerprints& before;
        const UnitFacts& now;
    };
    /// Judges a pair. `base_blob` gives the blob of portmap.base/PRINT, or "".
    using BaseBlob = std::function<std::string(Print print)>;
    EditFacts edits(const BySide<UnitInTime>& pair, const BaseBlob& base_blob, CompareBudget& budget);

private:
    struct UnitPlace {
        FileVersion file;
        std::string unit;
    };

    std::string text_of_blob(const std::string& path, const std::string& blob) const;
    ScannedFile scan(const FileVersion& file) const;
    const NormalText& text_of(Print print, const BaseBlob& base_blob);
    void read_texts(const FileVersion& file, Print wanted);

    const Past& past_;
    BlobCache& cache_;
    Dialect dialect_;
    std::string dialect_key_;
    std::unordered_map<std::string, BlobFacts> facts_;
    std::unordered_map<Print, UnitPlace> places_;  ///< where a text with this print stands
    std::unordered_map<Print, NormalText> texts_;  ///< by print, those asked for and what came with them
    mutable std::mutex scanned_mutex_, git_mutex_;
    std::map<std::string, std::pair<std::string, std::shared_ptr<const ScannedFile>>> scanned_;  ///< by path, the last
};

}  // namespace porttool
