// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/coincident.h"

#include <algorithm>
#include <bit>

#include "render_system/coincident_bins.h"
#include "render_system/coincident_geometry.h"
#include "render_system/coincident_search.h"

namespace render_system {

void CoincidentSurfaces::find(std::span<const PlacedMesh> scene) {
    pairs_.clear();
    boxes_.clear();
    for (uint32_t i = 0; i < scene.size(); ++i) {
        boxes_.push_back(coincident::box_of(scene[i]));
        coincident::find_copies_within(scene[i], i, pairs_);
    }
    const std::vector<bool> all;
    coincident::find_between_instances(scene, boxes_, all, pairs_);
    std::sort(pairs_.begin(), pairs_.end());
    make_entries(scene, all);
}

void CoincidentSurfaces::follow(std::span<const PlacedMesh> scene, std::span<const uint32_t> changed) {
    std::vector<bool> moved(scene.size(), false);
    for (const uint32_t i : changed) moved[i] = true;
    // Of copies one has stood for all: where one goes the others are to be compared themselves.
    std::vector<bool> wanted = moved;
    for (const CoincidentPair& pair : pairs_) {
        if (!pair.same_corners || !(moved[pair.upper.instance] || moved[pair.lower.instance])) continue;
        wanted[pair.upper.instance] = wanted[pair.lower.instance] = true;
    }
    std::erase_if(pairs_, [&](const CoincidentPair& pair) {
        const bool is_old = wanted[pair.upper.instance] || wanted[pair.lower.instance];
        return is_old && pair.upper.instance != pair.lower.instance;
    });
    for (const uint32_t i : changed) boxes_[i] = coincident::box_of(scene[i]);
    coincident::find_between_instances(scene, boxes_, wanted, pairs_);
    std::sort(pairs_.begin(), pairs_.end());
    make_entries(scene, wanted);
}

// Of instances that have not changed the bins are still right; without any flag all are new.
void CoincidentSurfaces::make_entries(std::span<const PlacedMesh> scene, const std::vector<bool>& changed) {
    struct Lower {
        TriangleName triangle;
        std::vector<TriangleName> lower;
    };
    std::vector<Lower> all;
    for (const CoincidentPair& pair : pairs_) {
        if (all.empty() || all.back().triangle != pair.upper) all.push_back({pair.upper, {}});
        all.back().lower.push_back(pair.lower);
    }
    // What lies in the place of a copy's lowest lies in the copy's as well.
    const auto lower_of = [&](const TriangleName& triangle) -> std::vector<TriangleName>* {
        const auto at = std::lower_bound(all.begin(), all.end(), triangle,
                                         [](const Lower& entry, const TriangleName& t) { return entry.triangle < t; });
        return at != all.end() && at->triangle == triangle ? &at->lower : nullptr;
    };
    for (const CoincidentPair& pair : pairs_) {
        const std::vector<TriangleName>* of_lowest = pair.same_corners ? lower_of(pair.lower) : nullptr;
        if (!of_lowest) continue;
        std::vector<TriangleName>& lower = *lower_of(pair.upper);
        lower.insert(lower.end(), of_lowest->begin(), of_lowest->end());
        std::sort(lower.begin(), lower.end());
        lower.erase(std::unique(lower.begin(), lower.end()), lower.end());
    }
    size_t pairs = 0;
    for (const Lower& entry : all) pairs += entry.lower.size();
    const auto is_changed = [&](const TriangleName& name) { return changed.empty() || changed[name.instance]; };
    std::vector<Entry> before = std::move(entries_);
    entries_.clear();
    auto old = before.begin();
    for (const Lower& entry : all) {
        old = std::find_if(old, before.end(), [&](const Entry& e) { return !(e.triangle < entry.triangle); });
        const bool is_there = old != before.end() && old->triangle == entry.triangle && old->lower == entry.lower;
        if (is_there && !is_changed(entry.triangle) &&
            std::none_of(entry.lower.begin(), entry.lower.end(), is_changed)) {
            entries_.push_back(std::move(*old));
        } else {
            entries_.push_back(coincident::entry_of(scene, entry.triangle, entry.lower, pairs));
        }
    }
}

namespace {

constexpr uint32_t kNothing = ~0u;

// hash_bits and hash_pair of the kernels.
uint32_t hash_bits(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
uint32_t hash_pair(uint32_t a, uint32_t b) { return hash_bits(a ^ (hash_bits(b) + 0x9e3779b9u)); }

// The filter of the kernels' may_share: a word for each key, as layout.h of both cores describes it.
class CoincidentFilter {
public:
    explicit CoincidentFilter(size_t entries) : words_(std::bit_ceil(std::max<size_t>(entries * 2, 4))) {}

    void add(uint32_t key, const CoincidentSurfaces::Entry& entry) {
        uint32_t& word = words_[key & mask()];
        const uint32_t tag = key >> kTagShift;
        const bool is_shared = word != 0 && word >> kTagShift != tag;
        const uint32_t cells = (word | cells_of(entry)) & kTagAny;
        word = (is_shared ? kTagAny : tag) << kTagShift | cells;
    }

    uint32_t mask() const { return static_cast<uint32_t>(words_.size() - 1); }

    void append_to(std::vector<glm::uvec4>& rows) const {
        for (size_t i = 0; i < words_.size(); i += 4) {
            rows.push_back(glm::uvec4(words_[i], words_[i + 1], words_[i + 2], words_[i + 3]));
        }
    }

private:
    static constexpr uint32_t kCells = 4;
    static constexpr uint32_t kTagShift = 16;
    static constexpr uint32_t kTagAny = 0xffff;

    // Sides are powers of two: a part is made of whole bins, or a bin of whole parts.
    static uint32_t cells_of(const CoincidentSurfaces::Entry& entry) {
        const uint32_t bins = std::max(entry.side / kCells, 1u), cells = std::max(kCells / entry.side, 1u);
        uint32_t found = 0;
        for (uint32_t i = 0; i < entry.bins.size(); ++i) {
            if (entry.bins[i].empty()) continue;
            const uint32_t u = i % entry.side / bins * cells, v = i / entry.side / bins * cells;
            for (uint32_t k = 0; k < cells * cells; ++k) found |= 1u << ((v + k / cells) * kCells + u + k % cells);
        }
        return found;
    }

    std::vector<uint32_t> words_;
};

}  // namespace

std::vector<glm::uvec4> pack_coincident(std::span<const CoincidentSurfaces::Entry> entries,
                                        const std::function<CoincidentTriangle(const TriangleName&)>& triangle_of) {
    if (entries.empty()) return {};
    const uint32_t mask = std::bit_ceil(static_cast<uint32_t>(entries.size()) * 2) - 1;
    std::vector<glm::uvec4> rows(size_t{mask} + 2, glm::uvec4(kNothing, 0, 0, 0));
    std::vector<glm::uvec4> partners;
    CoincidentFilter filter(entries.size());
    for (const CoincidentSurfaces::Entry& entry : entries) {
        const uint32_t handle = triangle_of(entry.triangle).handle;
        const uint32_t key = hash_pair(entry.triangle.instance, handle);
        filter.add(key, entry);
        uint32_t place = key & mask;
        while (rows[place + 1].x != kNothing) place = (place + 1) & mask;
        rows[place + 1] = glm::uvec4(entry.triangle.instance, handle, rows.size(), entry.side);
        for (const std::vector<TriangleName>& bin : entry.bins) {
            rows.push_back(glm::uvec4(partners.size(), bin.size(), 0, 0));
            for (const TriangleName& name : bin) {
                const CoincidentTriangle lower = triangle_of(name);
                const auto opacity = std::bit_cast<uint32_t>(lower.opacity);
                partners.push_back(glm::uvec4(name.instance, lower.handle, name.primitive, opacity));
            }
        }
    }
    rows[0] = glm::uvec4(mask, rows.size(), (rows.size() + partners.size()) * 4, filter.mask());
    rows.insert(rows.end(), partners.begin(), partners.end());
    filter.append_to(rows);
    return rows;
}

}  // namespace render_system
