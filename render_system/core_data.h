// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "render_system/pixel_sum.h"

// The plain data that crosses the seam between the render system and a core. Spans point at memory of the
// caller; a core copies what it needs before the call returns. Lengths are in scene units, angles in radians,
// radiance is linear RGB in W / (m^2 sr) with the primaries of sRGB.

namespace render_system {

constexpr uint32_t NONE = 0xFFFFFFFFu;  ///< "no texture", "no mesh"

/// Four points: the eye and three corners of the screen. The fourth corner completes the parallelogram. With a lens the
/// screen stands where pictures are sharp.
struct ViewPyramid {
    glm::vec3 eye{0.0f, 0.0f, 0.0f};
    glm::vec3 top_left{-1.0f, 1.0f, -1.0f};
    glm::vec3 top_right{1.0f, 1.0f, -1.0f};
    glm::vec3 bottom_left{-1.0f, -1.0f, -1.0f};
    float aperture = 0.0f;  ///< radius of a thin lens around the eye; 0: a pinhole
    bool parallel = false;  ///< orthographic: all rays go from the screen's shadow at the eye to the screen; no lens

    bool operator==(const ViewPyramid&) const = default;
};

/// Converge adds samples to those already taken; Restart drops them first.
enum class Convergence { Converge, Restart };

/// How one texel is read: of one 32-bit word but for the last two.
enum class TexelFormat : uint32_t {
    rgba8 = 0,       ///< 8-bit unorm, linear; red in the lowest byte
    rgba8_srgb = 1,  ///< 8-bit unorm, red, green and blue carry the sRGB curve, alpha is linear
    rgb9e5 = 2,      ///< shared exponent, as VK_FORMAT_E5B9G9R9_UFLOAT_PACK32; alpha reads as 1
    rgba16 = 3,      ///< 16-bit unorm, linear, two words; red in the low half of the first, blue in that of the second
    rgba16_srgb = 4  ///< the same; red, green and blue carry the sRGB curve
};

/// 32-bit words of one texel.
constexpr uint32_t texel_words(TexelFormat format) { return format >= TexelFormat::rgba16 ? 2 : 1; }

enum class TextureWrap : uint32_t { repeat = 0, mirrored_repeat = 1, clamp_to_edge = 2 };

/// A texture with its whole mip chain, largest level first, rows top to bottom, tightly packed.
/// Level n is max(1, width >> n) by max(1, height >> n).
struct CoreTexture {
    uint32_t width = 0;
    uint32_t height = 0;
    uint32_t levels = 1;
    TexelFormat format = TexelFormat::rgba8;
    TextureWrap wrap_s = TextureWrap::repeat;
    TextureWrap wrap_t = TextureWrap::repeat;
    bool nearest = false;              ///< magnification and minification without interpolation inside a level
    std::span<const uint32_t> texels;  ///< texel_words() words each
};

/// A texture as a material uses it: uv' = rows * (u, v, 1), with uv from one of the sets 0 to 3.
struct CoreTextureSlot {
    uint32_t texture = NONE;
    uint32_t uv_set = 0;
    glm::vec3 row_u{1.0f, 0.0f, 0.0f};
    glm::vec3 row_v{0.0f, 1.0f, 0.0f};

