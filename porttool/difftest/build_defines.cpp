// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/build_defines.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <filesystem>

#include "porttool/read/bounded_json.h"
#include "porttool/read/refusals.h"

namespace porttool {
namespace {

constexpr uint64_t kLargestBuildFile = 1ull << 20;
constexpr uint64_t kLargestCommands = 64ull << 20;
constexpr int kMostFoldersUp = 3;
constexpr size_t kMostMacros = 256;

bool is_name_char(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Adds `NAME` or `NAME=VALUE`. What holds anything that a preprocessor would not take as one value is left out.
void add_macro(Macros& out, std::string_view text) {
    const size_t equals = std::min(text.find('='), text.size());
    const std::string_view name = text.substr(0, equals);
    std::string value(equals < text.size() ? text.substr(equals + 1) : "1");
    if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0 || out.size() >= kMostMacros ||
        !std::all_of(name.begin(), name.end(), is_name_char))
        return;
    if (value.size() > 1 && (value[0] == '\'' || value[0] == '"') && value.back() == value[0])
        value = value.substr(1, value.size() - 2);
    const auto is_odd = [](char c) { return std::string_view("$@\\\"'`;<>#\n\r").find(c) != std::string_view::npos; };
    if (std::any_of(value.begin(), value.end(), is_odd)) return;
    out.emplace_back(name, value);
}

/// The lines of a text, those that a backslash goes on in one.
std::vector<std::string> whole_lines(std::string_view text) {
    std::vector<std::string> out(1);
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '\n') {
            out.back() += ' ';
            ++i;
        } else if (text[i] == '\n') {
            out.emplace_back();
        } else {
            out.back() += text[i];
        }
    }
    return out;
}

std::string_view first_word(std::string_view line) {
    const size_t first = std::min(line.find_first_not_of(" \t"), line.size());
    size_t end = first;
    while (end < line.size() && is_name_char(line[end])) ++end;
    return line.substr(first, end - first);
}

void append(Macros& out, Macros more) {
    for (auto& macro : more)
        if (out.size() < kMostMacros) out.push_back(std::move(macro));
}

std::string folder_above(const std::string& folder) {
    if (folder.empty()) return {};
    const size_t slash = folder.rfind('/', folder.size() - 2);
    return slash == std::string::npos ? std::string() : folder.substr(0, slash + 1);
}

}  // namespace

bool is_macro(std::string_view text) {
    Macros out;
    add_macro(out, text);
    return !out.empty();
}

Macros macros_in_flags(std::string_view flags) {
    Macros out;
    for (size_t at = 0; at < flags.size();) {
        const size_t first = flags.find_first_not_of(" \t", at);
        if (first == std::string_view::npos) break;
        size_t end = first;
        char quote = 0;
        for (; end < flags.size() && (quote != 0 || (flags[end] != ' ' && flags[end] != '\t')); ++end) {
            if (quote == 0 && (flags[end] == '"' || flags[end] == '\''))
                quote = flags[end];
            else if (flags[end] == quote)
                quote = 0;
        }
        std::string_view word = flags.substr(first, end - first);
        at = end;
        if (word.size() > 2 && (word[0] == '"' || word[0] == '\'') && word.back() == word[0])
            word = word.substr(1, word.size() - 2);
        if (word == "-D") {
            const size_t next = std::min(flags.find_first_not_of(" \t", at), flags.size());
            at = std::min(flags.find_first_of(" \t", next), flags.size());
            add_macro(out, flags.substr(next, at - next));
        } else if (word.starts_with("-D")) {
            add_macro(out, word.substr(2));
        }
    }
    return out;
}

Macros macros_in_makefile(std::string_view text) {
    Macros out;
    int depth = 0;
    for (std::string& line : whole_lines(text)) {
        const std::string_view word = first_word(line);
        if (const size_t equals = line.find('='); equals != std::string::npos && line.find("-D") > equals)
            line[equals] = ' ';  // FLAGS=-DNAME
        if (word == "ifeq" || word == "ifneq" || word == "ifdef" || word == "ifndef") ++depth;
        if (word == "endif" && depth > 0) --depth;
        if (depth > 0) continue;
        append(out, macros_in_flags(std::string_view(line).substr(0, line.find('#'))));
    }
    return out;
}

