// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace porttool {

/// A list of plain values that is made at once and does not grow. It takes a pointer, a third of what a vector does,
/// and nothing else while it is empty: for what has many lists of which most are empty, a million times.
template <class T>
class ShortList {
    static_assert(std::is_trivially_copyable_v<T> && alignof(T) <= sizeof(uint32_t));

public:
    using value_type = T;

    ShortList() = default;
    ShortList(const std::vector<T>& items) : ShortList(items.data(), items.size()) {}
    ShortList(const ShortList& other) : ShortList(other.data(), other.size()) {}
    ShortList(ShortList&&) noexcept = default;
    ShortList& operator=(const ShortList& other) { return *this = ShortList(other); }
    ShortList& operator=(ShortList&&) noexcept = default;
    ~ShortList() = default;

    size_t size() const {
        uint32_t size = 0;
        if (bytes_ != nullptr) std::memcpy(&size, bytes_.get(), sizeof(size));
        return size;
    }
    bool empty() const { return bytes_ == nullptr; }
    const T* data() const { return empty() ? nullptr : reinterpret_cast<const T*>(bytes_.get() + sizeof(uint32_t)); }
    T* data() { return const_cast<T*>(std::as_const(*this).data()); }
    const T* begin() const { return data(); }
    const T* end() const { return data() + size(); }
    T* begin() { return data(); }
    T* end() { return data() + size(); }
    const T& operator[](size_t i) const { return data()[i]; }
    const T& back() const { return data()[size() - 1]; }
    std::vector<T> copy() const { return {begin(), end()}; }

    bool operator==(const ShortList& other) const { return std::equal(begin(), end(), other.begin(), other.end()); }

private:
    ShortList(const T* items, size_t count) {
        if (count == 0) return;
        const auto size = static_cast<uint32_t>(count);
        bytes_ = std::make_unique_for_overwrite<std::byte[]>(sizeof(size) + count * sizeof(T));
        std::memcpy(bytes_.get(), &size, sizeof(size));
        std::memcpy(bytes_.get() + sizeof(size), items, count * sizeof(T));
    }

    std::unique_ptr<std::byte[]> bytes_;  ///< how many there are, and they
};

}  // namespace porttool
