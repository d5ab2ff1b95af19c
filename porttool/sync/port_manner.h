// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/sync/edit_reading.h"

namespace porttool {

/// What a port does otherwise wherever the source does it, so that a new statement in the source's manner is none of
/// the port's, though each of its words is known there:
///
///     T * a = blob . host ( ) ;     T * a = blob . device ( ) ;      no element of `a` is used in host code
///     most ( & best , x ) ;         most ( best , x ) ;              the port's `most` takes no pointer
///     sum . low += x ;              add ( & sum . low , x ) ;        such sums are calls there
class PortManner : EditReading {
public:
    explicit PortManner(const EditReading& reading);

    /// Why a new clause, said in these words, is not in the port's manner, as a clause; "" if nothing tells so.
    std::string doubt(const std::vector<CarriedWord>& words, size_t now_clause) const;
    /// The same of the functions that a clause comes to call in the place of others.
    std::string doubt_of_calls(const Clause& was, const Clause& is) const;

private:
    struct Argument {
        size_t first = 0, end = 0;
    };
    struct Call {
        size_t name = 0;
        std::vector<Argument> arguments;
    };
    static std::vector<Call> calls_in(const std::vector<std::string>& words, size_t first, size_t end);
    static std::string giver_of(const std::vector<std::string>& words, const std::string& name);

    void learn_arguments(const Clause& here, const Clause& there);
    bool uses_elements_from(const std::string& giver) const;
    std::string foreign_element(const std::vector<CarriedWord>& words) const;
    std::string other_statement(const std::vector<CarriedWord>& words, const Clause& clause) const;

    using Arguments = std::map<std::string, std::set<size_t>>;
    Arguments pointed_to_, pointers_;  ///< by the port's function: what the source points to and the port hands over
};

}  // namespace porttool
