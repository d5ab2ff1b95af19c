// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/other_parts.h"

#include <algorithm>

#include "porttool/compare/paired_names.h"
#include "porttool/normal/prelude.h"

namespace porttool {

OtherParts::OtherParts(const Case& facts, const BySide<RenamedNames>& renamed, Side side)
    : facts_(facts), renamed_(renamed), side_(side) {}

/// The text when last in step, or none where it is not known.
NormalText OtherParts::text_before(const MappedPair& pair, Side side) const {
    const UnitState* unit = pair.units[side].unit;
    const Fingerprints& then = pair.recorded(side);
    if (unit != nullptr && unit->prints.written == then.written) return unit->text;
    return renamed_[side].updated(facts_.base_text(then.written));
}

std::vector<EditOfParts> OtherParts::look(const std::vector<const MappedPair*>& pairs) const {
    std::vector<EditOfParts> out(pairs.size());
    const NormalText port = text_before(*pairs.front(), side_);
    std::vector<NormalText> texts;
    std::vector<Words> originals;
    for (const MappedPair* pair : pairs) texts.push_back(text_before(*pair, other(side_)));
    for (const NormalText& text : texts) originals.push_back(without_prelude(text.words()));
    const bool is_known =
        !port.empty() && std::none_of(texts.begin(), texts.end(), [](const NormalText& text) { return text.empty(); });
    if (!is_known || pairs.size() < 2) return out;
    const PartsOfPort parts(without_prelude(port.words()), originals, dialect_of_edits(facts_.map));
    if (!parts.any()) return out;
    const ReachedParts reached = parts.reached(without_prelude(pairs.front()->units[side_].unit->text.words()));
    if (reached.surely.empty()) return out;
    for (size_t i = 0; i < pairs.size(); ++i) {
        for (const size_t k : reached.surely) out[i].owners.push_back(pairs[k]);
        if (reached.surely.contains(i) || reached.perhaps.contains(i)) continue;
        out[i].owner = out[i].owners.front();
        out[i].kind = parts.has_part(i) && !reached.elsewhere ? EditOfParts::OfOthers : EditOfParts::PerhapsNot;
    }
    return out;
}

const EditOfParts& OtherParts::edit_of(const MappedPair& pair, const std::vector<const MappedPair*>& pairs) {
    if (!known_.contains(&pair)) {
        std::vector<EditOfParts> all = look(pairs);
        for (size_t i = 0; i < pairs.size(); ++i) known_[pairs[i]] = std::move(all[i]);
    }
    return known_[&pair];
}

}  // namespace porttool
