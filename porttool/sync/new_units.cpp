// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/sync/new_units.h"

#include <algorithm>

#include "porttool/judge/settle.h"
#include "porttool/normal/unit_state.h"
#include "porttool/scan/scan.h"
#include "porttool/sync/unit_place.h"

namespace porttool {

const std::map<std::string, std::vector<const UnitState*>, std::less<>>& NewUnits::fresh_units(Side from) const {
    auto& out = fresh_[from];
    if (fresh_read_[from]) return out;
    fresh_read_[from] = true;
    std::set<std::string_view> seen;
    for (const Finding& finding : checked_.judgement.findings) {
        if (!is_of_new_unit(finding) || finding.side != from) continue;
        const auto unit = checked_.states[from].find(finding.map_source);
        if (unit != checked_.states[from].end() && seen.insert(unit->first).second)
            out[std::string(bare_leaf_of(unit->second.name))].push_back(&unit->second);
    }
    if (!is_contract(checked_.judgement.reference, from)) find_since_commit(from, out);
    return out;
}

/// No baseline says what is new on the side that is not the contract: what the commit before does not have is.
void NewUnits::find_since_commit(Side from,
                                 std::map<std::string, std::vector<const UnitState*>, std::less<>>& out) const {
    std::set<std::string> paired;
    for (const JudgedPair& pair : checked_.judgement.pairs)
        if (pair.unit[from] != nullptr) paired.insert(pair.unit[from]->id);
    std::set<std::string> wanted;
    for (const auto& [id, state] : checked_.states[from])
        if (!paired.contains(id) && state.kind != UnitKind::File) wanted.insert(state.file);
    std::map<std::string, std::set<std::string>> old;
    for (const auto& [path, text] : earlier_files_.read(from, wanted)) {
        const ScannedFile scanned = scan_text(path, text);
        for (const Unit& unit : scanned.units) old[path].insert(unit_id(scanned, unit));
    }
    for (const auto& [id, state] : checked_.states[from])
        if (!paired.contains(id) && old.contains(state.file) && !old.at(state.file).contains(id))
            out[std::string(bare_leaf_of(state.name))].push_back(&state);
}

void NewUnits::port(const std::vector<std::string>& words, const JudgedPair& user, Side from,
                    const std::set<std::string>& excluded) {
    if (!excluded.empty())
        earlier_.merge(reasons_);
    else
        earlier_.clear();
    reasons_.clear();
    usable_.clear();
    excluded_ = excluded;
    const auto& fresh = fresh_units(from);
    if (fresh.empty()) return;
    std::set<std::string> open;
    for (const std::string& word : words) {
        if (!fresh.contains(word) || reasons_.contains(word) || usable_.contains(word)) continue;
        if (std::string why = port_one(word, user, from, open); !why.empty()) reasons_[word] = std::move(why);
    }
}

std::map<std::string, std::string, std::less<>> NewUnits::unported(Side from) const {
    std::map<std::string, std::string, std::less<>> out;
    for (const auto& [name, units] : fresh_units(from)) {
        if (usable_.contains(name)) continue;
        const auto first = earlier_.find(name), why = reasons_.find(name);
        if (first != earlier_.end())
            out[name] = first->second;
        else
            out[name] = why == reasons_.end() ? std::string() : why->second;
    }
    return out;
}

std::string NewUnits::still_alone(Side from) const {
    for (const auto& [name, units] : fresh_units(from)) {
        const auto is_it = [&, wanted = &name](const Made& made) { return made.from == from && made.name == *wanted; };
        if (std::none_of(made_.begin(), made_.end(), is_it)) return name;
    }
    return {};
}

std::set<std::string, std::less<>> NewUnits::brought() const {
    std::set<std::string, std::less<>> out = brought_;
    for (const Made& made : made_)
        if (usable_.contains(made.name)) out.insert(made.fields.begin(), made.fields.end());
    return out;
}

bool NewUnits::can_be_used(const Made& made, const JudgedPair& user) {
    const Side to = other_side(made.from);
    const ScannedFile* port = knowledge_.file_of(to, made.port().file);
    const ScannedFile* file = knowledge_.file_of(to, user.unit[to]->file);
    if (port == nullptr || file == nullptr) return false;
    if (port != file) return includes(knowledge_.files(to), *file, *port);
    const ScannedFile& now = drafts_.of(to, *file).scanned;
    const Unit *helper = unit_named(now, made.port().id), *own = unit_named(now, user.unit[to]->id);
    return helper != nullptr && own != nullptr && helper->tokens.first < own->tokens.first;
}

void NewUnits::tell_knowledge() {
    std::vector<Knowledge::FreshIds> ids;
    for (const Made& made : made_) ids.push_back({made.from, {made.pair.source.id, made.pair.target.id}});
    knowledge_.set_fresh(ids);
}

void NewUnits::take_back(size_t count) {
    if (made_.size() == count) return;
    made_.erase(made_.begin() + static_cast<std::ptrdiff_t>(count), made_.end());
    tell_knowledge();
}

std::set<std::string> NewUnits::unused(size_t first, const std::vector<std::string>& words) const {
    std::set<std::string> out;
    for (size_t i = first; i < made_.size(); ++i) out.insert(made_[i].name);
    // One uses only those before it.
    for (size_t i = made_.size(); i-- > first;) {
        const Made& made = made_[i];
        const bool in_port = std::find(words.begin(), words.end(), made.port_name) != words.end();
        if (in_port) out.erase(made.name);
        if (!out.contains(made.name))
            for (const std::string& used : made.uses) out.erase(used);
    }
    return out;
}

std::vector<std::string> NewUnits::told(size_t first) const {
    std::vector<std::string> out;
    for (size_t i = first; i < made_.size(); ++i)
        out.push_back("`" + made_[i].unit().id + "` came without a port, and " +
                      (made_[i].is_twin ? "is what the port has as `" : "gets `") + made_[i].port().id + "`");
    return out;
}

}  // namespace porttool
