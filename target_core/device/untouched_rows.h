// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <memory>
#include <new>
#include <span>

namespace target_core {

/// A large table of zeros that costs nothing before it is used: the system makes its memory where a thread first
/// writes, so that threads share that work. It begins where a page of memory does.
template <class Row>
class UntouchedRows {
public:
    /// So many rows of zeros in place of those there are. Throws std::bad_alloc.
    void make(size_t count) {
        rows_.reset();
        if (count == 0) return;
        const size_t bytes = count * sizeof(Row);
        void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
        if (memory == MAP_FAILED) throw std::bad_alloc();
        madvise(memory, bytes, MADV_HUGEPAGE);  // if it may: a picture's pages are thousands
        rows_ = {static_cast<Row*>(memory), Unmap{count}};
    }
    void swap(UntouchedRows& other) { rows_.swap(other.rows_); }

    /// As `make`, unless there are so many; its memory if it is new.
    std::span<std::byte> ensure(size_t count) {
        if (size() == count) return {};
        make(count);
        return std::as_writable_bytes(std::span(data(), count));
    }

    Row* data() const { return rows_.get(); }
    size_t size() const { return rows_ ? rows_.get_deleter().count : 0; }
    size_t bytes() const { return size() * sizeof(Row); }

private:
    struct Unmap {
        size_t count = 0;
        void operator()(Row* rows) const { munmap(rows, count * sizeof(Row)); }
    };
    std::unique_ptr<Row, Unmap> rows_;
};

}  // namespace target_core
