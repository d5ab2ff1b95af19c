// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace porttool {

/// Whether a link on the way to a file is followed.
enum class Links : uint8_t {
    Within,  ///< as long as it leads to something beneath the root
    None,    ///< not at all: what porttool alone writes holds no links
};

/// `.git` in any spelling that a file system may take for it: where a checkout keeps its credentials.
bool is_git_folder(std::string_view name);

/// A path that somebody else may have written: in a map, a lock, a glob or an `#include`. It is opened beneath `root`,
/// which is the user's own, or not at all; nor is anything in a folder `.git`, where a checkout keeps its credentials.
struct TreePath {
    std::string root;
    std::string path;  ///< relative to the root
    Links links = Links::Within;
};

/// A file descriptor that closes itself.
class Descriptor {
public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(other.release()) {}
    Descriptor& operator=(Descriptor&& other) noexcept;
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor();

    int get() const { return number_; }
    bool valid() const { return number_ >= 0; }
    int release();

private:
    int number_;
};

/// An open file, or why it is none, as the end of a sentence that the file's name begins. `errno` of the failed call is
/// kept; it is EXDEV for what lies out of the root or in `.git`.
struct OpenedBeneath {
    Descriptor file;
    std::string error;
    int code = 0;
    std::string end = {};  ///< where links led, seen from the root; "" where there was none on the way
};

/// Who resolves a path: the kernel at once (openat2(2), Linux 5.6), or we, step by step. The kernel is asked first; we
/// go on where there is a link on the way, or where the call is missing or denied, as in older containers.
enum class OpenBy : uint8_t { Kernel, Steps };

/// The ONE routine that opens what a tree names. `flags` as for open(2); O_CLOEXEC, O_NOFOLLOW and O_NONBLOCK are
/// added, so that a pipe in the place of a file does not wait. No step of the way can be exchanged for a link
/// meanwhile.
OpenedBeneath open_beneath(const TreePath& at, int flags, OpenBy first = OpenBy::Kernel);

/// The folder that a path lies in, opened, and its last name there, which is no link: for writing and removing.
struct FolderBeneath {
    Descriptor folder;
    std::string name;
    std::string error;
    int code = 0;
};
FolderBeneath folder_beneath(const TreePath& at);

}  // namespace porttool
