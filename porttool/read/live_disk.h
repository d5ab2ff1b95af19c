// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

#include "porttool/read/disk.h"

namespace porttool {

/// What was asked of a disk, by absolute paths: all that an answer rests on.
struct LookedAt {
    std::set<std::string> names;    ///< files, there or not
    std::set<std::string> folders;  ///< whose entries were listed
    bool operator==(const LookedAt&) const = default;
};

/// Another disk as it stands this moment for who works on it: texts that an editor has not saved yet stand in the place
/// of their files, and what is asked of it is noted, so that one knows what to watch. Writes go to the other disk.
class LiveDisk final : public Disk {
public:
    /// `beneath` must outlive it.
    explicit LiveDisk(Disk& beneath) : beneath_(beneath) {}

    /// From here on a file reads so, wherever it is read from; by absolute path.
    void show(const std::string& path, std::string text) { shown_[path] = std::move(text); }
    /// It reads as it stands on the disk again.
    void show_saved(const std::string& path) { shown_.erase(path); }
    bool shows(const std::string& path) const { return shown_.contains(path); }

    /// What was asked since the last call.
    LookedAt take_looked_at() { return std::exchange(looked_at_, {}); }

    FileText read(const std::string& path, uint64_t limit) const override;
    FileText read(const TreePath& path, uint64_t limit) const override;
    FolderList list(const TreePath& path) const override;
    FileKind kind(const TreePath& path) const override;
    bool is_directory(const std::string& path) const override;
    bool exists(const std::string& path) const override;
    std::string write(const std::string& path, const std::string& bytes) override;
    std::string write(const TreePath& path, const std::string& bytes) override;
    std::string write_all(const std::vector<FileToWrite>& files) override;
    bool is_read_only(const TreePath& path) const override;
    std::string remove(const TreePath& path) override;
    TakenGuard guard(const TreePath& path) override;

private:
    /// The text that stands in the place of a file, or nullptr. Notes that it was asked for.
    const std::string* shown(const std::string& path) const;

    Disk& beneath_;
    std::map<std::string, std::string> shown_;  ///< by absolute path
    mutable LookedAt looked_at_;
};

}  // namespace porttool
