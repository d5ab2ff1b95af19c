// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace metrics {

/// The text with U+FFFD in the place of each byte that is no UTF-8, and `escape(code)` in that of each character that
/// draws nothing of its own but acts on what stands around it: control characters (C0, DEL, C1), what sets the
/// direction of writing, what has no width, separators of lines and paragraphs, tags and noncharacters. Joiners and
/// variation selectors stay within emoji.
std::string without_invisible(std::string_view bytes, std::string (*escape)(char32_t code));

/// A text of others (a name, a message, a line of code) in one line in which nothing is hidden and nothing acts: each
/// character that `without_invisible` takes out as `\u{202e}`, also tabs and line breaks. So that this is unambiguous,
/// a backslash that begins such a sequence in the text itself is `\u{5c}`. `##[` is `#\u{23}[`. Every sink but JSON,
/// which keeps the text as it is, begins with this.
std::string visible(std::string_view bytes);

/// The same of a message of ours that holds such texts: its line breaks stay, and what is escaped in it already does.
std::string visible_lines(std::string_view message);

/// The text with `sign` in the place of the second `#` of each `##[`, which readers of build logs take for a command
/// wherever it stands; also `##vso[` of Azure Pipelines and `##teamcity[`.
std::string without_log_commands(std::string text, std::string_view sign);

/// The bytes of blanks that a text begins with: white space of Unicode.
size_t leading_blanks(std::string_view text);

}  // namespace metrics
