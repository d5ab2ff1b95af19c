// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

#include "porttool/normal/normal_text.h"
#include "porttool/read/map_file.h"
#include "porttool/scan/unit.h"
#include "porttool/spirv/spirv.h"

namespace porttool {

/// All that an answer rests on.
struct ShaderSide {
    ShaderFiles now;
    std::vector<std::string> entries;  ///< paths of all entry points
    MapShaders settings;
};

/// Whether an edit reaches the compiled code.
struct SpirvAnswer {
    bool same = false;
    std::vector<std::string> entries;  ///< the entry points that were compiled
    std::string obstacle;              ///< why it cannot be told; empty if it can
};

/// Tells whether functions of GLSL compile to the same code as before. Keeps what it compiled. An answer "same" needs:
/// every entry point that includes the file compiles, at least one of them reaches the function at hand, and in all of
/// them nothing differs but names, debug information and code without effect.
class SpirvComparer {
public:
    explicit SpirvComparer(ShaderSide side);

    /// Today's files against today's files with the earlier text of one function in its place. `before` is that text.
    SpirvAnswer compare_unit(const ScannedFile& file, const Unit& unit, const NormalText& before);

    /// Today's files against earlier ones as a whole.
    SpirvAnswer compare_files(const ScannedFile& file, const Unit& unit, const ShaderFiles& before);

private:
    struct Subject {
        const ScannedFile& file;
        const Unit& unit;
    };
    SpirvAnswer compare(const Subject& subject, const ShaderFiles& before);
    const SpirvModule& today(const std::string& entry, const std::string& preamble);
    bool reaches(const Subject& subject, const std::string& entry, const std::string& preamble);

    ShaderSide side_;
    std::map<std::string, std::set<std::string>> included_;  ///< by entry point
    std::map<std::pair<std::string, std::string>, SpirvModule> today_;
};

}  // namespace porttool
