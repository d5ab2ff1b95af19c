// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "porttool/judge/judge.h"

namespace porttool {

/// Types that one side gave other names throughout. The old name stands in no file of the side any more, the new one in
/// no unit that is as it was recorded, and several watched units were edited by nothing else. Of a type that is a unit
/// of a pair RenamedNames knows it.
///
///     using rgbaf = tuple4<float>;     ->     using RgbaF = tuple4<float>;
///     rgbaf sum = rgbaf();             ->     RgbaF sum = RgbaF();             in two functions at least
class SweptNames {
public:
    /// `facts` must outlive it.
    explicit SweptNames(const Case& facts) : facts_(facts) {}

    /// True if the edit of a text of that side did nothing else.
    bool are_all(Side side, const Words& before, const Words& now);

private:
    using Name = std::pair<std::string, std::string>;  ///< before, now

    bool is_swept(Side side, const Name& name);
    bool is_gone(Side side, const std::string& name) const;
    bool is_type(Side side, const std::string& name) const;
    bool is_new(Side side, const std::string& name) const;
    size_t times_alone(Side side, const Name& name);
    const std::map<std::string, size_t>& lone_renamings(Side side);

    const Case& facts_;
    BySide<std::optional<std::map<std::string, size_t>>> lone_;  ///< units by `before now`; filled when first asked
    BySide<std::map<Name, bool>> known_;
};

}  // namespace porttool
