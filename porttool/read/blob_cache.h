// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>

namespace porttool {

/// What was computed from contents that never change, by a hash of these contents: a cache that may be deleted at any
/// time. Its file has one line an entry, each with a checksum; a line that is damaged, and a file of another build
/// of the program or of another normal form, count as not there. Several threads may find and put at once.
class BlobCache {
public:
    BlobCache() = default;
    explicit BlobCache(const std::string& file);

    /// The key for some contents; equal for equal parts only.
    static std::string key(std::initializer_list<std::string_view> parts);

    /// The value of a key, or nullptr.
    const std::string* find(const std::string& key);
    /// `value` must not contain line breaks. What a key has already stays.
    void put(const std::string& key, std::string value);

    /// True if there is something to store.
    bool changed() const { return changed_; }
    /// The file, sorted. One above `limit` bytes keeps only what this run has used.
    std::string file(size_t limit) const;

private:
    std::unique_ptr<std::mutex> mutex_ = std::make_unique<std::mutex>();
    std::unordered_map<std::string, std::string> entries_;
    std::set<std::string> used_;
    bool changed_ = false;
};

}  // namespace porttool
