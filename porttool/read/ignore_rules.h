// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace porttool {

/// The rules of the `.gitignore` files from a root down to one folder, in git's meaning: the last rule that matches
/// decides, `!` brings back, a slash anchors, a trailing slash means folders only. Copies share what they hold. Of a
/// file's rules with wildcards the first 4096 hold; a rule longer than any path is left out.
class IgnoreRules {
public:
    /// Adds the text of the `.gitignore` in `folder` (relative to the root, "" for the root itself).
    void add(std::string_view folder, std::string_view text);
    bool ignores(std::string_view path, bool is_directory) const;

private:
    struct Rule {
        std::vector<std::string> pattern;
        bool negated = false;
        bool folders_only = false;
    };
    using Index = std::unordered_map<std::string, std::vector<size_t>>;

    /// The rules of one file, found by the name or the path that they spell out where they have no wildcard.
    struct Layer {
        std::string folder;
        std::vector<Rule> rules;
        Index by_name, by_path;
        std::vector<size_t> wild;
        bool is_full = false;                ///< it had more than is taken, and ignores nothing
        std::shared_ptr<const Layer> above;  ///< of the folder above

        void add(std::string_view line);
        void give_up();
        const Rule* last_match(std::string_view path, bool is_directory) const;
        void consider(const Index& index, std::string_view key, bool is_directory, const Rule*& best) const;
    };

    std::shared_ptr<const Layer> innermost_;
};

}  // namespace porttool
