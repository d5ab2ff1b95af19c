// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/ignore_rules.h"

#include <algorithm>

#include "porttool/read/glob.h"

namespace porttool {

void IgnoreRules::add(std::string_view folder, std::string_view text) {
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        while (line.ends_with(' ') && !line.ends_with("\\ ")) line.remove_suffix(1);
        if (line.empty() || line.starts_with('#')) continue;
        Rule rule;
        rule.folder = std::string(folder);
        if (line.starts_with('!')) {
            rule.negated = true;
            line.remove_prefix(1);
        }
        if (line.ends_with('/')) {
            rule.folders_only = true;
            line.remove_suffix(1);
        }
        if (line.find('/') == std::string_view::npos) rule.pattern.emplace_back("**");
        for (const auto segment : split_path(line)) rule.pattern.emplace_back(segment);
        if (!rule.pattern.empty()) rules_.push_back(std::move(rule));
    }
}

bool IgnoreRules::ignores(std::string_view path, bool is_directory) const {
    for (auto rule = rules_.rbegin(); rule != rules_.rend(); ++rule) {
        if (rule->folders_only && !is_directory) continue;
        std::string_view below = path;
        if (!rule->folder.empty()) {
            if (!path.starts_with(rule->folder) || path.size() <= rule->folder.size() ||
                path[rule->folder.size()] != '/')
                continue;
            below.remove_prefix(rule->folder.size() + 1);
        }
        if (segments_match(rule->pattern, split_path(below))) return !rule->negated;
    }
    return false;
}

}  // namespace porttool
