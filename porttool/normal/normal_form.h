// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "porttool/normal/normal_text.h"
#include "porttool/scan/unit.h"
#include "porttool/text/fingerprint.h"

namespace porttool {

/// A unit without what is cosmetic: no comments and white space, numbers in one spelling, every controlled statement in
/// braces, its own name replaced by `@`. Two units that differ only cosmetically have the same normal form.
/// Whoever changes what comes out raises kNormalForm (porttool/read/lock_file.h), or recorded texts look edited.
/// `sink` takes it word by word; `token` leads back to the place in the file, and a text lives until the sink returns.
using NormalSink = std::function<void(std::string_view text, uint32_t token)>;
void write_normal_form(const ScannedFile& file, const Unit& unit, const NormalSink& sink);

NormalText normal_form(const ScannedFile& file, const Unit& unit);

/// One spelling per value: `0.0F`, `0.f` and `0.0f` become `0f`; `0x10` becomes `16`.
std::string normal_number(std::string_view text);

/// The value of a number whatever its suffix: `2.0f`, `2.` and `2` are one.
std::string number_value(std::string_view text);

/// The fingerprint of words in their order.
Print fingerprint(const Words& words);

}  // namespace porttool
