// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/inputs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace porttool {
namespace {

/// SplitMix64 (Steele, Lea, Flood 2014): the same numbers everywhere, unlike the distributions of <random>.
class Draw {
public:
    explicit Draw(uint64_t seed) : state_(seed) {}
    uint64_t bits() {
        uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }
    uint64_t below(uint64_t count) { return bits() % count; }
    /// In [0, 1), with 24 bits.
    double unit() { return static_cast<double>(bits() >> 40) * 0x1p-24; }
    /// In [-1, 1).
    double turn() { return 2 * unit() - 1; }

private:
    uint64_t state_;
};

constexpr float kFloatTiny = std::numeric_limits<float>::denorm_min();
constexpr std::array<double, 20> kEdges = {0.0,
                                           -0.0,
                                           1.0,
                                           -1.0,
                                           0.5,
                                           2.0,
                                           static_cast<double>(std::numeric_limits<float>::min()),
                                           static_cast<double>(-std::numeric_limits<float>::min()),
                                           static_cast<double>(kFloatTiny),
                                           static_cast<double>(-kFloatTiny),
                                           static_cast<double>(std::numeric_limits<float>::max()),
                                           static_cast<double>(-std::numeric_limits<float>::max()),
                                           static_cast<double>(std::numeric_limits<float>::epsilon()),
                                           0x1.fffffep-1,
                                           0x1.000002p+0,
                                           1e-6,
                                           1e6,
                                           std::numeric_limits<double>::infinity(),
                                           -std::numeric_limits<double>::infinity(),
                                           std::numeric_limits<double>::quiet_NaN()};
constexpr std::array<int64_t, 14> kWholeEdges = {0,   1,   -1,    2,     3,          7,           8,
                                                 255, 256, 65535, 65536, 2147483647, -2147483648, 4294967295};

/// What a whole number of a kind can be.
int64_t held_by(int64_t value, const Leaf& leaf) {
    if (leaf.kind == NumberKind::Bool) return value & 1;
    const bool has_sign = leaf.kind == NumberKind::Signed;
    switch (leaf.bytes) {
        case 1:
            return has_sign ? static_cast<int8_t>(value) : static_cast<uint8_t>(value);
        case 2:
            return has_sign ? static_cast<int16_t>(value) : static_cast<uint16_t>(value);
        case 4:
            return has_sign ? static_cast<int32_t>(value) : static_cast<uint32_t>(value);
        default:
            return value;
    }
}

double held_by_real(double value, const Leaf& leaf) {
    if (leaf.kind == NumberKind::Double) return value;
    const auto narrow = static_cast<float>(value);
    return static_cast<double>(
        leaf.kind == NumberKind::Half ? static_cast<float>(std::ldexp(std::round(std::ldexp(narrow, 8)), -8)) : narrow);
}

class Drawer {
public:
    Drawer(const std::vector<Leaf>& leaves, const std::vector<double>& constants, uint64_t seed)
        : leaves_(leaves), constants_(constants), draw_(seed) {
        for (size_t i = 0; i + 2 < leaves.size(); ++i)
            if (leaves[i].is_real() && leaves[i].path.ends_with(".x") && leaves[i + 1].path.ends_with(".y") &&
                leaves[i + 2].path.ends_with(".z"))
                vectors_.push_back(i);
    }

