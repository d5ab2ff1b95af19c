// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/effort/changed_side.h"

#include <map>

namespace porttool {

EditedUnit ChangedSide::edit_of_pair(const std::string& id) {
    EditedUnit out;
    out.now = now_.find(id);
    const LinesOfCode before = read_paired(before_.find_before(id, now_));
    out.lines = edited_lines(before, read_paired(out.now));
    return out;
}

std::vector<FileEffort> ChangedSide::outside(size_t& words) {
    struct Versions {
        const ScannedFile *before = nullptr, *now = nullptr;
    };
    std::map<std::string_view, Versions> files;
    for (const ScannedFile& file : files_before_) files[file.path].before = &file;
    for (const ScannedFile& file : files_now_) files[file.path].now = &file;
    std::vector<FileEffort> out;
    for (const auto& [path, file] : files) {
        if (file.before != nullptr && file.now != nullptr && file.before->lexed.text == file.now->lexed.text) continue;
        const EditedLines lines = edited_lines(read_outside(file.before), read_outside(file.now));
        if (lines.edit.changed() == 0) continue;
        out.push_back({std::string(path), lines.edit});
        words += added_words(lines, reader_.words).size();
    }
    return out;
}

LinesOfCode ChangedSide::read_paired(const Excerpt& excerpt) {
    LinesOfCode code = reader_.read(excerpt);
    if (code.lines.empty()) return code;
    std::vector<bool>& paired = paired_[excerpt.file];
    paired.resize(excerpt.file->lexed.line_count + size_t{2});
    for (const TextLine& line : code.lines) paired[line.line] = true;
    return code;
}

LinesOfCode ChangedSide::read_outside(const ScannedFile* file) const {
    LinesOfCode code = reader_.read({file, nullptr});
    if (const auto found = paired_.find(file); found != paired_.end())
        std::erase_if(code.lines, [&](const TextLine& line) { return found->second[line.line]; });
    return code;
}

}  // namespace porttool
