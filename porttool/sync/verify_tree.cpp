// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/verify_tree.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "porttool/read/borrowed_repository.h"
#include "porttool/read/cannot_do.h"
#include "porttool/read/git_repository.h"
#include "porttool/read/replace_file.h"
#include "porttool/read/source_files.h"
#include "porttool/read/user_cache.h"
#include "porttool/text/fingerprint.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace fs = std::filesystem;
namespace {

constexpr const char* kNeedsGit = "sync --verify works on a copy of a repository; see why there is none with";
constexpr uint64_t kAnySize = std::numeric_limits<uint64_t>::max();

/// The user's folder for what can be made anew (XDG Base Directory Specification). Throws CannotDo.
std::string cache_folder() {
    std::string home = xdg_cache_home();
    if (!home.empty()) return home;
    throw CannotDo("--verify needs a folder for its work tree: set XDG_CACHE_HOME, or HOME, to an absolute path");
}

/// Makes porttool's own part of the cache, which is nobody else's to read. Throws CannotDo.
std::string verify_folder(const std::string& work_tree) {
    const std::string ours = join_path(cache_folder(), "porttool"), folder = join_path(ours, "verify");
    std::error_code error;
    // Where it lies is asked before anything is made, of the cache as well: what a repository holds may be links.
    for (const std::string& place : {cache_folder(), folder}) {
        const std::string real = fs::weakly_canonical(fs::absolute(place, error), error).generic_string();
        if (error || (real + "/").starts_with(work_tree + "/"))
            throw CannotDo(terminal_text(folder) +
                           " lies in the repository itself\nSet XDG_CACHE_HOME to a folder outside");
    }
    const bool is_new = !fs::exists(ours, error);
    fs::create_directories(folder, error);
    if (error) throw CannotDo(terminal_text(folder) + ": cannot be made: " + error.message());
    if (is_new) fs::permissions(ours, fs::perms::owner_all, error);
    return fs::canonical(folder).generic_string();
}

/// Files by their path in the repository: what they are copied from.
using Originals = std::map<std::string, std::string>;

/// The tracked files of a work tree that are there, those of its submodules included.
void list_tracked(const std::string& work_tree, const std::string& before, Originals& out) {
    const GitRepository repository(work_tree);
    if (!repository.error().empty()) return;
    for (const std::string& path : repository.tracked_files([](const std::string&) { return true; }).files) {
        const std::string here = join_path(work_tree, path);
        struct stat status {};
        if (::lstat(here.c_str(), &status) != 0) continue;
        if (S_ISREG(status.st_mode) || S_ISLNK(status.st_mode)) out[before + path] = here;
        std::error_code error;
        if (S_ISDIR(status.st_mode) && fs::exists(fs::path(here) / ".git", error))
            list_tracked(here, before + path + "/", out);
    }
}

/// Makes the folders of a path beneath a root; what stands in the place of one is removed.
void make_folders(const std::string& root, const std::string& path) {
    std::error_code error;
    for (size_t slash = path.find('/'); slash != std::string::npos; slash = path.find('/', slash + 1)) {
        const fs::path folder = fs::path(root) / path.substr(0, slash);
        if (fs::is_directory(fs::symlink_status(folder, error))) continue;
        fs::remove(folder, error);
        fs::create_directory(folder, error);
    }
}

[[noreturn]] void fail(const std::string& path, const std::string& why) {
    throw CannotDo("the work tree of --verify: " + terminal_text(path) + " " + why);
}

void put_link(const std::string& from, const std::string& root, const std::string& path) {
    std::error_code error;
    const fs::path target = fs::read_symlink(from, error), place = fs::path(root) / path;
    if (fs::is_symlink(fs::symlink_status(place, error)) && fs::read_symlink(place, error) == target) return;
    fs::remove_all(place, error);
    fs::create_symlink(target, place, error);
    if (error) fail(path, "cannot be made: " + error.message());
}

void put_bytes_if_new(const std::string& root, const std::string& path, const std::string& bytes, Disk& disk) {
    const TreePath place{root, path, Links::None};
    const FileText there = disk.read(place, kAnySize);
    if (there.error.empty() && there.bytes == bytes) return;
    std::error_code error;
    const fs::path real = fs::path(root) / path;
    if (fs::exists(fs::symlink_status(real, error)) && !fs::is_regular_file(fs::symlink_status(real, error)))
        fs::remove_all(real, error);
    make_folders(root, path);
    if (const std::string failure = disk.write(place, bytes); !failure.empty()) fail(path, failure);
}

bool same_bytes(const std::string& one, const std::string& other) {
    constexpr size_t kBlock = size_t{1} << 20;
    std::ifstream a(one, std::ios::binary), b(other, std::ios::binary);
    std::string a_block(kBlock, '\0'), b_block(kBlock, '\0');
    while (a && b) {
        a.read(a_block.data(), kBlock);
        b.read(b_block.data(), kBlock);
        if (a.gcount() != b.gcount() ||
            a_block.compare(0, static_cast<size_t>(a.gcount()), b_block, 0, static_cast<size_t>(b.gcount())) != 0)
            return false;
    }
    return a.eof() && b.eof();
}

/// A file that may be larger than memory: a megabyte of a pack can stand for gigabytes.
void put_large_if_new(const std::string& from, const std::string& root, const std::string& path) {
    std::error_code error;
    const fs::path place = fs::path(root) / path;
    const bool there = fs::is_regular_file(fs::symlink_status(place, error));
    if (there && same_bytes(from, place.string())) return;
    if (!there) fs::remove_all(place, error);
    fs::copy_file(from, place, fs::copy_options::overwrite_existing, error);
    if (error) fail(path, "cannot be copied: " + error.message());
}

/// Makes a file of the tree what the user's is.
void copy_file(const std::string& from, const std::string& root, const std::string& path, Disk& disk) {
    struct stat status {};
    if (::lstat(from.c_str(), &status) != 0) return;
    make_folders(root, path);
    if (S_ISLNK(status.st_mode)) return put_link(from, root, path);
    if (static_cast<uint64_t>(status.st_size) > kLargestFile) {
        put_large_if_new(from, root, path);
    } else {
        const FileText text = disk.read(from, kLargestFile);
        if (!text.error.empty()) fail(path, text.error);
        put_bytes_if_new(root, path, text.bytes, disk);
    }
    constexpr mode_t kRuns = 0755, kPlain = 0644;
    const mode_t wanted = (status.st_mode & S_IXUSR) != 0 ? kRuns : kPlain;
    const std::string place = join_path(root, path);
    struct stat now {};
    if (::lstat(place.c_str(), &now) == 0 && (now.st_mode & S_IXUSR) != (wanted & S_IXUSR))
        (void)::chmod(place.c_str(), wanted);
}

/// What the run before has put there, as its list in the tree's own `.git` says.
std::set<std::string> earlier_files(const std::string& list, const Disk& disk) {
    std::set<std::string> out;
    const FileText text = disk.read(list, kAnySize);
    for (size_t at = 0; at < text.bytes.size();) {
        const size_t end = text.bytes.find('\0', at);
        if (end == std::string::npos) break;
        out.insert(text.bytes.substr(at, end - at));
        at = end + 1;
    }
    return out;
}

}  // namespace

