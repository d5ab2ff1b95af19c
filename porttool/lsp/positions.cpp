// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/positions.h"

#include <algorithm>

#include "porttool/text/utf8.h"

namespace porttool::lsp {
namespace {

struct CharacterSize {
    size_t bytes = 1;
    uint32_t units = 1;
};

/// What stands first in a text that is not empty.
CharacterSize first_character(std::string_view text) {
    constexpr size_t kBeyondBasicPlane = 4;  // bytes of UTF-8, and two units of UTF-16
    const size_t bytes = static_cast<unsigned char>(text[0]) < 0x80 ? 1 : utf8_length(text);
    if (bytes == 0) return {};
    return {bytes, bytes == kBeyondBasicPlane ? 2U : 1U};
}

}  // namespace

uint32_t utf16_length(std::string_view text) {
    uint32_t units = 0;
    while (!text.empty()) {
        const CharacterSize first = first_character(text);
        units += first.units;
        text.remove_prefix(first.bytes);
    }
    return units;
}

Utf16Counts::Utf16Counts(std::string_view text) : text_(text) {
    constexpr size_t kApart = 4096;
    Mark at;
    for (size_t next = kApart; at.offset < text.size();) {
        const CharacterSize first = first_character(text.substr(at.offset));
        at.offset += first.bytes;
        at.units += first.units;
        if (at.offset < next) continue;
        marks_.push_back(at);
        next = at.offset + kApart;
    }
}

uint32_t Utf16Counts::between(size_t first, size_t end) const {
    const auto is_before = [](const Mark& mark, size_t offset) { return mark.offset < offset; };
    const auto low = std::lower_bound(marks_.begin(), marks_.end(), first, is_before);
    const auto behind = std::lower_bound(low, marks_.end(), end, is_before);
    if (low == behind) return utf16_length(text_.substr(first, end - first));
    const Mark &from = *low, &to = *(behind - 1);
    return utf16_length(text_.substr(first, from.offset - first)) + (to.units - from.units) +
           utf16_length(text_.substr(to.offset, end - to.offset));
}

TextPlaces::TextPlaces(std::string_view text) : text_(text), starts_{0} {
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n') continue;
        if (text[i] == '\n' || text[i] == '\r') starts_.push_back(i + 1);
    }
}

size_t TextPlaces::offset_of(Position at) const {
    if (at.line >= starts_.size()) return text_.size();
    size_t offset = starts_[at.line];
    for (uint32_t units = 0; offset < text_.size() && text_[offset] != '\n' && text_[offset] != '\r';) {
        const CharacterSize next = first_character(text_.substr(offset));
        units += next.units;
        if (units > at.character) break;
        offset += next.bytes;
    }
    return offset;
}

Position TextPlaces::position_of(size_t offset) const {
    const auto after = std::upper_bound(starts_.begin(), starts_.end(), std::min(offset, text_.size()));
    const size_t start = *(after - 1);
    return {static_cast<uint32_t>(after - starts_.begin() - 1),
            utf16_length(text_.substr(start, std::min(offset, text_.size()) - start))};
}

}  // namespace porttool::lsp