Macros macros_in_cmake(std::string_view text) {
    Macros out;
    int depth = 0;
    for (size_t at = 0; at < text.size();) {
        if (text[at] == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (!is_name_char(text[at])) {
            ++at;
            continue;
        }
        const std::string_view name = first_word(text.substr(at));
        at += name.size();
        const size_t open = text.find_first_not_of(" \t", at);
        if (name == "if") ++depth;
        if (name == "endif" && depth > 0) --depth;
        const bool takes_flags = name == "add_definitions" || name == "add_compile_options";
        const bool takes_names = name == "add_compile_definitions" || name == "target_compile_definitions";
        if ((!takes_flags && !takes_names) || depth > 0 || open == std::string_view::npos || text[open] != '(')
            continue;
        const size_t close = std::min(text.find(')', open), text.size());
        std::string list(text.substr(open + 1, close - open - 1));
        std::replace(list.begin(), list.end(), '\n', ' ');
        at = close;
        if (takes_flags) {
            append(out, macros_in_flags(list));
            continue;
        }
        bool listed = name == "add_compile_definitions";
        for (size_t i = 0; i < list.size();) {
            const size_t first = list.find_first_not_of(" \t", i);
            if (first == std::string::npos) break;
            i = std::min(list.find_first_of(" \t", first), list.size());
            const std::string_view word = std::string_view(list).substr(first, i - first);
            if (word == "PRIVATE" || word == "PUBLIC" || word == "INTERFACE")
                listed = true;
            else if (listed)
                add_macro(out, word.starts_with("-D") ? word.substr(2) : word);
        }
    }
    return out;
}

BuildDefines::BuildDefines(const std::string& root, const Disk& disk, const std::vector<std::string>& given)
    : root_(root), disk_(disk) {
    for (const std::string& one : given) add_macro(given_, one);
    for (const char* path : {"compile_commands.json", "build/compile_commands.json"})
        if (commands_.empty()) read_commands(path);
}

/// Nothing where there is none, or none that may be read.
std::optional<std::string> BuildDefines::read(const std::string& path, uint64_t limit) const {
    FileText text = disk_.read(TreePath{root_, path}, limit);
    const bool is_missing = text.error == cannot_be_read(ENOENT) || text.error == cannot_be_read(ENOTDIR);
    if (!text.error.empty() && !is_missing) unread_.push_back(path + ": " + text.error);
    return text.error.empty() ? std::optional(std::move(text.bytes)) : std::nullopt;
}

void BuildDefines::read_commands(const std::string& path) {
    const std::optional<std::string> text = read(path, kLargestCommands);
    if (!text) return;
    constexpr int kDeepest = 16;
    const auto all = bounded_json<nlohmann::json>(*text, kDeepest);
    if (!all.is_array()) return;
    const auto string_in = [](const nlohmann::json& one, const char* name) {
        return one.contains(name) && one[name].is_string() ? one[name].get<std::string>() : std::string();
    };
    const std::filesystem::path root = std::filesystem::absolute(root_).lexically_normal();
    for (const nlohmann::json& one : all) {
        if (!one.is_object()) continue;
        const auto file = (std::filesystem::path(string_in(one, "directory")) / string_in(one, "file"))
                              .lexically_normal()
                              .lexically_relative(root);
        Macros macros = macros_in_flags(string_in(one, "command"));
        if (one.contains("arguments") && one["arguments"].is_array())
            for (const nlohmann::json& argument : one["arguments"])
                if (argument.is_string() && argument.get<std::string>().starts_with("-D"))
                    add_macro(macros, argument.get<std::string>().substr(2));
        commands_.emplace(file.generic_string(), std::move(macros));
    }
}

const Macros& BuildDefines::of_folder(const std::string& folder, int up) const {
    const auto [at, is_new] = folders_.try_emplace(folder);
    if (!is_new) return at->second;
    for (const char* name : {"Makefile", "makefile", "GNUmakefile", "CMakeLists.txt"}) {
        const std::optional<std::string> text = read(folder + name, kLargestBuildFile);
        if (!text) continue;
        return folders_[folder] = name[0] == 'C' ? macros_in_cmake(*text) : macros_in_makefile(*text);
    }
    if (folder.empty() || up == kMostFoldersUp) return at->second;
    Macros above = of_folder(folder_above(folder), up + 1);
    return folders_[folder] = std::move(above);
}

const std::string& BuildDefines::text_for(const std::string& path) const {
    const auto [at, is_new] = texts_.try_emplace(path);
    if (!is_new) return at->second;
    const auto command = commands_.find(path);
    const Macros& of_build = command != commands_.end()
                                 ? command->second
                                 : of_folder(path.substr(0, path.rfind('/') + 1), 0);  // npos + 1 is 0
    std::map<std::string, bool> known;
    for (const Macros* macros : {&given_, &of_build})
        for (const auto& [name, value] : *macros)
            if (known.emplace(name, true).second) at->second += "#define " + name + " " + value + "\n";
    return at->second;
}

}  // namespace porttool
