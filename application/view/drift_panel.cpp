// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/drift_panel.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <tuple>
#include <utility>

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

/// The folder that the files of findings are relative to: the nearest one upwards with a map.
std::string root_of(const std::string& folder) {
    std::error_code error;
    std::filesystem::path root = std::filesystem::absolute(folder, error);
    while (!std::filesystem::exists(root / "portmap.toml", error)) {
        if (root == root.parent_path()) return folder;
        root = root.parent_path();
    }
    return root.string();
}

std::string text_at(const Json& value, const char* name) {
    const auto found = value.is_object() ? value.find(name) : value.end();
    return value.is_object() && found != value.end() && found->is_string() ? found->get<std::string>() : std::string();
}

int number_at(const Json& value, const char* name) {
    const auto found = value.find(name);
    return found != value.end() && found->is_number_integer() ? found->get<int>() : 0;
}

std::string lines_of(const std::filesystem::path& path, int first, int last) {
    constexpr int kMost = 400;
    std::ifstream file(path);
    std::string text, line;
    for (int number = 1; number <= std::min(last, first + kMost) && std::getline(file, line); ++number)
        if (number >= first) text += line + "\n";
    return text;
}

DriftSide side_at(const Json& value, const char* name, const std::string& root) {
    const auto found = value.find(name);
    if (found == value.end() || !found->is_object()) return {};
    DriftSide side{text_at(*found, "id"), text_at(*found, "file"), number_at(*found, "line"), ""};
    side.text = lines_of(std::filesystem::path(root) / side.file, side.line, number_at(*found, "end_line"));
    return side;
}

DriftFinding finding_of(const Json& value, const std::string& root) {
    DriftFinding out{text_at(value, "rule"),
                     text_at(value, "level"),
                     text_at(value, "message"),
                     text_at(value, "fingerprint"),
                     side_at(value, "source", root),
                     side_at(value, "target", root),
                     {}};
    const auto details = value.find("details");
    if (details != value.end() && details->is_array())
        for (const Json& line : *details)
            if (line.is_string()) out.details.push_back(line.get<std::string>());
    return out;
}

auto place_of(const DriftFinding& finding) {
    return std::tie(finding.source.file, finding.source.line, finding.target.file, finding.target.line,
                    finding.fingerprint);
}

std::string last_line(std::string text) {
    text.erase(text.find_last_not_of('\n') + 1);
    return text.substr(text.find_last_of('\n') + 1);
}

}  // namespace

DriftPanel::DriftPanel(std::string folder, ViewLog& log) : DriftPanel(find_porttool(), std::move(folder), log) {}

DriftPanel::DriftPanel(std::string porttool, std::string folder, ViewLog& log)
    : program_(std::move(porttool)), folder_(std::move(folder)), root_(root_of(folder_)), log_(log) {
    if (program_.empty()) {
        standing_ = "there is no porttool beside this program or in PATH";
        return;
    }
    watch_ = SideProcess({program_, "-C", folder_, "watch", "--format", "json"});
    standing_ = watch_.is_started() ? "porttool looks at " + folder_ : program_ + " could not be started";
}

bool DriftPanel::update() {
    bool is_new = false;
    if (watch_.is_started()) {
        watch_.update();
        std::string& said = watch_.out();
        size_t at = 0;
        for (size_t end = 0; (end = said.find('\n', at)) != std::string::npos; at = end + 1) {
            take_line(said.substr(at, end - at));
            is_new = true;
        }
        said.erase(0, at);
        if (watch_.exit_code()) {
            standing_ = "porttool has ended: " + last_line(watch_.errors());
            is_new = true;
        }
    }
    asked_.update();
    if (!asked_.exit_code()) return is_new;
    if (step_ == Step::Asked) {
        take_proposal();
    } else {
        take_verdict();
    }
    asked_ = SideProcess();
    if (!then_ask_.empty()) ask(Step::Writing, std::exchange(then_ask_, {}));
    return true;
}

void DriftPanel::take_line(const std::string& line) {
    const Json value = Json::parse(line, nullptr, false);
    const std::string event = text_at(value, "event");
    if (event == "finding") take_finding(finding_of(value, root_));
    if (event == "gone") {
        const std::string fingerprint = text_at(value, "fingerprint");
        drop(fingerprint);
        log_.say("finding", {{"state", "gone"}, {"rule", text_at(value, "rule")}, {"fingerprint", fingerprint}});
    }
    if (event == "judged") standing_ = fmt::format("{}, {} findings", text_at(value, "verdict"), findings_.size());
    if (event == "error") {
        standing_ = text_at(value, "message");
        log_.say("error", {{"message", standing_}});
    }
}

