// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <cerrno>

#include "porttool/read/disk.h"
#include "porttool/read/refusals.h"

namespace porttool {
namespace {

/// The name of a file beneath a root, or "" for one that lies elsewhere.
std::string name_of(const TreePath& at) {
    const std::string path = clean_path(at.path);
    if (path.starts_with('/') || path == ".." || path.starts_with("../")) return {};
    if (names_git_folder(path)) return {};
    return join_path(at.root, path);
}

}  // namespace

FileText MemoryDisk::read(const std::string& path, uint64_t limit) const {
    if (const auto bad = errors.find(path); bad != errors.end()) return {"", bad->second};
    const auto file = files.find(path);
    if (file == files.end()) return {"", cannot_be_read(ENOENT)};
    if (file->second.size() > limit) return {"", too_large(file->second.size(), limit)};
    return {file->second, ""};
}

FileText MemoryDisk::read(const TreePath& path, uint64_t limit) const {
    const std::string name = name_of(path);
    return name.empty() ? FileText{"", leads_out(path.root)} : read(name, limit);
}

FolderList MemoryDisk::list(const TreePath& path) const {
    const std::string name = name_of(path);
    if (name.empty()) return {{}, leads_out(path.root), true};
    if (!is_directory(name)) return {{}, cannot_be_read(ENOTDIR)};
    const std::string prefix = name == "." ? "" : name + "/";
    std::map<std::string, bool> found;
    auto add = [&](const std::string& file) {
        if (!file.starts_with(prefix)) return;
        const std::string rest = file.substr(prefix.size());
        const size_t slash = rest.find('/');
        found[rest.substr(0, slash)] |= slash != std::string::npos;
    };
    for (const auto& [file, bytes] : files) add(file);
    for (const auto& [file, reason] : errors) add(file);
    FolderList out;
    for (const auto& [entry, folder] : found) out.entries.push_back({entry, folder});
    return out;
}

FileKind MemoryDisk::kind(const TreePath& path) const {
    const std::string name = name_of(path);
    if (name.empty()) return FileKind::Other;
    if (files.contains(name) || errors.contains(name)) return FileKind::File;
    return is_directory(name) ? FileKind::Folder : FileKind::None;
}

bool MemoryDisk::is_directory(const std::string& path) const {
    if (path.empty() || path == ".") return true;
    const auto next = files.lower_bound(path + "/");
    return next != files.end() && next->first.starts_with(path + "/");
}

bool MemoryDisk::exists(const std::string& path) const { return files.contains(path) || is_directory(path); }

std::string MemoryDisk::write(const std::string& path, const std::string& bytes) {
    files[path] = bytes;
    return {};
}

std::string MemoryDisk::write(const TreePath& path, const std::string& bytes) {
    const std::string name = name_of(path);
    return name.empty() ? leads_out(path.root) : write(name, bytes);
}

std::string MemoryDisk::remove(const TreePath& path) {
    files.erase(name_of(path));
    return {};
}

TakenGuard MemoryDisk::guard(const TreePath&) { return {std::make_unique<WriteGuard>(), ""}; }

}  // namespace porttool
