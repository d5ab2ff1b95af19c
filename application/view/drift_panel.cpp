// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/drift_panel.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <utility>

extern char** environ;

namespace application {
namespace {

using Json = nlohmann::ordered_json;

/// porttool beside this program, else in PATH.
std::string find_porttool() {
    std::error_code error;
    const auto beside = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "porttool";
    if (std::filesystem::exists(beside, error)) return beside.string();
    const char* list = std::getenv("PATH");
    std::string rest = list == nullptr ? "" : list;
    while (!rest.empty()) {
        const size_t end = std::min(rest.find(':'), rest.size());
        const auto there = std::filesystem::path(rest.substr(0, end)) / "porttool";
        if (end > 0 && ::access(there.c_str(), X_OK) == 0) return there.string();
        rest.erase(0, end + 1);
    }
    return {};
}

std::string text_at(const Json& value, const char* name) {
    const auto found = value.is_object() ? value.find(name) : value.end();
    return found != value.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::string id_at(const Json& value, const char* name) {
    const auto found = value.find(name);
    return found != value.end() && found->is_object() ? text_at(*found, "id") : std::string();
}

}  // namespace

SideProcess::SideProcess(const std::vector<std::string>& arguments) {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC | O_NONBLOCK) != 0) return;
    pipe_ = ends[0];
    posix_spawn_file_actions_t actions;
    (void)::posix_spawn_file_actions_init(&actions);
    (void)::posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    (void)::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    (void)::posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
    std::vector<char*> pointers;
    for (const std::string& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
    pointers.push_back(nullptr);
    if (::posix_spawn(&process_, pointers[0], &actions, nullptr, pointers.data(), environ) != 0) process_ = -1;
    (void)::posix_spawn_file_actions_destroy(&actions);
    (void)::close(ends[1]);
}

SideProcess& SideProcess::operator=(SideProcess&& other) noexcept {
    if (this == &other) return *this;
    end();
    process_ = std::exchange(other.process_, -1);
    pipe_ = std::exchange(other.pipe_, -1);
    exit_code_ = std::exchange(other.exit_code_, std::nullopt);
    return *this;
}

std::string SideProcess::read() {
    std::string out;
    std::array<char, 16384> room{};
    while (pipe_ >= 0) {
        const ssize_t got = ::read(pipe_, room.data(), room.size());
        if (got > 0) {
            out.append(room.data(), static_cast<size_t>(got));
            continue;
        }
        if (got < 0 && (errno == EAGAIN || errno == EINTR)) break;
        (void)::close(std::exchange(pipe_, -1));
        int status = 0;
        if (process_ > 0 && ::waitpid(std::exchange(process_, -1), &status, 0) > 0)
            exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return out;
}

void SideProcess::end() {
    if (process_ > 0) {
        (void)::kill(process_, SIGTERM);
        (void)::waitpid(std::exchange(process_, -1), nullptr, 0);
    }
    if (pipe_ >= 0) (void)::close(std::exchange(pipe_, -1));
    exit_code_.reset();
}

DriftPanel::DriftPanel(std::string folder, ViewLog& log)
    : program_(find_porttool()), folder_(std::move(folder)), log_(log) {
    if (program_.empty()) {
        standing_ = "there is no porttool beside this program or in PATH";
        return;
    }
    watch_ = SideProcess({program_, "-C", folder_, "watch", "--format", "json"});
    standing_ = watch_.is_started() ? "porttool looks at " + folder_ : "porttool could not be started";
}

void DriftPanel::update() {
    watched_text_ += watch_.read();
    for (size_t end = 0; (end = watched_text_.find('\n')) != std::string::npos;) {
        take_line(watched_text_.substr(0, end));
        watched_text_.erase(0, end + 1);
    }
    proposed_text_ += sync_.read();
    if (sync_.exit_code()) {
        take_proposal(proposed_text_);
        proposed_text_.clear();
        sync_ = SideProcess();
    }
    verdict_text_ += verdict_.read();
    if (verdict_.exit_code()) {
        proposal_ = verdict_text_;
        log_.say("patch", {{"done", *verdict_.exit_code() == 0}, {"said", verdict_text_}});
        verdict_text_.clear();
        verdict_ = SideProcess();
    }
}

void DriftPanel::take_line(const std::string& line) {
    const Json value = Json::parse(line, nullptr, false);
    const std::string event = text_at(value, "event");
    if (value.is_discarded() || event.empty()) {
        standing_ = line;  // what porttool says on stderr
        return;
    }
    const std::string fingerprint = text_at(value, "fingerprint");
    if (event == "finding") {
        findings_[fingerprint] = {text_at(value, "rule"), text_at(value, "level"), text_at(value, "message"),
                                  id_at(value, "source"), id_at(value, "target"),  fingerprint};
        log_.say("finding", {{"state", "open"},
                             {"rule", text_at(value, "rule")},
                             {"source", id_at(value, "source")},
                             {"target", id_at(value, "target")},
                             {"message", text_at(value, "message")},
                             {"fingerprint", fingerprint}});
    } else if (event == "gone") {
        findings_.erase(fingerprint);
        log_.say("finding", {{"state", "gone"}, {"rule", text_at(value, "rule")}, {"fingerprint", fingerprint}});
    } else if (event == "judged") {
        standing_ = fmt::format("{}, {} findings", text_at(value, "verdict"), findings_.size());
    } else if (event == "error") {
        standing_ = text_at(value, "message");
        log_.say("error", {{"message", standing_}});
    }
}

void DriftPanel::propose(const DriftFinding& finding) {
    can_apply_ = false;
    proposed_ = finding.fingerprint;
    proposal_ = "porttool looks for the port of this edit";
    sync_ = SideProcess({program_, "-C", folder_, "sync", finding.fingerprint, "--format", "json"});
}

void DriftPanel::take_proposal(const std::string& text) {
    // Before it may stand what porttool said on stderr.
    const Json value = Json::parse(text.substr(std::min(text.find('{'), text.size())), nullptr, false);
    proposal_ = text;
    const auto list = value.is_object() ? value.find("proposals") : value.end();
    if (value.is_discarded() || list == value.end() || !list->is_array() || list->empty()) return;
    const Json& first = list->front();
    const std::string state = text_at(first, "state");
    can_apply_ = state == "proposed";
    proposal_ = state + "\n" + text_at(first, "patch");
    const auto left = first.find("left");
    if (left != first.end() && left->is_array())
        for (const Json& item : *left) proposal_ += "left for you: " + text_at(item, "message") + "\n";
    log_.say("patch", {{"state", state}, {"patch", text_at(first, "patch")}});
}

void DriftPanel::apply() {
    if (!can_apply_) return;
    can_apply_ = false;
    verdict_ = SideProcess({program_, "-C", folder_, "sync", proposed_, "--apply"});
}

void DriftPanel::accept(const DriftFinding& finding) {
    verdict_ = SideProcess({program_, "-C", folder_, "accept", finding.fingerprint});
}

}  // namespace application