void DriftPanel::take_finding(DriftFinding finding) {
    drop(finding.fingerprint);
    log_.say("finding", {{"state", "open"},
                         {"rule", finding.rule},
                         {"source", finding.source.id},
                         {"target", finding.target.id},
                         {"message", finding.message},
                         {"fingerprint", finding.fingerprint}});
    if (selected_.empty()) selected_ = finding.fingerprint;
    const auto place =
        std::lower_bound(findings_.begin(), findings_.end(), finding,
                         [](const DriftFinding& a, const DriftFinding& b) { return place_of(a) < place_of(b); });
    findings_.insert(place, std::move(finding));
}

/// A patch that was shown for it says nothing any more.
void DriftPanel::drop(const std::string& fingerprint) {
    std::erase_if(findings_, [&](const DriftFinding& one) { return one.fingerprint == fingerprint; });
    if (fingerprint == proposed_ && step_ == Step::Shown) {
        step_ = Step::None;
        patch_.clear();
    }
}

const DriftFinding* DriftPanel::selected() const {
    const auto found = std::find_if(findings_.begin(), findings_.end(),
                                    [&](const DriftFinding& one) { return one.fingerprint == selected_; });
    if (found != findings_.end()) return &*found;
    return findings_.empty() ? nullptr : &findings_.front();
}

void DriftPanel::select(const std::string& fingerprint) {
    selected_ = fingerprint;
    if (fingerprint == proposed_ || step_ == Step::Asked || step_ == Step::Writing) return;
    step_ = Step::None;
    patch_.clear();
    said_.clear();
}

void DriftPanel::select_next() {
    const DriftFinding* now = selected();
    if (now == nullptr) return;
    const auto next = static_cast<size_t>(now - findings_.data() + 1) % findings_.size();
    select(std::string(findings_[next].fingerprint));
}

void DriftPanel::ask(Step step, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {program_, "-C", folder_});
    asked_ = SideProcess(arguments);
    step_ = asked_.is_started() ? step : Step::Failed;
    said_ = asked_.is_started() ? "" : program_ + " could not be started";
}

void DriftPanel::propose() {
    const DriftFinding* finding = selected();
    if (finding == nullptr || step_ == Step::Writing) return;
    proposed_ = finding->fingerprint;
    selected_ = proposed_;
    pair_ = finding->source.id + "=" + finding->target.id;
    patch_.clear();
    wants_force_ = false;
    applies_ = false;
    ask(Step::Asked, {"sync", proposed_, "--format", "json"});
}

void DriftPanel::take_proposal() {
    const Json value = Json::parse(asked_.out(), nullptr, false);
    const auto list = value.is_object() ? value.find("proposals") : value.end();
    step_ = Step::Refused;
    if (!value.is_object() || list == value.end() || !list->is_array() || list->empty()) {
        said_ = last_line(asked_.errors());
    } else {
        const Json& first = list->front();
        const std::string state = text_at(first, "state");
        patch_ = text_at(first, "patch");
        said_ = state;
        const auto left = first.find("left");
        if (left != first.end() && left->is_array())
            for (const Json& item : *left) said_ += "\nleft for you: " + text_at(item, "message");
        if (state == "proposed") step_ = Step::Shown;
    }
    log_.say("patch", {{"state", said_.substr(0, said_.find('\n'))}, {"patch", patch_}});
}

void DriftPanel::apply(bool force) {
    const bool again = step_ == Step::Failed && wants_force_ && force;
    if (step_ != Step::Shown && !again) return;
    std::vector<std::string> arguments{"sync", proposed_, "--apply"};
    if (force) arguments.emplace_back("--force");
    ask(Step::Writing, std::move(arguments));
    applies_ = true;
}

void DriftPanel::accept(const std::string& reason) {
    const DriftFinding* finding = selected();
    if (finding == nullptr || step_ == Step::Writing || reason.empty()) return;
    proposed_ = finding->fingerprint;
    ask(Step::Writing, {"accept", finding->fingerprint, "--reason", reason});
}

void DriftPanel::defer(const std::string& reason, const std::string& owner, const std::string& until) {
    const DriftFinding* finding = selected();
    if (finding == nullptr || step_ == Step::Writing || reason.empty() || owner.empty() || until.empty()) return;
    proposed_ = finding->fingerprint;
    ask(Step::Writing, {"defer", finding->fingerprint, "--reason", reason, "--owner", owner, "--until", until});
}

void DriftPanel::take_verdict() {
    const bool is_done = *asked_.exit_code() == 0;
    said_ = last_line(is_done ? asked_.out() : asked_.errors());
    step_ = is_done ? Step::Written : Step::Failed;
    wants_force_ = !is_done && said_.find("--force") != std::string::npos;
    if (is_done) patch_.clear();
    log_.say("patch", {{"done", is_done}, {"said", said_}});
    // A person saw the patch: from here on the two are in step, and the next edit of the one is held against this.
    if (std::exchange(applies_, false) && is_done) then_ask_ = {"accept", pair_, "--reason", "ported in the window"};
}

}  // namespace application
