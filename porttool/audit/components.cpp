// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/audit/components.h"

#include <string_view>

namespace porttool {
namespace {

using Text = std::vector<std::string>;

/// Which component a name is, from 1 on; 0 for no component.
size_t component_of(const std::string& name) {
    constexpr std::string_view kNames[] = {"xyzw", "rgba", "RGBA"};
    if (name.size() != 1) return 0;
    for (const std::string_view names : kNames)
        if (const size_t at = names.find(name[0]); at != std::string_view::npos) return at + 1;
    return 0;
}

size_t component_at(const Text& words, size_t dot) {
    const bool is_call = dot + 2 < words.size() && words[dot + 2] == "(";
    return words[dot] == "." && dot + 1 < words.size() && !is_call ? component_of(words[dot + 1]) : 0;
}

/// The one that all of a statement is about; 0 for none, or several.
size_t only_component(const Text& words) {
    size_t out = 0;
    for (size_t i = 1; i < words.size(); ++i) {
        const size_t here = component_at(words, i);
        if (here != 0 && out != 0 && here != out) return 0;
        if (here != 0) out = here;
    }
    return out;
}

}  // namespace

std::optional<Text> without_component(const Text& words) {
    if (only_component(words) == 0) return std::nullopt;
    Text out;
    for (size_t i = 0; i < words.size(); ++i) {
        if (i > 0 && component_at(words, i) != 0)
            ++i;
        else
            out.push_back(words[i]);
    }
    return out;
}

std::vector<ComponentRun> component_runs(const std::vector<Text>& statements) {
    std::vector<ComponentRun> out;
    for (size_t i = 0; i < statements.size();) {
        ComponentRun run{i, i + 1, {}};
        const auto whole = without_component(statements[i]);
        while (whole && run.end < statements.size() &&
               only_component(statements[run.end]) > only_component(statements[run.end - 1]) &&
               without_component(statements[run.end]) == whole)
            ++run.end;
        i = run.end;
        if (run.end - run.first < 2) continue;
        run.whole = *whole;
        out.push_back(std::move(run));
    }
    return out;
}

}  // namespace porttool
