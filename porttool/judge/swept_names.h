// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "porttool/compare/meaning.h"
#include "porttool/judge/judge.h"

namespace porttool {

/// Names that gave way to others throughout: the old one stands in no file of the side any more, the new one in no unit
/// that is as it was recorded. A type, where several watched units were edited by nothing else (of one that is a unit
/// of a pair RenamedNames knows it); a member, where both sides gave it the same new name and no other name is in it.
///
///     using rgbaf = tuple4<float>;     ->     using RgbaF = tuple4<float>;
///     rgbaf sum = rgbaf();             ->     RgbaF sum = RgbaF();             in two functions at least
///     list.cj4[i] = mask;              ->     list.packed[i] = mask;           on both sides
class SweptNames {
public:
    /// `facts` must outlive it.
    explicit SweptNames(const Case& facts) : facts_(facts) {}

    /// What is to say of the edit of a text of that side if it did nothing else; else "".
    std::string say(Side side, const Words& before, const Words& now);

    /// What others may have in common with an edit, to be told once. Of one that only exchanges names, none of them a
    /// function's, where what went stands nowhere in the file any more and gave way to one name alone: the new names
    /// that came into several watched units so. Of one that only adds text with names that are new to the side in each
    /// place: these names.
    std::vector<std::string> causes(Side side, const std::string& file, const Words& before, const Words& now);

    /// True if both edits only give the same things the same new names, with their scopes, be it in more places of one
    /// side.
    ///
    ///     case COARSE_AG : coarse ( A ) ;                      case amg :: AGGREGATION : coarse ( A ) ;
    static bool are_same_on_both(const PairTexts& texts);

private:
    using Name = std::pair<std::string, std::string>;  ///< before, now
    struct Times {
        size_t alone = 0, in_all = 0;  ///< of the watched units that only exchange names
    };

    std::vector<std::string> new_names(Side side, const std::string& file, const Words& before, const Words& now);
    std::vector<std::string> brought_names(Side side, const Words& before, const Words& now);
    bool is_swept_type(Side side, const Name& name);
    bool is_swept_on_both(const Name& name);
    bool is_one_to_one(Side side, const Name& name);
    bool is_type(Side side, const std::string& name) const;
    bool is_new(Side side, const std::string& name) const;
    bool is_brought(Side side, std::string_view name);
    Times times(Side side, const Name& name);
    const std::map<Name, Times>& exchanges(Side side);

    const Case& facts_;
    BySide<std::optional<std::map<Name, Times>>> exchanges_;  ///< filled when first asked
    BySide<std::map<Name, bool>> types_;
    BySide<std::map<std::string, bool, std::less<>>> brought_;
    std::map<Name, bool> of_both_;
};

}  // namespace porttool
