// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/file_bytes.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

[[noreturn]] void fail_open(int error) {
    if (error == ENOENT || error == ENOTDIR) {
        throw LoadError{StatusCode::not_found, "there is no such file; check the path"};
    }
    throw LoadError{StatusCode::unreadable,
                    std::string("cannot be read (") + std::strerror(error) + "); see its rights and the disk"};
}

// What opening would wait for, or would set off, is asked for first: a pipe waits for its writer, a device may act.
void refuse_what_is_no_file(const struct stat& info) {
    if (S_ISREG(info.st_mode)) return;
    const char* kind = S_ISDIR(info.st_mode)    ? "a folder"
                       : S_ISFIFO(info.st_mode) ? "a pipe"
                       : S_ISSOCK(info.st_mode) ? "a socket"
                                                : "a device";
    throw LoadError{StatusCode::unreadable, std::string("is not a regular file but ") + kind + "; name the file itself",
                    true};
}

// Closes the descriptor on every way out.
struct Descriptor {
    int number;
    ~Descriptor() {
        if (number >= 0) close(number);
    }
};

}  // namespace

FileBytes::FileBytes(const std::filesystem::path& path) {
    struct stat info {};
    if (stat(path.c_str(), &info) != 0) fail_open(errno);
    refuse_what_is_no_file(info);
    // It may have been exchanged meanwhile: opening still does not wait, and what was opened is asked once more.
    const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY)};
    if (file.number < 0) fail_open(errno);
    if (fstat(file.number, &info) != 0) fail_open(errno);
    refuse_what_is_no_file(info);
    if (info.st_size == 0) return;
    void* data = mmap(nullptr, static_cast<size_t>(info.st_size), PROT_READ, MAP_PRIVATE, file.number, 0);
    if (data == MAP_FAILED) fail_open(errno);
    data_ = static_cast<const std::byte*>(data);
    size_ = static_cast<size_t>(info.st_size);
}

FileBytes::FileBytes(FileBytes&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

FileBytes& FileBytes::operator=(FileBytes&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
}

FileBytes::~FileBytes() {
    if (data_) munmap(const_cast<std::byte*>(data_), size_);
}

void FileBytes::release_pages() const {
    // Private, read-only pages are clean, so dropping them loses nothing.
    if (data_) madvise(const_cast<std::byte*>(data_), size_, MADV_DONTNEED);
}

}  // namespace render_system
