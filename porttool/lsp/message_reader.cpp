// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/message_reader.h"

#include <algorithm>
#include <charconv>

#include "porttool/text/letters.h"

namespace porttool::lsp {
namespace {

constexpr size_t kMostHead = 4096;
/// More than the largest source that is read, written as JSON.
constexpr size_t kMostBody = 128ull * 1024 * 1024;
constexpr std::string_view kLengthName = "content-length:";

/// The number behind `Content-Length:` in a line, where it stands at its beginning, or, for who has lost the place,
/// anywhere. None where that name is not there; the number is empty where it is none.
std::optional<std::optional<size_t>> length_in(std::string_view line, bool anywhere) {
    const std::string lower = in_small_letters(line);
    const size_t at = anywhere ? lower.rfind(kLengthName) : lower.find(kLengthName);
    if (at == std::string::npos || (at != 0 && !anywhere)) return std::nullopt;
    size_t first = at + kLengthName.size();
    while (first < line.size() && (line[first] == ' ' || line[first] == '\t')) ++first;
    size_t value = 0;
    const auto [end, error] = std::from_chars(line.data() + first, line.data() + line.size(), value);
    const std::string_view rest(end, static_cast<size_t>(line.data() + line.size() - end));
    if (error != std::errc() || rest.find_first_not_of(" \t\r") != std::string_view::npos)
        return std::optional<size_t>();
    return value;
}

}  // namespace

/// Reads the head, if it is there as a whole; false if it is not.
bool MessageReader::read_head(std::optional<IncomingMessage>& problem) {
    const auto lose = [&](const char* why) {
        if (!is_lost_) problem = IncomingMessage{"", why};
        is_lost_ = true;
    };
    std::optional<size_t> length;
    for (size_t at = 0;;) {
        const size_t end = buffer_.find('\n', at);
        if (end == std::string::npos) {
            if (buffer_.size() - at <= kMostHead) return false;
            lose("the head of a message is too long");
            // What could be the beginning of the name stays.
            buffer_.erase(0, buffer_.size() - kLengthName.size());
            return problem.has_value();
        }
        std::string_view line(buffer_.data() + at, end - at);
        if (line.ends_with('\r')) line.remove_suffix(1);
        at = end + 1;
        if (length && at > kMostHead && !line.empty()) {  // as where Content-Length comes again and again
            buffer_.erase(0, at);
            lose("the head of a message is too long");
            return true;
        }
        if (const auto found = length_in(line, is_lost_)) {
            if (!*found) {
                buffer_.erase(0, at);
                lose("Content-Length is no number");
                return true;
            }
            length = **found;
        } else if (line.empty() && length) {
            buffer_.erase(0, at);
            is_lost_ = false;
            if (*length <= kMostBody) {
                length_ = *length;
            } else {
                skip_ = *length;
                problem = IncomingMessage{"", "a message of more than 128 MiB"};
            }
            return true;
        } else if (line.empty() || at > kMostHead) {
            buffer_.erase(0, at);
            lose("a message without Content-Length");
            return true;
        }
    }
}

std::optional<IncomingMessage> MessageReader::next() {
    for (;;) {
        const size_t skipped = std::min(skip_, buffer_.size());
        buffer_.erase(0, skipped);
        skip_ -= skipped;
        if (skip_ > 0) return std::nullopt;
        if (!length_) {
            std::optional<IncomingMessage> problem;
            if (!read_head(problem)) return std::nullopt;
            if (problem) return problem;
            continue;
        }
        if (buffer_.size() < *length_) return std::nullopt;
        IncomingMessage out{buffer_.substr(0, *length_), ""};
        buffer_.erase(0, *length_);
        length_.reset();
        return out;
    }
}

std::string framed(const std::string& body) {
    return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

}  // namespace porttool::lsp
