// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace render_system {

bool is_data_uri(std::string_view uri);

/// The bytes of a data URI (RFC 2397), base64 or percent-encoded. Throws LoadError, with `place`.
std::vector<std::byte> decode_data_uri(std::string_view uri, const std::string& place);

/// Whether a scene may name files outside its folder.
enum class Reach { folder, anywhere };

/// The file that a relative or `file:` URI names, seen from `folder`; percent-encoding is undone. With Reach::folder,
/// one that leads out of `folder`, links followed, is refused as hostile: absolute, `file:`, through `..` (with either
/// slash) or through a symbolic link. Throws LoadError, with `place`, also for any other scheme, e.g. http.
std::filesystem::path file_of_uri(std::string_view uri, const std::filesystem::path& folder, Reach reach,
                                  const std::string& place);

}  // namespace render_system
