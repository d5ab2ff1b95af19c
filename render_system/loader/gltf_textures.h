// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "render_system/host_scene.h"
#include "render_system/loader/gltf_document.h"
#include "render_system/texture.h"

namespace render_system {

/// Decodes an image of the document, wherever it lies. Throws LoadError.
Image read_document_image(const GltfDocument& document, int image);

/// Reads textures as materials ask for them, each combination of image, role and sampler once.
class GltfTextures {
public:
    GltfTextures(GltfDocument& document, HostScene& scene) : document_(document), scene_(scene) {}

    /// The scene's texture for `texture` of the file. An image that cannot be read gives a warning; in its stead
    /// colour is a visible checkerboard, and data is NONE (the factors alone hold). With a `glossiness` the texture's
    /// green is not the image's, but 1 minus the image's alpha times that: roughness of a glossy material.
    uint32_t add(int texture, TextureRole role, std::optional<float> glossiness = {});

private:
    struct Key {
        int image = -1;
        TextureRole role = TextureRole::color;
        TextureWrap wrap_s = TextureWrap::repeat;
        TextureWrap wrap_t = TextureWrap::repeat;
        bool nearest = false;
        bool mips = true;
        std::optional<float> glossiness;
        std::array<int, 4> packed{-1, -1, -1, -1};  // by channel: the image whose red it is

        auto operator<=>(const Key&) const = default;
        bool is_packed() const { return packed != std::array<int, 4>{-1, -1, -1, -1}; }
    };

    Key key_of(int texture, TextureRole role) const;
    uint32_t load(int texture, const Key& key);
    Image read_packed(const Key& key);
    void pack(Image& image, size_t channel, int source);
    void warn(int texture, int image, const std::string& why);

    GltfDocument& document_;
    HostScene& scene_;
    std::map<Key, uint32_t> known_;
    std::set<std::string> warned_;
};

}  // namespace render_system
