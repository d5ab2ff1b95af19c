// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "metrics/text/visible.h"

#include <algorithm>
#include <array>
#include <charconv>

#include "metrics/text/utf8.h"

namespace metrics {
namespace {

struct Range {
    char32_t first, last;
};

/// Beside control characters: Default_Ignorable_Code_Point of Unicode 15, the separators U+2028 and U+2029, and
/// interlinear annotations. Sorted.
constexpr std::array<Range, 19> kInvisible = {{{0xAD, 0xAD},
                                               {0x34F, 0x34F},
                                               {0x61C, 0x61C},
                                               {0x115F, 0x1160},
                                               {0x17B4, 0x17B5},
                                               {0x180B, 0x180F},
                                               {0x200B, 0x200F},
                                               {0x2028, 0x202E},
                                               {0x2060, 0x206F},
                                               {0x3164, 0x3164},
                                               {0xFDD0, 0xFDEF},
                                               {0xFE00, 0xFE0F},
                                               {0xFEFF, 0xFEFF},
                                               {0xFFA0, 0xFFA0},
                                               {0xFFF0, 0xFFFB},
                                               {0x1BCA0, 0x1BCA3},
                                               {0x1D173, 0x1D17A},
                                               {0xE0000, 0xE0FFF},
                                               {0x10FFFE, 0x10FFFF}}};

constexpr char32_t kFirstPrintable = 0x20, kDelete = 0x7F, kLastControl = 0x9F;
constexpr char32_t kJoiner = 0x200D, kTextStyle = 0xFE0E, kPictureStyle = 0xFE0F;

bool is_invisible(char32_t code) {
    if (code < kFirstPrintable || (code >= kDelete && code <= kLastControl)) return true;
    if ((code & 0xFFFE) == 0xFFFE) return true;  // a noncharacter
    const auto next = std::upper_bound(kInvisible.begin(), kInvisible.end(), code,
                                       [](char32_t c, const Range& range) { return c < range.first; });
    return next != kInvisible.begin() && code <= std::prev(next)->last;
}

/// Pictures, which joiners and variation selectors may follow.
bool is_picture(char32_t code) { return (code >= 0x2190 && code <= 0x2BFF) || (code >= 0x1F000 && code <= 0x1FAFF); }

char32_t code_of(std::string_view character) {
    const auto byte = [&](size_t i) { return static_cast<unsigned char>(character[i]); };
    constexpr unsigned kPayload = 0x3F, kShift = 6;
    if (character.size() == 1) return byte(0);
    char32_t code = byte(0) & (0xFFu >> (character.size() + 1));
    for (size_t i = 1; i < character.size(); ++i) code = (code << kShift) | (byte(i) & kPayload);
    return code;
}

/// The character that a text begins with; 0 if there is none.
char32_t first_code(std::string_view text) {
    const size_t length = text.empty() ? 0 : utf8_length(text);
    return length == 0 ? 0 : code_of(text.substr(0, length));
}

bool is_part_of_picture(char32_t code, char32_t before, std::string_view rest) {
    if (code == kTextStyle || code == kPictureStyle) return is_picture(before);
    return code == kJoiner && (is_picture(before) || before == kPictureStyle) && is_picture(first_code(rest));
}

std::string braced_code(char32_t code) {
    char digits[8];
    const auto end = std::to_chars(std::begin(digits), std::end(digits), static_cast<uint32_t>(code), 16).ptr;
    return "\\u{" + std::string(digits, end) + "}";
}

/// A backslash of the text itself that reads like the beginning of an escape is one.
std::string with_plain_backslashes(std::string_view bytes) {
    constexpr std::string_view kOpen = "\\u{";
    std::string out;
    for (size_t at = bytes.find(kOpen); at != std::string_view::npos; at = bytes.find(kOpen)) {
        out += bytes.substr(0, at);
        out += "\\u{5c}";
        bytes.remove_prefix(at + 1);
    }
    return out += bytes;
}

std::string braced_code_or_line_break(char32_t code) { return code == '\n' ? "\n" : braced_code(code); }

}  // namespace

std::string without_invisible(std::string_view bytes, std::string (*escape)(char32_t code)) {
    std::string out;
    out.reserve(bytes.size());
    char32_t before = 0;
    while (!bytes.empty()) {
        const auto plain = std::find_if(bytes.begin(), bytes.end(), [](char c) { return c < ' ' || c == kDelete; });
        const auto run = static_cast<size_t>(plain - bytes.begin());  // of ASCII, in one piece; other bytes are below 0
        out += bytes.substr(0, run);
        bytes.remove_prefix(run);
        if (run > 0) before = 0;
        if (bytes.empty()) break;
        const size_t length = utf8_length(bytes);
        const std::string_view character = bytes.substr(0, std::max<size_t>(1, length));
        bytes.remove_prefix(character.size());
        const char32_t code = length == 0 ? 0xFFFD : code_of(character);
        if (length == 0)
            out += "\xEF\xBF\xBD";
        else if (is_invisible(code) && !is_part_of_picture(code, before, bytes))
            out += escape(code);
        else
            out += character;
        before = code;
    }
    return out;
}

std::string visible(std::string_view bytes) {
    return without_log_commands(without_invisible(with_plain_backslashes(bytes), braced_code), "\\u{23}");
}

std::string visible_lines(std::string_view message) {
    return without_log_commands(without_invisible(message, braced_code_or_line_break), "\\u{23}");
}

std::string without_log_commands(std::string text, std::string_view sign) {
    for (size_t at = text.find("##"); at != std::string::npos; at = text.find("##", at + 1)) {
        size_t end = at + 2;
        while (end < text.size() && text[end] >= 'a' && text[end] <= 'z') ++end;
        if (end < text.size() && text[end] == '[') text.replace(at + 1, 1, sign);
    }
    return text;
}

size_t leading_blanks(std::string_view text) {
    constexpr std::array<Range, 9> kBlanks = {{{0x9, 0xD},
                                               {0x20, 0x20},
                                               {0x85, 0x85},
                                               {0xA0, 0xA0},
                                               {0x1680, 0x1680},
                                               {0x2000, 0x200B},
                                               {0x2028, 0x202F},
                                               {0x205F, 0x205F},
                                               {0x3000, 0x3000}}};
    const size_t all = text.size();
    while (!text.empty()) {
        const char32_t code = first_code(text);
        const bool blank = std::any_of(kBlanks.begin(), kBlanks.end(),
                                       [&](const Range& range) { return code >= range.first && code <= range.last; });
        if (!blank) break;
        text.remove_prefix(utf8_length(text));
    }
    return all - text.size();
}

}  // namespace metrics
