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

using Lanes = float __attribute__((vector_size(16)));  // x, y, z and a fourth that nobody looks at

constexpr uint32_t LARGEST_LEAF = 4;
constexpr uint32_t BINS = 16;
constexpr float NODE_COST = 1.0f;      // of testing a node against that of a triangle
constexpr size_t PARALLEL_RANGE = 8192;  // primitives below which a thread of its own is not worth it
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

Lanes load_lower(const BuildPrimitive& primitive) {
    Lanes lanes;
    std::memcpy(&lanes, &primitive, sizeof(lanes));
    return lanes;
}

Lanes load_upper(const BuildPrimitive& primitive) {
    Lanes lanes;
    std::memcpy(&lanes, reinterpret_cast<const char*>(&primitive) + sizeof(lanes), sizeof(lanes));
    return lanes;
}

Lanes centre(const BuildPrimitive& primitive) { return load_lower(primitive) * 0.5f + load_upper(primitive) * 0.5f; }

struct Split {
    int axis = -1;  // -1: none
    uint32_t bin = 0;  // first bin of the right side
    float cost = LARGEST;
};

// How centroids map to bins.
struct BinScale {
    Lanes origin;
    Lanes scale;

    uint32_t bin(Lanes centroid, int axis) const {
        const float position = (centroid[axis] - origin[axis]) * scale[axis];
        return std::min(static_cast<uint32_t>(position), BINS - 1);
    }
};

BinScale make_scale(const Bounds& centroids) {
    BinScale result{centroids.lower, {}};
    for (int axis = 0; axis < 3; ++axis) {
        const float extent = centroids.upper[axis] - centroids.lower[axis];
        const float scale = static_cast<float>(BINS) / extent;
        result.scale[axis] = extent > 0.0f && scale < LARGEST ? scale : 0.0f;
    }
    return result;
}

struct Bins {
    Bounds bounds[3][BINS];
    uint32_t counts[3][BINS] = {};
};

void fill(Bins& bins, const BinScale& scale, std::span<const BuildPrimitive> range) {
    for (const BuildPrimitive& primitive : range) {
        const Lanes lower = load_lower(primitive);
        const Lanes upper = load_upper(primitive);
        const Lanes position = (centre(primitive) - scale.origin) * scale.scale;
        for (int axis = 0; axis < 3; ++axis) {
            const uint32_t bin = std::min(static_cast<uint32_t>(position[axis]), BINS - 1);
            bins.bounds[axis][bin].include(lower, upper);
            ++bins.counts[axis][bin];
        }
    }
}

void sweep_axis(const Bins& bins, int axis, Split& best) {
    float right_cost[BINS];
    Bounds right;
    uint32_t count = 0;
    for (uint32_t bin = BINS - 1; bin > 0; --bin) {
        right.include(bins.bounds[axis][bin].lower, bins.bounds[axis][bin].upper);
        count += bins.counts[axis][bin];
        right_cost[bin] = count == 0 ? LARGEST : right.half_area() * static_cast<float>(count);
    }
    Bounds left;
    count = 0;
    for (uint32_t bin = 1; bin < BINS; ++bin) {
        left.include(bins.bounds[axis][bin - 1].lower, bins.bounds[axis][bin - 1].upper);
        count += bins.counts[axis][bin - 1];
        if (count == 0 || right_cost[bin] == LARGEST) {
            continue;
        }
        const float cost = left.half_area() * static_cast<float>(count) + right_cost[bin];
        if (cost < best.cost) {
            best = {axis, bin, cost};
        }
    }
}

class Builder {
public:
    Builder(std::vector<BuildPrimitive>& primitives, uint32_t threads, uint32_t median_depth)
        : primitives_(primitives), nodes_(2 * primitives.size()), median_depth_(median_depth) {
        const uint32_t all = std::max(1u, std::thread::hardware_concurrency());
        spare_threads_ = static_cast<int>(threads == 0 ? all : threads) - 1;
    }

