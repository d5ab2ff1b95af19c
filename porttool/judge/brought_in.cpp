// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/brought_in.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "porttool/read/lock_lines.h"

namespace porttool {
namespace {

/// How often each suppression stands somewhere; taking one away says whether it was there. One is told by what it says
/// and where it belongs, not by its line, which any edit above it moves.
class Counted {
public:
    explicit Counted(const std::vector<PlacedSuppression>& suppressions) {
        for (const PlacedSuppression& one : suppressions) ++counts_[key_of(one)];
    }
    bool take(const PlacedSuppression& one) {
        const auto found = counts_.find(key_of(one));
        if (found == counts_.end() || found->second == 0) return false;
        --found->second;
        return true;
    }

private:
    std::string key_of(const PlacedSuppression& suppression) {
        const Suppression& comment = suppression.comment;
        Fingerprinter print;
        for (const std::string* part : {&suppression.file, &comment.rule, &comment.reason}) print.add(*part);
        print.add(units_of(comment));
        return print.digits();
    }

    /// Many comments share one list of units, which may be long.
    const std::string& units_of(const Suppression& comment) {
        const auto [known, fresh] = units_.try_emplace(comment.units);
        if (fresh && comment.units != nullptr) {
            Fingerprinter print;
            for (const std::string& unit : *comment.units) print.add(unit);
            known->second = print.digits();
        }
        return known->second;
    }

    std::map<std::string, size_t> counts_;
    std::map<decltype(Suppression::units), std::string> units_;
};

GatePart part_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::Accept:
            return GatePart::Accept;
        case Verdict::Defer:
            return GatePart::Defer;
        case Verdict::Ignore:
            break;
    }
    return GatePart::Ignore;
}

class Comparison {
public:
    Comparison(const GateState& before, const GateState& now, std::string map_name)
        : before_(before), now_(now), map_name_(std::move(map_name)) {}

    std::vector<BroughtIn> run() {
        Counted known(before_.suppressions);
        for (const PlacedSuppression& one : now_.suppressions)
            if (!known.take(one))
                add(GatePart::Suppression, one.file, static_cast<int>(one.comment.line),
                    fmt::format("porttool: ignore({}) {}", one.comment.rule, one.comment.reason));
        compare_locks();
        compare_maps();
        std::sort(out_.begin(), out_.end(), [](const BroughtIn& a, const BroughtIn& b) {
            return std::tie(a.file, a.line, a.kind, a.text) < std::tie(b.file, b.line, b.kind, b.text);
        });
        return std::move(out_);
    }

private:
    static constexpr const char* kLock = "portmap.lock";

    void add(GatePart kind, const std::string& file, int line, const std::string& text) {
        out_.push_back({kind, file, std::max(1, line), text});
    }

    void compare_locks() {
        if (!now_.has_lock && before_.has_lock) add(GatePart::Accept, kLock, 1, "the lock is gone");
        if (!now_.has_lock) return;
        if (!before_.has_lock)
            return add(GatePart::Accept, kLock, 1,
                       fmt::format("the lock is new: {} pairs, {} units in the baseline, {} verdicts",
                                   now_.lock.pairs.size(), now_.lock.baseline.size(), now_.lock.ledger.size()));
        compare_locked_pairs();
        const auto units = [](const LockedUnit& u) { return std::tie(u.side, u.id, u.reason, u.prints.written); };
        for (const LockedUnit* unit : new_ones(before_.lock.baseline, now_.lock.baseline, units))
            add(GatePart::Ignore, kLock, unit->line,
                unit->id + (unit->reason.empty() ? "" : ": " + unit->reason.text()));
        const auto verdicts = [](const LedgerEntry& e) {
            return std::tie(e.verdict, e.source, e.target, e.source_print, e.target_print, e.owner, e.until, e.reason);
        };
        for (const LedgerEntry* entry : new_ones(before_.lock.ledger, now_.lock.ledger, verdicts))
            add(part_of(entry->verdict), kLock, entry->line,
                entry->source + (entry->target.empty() ? "" : " = " + entry->target) + ": " + entry->reason +
                    (entry->verdict == Verdict::Defer ? " (" + entry->owner + ", until " + entry->until + ")" : ""));
        compare_gone_verdicts();
    }

    /// Records that are gone, where the pair was not recorded anew, which is what takes one away.
    void compare_gone_verdicts() {
        const LinesByPair before(before_.lock), now(now_.lock);
        std::set<std::tuple<Verdict, std::string_view, std::string_view>> kept;
        for (const LedgerEntry& entry : now_.lock.ledger) kept.insert({entry.verdict, entry.source, entry.target});
        for (const LedgerEntry& entry : before_.lock.ledger) {
            if (kept.contains({entry.verdict, entry.source, entry.target})) continue;
            const LockedPair *was = before.find(entry.source, entry.target), *is = now.find(entry.source, entry.target);
            const bool anew = was != nullptr && (is == nullptr || was->source_prints != is->source_prints ||
                                                 was->target_prints != is->target_prints);
            if (!anew)
                add(part_of(entry.verdict), kLock, 1,
                    "no longer: " + entry.source + (entry.target.empty() ? "" : " = " + entry.target) + ": " +
                        entry.reason);
        }
    }

