// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// A pattern that stands for more than can be tried; says which, and what to do.
struct GlobTooLarge : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A pattern over `/`-separated relative paths: `*` and `?` within a folder, `**` over folders, `[a-z]`, `[!a]`,
/// `{a,b}`, backslash escapes. A pattern that names a folder matches what lies in it.
class Glob {
public:
    /// Throws GlobTooLarge.
    explicit Glob(std::string_view pattern);

    bool matches(std::string_view path) const;
    /// False for a folder below which no path matches.
    bool may_match_below(std::string_view folder) const;
    /// The folders that hold every match, as far as they are spelled out: "src" for `src/*.cl`.
    std::vector<std::string> roots() const;
    /// What every path that matches begins with, as far as it stands before the first wildcard.
    std::string start() const;
    /// True if the pattern has no wildcard and is one path.
    bool literal() const { return literal_; }
    const std::string& text() const { return text_; }
    /// How many patterns without braces it stands for.
    size_t size() const { return alternatives_.size(); }

private:
    std::string text_;
    std::vector<std::vector<std::string>> alternatives_;  ///< each as its segments
    bool literal_ = false;
};

/// Segments of a pattern against segments of a path; a segment `**` stands for any number.
bool segments_match(const std::vector<std::string>& pattern, const std::vector<std::string_view>& path);

std::vector<std::string_view> split_path(std::string_view path);

}  // namespace porttool
