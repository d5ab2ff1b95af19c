// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "porttool/sync/edit_reading.h"
#include "porttool/sync/local_writes.h"

namespace porttool {

/// Whether variables of the two sides get the same values, as far as the texts of a pair that is in step show it: each
/// write has its like on the other side, of a value that is the same in the other's words. What a write reads is looked
/// at in the same way, no deeper than that: somewhere ports always differ.
///
///     int hi = n ;   int last = n - 1 ;      differ          int x = blockIdx.x * w + threadIdx.x ;
///     n -- ;         (nothing)               differ          for ( int x = 0 ; x < w ; ++ x ) {         are the same
class SameValues : EditReading {
public:
    struct Names {
        std::string here, there;
        std::string part_here, part_there;  ///< the members of them that are read
    };
    using Clauses = std::set<size_t>;

    /// Both must outlive it.
    SameValues(const EditReading& reading, const LocalWrites& before, const LocalWrites& there)
        : EditReading(reading), before_(before), there_(there) {}

    /// Why a variable of the target that gets its value in the clauses `there` has another one than the source's, which
    /// gets it in those of `here`; "" if that is not so.
    std::string difference(const Names& names, const Clauses& here, const Clauses& there) const {
        return difference(names, here, there, 0);
    }
    /// The same of all that writes to them, whatever that is made of.
    std::string difference_of_writes(const Names& names, const Clauses& here, const Clauses& there) const {
        return difference(names, here, there, kDeepest);
    }
    /// The same of a clause and its counterpart.
    std::string difference_of(const Names& names, size_t here) const;

private:
    static constexpr int kDeepest = 1;       ///< so far what a value is made of is looked at
    static constexpr int kDeepestOther = 3;  ///< the same where the port has another name in it

    std::string difference(const Names& names, const Clauses& here, const Clauses& there, int depth) const;
    std::string difference_of(const Names& names, size_t here, size_t there, int depth) const;
    /// True where both sides write one name in statements that stand for each other, however each says it:
    /// `z *= s / r ;` and `z *= native_divide ( s , r ) ;`.
    bool say_it_each_their_way(const Names& names, size_t here, size_t there) const;
    std::string written_otherwise(const Names& names, size_t here, size_t there, int depth) const;
    bool is_other_parameter(const Names& names) const;
    bool counts_alike(size_t here, size_t there) const;
    std::vector<std::string> thread_numbers(const AlignedText& text, size_t clause) const;
    bool is_by_thread(const AlignedText& text, size_t clause) const;
    /// Why two written values differ; " " if there is no more to say than that.
    std::string differ(const VariableWrite& here, const VariableWrite& there, int depth) const;
    bool differ_in_parts(const VariableWrite& there, const std::vector<CarriedWord>& said) const;

    using Asked = std::tuple<std::string, std::string, std::string, std::string, size_t, size_t, int>;

    const LocalWrites &before_, &there_;
    mutable std::map<Asked, std::string> told_;  ///< of clauses, whose values lead to one another
};

}  // namespace porttool