    bool operator==(const CoreTextureSlot&) const = default;
};

/// One material in the metallic-roughness model of glTF 2.0. Factors multiply what the slots read.
struct CoreMaterial {
    glm::vec3 base_color{1.0f};
    float alpha = 1.0f;         ///< coverage: the share of rays that meet the surface (BLEND)
    float alpha_cutoff = 0.0f;  ///< MASK: rays meet the surface where alpha >= cutoff > 0; 0: BLEND or OPAQUE
    bool opaque = true;         ///< OPAQUE: alpha is ignored
    bool double_sided = false;  ///< emission leaves both sides; scattering always does
    float metallic = 1.0f;
    float roughness = 1.0f;
    float ior = 1.5f;
    float specular = 1.0f;           ///< KHR_materials_specular
    glm::vec3 specular_color{1.0f};  ///< KHR_materials_specular
    float transmission = 0.0f;       ///< KHR_materials_transmission
    bool thin_walled = true;         ///< transmission without refraction; false: a solid, refracting at ior
    glm::vec3 absorption{0.0f};      ///< KHR_materials_volume: of a solid, nepers per unit of length
    glm::vec3 emission{0.0f};        ///< emissiveFactor times KHR_materials_emissive_strength
    float emission_weight = 0.0f;    ///< luminance of the mean emission that alpha leaves; see CoreLights::total_weight
    float normal_scale = 1.0f;
    glm::vec3 sheen_color{0.0f};   ///< KHR_materials_sheen
    float sheen_roughness = 0.0f;  ///< KHR_materials_sheen
    float coat = 0.0f;             ///< KHR_materials_clearcoat
    float coat_roughness = 0.0f;   ///< KHR_materials_clearcoat
    float coat_normal_scale = 1.0f;
    float film = 0.0f;                         ///< KHR_materials_iridescence
    float film_ior = 1.3f;                     ///< KHR_materials_iridescence
    glm::vec2 film_thickness{100.0f, 400.0f};  ///< nanometres, where film_thickness_texture is 0 and 1 (without one: 1)
    float anisotropy = 0.0f;             ///< KHR_materials_anisotropy, its strength, also of solids that bend light
    float anisotropy_rotation = 0.0f;    ///< counter-clockwise from the tangent
    CoreTextureSlot base_color_texture;  ///< RGB, alpha in A
    CoreTextureSlot metallic_roughness_texture;  ///< roughness in G, metallic in B
    CoreTextureSlot normal_texture;              ///< tangent space
    CoreTextureSlot emission_texture;            ///< RGB
    CoreTextureSlot transmission_texture;        ///< R
    CoreTextureSlot specular_texture;            ///< A
    CoreTextureSlot specular_color_texture;      ///< RGB
    CoreTextureSlot sheen_color_texture;         ///< RGB
    CoreTextureSlot sheen_roughness_texture;     ///< A
    CoreTextureSlot coat_texture;                ///< R
    CoreTextureSlot coat_roughness_texture;      ///< G
    CoreTextureSlot coat_normal_texture;         ///< tangent space; without one the coat follows the geometry's normal
    CoreTextureSlot film_texture;                ///< R
    CoreTextureSlot film_thickness_texture;      ///< G
    CoreTextureSlot anisotropy_texture;          ///< direction along tangent and bitangent in RG, strength in B

    bool operator==(const CoreMaterial&) const = default;
};

/// Every texture slot of a material, each once: what goes for all of them goes through this list. Its order is that of
/// the slots in the cores' rows (MATERIAL_SLOTS in layout.h).
constexpr CoreTextureSlot CoreMaterial::*kTextureSlots[] = {
    &CoreMaterial::base_color_texture,
    &CoreMaterial::metallic_roughness_texture,
    &CoreMaterial::normal_texture,
    &CoreMaterial::emission_texture,
    &CoreMaterial::transmission_texture,
    &CoreMaterial::specular_texture,
    &CoreMaterial::specular_color_texture,
    &CoreMaterial::sheen_color_texture,
    &CoreMaterial::sheen_roughness_texture,
    &CoreMaterial::coat_texture,
    &CoreMaterial::coat_roughness_texture,
    &CoreMaterial::coat_normal_texture,
    &CoreMaterial::film_texture,
    &CoreMaterial::film_thickness_texture,
    &CoreMaterial::anisotropy_texture,
};

/// One triangle mesh. `triangles` holds three vertex indices and the material of each triangle in w.
/// The other spans have one element per vertex, or none: normals must be there; the rest default to
/// uv (0,0), tangent (none: normal maps are ignored) and colour white.
struct CoreMesh {
    std::span<const glm::vec3> positions;
    std::span<const glm::vec3> normals;
    std::span<const glm::vec4> tangents;  ///< w is the bitangent's sign
    std::span<const glm::vec2> uv0;
    std::span<const glm::vec2> uv1;
    std::span<const glm::vec2> uv2;
    std::span<const glm::vec2> uv3;
    std::span<const glm::vec4> colors;  ///< linear RGBA, 0 to 1
    std::span<const glm::uvec4> triangles;
    /// What is to come after the first Render: an instance of it is set again, or its vertices are. A core need not be
    /// told; one that was sees the same triangles from the first picture on as after many.
    bool moves = false;
    bool deforms = false;
};

/// Rows of the object-to-world matrix: world.x = dot(rows[0].xyz, p) + rows[0].w.
struct CoreTransform {
    glm::vec4 rows[3]{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}};

