// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/read/blob_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "porttool/read/lock_file.h"
#include "porttool/read/user_cache.h"
#include "porttool/text/fingerprint.h"

namespace porttool {
namespace {

constexpr size_t kSumDigits = 16, kKeyDigits = 32;

std::string digits(uint64_t number) {
    std::array<char, kSumDigits + 1> text{};
    std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(number));
    return text.data();
}

/// What an entry means hangs on the whole program: scanner, normal form, comparison and metrics.
std::string header() { return fmt::format("porttool-cache 3 normal-form {} program {}", kNormalForm, this_program()); }

std::string line_of(const std::string& key, const std::string& value) {
    const std::string text = key + " " + value;
    return digits(hash_text(text)) + " " + text + "\n";
}

}  // namespace

BlobCache::BlobCache(const std::string& file) {
    const std::string_view text = file;
    size_t first = text.find('\n');
    if (first == std::string_view::npos || text.substr(0, first) != header()) return;
    for (++first; first < text.size();) {
        const size_t end = text.find('\n', first);
        if (end == std::string_view::npos) return;  // cut off
        const std::string_view line = text.substr(first, end - first);
        first = end + 1;
        constexpr size_t kKeyAt = kSumDigits + 1, kValueAt = kKeyAt + kKeyDigits + 1;
        if (line.size() < kValueAt || line.substr(0, kSumDigits) != digits(hash_text(line.substr(kKeyAt)))) continue;
        entries_.emplace(line.substr(kKeyAt, kKeyDigits), line.substr(kValueAt));
    }
}

std::string BlobCache::key(std::initializer_list<std::string_view> parts) {
    uint64_t one = 1, other = 2;
    for (const std::string_view part : parts) {
        one = hash_text(part, one + part.size());
        other = hash_text(part, other ^ (part.size() << 32));
    }
    return digits(one) + digits(other);
}

const std::string* BlobCache::find(const std::string& key) {
    const std::lock_guard lock(*mutex_);
    const auto found = entries_.find(key);
    if (found == entries_.end()) return nullptr;
    used_.insert(key);
    return &found->second;
}

void BlobCache::put(const std::string& key, std::string value) {
    const std::lock_guard lock(*mutex_);
    changed_ = true;
    used_.insert(key);
    entries_.try_emplace(key, std::move(value));
}

std::string BlobCache::file(size_t limit) const {
    size_t size = 0;
    for (const auto& [key, value] : entries_) size += value.size() + kSumDigits + kKeyDigits + 3;
    std::vector<const std::string*> keys;
    for (const auto& [key, value] : entries_)
        if (size <= limit || used_.contains(key)) keys.push_back(&key);
    std::sort(keys.begin(), keys.end(), [](const std::string* a, const std::string* b) { return *a < *b; });
    std::string out = header() + "\n";
    for (const std::string* key : keys) out += line_of(*key, entries_.at(*key));
    return out;
}

}  // namespace porttool
