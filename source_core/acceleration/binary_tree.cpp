// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "source_core/acceleration/binary_tree.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <future>
#include <limits>
#include <span>
#include <thread>

namespace source_core {

namespace {

using Lanes = float __attribute__((vector_size(16)));  // x, y, z and a fourth, which is zero
using Words = int32_t __attribute__((vector_size(16)));

constexpr uint32_t LARGEST_LEAF = 4;
constexpr uint32_t BINS = 16;
constexpr float NODE_COST = 2.0f;        // against a triangle test; higher makes fewer, fuller leaves, no slower
constexpr size_t PARALLEL_RANGE = 8192;  // primitives below which a thread of its own is not worth it
constexpr size_t TWO_HALVES = 256;       // primitives from which two sets of bins pay
constexpr float LARGEST = std::numeric_limits<float>::max();

struct Bounds {
    Lanes lower{LARGEST, LARGEST, LARGEST, LARGEST};
    Lanes upper{-LARGEST, -LARGEST, -LARGEST, -LARGEST};

    void include(Lanes low, Lanes high) {
        lower = low < lower ? low : lower;
        upper = high > upper ? high : upper;
    }
    float half_area() const {
        const Lanes size = upper - lower;
        return size[0] < 0.0f ? 0.0f : size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
    }
};

static_assert(sizeof(BuildPrimitive) == 2 * sizeof(Lanes));

// The fourth float of a primitive is a number; as a float it would be denormal, and each product with it a hundred
// times as slow.
Lanes without_fourth(Words words) { return reinterpret_cast<Lanes>(words & Words{-1, -1, -1, 0}); }

Lanes load_lower(const BuildPrimitive& primitive) {
    Words words;
    std::memcpy(&words, &primitive, sizeof(words));
    return without_fourth(words);
}

Lanes load_upper(const BuildPrimitive& primitive) {
    Words words;
    std::memcpy(&words, reinterpret_cast<const char*>(&primitive) + sizeof(words), sizeof(words));
    return without_fourth(words);
}

Lanes centre(const BuildPrimitive& primitive) { return load_lower(primitive) * 0.5f + load_upper(primitive) * 0.5f; }

// What a range of primitives needs before it can be split.
struct RangeBounds {
    Bounds boxes;
    Bounds centres;
    bool some_alone = false;

    void include(const BuildPrimitive& primitive) {
        boxes.include(load_lower(primitive), load_upper(primitive));
        const Lanes middle = centre(primitive);
        centres.include(middle, middle);
        some_alone |= primitive.alone != 0;
    }
};

struct Split {
    int axis = -1;     // -1: none
    uint32_t bin = 0;  // first bin of the right side
    float cost = LARGEST;
    Bounds left;  // boxes of the two sides
    Bounds right;
};

// How centres map to bins. Small ranges get few: their bins would be empty.
struct BinScale {
    Lanes origin;
    Lanes scale;
    Lanes last;  // bin
    uint32_t count;

    /// One bin for each axis.
    Words bins(Lanes middle) const {
        const Lanes position = (middle - origin) * scale;
        return __builtin_convertvector(position < last ? position : last, Words);
    }
};

BinScale make_scale(const Bounds& centres, size_t range) {
    BinScale result{centres.lower, {}, {}, static_cast<uint32_t>(std::min<size_t>(BINS, 4 + range / 8))};
    result.last += static_cast<float>(result.count - 1);
    for (int axis = 0; axis < 3; ++axis) {
        const float extent = centres.upper[axis] - centres.lower[axis];
        const float scale = static_cast<float>(result.count) / extent;
        result.scale[axis] = extent > 0.0f && scale < LARGEST ? scale : 0.0f;
    }
    return result;
}

struct Bin {
    Bounds bounds;
    uint32_t count = 0;

    void include(Lanes lower, Lanes upper, uint32_t primitives) {
        bounds.include(lower, upper);
        count += primitives;
    }
};

struct Bins {
    Bin bins[3][BINS];

