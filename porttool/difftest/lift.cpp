// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/difftest/lift.h"

#include <map>

namespace porttool {

std::optional<BuiltSide> lifted(const BuiltSide& narrow, const Leaves& wide) {
    constexpr size_t kMost = 4;
    const Leaves& one = narrow.leaves;
    const size_t count = wide.out.size();
    if (one.out.size() != 1 || count < 2 || count > kMost || one.in.empty()) return std::nullopt;
    std::map<int, std::vector<size_t>> places;  // of the wide side's numbers, by parameter
    for (size_t i = 0; i < wide.in.size(); ++i) places[wide.in[i].parameter].push_back(i);
    if (places.size() != one.in.size()) return std::nullopt;
    BuiltSide out = narrow;
    out.leaves.in.assign(wide.in.size(), Leaf());
    out.leaves.out.assign(count, one.out.front());
    out.calls.assign(count, {});
    size_t at = 0;
    for (const auto& [parameter, numbers] : places) {
        if (numbers.size() != 1 && numbers.size() != count) return std::nullopt;
        for (size_t i = 0; i < numbers.size(); ++i) {
            out.leaves.in[numbers[i]] = one.in[at];
            out.leaves.in[numbers[i]].path = wide.in[numbers[i]].path;
        }
        for (size_t call = 0; call < count; ++call) out.calls[call].push_back(numbers[numbers.size() == 1 ? 0 : call]);
        ++at;
    }
    for (size_t i = 0; i < count; ++i) {
        out.leaves.out[i].parameter = wide.out[i].parameter;
        out.leaves.out[i].path = wide.out[i].path;
    }
    return out;
}

}  // namespace porttool
