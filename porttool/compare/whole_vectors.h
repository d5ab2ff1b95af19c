// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// What a side says of each part of a value, in the words of a side that has the value whole.
///
///     cx = qx * a ;  cy = qy * a ;  cz = qz * a ;              c = q * a ;
///     c [ 0 ] = q [ 0 ] * a ;  c [ 1 ] = q [ 1 ] * a ;         the same, of `float c [ 2 ]`
///     cy = 0 ;                                                 c . y = 0 ;
///
/// Names are parts where the text has all of one manner, and no name of the whole: `x y z`, `r g b`, `red green blue`,
/// `0 1 2`, before or behind the rest. So is `q_lo` one of `q` where the other side says `q . lo`.
class WholeVectors {
public:
    /// `own`, `others`: the texts of the side, and those of the other one.
    WholeVectors(std::initializer_list<const Words*> own, std::initializer_list<const Words*> others);

    /// The text so, and whether that is another one.
    std::vector<std::string> written(const Words& text) const;

private:
    struct PartOfVector {
        std::string whole;
        size_t place = 0, count = 0;
    };
    using PartText = std::vector<std::string>;

    using Names = std::set<std::string, std::less<>>;

    void note(const Words& text, Names& names);
    void note_parts(const Names& names);
    void note_members(const Words& other, const Names& names, const Names& names_there);
    PartText with_members(const Words& text) const;
    size_t parts_said(const PartText& text, size_t first, size_t count) const;
    bool says_part(const PartText& text, size_t i, size_t place) const;

    std::map<std::string, PartOfVector, std::less<>> parts_;
    std::map<std::string, std::set<size_t>, std::less<>> counts_;  ///< of parts, by the names of the whole
    std::map<std::string, std::pair<std::string, std::string>, std::less<>> members_;  ///< an object's, by their names
    std::map<std::string, size_t, std::less<>> arrays_;  ///< of that many parts each; 0 for what is something else, too
};

}  // namespace porttool
