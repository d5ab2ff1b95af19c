// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/file_text.h"

namespace porttool {
namespace {

/// The byte of the file that each byte of the scanned text was, and the end.
std::vector<size_t> places(std::string_view bytes, std::string_view scanned) {
    std::vector<size_t> out;
    out.reserve(scanned.size() + 1);
    size_t at = bytes.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    for (const char c : scanned) {
        while (at < bytes.size() && bytes[at] != c) ++at;
        if (at == bytes.size()) return {};  // the scanned text is not that of these bytes
        // A line end that was written as two bytes begins with the first.
        out.push_back(c == '\n' && at > 0 && bytes[at - 1] == '\r' && (out.empty() || out.back() < at - 1) ? at - 1
                                                                                                           : at);
        ++at;
    }
    out.push_back(bytes.size());
    return out;
}

/// An edit without the bytes at its ends that stay: a line that goes on may end among them.
TextEdit what_changes(std::string_view scanned, TextEdit edit) {
    size_t begin = 0, end = edit.text.size();
    while (edit.first < edit.end && begin < end && scanned[edit.first] == edit.text[begin]) ++edit.first, ++begin;
    while (edit.first < edit.end && begin < end && scanned[edit.end - 1] == edit.text[end - 1]) --edit.end, --end;
    edit.text = edit.text.substr(begin, end - begin);
    return edit;
}

std::string with_line_ends(const std::string& text, std::string_view line_end) {
    std::string out;
    for (const char c : text)
        if (c == '\n')
            out += line_end;
        else
            out += c;
    return out;
}

}  // namespace

std::optional<std::string> edit_file(std::string_view bytes, std::string_view scanned,
                                     const std::vector<TextEdit>& edits) {
    if (bytes == scanned) return with_edits(bytes, edits);
    const std::vector<size_t> place = places(bytes, scanned);
    if (place.empty()) return std::nullopt;
    const size_t first_end = bytes.find('\n');
    const bool two = first_end != std::string_view::npos && first_end > 0 && bytes[first_end - 1] == '\r';
    std::vector<TextEdit> moved;
    for (const TextEdit& whole : edits) {
        const TextEdit edit = what_changes(scanned, whole);
        const std::string_view old = bytes.substr(place[edit.first], place[edit.end] - place[edit.first]);
        if (old.find("\\\n") != std::string_view::npos || old.find("\\\r\n") != std::string_view::npos)
            return std::nullopt;
        moved.push_back({place[edit.first], place[edit.end], with_line_ends(edit.text, two ? "\r\n" : "\n")});
    }
    return with_edits(bytes, moved);
}

}  // namespace porttool
