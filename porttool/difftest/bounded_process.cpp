// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/bounded_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <string_view>

#include "porttool/read/beneath.h"
#include "porttool/read/child_process.h"

namespace porttool {
namespace {

using ProcessClock = std::chrono::steady_clock;

/// What a compiler and a program of ours need; nothing by which a user's set-up changes what is built.
std::vector<std::string> plain_environment(const std::string& folder) {
    std::vector<std::string> out = {"LC_ALL=C", "TMPDIR=" + folder, "HOME=" + folder};
    if (const char* const path = std::getenv("PATH"); path != nullptr) out.push_back("PATH=" + std::string(path));
    return out;
}

std::vector<char*> pointers_to(std::vector<std::string>& texts) {
    std::vector<char*> out;
    for (std::string& text : texts) out.push_back(text.data());
    out.push_back(nullptr);
    return out;
}

void limit(int resource, uint64_t most) {
    const rlimit value{most, most};
    (void)::setrlimit(static_cast<__rlimit_resource_t>(resource), &value);
}

/// In the child, before it becomes the program: calls of the system alone, since its memory is still the parent's.
void become_bounded(const ProcessLimits& limits, pid_t parent, int output) {
    (void)::setpgid(0, 0);
    (void)::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);
    const auto seconds = static_cast<uint64_t>(limits.time.count() / 1000 + 2);
    limit(RLIMIT_AS, limits.memory);
    limit(RLIMIT_CPU, seconds);
    limit(RLIMIT_FSIZE, limits.file);
    limit(RLIMIT_CORE, 0);
    const int nothing = ::open("/dev/null", O_RDONLY);
    (void)::dup2(nothing, STDIN_FILENO);
    (void)::dup2(output, STDOUT_FILENO);
    (void)::dup2(output, STDERR_FILENO);
    // No handler of ours can run in it: CleanOnInterrupt waits for signals, and has none.
    sigset_t none;
    (void)::sigemptyset(&none);
    (void)::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

/// The processes that we have started and still wait for. What they leave behind becomes ours, and is ended by whoever
/// sees it first.
class OwnProcesses {
public:
    /// Starts one, by a call that gives its number.
    template <class Start>
    pid_t start(const Start& begin) {
        const std::lock_guard<std::mutex> lock(mutex_);
        (void)::prctl(PR_SET_CHILD_SUBREAPER, 1);
        const pid_t child = begin();
        if (child > 0) running_.insert(child);
        return child;
    }
    void end(pid_t child) {
        const std::lock_guard<std::mutex> lock(mutex_);
        running_.erase(child);
        constexpr int kMostRounds = 100;  // what a process left behind may have left others behind
        for (int round = 0; round < kMostRounds && end_strays(); ++round) {
        }
    }

    /// Ends all that run, with their groups, and lets no other start.
    void end_all() {
        mutex_.lock();  // for good: this program ends
        for (const pid_t child : running_) (void)::kill(-child, SIGKILL);
    }

private:
    bool end_strays() const {
        bool any = false;
        std::error_code error;
        for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task", error)) {
            std::ifstream children(thread.path() / "children");
            for (pid_t child = 0; children >> child;) {
                if (running_.contains(child)) continue;
                any = true;
                (void)::kill(child, SIGKILL);
                int status = 0;
                (void)::waitpid(child, &status, 0);
            }
        }
        return any;
    }

    std::mutex mutex_;
    std::set<pid_t> running_;
};

OwnProcesses& own_processes() {
    static OwnProcesses processes;
    return processes;
}

/// Takes what has been printed so far; false at its end.
bool take_first_output(int pipe, std::string& text, size_t most) {
    return take_available(pipe,
                          [&](std::string_view got) { text += got.substr(0, most - std::min(most, text.size())); });
}

}  // namespace

void end_processes() { own_processes().end_all(); }

std::string program_path(const std::string& name) {
    const char* const path = std::getenv("PATH");
    const std::string_view folders = path == nullptr ? "/usr/bin:/bin" : path;
    for (size_t at = 0; at <= folders.size();) {
        const size_t end = std::min(folders.find(':', at), folders.size());
        const std::string file = std::string(folders.substr(at, end - at)) + "/" + name;
        if (file.front() == '/' && ::access(file.c_str(), X_OK) == 0) return file;
        at = end + 1;
    }
    return {};
}

ProcessEnd run_process(const std::vector<std::string>& arguments, const std::string& folder,
                       const ProcessLimits& limits) {
    ProcessEnd out;
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) return {127, false, "no pipe can be made"};
    const Descriptor reader(ends[0]);
    Descriptor writer(ends[1]);
    (void)::fcntl(reader.get(), F_SETFL, O_NONBLOCK);
    std::vector<std::string> words = arguments, environment = plain_environment(folder);
    const std::vector<char*> argv = pointers_to(words), envp = pointers_to(environment);
    const pid_t parent = ::getpid();
    const auto start = ProcessClock::now();
    const pid_t child = own_processes().start([&] {
        // Not fork(), which takes away every page of the tables of inputs and has each written one fetched again.
        const pid_t started = ::vfork();
        if (started != 0) return started;
        become_bounded(limits, parent, writer.get());
        if (::chdir(folder.c_str()) == 0) ::execve(argv[0], argv.data(), envp.data());
        ::_exit(127);
    });
    if (child < 0) return {127, false, "no process can be started"};
    (void)::setpgid(child, child);  // whoever is first
    writer = Descriptor();
    int status = 0;
    bool open = true;
    int pause = 1;  // milliseconds
    while (::waitpid(child, &status, WNOHANG) == 0) {
        out.timed_out = ProcessClock::now() - start >= limits.time;
        if (out.timed_out) {
            (void)::kill(-child, SIGKILL);
            while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
            }
            break;
        }
        pollfd watched{open ? reader.get() : -1, POLLIN, 0};
        (void)::poll(&watched, 1, pause);
        pause = std::min(2 * pause, 20);
        if (open) open = take_first_output(reader.get(), out.output, limits.output);
    }
    (void)::kill(-child, SIGKILL);  // what it has left behind
    own_processes().end(child);
    if (open) take_first_output(reader.get(), out.output, limits.output);
    out.exit_code = exit_code_of(status);
    return out;
}

}  // namespace porttool
