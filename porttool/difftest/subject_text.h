// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "porttool/difftest/subject.h"

namespace porttool {

/// The subject as a part of a program: in a namespace of its own, `subject_N`. `widens`: with doubles for floats.
std::string subject_text(const Subject& subject, int number, const Definitions& definitions, const StandIns& stand_ins,
                         bool widens = false);

}  // namespace porttool
