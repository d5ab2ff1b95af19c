// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// A name cut into the words that it is made of.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// A name, or an id, cut before each capital letter that follows or precedes a small one, and around each character
/// that is neither letter nor digit: `get`, `Cuda`, `_`, `FFT` and `Plan` of `getCuda_FFTPlan`. Joined they are the
/// name.
std::vector<std::string_view> name_pieces(std::string_view name);

/// The same in small letters, without what stands between: `ggmlOpAdd`, `GGML_OP_ADD` and `ggml_op_add` have the same.
std::vector<std::string> words_of_name(std::string_view name);

}  // namespace porttool
