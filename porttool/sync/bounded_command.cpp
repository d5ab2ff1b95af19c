// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/bounded_command.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include "porttool/read/beneath.h"
#include "porttool/read/cannot_do.h"
#include "porttool/read/child_process.h"

namespace porttool {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTimedOut = 124;
constexpr size_t kTail = 8192;  ///< bytes of output that are kept

/// What ends us while a command runs, and must end the command first; not what we ignore, as under nohup.
sigset_t ending_signals() {
    sigset_t set;
    ::sigemptyset(&set);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
        struct sigaction action {};
        if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_IGN) ::sigaddset(&set, signal);
    }
    return set;
}

/// Holds the ending signals back, to be read one by one.
class HeldSignals {
public:
    HeldSignals() {
        const sigset_t held = ending_signals();
        ::pthread_sigmask(SIG_BLOCK, &held, &before_);
        reader_ = Descriptor(::signalfd(-1, &held, SFD_CLOEXEC | SFD_NONBLOCK));
    }
    ~HeldSignals() {
        ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
        if (taken_ != 0) (void)::raise(taken_);
    }
    HeldSignals(const HeldSignals&) = delete;
    HeldSignals& operator=(const HeldSignals&) = delete;

    int reader() const { return reader_.get(); }
    const sigset_t& before() const { return before_; }
    /// True once one has come; it does its work when they are held no more.
    bool came() {
        signalfd_siginfo info{};
        if (taken_ == 0 && ::read(reader_.get(), &info, sizeof info) == static_cast<ssize_t>(sizeof info))
            taken_ = static_cast<int>(info.ssi_signo);
        return taken_ != 0;
    }

private:
    sigset_t before_{};
    Descriptor reader_;
    int taken_ = 0;
};

/// The environment without what git gives to its hooks.
std::vector<char*> environment_of_command() {
    constexpr std::array<std::string_view, 8> kOfHooks = {
        "GIT_DIR=",        "GIT_WORK_TREE=",        "GIT_INDEX_FILE=",
        "GIT_PREFIX=",     "GIT_OBJECT_DIRECTORY=", "GIT_ALTERNATE_OBJECT_DIRECTORIES=",
        "GIT_COMMON_DIR=", "GIT_NAMESPACE="};
    std::vector<char*> out;
    for (char** one = environ; *one != nullptr; ++one)
        if (std::none_of(kOfHooks.begin(), kOfHooks.end(),
                         [&](std::string_view name) { return std::string_view(*one).starts_with(name); }))
            out.push_back(*one);
    out.push_back(nullptr);
    return out;
}

/// Starts the shell as the head of a process group of its own. Returns its number, or 0 with `errno` set.
pid_t start_shell(const std::string& command, const std::string& folder, int output, const sigset_t& mask) {
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t settings;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawnattr_init(&settings);
    ::posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
    ::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDOUT_FILENO);
    ::posix_spawn_file_actions_adddup2(&actions, output, STDERR_FILENO);
    ::posix_spawnattr_setflags(&settings, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);
    ::posix_spawnattr_setpgroup(&settings, 0);
    ::posix_spawnattr_setsigmask(&settings, &mask);
    std::string shell = "sh", option = "-c", text = command;
    std::array<char*, 4> arguments = {shell.data(), option.data(), text.data(), nullptr};
    const std::vector<char*> environment = environment_of_command();
    pid_t child = 0;
    errno = ::posix_spawn(&child, "/bin/sh", &actions, &settings, arguments.data(), environment.data());
    const int code = errno;
    ::posix_spawnattr_destroy(&settings);
    ::posix_spawn_file_actions_destroy(&actions);
    errno = code;
    return code == 0 ? child : 0;
}

/// Takes what has been printed so far; false at its end.
bool take_output(int pipe, std::string& tail) {
    return take_available(pipe, [&](std::string_view text) {
        tail += text;
        if (tail.size() > 4 * kTail) tail.erase(0, tail.size() - 2 * kTail);
    });
}

/// The last whole lines that fit.
std::string last_lines(std::string text) {
    if (text.size() <= kTail) return text;
    text.erase(0, text.size() - kTail);
    const size_t line = text.find('\n');
    return line == std::string::npos || line + 1 == text.size() ? text : text.substr(line + 1);
}

}  // namespace

CommandEnd run_bounded(const std::string& command, const std::string& folder, std::chrono::milliseconds limit) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        throw CannotDo(std::string("no pipe can be made: ") + std::strerror(errno));
    const Descriptor reader(ends[0]);
    Descriptor writer(ends[1]);
    (void)::fcntl(reader.get(), F_SETFL, O_NONBLOCK);
    HeldSignals signals;
    const auto start = Clock::now();
    const pid_t child = start_shell(command, folder, writer.get(), signals.before());
    if (child == 0) throw CannotDo(std::string("/bin/sh cannot be started: ") + std::strerror(errno));
    writer = Descriptor();

    CommandEnd out;
    int status = 0;
    bool open = true;
    constexpr int kPause = 20;  // milliseconds between two looks at whether the shell has ended
    while (::waitpid(child, &status, WNOHANG) == 0) {
        out.timed_out = Clock::now() - start >= limit;
        if (out.timed_out || signals.came()) {
            (void)::kill(-child, SIGKILL);
            while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
            }
            break;
        }
        std::array<pollfd, 2> watched = {pollfd{signals.reader(), POLLIN, 0},
                                         pollfd{open ? reader.get() : -1, POLLIN, 0}};
        (void)::poll(watched.data(), watched.size(), kPause);
        if (open) open = take_output(reader.get(), out.output_tail);
    }
    (void)::kill(-child, SIGKILL);  // what the shell has left behind
    if (open) take_output(reader.get(), out.output_tail);
    out.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    out.exit_code = out.timed_out ? kTimedOut : exit_code_of(status);
    out.output_tail = last_lines(std::move(out.output_tail));
    return out;
}

}  // namespace porttool
