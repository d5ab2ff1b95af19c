// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/beneath.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#if __has_include(<linux/openat2.h>)
#include <linux/openat2.h>
#endif

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <cstring>
#include <deque>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/read/glob.h"
#include "porttool/read/refusals.h"
#include "porttool/text/letters.h"

namespace porttool {
namespace {

/// What open(2) is always asked for. O_PATH opens nothing that could wait, and openat2(2) takes no O_NONBLOCK with it.
int with_care(int flags) { return flags | O_CLOEXEC | O_NOFOLLOW | ((flags & O_PATH) != 0 ? 0 : O_NONBLOCK); }

std::deque<std::string> components_of(std::string_view path) {
    const std::vector<std::string_view> names = split_path(path);
    return {names.begin(), names.end()};
}

/// Why a path is refused, or "" if it is not; then `code` is 0.
struct Refusal {
    std::string text;
    int code = 0;
};

Refusal out_of(const std::string& root) { return {leads_out(root), EXDEV}; }
Refusal in_git() { return {"lies in .git, which is never read", EXDEV}; }
Refusal is_link() { return {"is a link, or lies behind one, which is not followed here", ELOOP}; }
Refusal failed(int code) { return {cannot_be_read(code), code}; }

/// Goes from the root to a path by single steps, none of which follows a link by itself.
class Steps {
public:
    Steps(const TreePath& at, Descriptor root) : at_(at) { folders_.push_back(std::move(root)); }

    /// Goes to the folder of the last name, which is "." for the root itself.
    Refusal go() {
        ahead_ = components_of(at_.path);
        if (at_.path.starts_with('/')) return out_of(at_.root);
        while (!ahead_.empty()) {
            name_ = std::move(ahead_.front());
            ahead_.pop_front();
            if (const Refusal refusal = step(); refusal.code != 0) return refusal;
        }
        return {};
    }

    const Descriptor& folder() const { return folders_.back(); }
    Descriptor take_folder() { return std::move(folders_.back()); }
    const std::string& name() const { return name_; }
    /// The way without a link in it; "" where none was met.
    std::string end() const {
        std::string path;
        for (const std::string& folder : names_) path += folder + "/";
        return links_ == 0 ? "" : path + name_;
    }

private:
    static constexpr int kMostLinks = 40;  // as in the kernel

    Refusal step() {
        if (name_ == "..") {
            if (folders_.size() == 1) return out_of(at_.root);
            folders_.pop_back();
            names_.pop_back();
            name_ = ".";
            return {};
        }
        if (is_git_folder(name_)) return in_git();
        struct stat status {};
        if (::fstatat(folder().get(), name_.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0)
            return ahead_.empty() && errno == ENOENT ? Refusal{} : failed(errno);  // it may be there to be made
        if (S_ISLNK(status.st_mode)) {
            // The last name may stand for the link itself, to be replaced or removed; opening it fails.
            return ahead_.empty() && at_.links == Links::None ? Refusal{} : follow();
        }
        if (ahead_.empty()) return {};
        Descriptor next(::openat(folder().get(), name_.c_str(), O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
        if (!next.valid()) return failed(errno);
        folders_.push_back(std::move(next));
        names_.push_back(name_);
        return {};
    }

    Refusal follow() {
        if (at_.links == Links::None) return is_link();
        if (++links_ > kMostLinks) return failed(ELOOP);
        std::array<char, PATH_MAX> text{};
        const ssize_t length = ::readlinkat(folder().get(), name_.c_str(), text.data(), text.size());
        if (length < 0) return failed(errno);
        std::string target(text.data(), static_cast<size_t>(length));
        if (target.starts_with('/')) {
            std::error_code error;
            const std::string root = std::filesystem::canonical(at_.root, error).string() + "/";
            if (error || !target.starts_with(root)) return out_of(at_.root);
            target.erase(0, root.size());
            folders_.erase(folders_.begin() + 1, folders_.end());
            names_.clear();
        }
        const std::deque<std::string> parts = components_of(target);
        ahead_.insert(ahead_.begin(), parts.begin(), parts.end());
        name_ = ".";
        return {};
    }

    const TreePath& at_;
    std::vector<Descriptor> folders_;  ///< from the root to where we are
    std::vector<std::string> names_;   ///< of these but the root
    std::deque<std::string> ahead_;
    std::string name_ = ".";
    int links_ = 0;
};

Descriptor open_root(const std::string& root) {
    return Descriptor(::open(root.empty() ? "." : root.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
}

/// Asks the kernel to open what no link leads to. Not valid where it cannot, or there is a link.
Descriptor open_by_kernel([[maybe_unused]] int root, [[maybe_unused]] const TreePath& at, [[maybe_unused]] int flags) {
#ifdef RESOLVE_BENEATH
    struct open_how how {};
    how.flags = static_cast<uint64_t>(with_care(flags));
    how.resolve = RESOLVE_BENEATH | RESOLVE_NO_SYMLINKS | RESOLVE_NO_MAGICLINKS;
    const std::string path = at.path.empty() ? "." : at.path;
    return Descriptor(static_cast<int>(::syscall(SYS_openat2, root, path.c_str(), &how, sizeof how)));
#else
    errno = ENOSYS;
    return Descriptor();
#endif
}

}  // namespace

bool is_git_folder(std::string_view name) { return is_in_any_case(name, ".git"); }

bool names_git_folder(std::string_view path) {
    const auto parts = components_of(path);
    return std::any_of(parts.begin(), parts.end(), is_git_folder);
}

std::string leads_out(const std::string& root) { return "leads out of " + root + ", and is not followed"; }

std::string cannot_be_read(int code) { return std::string("cannot be read: ") + std::strerror(code); }

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
}

Descriptor::~Descriptor() {
    if (valid()) ::close(number_);
}

int Descriptor::release() { return std::exchange(number_, -1); }

OpenedBeneath open_beneath(const TreePath& at, int flags, OpenBy first) {
    Descriptor root = open_root(at.root);
    if (!root.valid()) return {Descriptor(), cannot_be_read(errno), errno};
    if (names_git_folder(at.path)) return {Descriptor(), in_git().text, in_git().code};
    if (first == OpenBy::Kernel) {
        Descriptor file = open_by_kernel(root.get(), at, flags);
        if (file.valid()) return {std::move(file), "", 0};
        // A link in the place of a folder is ENOTDIR here, too: the steps tell whether it leads to one.
        if (errno == ENOENT || errno == EACCES) return {Descriptor(), cannot_be_read(errno), errno};
    }
    Steps steps(at, std::move(root));
    if (const Refusal refusal = steps.go(); refusal.code != 0) return {Descriptor(), refusal.text, refusal.code};
    Descriptor file(::openat(steps.folder().get(), steps.name().c_str(), with_care(flags)));
    if (file.valid()) return {std::move(file), "", 0, steps.end()};
    const Refusal refusal = errno == ELOOP ? is_link() : failed(errno);
    return {Descriptor(), refusal.text, refusal.code};
}

FolderBeneath folder_beneath(const TreePath& at) {
    Descriptor root = open_root(at.root);
    if (!root.valid()) return {Descriptor(), "", cannot_be_read(errno), errno};
    Steps steps(at, std::move(root));
    if (const Refusal refusal = steps.go(); refusal.code != 0) return {Descriptor(), "", refusal.text, refusal.code};
    return {steps.take_folder(), steps.name(), "", 0};
}

}  // namespace porttool
