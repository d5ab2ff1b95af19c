// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/spirv/spirv_check.h"

#include <algorithm>

#include "porttool/scan/scan.h"

namespace porttool {
namespace {

/// What a shader can include.
bool is_shader_text(const std::string& path) {
    return language_of_path(path) != Language::Unknown || path.ends_with(".inc") || path.ends_with(".def");
}

}  // namespace

/// The files of one side, each read once.
struct SpirvCheck::Side {
    std::string root;
    bool sources_only = false;
    std::map<std::string, std::optional<std::string>> now;
    std::optional<GitFiles> then;
    std::optional<SpirvComparer> comparer;
};

SpirvCheck::SpirvCheck(const Project& project, bool staged, std::string base, const Disk& disk)
    : project_(project), staged_(staged), base_(std::move(base)), disk_(disk) {
    if (!spirv_is_built_in())
        throw CannotDo(
            "--spirv: this porttool was built without glslang\nInstall glslang-dev, spirv-tools and spirv-headers, and "
            "build it anew; or check without --spirv");
}

SpirvCheck::~SpirvCheck() = default;

SpirvCheck::Side& SpirvCheck::side(bool source) {
    std::unique_ptr<Side>& slot = source ? source_ : target_;
    if (slot) return *slot;
    slot = std::make_unique<Side>();
    Side& side = *slot;
    side.root = source ? project_.root : target_root(project_);
    side.sources_only = !source && is_elsewhere(project_);
    std::vector<std::string> entries;
    if (staged_ && (source || project_.map.target_root.empty())) {
        GitFiles staged = GitRepository(side.root, kChecksWithGit).files_in_index(is_shader_text);
        if (!staged.error.empty()) throw CannotDo(staged.error);
        for (auto& [path, text] : staged.files) {
            if (stage_of_path(path)) entries.push_back(path);
            side.now[path] = std::move(text);
        }
        side.comparer.emplace(ShaderSide{[&side](const std::string& path) {
                                             const auto found = side.now.find(path);
                                             return found == side.now.end() ? nullptr : &*found->second;
                                         },
                                         std::move(entries), project_.map.shaders});
        return side;
    }
    std::vector<std::string> unmatched;
    SourceSet read = read_globs(disk_, side.root, shader_entry_globs(), unmatched);
    for (SourceText& file : read.files) {
        entries.push_back(file.path);
        side.now[file.path] = std::move(file.text);
    }
    side.comparer.emplace(ShaderSide{[this, &side](const std::string& path) -> const std::string* {
                                         if (side.sources_only && !is_shader_text(path)) return nullptr;
                                         const auto [at, fresh] = side.now.try_emplace(path);
                                         if (fresh) {
                                             FileText file = disk_.read(TreePath{side.root, path}, kLargestFile);
                                             if (file.error.empty()) at->second = std::move(file.bytes);
                                         }
                                         return at->second ? &*at->second : nullptr;
                                     },
                                     std::move(entries), project_.map.shaders});
    return side;
}

/// First with this function's earlier text alone among today's files. Where that does not compile, as after a renaming
/// of what it uses, with git's earlier files, if they hold the text that the pair was in step with.
SpirvAnswer SpirvCheck::ask(Side& side, const ScannedFile& file, const Unit& unit, const NormalText& before) {
    SpirvAnswer answer = side.comparer->compare_unit(file, unit, before);
    if (answer.obstacle.empty() || answer.entries.empty()) return answer;
    if (!side.then) side.then = GitRepository(side.root, kChecksWithGit).files_at_base(base_, is_shader_text);
    if (!side.then->error.empty()) {
        answer.obstacle += "; and there are no earlier files to compare as a whole: " +
                           side.then->error.substr(0, side.then->error.find('\n'));
        return answer;
    }
    const auto old_file = side.then->files.find(file.path);
    if (old_file == side.then->files.end()) return answer;
    const ScannedFile scanned = scan_text(file.path, old_file->second);
    const bool same_text = std::any_of(scanned.units.begin(), scanned.units.end(),
                                       [&](const Unit& old) { return unit_state(scanned, old).text == before; });
    if (!same_text) return answer;
    const SpirvAnswer whole =
        side.comparer->compare_files(file, unit, [&side](const std::string& path) -> const std::string* {
            const auto found = side.then->files.find(path);
            return found == side.then->files.end() ? nullptr : &found->second;
        });
    return whole.obstacle.empty() ? whole : answer;
}

std::string SpirvCheck::same_code(const UnitState& unit, bool source, const NormalText& before) {
    const auto& files = source ? project_.source : project_.target;
    const auto file =
        std::find_if(files.begin(), files.end(), [&](const ScannedFile& f) { return f.path == unit.file; });
    if (file == files.end() || file->language != Language::Glsl) return {};
    const auto found = std::find_if(file->units.begin(), file->units.end(),
                                    [&](const Unit& u) { return unit_id(*file, u) == unit.id; });
    if (found == file->units.end()) return {};
    if (found->kind != UnitKind::Function && found->kind != UnitKind::Kernel) return {};
    const SpirvAnswer answer = ask(side(source), *file, *found, before);
    if (!answer.obstacle.empty()) obstacles_.push_back("--spirv: " + unit.id + " keeps its level: " + answer.obstacle);
    if (!answer.same) return {};
    std::string entries;
    for (const std::string& entry : answer.entries) entries += (entries.empty() ? "" : ", ") + entry;
    return "compiles to the same SPIR-V as before (" + entries + ")";
}

}  // namespace porttool
