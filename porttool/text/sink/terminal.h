// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <streambuf>
#include <string>
#include <string_view>

namespace porttool {

/// Text for a terminal, or for a log that a person reads. Control sequences (ECMA-48, also C1 as UTF-8 or as bytes),
/// the Unicode Bidirectional Algorithm's controls and line breaks of others are shown as `\u{1b}`, never obeyed.

/// A name or a text of others in the midst of a line.
std::string terminal_text(std::string_view value);

/// The same where it stands first in a line: `::name::`, a workflow command of GitHub there, also after blanks, begins
/// with `\u{3a}:`.
std::string terminal_line(std::string_view value);

/// A line of a file, for a reader, behind `indent`: its tabs stay, and it begins no command.
std::string terminal_code_line(std::string_view indent, std::string_view line);

/// A message of several lines, made of words of ours and of values that went through `terminal_text`: its line breaks
/// stay. What values it holds that did not can forge a line, but nothing acts.
std::string terminal_lines(std::string_view message);

/// A stream buffer that passes on what is written to it, line by line, as `terminal_lines`; of lines beyond 4 KiB the
/// middle is left out. What has no line break yet
/// waits for it, or for the end of the buffer.
class TerminalBuffer : public std::streambuf {
public:
    explicit TerminalBuffer(std::streambuf* out) : out_(out) {}
    ~TerminalBuffer() override;
    TerminalBuffer(const TerminalBuffer&) = delete;
    TerminalBuffer& operator=(const TerminalBuffer&) = delete;

protected:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int sync() override;

private:
    void pass_on();

    std::streambuf* out_;
    std::string line_;
};

}  // namespace porttool
