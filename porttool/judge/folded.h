// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "porttool/judge/finding_list.h"
#include "porttool/read/map_file.h"

namespace porttool {

/// Tells findings of one cause once: the first of the worst says it and lists the others, which become notes that name
/// it. One cause are an edit of one unit that several pairs have; one edit of more than a word or two that was made in
/// several units; heads of many functions that take one type in the place of another; what several functions take or
/// hand on and did not before; parts of several units that were put into branches for the compiler; edits that do
/// nothing but what one of them does as well, where each of their spots is one of several units; new units of one file
/// that look like some of the other side; the methods of a new class; edits of
/// five units and more that are one sweep (judge/sweeps.h); units of one file that are gone, or of a family
/// whose counterparts have one name; macros that several unedited texts use. What a person settled, and rules whose
/// level the map sets, are left alone. The pairs stand as they stood.
///
///     s/disney.cl:1: error: new function Albedo looks like t/disney.cpp:Albedo (1.00): ...; 2 more new units ...
///     s/disney.cl:9: note: new function Pdf looks like ...; told with s/disney.cl:Albedo
void fold_findings(FindingList& findings, const MapFile& map);

/// A port whose source is gone is a note where another source of it is there, or a new unit that looks like it and is
/// told for itself: then nothing is left over; and where ports that have their sources use it, so that it cannot go.
void ease_orphans(FindingList& findings, const std::vector<JudgedPair>& pairs, const UnitsById& ports);

}  // namespace porttool
