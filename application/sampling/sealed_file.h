// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "render_system/status.h"

// What a run keeps so that another can go on from it: a line that names the kind of file, a line of JSON, numbers as
// they lie in memory, and the digest of all that in 16 digits. Such a file is there whole or not at all.

namespace application {

static_assert(std::endian::native == std::endian::little, "numbers are stored as they lie in memory");

/// A file to be written.
class SealedWriter {
public:
    /// `kind` is its first line; about `size` bytes of numbers will follow.
    SealedWriter(std::string_view kind, const nlohmann::ordered_json& head, size_t size);

    template <class Element>
    void append(const std::vector<Element>& values) {
        static_assert(std::is_trivially_copyable_v<Element>);
        bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Element));
    }

    /// Puts it in place of one that is there. Fails as write_file does.
    render_system::Status write(const std::filesystem::path& file);

private:
    std::string bytes_;
};

/// A file that was read, whose digest is right.
class SealedFile {
public:
    /// Nothing where there is no file. Fails where it is torn, altered or of another kind, naming the remedy.
    static render_system::Result<std::optional<SealedFile>> read(const std::filesystem::path& file,
                                                                 std::string_view kind);

    /// Why a file is of no use, with the remedy.
    static render_system::Status damaged(const std::filesystem::path& file, const std::string& what);

    /// A whole number of the head; UINT64_MAX where it has none of that name.
    uint64_t number(const char* name) const;

    /// A text of the head; none where it has none of that name.
    std::optional<std::string> text(const char* name) const;

    /// How many bytes of numbers have not been taken yet.
    size_t left() const { return end_ - place_; }

    /// Fills `values` with the next numbers, of which enough must be left.
    template <class Element>
    void take(std::vector<Element>& values) {
        static_assert(std::is_trivially_copyable_v<Element>);
        const size_t size = values.size() * sizeof(Element);
        std::memcpy(static_cast<void*>(values.data()), bytes_.data() + place_, size);
        place_ += size;
    }

private:
    std::string bytes_;
    nlohmann::json head_;
    size_t place_ = 0;
    size_t end_ = 0;
};

}  // namespace application
