// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/spirv/spirv_check.h"

#include <algorithm>

#include "porttool/read/tracked.h"
#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// What a shader can include.
bool is_shader_text(const std::string& path) {
    return language_of_path(path) != Language::Unknown || path.ends_with(".inc") || path.ends_with(".def");
}

}  // namespace

/// The files of one side, each read once.
struct SpirvCheck::Shaders {
    std::string root;
    bool sources_only = false;
    std::map<std::string, std::optional<std::string>> now;
    std::optional<GitFiles> then;
    std::optional<SpirvComparer> comparer;
};

SpirvCheck::SpirvCheck(const Snapshot& snapshot, std::string base, const Disk& disk)
    : snapshot_(snapshot), project_(snapshot.project), base_(std::move(base)), disk_(disk) {
    if (!spirv_is_built_in())
        throw CannotDo(
            "--spirv: this porttool was built without glslang\nInstall glslang-dev, spirv-tools and spirv-headers, and "
            "build it anew; or check without --spirv");
}

SpirvCheck::~SpirvCheck() = default;

SpirvCheck::Shaders& SpirvCheck::shaders_of(Side side) {
    std::unique_ptr<Shaders>& slot = shaders_[side];
    if (slot) return *slot;
    slot = std::make_unique<Shaders>();
    Shaders& shaders = *slot;
    const bool source = side == Side::Source;
    shaders.root = source ? project_.root : target_root(project_);
    shaders.sources_only = !source && is_elsewhere(project_);
    std::vector<std::string> entries;
    if (snapshot_.at.kind == Moment::Kind::Index && (source || project_.map.target_root.empty())) {
        GitFiles staged = GitRepository(shaders.root, kChecksWithGit).files_in_index(is_shader_text);
        if (!staged.error.empty()) throw CannotDo(staged.error);
        for (auto& [path, text] : staged.files) {
            if (stage_of_path(path)) entries.push_back(path);
            shaders.now[path] = std::move(text);
        }
        shaders.comparer.emplace(ShaderSide{[&shaders](const std::string& path) {
                                                const auto found = shaders.now.find(path);
                                                return found == shaders.now.end() ? nullptr : &*found->second;
                                            },
                                            std::move(entries), project_.map.shaders});
        return shaders;
    }
    std::vector<std::string> unmatched;
    SourceSet read = read_globs(disk_, shaders.root, shader_entry_globs(), unmatched);
    for (SourceText& file : read.files) {
        entries.push_back(file.path);
        shaders.now[file.path] = std::move(file.text);
    }
    shaders.comparer.emplace(ShaderSide{[this, &shaders](const std::string& path) -> const std::string* {
                                            if (shaders.sources_only && !is_shader_text(path)) return nullptr;
                                            const auto [at, fresh] = shaders.now.try_emplace(path);
                                            if (fresh) {
                                                FileText file = disk_.read(TreePath{shaders.root, path}, kLargestFile);
                                                if (file.error.empty() && !file.by_link)
                                                    file.error = untracked_reason(shaders.root, path);
                                                if (file.error.empty()) at->second = std::move(file.bytes);
                                            }
                                            return at->second ? &*at->second : nullptr;
                                        },
                                        std::move(entries), project_.map.shaders});
    return shaders;
}

/// First with this function's earlier text alone among today's files. Where that does not compile, as after a renaming
/// of what it uses, with git's earlier files, if they hold the text that the pair was in step with.
SpirvAnswer SpirvCheck::ask(Shaders& shaders, const ScannedFile& file, const Unit& unit, const NormalText& before) {
    SpirvAnswer answer = shaders.comparer->compare_unit(file, unit, before);
    if (answer.obstacle.empty() || answer.entries.empty()) return answer;
    if (!shaders.then) shaders.then = GitRepository(shaders.root, kChecksWithGit).files_at_base(base_, is_shader_text);
    if (!shaders.then->error.empty()) {
        answer.obstacle += "; and there are no earlier files to compare as a whole: " +
                           shaders.then->error.substr(0, shaders.then->error.find('\n'));
        return answer;
    }
    const auto old_file = shaders.then->files.find(file.path);
    if (old_file == shaders.then->files.end()) return answer;
    const ScannedFile scanned = scan_text(file.path, old_file->second);
    const bool same_text = std::any_of(scanned.units.begin(), scanned.units.end(),
                                       [&](const Unit& old) { return unit_state(scanned, old).text.get() == before; });
    if (!same_text) return answer;
    const SpirvAnswer whole =
        shaders.comparer->compare_files(file, unit, [&shaders](const std::string& path) -> const std::string* {
            const auto found = shaders.then->files.find(path);
            return found == shaders.then->files.end() ? nullptr : &found->second;
        });
    return whole.obstacle.empty() ? whole : answer;
}

std::string SpirvCheck::same_code(const UnitState& unit, Side side, const NormalText& before) {
    const FilesOfSide files = snapshot_.files(side);
    size_t at = 0;
    while (at < files.size() && files.path(at) != unit.file) ++at;
    if (at == files.size()) return {};
    const ScannedFile* const file = &files.scanned(at);
    if (file->language != Language::Glsl) return {};
    const auto found = std::find_if(file->units.begin(), file->units.end(),
                                    [&](const Unit& u) { return unit_id(*file, u) == unit.id; });
    if (found == file->units.end()) return {};
    if (found->kind != UnitKind::Function && found->kind != UnitKind::Kernel) return {};
    const SpirvAnswer answer = ask(shaders_of(side), *file, *found, before);
    if (!answer.obstacle.empty()) obstacles_.push_back("--spirv: " + unit.id + " keeps its level: " + answer.obstacle);
    if (!answer.same) return {};
    std::string entries;
    for (const std::string& entry : answer.entries) entries += (entries.empty() ? "" : ", ") + entry;
    return "compiles to the same SPIR-V as before (" + entries + ")";
}

}  // namespace porttool
