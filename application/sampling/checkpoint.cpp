// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/checkpoint.h"

#include <fmt/format.h>
#include <signal.h>

#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <type_traits>

#include "application/file_output.h"
#include "application/option_values.h"
#include "application/sampling/scene_digest.h"

namespace application {
namespace {

using render_system::PixelSum;
using render_system::Result;
using render_system::Status;
using render_system::StatusCode;
using std::filesystem::path;

// The file: this line, a line of JSON, the sums, the squares, and the digest of all that in 16 digits.
constexpr std::string_view kFirstLine = "pathtracer checkpoint 1\n";
constexpr size_t kDigestLength = 16;
static_assert(std::is_trivially_copyable_v<PixelSum> && sizeof(PixelSum) == 48);
static_assert(std::endian::native == std::endian::little, "the sums are stored as they lie in memory");

template <class Element>
void append(std::string& bytes, const std::vector<Element>& values) {
    bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Element));
}

template <class Element>
void take(std::string_view& bytes, std::vector<Element>& values) {
    const size_t size = values.size() * sizeof(Element);
    std::memcpy(values.data(), bytes.data(), size);
    bytes.remove_prefix(size);
}

std::string digest_of(std::string_view bytes) {
    Digest digest;
    digest.add(bytes);
    return digest.hex();
}

Status damaged(const path& file, const std::string& what) {
    return Status::error(StatusCode::unreadable,
                         fmt::format("{}: {}; delete it to start anew, or leave --resume out", file.string(), what));
}

/// Everything behind the first line; none where the JSON says what the bytes do not hold.
std::optional<Checkpoint> parse(std::string_view bytes) {
    const size_t end = bytes.find('\n');
    if (end == std::string_view::npos) return std::nullopt;
    const auto head = nlohmann::json::parse(bytes.substr(0, end), nullptr, false);
    bytes.remove_prefix(end + 1);
    const auto number = [&head](const char* name) -> uint64_t {
        return head.is_object() && head.contains(name) && head[name].is_number_unsigned() ? head[name].get<uint64_t>()
                                                                                          : UINT64_MAX;
    };
    const uint64_t width = number("width"), height = number("height"), samples = number("samples");
    const uint64_t first = number("first_sample"), squares = number("squares");
    if (width > MAX_SIDE || height > MAX_SIDE || width * height > MAX_PIXELS || samples > MAX_SAMPLES || samples == 0 ||
        first > MAX_SAMPLES || squares > 1 || !head.contains("run") || !head["run"].is_string())
        return std::nullopt;
    const uint64_t bytes_per_pixel = sizeof(PixelSum) + (squares == 1 ? sizeof(double) : 0);
    if (bytes.size() != width * height * bytes_per_pixel) return std::nullopt;
    Checkpoint checkpoint;
    checkpoint.run = RunIdentity::read(head["run"].get<std::string>());
    checkpoint.first_sample = static_cast<uint32_t>(first);
    checkpoint.sums = SampleSums(static_cast<uint32_t>(width), static_cast<uint32_t>(height), squares == 1);
    checkpoint.sums.samples = static_cast<uint32_t>(samples);
    take(bytes, checkpoint.sums.pixels);
    take(bytes, checkpoint.sums.squares);
    return checkpoint;
}

/// The process whose unfinished file this is the name of, where it is one of `file`; else 0.
pid_t writer_of(const std::string& name, const path& file) {
    pid_t process = 0;
    if (!name.starts_with('.')) return 0;
    const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), process);
    return error == std::errc{} && process > 0 && std::string(end) == "." + file.filename().string() ? process : 0;
}

}  // namespace

path checkpoint_of(const path& picture) { return picture.string() + ".checkpoint"; }

Status write_checkpoint(const path& file, const RunIdentity& run, uint32_t first_sample, const SampleSums& sums) {
    const nlohmann::ordered_json head = {{"run", run.text()},       {"width", sums.width},
                                         {"height", sums.height},   {"first_sample", first_sample},
                                         {"samples", sums.samples}, {"squares", sums.squares.empty() ? 0u : 1u}};
    std::string bytes(kFirstLine);
    bytes.reserve(bytes.size() + sums.pixels.size() * (sizeof(PixelSum) + sizeof(double)) + 4096);
    bytes += head.dump(-1, ' ', true) + "\n";
    append(bytes, sums.pixels);
    append(bytes, sums.squares);
    bytes += digest_of(bytes);
    return write_file_durably(file, bytes);
}

Result<std::optional<Checkpoint>> read_checkpoint(const path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return std::optional<Checkpoint>();
    if (!std::filesystem::is_regular_file(file, error)) return damaged(file, "it is no file");
    std::ifstream stream(file, std::ios::binary);
    std::string bytes(std::filesystem::file_size(file, error), '\0');
    if (!stream || error || !stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())))
        return damaged(file, "it cannot be read");
    std::string_view rest = bytes;
    if (!rest.starts_with(kFirstLine)) return damaged(file, "it is no checkpoint that this version can read");
    const size_t length = rest.size() < kDigestLength ? 0 : rest.size() - kDigestLength;
    if (digest_of(rest.substr(0, length)) != rest.substr(length))
        return damaged(file, "the checkpoint is damaged (its checksum is wrong)");
    rest = rest.substr(kFirstLine.size(), length - kFirstLine.size());
    auto checkpoint = parse(rest);
    if (!checkpoint) return damaged(file, "the checkpoint is damaged (its sizes are wrong)");
    return checkpoint;
}

void remove_abandoned(const path& file) {
    std::error_code error;
    const path folder = file.has_parent_path() ? file.parent_path() : path(".");
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        const pid_t writer = writer_of(entry.path().filename().string(), file);
        if (writer != 0 && kill(writer, 0) != 0 && errno == ESRCH) std::filesystem::remove(entry.path(), error);
    }
}

}  // namespace application
