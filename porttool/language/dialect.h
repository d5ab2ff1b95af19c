// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace porttool {

/// One vocabulary for all dialects: each type, built-in and qualifier leads to the name that it goes by here. A
/// qualifier that has no counterpart elsewhere (address spaces, inlining, storage) leads to "".
class Dialect {
public:
    /// The built-in table, extended by `rows` from portmap.toml (`"vec3" = "float3"`: the two are one).
    explicit Dialect(const std::vector<std::pair<std::string, std::string>>& rows = {});

    /// The common name of a word, or nullptr if the table does not know it: what units are paired and measured by.
    const std::string* find(std::string_view word) const;

    /// The same, but words share a name only if they mean the same: `fmod` is not `mod`. What edits are compared by.
    const std::string* meaning(std::string_view word) const;

    /// True for a type, under whichever of its names, that numbers and vectors are cast to.
    bool is_number_type(std::string_view name) const;

    /// Takes names that each side has of its own for one thing, as the two functions of a pair have: source, target.
    void add_counterparts(const std::vector<std::pair<std::string, std::string>>& names);

    /// What the source calls that which is called so in the target, or nullptr if no pair says it.
    const std::string* counterpart(std::string_view target_name) const;

    /// True for a name that has another counterpart in the target than its own name.
    bool has_counterpart(std::string_view source_name) const { return with_counterpart_.contains(source_name); }

private:
    struct Hash {
        using is_transparent = void;
        size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
    };
    using Names = std::unordered_map<std::string, std::string, Hash, std::equal_to<>>;
    Names names_, meanings_, counterparts_;
    std::unordered_set<std::string, Hash, std::equal_to<>> with_counterpart_;
};

}  // namespace porttool
