// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace porttool::lsp {

/// A place in a document as the protocol has it: line from 0, and UTF-16 code units before it in that line.
struct Position {
    uint32_t line = 0, character = 0;
    auto operator<=>(const Position&) const = default;
};

struct Range {
    Position start, end;
    bool operator==(const Range&) const = default;
};

/// How many UTF-16 code units a text has. A byte that is no UTF-8 counts for one, as U+FFFD does.
uint32_t utf16_length(std::string_view text);

/// How many UTF-16 code units lie between two bytes of one text, asked for often: of a long line only a part is gone
/// through. The text must outlive it.
class Utf16Counts {
public:
    explicit Utf16Counts(std::string_view text);

    /// As utf16_length of that part; both are the beginnings of characters.
    uint32_t between(size_t first, size_t end) const;

private:
    struct Mark {
        size_t offset = 0;
        uint32_t units = 0;  ///< before it
    };
    std::string_view text_;
    std::vector<Mark> marks_;  ///< every few kilobytes, each where a character begins
};

/// Places of a text, whose lines end with \n, \r\n or \r, as bytes and as positions. The text must outlive it.
class TextPlaces {
public:
    explicit TextPlaces(std::string_view text);

    /// The byte at a position. One behind the end of its line is that end, one behind the last line the text's end, and
    /// one within a character its beginning.
    size_t offset_of(Position at) const;
    Position position_of(size_t offset) const;

private:
    std::string_view text_;
    std::vector<size_t> starts_;  ///< of lines
};

}  // namespace porttool::lsp
