// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/import_process.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <filesystem>

#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

// What any file may take, and what more per byte of it: FBX and OBJ take 20 times their size, Draco packs 50 to 1.
constexpr uint64_t kImportBytes = uint64_t{3} << 29;
constexpr uint64_t kImportBytesPerByte = 128;
constexpr uint64_t kImportSeconds = 20;
constexpr uint64_t kBytesPerImportSecond = uint64_t{1} << 18;

// A file without a name, gone with its last user.
class NamelessFile {
public:
    explicit NamelessFile(const char* label) : file_(memfd_create(label, MFD_CLOEXEC)) {
        if (file_ < 0) fail_at("", "cannot be imported: no memory for it is left");
    }
    NamelessFile(const NamelessFile&) = delete;
    NamelessFile& operator=(const NamelessFile&) = delete;
    ~NamelessFile() { close(file_); }

    int descriptor() const { return file_; }
    FileBytes bytes() const { return FileBytes("/proc/self/fd/" + std::to_string(file_)); }

    void fill(std::span<const std::byte> bytes) {
        while (!bytes.empty()) {
            const ssize_t written = write(file_, bytes.data(), bytes.size());
            if (written < 0 && errno == EINTR) continue;
            if (written <= 0) fail_at("", "cannot be imported: no memory for it is left");
            bytes = bytes.subspan(static_cast<size_t>(written));
        }
        lseek(file_, 0, SEEK_SET);
    }

private:
    int file_;
};

// Beside the program, or one folder up: programs of a sanitized build lie below the others.
std::string importer_path() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    const std::filesystem::path beside = program.parent_path() / "pathtracer-import";
    const std::filesystem::path above = program.parent_path().parent_path() / "pathtracer-import";
    return std::filesystem::exists(beside, error) ? beside : above;
}

// Its exit status.
int run_to_end(const std::vector<std::string>& words, int input, int output, int errors) {
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, input, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, errors, STDERR_FILENO);
    pid_t child = -1;
    const int error = posix_spawn(&child, words[0].c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (error != 0) fail_at("", "cannot be imported: " + words[0] + " does not start; install the program anew");
    int status = 0;
    while (waitpid(child, &status, 0) < 0) {
        if (errno != EINTR) fail_at("", "cannot be imported: its importer was lost; try again");
    }
    return status;
}

// The first line of what it said, without what a terminal would obey.
std::string first_line(const FileBytes& said) {
    constexpr size_t kLongest = 300;
    std::string line;
    for (std::byte byte : said.bytes().first(std::min(said.bytes().size(), kLongest))) {
        const char c = static_cast<char>(byte);
        if (c == '\n') break;
        line += static_cast<unsigned char>(c) < 0x20 || c == 0x7F ? ' ' : c;
    }
    return line;
}

std::string end_of(int status, const FileBytes& said) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 2 && !said.bytes().empty()) return first_line(said);
    const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
    if (signal == SIGXCPU || signal == SIGALRM || signal == SIGKILL) {
        return "takes longer to import than a file of its size should; convert it to glTF";
    }
    if (signal == SIGXFSZ) return "holds far more than its size lets expect; convert it to glTF";
    return "ends its importer (" + (signal > 0 ? "signal " + std::to_string(signal) : std::string("no reason given")) +
           "); the file is damaged, export it again or convert it to glTF";
}

}  // namespace

FileBytes run_importer(const ImportRequest& request) {
    NamelessFile input("import request"), output("import answer"), errors("import errors");
    input.fill(request.input);
    const uint64_t bytes = kImportBytes + kImportBytesPerByte * request.file_bytes;
    const uint64_t seconds = kImportSeconds + request.file_bytes / kBytesPerImportSecond;
    std::vector<std::string> words{importer_path(), request.format, std::to_string(bytes), std::to_string(seconds)};
    words.insert(words.end(), request.arguments.begin(), request.arguments.end());
    const int status = run_to_end(words, input.descriptor(), output.descriptor(), errors.descriptor());
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) fail_at("", end_of(status, errors.bytes()));
    return output.bytes();
}

}  // namespace render_system
