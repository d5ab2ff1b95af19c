// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// The rules of the `.gitignore` files from a root down to one folder, in git's meaning: the last rule that matches
/// decides, `!` brings back, a slash anchors, a trailing slash means folders only.
class IgnoreRules {
public:
    /// Adds the text of the `.gitignore` in `folder` (relative to the root, "" for the root itself).
    void add(std::string_view folder, std::string_view text);
    bool ignores(std::string_view path, bool is_directory) const;

private:
    struct Rule {
        std::string folder;
        std::vector<std::string> pattern;
        bool negated = false;
        bool folders_only = false;
    };
    std::vector<Rule> rules_;
};

}  // namespace porttool
