// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace porttool::lsp {

/// A message's JSON, or what is wrong with its head.
struct IncomingMessage {
    std::string body;
    std::string problem;
};

/// Cuts a stream of bytes into messages as the base protocol has them: `Content-Length: N`, an empty line, N bytes of
/// JSON (Language Server Protocol 3.17, "Base Protocol"). After a head without a usable length it goes on at the next
/// `Content-Length`.
class MessageReader {
public:
    void add(std::string_view bytes) { buffer_ += bytes; }
    /// The next message that is there as a whole.
    std::optional<IncomingMessage> next();

private:
    bool read_head(std::optional<IncomingMessage>& problem);

    std::string buffer_;
    std::optional<size_t> length_;  ///< of the body that follows
    size_t skip_ = 0;               ///< bytes of a body that is too long
    bool is_lost_ = false;          ///< between two messages, after a bad head
};

/// A message with its head.
std::string framed(const std::string& body);

}  // namespace porttool::lsp
