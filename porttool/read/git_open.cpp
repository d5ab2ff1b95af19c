// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/git_open.h"

#include <fmt/format.h>
#include <git2/sys/alloc.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <new>
#include <string_view>
#include <utility>

#include "porttool/read/cannot_do.h"
#include "porttool/read/disk.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {

namespace {

/// The most that libgit2 gets at once: more than the index of the most files that are read. A commit, a folder or what
/// a small object is kept as a difference to may otherwise be gigabytes, out of a few kilobytes of a pack; libgit2
/// reads all of these by itself, and whole.
constexpr size_t kMostAtOnce = size_t{256} << 20;
thread_local size_t refused_bytes = 0;

bool is_refused(size_t bytes) {
    if (bytes <= kMostAtOnce) return false;
    refused_bytes = bytes;
    return true;
}

bool is_refused(size_t count, size_t each) {
    size_t bytes = 0;
    return is_refused(__builtin_mul_overflow(count, each, &bytes) ? SIZE_MAX : bytes);
}

/// That of the C library, within that bound.
git_allocator bounded_allocator() {
    git_allocator out{};
    out.gmalloc = [](size_t size, const char*, int) { return is_refused(size) ? nullptr : std::malloc(size); };
    out.gcalloc = [](size_t count, size_t each, const char*, int) {
        return is_refused(count, each) ? nullptr : std::calloc(count, each);
    };
    out.gstrdup = [](const char* text, const char*, int) {
        return is_refused(std::strlen(text)) ? nullptr : ::strdup(text);
    };
    out.gstrndup = [](const char* text, size_t most, const char*, int) {
        return is_refused(::strnlen(text, most)) ? nullptr : ::strndup(text, most);
    };
    out.gsubstrdup = [](const char* text, size_t size, const char*, int) {
        char* copy = is_refused(size) ? nullptr : static_cast<char*>(std::malloc(size + 1));
        if (copy != nullptr) {
            std::memcpy(copy, text, size);
            copy[size] = '\0';
        }
        return copy;
    };
    out.grealloc = [](void* from, size_t size, const char*, int) {
        return is_refused(size) ? nullptr : std::realloc(from, size);
    };
    out.greallocarray = [](void* from, size_t count, size_t each, const char*, int) {
        return is_refused(count, each) ? nullptr : std::realloc(from, count * each);
    };
    out.gmallocarray = [](size_t count, size_t each, const char*, int) {
        return is_refused(count, each) ? nullptr : std::malloc(count * each);
    };
    out.gfree = [](void* memory) { std::free(memory); };
    return out;
}

/// What libgit2 could not do for lack of memory is no fault of the repository: throws std::bad_alloc, as our own code
/// does.
void tell_lack_of_memory() {
    tell_refused_object();
    const git_error* error = git_error_last();
    if (error == nullptr) return;
    const std::string_view message = error->message != nullptr ? error->message : "";
    if (error->klass == GIT_ERROR_NOMEMORY || message.find(std::strerror(ENOMEM)) != std::string_view::npos)
        throw std::bad_alloc();
}

}  // namespace

void tell_refused_object() {
    if (const size_t bytes = std::exchange(refused_bytes, 0); bytes != 0)
        throw CannotDo(
            fmt::format("git has a commit or folder of {} MiB here, or a file that is kept as a difference to so large "
                        "a one; more than {} are not read\nFind it with: git cat-file --batch-all-objects "
                        "--batch-check; and leave it out, with another --since, --from, --to or --base",
                        bytes >> 20, kMostAtOnce >> 20));
}

std::string git_last_error() {
    tell_lack_of_memory();
    const git_error* error = git_error_last();
    return error != nullptr && error->message != nullptr ? terminal_text(error->message) : "no reason given";
}

OwnedCommit git_commit_at(git_repository* repository, const git_oid& id) {
    git_commit* commit = nullptr;
    return OwnedCommit(git_commit_lookup(&commit, repository, &id) == 0 ? commit : nullptr);
}

OwnedTree git_tree_at(git_repository* repository, const git_oid& id) {
    git_tree* tree = nullptr;
    return OwnedTree(git_tree_lookup(&tree, repository, &id) == 0 ? tree : nullptr);
}

OwnedTree git_tree_of(const git_commit* commit) {
    git_tree* tree = nullptr;
    return OwnedTree(git_commit_tree(&tree, commit) == 0 ? tree : nullptr);
}

OwnedIndex git_index_of(git_repository* repository) {
    git_index* index = nullptr;
    return OwnedIndex(git_repository_index(&index, repository) == 0 ? index : nullptr);
}

std::optional<git_oid> git_oid_of(const std::string& text) {
    git_oid id{};
    if (text.size() != GIT_OID_HEXSZ || git_oid_fromstr(&id, text.c_str()) != 0) return std::nullopt;
    return id;
}

