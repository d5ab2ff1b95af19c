// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/sink/terminal.h"

#include <fmt/format.h>

#include <algorithm>

#include "porttool/text/shortened.h"
#include "porttool/text/visible.h"

namespace porttool {
namespace {

constexpr std::string_view kCommand = "::";

/// Breaks a workflow command that a line begins with.
std::string without_command(std::string line) {
    const size_t blanks = leading_blanks(line);
    if (line.compare(blanks, kCommand.size(), kCommand) == 0) line.replace(blanks, 1, "\\u{3a}");
    return line;
}

/// Our own escapes, which a value of the message holds already, stay as they are.
std::string escaped_once(char32_t code) {
    return code == '\n' ? "\n" : fmt::format("\\u{{{:x}}}", static_cast<uint32_t>(code));
}

}  // namespace

std::string terminal_text(std::string_view value) { return visible(value); }

std::string terminal_line(std::string_view value) { return without_command(visible(value)); }

std::string terminal_code_line(std::string_view indent, std::string_view line) {
    std::string out(indent);
    for (size_t at = 0; at < line.size();) {
        const size_t tab = std::min(line.find('\t', at), line.size());
        out += visible(line.substr(at, tab - at));
        if (tab < line.size()) out += '\t';
        at = tab + 1;
    }
    return without_command(std::move(out));
}

std::string terminal_lines(std::string_view message) {
    std::string out;
    while (true) {
        const size_t end = message.find('\n');
        out +=
            without_command(without_log_commands(without_invisible(message.substr(0, end), escaped_once), "\\u{23}"));
        if (end == std::string_view::npos) return out;
        out += '\n';
        message.remove_prefix(end + 1);
    }
}

TerminalBuffer::~TerminalBuffer() { pass_on(); }

/// A key or a glob of a map, which a message quotes, may be a megabyte long.
void TerminalBuffer::pass_on() {
    constexpr size_t kLongestLine = 4096;
    std::string text;
    for (std::string_view rest = line_; !rest.empty();) {
        const size_t end = std::min(rest.find('\n'), rest.size());
        text += terminal_lines(shortened(rest.substr(0, end), kLongestLine));
        if (end < rest.size()) text += '\n';
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    line_.clear();
    out_->sputn(text.data(), static_cast<std::streamsize>(text.size()));
}

TerminalBuffer::int_type TerminalBuffer::overflow(int_type c) {
    if (traits_type::eq_int_type(c, traits_type::eof())) return traits_type::not_eof(c);
    line_ += traits_type::to_char_type(c);
    if (line_.back() == '\n') sync();
    return c;
}

std::streamsize TerminalBuffer::xsputn(const char* text, std::streamsize size) {
    line_.append(text, static_cast<size_t>(size));
    sync();
    return size;
}

int TerminalBuffer::sync() {
    const size_t end = line_.rfind('\n') + 1;  // 0 if there is none
    if (end == 0) return 0;
    std::string rest = line_.substr(end);
    line_.resize(end);
    pass_on();
    line_ = std::move(rest);
    return out_->pubsync();
}

}  // namespace porttool
