// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/snapshot/named_text.h"

#include <algorithm>
#include <vector>

#include "porttool/read/cannot_do.h"
#include "porttool/read/source_files.h"
#include "porttool/scan/scan.h"
#include "porttool/text/sink/shell.h"
#include "porttool/text/sink/terminal.h"
#include "porttool/text/suggest.h"

namespace porttool {
namespace {

bool is_file(const Disk& disk, const std::string& path) { return disk.exists(path) && !disk.is_directory(path); }

/// An argument taken apart: PATH or PATH:NAME.
struct NamedFile {
    std::string path;  ///< absolute
    std::string name;  ///< empty: the whole file
};

/// The part of an argument that is a file below `folder`: all of it, else the longest part before a colon. Nothing if
/// there is none.
std::optional<NamedFile> find_file(const Disk& disk, const std::string& folder, const std::string& argument) {
    for (size_t end = argument.size(); end != std::string::npos && end > 0; end = argument.rfind(':', end - 1)) {
        const std::string path = absolute_path(join_path(folder, argument.substr(0, end)));
        if (is_file(disk, path))
            return NamedFile{path, end < argument.size() ? argument.substr(end + 1) : std::string()};
    }
    return std::nullopt;
}

[[noreturn]] void refuse_argument(const Disk& disk, const std::string& folder, const std::string& argument) {
    if (argument.empty()) throw CannotDo("compare: an empty name; name a file, or a unit as PATH:NAME");
    if (disk.is_directory(absolute_path(join_path(folder, argument))))
        throw CannotDo(terminal_text(argument) + " is a folder; name a file, or a unit as PATH:NAME");
    throw CannotDo(terminal_text(argument) +
                   ": no such file or unit; paths are relative to -C or to the root, units are PATH:NAME");
}

/// The unit most like a name: one with the same last part, else the one with the fewest letters changed.
std::string nearest_unit(const ScannedFile& file, const std::string& name) {
    std::vector<std::string> names, leaves;
    for (const Unit& unit : file.units) {
        if (leaf_of(unit.name) == leaf_of(name)) return unit.name;
        names.push_back(unit.name);
        leaves.emplace_back(leaf_of(unit.name));
    }
    if (const std::string near = nearest(name, names); !near.empty()) return near;
    const std::string near = nearest(std::string(leaf_of(name)), leaves);
    const auto at = std::find(leaves.begin(), leaves.end(), near);
    return near.empty() ? near : names[static_cast<size_t>(at - leaves.begin())];
}

[[noreturn]] void refuse_unit(const ScannedFile& file, const std::string& name) {
    std::string text = terminal_text(file.path) + " has no unit '" + terminal_text(name) + "'";
    if (const std::string near = nearest_unit(file, name); !near.empty())
        text += "; did you mean '" + terminal_text(near) + "'?";
    text += "\nporttool scan " + terminal_text(shell_word(file.path)) + " lists its " +
            std::to_string(file.units.size()) + " units";
    throw CannotDo(text);
}

}  // namespace

std::string NamedText::id() const { return unit ? unit_id(file, file.units[*unit]) : file.path + ":@file"; }

NamedText read_named_text(const Disk& disk, const std::string& directory, const std::string& root,
                          const std::string& argument) {
    std::optional<NamedFile> named = find_file(disk, directory, argument);
    if (!named) named = find_file(disk, root, argument);
    if (!named) refuse_argument(disk, directory, argument);
    std::vector<std::string> missing;
    const SourceSet sources = read_paths(disk, root, {named->path}, missing);
    if (!missing.empty()) throw CannotDo(terminal_text(argument) + ": no such file");
    if (!sources.skipped.empty())
        throw CannotDo(terminal_text(sources.skipped[0].file) + ": " + sources.skipped[0].reason);
    NamedText side{scan_text(sources.files[0].path, sources.files[0].text), std::nullopt};
    if (named->name.empty() || named->name == "@file") return side;
    for (size_t i = 0; i < side.file.units.size(); ++i)
        if (side.file.units[i].name == named->name) side.unit = i;
    if (!side.unit) refuse_unit(side.file, named->name);
    return side;
}

}  // namespace porttool
