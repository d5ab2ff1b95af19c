// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/judge/words_of_ports.h"

#include <algorithm>
#include <vector>

#include "porttool/compare/laid_edit.h"
#include "porttool/compare/owed_edit.h"
#include "porttool/normal/prelude.h"

namespace porttool {
namespace {

constexpr size_t kShortest = 32, kLongest = 400;  // words of texts whose likeness tells something, and soon

bool is_telling(const UnitState& unit) {
    const bool is_code = unit.kind == UnitKind::Function || unit.kind == UnitKind::Kernel;
    const size_t size = unit.text.words().size();
    return is_code && size >= kShortest && size <= kLongest;
}

}  // namespace

bool WordsOfPorts::are_their_own() {
    constexpr size_t kSample = 24, kFewest = 8;
    if (are_their_own_) return *are_their_own_;
    std::vector<BySide<const UnitState*>> namesakes;
    for (const MapPair& pair : facts_.map.pairs) {
        const auto source = facts_.source.find(pair.source);
        if (source == facts_.source.end() || !is_telling(source->second)) continue;
        for (const std::string& id : pair.targets) {
            const auto target = facts_.target.find(id);
            if (target == facts_.target.end() || !is_telling(target->second)) continue;
            const BySide<const UnitState*> units{&source->second, &target->second};
            if (own_names_.are_one(units)) namesakes.push_back(units);
        }
    }
    const size_t read = std::min(namesakes.size(), kSample);
    size_t alike = 0;
    for (size_t i = 0; i < read; ++i) {
        const auto& [first, second] = namesakes[i * namesakes.size() / read];
        const Words source = without_prelude(first->text.words()), target = without_prelude(second->text.words());
        const LoneTexts texts{source, source, target};
        LaidEdit laid(texts, dialect_);
        alike += are_mostly_alike(laid) ? 1 : 0;
    }
    are_their_own_ = read >= kFewest && 2 * alike < read;
    return *are_their_own_;
}

}  // namespace porttool
