// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/compare/alignment.h"

namespace porttool {

/// True if a function takes its argument of that number, from 0, by a reference that it may write through.
using HandsBack = std::function<bool(const std::string& function, size_t argument)>;

/// A local, or one of its members.
struct LocalPart {
    size_t local = 0;  ///< 0 for what is no local
    std::string part;  ///< "" for all of it
};

/// Where a value is read: before which clause, in which block.
struct UsePlace {
    size_t clause = 0;             ///< those before it come first
    size_t block = Clause::kNone;  ///< the clause that heads the block around it
    bool is_within = false;        ///< it is read by the clause itself
};

/// How a clause writes a variable.
///
///     float v = a + b ;       =   a + b            for ( int i = 0 ; i < n ; i ++ ) {      =   0       +=
///     v += a ;                +=  a                read ( & v ) ; take ( v ) ;             &
struct VariableWrite {
    std::string op;
    std::string part;           ///< the member of it that is written, if one
    size_t first = 0, end = 0;  ///< the words of the value; none for `++`, a parameter or `&`
    bool is_whole = false;      ///< nothing of it is as it was

    static constexpr std::string_view kParameter = "@", kEach = ":", kAddress = "&";
};

/// The local variables of a unit in normal form, and where they get their values. Preprocessor lines are passed over.
class LocalWrites {
public:
    /// Both must outlive it.
    LocalWrites(const AlignedText& text, const HandsBack& hands_back);

    /// Takes a loop for one over all threads, none of which reads what another wrote.
    void run_apart(size_t loop) { apart_.insert(loop); }
    bool is_loop(size_t clause) const;

    /// False for a text that is not understood; then nothing is local.
    bool is_known() const { return !locals_.empty(); }
    /// Which local a word names, from 1; 0 for anything else.
    size_t local(size_t word) const { return locals_.empty() ? 0 : locals_[word]; }
    /// The same with the member that is picked of it there.
    LocalPart part(size_t word) const;
    /// Which local a name would mean before `word`; 0 for none.
    size_t local_at(size_t word, const std::string& name) const;
    /// The word that declares a local.
    size_t declaration(size_t local) const { return declared_.at(local); }
    /// True for a local that is declared not to change; with `parts` for one of which no part changes: `const float *
    /// in`.
    bool is_constant(size_t local, bool parts) const;

    UsePlace place_of(size_t word) const;
    UsePlace place_before(size_t word) const;
    /// Behind a clause; with kNone before the first.
    UsePlace place_behind(size_t clause) const;

    /// The clauses whose writes may be what is read at a place: from the last one that surely comes before it on.
    std::set<size_t> reaching(const LocalPart& read, const UsePlace& place) const;
    std::set<size_t> reaching(size_t word) const { return reaching(part(word), place_of(word)); }
    /// All clauses that write it.
    std::set<size_t> writing(const LocalPart& written) const;
    /// What a clause writes to locals of a name, or to that part of them.
    std::vector<VariableWrite> writes(size_t clause, const std::string& name, const std::string& part) const;
    size_t clause_at(size_t word) const;

private:
    bool is_in(size_t clause, size_t head) const;
    bool surely_runs(size_t clause, const UsePlace& place) const;
    void note_write(size_t word, std::vector<VariableWrite>& out) const;
    bool is_handed_back(size_t first, size_t end) const;
    size_t end_of_value(size_t first) const;
    size_t closing(size_t open) const;
    const std::string& word(size_t i) const;

    const AlignedText& text_;
    const HandsBack& hands_back_;
    std::vector<size_t> locals_;
    std::vector<size_t> declared_;  ///< by local: the word that declares it
    std::set<size_t> apart_;
    std::map<size_t, std::set<size_t>> written_in_;  ///< by local: clauses
};

}  // namespace porttool
