// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/read/source_files.h"
#include "porttool/read/traced_disk.h"
#include "porttool/read/user_cache.h"
#include "porttool/snapshot/side_files.h"

namespace porttool {

/// The facts of a project's files, kept in the user's cache from run to run: those of a file are found by a keyed hash
/// of its path and its content, so that only what changed is scanned again. Without a cache, or where what is kept is
/// not what was written, all files are.
class FactsStore {
public:
    /// `request`: all that facts rest on beside path and content, that is the build of the program; and what tells one
    /// project from another. `repository`: must not hold the cache. Sides of fewer bytes are scanned in less time than
    /// their facts take to be kept.
    FactsStore(std::string request, const std::string& repository, uint64_t least_bytes);

    uint64_t least_bytes() const { return least_bytes_; }

    /// The files of a set with their facts. `named`: ids that the map names, of files as a whole among them. Few new
    /// files stay scanned: they are the ones whose texts a judgement asks for.
    KnownSide know(std::vector<SourceText> files, const std::set<std::string>& named);

    /// Keeps the facts of all files that were known, where enough of them are new.
    void save();

private:
    struct Entry {
        uint64_t hash = 0;
        std::string_view bytes = {};
        bool is_new = false;
    };

    void open();
    bool read(std::string bytes);
    uint64_t hash_of(const SourceText& file, bool is_whole) const;

    std::string request_, file_;
    UserCache cache_;
    uint64_t least_bytes_;
    bool is_open_ = false;
    TraceKey key_{};
    std::shared_ptr<const std::string> kept_;               ///< the bytes of the cache's file
    std::unordered_map<uint64_t, std::string_view> found_;  ///< in kept_, by hash
    std::vector<Entry> known_;
    std::vector<std::shared_ptr<const std::string>> owners_;  ///< of the bytes of known_
};

}  // namespace porttool
