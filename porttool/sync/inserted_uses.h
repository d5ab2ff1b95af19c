// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "porttool/sync/edit_reading.h"
#include "porttool/sync/local_writes.h"
#include "porttool/sync/same_values.h"

namespace porttool {

/// Whether what an edit brings into the target can stand there: each name is declared at that place, and each variable
/// holds what it holds in the source, since the same writes lead to both. A port goes ways of its own, and a name that
/// stands for another in one place does not in all.
///
///     int hi = n ;                 int last = n - 1 ;
///     if ( hi == 0 ) ...           if ( last == 0 ) ...          not so: `last` has another value
class InsertedUses : EditReading {
public:
    /// `is_method`: the target's unit sees the fields of a class.
    InsertedUses(const EditReading& reading, bool is_method);
    InsertedUses(const InsertedUses&) = delete;
    InsertedUses& operator=(const InsertedUses&) = delete;

    /// True for a word of the source's new text that names a local of it.
    bool is_local(size_t now_word) const { return now_.local(now_word) != 0; }
    /// True for a word of the source's old or new text that its clause may write, in place or as an argument.
    bool may_write_before(size_t word) const { return may_write(before_, texts_.before, word); }
    bool may_write_now(size_t word) const { return may_write(now_, texts_.now, word); }
    /// True for a word of the target that names a local or a parameter of it.
    bool is_local_there(size_t word) const { return there_.local(word) != 0; }

    /// Why a step of a variable in a clause of the source's old text, `n ++` or `n += 2`, leads elsewhere in the port
    /// whatever it says: it counts from another number there. "" if nothing shows that.
    std::string doubt_of_step(size_t was) const;

    /// Words, made from those of the source's new text before `source_end`, in place of words of a clause of the
    /// target. Why they cannot be sure there, as a clause; "" if they are.
    std::string doubt_within(const std::vector<CarriedWord>& words, size_t source_end, size_t target_word) const;
    /// The same before a clause.
    std::string doubt_before(const std::vector<CarriedWord>& words, size_t source_end, size_t target_word) const;

private:
    /// Words of the source's new text, and which of the carried words say the same.
    struct Saying {
        size_t first = 0, end = 0, said_first = 0, said_end = 0;
    };
    /// Where the carried words go.
    struct Insertion {
        const std::vector<CarriedWord>& words;
        size_t target_word;
        UsePlace place;
    };
    using Clauses = std::set<size_t>;

    void run_threads_apart();
    static bool may_write(const LocalWrites& writes, const AlignedText& text, size_t word);
    std::string doubt(const Insertion& in, size_t source_end) const;
    std::string doubt_of(const Saying& saying, const Insertion& in) const;
    /// True for a name that the carried words declare themselves, whatever the port has under that name.
    bool declares_itself(const Insertion& in, size_t i) const;
    bool is_plain_name(const Insertion& in, size_t i) const;
    std::string unknown_name(const Insertion& in, size_t i, bool is_local_here) const;
    bool writes_constant(const Insertion& in, size_t i, size_t local) const;
    bool stands_already(const Saying& saying, const Insertion& in) const;
    /// True if the pair says it so elsewhere, and all that is read has the same values there.
    bool is_said_elsewhere(const Saying& saying, const Insertion& in) const;
    bool reads_the_same(const Saying& saying, const Insertion& in, size_t here, size_t there) const;
    /// True if both sides have the name, with the values that it has here, in a statement that they say word for word.
    bool is_used_alike(const Insertion& in, size_t here, size_t there) const;
    bool is_said_word_for_word(size_t was) const;
    bool is_new(size_t now_word) const;

    std::string other_value(const Insertion& in, size_t here, size_t there) const;
    bool is_overwritten(size_t now_word) const;
    /// What a word of the source's new text names, and where it would stand, in the old one.
    LocalPart old_part(size_t now_word) const;
    UsePlace old_place(size_t now_word) const;
    /// The clauses of the old text whose writes lead to a word of the new one; without those of the edit.
    Clauses reaching_now(size_t now_word) const;
    /// Clauses of the source's old text, and of the target, without those that go.
    Clauses staying(Clauses before) const;
    Clauses staying_there(Clauses there) const;
    /// What a carried word reads of the target; `part`: of the source's word.
    LocalPart part_there(const Insertion& in, size_t i, const std::string& part) const;

    bool is_method_;
    LocalWrites before_, now_, there_;
    SameValues values_;
    std::vector<size_t> was_;  ///< for each word of the source's new text the one of the old that stayed
    mutable std::map<size_t, bool>
        said_;       ///< clauses of the source's old text: whether the target has just their words
    Clauses going_;  ///< clauses of the target whose counterparts went
};

}  // namespace porttool
