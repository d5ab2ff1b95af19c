// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/report/portability_page.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "porttool/measure/alignment.h"
#include "porttool/report/packed.h"
#include "porttool/report/page.h"
#include "porttool/text/sink/json.h"
#include "porttool/text/utf8.h"

namespace porttool {
namespace {

using nlohmann::ordered_json;

std::vector<std::string_view> lines_of(std::string_view bytes) {
    if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
    std::vector<std::string_view> lines;
    while (!bytes.empty()) {
        const size_t end = std::min(bytes.find_first_of("\r\n"), bytes.size());
        lines.push_back(bytes.substr(0, end));
        const size_t skip = bytes.substr(end).starts_with("\r\n") ? 2 : 1;
        bytes.remove_prefix(std::min(end + skip, bytes.size()));
    }
    return lines;
}

/// How many UTF-16 units, the way JavaScript counts, the first bytes of a line take in the page. Asked in the order of
/// the line it goes through it once.
class Utf16Count {
public:
    explicit Utf16Count(std::string_view line) : line_(line) {}

    uint32_t of_first(size_t count) {
        if (count < at_) at_ = 0, units_ = 0;
        for (const size_t end = std::min(count, line_.size()); at_ < end;) {
            const size_t length = static_cast<signed char>(line_[at_]) >= 0 ? 1 : utf8_length(line_.substr(at_));
            units_ += length == 4 ? 2 : 1;
            at_ += std::max<size_t>(1, length);
        }
        return units_;
    }

private:
    std::string_view line_;
    size_t at_ = 0;
    uint32_t units_ = 0;
};

/// first, length, 1 if the dialect makes both sides equal here; for each mark. One for all where there are so many that
/// nobody sees one among them: thousands of units in one line would each have those of all.
ordered_json marks_json(const std::vector<Mark>& marks, std::string_view line) {
    constexpr size_t kMostMarks = 500;
    ordered_json out = ordered_json::array();
    Utf16Count units(line);
    const auto add = [&](size_t first_byte, size_t end_byte, bool translated) {
        const uint32_t first = units.of_first(first_byte), end = units.of_first(end_byte);
        for (const uint32_t value : {first, end - first, translated ? 1u : 0u}) out.push_back(value);
    };
    const auto is_translated = [](const Mark& mark) { return mark.translated; };
    if (marks.size() > kMostMarks)
        add(marks.front().first, marks.back().first + marks.back().length,
            std::all_of(marks.begin(), marks.end(), is_translated));
    else
        for (const Mark& mark : marks) add(mark.first, mark.first + mark.length, mark.translated);
    return out;
}

using TextLines = std::map<std::string, std::vector<std::string_view>>;

TextLines split(const std::map<std::string, std::string>& texts) {
    TextLines out;
    for (const auto& [path, bytes] : texts) out.emplace(path, lines_of(bytes));
    return out;
}

std::string_view line_at(const TextLines& texts, const std::string& file, uint32_t line) {
    const auto found = texts.find(file);
    return found == texts.end() || line == 0 || line > found->second.size() ? std::string_view()
                                                                            : found->second[line - 1];
}

/// source line, target line (0: none, else how far after the last one), and where something differs the marks of both.
ordered_json rows_json(const RowSide& source, const RowSide& target, const BySide<TextLines>& texts,
                       const Dialect& dialect) {
    ordered_json out = ordered_json::array();
    BySide<uint32_t> last{0, 0};
    const auto step = [&](Side side, uint32_t line) { return line == 0 ? 0 : line - std::exchange(last[side], line); };
    for (const AlignedRow& aligned : align_units(source.excerpt, target.excerpt, dialect)) {
        ordered_json one = {step(Side::Source, aligned.source_line), step(Side::Target, aligned.target_line)};
        if (!aligned.source_marks.empty() || !aligned.target_marks.empty()) {
            one.push_back(marks_json(aligned.source_marks, line_at(texts.source, source.file, aligned.source_line)));
            one.push_back(marks_json(aligned.target_marks, line_at(texts.target, target.file, aligned.target_line)));
        }
        out.push_back(std::move(one));
    }
    return out;
}

/// [first, last] pairs as steps: from the last span's end to the first line, and on to the last.
void pack_spans(ordered_json& spans) {
    ordered_json steps = ordered_json::array();
    uint32_t at = 0;
    for (const ordered_json& span : spans) {
        const auto first = span[0].get<uint32_t>(), last = span[1].get<uint32_t>();
        steps.push_back(first - at);
        steps.push_back(last - first);
        at = last;
    }
    spans = std::move(steps);
}

/// Leaves out which lines of a file are code where the totals say the same, and of units, and writes all spans as
/// steps.
void pack(ordered_json& data) {
    for (const char* side : {"source", "target"}) {
        std::map<std::string, ordered_json> code;
        for (ordered_json& file : data["totals"]["lines"][side]) code[file["file"]] = file["code"];
        for (ordered_json& block : data["blocks"])
            for (ordered_json& file : block["lines"][side]) {
                pack_spans(file["shared"]);
                if (code[file["file"]] == file["code"])
                    file.erase("code");
                else
                    pack_spans(file["code"]);
            }
        for (ordered_json& file : data["totals"]["lines"][side])
            for (const char* spans : {"code", "shared"}) pack_spans(file[spans]);
        for (ordered_json& row : data["units"]) {
            ordered_json& unit = row[side];
            if (unit.is_null()) continue;
            pack_spans(unit["shared"]);
            if (unit["kind"] == "file")
                pack_spans(unit["code"]);
            else
                unit.erase("code");
        }
    }
}

/// What the page shows: the JSON of the report, packed, with the rows of each pair and all texts. data.js unpacks it.
ordered_json page_data(const WholeReport& whole, const SideTexts& texts) {
    ordered_json data = portability_json(whole);
    pack(data);
    const BySide<TextLines> lines = {split(texts.source), split(texts.target)};
    const Dialect dialect(whole.map.dialect);
    for (size_t i = 0; i < whole.report.rows.size(); ++i) {
        const RowReport& row = whole.report.rows[i];
        if (row.sides.source && row.sides.target)
            data["units"][i]["rows"] = rows_json(*row.sides.source, *row.sides.target, lines, dialect);
    }
    data["texts"] = ordered_json::object();
    for (const Side side : kBothSides) {
        ordered_json files = ordered_json::object();
        for (const auto& [path, bytes] : texts[side]) files[path] = page_text(bytes);
        data["texts"][side == Side::Source ? "source" : "target"] = std::move(files);
    }
    return data;
}

}  // namespace

std::string page_text(std::string_view bytes) {
    std::string out;
    for (const std::string_view line : lines_of(bytes)) {
        out += as_utf8(line);
        out += '\n';
    }
    return out;
}

std::string portability_html(const WholeReport& whole, const SideTexts& texts) {
    const std::string data = packed(json_text(page_data(whole, texts), -1));
    return filled_page(
        "portability.html",
        {{"@STYLE@", page_file("portability.css")}, {"@DATA@", data}, {"@SCRIPT@", page_file("script.js")}});
}

}  // namespace porttool