    void include(const BuildPrimitive& primitive, const BinScale& scale) {
        const Lanes lower = load_lower(primitive);
        const Lanes upper = load_upper(primitive);
        const Words bin = scale.bins(centre(primitive));
        bins[0][bin[0]].include(lower, upper, 1);
        bins[1][bin[1]].include(lower, upper, 1);
        bins[2][bin[2]].include(lower, upper, 1);
    }
    void include(const Bins& other, uint32_t count) {
        for (int axis = 0; axis < 3; ++axis) {
            for (uint32_t i = 0; i < count; ++i) {
                const Bin& bin = other.bins[axis][i];
                bins[axis][i].include(bin.bounds.lower, bin.bounds.upper, bin.count);
            }
        }
    }
};

// Neighbours in the range mostly fall into the same bin, and each would wait for the one before it to be stored: two
// halves of the range are taken in turn.
void fill(Bins& bins, const BinScale& scale, std::span<const BuildPrimitive> range) {
    const size_t half = range.size() < TWO_HALVES ? 0 : range.size() / 2;
    if (half > 0) {
        Bins others;
        for (size_t i = 0; i < half; ++i) {
            bins.include(range[i], scale);
            others.include(range[half + i], scale);
        }
        bins.include(others, scale.count);
    }
    for (size_t i = 2 * half; i < range.size(); ++i) {
        bins.include(range[i], scale);
    }
}

void sweep_axis(const Bin* bins, uint32_t bin_count, int axis, Split& best) {
    float right_cost[BINS];
    Bounds rights[BINS];
    Bounds right;
    uint32_t count = 0;
    for (uint32_t bin = bin_count - 1; bin > 0; --bin) {
        right.include(bins[bin].bounds.lower, bins[bin].bounds.upper);
        count += bins[bin].count;
        rights[bin] = right;
        right_cost[bin] = count == 0 ? LARGEST : right.half_area() * static_cast<float>(count);
    }
    Bounds left;
    count = 0;
    for (uint32_t bin = 1; bin < bin_count; ++bin) {
        left.include(bins[bin - 1].bounds.lower, bins[bin - 1].bounds.upper);
        count += bins[bin - 1].count;
        if (count == 0 || right_cost[bin] == LARGEST) {
            continue;
        }
        const float cost = left.half_area() * static_cast<float>(count) + right_cost[bin];
        if (cost < best.cost) {
            best = {axis, bin, cost, left, rights[bin]};
        }
    }
}

// Not inlined: its bins would lie on the stack of every level of the recursion.
[[gnu::noinline]] Split find_split(const BinScale& scale, std::span<const BuildPrimitive> range) {
    Bins bins;
    fill(bins, scale, range);
    Split best;
    for (int axis = 0; axis < 3; ++axis) {
        if (scale.scale[axis] > 0.0f) {
            sweep_axis(bins.bins[axis], scale.count, axis, best);
        }
    }
    return best;
}

// The two parts of a range; an empty left part makes a leaf.
struct Parts {
    size_t left_count = 0;
    RangeBounds left;
    RangeBounds right;
};

Parts partition(std::span<BuildPrimitive> range, const BinScale& scale, const Split& split) {
    Parts parts;
    parts.left.boxes = split.left;
    parts.right.boxes = split.right;
    const auto first_right_bin = static_cast<int32_t>(split.bin);
    size_t left = 0;
    size_t right = range.size();
    while (left < right) {
        const Lanes middle = centre(range[left]);
        const bool alone = range[left].alone != 0;
        if (scale.bins(middle)[split.axis] < first_right_bin) {
            parts.left.centres.include(middle, middle);
            parts.left.some_alone |= alone;
            ++left;
        } else {
            parts.right.centres.include(middle, middle);
            parts.right.some_alone |= alone;
            std::swap(range[left], range[--right]);
        }
    }
    parts.left_count = left;
    return parts;
}

Parts halve(std::span<BuildPrimitive> range, const Bounds& centres) {
    const Lanes extent = centres.upper - centres.lower;
    int axis = extent[1] > extent[0] ? 1 : 0;
    axis = extent[2] > extent[axis] ? 2 : axis;
    const auto middle = range.begin() + static_cast<std::ptrdiff_t>(range.size() / 2);
    std::nth_element(range.begin(), middle, range.end(), [axis](const BuildPrimitive& a, const BuildPrimitive& b) {
        const float centre_a = centre(a)[axis];
        const float centre_b = centre(b)[axis];
        return centre_a < centre_b || (centre_a == centre_b && a.id < b.id);
    });
    Parts parts;
    parts.left_count = range.size() / 2;
    for (size_t i = 0; i < range.size(); ++i) {
        (i < parts.left_count ? parts.left : parts.right).include(range[i]);
    }
    return parts;
}

class Builder {
public:
    Builder(std::vector<BuildPrimitive>& primitives, uint32_t threads, uint32_t median_depth)
        : primitives_(primitives), nodes_(2 * primitives.size()), median_depth_(median_depth) {
        const uint32_t all = std::max(1u, std::thread::hardware_concurrency());
        spare_threads_ = static_cast<int>(threads == 0 ? all : threads) - 1;
    }

