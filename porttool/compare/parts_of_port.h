// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <vector>

#include "porttool/compare/clauses.h"
#include "porttool/language/dialect.h"
#include "porttool/normal/normal_text.h"

namespace porttool {

/// Whose parts of a port an edit of it reached. Originals go by their index.
struct ReachedParts {
    std::set<size_t> surely;   ///< a part of theirs was edited
    std::set<size_t> perhaps;  ///< one of theirs may have been
    bool elsewhere = false;    ///< what is nobody's part, or not told apart, was edited as well
};

/// The blocks of a function that is the port of several originals at once, and which of them each is the port of. A
/// block belongs to the original that alone has most of what not all have: calls, names, numbers, and the
/// operators around names whatever these are. What is as like another one's belongs to none, and a function of which
/// no block belongs to anyone has no parts.
///
///     originals   scale     v *= f[y];       port    for (...) { v *= factors[row]; }       the part of scale
///                 clip      if (v < lo) ...          for (...) { if (v < low) ... }         the part of clip
class PartsOfPort {
public:
    /// Of texts when they were last in step, without preludes; `port` must outlive it.
    PartsOfPort(const Words& port, const std::vector<Words>& originals, const Dialect& dialect);

    /// True if a block surely belongs to the original.
    bool has_part(size_t original) const { return with_parts_.contains(original); }
    bool any() const { return !with_parts_.empty(); }

    /// What an edit of the port, to this text, reached.
    ReachedParts reached(const Words& now) const;

private:
    static constexpr size_t kNobody = static_cast<size_t>(-1);

    /// A block with its head, as clauses.
    struct Block {
        size_t head, end;
        size_t owner = kNobody;
    };
    struct Hunk;

    static void add_other_ways(const Hunk& at, const Hunk& moved, const std::vector<std::string>& text,
                               std::vector<Hunk>& ways);
    size_t owner_of(const Hunk& hunk) const;
    void note(const std::vector<Hunk>& ways, ReachedParts& out) const;

    std::vector<std::string> words_;
    std::vector<Clause> clauses_;
    std::vector<Block> owned_;  ///< outer ones before those that they hold
    std::set<size_t> with_parts_;
};

}  // namespace porttool