VerifyTree prepare_verify_tree(const std::string& root, const std::map<std::string, std::string>& files, Disk& disk) {
    const GitRepository repository(root, kNeedsGit);
    if (!repository.error().empty()) throw CannotDo(repository.error());
    std::error_code error;
    const std::string work_tree = fs::canonical(repository.work_tree(), error).generic_string();
    const std::string cache = verify_folder(work_tree);
    Fingerprinter hash;
    hash.add(work_tree);
    TakenGuard taken = disk.guard({cache, hash.digits()});
    if (!taken.error.empty()) throw CannotDo(taken.error);
    const std::string tree = join_path(cache, hash.digits());
    if (const std::string failure = borrow_repository(repository, tree); !failure.empty())
        throw CannotDo(terminal_text(tree) + ": " + failure + "\nRemove that folder; it is made anew");

    Originals originals;
    list_tracked(work_tree, "", originals);
    const std::string list = join_path(tree, ".git/porttool-files");
    std::string names;
    for (const auto& [path, from] : originals) names += path + '\0';
    for (const auto& [path, bytes] : files) names += repository.folder() + path + '\0';
    std::set<std::string> gone = earlier_files(list, disk);
    if (const std::string failure = disk.write(list, names); !failure.empty()) fail(list, failure);
    for (const auto& [path, from] : originals) gone.erase(path);
    for (const std::string& path : gone) (void)disk.remove(TreePath{tree, path, Links::None});
    for (const auto& [path, from] : originals)
        if (!path.starts_with(repository.folder()) || !files.contains(path.substr(repository.folder().size())))
            copy_file(from, tree, path, disk);
    for (const auto& [path, bytes] : files) {
        make_folders(tree, repository.folder() + path);
        put_bytes_if_new(tree, repository.folder() + path, bytes, disk);
    }
    make_folders(tree, repository.folder() + "x");
    return {std::move(taken.guard), join_path(tree, repository.folder())};
}

}  // namespace porttool
