// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/side_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

extern char** environ;

namespace application {
namespace {

/// What can be read by now; the pipe is closed at its end.
void drain(int& pipe, std::string& text) {
    std::array<char, 16384> room{};
    while (pipe >= 0) {
        const ssize_t got = ::read(pipe, room.data(), room.size());
        if (got > 0) text.append(room.data(), static_cast<size_t>(got));
        if (got > 0 || (got < 0 && errno == EINTR)) continue;
        if (got < 0 && errno == EAGAIN) return;
        (void)::close(std::exchange(pipe, -1));
    }
}

}  // namespace

SideProcess::SideProcess(const std::vector<std::string>& arguments) {
    posix_spawn_file_actions_t actions;
    (void)::posix_spawn_file_actions_init(&actions);
    (void)::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    std::array<int, 2> writers{-1, -1};
    for (size_t i = 0; i < pipes_.size(); ++i) {
        std::array<int, 2> ends{-1, -1};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) continue;
        (void)::fcntl(ends[0], F_SETFL, O_NONBLOCK);  // this end alone: a program may not expect it of its stdout
        pipes_[i] = ends[0];
        writers[i] = ends[1];
        (void)::posix_spawn_file_actions_adddup2(&actions, ends[1], i == 0 ? STDOUT_FILENO : STDERR_FILENO);
    }
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    const bool has_pipes = pipes_[0] >= 0 && pipes_[1] >= 0;
    if (!has_pipes || ::posix_spawn(&process_, pointers[0], &actions, nullptr, pointers.data(), environ) != 0)
        process_ = -1;
    (void)::posix_spawn_file_actions_destroy(&actions);
    for (const int writer : writers)
        if (writer >= 0) (void)::close(writer);
}

SideProcess& SideProcess::operator=(SideProcess&& other) noexcept {
    if (this == &other) return *this;
    end();
    process_ = std::exchange(other.process_, -1);
    pipes_ = std::exchange(other.pipes_, {-1, -1});
    texts_ = std::exchange(other.texts_, {});
    exit_code_ = std::exchange(other.exit_code_, std::nullopt);
    return *this;
}

void SideProcess::update() {
    for (size_t i = 0; i < pipes_.size(); ++i) drain(pipes_[i], texts_[i]);
    if (process_ <= 0 || pipes_[0] >= 0 || pipes_[1] >= 0) return;
    int status = 0;
    if (::waitpid(std::exchange(process_, -1), &status, 0) > 0)
        exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void SideProcess::end() {
    if (process_ > 0) {
        (void)::kill(process_, SIGTERM);
        (void)::waitpid(std::exchange(process_, -1), nullptr, 0);
    }
    for (int& pipe : pipes_)
        if (pipe >= 0) (void)::close(std::exchange(pipe, -1));
    texts_ = {};
    exit_code_.reset();
}

}  // namespace application
