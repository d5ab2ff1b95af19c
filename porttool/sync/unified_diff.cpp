// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/unified_diff.h"

#include <algorithm>
#include <utility>
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

/// How many bytes both texts begin with: by blocks, since files are long and edits short.
size_t same_bytes(std::string_view a, std::string_view b) {
    constexpr size_t kBlock = 4096;
    const size_t most = std::min(a.size(), b.size());
    size_t at = 0;
    while (at + kBlock <= most && a.compare(at, kBlock, b.substr(at, kBlock)) == 0) at += kBlock;
    while (at < most && a[at] == b[at]) ++at;
    return at;
}

/// How many lines, and bytes, both texts begin with; fewer by the context of what follows.
std::pair<size_t, size_t> same_lines_in_front(std::string_view before, std::string_view now) {
    size_t bytes = same_bytes(before, now);
    for (size_t i = 0; i <= kContext && bytes > 0; ++i) {
        const size_t end = bytes < 2 ? std::string_view::npos : before.rfind('\n', i == 0 ? bytes - 1 : bytes - 2);
        bytes = end == std::string_view::npos ? 0 : end + 1;
    }
    return {static_cast<size_t>(std::count(before.begin(), before.begin() + static_cast<std::ptrdiff_t>(bytes), '\n')),
            bytes};
}

/// The bytes of whole lines that both texts end with; fewer by the context of what stands before.
size_t bytes_behind(std::string_view before, std::string_view now) {
    constexpr size_t kBlock = 4096;
    const size_t most = std::min(before.size(), now.size());
    size_t same = 0;
    while (same + kBlock <= most &&
           before.substr(before.size() - same - kBlock, kBlock) == now.substr(now.size() - same - kBlock, kBlock))
        same += kBlock;
    while (same < most && before[before.size() - same - 1] == now[now.size() - same - 1]) ++same;
    size_t at = before.size() - same;
    for (size_t i = 0; i <= kContext; ++i) {
        const size_t end = before.find('\n', at);
        if (end == std::string_view::npos) return 0;
        at = end + 1;
    }
    return before.size() - at;
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

std::string unified_diff(const std::string& path, std::string_view before, std::string_view now, bool is_new,
                         size_t lines_in_front) {
    if (before == now) return {};
    const auto [skipped_lines, in_front] = same_lines_in_front(before, now);
    const size_t same_lines = lines_in_front + skipped_lines;
    before.remove_prefix(in_front);
    now.remove_prefix(in_front);
    const size_t behind = bytes_behind(before, now);
    const Words old_lines = lines_with_ends(before.substr(0, before.size() - behind)),
                new_lines = lines_with_ends(now.substr(0, now.size() - behind));
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
        out += "@@ -" + range(same_lines + steps[first].before, old_count) + " +" +
               range(same_lines + steps[first].now, new_count) + " @@\n" + body;
        i = end;
    }
    return out;
}

}  // namespace porttool
