// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/sealed_file.h"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "application/file_output.h"
#include "application/sampling/scene_digest.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;
using render_system::StatusCode;
using std::filesystem::path;

constexpr size_t kDigestLength = 16;

std::string digest_of(std::string_view bytes) {
    Digest digest;
    digest.add(bytes);
    return digest.hex();
}

}  // namespace

SealedWriter::SealedWriter(std::string_view kind, const nlohmann::ordered_json& head, size_t size) {
    bytes_.reserve(size + 4096);
    bytes_ = kind;
    bytes_ += head.dump(-1, ' ', true) + "\n";
}

Status SealedWriter::write(const path& file) {
    bytes_ += digest_of(bytes_);
    return write_file_durably(file, bytes_);
}

Status SealedFile::damaged(const path& file, const std::string& what) {
    return Status::error(StatusCode::unreadable,
                         fmt::format("{}: {}; delete it to start anew, or leave --resume out", file.string(), what));
}

Result<std::optional<SealedFile>> SealedFile::read(const path& file, std::string_view kind) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return std::optional<SealedFile>();
    if (!std::filesystem::is_regular_file(file, error)) return damaged(file, "it is no file");
    SealedFile read;
    std::string& bytes = read.bytes_;
    std::ifstream stream(file, std::ios::binary);
    bytes.resize(std::filesystem::file_size(file, error));
    if (!stream || error || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        return damaged(file, "it cannot be read");
    if (!bytes.starts_with(kind)) return damaged(file, "it is no checkpoint that this version can read");
    read.end_ = bytes.size() < kDigestLength ? 0 : bytes.size() - kDigestLength;
    if (digest_of(std::string_view(bytes).substr(0, read.end_)) != bytes.substr(read.end_))
        return damaged(file, "the checkpoint is damaged (its checksum is wrong)");
    const size_t head = bytes.find('\n', kind.size());
    if (head >= read.end_) return damaged(file, "the checkpoint is damaged (it has no head)");
    read.head_ = nlohmann::json::parse(bytes.substr(kind.size(), head - kind.size()), nullptr, false);
    read.place_ = head + 1;
    return std::optional<SealedFile>(std::move(read));
}

uint64_t SealedFile::number(const char* name) const {
    const bool there = head_.is_object() && head_.contains(name) && head_[name].is_number_unsigned();
    return there ? head_[name].get<uint64_t>() : UINT64_MAX;
}

std::optional<std::string> SealedFile::text(const char* name) const {
    if (!head_.is_object() || !head_.contains(name) || !head_[name].is_string()) return std::nullopt;
    return head_[name].get<std::string>();
}

}  // namespace application
