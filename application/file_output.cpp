// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/file_output.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

namespace application {
namespace {

using render_system::Result;
using render_system::Status;
using std::filesystem::path;

// The unfinished file, for the signal handler: a plain array, since a handler may not allocate.
std::array<char, 4096> unfinished_name{};
std::atomic<bool> unfinished{false};
static_assert(std::atomic<bool>::is_always_lock_free);
// The folders that were made, inner ones first, each with its null, and one more null behind the last.
std::array<char, 16384> made_folders{};

/// Those that are empty. For signal handlers, too.
void remove_empty_folders() {
    for (const char* name = made_folders.data(); *name != '\0'; name += std::strlen(name) + 1) rmdir(name);
}

Status cannot_write(const path& file, const std::string& reason) {
    return Status::invalid(fmt::format("cannot write {}: {}; give another place to write to", file.string(), reason));
}

Status cannot_write(const path& file, int error) { return cannot_write(file, std::string(std::strerror(error))); }

/// An unfinished file: made beside its place, gone with this object unless put into its place.
class UnfinishedFile {
public:
    explicit UnfinishedFile(const path& place)
        : place_(place), name_(place.parent_path() / fmt::format(".{}.{}", getpid(), place.filename().string())) {
        const std::string name = name_.string();
        if (name.size() >= unfinished_name.size()) {
            error_ = ENAMETOOLONG;
            return;
        }
        std::memcpy(unfinished_name.data(), name.c_str(), name.size() + 1);
        unfinished.store(true);
        descriptor_ = open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
        error_ = descriptor_ < 0 ? errno : 0;
    }
    ~UnfinishedFile() {
        if (descriptor_ >= 0) {
            close(descriptor_);
            unlink(name_.c_str());
        }
        unfinished.store(false);
    }
    UnfinishedFile(const UnfinishedFile&) = delete;
    UnfinishedFile& operator=(const UnfinishedFile&) = delete;

    int error() const { return error_; }
    int descriptor() const { return descriptor_; }

    /// Closes the file and gives it its name. Answers an errno, 0 where all went well.
    int finish(bool durably) {
        if (durably && fdatasync(descriptor_) != 0) error_ = errno;
        if (close(descriptor_) != 0) error_ = errno;
        descriptor_ = -1;
        if (error_ == 0 && rename(name_.c_str(), place_.c_str()) != 0) error_ = errno;
        if (error_ != 0) unlink(name_.c_str());
        return error_;
    }

private:
    path place_;
    path name_;
    int descriptor_ = -1;
    int error_ = 0;
};

/// Answers an errno, 0 where all was written.
int write_all(int descriptor, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) return errno;
        if (written > 0) bytes.remove_prefix(static_cast<size_t>(written));
    }
    return 0;
}

/// Where a file of that name really goes: behind symbolic links, so that these stay.
path place_behind_links(const path& file) {
    std::error_code error;
    const path real = std::filesystem::canonical(file, error);
    return error ? file : real;
}

/// A device or a pipe has no neighbour to be renamed from.
bool is_special(const path& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
           !std::filesystem::is_directory(status);
}

/// A pipe that was found to have a reader. It stays open until it is written: to the reader, closing it is the end.
struct HeldPipe {
    dev_t device;
    ino_t number;
    int descriptor;
};
std::vector<HeldPipe> held_pipes;

/// The descriptor of a pipe, a held one too; never waits for a reader.
Result<int> open_pipe(const path& file, const struct stat& info) {
    const auto held = std::find_if(held_pipes.begin(), held_pipes.end(), [&](const HeldPipe& pipe) {
        return pipe.device == info.st_dev && pipe.number == info.st_ino;
    });
    if (held != held_pipes.end()) {
        const int descriptor = held->descriptor;
        held_pipes.erase(held);
        return descriptor;
    }
    const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0 && errno == ENXIO) return cannot_write(file, std::string("it is a pipe that nobody reads from"));
    if (descriptor < 0) return cannot_write(file, errno);
    fcntl(descriptor, F_SETFL, fcntl(descriptor, F_GETFL) & ~O_NONBLOCK);
    return descriptor;
}

