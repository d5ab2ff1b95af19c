// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "porttool/sync/drafts.h"
#include "porttool/sync/knowledge.h"

namespace porttool {

/// Lifts what a port's file declares below a unit that comes to use it: most languages want it above.
///
///     Bsdf make_bsdf(...) { ... smith_root(...) ... }        Float smith_root(...) { ... }
///     Float smith_root(...) { ... }                          Bsdf make_bsdf(...) { ... smith_root(...) ... }
class UnitRaiser {
public:
    /// All must outlive it.
    UnitRaiser(const CheckedProject& checked, Knowledge& knowledge, Drafts& drafts)
        : checked_(checked), knowledge_(knowledge), drafts_(drafts) {}

    /// What came of it: whether the draft is another one, and why the names cannot be used there; "" if they can.
    struct Raised {
        bool any = false;
        std::string failure;
    };
    /// Of those names that the file declares below the unit of an id and nowhere above, with what they use in turn.
    Raised raise(Side to, Draft& draft, const std::string& user, const std::set<std::string>& names);

private:
    const Unit* declared_below(Side to, const ScannedFile& file, const Unit& user,
                               const std::set<std::string>& names) const;
    bool is_declared_above(Side to, const ScannedFile& file, const Unit& user, const std::string& name) const;
    bool is_below_in_source(Side to, const std::string& unit, const std::string& user) const;
    std::string raise_one(Side to, Draft& draft, const std::string& user, const std::set<std::string>& names,
                          size_t depth, bool& any);
    bool lift(Draft& draft, const Unit& unit, const Unit& user);

    const CheckedProject& checked_;
    Knowledge& knowledge_;
    Drafts& drafts_;
};

}  // namespace porttool