std::optional<GitBlob> read_git_blob(git_repository* repository, const git_oid& id) {
    using Objects = GitOwned<git_odb, git_odb_free>;
    using Blob = GitOwned<git_blob, git_blob_free>;
    git_odb* objects = nullptr;
    if (git_repository_odb(&objects, repository) != 0) return std::nullopt;
    const Objects objects_owner(objects);
    GitBlob out;
    size_t size = 0;
    git_object_t type = GIT_OBJECT_INVALID;
    git_blob* blob = nullptr;
    git_error_clear();  // one of before is not this one's
    const bool has_size = git_odb_read_header(&size, &type, objects, &id) == 0;
    out.size = size;
    if (has_size && size > kLargestFile) return out;
    if (!has_size || git_blob_lookup(&blob, repository, &id) != 0) {
        tell_lack_of_memory();
        return std::nullopt;
    }
    const Blob owner(blob);
    out.bytes.assign(static_cast<const char*>(git_blob_rawcontent(blob)), static_cast<size_t>(git_blob_rawsize(blob)));
    return out;
}

void EntryCount::add(size_t entries) {
    met_ += entries;
    if (met_ > kMostEntries)
        throw CannotDo(
            fmt::format("{} has, or changes, more than {} files and folders; a few bytes can stand for that many\n"
                        "Leave it out of what is read: with another --since, --from, --to or --base",
                        where_, kMostEntries));
}

namespace {

/// The nearest `.git` upwards, which no commit can bring along; "" if there is none. A folder that only looks like a
/// repository (HEAD, objects, refs) may be a part of what is proposed.
std::string git_entry_above(const std::string& root) {
    std::error_code error;
    for (std::filesystem::path at = std::filesystem::canonical(root, error); !error; at = at.parent_path()) {
        if (std::filesystem::exists(at / ".git", error)) return (at / ".git").string();
        if (at == at.parent_path()) break;
    }
    return {};
}

/// The file of a repository that is no file, as a pipe that libgit2 would wait for without end; "" if there is none.
std::string waiting_file(const std::string& folder) {
    std::error_code error;
    for (const char* name : {"config", "HEAD", "index", "packed-refs", "shallow", "commondir"})
        if (const std::filesystem::file_status status =
                std::filesystem::status(std::filesystem::path(folder) / name, error);
            std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
            return join_path(folder, name);
    return {};
}

}  // namespace

git_repository* open_work_tree(const std::string& git_entry) {
    git_repository* repository = nullptr;
    const unsigned flags = GIT_REPOSITORY_OPEN_NO_SEARCH;
    return git_repository_open_ext(&repository, git_entry.c_str(), flags, nullptr) == 0 ? repository : nullptr;
}

OpenedGit open_git(const std::string& root, const std::string& remedy) {
    git_libgit2_init();
    static std::once_flag bounded;
    std::call_once(bounded, [] {
        static git_allocator allocator = bounded_allocator();
        git_libgit2_opts(GIT_OPT_SET_ALLOCATOR, &allocator);
    });
    // Objects are only read: that the work tree belongs to another user (as in CI containers) does no harm. Nor do
    // extensions about how a work tree is written (`git sparse-checkout` sets one), or how objects are kept and
    // fetched: one that a partial clone lacks cannot be read, and is told.
    git_libgit2_opts(GIT_OPT_SET_OWNER_VALIDATION, 0);
    const char* extensions[] = {"worktreeconfig", "partialclone", "preciousobjects"};
    git_libgit2_opts(GIT_OPT_SET_EXTENSIONS, extensions, std::size(extensions));
    // Who fetched an object has asked whether it is the one that its name says; git does not ask again where it checks
    // files out either.
    git_libgit2_opts(GIT_OPT_ENABLE_STRICT_HASH_VERIFICATION, 0);
    OpenedGit out;
    const std::string entry = git_entry_above(root);
    out.is_there = !entry.empty();
    std::string waiting = entry.empty() ? "" : waiting_file(entry);
    git_repository* repository = entry.empty() || !waiting.empty() ? nullptr : open_work_tree(entry);
    if (repository != nullptr) waiting = waiting_file(git_repository_path(repository));  // of a linked work tree
    if (git_repository* bare = entry.empty() ? open_work_tree(root) : nullptr) {
        git_repository_free(bare);
        out.error = terminal_text(root) + " is a bare repository; porttool needs a work tree: git worktree add";
        return out;
    }
    if (!waiting.empty()) {
        git_repository_free(repository);
        out.error = terminal_text(waiting) + " is no file, and is not read\n" + remedy + ": git -C " +
                    terminal_text(shell_quoted(root)) + " status";
        return out;
    }
    if (repository == nullptr) {
        out.error = terminal_text(root) + " is in no git repository that can be read (" +
                    (entry.empty() ? "there is no .git above it" : git_last_error()) + ")\n" + remedy + ": git -C " +
                    terminal_text(shell_quoted(root)) + " status";
        return out;
    }
    out.repository.reset(repository);
    const char* workdir = git_repository_workdir(repository);
    if (workdir == nullptr) {
        out.error = terminal_text(root) + " is a bare repository; porttool needs a work tree: git worktree add";
        return out;
    }
    std::error_code error;
    const auto below = std::filesystem::relative(std::filesystem::canonical(root, error),
                                                 std::filesystem::canonical(workdir, error), error);
    const std::string path = below.generic_string();
    if (path == ".." || path.starts_with("../")) {
        out.error = terminal_text(root) + " is not in the work tree of its repository, which is " +
                    terminal_text(workdir) + "\nSee what sets it with: git config --show-origin core.worktree";
        return out;
    }
    out.prefix = path == "." || path.empty() ? "" : path + "/";
    return out;
}

}  // namespace porttool