    std::vector<BinaryNode> build() {
        RangeBounds bounds;
        for (const BuildPrimitive& primitive : primitives_) {
            bounds.include(primitive);
        }
        build_range(0, 0, primitives_.size(), bounds, 0);
        nodes_.resize(next_node_);
        return std::move(nodes_);
    }

private:
    void build_range(uint32_t node, size_t begin, size_t end, const RangeBounds& bounds, uint32_t depth) {
        const std::span<BuildPrimitive> range(primitives_.data() + begin, end - begin);
        BinaryNode& result = nodes_[node];
        result.lower = {bounds.boxes.lower[0], bounds.boxes.lower[1], bounds.boxes.lower[2]};
        result.upper = {bounds.boxes.upper[0], bounds.boxes.upper[1], bounds.boxes.upper[2]};
        const Parts parts = split(range, bounds, depth);
        if (parts.left_count == 0) {
            result.first = static_cast<uint32_t>(begin);
            result.count = static_cast<uint32_t>(range.size());
            return;
        }
        const uint32_t left = next_node_.fetch_add(2);
        result.first = left;
        result.count = 0;
        const size_t middle = begin + parts.left_count;
        const bool large = std::min(middle - begin, end - middle) >= PARALLEL_RANGE;
        if (large && take_thread()) {
            auto other =
                std::async(std::launch::async, [=, this] { build_range(left, begin, middle, parts.left, depth + 1); });
            build_range(left + 1, middle, end, parts.right, depth + 1);
            other.get();
            spare_threads_.fetch_add(1);
            return;
        }
        build_range(left, begin, middle, parts.left, depth + 1);
        build_range(left + 1, middle, end, parts.right, depth + 1);
    }

    bool take_thread() {
        if (spare_threads_.fetch_sub(1) > 0) {
            return true;
        }
        spare_threads_.fetch_add(1);
        return false;
    }

    Parts split(std::span<BuildPrimitive> range, const RangeBounds& bounds, uint32_t depth) const {
        const bool may_be_leaf = range.size() == 1 || (range.size() <= LARGEST_LEAF && !bounds.some_alone);
        if (range.size() == 1 || (may_be_leaf && depth >= median_depth_)) {
            return {};
        }
        if (depth >= median_depth_) {
            return halve(range, bounds.centres);
        }
        const BinScale scale = make_scale(bounds.centres, range.size());
        const Split best = find_split(scale, range);
        const float leaf_cost = bounds.boxes.half_area() * (static_cast<float>(range.size()) - NODE_COST);
        if (may_be_leaf && !(best.cost < leaf_cost)) {
            return {};
        }
        return best.axis < 0 ? halve(range, bounds.centres) : partition(range, scale, best);
    }

    std::vector<BuildPrimitive>& primitives_;
    std::vector<BinaryNode> nodes_;
    std::atomic<uint32_t> next_node_{1};
    std::atomic<int> spare_threads_{0};
    uint32_t median_depth_;
};

}  // namespace

float half_area(const BinaryNode& node) {
    const glm::vec3 size = node.upper - node.lower;
    return size.x * size.y + size.y * size.z + size.z * size.x;
}

std::vector<BinaryNode> build_binary_tree(std::vector<BuildPrimitive>& primitives, uint32_t threads,
                                          uint32_t median_depth) {
    return Builder(primitives, threads, median_depth).build();
}

}  // namespace source_core
