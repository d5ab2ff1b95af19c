// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "porttool/judge/check_project.h"
#include "porttool/read/lock_lines.h"
#include "porttool/sync/carried_names.h"
#include "porttool/sync/declaration_carrier.h"
#include "porttool/sync/drafts.h"
#include "porttool/sync/earlier_files.h"
#include "porttool/sync/knowledge.h"
#include "porttool/sync/new_units.h"
#include "porttool/sync/proposal.h"
#include "porttool/sync/rewrite.h"
#include "porttool/sync/unit_raiser.h"

namespace porttool {

/// How many pairs a unit stands in, by its id.
using PairCounts = BySide<std::unordered_map<std::string_view, size_t>>;

/// An edit of one side of a pair. `before`: the texts when the pair was last in step.
struct PairEdit {
    const JudgedPair& pair;
    const LockedPair& line;
    const BySide<NormalText>& before;
    Side from;
    Side to() const { return other_side(from); }
};

/// Carries the edit of one unit into the draft of its port's file, and says what is left.
class PairCarrier {
public:
    /// All must outlive it.
    PairCarrier(Knowledge& knowledge, Drafts& drafts, const NewUnits& new_units, UnitRaiser& raiser,
                EarlierTexts& earlier_texts, DeclarationCarrier& declarations, const LinesByPair& lines,
                const CheckedProject& checked, const PairCounts& counts)
        : knowledge_(knowledge),
          drafts_(drafts),
          new_units_(new_units),
          raiser_(raiser),
          earlier_texts_(earlier_texts),
          declarations_(declarations),
          lines_(lines),
          checked_(checked),
          counts_(counts) {}

    void carry(const PairEdit& edit, Proposal& out);

private:
    struct Places;
    struct Texts;
    /// What is known of names: those that may be used, those that may not, and why of some.
    struct KnownNames {
        Names from_elsewhere, brought, lone;
        std::map<std::string, std::string, std::less<>> unported;
        std::set<std::string> locals;  ///< of the source's new text
    };

    static bool is_declared_anew(const Texts& texts, const std::string& name);
    KnownNames names_of(const PairEdit& edit, const Texts& texts);
    void read_earlier_file(const PairEdit& edit, const Texts& texts, UnitSurroundings& out);
    Transplant transplanted(const PairEdit& edit, const Texts& texts, KnownNames& names, Proposal& out);
    void leave_unported(const PairEdit& edit, const Texts& texts, const KnownNames& names, const Transplant& found,
                        Proposal& out) const;
    bool write(const PairEdit& edit, const Texts& texts, const KnownNames& names, Transplant& found, Proposal& out);
    bool leave_values_of_nothing(const PairEdit& edit, const Texts& texts, Transplant& found, Proposal& out) const;
    static bool withdraw_undeclared(const PairEdit& edit, const Texts& texts, const ScannedFile& file,
                                    Transplant& found);
    static std::vector<TextEdit> edits_of(const Texts& texts, const ScannedFile& file, const Transplant& found);
    void finish(const PairEdit& edit, const Texts& texts, Transplant& found, Proposal& out);
    bool holds_a_part(const PairEdit& edit, const Alignment& across) const;
    std::vector<uint32_t> constants_of(const ScannedFile& file, const Unit& unit, const ScannedFile& other);
    BraceEdits edit_of_braces(const PairEdit& edit, const Texts& texts);

    Knowledge& knowledge_;
    Drafts& drafts_;
    const NewUnits& new_units_;
    UnitRaiser& raiser_;
    EarlierTexts& earlier_texts_;
    DeclarationCarrier& declarations_;
    const LinesByPair& lines_;
    const CheckedProject& checked_;
    const PairCounts& counts_;
};

}  // namespace porttool
