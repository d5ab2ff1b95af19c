// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// The words of a text in small letters: those of letters and digits.
std::vector<std::string> small_words_of(std::string_view text);

/// A literal of the source that became another one, and that of the port which stands for it.
struct LiteralEdit {
    const std::string &was, &is, &there;
};

/// True if the port's literal says most of what the source's said, shows the same values, and has no word of its own
/// but what the source's came to say: what the source says now can stand there as well.
///
///     was      "kernel time on the device: %g"       "file not opened"
///     is       "kernel execution time: %g"           "ERROR: file %s not opened"
///     there    "kernel time the device: %g"          "ERROR: file not opened"
bool may_replace_literal(const LiteralEdit& edit);

/// What the port's literal becomes where words of it are its own, and what changed in the source's stands in it once,
/// between the same neighbours; "" where that is not so, or where what is shown of values changed.
///
///     was      "CUDA assert: %s %d\n"                 is    "CUDA error: %s %d\n"
///     there    "HIP assert: %s %d\n"                  ->    "HIP error: %s %d\n"
std::string literal_changed_alike(const LiteralEdit& edit);

}  // namespace porttool
