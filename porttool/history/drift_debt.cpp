// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/history/drift_debt.h"

#include <algorithm>

namespace porttool {
namespace {

constexpr double kAlike = 0.5;  // between edits of true ports (0.78) and of strangers (0.12)

}  // namespace

double OpenPair::debt(int64_t now) const {
    constexpr double kSecondsOfDay = 86400;
    return std::max(0.0, static_cast<double>(now - since)) / kSecondsOfDay * lines;
}

void DriftReplay::update(const PairId& id, const PairNow& now, int64_t time) {
    if (now.source == nullptr || now.target == nullptr) {
        const bool was_paired = bases_.contains(id) || now.locked_target != nullptr;
        if (now.source == nullptr || !was_paired || now.ignored) {
            open_.erase(id);
            return;
        }
        OpenPair& gone = open_.try_emplace(id, OpenPair{id, time, 0}).first->second;
        gone.lines = std::max({gone.lines, now.source->lines, 1u});  // all of it is to be ported again
        return;
    }
    const bool locked = now.locked_source != nullptr && now.locked_target != nullptr;
    const BySide<const UnitFacts*> units{now.source, now.target};
    auto& base = bases_.try_emplace(id, BySide<Fingerprints>{now.source->prints, now.target->prints}).first->second;
    if (locked) base = {*now.locked_source, *now.locked_target};
    const auto changed = [&](Side side) { return is_edit(classify(base[side], units[side]->prints)); };
    bool in_step = !changed(Side::Source) && !changed(Side::Target);
    EditFacts edits;
    if (!in_step) {
        edits = compare_(id, base, units);
        const bool followed = !locked && changed(Side::Source) && changed(Side::Target) && edits.similarity >= kAlike;
        in_step = (edits.in_step && !edits.refused) || followed;
    }
    if (in_step && !locked) base = {now.source->prints, now.target->prints};
    if (in_step || now.ignored) {
        open_.erase(id);
        return;
    }
    OpenPair& pair = open_.try_emplace(id, OpenPair{id, time, 0}).first->second;
    pair.lines = std::max({edits.source_size, edits.target_size, 1u});
}

void DriftReplay::forget(const PairId& id) {
    bases_.erase(id);
    open_.erase(id);
}

std::vector<OpenPair> DriftReplay::open() const {
    std::vector<OpenPair> out;
    for (const auto& [id, pair] : open_) out.push_back(pair);
    return out;
}

double DriftReplay::debt(int64_t now) const {
    double sum = 0;
    for (const auto& [id, pair] : open_) sum += pair.debt(now);
    return sum;
}

}  // namespace porttool
