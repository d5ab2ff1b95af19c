// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <vector>

#include "porttool/compare/parts_of_port.h"
#include "porttool/judge/judge.h"
#include "porttool/judge/mapped_pair.h"

namespace porttool {

/// What an edit of a port that several originals share is to one of these.
struct EditOfParts {
    enum Kind : uint8_t {
        Fits,        ///< it may be the port of an edit of this original
        PerhapsNot,  ///< parts of others were edited, and no part of this one's; but not all parts are known
        OfOthers,    ///< all of it lies in parts of others, and this one has its own
    } kind = Fits;
    const MappedPair* owner = nullptr;      ///< one of the others whose part it lies in
    std::vector<const MappedPair*> owners;  ///< all originals whose part it surely reached
};

/// Tells whose part of a shared port was edited. What was recorded tells the parts; each port is looked at once.
class OtherParts {
public:
    /// All must outlive it. `side`: of the ports.
    OtherParts(const Case& facts, const BySide<RenamedNames>& renamed, Side side);

    /// `pairs`: all that were recorded with one text of their port, which was edited since; `pair` is one of them.
    const EditOfParts& edit_of(const MappedPair& pair, const std::vector<const MappedPair*>& pairs);

private:
    std::vector<EditOfParts> look(const std::vector<const MappedPair*>& pairs) const;
    NormalText text_before(const MappedPair& pair, Side side) const;

    const Case& facts_;
    const BySide<RenamedNames>& renamed_;
    Side side_;
    std::map<const MappedPair*, EditOfParts> known_;
};

}  // namespace porttool