    bool operator==(const CoreTransform&) const = default;
};

/// One entry of Walker's alias table: take `self` if the random fraction is below threshold, else `alias`.
struct AliasEntry {
    float threshold = 1.0f;
    uint32_t alias = 0;
    float probability = 0.0f;  ///< of choosing this entry, over the whole table
};

enum class LightKind : uint32_t { triangle = 0, point = 1, spot = 2, directional = 3, sky = 4 };

/// One light that next event estimation can choose.
struct CoreLight {
    LightKind kind = LightKind::point;
    glm::vec3 vertices[3]{};  ///< triangle: world space, front side by (v1-v0)x(v2-v0) [already flipped for mirrored
                              ///< instances]; point, spot: position in vertices[0]
    glm::vec3 direction{0, 0, -1};  ///< spot, directional: the way that light travels, unit length
    glm::vec3 emission{0.0f};  ///< triangle: radiance factor; point, spot: radiant intensity; directional: irradiance
    float spot_scale = 0.0f;   ///< spot: attenuation = clamp(cos * scale + offset, 0, 1)^2 (KHR_lights_punctual)
    float spot_offset = 1.0f;
    bool two_sided = false;            ///< triangle
    CoreTextureSlot emission_texture;  ///< triangle: transform already applied to uv; only `texture` is used
    glm::vec2 uv[3]{};                 ///< triangle: coordinates for emission_texture
};

/// All lights and the table that chooses among them. For a triangle light the density per unit area is
/// material.emission_weight / total_weight, whichever the triangle; so a hit needs no search.
struct CoreLights {
    std::span<const CoreLight> lights;
    std::span<const AliasEntry> table;  ///< one entry per light
    float total_weight = 0.0f;  ///< sum over triangles of area * emission_weight, plus the other lights' weights
};

/// The environment. A constant sky (no map) is met by rays that leave the scene and is never chosen by next event
/// estimation; a map is, through a light of kind sky and the table here.
struct CoreSky {
    glm::vec3 radiance{0.0f};  ///< without a map
    uint32_t width = 0;        ///< map: equirectangular, row 0 at +y; u = 0.5 + atan2(x, -z) / (2 pi)
    uint32_t height = 0;
    std::span<const glm::vec4> texels;  ///< linear radiance in xyz; empty: no map
    std::span<const AliasEntry> table;  ///< one entry per texel, proportional to luminance times solid angle
    float light_probability = 0.0f;     ///< of the sky's entry in CoreLights::table
};

/// What Render writes to: the mean radiance of all samples so far, row-major from the top left, alpha 1.
struct CoreTarget {
    uint32_t width = 0;
    uint32_t height = 0;
    std::span<glm::vec4> pixels;  ///< width * height; stays valid until the next SetTarget or Shutdown
    /// Not empty: Render adds every sample to these sums in place of writing means (what `pixels` hold then is the
    /// core's affair), and takes samples of the pixels [first_pixel, first_pixel + sums.size()) only. The sums are the
    /// caller's: no Restart clears them.
    std::span<PixelSum> sums = {};
    std::span<double> squares = {};  ///< none, or as many as `sums`: of luminance, squared
    uint32_t first_pixel = 0;
    /// Not empty: whether Render is still wanted, asked as that of CoreFilter. Where it is not, what `pixels` and
    /// `sums` hold is the core's affair.
    std::function<bool()> is_called_off = {};
};

