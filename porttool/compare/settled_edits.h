// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "porttool/compare/meaning.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// True if edits of both sides left no difference that was not there before: all that came on one side stands in the
/// other's text of today as well, in the same order, and nothing lost its counterpart. What each side said in its own
/// words before, and that went, must have gone in as many statements on both sides, each with one of the other that has
/// the same numbers or half of its names; or it must have stood where the other side had nothing that is still there.
///
///                 source                          port
///     before      case 1: r = q; default: r = 0   case 1: *red = q; default: *red = 0
///     now         case 1: default: r = q          case 1: default: *red = q
///     or now      case 1: default: r = q          case 1: *red = q;                       not: where `default` stands
bool edits_leave_no_difference(const PairTexts& texts, const Dialect& dialect, const BySide<Language>& languages);

}  // namespace porttool
