// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "porttool/scan/declared_words.h"
#include "porttool/snapshot/side_files.h"

namespace porttool {

/// What a side says of a word outside of units, and did not say at the merge base.
struct NewWord {
    const ScannedFile* file = nullptr;  ///< that says it
    DeclaredWord said;
    bool is_known = false;  ///< something was said of the word there before, at the level of a file

    std::string_view word() const { return word_of(*file, said); }
    std::string text() const { return text_of(*file, said); }
    uint32_t line() const { return file->lexed.tokens[said.tokens.first].line; }
};

struct NewWords {
    std::vector<NewWord> words;
    std::set<std::string> opened;  ///< namespaces of which names are seen without them somewhere, now
    /// Files, each with a word that it brought from a namespace, or a namespace that it opened, at the merge base.
    std::set<std::pair<std::string, std::string>> brought_before;
};

/// `now` must outlive it. What one file no longer says and another says now was moved and is not new.
NewWords new_words(const FilesOfSide& now, const FilesOfSide& then);

/// False for files that are compiled by themselves.
bool is_header(std::string_view path);

}  // namespace porttool
