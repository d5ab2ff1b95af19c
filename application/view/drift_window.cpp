// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/view/drift_window.h"

#include <imgui.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <string>
#include <string_view>

namespace application {
namespace {

using Step = DriftPanel::Step;

void put(std::array<char, 256>& field, const std::string& text) {
    const size_t length = std::min(text.size(), field.size() - 1);
    std::copy_n(text.begin(), length, field.begin());
    field[length] = '\0';
}

/// Line by line, what a patch takes away in red and what it brings in green.
void show_lines(std::string_view text, bool is_patch) {
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        const char mark = is_patch && !line.empty() ? line.front() : ' ';
        const ImU32 color = mark == '-'   ? IM_COL32(255, 130, 130, 255)
                            : mark == '+' ? IM_COL32(130, 230, 130, 255)
                                          : IM_COL32(225, 225, 225, 255);
        ImGui::PushStyleColor(ImGuiCol_Text, color);
        ImGui::TextUnformatted(line.data(), line.data() + line.size());
        ImGui::PopStyleColor();
    }
}

void show_side(const char* name, const DriftSide& side) {
    ImGui::BeginChild(name, {0.0f, 0.0f}, true, ImGuiWindowFlags_HorizontalScrollbar);
    ImGui::TextUnformatted(side.id.empty() ? "(none)" : side.id.c_str());
    ImGui::Separator();
    show_lines(side.text, false);
    ImGui::EndChild();
}

}  // namespace

PanelPlace PanelPlace::of_window() {
    const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    return {static_cast<double>(corner.x), static_cast<double>(corner.y), static_cast<double>(size.x),
            static_cast<double>(size.y)};
}

DriftWindow::DriftWindow(DriftPanel& panel) : panel_(panel) {
    const char* user = std::getenv("USER");
    put(owner_, user == nullptr ? "" : user);
    constexpr std::time_t kMonth = 30 * 24 * 3600;
    const std::time_t then = std::time(nullptr) + kMonth;
    std::tm day{};
    (void)std::strftime(until_.data(), until_.size(), "%Y-%m-%d", ::gmtime_r(&then, &day));
}

void DriftWindow::next_finding() {
    if (had_findings_) panel_.select_next();
    opens_ = true;
}

void DriftWindow::propose() {
    panel_.propose();
    opens_ = true;
}

void DriftWindow::apply() { panel_.apply(); }

void DriftWindow::draw() {
    const bool has_findings = !panel_.findings().empty();
    opens_ = opens_ || (has_findings && !had_findings_);
    had_findings_ = has_findings;
    const ImVec2 room = ImGui::GetIO().DisplaySize;
    const ImGuiCond when = opens_ && !was_open_ ? ImGuiCond_Always : ImGuiCond_FirstUseEver;
    was_open_ = was_open_ || opens_;
    constexpr float kTop = 165.0f;  // below the figures of the cores
    ImGui::SetNextWindowPos({8.0f, kTop}, when);
    ImGui::SetNextWindowSize({std::max(200.0f, 0.7f * room.x), std::max(120.0f, room.y - kTop - 8.0f)}, when);
    ImGui::SetNextWindowCollapsed(!opens_, opens_ ? ImGuiCond_Always : ImGuiCond_FirstUseEver);
    opens_ = false;
    const bool is_open = ImGui::Begin("drift");
    place_ = PanelPlace::of_window();
    if (is_open) {
        ImGui::TextWrapped("%s", panel_.standing().c_str());
        draw_list();
        if (const DriftFinding* finding = panel_.selected(); finding != nullptr) {
            draw_port();
            draw_texts(*finding);
            draw_verdicts();
        } else if (!panel_.said().empty()) {
            ImGui::TextWrapped("%s", panel_.said().c_str());
        }
    }
    ImGui::End();
}

void DriftWindow::draw_list() {
    std::string chosen;
    for (const DriftFinding& finding : panel_.findings()) {
        const DriftSide& side = finding.source.id.empty() ? finding.target : finding.source;
        const std::string label = side.id + " [" + finding.rule + "]##" + finding.fingerprint;
        if (ImGui::Selectable(label.c_str(), &finding == panel_.selected())) chosen = finding.fingerprint;
    }
    if (!chosen.empty()) panel_.select(chosen);
}

void DriftWindow::draw_texts(const DriftFinding& finding) const {
    ImGui::TextWrapped("%s", finding.message.c_str());
    for (const std::string& line : finding.details) show_lines(line, true);
    constexpr float kHeight = 150.0f;
    if (!ImGui::BeginTable("texts", 2, ImGuiTableFlags_Resizable, {0.0f, kHeight})) return;
    ImGui::TableNextColumn();
    show_side("source", finding.source);
    ImGui::TableNextColumn();
    show_side("target", finding.target);
    ImGui::EndTable();
}

void DriftWindow::draw_port() {
    const Step step = panel_.step();
    if (ImGui::Button("propose port (O)")) panel_.propose();
    if (step == Step::Shown) {
        ImGui::SameLine();
        if (ImGui::Button("apply (Enter)")) panel_.apply();
    }
    if (step == Step::Failed && panel_.wants_force()) {
        ImGui::SameLine();
        if (ImGui::Button("write it all the same")) panel_.apply(true);
    }
    if (step == Step::Asked) ImGui::TextUnformatted("porttool looks for the port of this edit");
    if (step == Step::Writing) ImGui::TextUnformatted("porttool writes");
    if (!panel_.said().empty()) ImGui::TextWrapped("%s", panel_.said().c_str());
    show_lines(panel_.patch(), true);
}

void DriftWindow::draw_verdicts() {
    constexpr float kWidth = 0.4f;
    ImGui::PushItemWidth(kWidth * ImGui::GetWindowWidth());
    ImGui::InputText("reason", reason_.data(), reason_.size());
    ImGui::InputText("owner, to defer", owner_.data(), owner_.size());
    ImGui::InputText("until, to defer", until_.data(), until_.size());
    ImGui::PopItemWidth();
    if (reason_[0] == '\0') return ImGui::TextUnformatted("a reason, to accept or defer this finding");
    if (ImGui::Button("accept as in step")) panel_.accept(reason_.data());
    ImGui::SameLine();
    if (ImGui::Button("defer")) panel_.defer(reason_.data(), owner_.data(), until_.data());
}

}  // namespace application
