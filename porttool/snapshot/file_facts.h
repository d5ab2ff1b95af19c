// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
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
    uint32_t words = 0;  ///< of its normal text
};

/// What a check asks of a file none of whose units changed: a function of path and text alone. In bytes of its own,
/// which are what is kept of it; made of them whether they are new or were kept. Units and macros, of which a file can
/// have half a million, are read from the bytes when they are asked for.
class FileFacts {
public:
    /// `states`: those of the file's units.
    static std::string pack(const ScannedFile& file, const std::vector<UnitState>& states);
    /// `bytes` lie in `owner`. None where they are not what pack() gives.
    static std::optional<FileFacts> read(std::shared_ptr<const std::string> owner, std::string_view bytes);

    std::string_view bytes() const { return bytes_; }
    uint64_t tokens() const { return tokens_; }
    const std::optional<uint32_t>& unfinished_merge() const { return unfinished_merge_; }
    uint32_t units() const { return static_cast<uint32_t>(units_.size()); }
    KnownUnit unit(uint32_t i) const;  ///< in order; the whole file is the last
    /// Calls visit(name) once for each name that the unit's text has.
    void each_name(uint32_t unit, const std::function<void(std::string_view)>& visit) const;
    const std::vector<Suppression>& suppressions() const { return suppressions_; }
    std::vector<MacroLine> macros() const;
    const std::vector<std::string>& includes() const { return includes_; }

private:
    std::shared_ptr<const std::string> owner_;
    std::string_view bytes_;
    uint64_t tokens_ = 0;
    std::optional<uint32_t> unfinished_merge_;
    std::vector<std::string_view> names_;
    std::vector<uint32_t> units_;  ///< where they begin in bytes_
    size_t macros_ = 0;            ///< the same of the macros
    std::vector<Suppression> suppressions_;
    std::vector<std::string> includes_;
};

/// The states of a file's units, the whole file last where it is one (`with_whole`, or where there are no others): one
/// after the other, as a file can have half a million, or all; and that of one of them.
void visit_states(const ScannedFile& file, bool with_whole, const std::function<void(UnitState)>& visit);
std::vector<UnitState> states_of(const ScannedFile& file, bool with_whole);
UnitState state_of(const ScannedFile& file, uint32_t unit);

}  // namespace porttool
