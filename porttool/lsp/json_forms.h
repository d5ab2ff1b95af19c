// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>

#include "porttool/lsp/positions.h"

namespace porttool::lsp {

using Json = nlohmann::ordered_json;

/// Codes of JSON-RPC 2.0 and of the Language Server Protocol.
enum class ErrorCode : int {
    ParseError = -32700,
    InvalidRequest = -32600,
    MethodNotFound = -32601,
    InvalidParams = -32602,
    InternalError = -32603,
    ServerNotInitialized = -32002,
    RequestFailed = -32803,
};

/// A request that gets an error for its answer.
class RequestError : public std::runtime_error {
public:
    RequestError(ErrorCode kind, const std::string& message) : std::runtime_error(message), code(kind) {}
    const ErrorCode code;
};

Json range_json(const Range& range);
Json location_json(const std::string& uri, const Range& range);

/// The value behind a path of names, `textDocument`, `uri`; null where something on the way is not there.
const Json& value_at(const Json& value, std::initializer_list<const char*> path);

// The values of a request's parameters. Throw RequestError with InvalidParams, which names the path.
std::string string_at(const Json& value, std::initializer_list<const char*> path);
Position position_at(const Json& value, std::initializer_list<const char*> path);
Range range_at(const Json& value, std::initializer_list<const char*> path);

}  // namespace porttool::lsp
