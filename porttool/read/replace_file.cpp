// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/replace_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "porttool/read/source_files.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kMark = ".porttool-";
constexpr mode_t kNewFile = 0666, kNewFolder = 0777;

std::string cannot_be_written(int code) { return std::string("cannot be written: ") + std::strerror(code); }

std::string temporary_name(const std::string& name) {
    static std::atomic<unsigned> count = 0;
    return name + std::string(kMark) + std::to_string(::getpid()) + "." + std::to_string(++count);
}

/// Empty, or why the bytes are not in the file.
std::string put_bytes(const Descriptor& file, const std::string& bytes) {
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t now = ::write(file.get(), bytes.data() + done, bytes.size() - done);
        if (now < 0 && errno == EINTR) continue;
        if (now < 0) return cannot_be_written(errno);
        done += static_cast<size_t>(now);
    }
    return {};
}

/// Gives a new file the permissions of the one that it replaces.
void keep_permissions(int folder, const std::string& name, const Descriptor& file) {
    struct stat before {};
    if (::fstatat(folder, name.c_str(), &before, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(before.st_mode))
        (void)::fchmod(file.get(), before.st_mode & 07777);
}

/// Writes a temporary beside `name` in an open folder. Returns why it could not, and then leaves none.
std::string stage_in(int folder, const std::string& name, const std::string& temporary, const std::string& bytes) {
    (void)::unlinkat(folder, temporary.c_str(), 0);  // of a killed process that had our number
    const Descriptor file(
        ::openat(folder, temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kNewFile));
    if (!file.valid()) return cannot_be_written(errno);
    std::string reason = put_bytes(file, bytes);
    if (reason.empty()) keep_permissions(folder, name, file);
    if (!reason.empty()) (void)::unlinkat(folder, temporary.c_str(), 0);
    return reason;
}

/// Gives a temporary its file's name, or removes it.
std::string put_in_place(int folder, const std::string& name, const std::string& temporary) {
    if (::renameat(folder, temporary.c_str(), folder, name.c_str()) == 0) return {};
    std::string reason = cannot_be_written(errno);
    (void)::unlinkat(folder, temporary.c_str(), 0);
    return reason;
}

/// Writes `name` in an open folder by way of a temporary.
std::string replace_in(int folder, const std::string& name, const std::string& bytes) {
    const std::string temporary = temporary_name(name);
    const std::string reason = stage_in(folder, name, temporary, bytes);
    return reason.empty() ? put_in_place(folder, name, temporary) : reason;
}

std::string append(const std::string& path, const std::string& bytes) {
    // At first without waiting, since a pipe that nobody reads would be waited for without end.
    const Descriptor file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC | O_NONBLOCK));
    if (!file.valid()) return errno == ENXIO ? "is a pipe that nobody reads" : cannot_be_written(errno);
    (void)::fcntl(file.get(), F_SETFL, O_APPEND);
    return put_bytes(file, bytes);
}

/// What a path of the user's leads to over its links.
struct Destination {
    std::string path;
    bool is_stream = false;  ///< it is written to, not replaced
};

bool is_of_proc(const std::string& folder) {
    constexpr long kProc = 0x9FA0;  // PROC_SUPER_MAGIC
    struct statfs system {};
    return ::statfs(folder.empty() ? "." : folder.c_str(), &system) == 0 && static_cast<long>(system.f_type) == kProc;
}

/// Asks the file, not its name: a link of /proc stands for a file that is open already.
Destination destination_of(std::string path) {
    constexpr int kMostSteps = 40;
    for (int links = 0; links < kMostSteps; ++links) {
        struct stat status {};
        if (::lstat(path.c_str(), &status) != 0 || !S_ISLNK(status.st_mode))
            return {path, ::lstat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode)};
        const std::string folder = fs::path(path).parent_path().string();
        if (is_of_proc(folder)) return {path, true};
        std::error_code error;
        path = join_path(folder, fs::read_symlink(path, error).string());
    }
    return {path, true};  // links that lead to one another: opening it says so
}

