// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/text/shortened.h"

namespace porttool {
namespace {

/// True for a byte that goes on with a character of UTF-8.
bool goes_on(char byte) {
    constexpr unsigned kMask = 0xC0, kGoesOn = 0x80;
    return (static_cast<unsigned char>(byte) & kMask) == kGoesOn;
}

}  // namespace

std::string shortened(std::string_view text, size_t most) {
    constexpr std::string_view kLeftOut = " ... ";
    if (text.size() <= most) return std::string(text);
    size_t end = (most - kLeftOut.size()) * 2 / 3, start = text.size() - (most - kLeftOut.size() - end);
    while (end > 0 && goes_on(text[end])) --end;
    while (start < text.size() && goes_on(text[start])) ++start;
    return std::string(text.substr(0, end)).append(kLeftOut).append(text.substr(start));
}

}  // namespace porttool