    std::vector<BinaryNode> build() {
        build_range(0, 0, primitives_.size(), 0);
        nodes_.resize(next_node_);
        return std::move(nodes_);
    }

private:
    void build_range(uint32_t node, size_t begin, size_t end, uint32_t depth) {
        const std::span<BuildPrimitive> range(primitives_.data() + begin, end - begin);
        Bounds bounds;
        Bounds centroids;
        bool some_alone = false;
        for (const BuildPrimitive& primitive : range) {
            bounds.include(load_lower(primitive), load_upper(primitive));
            const Lanes centroid = centre(primitive);
            centroids.include(centroid, centroid);
            some_alone |= primitive.alone != 0;
        }
        BinaryNode& result = nodes_[node];
        result.lower = {bounds.lower[0], bounds.lower[1], bounds.lower[2]};
        result.upper = {bounds.upper[0], bounds.upper[1], bounds.upper[2]};
        const bool may_be_leaf = range.size() == 1 || (range.size() <= LARGEST_LEAF && !some_alone);
        const size_t middle = begin + split(range, bounds, centroids, may_be_leaf, depth);
        if (middle == begin) {
            result.first = static_cast<uint32_t>(begin);
            result.count = static_cast<uint32_t>(range.size());
            return;
        }
        const uint32_t left = next_node_.fetch_add(2);
        result.first = left;
        result.count = 0;
        build_children(left, begin, middle, end, depth + 1);
    }

    void build_children(uint32_t left, size_t begin, size_t middle, size_t end, uint32_t depth) {
        const bool large = std::min(middle - begin, end - middle) >= PARALLEL_RANGE;
        if (large && spare_threads_.fetch_sub(1) > 0) {
            auto other = std::async(std::launch::async, [=, this] { build_range(left, begin, middle, depth); });
            build_range(left + 1, middle, end, depth);
            other.get();
            spare_threads_.fetch_add(1);
            return;
        }
        if (large) {
            spare_threads_.fetch_add(1);
        }
        build_range(left, begin, middle, depth);
        build_range(left + 1, middle, end, depth);
    }

    // Reorders the range and returns the size of its left part; 0 makes a leaf.
    size_t split(std::span<BuildPrimitive> range, const Bounds& bounds, const Bounds& centroids, bool may_be_leaf,
                 uint32_t depth) {
        if (range.size() == 1 || (may_be_leaf && depth >= median_depth_)) {
            return 0;
        }
        if (depth >= median_depth_) {
            return median(range, centroids);
        }
        const BinScale scale = make_scale(centroids);
        Bins bins;
        fill(bins, scale, range);
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            if (scale.scale[axis] > 0.0f) {
                sweep_axis(bins, axis, best);
            }
        }
        const float leaf_cost = bounds.half_area() * (static_cast<float>(range.size()) - NODE_COST);
        if (may_be_leaf && !(best.cost < leaf_cost)) {
            return 0;
        }
        if (best.axis < 0) {
            return median(range, centroids);
        }
        const auto middle = std::partition(range.begin(), range.end(), [&](const BuildPrimitive& primitive) {
            return scale.bin(centre(primitive), best.axis) < best.bin;
        });
        return static_cast<size_t>(middle - range.begin());
    }

    static size_t median(std::span<BuildPrimitive> range, const Bounds& centroids) {
        const Lanes extent = centroids.upper - centroids.lower;
        int axis = extent[1] > extent[0] ? 1 : 0;
        axis = extent[2] > extent[axis] ? 2 : axis;
        const auto middle = range.begin() + static_cast<std::ptrdiff_t>(range.size() / 2);
        std::nth_element(range.begin(), middle, range.end(), [axis](const BuildPrimitive& a, const BuildPrimitive& b) {
            const float centre_a = centre(a)[axis];
            const float centre_b = centre(b)[axis];
            return centre_a < centre_b || (centre_a == centre_b && a.id < b.id);
        });
        return range.size() / 2;
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
