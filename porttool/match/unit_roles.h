// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <unordered_set>
#include <vector>

#include "porttool/match/candidates.h"
#include "porttool/match/features.h"

namespace porttool {

/// What the units of both sides do: they are kernels, launch them, hand on to what does, make ready for one, or work. A
/// launcher is no kernel's port, wherever it stands. Sources and targets are given by their numbers.
class UnitRoles {
public:
    /// What it is given has to stay, but for the candidates.
    UnitRoles(const std::vector<UnitFeatures>& source, const std::vector<UnitFeatures>& target,
              const TermNumbers& terms, const std::vector<std::vector<Candidate>>& candidates);

    /// A shader's main is the subject of its file: a helper of another file is not it, even under the very name.
    bool is_elsewhere(uint32_t s, uint32_t t) const { return has_home_[s] && target_[t].stem != source_[s].stem; }

    /// What leads to a kernel is not ported by what neither works nor calls what does, as what only notes what to do.
    bool is_idle_for(uint32_t s, uint32_t t) const;

    /// A kernel, and what launches it there or hands on to what does.
    bool is_launched_there(uint32_t s, uint32_t t) const;

    /// A kernel or launcher of a file whose launchers are called there.
    bool is_used_there(uint32_t s, uint32_t t) const;

    /// One of the two launches kernels. Where they share the last part of their names, or differ there in the platform
    /// that each names, the other can hold the launcher and its kernel in one, but is no kernel.
    static bool other_role(const UnitFeatures& a, const UnitFeatures& b);

    /// One is a kernel, and the other's name says that it makes ready for what a kernel does.
    bool prepares(const UnitFeatures& a, const UnitFeatures& b) const;

private:
    /// What each target does with the kernels of the source: launches them, calls what does, or neither.
    void read_launchers();

    /// What of the target calls launchers that stand beside the source's kernels: the host that both sides have in
    /// common, or the part of it that is in the target's folders.
    void read_callers();

    /// What of the source leads to a kernel without launching it, and what of the target works, itself or in a function
    /// of its file that it calls.
    void read_workers();

    /// Which shaders' mains have a candidate that works in the other side's file of their own file's name.
    void read_homes(const std::vector<std::vector<Candidate>>& candidates);

    /// A call of a name that the target itself does not have is one of the source's.
    bool calls_by_name(uint32_t s, uint32_t t) const;

    const std::vector<UnitFeatures>& source_;
    const std::vector<UnitFeatures>& target_;
    const TermNumbers& terms_;
    std::unordered_set<uint32_t> own_;            ///< the names that the target's functions are called by
    std::vector<bool> launches_;                  ///< of each target
    std::vector<bool> has_home_;                  ///< of each source, see read_homes()
    std::vector<bool> leads_on_;                  ///< of each source: it calls what launches
    std::vector<bool> delegates_;                 ///< of each target: it calls what works, or launches
    std::vector<std::set<uint32_t>> calls_into_;  ///< of each target, files whose launchers it calls
};

}  // namespace porttool
