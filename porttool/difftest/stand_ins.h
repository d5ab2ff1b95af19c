// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/difftest/definitions.h"
#include "porttool/scan/side.h"

namespace porttool {

/// What stands in for something that one side of the other does not have either, by a name alone.
struct NamedAnswer {
    int number = 0;
    std::string type;  ///< of the answer, as the other side writes it
};

/// What a run supplies on one side in place of what it does not have: tables, textures, settings.
struct StandIns {
    /// Functions that read such things, by the number under which both sides answer alike.
    std::map<const Definition*, int> functions;
    /// The same where this side has nothing of the name that the scan could see, as a function that a macro makes.
    std::map<std::string, NamedAnswer, std::less<>> named;
    /// Variables of plain data that both sides have under one name: they are inputs. Of one value, and of many, for
    /// which an answer of what reads them may stand as well.
    std::set<std::string, std::less<>> variables, arrays;
};

/// True for a function that gives nothing.
bool gives_nothing(const Definition& function);

/// What each side is supplied with, by `pairs`, the functions that are paired: where either reads what a run does not
/// have, or the two do not read the same, one answer stands for both.
BySide<StandIns> stand_ins_of(const std::vector<BySide<const Definition*>>& pairs, const Definitions& source,
                              const Definitions& target);

}  // namespace porttool
