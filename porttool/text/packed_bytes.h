// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace porttool {

/// Numbers and texts one after the other, for files that this machine alone reads.
class ByteWriter {
public:
    explicit ByteWriter(std::string& out) : out_(out) {}
    template <class Number>
    void number(Number value) {
        out_.append(reinterpret_cast<const char*>(&value), sizeof(value));
    }
    /// A text, its size before it.
    void text(std::string_view text) {
        number<uint64_t>(text.size());
        out_ += text;
    }

private:
    std::string& out_;
};

/// Takes numbers and texts from bytes; once they do not suffice, all that follows is empty.
class ByteReader {
public:
    explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

    template <class Number>
    Number number() {
        Number value{};
        const std::string_view taken = take(sizeof(value));
        if (sound_) std::memcpy(&value, taken.data(), sizeof(value));
        return value;
    }
    std::string_view text() { return take(number<uint64_t>()); }
    std::string_view take(uint64_t size) {
        if (size > bytes_.size()) {
            sound_ = false;
            bytes_ = {};
            return {};
        }
        const std::string_view taken = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return taken;
    }
    size_t left() const { return bytes_.size(); }
    bool at_end() const { return bytes_.empty(); }
    bool sound() const { return sound_; }

private:
    std::string_view bytes_;
    bool sound_ = true;
};

}  // namespace porttool
