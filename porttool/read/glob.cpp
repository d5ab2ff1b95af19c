// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/glob.h"

#include <algorithm>
#include <optional>

namespace porttool {
namespace {

constexpr size_t kMostAlternatives = 4096;

/// Position of the `}` that closes the `{` at `open`.
std::optional<size_t> closing_brace(std::string_view pattern, size_t open) {
    int depth = 0;
    for (size_t i = open; i < pattern.size(); ++i) {
        if (pattern[i] == '\\')
            ++i;
        else if (pattern[i] == '{')
            ++depth;
        else if (pattern[i] == '}' && --depth == 0)
            return i;
    }
    return std::nullopt;
}

/// Writes `{a,b}` out, the first brace first.
void expand_braces(const std::string& pattern, std::vector<std::string>& out) {
    for (size_t open = 0; open < pattern.size(); ++open) {
        if (pattern[open] == '\\') {
            ++open;
            continue;
        }
        if (pattern[open] != '{') continue;
        const auto close = closing_brace(pattern, open);
        if (!close) break;
        int depth = 0;
        size_t first = open + 1;
        for (size_t i = open + 1; i <= *close && out.size() < kMostAlternatives; ++i) {
            if (pattern[i] == '{') ++depth;
            const bool ends = i == *close || (pattern[i] == ',' && depth == 0);
            if (pattern[i] == '}') --depth;
            if (!ends) continue;
            expand_braces(pattern.substr(0, open) + pattern.substr(first, i - first) + pattern.substr(*close + 1), out);
            first = i + 1;
        }
        return;
    }
    if (out.size() < kMostAlternatives) out.push_back(pattern);
}

bool has_wildcard(std::string_view text) { return text.find_first_of("*?[") != std::string_view::npos; }

/// Matches `[...]` at `at`, which moves behind it; false leaves `at` where it was if the class does not close.
bool class_matches(std::string_view pattern, size_t& at, char c) {
    size_t i = at + 1;
    const bool negated = i < pattern.size() && (pattern[i] == '!' || pattern[i] == '^');
    if (negated) ++i;
    bool found = false;
    for (bool first = true; i < pattern.size() && (first || pattern[i] != ']'); first = false, ++i) {
        if (i + 2 < pattern.size() && pattern[i + 1] == '-' && pattern[i + 2] != ']') {
            found = found || (pattern[i] <= c && c <= pattern[i + 2]);
            i += 2;
        } else {
            found = found || pattern[i] == c;
        }
    }
    if (i >= pattern.size()) {  // no end: a plain bracket
        ++at;
        return c == '[';
    }
    at = i + 1;
    return found != negated;
}

}  // namespace

bool segment_matches(std::string_view pattern, std::string_view name) {
    size_t p = 0, n = 0;
    size_t star = std::string_view::npos, star_name = 0;
    while (n < name.size()) {
        bool fits = false;
        size_t next = p;
        if (p < pattern.size()) {
            if (pattern[p] == '*') {
                star = p++;
                star_name = n;
                continue;
            }
            if (pattern[p] == '[') {
                fits = class_matches(pattern, next, name[n]);
            } else {
                if (pattern[p] == '\\' && p + 1 < pattern.size()) ++next;
                fits = (pattern[p] == '?') || pattern[next] == name[n];
                ++next;
            }
        }
        if (fits) {
            p = next;
            ++n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++star_name;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == '*') ++p;
    return p == pattern.size();
}

bool segments_match(const std::vector<std::string>& pattern, const std::vector<std::string_view>& path) {
    size_t p = 0, n = 0;
    size_t star = std::string::npos, star_path = 0;
    while (n < path.size()) {
        if (p < pattern.size() && pattern[p] == "**") {
            star = p++;
            star_path = n;
        } else if (p < pattern.size() && segment_matches(pattern[p], path[n])) {
            ++p;
            ++n;
        } else if (star != std::string::npos) {
            p = star + 1;
            n = ++star_path;
        } else {
            return false;
        }
    }
    while (p < pattern.size() && pattern[p] == "**") ++p;
    return p == pattern.size();
}

std::vector<std::string_view> split_path(std::string_view path) {
    std::vector<std::string_view> segments;
    while (!path.empty()) {
        const size_t slash = std::min(path.find('/'), path.size());
        if (slash > 0 && path.substr(0, slash) != ".") segments.push_back(path.substr(0, slash));
        path.remove_prefix(std::min(slash + 1, path.size()));
    }
    return segments;
}

Glob::Glob(std::string_view pattern) : text_(pattern) {
    std::vector<std::string> expanded;
    expand_braces(text_, expanded);
    for (const std::string& one : expanded) {
        std::vector<std::string> segments;
        for (const std::string_view segment : split_path(one)) {
            if (segment != "**" && segment.starts_with("**")) {  // **.cl reads as **/*.cl
                segments.emplace_back("**");
                segments.emplace_back(segment.substr(1));
            } else {
                segments.emplace_back(segment);
            }
        }
        const bool wild = std::any_of(segments.begin(), segments.end(), has_wildcard);
        literal_ = expanded.size() == 1 && !wild;
        const bool folder = one.ends_with('/') || one == "." || segments.empty();
        if (!folder) alternatives_.push_back(segments);
        if (folder || !has_wildcard(segments.back())) {
            segments.emplace_back("**");
            segments.emplace_back("*");
            alternatives_.push_back(std::move(segments));
        }
    }
}

bool Glob::matches(std::string_view path) const {
    const auto segments = split_path(path);
    return std::any_of(alternatives_.begin(), alternatives_.end(),
                       [&](const auto& alternative) { return segments_match(alternative, segments); });
}

std::vector<std::string> Glob::roots() const {
    std::vector<std::string> roots;
    for (const auto& alternative : alternatives_) {
        std::string root;
        for (size_t i = 0; i + 1 < alternative.size() && !has_wildcard(alternative[i]); ++i)
            root += (root.empty() ? "" : "/") + alternative[i];
        roots.push_back(root.empty() ? "." : root);
    }
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    return roots;
}

}  // namespace porttool
