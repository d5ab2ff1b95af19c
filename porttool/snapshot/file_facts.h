// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/unit_state.h"
#include "porttool/normal/word_macros.h"
#include "porttool/scan/unit.h"

namespace porttool {

/// A unit without its text.
struct KnownUnit {
    std::string_view name;
    UnitKind kind = UnitKind::Function;
    uint32_t start_line = 0, end_line = 0;
    Fingerprints prints;
    uint32_t words = 0;           ///< of its normal text
    std::vector<uint32_t> names;  ///< that its text has, by their places in FileFacts::names
};

/// What a check asks of a file none of whose units changed: a function of path and text alone. In bytes of its own,
/// which are what is kept of it; made of them whether they are new or were kept.
class FileFacts {
public:
    /// `states`: those of the file's units.
    static std::string pack(const ScannedFile& file, const std::vector<UnitState>& states);
    /// `bytes` lie in `owner`. None where they are not what pack() gives.
    static std::optional<FileFacts> read(std::shared_ptr<const std::string> owner, std::string_view bytes);

    std::string_view bytes() const { return bytes_; }
    uint64_t tokens() const { return tokens_; }
    const std::optional<uint32_t>& unfinished_merge() const { return unfinished_merge_; }
    const std::vector<KnownUnit>& units() const { return units_; }  ///< in order; the whole file is the last
    const std::vector<std::string_view>& names() const { return names_; }
    const std::vector<Suppression>& suppressions() const { return suppressions_; }
    const std::vector<MacroLine>& macros() const { return macros_; }
    const std::vector<std::string>& includes() const { return includes_; }

private:
    std::shared_ptr<const std::string> owner_;
    std::string_view bytes_;
    uint64_t tokens_ = 0;
    std::optional<uint32_t> unfinished_merge_;
    std::vector<KnownUnit> units_;
    std::vector<std::string_view> names_;
    std::vector<Suppression> suppressions_;
    std::vector<MacroLine> macros_;
    std::vector<std::string> includes_;
};

/// The states of a file's units, the whole file last where it is one (`with_whole`, or where there are no others), and
/// that of one of them.
std::vector<UnitState> states_of(const ScannedFile& file, bool with_whole);
UnitState state_of(const ScannedFile& file, uint32_t unit);

}  // namespace porttool