    /// `manner`: 0 ordinary, 1 varied, 2 wild.
    void record(uint64_t* row, int manner) {
        for (size_t i = 0; i < leaves_.size(); ++i)
            row[i] =
                leaves_[i].is_real() ? std::bit_cast<uint64_t>(real(leaves_[i], manner)) : whole(leaves_[i], manner);
        if (manner < 2)
            for (const size_t at : vectors_)
                if (draw_.below(3) != 0) unit_vector(row + at);
        if (leaves_.size() > 1 && draw_.below(8) == 0) {
            const size_t from = draw_.below(leaves_.size()), to = draw_.below(leaves_.size());
            if (leaves_[from].is_real() == leaves_[to].is_real() && leaves_[from].kind != NumberKind::Double)
                row[to] = leaves_[to].is_real()
                              ? row[from]
                              : static_cast<uint64_t>(held_by(static_cast<int64_t>(row[from]), leaves_[to]));
        }
    }
    static size_t edge_count(const Leaf& leaf) { return leaf.is_real() ? kEdges.size() : kWholeEdges.size(); }
    uint64_t edge(const Leaf& leaf, size_t which) const {
        if (leaf.is_real()) return std::bit_cast<uint64_t>(held_by_real(kEdges.at(which), leaf));
        return static_cast<uint64_t>(held_by(kWholeEdges.at(which), leaf));
    }
    uint64_t near_constant(const Leaf& leaf, double constant, int step) const {
        if (!leaf.is_real()) return static_cast<uint64_t>(held_by(whole_of(constant) + step, leaf));
        auto value = static_cast<float>(constant);
        for (int i = 0; i < std::abs(step); ++i) value = std::nextafter(value, step < 0 ? -INFINITY : INFINITY);
        return std::bit_cast<uint64_t>(held_by_real(static_cast<double>(value), leaf));
    }

private:
    static int64_t whole_of(double value) { return std::fabs(value) < 9e18 ? static_cast<int64_t>(value) : 0; }
    double real(const Leaf& leaf, int manner) {
        double value = 0;
        switch (manner == 0 ? draw_.below(3) : manner == 1 ? draw_.below(8) : 8 + draw_.below(3)) {
            case 0:
            case 1:
                value = draw_.unit();
                break;
            case 2:
            case 3:
                value = draw_.turn();
                break;
            case 4:
                value = draw_.turn() * 10;
                break;
            case 5:
                value = std::ldexp(draw_.turn(), static_cast<int>(draw_.below(40)) - 20);
                break;
            case 6:
                value = constants_.empty() ? draw_.unit()
                                           : constant() * (draw_.below(2) == 0 ? 1 : 1 + 1e-3 * draw_.turn());
                break;
            case 7:
                value = static_cast<double>(draw_.below(9)) / 4 - 1;
                break;
            case 8:
                value = kEdges.at(draw_.below(kEdges.size()));
                break;
            case 9:
                value = static_cast<double>(std::bit_cast<float>(static_cast<uint32_t>(draw_.bits())));
                break;
            default:
                value = std::ldexp(draw_.turn(), static_cast<int>(draw_.below(250)) - 125);
        }
        return held_by_real(value, leaf);
    }
    uint64_t whole(const Leaf& leaf, int manner) {
        int64_t value = 0;
        switch (manner == 0 ? draw_.below(2) : manner == 1 ? draw_.below(5) : 5 + draw_.below(2)) {
            case 0:
                value = static_cast<int64_t>(draw_.below(4));
                break;
            case 1:
                value = static_cast<int64_t>(draw_.below(64));
                break;
            case 2:
                value = static_cast<int64_t>(draw_.below(4096)) - 16;
                break;
            case 3:
                value = (int64_t{1} << draw_.below(32)) + static_cast<int64_t>(draw_.below(3)) - 1;
                break;
            case 4:
                value = constants_.empty() ? 5 : whole_of(constant()) + static_cast<int64_t>(draw_.below(3)) - 1;
                break;
            case 5:
                value = kWholeEdges.at(draw_.below(kWholeEdges.size()));
                break;
            default:
                value = static_cast<int64_t>(draw_.bits());
        }
        return static_cast<uint64_t>(held_by(value, leaf));
    }
    double constant() { return constants_[draw_.below(constants_.size())]; }
    void unit_vector(uint64_t* at) {
        std::array<double, 3> v = {draw_.turn(), draw_.turn(), draw_.turn()};
        const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
        if (length < 1e-3) return;
        for (size_t i = 0; i < 3; ++i)
            at[i] = std::bit_cast<uint64_t>(static_cast<double>(static_cast<float>(v.at(i) / length)));
    }

    const std::vector<Leaf>& leaves_;
    const std::vector<double>& constants_;
    std::vector<size_t> vectors_;
    Draw draw_;
};

}  // namespace

std::vector<Leaf> common_inputs(const Leaves& source, const Leaves& target, const LeafMatch& match) {
    std::vector<Leaf> out;
    for (const BySide<size_t>& place : match.in) out.push_back(source.in[place.source]);
    for (size_t i = 0; i < out.size(); ++i) {
        const Leaf& other = target.in[match.in[i].target];
        if (out[i].is_real() ? static_cast<int>(other.kind == NumberKind::Double) <
                                       static_cast<int>(out[i].kind == NumberKind::Double) ||
                                   other.kind == NumberKind::Half
                             : other.kind == NumberKind::Bool || other.bytes < out[i].bytes) {
            out[i].kind = other.kind;
            out[i].bytes = other.bytes;
        }
    }
    return out;
}

void draw_inputs(const std::vector<Leaf>& leaves, const std::vector<double>& constants, size_t records, uint64_t seed,
                 int64_t most, InputTable& out) {
    const size_t width = leaves.size();
    out.resize(width * records);
    Drawer drawer(leaves, constants, seed);
    size_t row = 0;
    // Edges, and what lies beside constants, one number at a time: in at most half of the records.
    constexpr size_t kMostConstants = 24;
    for (size_t i = 0; i < width; ++i)
        for (size_t which = 0; which < Drawer::edge_count(leaves[i]) && row < records / 4; ++which, ++row) {
            drawer.record(out.data() + row * width, 0);
            out[row * width + i] = drawer.edge(leaves[i], which);
        }
    for (size_t c = 0; c < std::min(constants.size(), kMostConstants); ++c)
        for (size_t i = 0; i < width; ++i)
            for (int step = -1; step <= 1 && row < records / 2; ++step, ++row) {
                drawer.record(out.data() + row * width, 0);
                out[row * width + i] = drawer.near_constant(leaves[i], constants[c], step);
            }
    for (size_t turn = 0; row < records; ++row, ++turn)
        drawer.record(out.data() + row * width, turn % 8 < 4 ? 0 : turn % 8 < 7 ? 1 : 2);
    if (most > 0)
        for (size_t i = 0; i < out.size(); ++i)
            if (const Leaf& leaf = leaves[i % width]; !leaf.is_real())
                out[i] = static_cast<uint64_t>(static_cast<int64_t>(out[i]) % (most + 1));
}

double size_of_record(const uint64_t* record, const std::vector<Leaf>& leaves) {
    double out = 0;
    for (size_t i = 0; i < leaves.size(); ++i) {
        if (!leaves[i].is_real()) continue;
        const double size = std::fabs(std::bit_cast<double>(record[i]));
        out = std::isnan(size) ? std::numeric_limits<double>::infinity() : std::max(out, size);
    }
    return out;
}

}  // namespace porttool
