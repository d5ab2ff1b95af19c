// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/matrix_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "porttool/text/sink/markdown.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

std::string cell_words(const MatrixCell& cell) {
    if (cell.state == InPort::LeftOut) return "left out";
    if (cell.state != InPort::Behind) return std::string(in_port_name(cell.state));
    return fmt::format("behind by {} edit{}", cell.edits, cell.edits == 1 ? "" : "s");
}

}  // namespace

nlohmann::ordered_json matrix_json(const TargetMatrix& matrix) {
    if (matrix.targets.empty()) return nullptr;
    nlohmann::ordered_json units = nlohmann::ordered_json::array();
    for (const MatrixRow& row : matrix.rows) {
        nlohmann::ordered_json cells = nlohmann::ordered_json::array();
        for (const MatrixCell& cell : row.cells)
            cells.push_back({{"state", in_port_name(cell.state)},
                             {"target", cell.target.empty() ? nlohmann::ordered_json(nullptr)
                                                            : nlohmann::ordered_json(cell.target)},
                             {"edits", cell.edits}});
        units.push_back({{"source", row.source}, {"cells", std::move(cells)}});
    }
    return {{"targets", matrix.targets}, {"units", std::move(units)}};
}

std::string matrix_table(const TargetMatrix& matrix) {
    if (matrix.targets.empty()) return {};
    constexpr size_t kGap = 2;
    size_t width = 4;
    for (const MatrixRow& row : matrix.rows) width = std::max(width, terminal_text(row.source).size());
    std::vector<size_t> widths;
    for (size_t i = 0; i < matrix.targets.size(); ++i) {
        widths.push_back(matrix.targets[i].size());
        for (const MatrixRow& row : matrix.rows) widths[i] = std::max(widths[i], cell_words(row.cells[i]).size());
    }
    const auto line = [&](const std::string& first, const auto& cell) {
        std::string out = fmt::format("{:<{}}", first, width);
        for (size_t i = 0; i < widths.size(); ++i) out += fmt::format("{:<{}}{:<{}}", "", kGap, cell(i), widths[i]);
        return out.substr(0, out.find_last_not_of(' ') + 1) + "\n";
    };
    std::string out = "\n" + line("unit", [&](size_t i) { return matrix.targets[i]; });
    for (const MatrixRow& row : matrix.rows)
        out += line(terminal_text(row.source), [&](size_t i) { return cell_words(row.cells[i]); });
    return out;
}

std::string matrix_markdown(const TargetMatrix& matrix) {
    if (matrix.targets.empty()) return {};
    std::string out = "\n| unit |", rule = "| --- |";
    for (const std::string& target : matrix.targets) {
        out += " " + markdown_text(target) + " |";
        rule += " --- |";
    }
    out += "\n" + rule + "\n";
    for (const MatrixRow& row : matrix.rows) {
        out += "| " + markdown_code(row.source) + " |";
        for (const MatrixCell& cell : row.cells) out += " " + cell_words(cell) + " |";
        out += "\n";
    }
    return out;
}

}  // namespace porttool
