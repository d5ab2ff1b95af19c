// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "render_system/status.h"

namespace render_system {

/// How a loader gives up. Thrown only inside `loader/`; each public function turns it into a Status at its border.
struct LoadError {
    StatusCode code = StatusCode::unreadable;
    std::string message;   ///< without the file's name, which the border adds
    bool hostile = false;  ///< no flaw of an exporter: the whole file is refused, even where a placeholder would do
};

/// `place` is where in the file, e.g. a JSON pointer; `what` is wrong there and, after a semicolon, what to do.
[[noreturn]] inline void fail_at(const std::string& place, const std::string& what) {
    throw LoadError{StatusCode::unreadable, place.empty() ? what : place + ": " + what};
}

/// The advice where a file contradicts itself.
inline const std::string EXPORT_AGAIN = "; export the file again or see what a glTF validator says";

}  // namespace render_system
