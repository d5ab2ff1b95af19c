// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace porttool {

/// What tells one build of the program from another; "" where nothing does. What was computed by another build is not
/// taken from a cache.
std::string this_program();

/// The user's folder for what can be made anew (XDG Base Directory Specification), or "" where the environment names
/// none by an absolute path.
std::string xdg_cache_home();

/// Files in `$XDG_CACHE_HOME/porttool/<name>/`: the user's own, nobody else's to read or write, and none where that
/// folder lies in the repository, links followed, or belongs to somebody else. A file is there whole or not at all; of
/// two writers the last one wins. Nothing here fails loudly: without a cache all is as with one, but slower.
class UserCache {
public:
    /// `repository`: the root that must not hold the cache.
    UserCache(const std::string& name, const std::string& repository);

    /// None where the file has more than `most_bytes`: it is none that was written.
    std::optional<std::string> read(const std::string& file, uint64_t most_bytes) const;
    /// Writes a file of pieces, one after the other. Keeps the newest files, at most `most_bytes` in all.
    void write(const std::string& file, const std::vector<std::string_view>& pieces, uint64_t most_bytes) const;

private:
    bool is_ours() const;
    bool make_folder() const;
    void drop_oldest(uint64_t most_bytes) const;

    std::string folder_;  // "" for none
};

}  // namespace porttool
