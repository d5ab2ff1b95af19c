// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/glob.h"

#include <algorithm>
#include <optional>
#include <set>
#include <utility>

#include "porttool/read/glob_segment.h"

namespace porttool {
namespace {

constexpr size_t kLongestPattern = 65'536, kMostAlternatives = 4096, kDeepestBraces = 32, kMostGroups = 256,
                 kMostBytes = 16'777'216;

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

/// The texts between the commas of a group.
std::vector<std::string_view> choices(std::string_view inner) {
    std::vector<std::string_view> out;
    int depth = 0;
    size_t first = 0;
    for (size_t i = 0; i <= inner.size(); ++i) {
        if (i < inner.size() && inner[i] == '{') ++depth;
        if (i < inner.size() && inner[i] == '}') --depth;
        if (i < inner.size() && (inner[i] != ',' || depth != 0)) continue;
        out.push_back(inner.substr(first, i - first));
        first = i + 1;
    }
    return out;
}

/// Counts what `{a,b}` written out would give, so that nothing is begun that has no end.
class BraceCount {
public:
    /// Above kMostAlternatives if there is more of anything than is taken.
    size_t of(std::string_view pattern, size_t depth = 0) {
        if (depth > kDeepestBraces) return kMostAlternatives + 1;
        size_t product = 1;
        for (size_t open = 0; open < pattern.size() && product <= kMostAlternatives; ++open) {
            if (pattern[open] == '\\') ++open;
            if (open >= pattern.size() || pattern[open] != '{') continue;
            const auto close = closing_brace(pattern, open);
            if (!close) break;
            if (++groups_ > kMostGroups) return kMostAlternatives + 1;
            size_t sum = 0;
            for (const std::string_view choice : choices(pattern.substr(open + 1, *close - open - 1)))
                sum += std::min(of(choice, depth + 1), kMostAlternatives + 1);
            product *= std::min(sum, kMostAlternatives + 1);
            open = *close;
        }
        return product;
    }

private:
    size_t groups_ = 0;
};

/// Writes `{a,b}` out, the first brace first.
void expand_braces(const std::string& pattern, size_t from, std::vector<std::string>& out) {
    for (size_t open = from; open < pattern.size(); ++open) {
        if (pattern[open] == '\\') {
            ++open;
            continue;
        }
        if (pattern[open] != '{') continue;
        const auto close = closing_brace(pattern, open);
        if (!close) break;
        const std::string_view text = pattern;
        for (const std::string_view choice : choices(text.substr(open + 1, *close - open - 1)))
            expand_braces(pattern.substr(0, open) + std::string(choice) + pattern.substr(*close + 1), open, out);
        return;
    }
    out.push_back(pattern);
}

/// Throws GlobTooLarge.
std::vector<std::string> expanded(const std::string& pattern) {
    const size_t count = pattern.size() > kLongestPattern ? kMostAlternatives + 1 : BraceCount().of(pattern);
    if (count > kMostAlternatives || count * pattern.size() > kMostBytes) {
        constexpr size_t kShown = 60;
        throw GlobTooLarge("the pattern '" + pattern.substr(0, kShown) + (pattern.size() > kShown ? "...'" : "'") +
                           " stands for too many: at most " + std::to_string(kMostAlternatives) +
                           " patterns of together 16 MiB, with at most " + std::to_string(kMostGroups) + " braces, " +
                           std::to_string(kDeepestBraces) + " in one another; write several shorter ones");
    }
    std::vector<std::string> out;
    expand_braces(pattern, 0, out);
    return out;
}

bool has_wildcard(std::string_view text) { return text.find_first_of("*?[") != std::string_view::npos; }

/// Segments of a pattern against a path's, one after another. Where a `**` may stand for this one or for no more, both
/// are followed.
class PatternProgress {
public:
    explicit PatternProgress(const std::vector<std::string>& pattern) : pattern_(pattern) { reach(0); }

    void step(std::string_view name) {
        const std::set<size_t> reached = std::exchange(reached_, {});
        for (const size_t at : reached) {
            if (at == pattern_.size()) continue;
            if (pattern_[at] == "**")
                reach(at);
            else if (segment_matches(pattern_[at], name))
                reach(at + 1);
        }
    }

    /// True if there is a path that goes on from here and matches.
    bool may_go_on() const { return !reached_.empty() && *reached_.begin() < pattern_.size(); }

private:
    void reach(size_t at) {
        const auto is_any = [&] { return at < pattern_.size() && pattern_[at] == "**"; };
        for (; is_any(); ++at)
            if (at + 1 == pattern_.size() || pattern_[at + 1] != "**") reached_.insert(at);
        reached_.insert(at);
    }

    const std::vector<std::string>& pattern_;
    std::set<size_t> reached_;  ///< how many segments of the pattern may be behind
};

}  // namespace

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
    const std::vector<std::string> all = expanded(text_);
    for (const std::string& one : all) {
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
        literal_ = all.size() == 1 && !wild;
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

bool Glob::may_match_below(std::string_view folder) const {
    const auto segments = split_path(folder);
    return std::any_of(alternatives_.begin(), alternatives_.end(), [&](const auto& alternative) {
        PatternProgress progress(alternative);
        for (const std::string_view segment : segments) progress.step(segment);
        return progress.may_go_on();
    });
}

std::string Glob::start() const {
    std::string start = text_.substr(0, text_.find_first_of("*?[{\\"));
    const bool is_written_otherwise = start.starts_with('.') || start.starts_with('/') ||
                                      start.find("/.") != std::string::npos || start.find("//") != std::string::npos;
    if (is_written_otherwise) return {};
    if (start.ends_with('/')) start.pop_back();
    return start;
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
