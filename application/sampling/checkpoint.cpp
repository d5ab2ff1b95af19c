// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/checkpoint.h"

#include <signal.h>

#include <cerrno>
#include <charconv>
#include <system_error>
#include <utility>

#include "application/option_values.h"
#include "application/sampling/sealed_file.h"

namespace application {
namespace {

using render_system::PixelSum;
using render_system::Result;
using render_system::Status;
using std::filesystem::path;

constexpr std::string_view kCheckpointKind = "pathtracer checkpoint 1\n";
static_assert(sizeof(PixelSum) == 48);

/// What the file holds; none where the head says what the bytes do not.
std::optional<Checkpoint> parse(SealedFile& file) {
    const uint64_t width = file.number("width"), height = file.number("height"), samples = file.number("samples");
    const uint64_t first = file.number("first_sample"), squares = file.number("squares");
    const auto run = file.text("run");
    if (width > MAX_SIDE || height > MAX_SIDE || width * height > MAX_PIXELS || samples > MAX_SAMPLES || samples == 0 ||
        first > MAX_SAMPLES || squares > 1 || !run)
        return std::nullopt;
    const uint64_t passes = file.number("passes"), planes = file.number("planes");
    const bool filters = passes != UINT64_MAX;
    if (filters && (passes > samples || planes > MAX_HISTORY_PLANES)) return std::nullopt;
    const uint64_t bytes_per_pixel = sizeof(PixelSum) + (squares == 1 ? sizeof(double) : 0) +
                                     (filters ? planes * sizeof(float) + sizeof(glm::vec4) : 0);
    if (file.left() != width * height * bytes_per_pixel) return std::nullopt;
    Checkpoint checkpoint;
    checkpoint.run = RunIdentity::read(*run);
    checkpoint.first_sample = static_cast<uint32_t>(first);
    checkpoint.sums = SampleSums(static_cast<uint32_t>(width), static_cast<uint32_t>(height), squares == 1);
    checkpoint.sums.samples = static_cast<uint32_t>(samples);
    file.take(checkpoint.sums.pixels);
    file.take(checkpoint.sums.squares);
    if (!filters) return checkpoint;
    KeptPasses& kept = checkpoint.passes.emplace();
    kept.history.frames = static_cast<uint32_t>(passes);
    kept.history.planes.resize(width * height * planes);
    kept.picture.resize(width * height);
    file.take(kept.history.planes);
    file.take(kept.picture);
    return checkpoint;
}

/// The process whose unfinished file this is the name of, and the name that it is to have; 0 where it is none.
std::pair<pid_t, std::string> writer_of(const std::string& name) {
    pid_t process = 0;
    if (!name.starts_with('.')) return {};
    const auto [end, error] = std::from_chars(name.data() + 1, name.data() + name.size(), process);
    if (error != std::errc{} || process <= 0 || *end != '.') return {};
    return {process, std::string(end + 1)};
}

}  // namespace

path checkpoint_of(const path& picture) { return picture.string() + ".checkpoint"; }

Status write_checkpoint(const path& file, const RunIdentity& run, uint32_t first_sample, const SampleSums& sums,
                        const KeptPasses* passes) {
    nlohmann::ordered_json head = {{"run", run.text()},       {"width", sums.width},
                                   {"height", sums.height},   {"first_sample", first_sample},
                                   {"samples", sums.samples}, {"squares", sums.squares.empty() ? 0u : 1u}};
    const size_t pixels = sums.pixels.size();
    size_t size = pixels * (sizeof(PixelSum) + sizeof(double));
    if (passes) {
        head["passes"] = passes->history.frames;
        head["planes"] = passes->history.planes.size() / pixels;
        size += passes->history.planes.size() * sizeof(float) + pixels * sizeof(glm::vec4);
    }
    SealedWriter writer(kCheckpointKind, head, size);
    writer.append(sums.pixels);
    writer.append(sums.squares);
    if (passes) {
        writer.append(passes->history.planes);
        writer.append(passes->picture);
    }
    return writer.write(file);
}

Result<std::optional<Checkpoint>> read_checkpoint(const path& file) {
    auto read = SealedFile::read(file, kCheckpointKind);
    if (!read.ok()) return read.status;
    if (!*read) return std::optional<Checkpoint>();
    auto checkpoint = parse(**read);
    if (!checkpoint) return SealedFile::damaged(file, "the checkpoint is damaged (its sizes are wrong)");
    return checkpoint;
}

void remove_abandoned(const path& folder, const std::function<bool(const std::string&)>& is_ours) {
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder.empty() ? "." : folder, error)) {
        const auto [writer, name] = writer_of(entry.path().filename().string());
        if (writer != 0 && is_ours(name) && kill(writer, 0) != 0 && errno == ESRCH)
            std::filesystem::remove(entry.path(), error);
    }
}

void remove_abandoned(const path& file) {
    remove_abandoned(file.parent_path(), [&](const std::string& name) { return name == file.filename().string(); });
}

}  // namespace application
