// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <new>
#include <string>

#include "render_system/loader/file_bytes.h"
#include "render_system/loader/image_reader.h"
#include "render_system/loader/load_error.h"
#include "render_system/scene_loader.h"

namespace render_system {

namespace {

// The largest half: what HDR writers put where a light is too bright for them.
constexpr float BRIGHTEST = 65504.0f;

// Makes a texel something that light can be; answers whether it was not.
bool repair(glm::vec4& texel) {
    bool changed = false;
    for (int i = 0; i < 3; ++i) {
        if (std::isfinite(texel[i]) && texel[i] >= 0.0f) continue;
        texel[i] = texel[i] > 0.0f ? BRIGHTEST : 0.0f;
        changed = true;
    }
    texel.w = 1.0f;
    return changed;
}

}  // namespace

Result<Sky> load_sky(const std::filesystem::path& path, std::vector<std::string>* warnings) {
    try {
        const FileBytes file(path);
        Image image = read_image(file.bytes(), path.string());
        if (!image.is_hdr) fail_at("", "is no HDR image; a sky is an equirectangular .hdr or .exr file");
        size_t repaired = 0;
        for (glm::vec4& texel : image.floats) repaired += repair(texel) ? 1 : 0;
        if (repaired > 0 && warnings) {
            warnings->push_back(path.string() + ": " + std::to_string(repaired) +
                                " texels are negative, infinite or NaN; negative and NaN are taken as 0, infinite as " +
                                std::to_string(static_cast<int>(BRIGHTEST)));
        }
        Sky sky;
        sky.width = image.width;
        sky.height = image.height;
        sky.texels = std::move(image.floats);
        return sky;
    } catch (const LoadError& error) {
        return Status::error(error.code, path.string() + ": " + error.message);
    } catch (const std::bad_alloc&) {
        return Status::error(StatusCode::unreadable, path.string() + ": the map does not fit this machine's memory");
    } catch (const std::exception& error) {
        return Status::error(StatusCode::unreadable, path.string() + ": cannot be read (" + error.what() + ")");
    }
}

}  // namespace render_system
