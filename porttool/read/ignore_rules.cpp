// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/ignore_rules.h"

#include <algorithm>

#include "porttool/read/glob.h"

namespace porttool {

void IgnoreRules::add(std::string_view folder, std::string_view text) {
    auto layer = std::make_shared<Layer>();
    layer->folder = std::string(folder);
    layer->above = std::move(innermost_);
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        layer->add(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    innermost_ = std::move(layer);
}

void IgnoreRules::Layer::add(std::string_view line) {
    constexpr size_t kLongestRule = 4096, kMostWild = 4096;
    if (is_full) return;
    if (line.ends_with('\r')) line.remove_suffix(1);
    while (line.ends_with(' ') && !line.ends_with("\\ ")) line.remove_suffix(1);
    if (line.empty() || line.starts_with('#')) return;
    if (line.size() > kLongestRule) return give_up();
    Rule rule;
    if (line.starts_with('!')) {
        rule.negated = true;
        line.remove_prefix(1);
    }
    if (line.ends_with('/')) {
        rule.folders_only = true;
        line.remove_suffix(1);
    }
    const bool anywhere = line.find('/') == std::string_view::npos;
    if (anywhere) rule.pattern.emplace_back("**");
    std::string path;
    for (const auto segment : split_path(line)) {
        if (segment != "**" || rule.pattern.empty() || rule.pattern.back() != "**") rule.pattern.emplace_back(segment);
        path += (path.empty() ? "" : "/") + std::string(segment);
    }
    if (rule.pattern.empty()) return;
    if (line.find_first_of("*?[\\") == std::string_view::npos)
        (anywhere ? by_name : by_path)[path].push_back(rules.size());
    else
        wild.push_back(rules.size());
    rules.push_back(std::move(rule));
    if (wild.size() <= kMostWild) return;
    // What is ignored by some rules and not by later ones cannot be told by a part of them: nothing is.
    give_up();
}

void IgnoreRules::Layer::give_up() {
    is_full = true;
    rules.clear();
    by_name.clear();
    by_path.clear();
    wild.clear();
}

bool IgnoreRules::ignores(std::string_view path, bool is_directory) const {
    for (const Layer* layer = innermost_.get(); layer != nullptr; layer = layer->above.get()) {
        std::string_view below = path;
        if (!layer->folder.empty()) {
            if (!path.starts_with(layer->folder) || path.size() <= layer->folder.size() ||
                path[layer->folder.size()] != '/')
                continue;
            below.remove_prefix(layer->folder.size() + 1);
        }
        if (const Rule* rule = layer->last_match(below, is_directory)) return !rule->negated;
    }
    return false;
}

const IgnoreRules::Rule* IgnoreRules::Layer::last_match(std::string_view path, bool is_directory) const {
    const Rule* best = nullptr;
    const auto segments = split_path(path);
    if (!segments.empty()) consider(by_name, segments.back(), is_directory, best);
    consider(by_path, path, is_directory, best);
    for (auto index = wild.rbegin(); index != wild.rend(); ++index) {
        const Rule& rule = rules[*index];
        if (best != nullptr && &rule < best) break;
        if ((!rule.folders_only || is_directory) && segments_match(rule.pattern, segments)) return &rule;
    }
    return best;
}

void IgnoreRules::Layer::consider(const Index& index, std::string_view key, bool is_directory,
                                  const Rule*& best) const {
    if (index.empty()) return;
    const auto found = index.find(std::string(key));
    if (found == index.end()) return;
    for (auto at = found->second.rbegin(); at != found->second.rend(); ++at) {
        const Rule& rule = rules[*at];
        if (rule.folders_only && !is_directory) continue;
        if (best == nullptr || &rule > best) best = &rule;
        return;
    }
}

}  // namespace porttool
