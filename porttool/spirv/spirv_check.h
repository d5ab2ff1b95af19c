// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "porttool/normal/unit_state.h"
#include "porttool/read/git_repository.h"
#include "porttool/scan/side.h"
#include "porttool/snapshot/snapshot.h"
#include "porttool/spirv/same_spirv.h"

namespace porttool {

/// Answers for `check --spirv` whether an edit of a GLSL function reaches the compiled code. Reads shaders and what
/// they include from the disk or, with --staged, from the index; earlier files from git where a function's earlier text
/// does not compile among today's files. Nothing is read before the first question.
class SpirvCheck {
public:
    /// `base`: the revision whose merge base with HEAD has the earlier files. Throws CannotDo if porttool was built
    /// without glslang.
    SpirvCheck(const Snapshot& snapshot, std::string base, const Disk& disk);
    ~SpirvCheck();

    /// What to say of a function that compiles to the same code as its earlier text `before` (as in portmap.base/), or
    /// "" if it does not or if that cannot be told.
    std::string same_code(const UnitState& unit, Side side, const NormalText& before);

    /// One line for each function of which it could not be told, and why.
    const std::vector<std::string>& obstacles() const { return obstacles_; }

private:
    struct Shaders;
    Shaders& shaders_of(Side side);
    SpirvAnswer ask(Shaders& shaders, const ScannedFile& file, const Unit& unit, const NormalText& before);

    const Snapshot& snapshot_;
    const Project& project_;
    std::string base_;
    const Disk& disk_;
    BySide<std::unique_ptr<Shaders>> shaders_;
    std::vector<std::string> obstacles_;
};

}  // namespace porttool
