// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "porttool/effort/ported_edit.h"
#include "porttool/effort/unit_index.h"

namespace porttool {

/// An edit outside all pairs.
struct FileEffort {
    std::string file;
    LineEdit edit;
};

/// One side before and after a change, with what its pairs have accounted for. The files must outlive it.
class ChangedSide {
public:
    ChangedSide(const std::vector<ScannedFile>& before, const std::vector<ScannedFile>& now, LineReader& reader)
        : files_before_(before), files_now_(now), before_(before), now_(now), reader_(reader) {}

    /// The edit of a unit that stands in a pair, by its id.
    EditedUnit edit_of_pair(const std::string& id);

    /// The edits that no pair accounts for, file by file; adds the number of their words to `words`.
    std::vector<FileEffort> outside(size_t& words);

private:
    /// Lines of paired units: by file, whether each of its lines is one.
    using PairedLines = std::unordered_map<const ScannedFile*, std::vector<bool>>;

    LinesOfCode read_paired(const Excerpt& excerpt);
    LinesOfCode read_outside(const ScannedFile* file) const;

    const std::vector<ScannedFile>&files_before_, &files_now_;
    UnitIndex before_, now_;
    LineReader& reader_;
    PairedLines paired_;
};

}  // namespace porttool
