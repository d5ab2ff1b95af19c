// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/include_carrier.h"

#include <algorithm>
#include <map>
#include <optional>

#include "porttool/scan/scan.h"
#include "porttool/sync/file_text.h"

namespace porttool {
namespace {

std::string folder_of_path(const std::string& path) { return path.substr(0, path.find_last_of('/') + 1); }

std::string inner(const std::string& what) { return what.substr(1, what.size() - 2); }

/// The file that an include of `file` means: in its own folder, or the only one whose path ends so.
const ScannedFile* included_file(const std::vector<ScannedFile>& files, const ScannedFile& file,
                                 const std::string& name) {
    const std::string beside = folder_of_path(file.path) + name;
    const ScannedFile* out = nullptr;
    for (const ScannedFile& other : files) {
        if (other.path == beside) return &other;
        if (other.path != name && !other.path.ends_with("/" + name)) continue;
        if (out != nullptr) return nullptr;
        out = &other;
    }
    return out;
}

bool same_units(const ScannedFile& a, const ScannedFile& b) {
    if (a.units.size() != b.units.size() || a.balanced != b.balanced) return false;
    for (size_t i = 0; i < a.units.size(); ++i)
        if (a.units[i].name != b.units[i].name || a.units[i].kind != b.units[i].kind) return false;
    return true;
}

}  // namespace

/// How the port's side includes the file that stands for one of the source's.
std::string IncludeCarrier::own_there(const std::string& name, const ScannedFile& port, Side from) const {
    const Side to = other_side(from);
    std::map<std::string, size_t> ports;
    size_t all = 0;
    for (const JudgedPair& pair : checked_.judgement.pairs)
        if (pair.unit[from] != nullptr && pair.unit[to] != nullptr && pair.unit[from]->file == name) {
            ++ports[pair.unit[to]->file];
            ++all;
        }
    for (const auto& [path, count] : ports) {
        if (4 * count < 3 * all || path == port.path) continue;
        // In the manner of the file's other includes of its own side: from the root, or from its folder.
        for (const IncludeLine& line : include_lines(port)) {
            const std::string text = inner(line.what);
            const ScannedFile* other =
                line.what.front() == '"' ? included_file(knowledge_.files(to), port, text) : nullptr;
            if (other == nullptr) continue;
            if (other->path == text && text.find('/') != std::string::npos) return '"' + path + '"';
            const std::string folder = folder_of_path(port.path);
            if (other->path == folder + text && path.starts_with(folder)) return '"' + path.substr(folder.size()) + '"';
        }
    }
    return {};
}

std::string IncludeCarrier::said_there(const std::string& what, const ScannedFile& file, const ScannedFile& port,
                                       Side from) const {
    if (what.front() == '"') {
        const ScannedFile* own = included_file(knowledge_.files(from), file, inner(what));
        return own == nullptr ? std::string() : own_there(own->path, port, from);
    }
    if (std::string text = standard_include(what, port.language); !text.empty()) return text;
    return file.language == port.language ? what : std::string();
}

void IncludeCarrier::carry(const JudgedPair& pair, Side from) {
    const Side to = other_side(from);
    const std::string &here = pair.unit[from]->file, &there = pair.unit[to]->file;
    if (!done_.insert({here, there}).second) return;
    const ScannedFile *file = knowledge_.file_of(from, here), *other = knowledge_.file_of(to, there);
    if (file == nullptr || other == nullptr || include_lines(*file).empty()) return;
    const std::string* text = earlier_.of(from, here);
    if (text == nullptr) return;
    Draft& draft = drafts_.of(to, *other);
    const std::vector<TextEdit> edits =
        port_includes(scan_text(here, *text), *file, draft.scanned,
                      [&](const std::string& what) { return said_there(what, *file, draft.scanned, from); });
    if (edits.empty()) return;
    const std::optional<std::string> now = edit_file(draft.bytes, draft.scanned.lexed.text, edits);
    if (!now) return;
    ScannedFile scanned = scan_text(there, *now);
    if (same_units(draft.scanned, scanned)) drafts_.write(draft, *now, std::move(scanned));
}

}  // namespace porttool
