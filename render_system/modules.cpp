// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/modules.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/sendfile.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <tuple>

#include "render_system/module_file.h"

namespace render_system {

namespace {

std::filesystem::path folder_of_environment() {
    const char* named = secure_getenv(kModulesVariable);
    return named == nullptr ? "" : named;
}

bool anybody_may_write(const std::filesystem::path& path) {
    struct stat found {};
    return ::stat(path.c_str(), &found) == 0 && (found.st_mode & S_IWOTH) != 0;
}

/// A file in memory with the bytes of that one; -1 where that cannot be. As long as it is open no other gets its name,
/// under which the loader remembers what it has loaded.
int copy_in_memory(const std::filesystem::path& file) {
    const int from = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (from < 0) return -1;
    const int to = ::memfd_create(file.filename().c_str(), MFD_CLOEXEC);
    ssize_t moved = to < 0 ? -1 : 1;
    constexpr size_t kMost = size_t{1} << 30;
    while (moved > 0) moved = ::sendfile(to, from, nullptr, kMost);
    const int error = errno;
    (void)::close(from);
    if (moved == 0) return to;
    if (to >= 0) (void)::close(to);
    errno = error;
    return -1;
}

Status refused(const std::filesystem::path& file, const std::string& why) {
    return Status::error(StatusCode::unreadable, file.string() + " " + why);
}

Result<void*> open_library(const std::filesystem::path& file, const std::string& name) {
    void* module = dlopen(name.c_str(), RTLD_LAZY | RTLD_LOCAL);
    if (module != nullptr) return module;
    std::string said = dlerror();
    if (said.starts_with(name + ": ")) said.erase(0, name.size() + 2);
    return refused(file, "cannot be loaded: " + said);
}

/// Each state of a file is loaded once: of that which did not change since the last time, what was loaded then.
Result<void*> open_copy(const std::filesystem::path& file) {
    using State = std::tuple<dev_t, ino_t, off_t, time_t, long>;
    static std::mutex mutex;
    static std::map<State, void*> opened;
    const std::lock_guard lock(mutex);
    struct stat now {};
    (void)::stat(file.c_str(), &now);
    const State state{now.st_dev, now.st_ino, now.st_size, now.st_mtim.tv_sec, now.st_mtim.tv_nsec};
    if (const auto found = opened.find(state); found != opened.end()) return found->second;
    const int copy = copy_in_memory(file);
    if (copy < 0) return refused(file, std::string("cannot be copied into memory: ") + std::strerror(errno));
    // The copy is looked at: the file may have been cut short in between.
    const std::string name = "/proc/self/fd/" + std::to_string(copy);
    const Status whole = check_module_file(name);
    auto module = whole.ok() ? open_library(file, name) : refused(file, whole.message.substr(name.size() + 1));
    if (module.ok())
        opened.emplace(state, *module);
    else
        (void)::close(copy);
    return module;
}

}  // namespace

std::vector<std::filesystem::path> module_folders() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path above = program.parent_path().parent_path();
    std::vector<std::filesystem::path> folders = {above / PATHTRACER_FOLDER, above.parent_path() / PATHTRACER_FOLDER};
    if (const auto named = folder_of_environment(); !named.empty()) folders.insert(folders.begin(), named);
    return folders;
}

Status check_module_folders() {
    const std::filesystem::path named = folder_of_environment();
    if (named.empty()) return Status::success();
    std::error_code error;
    std::string wrong;
    if (!named.is_absolute())
        wrong = "is not a whole path; begin it with /";
    else if (!std::filesystem::is_directory(named, error))
        wrong = "is no folder; make it, or unset the variable";
    else if (anybody_may_write(named))
        wrong = "can be written by anybody, and what lies there would be run; chmod o-w it";
    if (wrong.empty()) return Status::success();
    return Status::invalid(std::string(kModulesVariable) + ": " + named.string() + " " + wrong);
}

Result<std::filesystem::path> find_module(const std::string& name) {
    const auto folders = module_folders();
    for (const auto& folder : folders) {
        std::error_code error;
        // A link that leads nowhere is found too, and refused when it is loaded.
        if (std::filesystem::symlink_status(folder / name, error).type() != std::filesystem::file_type::not_found)
            return folder / name;
    }
    return Status::error(StatusCode::not_found,
                         "there is no " + (folders[folders.size() - 2] / name).string() + "; install the program anew");
}

Result<void*> load_module(const std::filesystem::path& file, const char* symbol, ModuleSource source) {
    if (Status status = check_module_file(file); !status.ok()) return status;
    if (file.parent_path() / "" == folder_of_environment() / "" && anybody_may_write(file))
        return refused(file, "can be written by anybody; chmod o-w it");
    const auto module = source == ModuleSource::copy ? open_copy(file) : open_library(file, file.string());
    if (!module.ok()) return module;
    void* address = dlsym(*module, symbol);
    if (address == nullptr) return refused(file, std::string("exports no ") + symbol);
    return address;
}

}  // namespace render_system
