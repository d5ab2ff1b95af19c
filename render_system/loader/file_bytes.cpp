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
    throw LoadError{StatusCode::unreadable, std::string("cannot be read (") + std::strerror(error) + ")"};
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
    const Descriptor file{open(path.c_str(), O_RDONLY | O_CLOEXEC)};
    if (file.number < 0) fail_open(errno);
    struct stat info {};
    if (fstat(file.number, &info) != 0) fail_open(errno);
    if (!S_ISREG(info.st_mode)) {
        throw LoadError{StatusCode::unreadable, "is not a regular file; name the file itself"};
    }
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
