// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/name_follower.h"

#include <algorithm>
#include <optional>

#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/file_text.h"

namespace porttool {
namespace {

std::string name_in_id(const std::string& id) {
    return std::string(bare_leaf_of(std::string_view(id).substr(id.find(':') + 1)));
}

bool is_picked_there(const LexedText& lexed, uint32_t i) {
    return i > 0 && is_one_of(lexed.view(i - 1), {".", "->", "::"});
}

bool is_local_of_any(const ScannedFile& file, const std::string& name) {
    return std::any_of(file.units.begin(), file.units.end(), [&](const Unit& unit) {
        if (unit.kind != UnitKind::Function && unit.kind != UnitKind::Kernel) return false;
        const std::vector<std::string> names = local_names(file, unit);
        return std::find(names.begin(), names.end(), name) != names.end();
    });
}

}  // namespace

NameFollower::NameFollower(const CheckedProject& checked, Knowledge& knowledge, Drafts& drafts)
    : checked_(checked), knowledge_(knowledge), drafts_(drafts) {
    for (const JudgedPair& pair : checked.judgement.pairs) {
        if (pair.unit.source == nullptr || pair.unit.target == nullptr) continue;
        for (const Side side : kBothSides) {
            const UnitState &unit = *pair.unit[side], &port = *pair.unit[other_side(side)];
            const bool is_function = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
            std::string old = name_in_id(pair.id[side]), now(bare_leaf_of(unit.name));
            if (is_function && old != now && old == bare_leaf_of(port.name))
                renamed_[side].push_back({&pair, std::move(old), std::move(now)});
        }
    }
}

void NameFollower::note(const JudgedPair& pair, Side from) {
    const Words words = pair.unit[from]->text.words(), port = pair.unit[other_side(from)]->text.words();
    const auto has = [](const Words& text, const std::string& word) {
        return std::find(text.begin(), text.end(), word) != text.end();
    };
    Wish wish{&pair, from, {}};
    for (const Name& name : renamed_[from])
        if (has(words, name.now) && has(port, name.old)) wish.names.insert(name);
    if (!wish.names.empty()) wishes_.push_back(std::move(wish));
}

void NameFollower::run(std::vector<Proposal>& proposals) {
    for (const Wish& wish : wishes_) {
        const auto own = std::find_if(proposals.begin(), proposals.end(),
                                      [&](const Proposal& one) { return one.id == wish.pair->id; });
        if (own == proposals.end() || own->state != ProposalState::Already) continue;
        drafts_.begin();
        bool any = false;
        for (const Name& name : wish.names) any |= follow(name, other_side(wish.from));
        if (!any) continue;
        own->state = ProposalState::Proposed;
        own->why.clear();
        own->is_elsewhere = wish.from == Side::Source && target_root(checked_.project) != checked_.project.root;
        own->patch = drafts_.patch();
        own->comes_last = true;
    }
}

/// False where the port uses the old name in more files, for something else, or has the new one already.
bool NameFollower::follow(const Name& name, Side to) {
    const UnitState& port = *name.pair->unit[to];
    const ScannedFile* file = knowledge_.file_of(to, port.file);
    if (file == nullptr) return false;
    Draft& draft = drafts_.of(to, *file);
    const LexedText& lexed = draft.scanned.lexed;
    if (draft.is_linked || draft.unit(port.id) == nullptr || is_local_of_any(draft.scanned, name.old)) return false;
    for (const ScannedFile& other : knowledge_.files(to))
        if (has_word(to, other.path, name.now) || (other.path != port.file && has_word(to, other.path, name.old)))
            return false;
    for (const ScannedFile& other : knowledge_.files(other_side(to)))
        if (has_word(other_side(to), other.path, name.old)) return false;
    std::vector<TextEdit> edits;
    for (uint32_t i = 0; i < lexed.tokens.size(); ++i) {
        if (lexed.view(i) != name.old) continue;
        if (is_picked_there(lexed, i)) return false;
        const Token& token = lexed.tokens[i];
        edits.push_back({token.offset, token.offset + token.length, name.now});
    }
    const std::optional<std::string> now = edit_file(draft.bytes, lexed.text, edits);
    if (!now) return false;
    ScannedFile scanned = scan_text(draft.scanned.path, *now);
    if (scanned.units.size() != draft.scanned.units.size()) return false;
    drafts_.write(draft, *now, std::move(scanned));
    return true;
}

/// As the patches so far have left it.
bool NameFollower::has_word(Side side, const std::string& path, const std::string& word) const {
    const Draft* draft = drafts_.find(side, path);
    const ScannedFile* file = draft == nullptr ? knowledge_.file_of(side, path) : &draft->scanned;
    if (file == nullptr || file->lexed.text.find(word) == std::string::npos) return false;
    const std::vector<Token>& tokens = file->lexed.tokens;
    return std::any_of(tokens.begin(), tokens.end(),
                       [&](const Token& token) { return file->lexed.view(token) == word; });
}

}  // namespace porttool
