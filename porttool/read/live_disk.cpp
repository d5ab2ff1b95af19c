// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/live_disk.h"

namespace porttool {
namespace {

std::string absolute_place(const TreePath& at) { return absolute_path(join_path(at.root, at.path)); }

FileText bounded(const std::string& text, uint64_t limit) {
    return text.size() > limit ? FileText{"", too_large(text.size(), limit)} : FileText{text, ""};
}

}  // namespace

const std::string* LiveDisk::shown(const std::string& path) const {
    looked_at_.names.insert(path);
    const auto found = shown_.find(path);
    return found == shown_.end() ? nullptr : &found->second;
}

FileText LiveDisk::read(const std::string& path, uint64_t limit) const {
    const std::string* text = shown(absolute_path(path));
    return text == nullptr ? beneath_.read(path, limit) : bounded(*text, limit);
}

FileText LiveDisk::read(const TreePath& path, uint64_t limit) const {
    const std::string* text = shown(absolute_place(path));
    // What leads out of the tree is not read, whatever an editor shows in its place.
    if (text == nullptr || beneath_.kind(path) == FileKind::Other) return beneath_.read(path, limit);
    return bounded(*text, limit);
}

FolderList LiveDisk::list(const TreePath& path) const {
    looked_at_.folders.insert(absolute_place(path));
    return beneath_.list(path);
}

FileKind LiveDisk::kind(const TreePath& path) const {
    looked_at_.names.insert(absolute_place(path));
    return beneath_.kind(path);
}

bool LiveDisk::is_directory(const std::string& path) const {
    looked_at_.names.insert(absolute_path(path));
    return beneath_.is_directory(path);
}

bool LiveDisk::exists(const std::string& path) const {
    looked_at_.names.insert(absolute_path(path));
    return beneath_.exists(path);
}

std::string LiveDisk::write(const std::string& path, const std::string& bytes) { return beneath_.write(path, bytes); }
std::string LiveDisk::write(const TreePath& path, const std::string& bytes) { return beneath_.write(path, bytes); }
std::string LiveDisk::write_all(const std::vector<FileToWrite>& files) { return beneath_.write_all(files); }
bool LiveDisk::is_read_only(const TreePath& path) const { return beneath_.is_read_only(path); }
std::string LiveDisk::remove(const TreePath& path) { return beneath_.remove(path); }
TakenGuard LiveDisk::guard(const TreePath& path) { return beneath_.guard(path); }

}  // namespace porttool
