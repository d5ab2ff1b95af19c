// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/unified_diff.h"

#include <algorithm>
#include <vector>

#include "porttool/normal/diff.h"

namespace porttool {
namespace {

constexpr size_t kContext = 3;

/// A path as a diff's head has it: quoted where it has what git quotes.
std::string quoted_path(const std::string& path) {
    const bool plain = std::all_of(path.begin(), path.end(), [](char c) {
        return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7f && c != '"' && c != '\\';
    });
    if (plain) return path;
    std::string out = "\"";
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            out += '\\';
            out += c;
        } else if (byte < 0x20 || byte >= 0x7f) {
            out += '\\';
            out += static_cast<char>('0' + (byte >> 6));
            out += static_cast<char>('0' + ((byte >> 3) & 7));
            out += static_cast<char>('0' + (byte & 7));
        } else {
            out += c;
        }
    }
    return out + "\"";
}

std::string range(size_t first, size_t count) {
    const size_t line = count == 0 ? first : first + 1;
    return std::to_string(line) + (count == 1 ? "" : "," + std::to_string(count));
}

void add_line(char mark, std::string_view line, std::string& out) {
    out += mark;
    out += line;
    if (!line.ends_with('\n')) out += "\n\\ No newline at end of file\n";
}

}  // namespace

Words lines_with_ends(std::string_view text) {
    Words out;
    while (!text.empty()) {
        const size_t end = text.find('\n');
        out.push_back(text.substr(0, end == std::string_view::npos ? text.size() : end + 1));
        text.remove_prefix(out.back().size());
    }
    return out;
}

std::string unified_diff(const std::string& path, std::string_view before, std::string_view now, bool is_new) {
    if (before == now) return {};
    const Words old_lines = lines_with_ends(before), new_lines = lines_with_ends(now);
    const std::vector<DiffStep> steps = diff(old_lines, new_lines);
    const std::string a = quoted_path("a/" + path), b = quoted_path("b/" + path);
    std::string out = "diff --git " + a + " " + b + "\n";
    if (is_new) out += "new file mode 100644\n";
    out += (is_new ? "--- /dev/null\n" : "--- " + a + "\n") + "+++ " + b + "\n";
    for (size_t i = 0; i < steps.size();) {
        if (steps[i].kind == DiffStep::Keep) {
            ++i;
            continue;
        }
        size_t first = i;
        while (first > 0 && i - first < kContext && steps[first - 1].kind == DiffStep::Keep) --first;
        size_t end = i, last = i;
        while (end < steps.size() && end - last <= 2 * kContext) {
            if (steps[end].kind != DiffStep::Keep) last = end;
            ++end;
        }
        end = std::min(steps.size(), last + 1 + kContext);
        size_t old_count = 0, new_count = 0;
        std::string body;
        for (size_t k = first; k < end; ++k) {
            old_count += steps[k].kind != DiffStep::Add;
            new_count += steps[k].kind != DiffStep::Remove;
            if (steps[k].kind == DiffStep::Keep) add_line(' ', old_lines[steps[k].before], body);
            if (steps[k].kind == DiffStep::Remove) add_line('-', old_lines[steps[k].before], body);
            if (steps[k].kind == DiffStep::Add) add_line('+', new_lines[steps[k].now], body);
        }
        out +=
            "@@ -" + range(steps[first].before, old_count) + " +" + range(steps[first].now, new_count) + " @@\n" + body;
        i = end;
    }
    return out;
}

}  // namespace porttool
