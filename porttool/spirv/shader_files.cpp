// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "porttool/spirv/shader_files.h"

#include <algorithm>
#include <array>

#include "porttool/read/disk.h"

namespace porttool {
namespace {

struct StageRow {
    std::string_view suffix;
    ShaderStage stage;
};

constexpr std::array kStages = {
    StageRow{"vert", ShaderStage::Vertex},       StageRow{"vs", ShaderStage::Vertex},
    StageRow{"vsh", ShaderStage::Vertex},        StageRow{"frag", ShaderStage::Fragment},
    StageRow{"fs", ShaderStage::Fragment},       StageRow{"fsh", ShaderStage::Fragment},
    StageRow{"geom", ShaderStage::Geometry},     StageRow{"gsh", ShaderStage::Geometry},
    StageRow{"tesc", ShaderStage::TessControl},  StageRow{"tese", ShaderStage::TessEvaluation},
    StageRow{"comp", ShaderStage::Compute},      StageRow{"rgen", ShaderStage::RayGeneration},
    StageRow{"rint", ShaderStage::Intersection}, StageRow{"rahit", ShaderStage::AnyHit},
    StageRow{"rchit", ShaderStage::ClosestHit},  StageRow{"rmiss", ShaderStage::Miss},
    StageRow{"rcall", ShaderStage::Callable},    StageRow{"mesh", ShaderStage::Mesh},
    StageRow{"task", ShaderStage::Task},
};

std::string folder_of(const std::string& path) {
    const size_t slash = path.find_last_of('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// The name in an `#include "name"` or `<name>` line, or "".
std::string included_name(std::string_view line) {
    auto skip = [&] { line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size())); };
    skip();
    if (!line.starts_with('#')) return {};
    line.remove_prefix(1);
    skip();
    if (!line.starts_with("include")) return {};
    line.remove_prefix(7);
    skip();
    if (line.empty() || (line[0] != '"' && line[0] != '<')) return {};
    const size_t end = line.find(line[0] == '"' ? '"' : '>', 1);
    return end == std::string_view::npos ? std::string() : std::string(line.substr(1, end - 1));
}

}  // namespace

std::optional<ShaderStage> stage_of_path(const std::string& path) {
    std::string_view name = path;
    name.remove_prefix(name.find_last_of('/') + 1);
    if (name.ends_with(".glsl")) name.remove_suffix(5);  // shade.comp.glsl
    const size_t dot = name.find_last_of('.');
    if (dot == std::string_view::npos) return std::nullopt;
    const auto row = std::find_if(kStages.begin(), kStages.end(),
                                  [&](const StageRow& r) { return r.suffix == name.substr(dot + 1); });
    return row == kStages.end() ? std::nullopt : std::optional(row->stage);
}

const std::vector<std::string>& shader_entry_globs() {
    static const std::vector<std::string> globs = [] {
        std::vector<std::string> out;
        for (const StageRow& row : kStages)
            for (const char* tail : {"", ".glsl"}) out.push_back("**/*." + std::string(row.suffix) + tail);
        return out;
    }();
    return globs;
}

std::string find_include(const ShaderFiles& files, const std::string& from, const std::string& name,
                         const std::vector<std::string>& include) {
    std::vector<std::string> folders = {folder_of(from)};
    folders.insert(folders.end(), include.begin(), include.end());
    for (const std::string& folder : folders) {
        const std::string path = clean_path(join_path(folder, name));
        if (files(path) != nullptr) return path;
    }
    return {};
}

std::set<std::string> files_included(const ShaderFiles& files, const std::string& entry,
                                     const std::vector<std::string>& include) {
    std::set<std::string> found = {entry};
    std::vector<std::string> open = {entry};
    while (!open.empty()) {
        const std::string path = open.back();
        open.pop_back();
        const std::string* text = files(path);
        if (text == nullptr) continue;
        for (size_t first = 0; first < text->size();) {
            const size_t end = std::min(text->find('\n', first), text->size());
            const std::string name = included_name(std::string_view(*text).substr(first, end - first));
            first = end + 1;
            if (name.empty()) continue;
            const std::string next = find_include(files, path, name, include);
            if (!next.empty() && found.insert(next).second) open.push_back(next);
        }
    }
    return found;
}

}  // namespace porttool
