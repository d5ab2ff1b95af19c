// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/base_lock.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <unordered_set>

#include "porttool/judge/first_record.h"
#include "porttool/judge/macro_record.h"
#include "porttool/judge/resolve.h"
#include "porttool/normal/word_macros.h"
#include "porttool/read/lock_lines.h"
#include "porttool/read/lock_upgrade.h"
#include "porttool/scan/scan.h"
#include "porttool/text/sink/terminal.h"

namespace porttool {
namespace {

bool same(const LockedPair& a, const LockedPair& b) {
    return a.source_prints == b.source_prints && a.target_prints == b.target_prints && a.macros == b.macros;
}

const UnitState* find_in(const UnitsById& states, const std::string& id) {
    const auto found = states.find(id);
    return found == states.end() ? nullptr : &found->second;
}

/// The line of today's lock that accepts a pair as it is, if it was written since the base.
const LockedPair* accepted_since(const LinesByPair& then, const LinesByPair& now, const States& today,
                                 const std::string& source, const std::string& target) {
    const LockedPair* line = now.find(source, target);
    if (line == nullptr) return nullptr;
    const LockedPair* old = then.find(source, target);
    if (old != nullptr && same(*old, *line)) return nullptr;
    const UnitState *left = find_in(today.source, source), *right = find_in(today.target, target);
    const bool matches = left != nullptr && right != nullptr && left->prints == line->source_prints &&
                         right->prints == line->target_prints;
    return matches ? line : nullptr;
}

/// What macros make of words and files declare of them, as far as a line says such things.
std::string counted_as(const std::string& line, const std::string& words) {
    if (!counts_keywords(line)) return without_keywords(words);
    return counts_declared(line) ? words : without_declared(words);
}

/// Lines of the base that do not say what macros there were, or say it without keywords, say it as far as today's lines
/// do: then these differ by what was done to macros since, not by having been noted.
void note_macros_as_today(LockFile& then, const LockFile& now, const Snapshot& base) {
    const LinesByPair lines(now);
    LockFile noted = then;
    if (note_macros(noted, base.files(), base.states) == 0) return;
    for (size_t i = 0; i < then.pairs.size(); ++i) {
        const LockedPair* line = lines.find(then.pairs[i].source, then.pairs[i].target);
        for (const Side side : kBothSides)
            if (line != nullptr && !line->macros[side].empty())
                then.pairs[i].macros[side] = counted_as(line->macros[side], noted.pairs[i].macros[side]);
    }
}

using TextOf = std::function<NormalText(Print)>;

/// True for an id of which nobody knows what it was at the base: its file, or a folder around it, cannot be read there.
bool is_unknown(const Snapshot& base, Side side, const std::string& id) {
    const std::string file = split_id(id).first;
    const std::set<std::string>& unknown = base.unknown[side];
    for (size_t end = file.find('/'); !unknown.empty() && end != std::string::npos; end = file.find('/', end + 1))
        if (unknown.contains(file.substr(0, end))) return true;
    return unknown.contains(file) || unknown.contains("");
}

/// A unit that cannot be read at the base, and that no lock knows, cannot be held against anything.
CannotDo nothing_to_hold(const Snapshot& base, const std::string& id) {
    return CannotDo("--base " + terminal_text(base.at.revision) + ": what " + terminal_text(id) +
                    " was there cannot be read, and portmap.lock does not have its pair: a submodule that is not "
                    "checked out, a link that leads elsewhere, or a file that is no text\nFetch it (git submodule "
                    "update --init), or record the pair with: porttool accept --all");
}

/// What ids of a map that are stale, at the base as well as today, had become at the base.
class StaleIds {
public:
    StaleIds(const Snapshot& base, const LinesByPair& now, const States& today, const TextOf& text_of) {
        for (const Side side : kBothSides) {
            std::vector<NamedUnit> named;
            bool any = false;
            for (const MapPair& pair : base.project.map.pairs)
                for (const std::string& target : pair.targets) {
                    const std::string& id = side == Side::Source ? pair.source : target;
                    const LockedPair* line = now.find(pair.source, target);
                    const Fingerprints* prints = line == nullptr        ? nullptr
                                                 : side == Side::Source ? &line->source_prints
                                                                        : &line->target_prints;
                    named.push_back({id, prints});
                    if (find_in(base.states[side], id) != nullptr || find_in(today[side], id) != nullptr) continue;
                    if (is_unknown(base, side, id)) continue;
                    stale_[side].insert(id);
                    any = true;
                }
            if (any) found_[side].emplace(base.states[side], named, text_of);
        }
    }

    bool contains(Side side, const std::string& id) const { return stale_[side].contains(id); }

