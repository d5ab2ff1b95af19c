// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace porttool {

/// Text in Markdown: CommonMark 0.30 with the tables, strikethrough and autolinks of GitHub Flavored Markdown, and
/// with what forges make of its text (mentions, references to issues, formulas, emoji). What a person reads is the text
/// given. None of these may stand at the very beginning of a line.

/// Text without any markup, anywhere in a line, a list item or the cell of a table. A word that forges would link
/// although its punctuation is escaped (`@team`, `https://`, `#12`) is shown as code.
std::string markdown_text(std::string_view text);

/// The same for the cell of a table, where what stands between single backticks stays code.
std::string markdown_cell(std::string_view message);

/// Text as a code span, whatever backticks it holds. A bar, which would end a cell, stands beside the span.
std::string markdown_code(std::string_view text);

/// What a block of code begins and ends with: backticks enough that none in the text ends it.
std::string markdown_fence(std::string_view text);

/// A sentence that is shown as text in one place and as Markdown in another: as it is but for words that would act in
/// Markdown, which become code.
std::string markdown_sentence(std::string_view message);

}  // namespace porttool
