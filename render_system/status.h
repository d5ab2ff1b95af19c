// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace render_system {

/// Why a call could not be done. Nothing below `application/` prints or exits; it answers one of these.
enum class StatusCode {
    ok,
    invalid_argument,  ///< the data handed over is malformed; the message names the place
    wrong_order,       ///< a call came before one that it needs
    not_found,         ///< a file or an id that does not exist
    unreadable,        ///< a file that exists but cannot be understood
    no_core,           ///< the module of a core is missing or refused
    no_device,         ///< no device on this machine can run the core; one reason per device looked at
    out_of_memory,     ///< does not fit the core's byte budget; needed_bytes and allowed_bytes are set
    device_lost,       ///< the device failed while working
    called_off,        ///< the caller did not want it any more
    internal,          ///< a bug of ours, e.g. a kernel that does not compile
};

/// Result of a call that can fail in normal life: a code and one or two lines for a person.
struct [[nodiscard]] Status {
    StatusCode code = StatusCode::ok;
    std::string message;
    uint64_t needed_bytes = 0;   ///< out_of_memory only
    uint64_t allowed_bytes = 0;  ///< out_of_memory only

    bool ok() const { return code == StatusCode::ok; }

    static Status success() { return {}; }
    static Status error(StatusCode code, std::string message) { return {code, std::move(message), 0, 0}; }
    static Status invalid(std::string message) { return error(StatusCode::invalid_argument, std::move(message)); }
    static Status out_of_memory(std::string message, uint64_t needed, uint64_t allowed) {
        return {StatusCode::out_of_memory, std::move(message), needed, allowed};
    }
};

/// A value, or the status that says why there is none.
template <class T>
struct [[nodiscard]] Result {
    std::optional<T> value;
    Status status;

    Result(T value_in) : value(std::move(value_in)) {}
    Result(Status status_in) : status(std::move(status_in)) {}

    bool ok() const { return value.has_value(); }
    T& operator*() { return *value; }
    const T& operator*() const { return *value; }
    T* operator->() { return &*value; }
    const T* operator->() const { return &*value; }
};

}  // namespace render_system
