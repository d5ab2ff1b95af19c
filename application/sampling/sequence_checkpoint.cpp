// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/sampling/sequence_checkpoint.h"

#include <fmt/format.h>

#include "application/option_values.h"
#include "application/sampling/sealed_file.h"

namespace application {
namespace {

using render_system::Result;
using render_system::Status;

constexpr std::string_view kSequenceKind = "pathtracer sequence 1\n";

}  // namespace

RunIdentity sequence_identity(const Options& options, CoreSession& session) {
    RunIdentity identity = run_identity(options, session);
    identity.entries.insert(identity.entries.end(), {{"--spp", std::to_string(options.spp.front())},
                                                     {"--fps", fmt::format("{}", options.fps)},
                                                     {"the first frame", std::to_string(options.frames->first)},
                                                     {"--filter", "temporal"}});
    return identity;
}

Status write_sequence_checkpoint(const std::filesystem::path& file, const SequenceCheckpoint& checkpoint) {
    const std::vector<float>& planes = checkpoint.history.planes;
    SealedWriter writer(kSequenceKind,
                        {{"run", checkpoint.run.text()},
                         {"frames", checkpoint.frames},
                         {"filtered", checkpoint.history.frames},
                         {"numbers", planes.size()}},
                        planes.size() * sizeof(float));
    writer.append(planes);
    return writer.write(file);
}

Result<std::optional<SequenceCheckpoint>> read_sequence_checkpoint(const std::filesystem::path& file) {
    auto read = SealedFile::read(file, kSequenceKind);
    if (!read.ok()) return read.status;
    if (!*read) return std::optional<SequenceCheckpoint>();
    SealedFile& sealed = **read;
    const uint64_t frames = sealed.number("frames"), filtered = sealed.number("filtered");
    const auto run = sealed.text("run");
    if (!run || frames == 0 || frames > MAX_SAMPLES || filtered == 0 || filtered > frames ||
        sealed.left() % sizeof(float) != 0 || sealed.number("numbers") != sealed.left() / sizeof(float))
        return SealedFile::damaged(file, "the checkpoint is damaged (its sizes are wrong)");
    SequenceCheckpoint checkpoint{RunIdentity::read(*run), static_cast<uint32_t>(frames), {}};
    checkpoint.history.frames = static_cast<uint32_t>(filtered);
    checkpoint.history.planes.resize(sealed.left() / sizeof(float));
    sealed.take(checkpoint.history.planes);
    return std::optional(std::move(checkpoint));
}

}  // namespace application