    /// Lines of pairs that are new or have changed, and those that are gone while the map still has the pair.
    void compare_locked_pairs() {
        const LinesByPair lines(before_.lock);
        for (const LockedPair& pair : now_.lock.pairs) compare_locked_pair(lines.find(pair.source, pair.target), pair);
        std::set<std::pair<std::string, std::string>> locked;
        for (const LockedPair& pair : now_.lock.pairs) locked.insert({pair.source, pair.target});
        for (const MapPair& pair : now_.map.pairs)
            for (const std::string& target : pair.targets)
                if (lines.find(pair.source, target) != nullptr && !locked.contains({pair.source, target}))
                    add(GatePart::Accept, kLock, 1, "no longer recorded: " + pair.source + " = " + target);
    }

    void compare_locked_pair(const LockedPair* old, const LockedPair& pair) {
        const bool same_texts = old != nullptr && old->source_prints == pair.source_prints &&
                                old->target_prints == pair.target_prints && old->macros == pair.macros;
        const bool by_hand = pair.state == kVerified && pair.by.starts_with(kAcceptedBy);  // as the row says anyway
        const bool same_word = same_texts ? std::tie(old->state, old->by) == std::tie(pair.state, pair.by)
                                          : pair.state == LockedPair().state || by_hand;
        if (same_texts && same_word) return;
        add(GatePart::Accept, kLock, pair.line,
            pair.source + " = " + pair.target +
                (same_word ? "" : ", " + pair.state + (pair.by.empty() ? "" : " by " + pair.by)));
    }

    template <class T, class Key>
    static std::vector<const T*> new_ones(const std::vector<T>& before, const std::vector<T>& now, const Key& key) {
        std::set<decltype(key(now.front()))> known;
        for (const T& one : before) known.insert(key(one));
        std::vector<const T*> out;
        for (const T& one : now)
            if (!known.contains(key(one))) out.push_back(&one);
        return out;
    }

    void compare_maps() {
        if (!before_.has_map) return add(GatePart::Sides, map_name_, 1, "the map is new: " + sides_text(now_.map));
        compare_pairs();
        const auto words = [](const MapIgnore& ignore) { return std::tie(ignore.id, ignore.reason); };
        for (const MapIgnore* ignore : new_ones(before_.map.ignores, now_.map.ignores, words))
            add(GatePart::Ignore, map_name_, ignore->line, ignore->id + ": " + ignore->reason);
        compare_values();
    }

    void compare_pairs() {
        std::map<std::pair<std::string, std::string>, int> gone;
        for (const MapPair& pair : before_.map.pairs)
            for (const std::string& target : pair.targets) gone[{pair.source, target}] = pair.line;
        for (const MapPair& pair : now_.map.pairs)
            for (const std::string& target : pair.targets)
                if (gone.erase({pair.source, target}) == 0)
                    add(GatePart::Pair, map_name_, pair.line, pair.source + " = " + target);
        for (const auto& [pair, line] : gone)
            add(GatePart::Pair, map_name_, 1, "no longer: " + pair.first + " = " + pair.second);
    }

    /// Everything else that stands in the map, whatever it is there for.
    void compare_values() {
        std::map<std::string, MapValue> before = values_of(before_.map);
        for (const auto& [key, value] : values_of(now_.map)) {
            const auto old = before.extract(key);
            if (!old.empty() && old.mapped().text == value.text) continue;
            add(part_of_key(key), map_name_, value.line,
                shown_key(key) + " = " + value.text + (old.empty() ? "" : ", before " + old.mapped().text));
        }
        for (const auto& [key, value] : before)
            add(part_of_key(key), map_name_, 1, "no longer: " + shown_key(key) + " = " + value.text);
    }

    /// With what holds where nothing is said.
    static std::map<std::string, MapValue> values_of(const MapFile& map) {
        std::map<std::string, MapValue> out = map.values;
        out.try_emplace("sides.reference", MapValue{std::string(reference_name(map.reference)), 1});
        return out;
    }
    static GatePart part_of_key(std::string_view key) {
        return key.starts_with("sides.")     ? GatePart::Sides
               : key.starts_with("dialect.") ? GatePart::Dialect
                                             : GatePart::Rule;
    }
    /// Without the section where the kind of row says it.
    static std::string shown_key(const std::string& key) {
        const size_t dot = key.find('.');
        const std::string section = key.substr(0, dot), name = key.substr(std::min(key.size(), dot + 1));
        return section == "sides" || section == "dialect" || section == "rules" ? name : section + " " + name;
    }
    static std::string sides_text(const MapFile& map) {
        std::string out;
        for (const auto& [key, value] : values_of(map))
            if (key.starts_with("sides.")) out += (out.empty() ? "" : "; ") + shown_key(key) + " = " + value.text;
        return out;
    }

    const GateState& before_;
    const GateState& now_;
    std::string map_name_;
    std::vector<BroughtIn> out_;
};

}  // namespace

std::vector<BroughtIn> brought_in(const GateState& before, const GateState& now, const std::string& map_name) {
    return Comparison(before, now, map_name).run();
}

std::vector<PlacedSuppression> known_before(const std::vector<PlacedSuppression>& now,
                                            const std::vector<PlacedSuppression>& before) {
    Counted known(before);
    std::vector<PlacedSuppression> out;
    for (const PlacedSuppression& one : now)
        if (known.take(one)) out.push_back(one);
    return out;
}

}  // namespace porttool
