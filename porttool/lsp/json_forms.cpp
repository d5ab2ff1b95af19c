// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/lsp/json_forms.h"

#include <limits>

namespace porttool::lsp {
namespace {

Json position_json(Position at) { return {{"line", at.line}, {"character", at.character}}; }

[[noreturn]] void refuse(std::initializer_list<const char*> path, const std::string& expected) {
    std::string name;
    for (const char* part : path) name += (name.empty() ? "" : ".") + std::string(part);
    throw RequestError(ErrorCode::InvalidParams, "params." + name + ": expected " + expected);
}

/// A number of the protocol's `uinteger`.
std::optional<uint32_t> number_in(const Json& value, const char* name) {
    const Json& number = value_at(value, {name});
    if (!number.is_number_integer()) return std::nullopt;
    const auto wide = number.is_number_unsigned() ? number.get<uint64_t>() : std::numeric_limits<uint64_t>::max();
    if (wide > static_cast<uint64_t>(std::numeric_limits<int32_t>::max())) return std::nullopt;
    return static_cast<uint32_t>(wide);
}

std::optional<Position> position_in(const Json& value) {
    const auto line = number_in(value, "line"), character = number_in(value, "character");
    return line && character ? std::optional(Position{*line, *character}) : std::nullopt;
}

}  // namespace

Json range_json(const Range& range) {
    return {{"start", position_json(range.start)}, {"end", position_json(range.end)}};
}

Json location_json(const std::string& uri, const Range& range) { return {{"uri", uri}, {"range", range_json(range)}}; }

const Json& value_at(const Json& value, std::initializer_list<const char*> path) {
    static const Json kNull;
    const Json* at = &value;
    for (const char* name : path) {
        if (!at->is_object()) return kNull;
        const auto found = at->find(name);
        if (found == at->end()) return kNull;
        at = &*found;
    }
    return *at;
}

std::string string_at(const Json& value, std::initializer_list<const char*> path) {
    const Json& found = value_at(value, path);
    if (!found.is_string()) refuse(path, "a string");
    return found.get<std::string>();
}

Position position_at(const Json& value, std::initializer_list<const char*> path) {
    const auto found = position_in(value_at(value, path));
    if (!found) refuse(path, "a position {line, character}");
    return *found;
}

Range range_at(const Json& value, std::initializer_list<const char*> path) {
    const Json& found = value_at(value, path);
    const auto start = position_in(value_at(found, {"start"})), end = position_in(value_at(found, {"end"}));
    if (!start || !end) refuse(path, "a range {start, end}");
    return {*start, *end};
}

}  // namespace porttool::lsp
