// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "render_system/host_scene.h"

namespace application {

/// 64 bits that tell contents apart (XXH64). Against slips, not against forgers.
class Digest {
public:
    void add_bytes(const void* bytes, size_t size);
    void add(std::string_view text);
    uint64_t value() const { return value_; }
    std::string hex() const;

private:
    uint64_t value_ = 0;
};

/// What of a scene reaches a picture: geometry, materials, textures, lights and sky; no names.
std::string scene_digest(const render_system::HostScene& scene);

/// The same as the scene stands now, without its textures and its sky, which nothing animates.
std::string pose_digest(const render_system::HostScene& scene);

/// The textures alone.
std::string texture_digest(const render_system::HostScene& scene);

/// The sky alone, which is in that of the scene as well.
std::string sky_digest(const render_system::Sky& sky);

/// The view, corner by corner.
std::string view_digest(const render_system::ViewPyramid& view);

}  // namespace application
