// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "porttool/difftest/subject.h"

namespace porttool {

/// The subject as a part of a program: in a namespace of its own, `subject_N`. `words`: what the other side names,
/// fields among it, which this one has to fill as well. `widens`: with doubles for floats.
std::string subject_text(const Subject& subject, int number, const Definitions& definitions, const StandIns& stand_ins,
                         std::set<std::string, std::less<>> words, bool widens);

}  // namespace porttool
