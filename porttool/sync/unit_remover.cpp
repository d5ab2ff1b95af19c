// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/unit_remover.h"

#include <algorithm>

#include "porttool/scan/scan.h"
#include "porttool/sync/file_text.h"
#include "porttool/sync/unit_extent.h"

namespace porttool {
namespace {

/// How often a file has a name, comments apart.
size_t times_of(const ScannedFile& file, std::string_view name) {
    if (file.lexed.text.find(name) == std::string::npos) return 0;
    const std::vector<Token>& tokens = file.lexed.tokens;
    return static_cast<size_t>(std::count_if(tokens.begin(), tokens.end(),
                                             [&](const Token& token) { return file.lexed.view(token) == name; }));
}

bool stands_once(const ScannedFile& file, const std::string& name) {
    return std::count_if(file.units.begin(), file.units.end(),
                         [&](const Unit& unit) { return bare_leaf_of(unit.name) == name; }) < 2;
}

}  // namespace

std::string UnitRemover::remove(const JudgedPair& pair, Side to, const std::vector<Proposal>& so_far,
                                const NewUnits& new_units) {
    const UnitState& port = *pair.unit[to];
    const ScannedFile* file = knowledge_.file_of(to, port.file);
    const bool is_code =
        port.kind == UnitKind::Function || port.kind == UnitKind::Constant || port.kind == UnitKind::Struct;
    if (file == nullptr || !is_code) return "only a function, a struct or a constant goes by itself";
    Draft& draft = drafts_.of(to, *file);
    const Unit* unit = draft.unit(port.id);
    const std::string name(bare_leaf_of(port.name));
    if (draft.is_linked || unit == nullptr || !stands_once(draft.scanned, name))
        return "its file has it in another form";
    const std::string& partner = pair.id[other_side(to)];
    const std::string gone(bare_leaf_of(std::string_view(partner).substr(partner.find(':') + 1)));
    for (const ScannedFile& other : knowledge_.files(other_side(to)))
        if (times_of(other, gone) > 0) return "`" + gone + "` still stands in " + other.path;
    if (const std::string fresh = new_units.still_alone(other_side(to)); !fresh.empty())
        return "`" + fresh + "` came without a port, and may be what became of it";
    if (std::string why = user_of(name, pair, to, so_far); !why.empty()) return why;
    try {
        record_.remove(pair.id);
    } catch (const CannotDo& error) {
        return error.what();
    }
    cut_out(pair, to, draft);
    return {};
}

/// Who of its side would still use it, the work of this run included.
std::string UnitRemover::user_of(const std::string& name, const JudgedPair& pair, Side to,
                                 const std::vector<Proposal>& so_far) {
    for (const ScannedFile& file : knowledge_.files(to)) {
        const Draft* draft = drafts_.find(to, file.path);
        const size_t own = file.path == pair.unit[to]->file ? 1 : 0;
        const ScannedFile& now = draft == nullptr ? file : draft->scanned;
        const Unit* unit = own == 0 ? nullptr : unit_named(now, pair.unit[to]->id);
        size_t times = times_of(now, name);
        if (unit != nullptr)
            for (uint32_t i = unit->tokens.first; i < unit->tokens.end; ++i) times -= now.lexed.view(i) == name;
        if (times > 0) return "the port's " + file.path + " still uses `" + name + "`";
    }
    // What is only left in part may never be written.
    for (const Proposal& one : so_far) {
        if (one.left.empty()) continue;
        const auto state = checked_.states[to].find(one.id[to]);
        if (state == checked_.states[to].end() || one.id[to] == pair.id[to]) continue;
        const auto words = state->second.text.words();
        if (std::find(words.begin(), words.end(), name) != words.end())
            return "`" + one.id[to] + "` uses it, and its own port is left";
    }
    return {};
}

void UnitRemover::cut_out(const JudgedPair& pair, Side to, Draft& draft) {
    const Unit& unit = *draft.unit(pair.unit[to]->id);
    const UnitExtent extent = extent_of(draft.scanned, unit);
    const LexedText& lexed = draft.scanned.lexed;
    const std::string& text = lexed.text;
    // A comment that the other side kept is of what follows as well.
    size_t first = extent.comment;
    if (extent.comment < extent.code) {
        const std::string comment = text.substr(extent.comment, text.find('\n', extent.comment) - extent.comment);
        for (const ScannedFile& other : knowledge_.files(other_side(to)))
            if (other.lexed.text.find(comment) != std::string::npos) first = extent.code;
    }
    size_t end = extent.end;
    if (extent.has_lines) {
        first = text.rfind('\n', first) + 1;
        const bool is_apart = (first == 0 || blank_lines_above(lexed, first) > 0) && blank_lines_below(lexed, end) > 0;
        end = std::min(text.find('\n', end), text.size() - 1) + 1;
        if (is_apart) end = std::min(text.find('\n', end), text.size() - 1) + 1;
    } else {
        first = extent.code;
    }
    const std::optional<std::string> now = edit_file(draft.bytes, text, {{first, end, ""}});
    if (!now) return;
    drafts_.write(draft, *now, scan_text(draft.scanned.path, *now));
}

}  // namespace porttool