    const UnitState* find(Side side, const std::string& id) const {
        return contains(side, id) ? found_[side]->find(id).unit : nullptr;
    }

private:
    BySide<std::set<std::string>> stale_;
    BySide<std::optional<Resolver>> found_;
};

/// What no pair led to at the base, and what today's lock says of such units beyond that.
void add_baseline(LockFile& out, const Snapshot& base, const LockFile& now) {
    const MapFile& map = base.project.map;
    const TargetSets sets(map);
    const auto paired = paired_units(map, sets);
    BySide<std::vector<LockedUnit>> then;  // each sorted by id
    for (const Side side : kBothSides)
        if (is_contract(map.reference, side)) then[side] = baseline_of(base.states[side], side, paired[side], sets);
    const auto is_said = [&](const LockedUnit& line) {
        if (!line.reason.empty() || !line.more.empty()) return false;
        const auto& lines = then[line.side == side_word(Side::Source) ? Side::Source : Side::Target];
        const auto by_id = [](const LockedUnit& one, const std::string& id) { return one.id < id; };
        const auto known = std::lower_bound(lines.begin(), lines.end(), line.id, by_id);
        return known != lines.end() && known->id == line.id && known->side == line.side && known->more.empty() &&
               known->prints == line.prints;
    };
    std::vector<LockedUnit> more;
    std::copy_if(now.baseline.begin(), now.baseline.end(), std::back_inserter(more), std::not_fn(is_said));
    out.baseline = std::move(then.source);
    for (std::vector<LockedUnit>* lines : {&then.target, &more})
        out.baseline.insert(out.baseline.end(), std::make_move_iterator(lines->begin()),
                            std::make_move_iterator(lines->end()));
}

/// The texts that may be asked for: behind the prints of the lock, and of units that are another now.
std::map<Print, UnitText> texts_for(const LockFile& lock, const States& then, const States& today) {
    std::unordered_set<uint64_t> named;
    for (const LockedPair& pair : lock.pairs)
        named.insert({pair.source_prints.written.bits(), pair.target_prints.written.bits()});
    for (const LedgerEntry& entry : lock.ledger) named.insert({entry.source_print.bits(), entry.target_print.bits()});
    std::map<Print, UnitText> out;
    const auto add = [&](const UnitState& state) { out.emplace(state.prints.written, state.text); };
    for (const Side side : kBothSides) {
        for (const auto& [id, state] : then[side]) {
            const UnitState* now = find_in(today[side], id);
            const bool is_same = now != nullptr && now->prints.written == state.prints.written;
            if (!is_same || named.contains(state.prints.written.bits())) add(state);
        }
        for (const auto& [id, state] : today[side])
            if (named.contains(state.prints.written.bits())) add(state);
    }
    return out;
}

}  // namespace

BaseRecord base_record(Snapshot& base, const RecordedLock& now, const States& today, std::ostream& err) {
    BaseRecord out;
    const Project& project = base.project;
    if (const FileText text = map_text_of(base); text.error.empty()) {
        const std::string name = map_in_commits(project) + " at " + base.at.revision;
        ReadMap read = text.bytes == project.map_text ? ReadMap{project.map, ""} : read_map(name, text.bytes);
        out.has_map = read.error.empty();
        out.map = std::move(read.map);
        if (!out.has_map) err << "warning: " << read.error << "\nThat map is left out\n";
    }
    const FileText text = base.git.read(beside_map(project, "portmap.lock"), kLargestFile);
    base.git.files.erase(lock_path(project));  // of many units it is large
    if (!text.error.empty()) return out;
    if (text.bytes == now.written) {
        out.has_lock = true;
        return out;
    }
    try {
        ReadLock read = read_lock(text.bytes);
        if (is_outdated(read.lock)) read_base_texts(base);  // only then are they needed
        out.changed_lock = lock_of_today(project, base.git, std::move(read), today).lock;
        note_macros_as_today(*out.changed_lock, now.lock, base);
        out.has_lock = true;
    } catch (const CannotDo& problem) {
        err << "warning: at " << terminal_text(base.at.revision) << ": " << problem.what()
            << "\nThat lock is left out\n";
    }
    return out;
}

BaseLock base_lock(const Snapshot& base, const LockFile& then, const LockFile& now, const States& today,
                   const TextOf& text_of) {
    BaseLock out;
    const LinesByPair lines_then(then), lines_now(now);
    const StaleIds stale(base, lines_now, today, text_of);
    size_t pairs = 0;
    for (const MapPair& pair : base.project.map.pairs) pairs += pair.targets.size();
    out.lock.pairs.reserve(pairs);
    for (const MapPair& pair : base.project.map.pairs) {
        for (const std::string& target : pair.targets) {
            if (const LockedPair* line = accepted_since(lines_then, lines_now, today, pair.source, target)) {
                out.lock.pairs.push_back(*line);
                continue;
            }
            const UnitState* left = find_in(base.states.source, pair.source);
            const UnitState* right = find_in(base.states.target, target);
            if (left == nullptr) left = stale.find(Side::Source, pair.source);
            if (right == nullptr) right = stale.find(Side::Target, target);
            const bool is_gone = (left == nullptr && stale.contains(Side::Source, pair.source)) ||
                                 (right == nullptr && stale.contains(Side::Target, target));
            const bool was_recorded = then.pairs.empty() || lines_then.find(pair.source, target) != nullptr;
            if (is_gone && was_recorded) out.gone_before.emplace(pair.source, target);
            if (left == nullptr || right == nullptr) {  // the pair is new since the base
                if (const LockedPair* line = lines_now.find(pair.source, target)) {
                    out.lock.pairs.push_back(*line);
                    continue;
                }
                if (left == nullptr && is_unknown(base, Side::Source, pair.source))
                    throw nothing_to_hold(base, pair.source);
                if (right == nullptr && is_unknown(base, Side::Target, target)) throw nothing_to_hold(base, target);
                left = find_in(today.source, pair.source);  // nothing to hold it against
                right = find_in(today.target, target);
            }
            if (left != nullptr && right != nullptr)
                out.lock.pairs.push_back({pair.source, target, left->prints, right->prints});
        }
    }
    note_macros(out.lock, base.files(), base.states);
    add_baseline(out.lock, base, now);
    out.lock.ledger = now.ledger;
    out.texts = texts_for(out.lock, base.states, today);
    return out;
}

}  // namespace porttool
