// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/audit/audit.h"
#include "porttool/audit/past_walk.h"
#include "porttool/audit/todays_pairs.h"

namespace porttool {

/// Items for units of either side, paired or not, of which one text alone tells that it is wrong: a member of another
/// group among those of one (odd_members.h), and other slips of the hand (lone_slips.h). What both sides of a pair say
/// is meant, but for what nobody can mean; what several units of a side say is one item.
std::vector<AuditItem> items_of_lone_texts(const Lineages& lineages, const TodaysPairs& today);

}  // namespace porttool
