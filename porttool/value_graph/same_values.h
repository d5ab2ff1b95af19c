// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "porttool/normal/statements.h"
#include "porttool/value_graph/machine.h"

namespace porttool {

/// A function as statements whose locals are words such as "%3", and how it is read.
struct ReadFunction {
    const std::vector<Statement>& statements;
    ReadingManner manner;
};

/// True if two functions, in common words, are sure to give back the same value and to do the same to all that they can
/// reach, in the same order, whatever they are given: each is run once with values that are not known (symbolic
/// execution), and both give one graph (ValueTable). What is not read, as a switch, a lambda, a local that others may
/// write into, or is too large, is never the same. Bits are kept: no sum is regrouped; that a compiler may join a
/// product and a sum into one operation is left out of account, and so is that two references may name one object.
///
///     float t = a * b ;  return c + t ;                   return a * b + c ;
///     if ( n < 0 ) {  return 0 ;  }  return f ( n ) ;     return n < 0 ? 0 : f ( n ) ;
///
/// The types of results and parameters stand for each other by their order: a class of `other` for one of `one`, or for
/// a vector; a reference for a pointer.
bool give_the_same(const ReadFunction& one, const ReadFunction& other);

}  // namespace porttool
