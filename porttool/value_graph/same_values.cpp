// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/value_graph/same_values.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string>

#include "porttool/language/words.h"
#include "porttool/value_graph/function_run.h"

namespace porttool {
namespace {

/// A type without the stars at its end.
std::string bare(const std::string& type) { return type.substr(0, type.find('*')); }

bool is_vector(const std::string& type) { return is_plain_type(type) && !is_scalar_type(type) && type != "bool"; }

/// The names by which the other function's types are known here, as the parameters tell; nothing where they cannot be
/// one function's. A side may have several classes for what the other has as one vector.
std::optional<std::map<std::string, std::string, std::less<>>> type_names(const std::vector<std::string>& here,
                                                                          const std::vector<std::string>& there) {
    if (here.size() != there.size()) return std::nullopt;
    std::map<std::string, std::string, std::less<>> out, back;
    const auto is_own = [](const std::string& type) { return !type.empty() && !is_type_word(type); };
    for (size_t i = 0; i < here.size(); ++i) {
        const std::string a = bare(here[i]), b = bare(there[i]);
        if (here[i].size() - a.size() != there[i].size() - b.size()) return std::nullopt;  // as many stars
        if (a == b) continue;
        const bool class_for_vector = is_own(b) && is_vector(a), classes = is_own(a) && is_own(b);
        if (!class_for_vector && !classes) return std::nullopt;
        if (out.emplace(b, a).first->second != a) return std::nullopt;
        if (classes && back.emplace(a, b).first->second != b) return std::nullopt;
    }
    return out;
}

}  // namespace

bool give_the_same(const ReadFunction& one, const ReadFunction& other) {
    ValueTable table(one.manner.own_operators);
    try {
        const std::vector<Step> here = as_tree(one.statements), there = as_tree(other.statements);
        if (here.size() != 1 || there.size() != 1) return false;
        FunctionRun first(table, one.manner, here[0]);
        const auto names = type_names(first.types(), FunctionRun(table, other.manner, there[0]).types());
        if (!names) return false;
        const ReadingManner renamed{other.manner.dialect, other.manner.shading, *names, other.manner.own_operators};
        return first.outcome() == FunctionRun(table, renamed, there[0]).outcome();
    } catch (const Unread&) {
        return false;
    }
}

}  // namespace porttool