/// Whose temporary a name is: `report.html` for `report.html.porttool-4711.1`; "" for any other name. `process` is the
/// one that made it.
std::string_view temporary_of(std::string_view name, int& process) {
    const size_t mark = name.rfind(kMark);
    if (mark == std::string_view::npos || mark == 0) return {};
    const char* end = name.data() + name.size();
    const auto number = std::from_chars(name.data() + mark + kMark.size(), end, process);
    if (number.ec != std::errc() || process <= 0 || number.ptr == end || *number.ptr != '.') return {};
    unsigned count = 0;
    const auto rest = std::from_chars(number.ptr + 1, end, count);
    return rest.ec == std::errc() && rest.ptr == end ? name.substr(0, mark) : std::string_view();
}

/// Opens the folder of a path beneath a root, and makes its last part where that is missing.
FolderBeneath folder_to_write(const TreePath& path) {
    FolderBeneath at = folder_beneath(path);
    const size_t slash = path.path.find_last_of('/');
    if (at.code != ENOENT || slash == std::string::npos) return at;
    const FolderBeneath above = folder_beneath({path.root, path.path.substr(0, slash), path.links});
    if (!above.error.empty()) return at;
    if (::mkdirat(above.folder.get(), above.name.c_str(), kNewFolder) != 0 && errno != EEXIST)
        return {Descriptor(), "", cannot_be_written(errno), errno};
    return folder_beneath(path);
}

/// One of several files, on the way to being replaced. No folder stays open: there may be more than descriptors.
struct Staged {
    const TreePath& place;
    std::string temporary;  ///< beside it
    FileText before;
};

/// Holds back every signal that can be held.
class SignalsHeld {
public:
    SignalsHeld() {
        sigset_t all;
        ::sigfillset(&all);
        ::pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~SignalsHeld() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalsHeld(const SignalsHeld&) = delete;
    SignalsHeld& operator=(const SignalsHeld&) = delete;

private:
    sigset_t before_{};
};

std::string refused(const TreePath& place, const std::string& reason) {
    return terminal_text(join_path(place.root, place.path)) + ": " + reason;
}

void drop_temporary(const Staged& file) {
    const FolderBeneath at = folder_beneath(file.place);
    if (at.error.empty()) (void)::unlinkat(at.folder.get(), file.temporary.c_str(), 0);
}

void restore(const Staged& file) {
    const FolderBeneath at = folder_beneath(file.place);
    if (!at.error.empty()) return;
    if (file.before.error.empty())
        (void)replace_in(at.folder.get(), at.name, file.before.bytes);
    else
        (void)::unlinkat(at.folder.get(), at.name.c_str(), 0);
}

/// Keeps what a file holds, to be put back. Returns why that cannot be, or "".
std::string take_before(const FolderBeneath& at, Staged& file) {
    file.before = RealDisk().read(file.place, kLargestFile);
    struct stat status {};
    const bool is_file =
        ::fstatat(at.folder.get(), at.name.c_str(), &status, AT_SYMLINK_NOFOLLOW) == 0 && S_ISREG(status.st_mode);
    return is_file ? file.before.error : std::string();
}

/// Writes the temporary of each; on a failure none is left.
std::string stage_all(const std::vector<FileToWrite>& files, std::vector<Staged>& staged) {
    for (const FileToWrite& file : files) {
        const FolderBeneath at = folder_to_write(file.place);
        Staged one{file.place, temporary_name(at.name), {}};
        std::string reason = at.error;
        if (reason.empty()) reason = take_before(at, one);
        if (reason.empty()) reason = stage_in(at.folder.get(), at.name, one.temporary, file.bytes);
        if (!reason.empty()) {
            for (const Staged& other : staged) drop_temporary(other);
            return refused(file.place, reason);
        }
        staged.push_back(std::move(one));
    }
    return {};
}

}  // namespace

