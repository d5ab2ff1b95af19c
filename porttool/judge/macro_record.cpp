// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/macro_record.h"

#include <set>
#include <string>
#include <utility>

#include "porttool/normal/word_macros.h"

namespace porttool {
namespace {

/// Fills in lines of pairs by what the files of one moment say.
class MacroNotes {
public:
    MacroNotes(const BySide<FilesOfSide>& files, const States& states)
        : macros_{WordMacros(files.source.macros()), WordMacros(files.target.macros())}, states_(states) {}

    /// True if there was something to note.
    bool note(LockedPair& line) {
        const bool source = note(line, Side::Source, line.source, line.source_prints);
        const bool target = note(line, Side::Target, line.target, line.target_prints);
        return source || target;
    }

private:
    bool note(LockedPair& line, Side side, const std::string& id, const Fingerprints& prints) {
        const auto unit = states_[side].find(id);
        std::string& noted = line.macros[side];
        if (counts_declared(noted) || unit == states_[side].end() || unit->second.prints != prints) return false;
        std::string now = macros_[side].of(unit->second.file, unit->second.text);
        const std::string as_noted = counts_keywords(noted) ? without_declared(now) : without_keywords(now);
        if (!noted.empty() && noted != as_noted) return false;  // that is to be told first
        if (noted == now) return false;
        noted = std::move(now);
        return true;
    }

    BySide<WordMacros> macros_;
    const States& states_;
};

}  // namespace

size_t note_macros(LockFile& lock, const BySide<FilesOfSide>& files, const States& states) {
    if (lock.pairs.empty()) return 0;
    MacroNotes notes(files, states);
    size_t count = 0;
    for (LockedPair& line : lock.pairs) count += notes.note(line);
    return count;
}

void note_macros(LockFile& lock, const Judgement& judgement, const std::vector<const JudgedPair*>& accepted,
                 const BySide<FilesOfSide>& files, const States& states) {
    using Two = std::pair<std::string, std::string>;
    std::set<Two> anew;
    std::set<std::string> edits;
    for (const JudgedPair* pair : accepted) {
        anew.insert({pair->id.source, pair->id.target});
        if (!pair->macro_edit.empty()) edits.insert(pair->macro_edit);
    }
    for (const JudgedPair& pair : judgement.pairs)
        if (edits.contains(pair.macro_edit)) anew.insert({pair.id.source, pair.id.target});
    if (anew.empty()) return;
    MacroNotes notes(files, states);
    for (LockedPair& line : lock.pairs) {
        if (!anew.contains(Two{line.source, line.target})) continue;
        line.macros = {};
        notes.note(line);
    }
}

}  // namespace porttool