/// What a filter makes of earlier frames.
enum class FilterHistory {
    none,   ///< nothing; what there is stays for others
    begin,  ///< this is the first one
    go_on,  ///< light and pictures of those since `begin` are followed to where they are now; without any, it begins
};

/// What filters with a history have left of the frames so far: enough for a core of the same kind to go on.
struct CoreHistory {
    uint32_t frames = 0;        ///< filtered since `begin`; 0: there is no history
    std::vector<float> planes;  ///< of the core's own making
};

/// A picture for Filter: means of the samples [first_sample, first_sample + samples) of every pixel of the target.
struct CoreFilter {
    std::span<const glm::vec4> means;  ///< radiance; width * height of the target, as `filtered`. One that is not
                                       ///< finite is not known: its pixel becomes what is around
    std::span<const float> variances;  ///< of the means' luminance; as many, or none: judged by what is around
    uint32_t first_sample = 0;
    uint32_t samples = 1;           ///< at least 1
    std::span<glm::vec4> filtered;  ///< may be `means`; alpha 1
    FilterHistory history = FilterHistory::none;
    uint32_t most_rays = 256;  ///< camera rays a pixel to go by, at least 1: fewer are sooner there
    /// Not empty: asked again and again, from several threads at once, whether the filter is still wanted; once it says
    /// that it is called off it is not asked much longer. It must not throw.
    std::function<bool()> is_called_off = {};

    /// What is known of a pixel: nothing where its mean is no number.
    bool knows(size_t pixel) const {
        const glm::vec4& mean = means[pixel];
        // Nothing but 0 where all are finite; by arithmetic, which is done for several pixels at once.
        return (mean.x - mean.x) + (mean.y - mean.y) + (mean.z - mean.z) == 0.0f;
    }
};

/// What every core is opened with; fixed for its life. What one core alone can be told is for its own create_core.
struct CoreOptions {
    uint32_t threads = 0;  ///< host threads, 0: all; never changes the picture
    bool exact = false;    ///< the checking mode: all cores give the same bits, by one shared triangle test
    bool still = false;    ///< no geometry comes or moves after the first Render: what only that needs is not kept
};

/// What may change between two images.
struct CoreSettings {
    uint32_t seed = 0;
    uint32_t max_path_length = 8;  ///< path segments from the eye, at least 1
    bool russian_roulette = true;  ///< from segment 4, survival clamp(max component of throughput, 0.05, 1)
    bool next_event_estimation = true;
    float indirect_limit = 0.0f;  ///< radiance that one path of 3 segments or more may bring at most; 0: no limit
    uint32_t first_sample = 0;    ///< index of the first sample after a Restart: ranges can be rendered apart

    bool operator==(const CoreSettings&) const = default;
};

/// Counters and times since the last Restart. Parts of the time are thread time divided by threads.
struct CoreStats {
    std::string core;
    std::string device;
    uint64_t triangles = 0;  ///< in all instances
    uint32_t threads = 0;
    uint64_t samples = 0;  ///< per pixel
    uint64_t primary_rays = 0;
    uint64_t extension_rays = 0;  ///< without the primary ones
    uint64_t shadow_rays = 0;
    double build_ms = 0.0;  ///< the last acceleration structure build
    double generate_ms = 0.0;
    double extend_ms = 0.0;
    double shade_ms = 0.0;
    double connect_ms = 0.0;
    double finalize_ms = 0.0;
    double total_ms = 0.0;      ///< wall time inside Render, without building and uploading
    double guide_ms = 0.0;      ///< of the last Filter: camera rays once more, for what the filter goes by; in it,
                                ///< where it is the first one of its size, that the system makes its memory
    double filter_ms = 0.0;     ///< of the last Filter: all the rest, wall time, but for compiling kernels
    uint64_t texel_bytes = 0;   ///< of memory_bytes, the textures
    uint64_t memory_bytes = 0;  ///< held by the core (device memory for the source core)
    uint64_t memory_allowed_bytes = 0;  ///< the core's budget for that; 0: it has none
};

}  // namespace render_system
