// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/uri.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <system_error>

#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

constexpr int BAD = -1;

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return BAD;
}

// Both alphabets of RFC 4648: files in the wild use either.
int base64_digit(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return BAD;
}

// A per cent sign that starts no escape stands for itself: such file names exist.
std::string percent_decoded(std::string_view text) {
    std::string decoded;
    decoded.reserve(text.size());
    for (size_t i = 0; i < text.size(); ++i) {
        const bool escape =
            text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) != BAD && hex_digit(text[i + 2]) != BAD;
        if (escape) {
            decoded.push_back(static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
            i += 2;
        } else {
            decoded.push_back(text[i]);
        }
    }
    return decoded;
}

std::vector<std::byte> base64_decoded(std::string_view text, const std::string& place) {
    while (!text.empty() && text.back() == '=') text.remove_suffix(1);
    std::vector<std::byte> bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    uint32_t bits = 0;
    int count = 0;
    for (char c : text) {
        const int digit = base64_digit(c);
        if (digit == BAD) fail_at(place, "its data URI is not base64" + EXPORT_AGAIN);
        bits = bits << 6 | static_cast<uint32_t>(digit);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes.push_back(static_cast<std::byte>(bits >> count & 0xFFu));
    }
    return bytes;
}

// The scheme of a URI in lower case; a single letter is no scheme but a drive.
std::string scheme_of(std::string_view uri) {
    const size_t colon = uri.find(':');
    if (colon == std::string_view::npos || colon < 2) return {};
    std::string scheme(uri.substr(0, colon));
    const bool valid = std::all_of(scheme.begin(), scheme.end(),
                                   [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
    if (!valid) return {};
    std::transform(scheme.begin(), scheme.end(), scheme.begin(), [](unsigned char c) { return std::tolower(c); });
    return scheme;
}

std::string shown(std::string_view uri) {
    constexpr size_t LONGEST = 80;
    return "\"" + std::string(uri.substr(0, LONGEST)) + (uri.size() > LONGEST ? "..." : "") + "\"";
}

[[noreturn]] void fail_outside(std::string_view uri, const std::string& place) {
    throw LoadError{StatusCode::unreadable,
                    place + ": " + shown(uri) +
                        " leads out of the scene's folder; copy the file into it, or give --allow-outside if you "
                        "trust the scene",
                    true};
}

// Refused whatever lies there: what is absolute, here or on another system, and backslashes that step out.
bool leaves_by_name(std::string name) {
    if (name.size() > 1 && name[1] == ':' && std::isalpha(static_cast<unsigned char>(name[0]))) return true;
    const bool foreign = name.find('\\') != std::string::npos;
    std::replace(name.begin(), name.end(), '\\', '/');
    if (name.front() == '/') return true;
    return foreign && *std::filesystem::path(name).lexically_normal().begin() == "..";
}

// The file behind all links, which must lie below the folder behind all links.
std::filesystem::path file_within(const std::filesystem::path& folder, const std::string& name, std::string_view uri,
                                  const std::string& place) {
    std::error_code error;
    const std::filesystem::path root = std::filesystem::canonical(folder.empty() ? "." : folder, error);
    if (error) return folder / name;  // opening it says why
    const std::filesystem::path file = std::filesystem::weakly_canonical(root / name, error);
    if (error) return folder / name;
    const auto parted = std::mismatch(root.begin(), root.end(), file.begin(), file.end());
    if (parted.first != root.end()) fail_outside(uri, place);
    return folder / file.lexically_relative(root);
}

}  // namespace

bool is_data_uri(std::string_view uri) { return scheme_of(uri.substr(0, 5)) == "data"; }

std::vector<std::byte> decode_data_uri(std::string_view uri, const std::string& place) {
    const size_t comma = uri.find(',');
    if (comma == std::string_view::npos) fail_at(place, "its data URI has no comma before the data" + EXPORT_AGAIN);
    const std::string_view header = uri.substr(0, comma);
    const std::string_view payload = uri.substr(comma + 1);
    constexpr std::string_view BASE64 = ";base64";
    const bool is_base64 = header.size() >= BASE64.size() && header.substr(header.size() - BASE64.size()) == BASE64;
    if (is_base64) {
        // Escapes are rare in base64 and cost a copy of what may be most of the file.
        const bool escaped = payload.find('%') != std::string_view::npos;
        return escaped ? base64_decoded(percent_decoded(payload), place) : base64_decoded(payload, place);
    }
    const std::string decoded = percent_decoded(payload);
    std::vector<std::byte> bytes(decoded.size());
    std::transform(decoded.begin(), decoded.end(), bytes.begin(), [](char c) { return static_cast<std::byte>(c); });
    return bytes;
}

std::filesystem::path file_of_uri(std::string_view uri, const std::filesystem::path& folder, Reach reach,
                                  const std::string& place) {
    const std::string_view whole = uri;
    const std::string scheme = scheme_of(uri);
    if (scheme == "file") {
        if (reach == Reach::folder) fail_outside(whole, place);
        uri.remove_prefix(5);
        if (uri.substr(0, 2) == "//") uri.remove_prefix(std::min(uri.find('/', 2), uri.size()));
    } else if (!scheme.empty()) {
        fail_at(place,
                shown(whole) + " is not a local file; " + scheme + " is not supported: download it and name the copy");
    }
    const std::string decoded = percent_decoded(uri);
    if (decoded.empty()) fail_at(place, "the URI is empty" + EXPORT_AGAIN);
    if (decoded.find('\0') != std::string::npos) fail_at(place, "the URI contains a zero byte" + EXPORT_AGAIN);
    if (reach == Reach::anywhere) return folder / decoded;
    if (leaves_by_name(decoded)) fail_outside(whole, place);
    return file_within(folder, decoded, whole, place);
}

}  // namespace render_system
