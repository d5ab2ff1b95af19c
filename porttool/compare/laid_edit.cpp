// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/compare/laid_edit.h"

namespace porttool {

const SideEdit& LaidEdit::edit() {
    if (!edit_) edit_.emplace(texts_.before, texts_.now, dialect_);
    return *edit_;
}

const SideEdit& LaidEdit::other() {
    if (!other_) other_.emplace(texts_.other, texts_.other, dialect_);
    return *other_;
}

bool LaidEdit::can_be_laid() const {
    constexpr size_t kMost = 24'000;  // words of all texts
    return texts_.before.size() + texts_.now.size() + texts_.other.size() <= kMost;
}

const SideBySide& LaidEdit::before() {
    if (!before_) before_.emplace(edit().before, other().now, WordKeys(dialect_));
    return before_->beside;
}

}  // namespace porttool
