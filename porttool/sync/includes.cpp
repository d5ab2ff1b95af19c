// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/includes.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "porttool/language/language.h"
#include "porttool/sync/unit_extent.h"

namespace porttool {
namespace {

/// The headers of C, which C++ has under both names, and those of C++ alone.
const std::set<std::string_view> kOfC = {"assert", "ctype",  "errno",  "float",  "inttypes", "limits", "locale",
                                         "math",   "setjmp", "signal", "stdarg", "stddef",   "stdint", "stdio",
                                         "stdlib", "string", "time",   "wchar",  "fenv",     "complex"};
const std::set<std::string_view> kOfCpp = {"algorithm",
                                           "array",
                                           "atomic",
                                           "bit",
                                           "bitset",
                                           "chrono",
                                           "complex",
                                           "deque",
                                           "exception",
                                           "execution",
                                           "filesystem",
                                           "fstream",
                                           "functional",
                                           "future",
                                           "iomanip",
                                           "iostream",
                                           "istream",
                                           "iterator",
                                           "limits",
                                           "list",
                                           "map",
                                           "memory",
                                           "mutex",
                                           "new",
                                           "numeric",
                                           "optional",
                                           "ostream",
                                           "queue",
                                           "random",
                                           "ratio",
                                           "regex",
                                           "set",
                                           "span",
                                           "sstream",
                                           "stack",
                                           "stdexcept",
                                           "string",
                                           "string_view",
                                           "thread",
                                           "tuple",
                                           "typeinfo",
                                           "type_traits",
                                           "utility",
                                           "unordered_map",
                                           "unordered_set",
                                           "valarray",
                                           "variant",
                                           "vector",
                                           "concepts",
                                           "numbers",
                                           "ranges",
                                           "condition_variable",
                                           "initializer_list"};

/// `<math.h>` and `<cmath>` are one.
std::string meaning_of_include(const std::string& what) {
    if (what.size() < 3 || what.front() != '<') return what;
    const std::string name = what.substr(1, what.size() - 2);
    if (name.ends_with(".h") && kOfC.contains(name.substr(0, name.size() - 2)))
        return "<c" + name.substr(0, name.size() - 2) + ">";
    return what;
}

}  // namespace

std::vector<IncludeLine> include_lines(const ScannedFile& file) {
    const LexedText& lexed = file.lexed;
    std::vector<IncludeLine> out;
    for (const Directive& directive : lexed.directives) {
        if (directive.kind != DirectiveKind::Include || directive.line != directive.end_line) continue;
        const size_t first = lexed.line_starts[directive.line - 1];
        const size_t end = std::min(lexed.text.find('\n', first), lexed.text.size());
        const std::string_view line = std::string_view(lexed.text).substr(first, end - first);
        const size_t open = line.find_first_of("<\"");
        if (open == std::string_view::npos || end == lexed.text.size()) continue;
        const size_t close = line.find(line[open] == '<' ? '>' : '"', open + 1);
        if (close == std::string_view::npos) continue;
        out.push_back({std::string(line.substr(open, close + 1 - open)), first, end + 1,
                       !branches_around(file, directive.first_token).empty()});
    }
    return out;
}

std::string standard_include(const std::string& what, Language there) {
    if (what.size() < 3 || what.front() != '<') return {};
    const std::string meaning = meaning_of_include(what), name = meaning.substr(1, meaning.size() - 2);
    if (meaning.starts_with("<c") && kOfC.contains(name.substr(1))) {
        if (traits_of(there).std_library) return what;
        return there == Language::C ? "<" + name.substr(1) + ".h>" : std::string();
    }
    return kOfCpp.contains(name) && traits_of(there).std_library ? what : std::string();
}

std::vector<TextEdit> port_includes(const ScannedFile& before, const ScannedFile& now, const ScannedFile& port,
                                    const IncludeThere& there) {
    std::set<std::string> old;
    for (const IncludeLine& line : include_lines(before)) old.insert(line.what);
    const std::vector<IncludeLine> lines = include_lines(now), others = include_lines(port);
    std::map<std::string, const IncludeLine*> has;
    for (const IncludeLine& line : others) has.emplace(meaning_of_include(line.what), &line);
    // Where each of the source's stands in the port; for a new one, where it goes.
    std::vector<const IncludeLine*> at(lines.size(), nullptr);
    std::vector<std::string> said(lines.size());
    for (size_t i = 0; i < lines.size(); ++i) {
        std::string text = there(lines[i].what);
        bool is_there = false;
        for (const std::string& what : {text, lines[i].what})
            if (const auto found = has.find(meaning_of_include(what)); found != has.end()) {
                is_there = true;
                if (!found->second->in_branch && !lines[i].in_branch && at[i] == nullptr) at[i] = found->second;
            }
        const bool is_new = !old.contains(lines[i].what) && !lines[i].in_branch && !is_there;
        if (is_new) said[i] = std::move(text);
    }
    std::map<size_t, std::string> added;
    for (size_t i = 0; i < lines.size(); ++i) {
        if (said[i].empty()) continue;
        size_t left = i, right = i;
        while (left > 0 && at[left - 1] == nullptr) --left;
        while (right < lines.size() && at[right] == nullptr) ++right;
        if (left > 0)
            added[at[left - 1]->next] += "#include " + said[i] + "\n";
        else if (right < lines.size())
            added[at[right]->first] += "#include " + said[i] + "\n";
    }
    std::vector<TextEdit> out;
    for (auto& [offset, text] : added) out.push_back({offset, offset, std::move(text)});
    return out;
}

}  // namespace porttool