Result<int> open_special(const path& file) {
    struct stat info {};
    if (stat(file.c_str(), &info) != 0) return cannot_write(file, errno);
    if (S_ISFIFO(info.st_mode)) return open_pipe(file, info);
    const int descriptor = open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) return cannot_write(file, errno);
    return descriptor;
}

/// A device is not opened for this: it may act.
Status check_special(const path& file) {
    struct stat info {};
    if (stat(file.c_str(), &info) != 0) return cannot_write(file, errno);
    if (S_ISSOCK(info.st_mode)) return cannot_write(file, std::string("it is a socket"));
    if (!S_ISFIFO(info.st_mode)) return Status::success();
    const auto descriptor = open_pipe(file, info);
    if (descriptor.ok()) held_pipes.push_back({info.st_dev, info.st_ino, *descriptor});
    return descriptor.status;
}

Status write_special(const path& file, std::string_view bytes) {
    const auto descriptor = open_special(file);
    if (!descriptor.ok()) return descriptor.status;
    const int error = write_all(*descriptor, bytes);
    close(*descriptor);
    return error == 0 ? Status::success() : cannot_write(file, error);
}

Status check_place(const path& file) {
    std::error_code error;
    if (file.filename().empty() || std::filesystem::is_directory(file, error)) {
        return cannot_write(file, std::string("it is a folder"));
    }
    const path folder = file.has_parent_path() ? file.parent_path() : path(".");
    if (!std::filesystem::exists(folder, error)) {
        return cannot_write(file, fmt::format("there is no folder {}", folder.string()));
    }
    return Status::success();
}

/// Writes beside the file and renames.
Status put_in_place(const path& file, std::string_view bytes, bool durably) {
    if (Status status = check_place(file); !status.ok()) return status;
    if (is_special(file)) return write_special(file, bytes);
    UnfinishedFile unfinished_file(place_behind_links(file));
    if (unfinished_file.error() != 0) return cannot_write(file, unfinished_file.error());
    if (const int error = write_all(unfinished_file.descriptor(), bytes); error != 0) return cannot_write(file, error);
    const int error = unfinished_file.finish(durably);
    return error == 0 ? Status::success() : cannot_write(file, error);
}

}  // namespace

Status check_writable(const path& file) {
    if (Status status = check_place(file); !status.ok()) return status;
    if (is_special(file)) return check_special(file);
    const UnfinishedFile probe(place_behind_links(file));
    return probe.error() == 0 ? Status::success() : cannot_write(file, probe.error());
}

Status write_file(const path& file, std::string_view bytes) { return put_in_place(file, bytes, false); }

Status write_file_durably(const path& file, std::string_view bytes) { return put_in_place(file, bytes, true); }

Result<int> open_emptied(const path& file) {
    if (Status status = check_place(file); !status.ok()) return status;
    if (is_special(file)) return open_special(file);
    const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (descriptor < 0) return cannot_write(file, errno);
    return descriptor;
}

FolderToFill::FolderToFill(const path& folder) {
    if (folder.empty()) return;
    std::error_code error;
    std::string missing;
    // Not `a/`, whose parent is `a`.
    for (path part = folder.has_filename() ? folder : folder.parent_path();
         !part.empty() && !std::filesystem::exists(part, error); part = part.parent_path())
        missing += part.string() + '\0';
    if (missing.size() + 1 < made_folders.size()) std::copy(missing.begin(), missing.end(), made_folders.begin());
    std::filesystem::create_directories(folder, error);
    status_ = error ? Status::invalid(fmt::format("cannot make the folder {}: {}; give another place to write to",
                                                  folder.string(), error.message()))
                    : check_writable(folder / "source.png");
}

FolderToFill::~FolderToFill() {
    remove_empty_folders();
    made_folders.fill('\0');
}

void remove_unfinished_file_and_end(int signal_number) {
    if (unfinished.load()) unlink(unfinished_name.data());
    remove_empty_folders();
    signal(signal_number, SIG_DFL);
    raise(signal_number);
}

void remove_unfinished_file_on_signals() {
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        if (signal(number, remove_unfinished_file_and_end) == SIG_IGN) signal(number, SIG_IGN);
    // Past a limit on the size of files, writing is to fail and be told, not to end the program.
    signal(SIGXFSZ, SIG_IGN);
}

}  // namespace application
