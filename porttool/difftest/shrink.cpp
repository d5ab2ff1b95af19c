// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/shrink.h"

#include <bit>
#include <cmath>
#include <cstdlib>

namespace porttool {
namespace {

constexpr int kMostShrinks = 40;
constexpr size_t kMostTried = 40000;  ///< numbers in the tries of one round

int complexity_of_real(double value) {
    constexpr int kOdd = 40;
    if (value == 0) return std::signbit(value) ? 2 : 0;
    if (!std::isfinite(value)) return 12;
    if (value == 1) return 1;
    const int sign = value < 0 ? 1 : 0;
    const double size = std::fabs(value);
    if (size == 1 || size == 0.5 || size == 2) return 2 + sign;
    for (int digits = 1; digits <= 8; ++digits) {
        const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(size)));
        const bool plain = size >= 1e-3 && size <= 1e4;
        if (std::fabs(std::round(size * scale) / scale - size) <= size * 1e-8)
            return 2 + sign + 2 * digits + (plain ? 0 : 4);
    }
    return kOdd;
}

int complexity_of_number(uint64_t number, const Leaf& leaf) {
    if (leaf.is_real()) return complexity_of_real(std::bit_cast<double>(number));
    const auto value = static_cast<int64_t>(number);
    return (value < 0 ? 1 : 0) + static_cast<int>(std::bit_width(static_cast<uint64_t>(std::llabs(value))));
}

double of_digits(double value, int digits) {
    if (value == 0 || !std::isfinite(value)) return value;
    const double scale = std::pow(10.0, digits - 1 - std::floor(std::log10(std::fabs(value))));
    return std::isfinite(scale) && scale != 0 ? std::round(value * scale) / scale : value;
}

/// Simpler numbers that may do instead.
std::vector<uint64_t> simpler(uint64_t number, const Leaf& leaf) {
    std::vector<uint64_t> out;
    if (leaf.is_real()) {
        const auto value = std::bit_cast<double>(number);
        for (const double other : {0.0, 1.0, -1.0, 0.5, 2.0, of_digits(value, 1), of_digits(value, 2),
                                   of_digits(value, 3), of_digits(value, 5), std::round(value)})
            out.push_back(std::bit_cast<uint64_t>(
                leaf.kind == NumberKind::Double ? other : static_cast<double>(static_cast<float>(other))));
    } else {
        const auto value = static_cast<int64_t>(number);
        for (const int64_t other : {int64_t{0}, int64_t{1}, int64_t{2}, value / 2, value / 16, value - 1, -value}) {
            if (leaf.kind == NumberKind::Bool && other > 1) continue;
            if (leaf.kind == NumberKind::Unsigned && other < 0) continue;
            out.push_back(static_cast<uint64_t>(other));
        }
    }
    return out;
}

}  // namespace

int complexity_of(const uint64_t* record, const std::vector<Leaf>& leaves) {
    int out = 0;
    for (size_t i = 0; i < leaves.size(); ++i) out += complexity_of_number(record[i], leaves[i]);
    return out;
}

std::vector<uint64_t> shrunk(Trial& trial, std::vector<uint64_t> record) {
    const std::vector<Leaf>& leaves = trial.inputs();
    const size_t width = leaves.size();
    for (int round = 0; round < kMostShrinks && width > 0; ++round) {
        const int now = complexity_of(record.data(), leaves);
        InputTable table;
        for (size_t i = 0; i < width && table.size() < kMostTried; ++i)
            for (const uint64_t other : simpler(record[i], leaves[i])) {
                if (complexity_of_number(other, leaves[i]) >= complexity_of_number(record[i], leaves[i])) continue;
                table.insert(table.end(), record.begin(), record.end());
                table[table.size() - width + i] = other;
                // The same for every number that is still as odd as this one: most do not matter at all.
                if (round > 1) continue;
                table.insert(table.end(), record.begin(), record.end());
                for (size_t k = i; k < width; ++k)
                    if (leaves[k].is_real() == leaves[i].is_real()) table[table.size() - width + k] = other;
            }
        if (table.empty() || !trial.run(table).empty()) break;
        int best = now;
        size_t chosen = trial.records();
        for (size_t i = 0; i < trial.records(); ++i) {
            const int here = complexity_of(&table[i * width], leaves);
            if (here >= best || trial.outcome(i) != Outcomes::Differs) continue;
            best = here;
            chosen = i;
        }
        if (chosen == trial.records()) break;
        record.assign(table.begin() + static_cast<std::ptrdiff_t>(chosen * width),
                      table.begin() + static_cast<std::ptrdiff_t>((chosen + 1) * width));
    }
    return record;
}

}  // namespace porttool