std::string temporary_left(const TreePath& place, int process) {
    const FolderBeneath at = folder_beneath(place);
    if (!at.error.empty()) return {};
    const int again = ::openat(at.folder.get(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR* entries = again < 0 ? nullptr : ::fdopendir(again);
    if (entries == nullptr) return {};
    std::string out;
    while (const dirent* entry = ::readdir(entries)) {
        int made_by = 0;
        if (temporary_of(entry->d_name, made_by) == at.name && made_by == process) out = entry->d_name;
    }
    ::closedir(entries);
    return out;
}

std::string take_temporary(const TreePath& place, const std::string& temporary) {
    const FolderBeneath at = folder_beneath(place);
    return at.error.empty() ? put_in_place(at.folder.get(), at.name, temporary) : at.error;
}

void sweep_beside(const std::vector<TreePath>& files) {
    std::map<std::pair<std::string, std::string>, std::set<std::string, std::less<>>> names;
    for (const TreePath& place : files) {
        const size_t slash = place.path.find_last_of('/');
        const std::string folder = slash == std::string::npos ? "" : place.path.substr(0, slash + 1);
        names[{place.root, folder}].insert(place.path.substr(folder.size()));
    }
    for (const auto& [folder, here] : names) {
        const FolderBeneath at = folder_beneath({folder.first, folder.second + *here.begin(), Links::None});
        if (!at.error.empty()) continue;
        sweep_temporaries(
            at.folder.get(), [&](std::string_view file) { return here.contains(file); }, false);
    }
}

std::string replace_files(const std::vector<FileToWrite>& files) {
    const SignalsHeld held;
    std::vector<TreePath> places;
    for (const FileToWrite& file : files) places.push_back(file.place);
    sweep_beside(places);
    std::vector<Staged> staged;
    if (std::string failure = stage_all(files, staged); !failure.empty()) return failure;
    for (size_t i = 0; i < staged.size(); ++i) {
        const FolderBeneath at = folder_beneath(staged[i].place);
        const std::string reason =
            at.error.empty() ? put_in_place(at.folder.get(), at.name, staged[i].temporary) : at.error;
        if (reason.empty()) continue;
        for (size_t k = i; k < staged.size(); ++k) drop_temporary(staged[k]);
        for (size_t k = i; k-- > 0;) restore(staged[k]);
        return refused(files[i].place, reason);
    }
    return {};
}

std::string replace_file(const std::string& path, const std::string& bytes) {
    std::error_code error;
    if (const fs::path folder = fs::path(path).parent_path(); !folder.empty()) fs::create_directories(folder, error);
    const Destination to = destination_of(path);
    if (to.is_stream) return append(path, bytes);
    const fs::path place = to.path;
    const std::string folder = place.has_parent_path() ? place.parent_path().string() : ".";
    const std::string name = place.filename().string();
    const Descriptor open(::open(folder.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!open.valid()) return cannot_be_written(errno);
    sweep_temporaries(
        open.get(), [&](std::string_view file) { return file == name; }, false);
    return replace_in(open.get(), name, bytes);
}

std::string replace_file(const TreePath& path, const std::string& bytes) {
    const FolderBeneath at = folder_to_write(path);
    return at.error.empty() ? replace_in(at.folder.get(), at.name, bytes) : at.error;
}

void sweep_temporaries(int folder, const std::function<bool(std::string_view)>& is_swept, bool all) {
    const int again = ::openat(folder, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR* entries = again < 0 ? nullptr : ::fdopendir(again);
    if (entries == nullptr) return;
    std::vector<std::string> left;
    while (const dirent* entry = ::readdir(entries)) {
        int process = 0;
        const std::string_view file = temporary_of(entry->d_name, process);
        if (!file.empty() && is_swept(file) && (all || (::kill(process, 0) != 0 && errno == ESRCH)))
            left.emplace_back(entry->d_name);
    }
    for (const std::string& one : left) (void)::unlinkat(again, one.c_str(), 0);
    ::closedir(entries);
}

}  // namespace porttool
