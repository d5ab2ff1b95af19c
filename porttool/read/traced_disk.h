// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/read/disk.h"

namespace porttool {

/// The key of a trace's hashes: drawn at random for each trace, so that nobody who writes files for it to be read can
/// make two contents of one hash.
using TraceKey = std::array<uint64_t, 2>;

TraceKey random_trace_key();

/// SipHash-2-4 of the bytes.
uint64_t keyed_hash(const TraceKey& key, std::string_view bytes);

/// Something that was asked of a disk, and the hash of what it answered.
struct DiskQuestion {
    enum class Kind : uint8_t { ReadPath, Read, List, FileKind, IsDirectory, Exists, IsReadOnly, Tracked };
    Kind kind = Kind::Read;
    TreePath place;                  ///< a plain path has no root
    uint64_t limit = 0;              ///< of a file
    std::vector<std::string> globs;  ///< Tracked: which files of git's index are asked for
    uint64_t answer = 0;
};

/// Everything that was asked of a disk. What is computed from its answers alone comes out the same as long as all of
/// them are the same: a verifying trace (Mokhov, Mitchell and Peyton Jones, "Build Systems a la Carte", 2018).
struct DiskTrace {
    TraceKey key{};
    std::vector<DiskQuestion> questions;

    std::string bytes() const;
    static std::optional<DiskTrace> read(std::string_view bytes);
    /// Asks all of it again.
    bool holds(const Disk& disk) const;
};

/// A disk that writes down what it is asked. One thread at a time.
class TracedDisk final : public Disk {
public:
    /// Answers are hashed once there are `least_bytes` of them; before, a trace is not worth its time.
    TracedDisk(Disk& disk, uint64_t least_bytes)
        : disk_(disk), least_bytes_(least_bytes), trace_{random_trace_key(), {}} {}

    /// The most questions that are kept: to ask so many again takes as long as to work.
    static constexpr size_t kMostQuestions = size_t{1} << 17;

    /// The trace, where there was enough to be worth it, not too much to be kept, and nothing was written or guarded:
    /// that is more than answers.
    const DiskTrace* trace() const {
        return only_read_ && !too_many_ && bytes_answered_ >= least_bytes_ ? &trace_ : nullptr;
    }

    /// Notes that git was asked which files of its index in `root` the globs match.
    void asked_git(const std::string& root, const std::vector<std::string>& globs) const;

    FileText read(const std::string& path, uint64_t limit) const override;
    FileText read(const TreePath& path, uint64_t limit) const override;
    FolderList list(const TreePath& path) const override;
    FileKind kind(const TreePath& path) const override;
    bool is_directory(const std::string& path) const override;
    bool exists(const std::string& path) const override;
    bool is_read_only(const TreePath& path) const override;
    std::string write(const std::string& path, const std::string& bytes) override;
    std::string write(const TreePath& path, const std::string& bytes) override;
    std::string write_all(const std::vector<FileToWrite>& files) override;
    std::string remove(const TreePath& path) override;
    TakenGuard guard(const TreePath& path) override;

private:
    void note(DiskQuestion question, std::string answer) const;

    Disk& disk_;
    uint64_t least_bytes_;
    mutable DiskTrace trace_;
    mutable std::vector<std::string> waiting_;  // the answers so far, while there are few
    mutable uint64_t bytes_answered_ = 0;
    mutable bool too_many_ = false;  // questions
    bool only_read_ = true;
};

}  // namespace porttool
