// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "porttool/compare/edits.h"
#include "porttool/compare/side_by_side.h"
#include "porttool/compare/side_edit.h"
#include "porttool/language/dialect.h"

namespace porttool {

/// An edit of one side alone beside the other side's text. What is dear is worked out when it is first asked for, and
/// then kept, for all that ask about the same edit.
class LaidEdit {
public:
    /// Both must outlive it.
    LaidEdit(const LoneTexts& texts, const Dialect& dialect) : texts_(texts), dialect_(dialect) {}
    LaidEdit(const LaidEdit&) = delete;
    LaidEdit& operator=(const LaidEdit&) = delete;

    const LoneTexts& texts() const { return texts_; }
    const Dialect& dialect() const { return dialect_; }

    const SideEdit& edit();
    const SideEdit& other();  ///< the other side's text, as an edit of nothing

    /// True if the texts are not too long to be laid side by side.
    bool can_be_laid() const;

    /// The text before the edit beside that of the other side; only where can_be_laid().
    const SideBySide& before();

private:
    struct Laid {
        Laid(const std::vector<std::string>& a, const std::vector<std::string>& b, WordKeys keys)
            : here(keys.text(a, false)), there(keys.text(b, false)), beside(a, b, here, there) {}

        AlignedText here, there;
        SideBySide beside;
    };

    const LoneTexts& texts_;
    const Dialect& dialect_;
    std::optional<SideEdit> edit_, other_;
    std::optional<Laid> before_;
};

}  // namespace porttool
