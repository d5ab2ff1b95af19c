// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cmath>

#include "render_system/texel.h"
#include "tests/render_system/gltf_file.h"

namespace render_system::testing::loader_material_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// One triangle with that material, loaded; the material with what came with it.
HostScene scene_with(const json& material, std::vector<std::string>* warnings = nullptr,
                     const std::vector<std::string>& images = {}) {
    GltfFile file = textured_triangle(8);
    for (const std::string& image : images) file.add_texture(image);
    file.root["meshes"][0]["primitives"][0]["material"] = file.add_material(material);
    return loaded(file, warnings);
}

CoreMaterial material_with(const json& material, std::vector<std::string>* warnings = nullptr,
                           const std::vector<std::string>& images = {}) {
    const HostScene scene = scene_with(material, warnings, images);
    return scene.materials().empty() ? CoreMaterial() : scene.materials()[0].core;
}

json extension(const char* name, const json& values) { return {{"extensions", {{name, values}}}}; }

TEST(LoaderMaterial, HasTheDefaultsOfTheSpecification) {
    const CoreMaterial m = material_with({{"name", "plain"}});
    EXPECT_EQ(m.base_color, glm::vec3(1));
    EXPECT_EQ(m.metallic, 1.0f);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.ior, 1.5f);
    EXPECT_EQ(m.specular, 1.0f);
    EXPECT_EQ(m.specular_color, glm::vec3(1));
    EXPECT_EQ(m.transmission, 0.0f);
    EXPECT_TRUE(m.thin_walled);
    EXPECT_TRUE(m.opaque);
    EXPECT_FALSE(m.double_sided);
    EXPECT_EQ(m.emission, glm::vec3(0));
    EXPECT_EQ(m.base_color_texture.texture, NONE);
}

TEST(LoaderMaterial, ReadsTheMetallicRoughnessFactors) {
    const CoreMaterial m = material_with(
        {{"doubleSided", true},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.25, 0.5, 0.75, 0.5}}, {"metallicFactor", 0.125}, {"roughnessFactor", 0}}}});
    EXPECT_EQ(m.base_color, glm::vec3(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(m.alpha, 0.5f);
    EXPECT_EQ(m.metallic, 0.125f);
    EXPECT_EQ(m.roughness, 0.0f);
    EXPECT_TRUE(m.double_sided);
}

TEST(LoaderMaterial, TellsOpaqueMaskAndBlendApart) {
    const CoreMaterial opaque = material_with({{"alphaMode", "OPAQUE"}, {"alphaCutoff", 0.7}});
    EXPECT_TRUE(opaque.opaque);
    EXPECT_EQ(opaque.alpha_cutoff, 0.0f);
    const CoreMaterial mask = material_with({{"alphaMode", "MASK"}});
    EXPECT_FALSE(mask.opaque);
    EXPECT_EQ(mask.alpha_cutoff, 0.5f);
    EXPECT_EQ(material_with({{"alphaMode", "MASK"}, {"alphaCutoff", 0.25}}).alpha_cutoff, 0.25f);
    const CoreMaterial blend = material_with({{"alphaMode", "BLEND"}, {"alphaCutoff", 0.7}});
    EXPECT_FALSE(blend.opaque);
    EXPECT_EQ(blend.alpha_cutoff, 0.0f);
    // A cutoff of 0 lets everything pass; as a number it would mean BLEND.
    EXPECT_TRUE(material_with({{"alphaMode", "MASK"}, {"alphaCutoff", 0}}).opaque);
}

TEST(LoaderMaterial, MultipliesEmissionWithItsStrength) {
    json material = extension("KHR_materials_emissive_strength", {{"emissiveStrength", 3000000000}});
    material["emissiveFactor"] = {1, 0.5, 0};
    const CoreMaterial m = material_with(material);
    EXPECT_EQ(m.emission, glm::vec3(3e9f, 1.5e9f, 0));  // past 32 bits on purpose
    EXPECT_FLOAT_EQ(m.emission_weight, luminance(m.emission));
}

TEST(LoaderMaterial, ReadsTransmissionIorAndSpecular) {
    EXPECT_EQ(material_with(extension("KHR_materials_transmission", {{"transmissionFactor", 0.5}})).transmission, 0.5f);
    EXPECT_EQ(material_with(extension("KHR_materials_transmission", json::object())).transmission, 0.0f);
    EXPECT_EQ(material_with(extension("KHR_materials_ior", {{"ior", 1.25}})).ior, 1.25f);
    EXPECT_EQ(material_with(extension("KHR_materials_ior", {{"ior", 0}})).ior, 0.0f);
    EXPECT_EQ(material_with(extension("KHR_materials_ior", json::object())).ior, 1.5f);
    const CoreMaterial m = material_with(
        extension("KHR_materials_specular", {{"specularFactor", 0.25}, {"specularColorFactor", {0.5, 2, 1}}}));
    EXPECT_EQ(m.specular, 0.25f);
    EXPECT_EQ(m.specular_color, glm::vec3(0.5f, 2, 1));
}

TEST(LoaderMaterial, ReadsSheen) {
    const char* name = "KHR_materials_sheen";
    EXPECT_EQ(material_with(extension(name, json::object())).sheen_color, glm::vec3(0));
    std::vector<std::string> warnings;
    const CoreMaterial m = material_with(
        extension(name, {{"sheenColorFactor", {0.25, 0.5, 1.5}}, {"sheenRoughnessFactor", 0.75}}), &warnings);
    EXPECT_EQ(m.sheen_color, glm::vec3(0.25f, 0.5f, 1.0f));
    EXPECT_EQ(m.sheen_roughness, 0.75f);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("clamped (/materials/0)")));
}

TEST(LoaderMaterial, ReadsClearcoat) {
    const char* name = "KHR_materials_clearcoat";
    EXPECT_EQ(material_with(extension(name, json::object())).coat, 0.0f);
    const CoreMaterial m =
        material_with(extension(name, {{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}}));
    EXPECT_EQ(m.coat, 0.5f);
    EXPECT_EQ(m.coat_roughness, 0.25f);
    std::vector<std::string> warnings;
    EXPECT_EQ(material_with(extension(name, {{"clearcoatFactor", 2}}), &warnings).coat, 1.0f);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("clamped (/materials/0)")));
}

TEST(LoaderMaterial, ReadsIridescence) {
    const char* name = "KHR_materials_iridescence";
    EXPECT_EQ(material_with(extension(name, json::object())).film, 0.0f);
    const CoreMaterial plain = material_with(extension(name, {{"iridescenceFactor", 0.5}}));
    EXPECT_EQ(plain.film, 0.5f);
    EXPECT_EQ(plain.film_ior, 1.3f);
    EXPECT_EQ(plain.film_thickness, glm::vec2(100.0f, 400.0f));
    const CoreMaterial m = material_with(extension(name, {{"iridescenceFactor", 1},
                                                          {"iridescenceIor", 1.8},
                                                          {"iridescenceThicknessMinimum", 0},
                                                          {"iridescenceThicknessMaximum", 900}}));
    EXPECT_EQ(m.film_ior, 1.8f);
    EXPECT_EQ(m.film_thickness, glm::vec2(0.0f, 900.0f));
}

TEST(LoaderMaterial, ReadsAnisotropy) {
    const char* name = "KHR_materials_anisotropy";
    EXPECT_EQ(material_with(extension(name, {{"anisotropyRotation", 1}})).anisotropy, 0.0f);
    std::vector<std::string> warnings;
    json members = {{"anisotropyStrength", 0.5}, {"anisotropyRotation", -7.5}};
    const CoreMaterial m = material_with(extension(name, members), &warnings);
    EXPECT_EQ(m.anisotropy, 0.5f);
    EXPECT_EQ(m.anisotropy_rotation, -7.5f);
    EXPECT_THAT(warnings, ElementsAre());
    members["anisotropyStrength"] = 2;
    EXPECT_EQ(material_with(extension(name, members), &warnings).anisotropy, 1.0f);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("clamped (/materials/0)")));
    const json solid = {{"extensions",
                         {{name, {{"anisotropyStrength", 1}}},
                          {"KHR_materials_transmission", {{"transmissionFactor", 1}}},
                          {"KHR_materials_volume", {{"thicknessFactor", 1}}}}}};
    warnings.clear();
    EXPECT_EQ(material_with(solid, &warnings).anisotropy, 1.0f);
    EXPECT_THAT(warnings, ElementsAre());
}

TEST(LoaderMaterial, AVolumeWithThicknessIsSolidAndAbsorbs) {
    EXPECT_FALSE(material_with(extension("KHR_materials_volume", {{"thicknessFactor", 0.1}})).thin_walled);
    EXPECT_TRUE(material_with(extension("KHR_materials_volume", json::object())).thin_walled);
    // Of each colour, after a distance of 2, so much is left: the exponential of -2 times what is absorbed.
    std::vector<std::string> warnings;
    json members = {{"thicknessFactor", 1}, {"attenuationDistance", 2}, {"attenuationColor", {1, 0.5, 0}}};
    const glm::vec3 absorption = material_with(extension("KHR_materials_volume", members), &warnings).absorption;
    EXPECT_THAT(warnings, ElementsAre());
    EXPECT_EQ(std::exp(-2.0f * absorption.x), 1.0f);
    EXPECT_NEAR(std::exp(-2.0f * absorption.y), 0.5f, 1e-6f);
    EXPECT_LT(std::exp(-2.0f * absorption.z), 1e-5f);
    members["attenuationDistance"] = -1;
    EXPECT_EQ(material_with(extension("KHR_materials_volume", members), &warnings).absorption, glm::vec3(0.0f));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("attenuation over a distance that is not above 0 (/materials/0)")));
}

TEST(LoaderMaterial, ClampsFactorsOutsideTheirRangeAndSaysSo) {
    std::vector<std::string> warnings;
    const CoreMaterial m =
        material_with({{"pbrMetallicRoughness", {{"roughnessFactor", 1.5}, {"metallicFactor", -1}}}}, &warnings);
    EXPECT_EQ(m.roughness, 1.0f);
    EXPECT_EQ(m.metallic, 0.0f);
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("clamped (/materials/0)")));
}

TEST(LoaderMaterial, NamesNumbersThatContradictTheirMeaning) {
    const auto warning = [](const char* name, const json& members) {
        std::vector<std::string> warnings;
        material_with(extension(name, members), &warnings);
        return warnings.empty() ? std::string() : warnings[0];
    };
    EXPECT_THAT(warning("KHR_materials_ior", {{"ior", 0.5}}),
                HasSubstr("indices of refraction below 1, which were kept (/materials/0)"));
    EXPECT_EQ(warning("KHR_materials_ior", {{"ior", 0}}), "");
    EXPECT_THAT(warning("KHR_materials_iridescence", {{"iridescenceFactor", 1}, {"iridescenceThicknessMinimum", 500}}),
                HasSubstr("least thicknesses above the greatest, which were kept (/materials/0)"));
}

const std::vector<uint8_t> RED = {255, 0, 0};

TEST(LoaderMaterial, ReadsEverySlotWithTheRightRole) {
    const json info = {{"index", 0}};
    const HostScene scene =
        scene_with({{"pbrMetallicRoughness", {{"baseColorTexture", info}, {"metallicRoughnessTexture", info}}},
                    {"normalTexture", {{"index", 0}, {"scale", 0.5}}},
                    {"emissiveTexture", info},
                    {"emissiveFactor", {1, 1, 1}},
                    {"extensions",
                     {{"KHR_materials_transmission", {{"transmissionTexture", info}}},
                      {"KHR_materials_sheen",
                       {{"sheenColorFactor", {1, 1, 1}}, {"sheenColorTexture", info}, {"sheenRoughnessTexture", info}}},
                      {"KHR_materials_clearcoat",
                       {{"clearcoatFactor", 1},
                        {"clearcoatTexture", info},
                        {"clearcoatRoughnessTexture", info},
                        {"clearcoatNormalTexture", {{"index", 0}, {"scale", 0.25}}}}},
                      {"KHR_materials_anisotropy", {{"anisotropyStrength", 1}, {"anisotropyTexture", info}}},
                      {"KHR_materials_iridescence",
                       {{"iridescenceFactor", 1}, {"iridescenceTexture", info}, {"iridescenceThicknessTexture", info}}},
                      {"KHR_materials_specular", {{"specularTexture", info}, {"specularColorTexture", info}}}}}},
                   nullptr, {png_uri(1, 1, 3, RED)});
    const CoreMaterial& m = scene.materials()[0].core;
    // One image in two roles makes two textures, and no more.
    ASSERT_EQ(scene.textures().size(), 2u);
    const auto format = [&](const CoreTextureSlot& slot) { return scene.textures()[slot.texture].format; };
    EXPECT_EQ(format(m.base_color_texture), TexelFormat::rgba8_srgb);
    EXPECT_EQ(format(m.emission_texture), TexelFormat::rgba8_srgb);
    EXPECT_EQ(format(m.specular_color_texture), TexelFormat::rgba8_srgb);
    EXPECT_EQ(format(m.metallic_roughness_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.normal_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.transmission_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.specular_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.sheen_color_texture), TexelFormat::rgba8_srgb);
    EXPECT_EQ(format(m.sheen_roughness_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.coat_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.film_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.anisotropy_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.film_thickness_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.coat_roughness_texture), TexelFormat::rgba8);
    EXPECT_EQ(format(m.coat_normal_texture), TexelFormat::rgba8);
    EXPECT_EQ(m.coat_normal_scale, 0.25f);
    EXPECT_EQ(m.normal_scale, 0.5f);
    EXPECT_FLOAT_EQ(m.emission_weight, 0.2126f);  // white times a red texture
}

glm::vec2 through(const CoreTextureSlot& slot, const glm::vec2& uv) {
    const glm::vec3 p(uv, 1);
    return {glm::dot(slot.row_u, p), glm::dot(slot.row_v, p)};
}

CoreTextureSlot slot_with(const json& transform) {
    const json info = {{"index", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    return material_with({{"pbrMetallicRoughness", {{"baseColorTexture", info}}}}, nullptr, {png_uri(1, 1, 3, RED)})
        .base_color_texture;
}

TEST(LoaderMaterial, TransformsTextureCoordinatesAsTheExtensionsExamplesSay) {
    // "utilizes only the lower left quadrant of the source image, rotated clockwise 90 degrees"; v grows downwards.
    const CoreTextureSlot quadrant =
        slot_with({{"offset", {0, 1}}, {"rotation", 1.57079632679}, {"scale", {0.5, 0.5}}});
    const glm::vec2 corners[4] = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
    const glm::vec2 wanted[4] = {{0, 1}, {0, 0.5f}, {0.5f, 1}, {0.5f, 0.5f}};
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(through(quadrant, corners[i]).x, wanted[i].x, 1e-6f) << i;
        EXPECT_NEAR(through(quadrant, corners[i]).y, wanted[i].y, 1e-6f) << i;
    }
    // "inverts the T axis"
    const CoreTextureSlot inverted = slot_with({{"offset", {0, 1}}, {"scale", {1, -1}}});
    EXPECT_EQ(through(inverted, {0.25f, 0.25f}), glm::vec2(0.25f, 0.75f));
    // Unequal scales act before the rotation.
    const CoreTextureSlot stretched = slot_with({{"rotation", 1.57079632679}, {"scale", {2, 4}}});
    EXPECT_NEAR(through(stretched, {1, 0}).y, -2.0f, 1e-6f);
    EXPECT_NEAR(through(stretched, {0, 1}).x, 4.0f, 1e-6f);
}

TEST(LoaderMaterial, TheTransformMayOverrideTheUvSet) {
    const json transform = {{"texCoord", 1}};
    const json info = {{"index", 0}, {"texCoord", 0}, {"extensions", {{"KHR_texture_transform", transform}}}};
    const CoreMaterial m =
        material_with({{"pbrMetallicRoughness", {{"baseColorTexture", info}}}}, nullptr, {png_uri(1, 1, 3, RED)});
    EXPECT_EQ(m.base_color_texture.uv_set, 1u);
    const CoreMaterial plain =
        material_with({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}, {"texCoord", 1}}}}}}, nullptr,
                      {png_uri(1, 1, 3, RED)});
    EXPECT_EQ(plain.base_color_texture.uv_set, 1u);
}

// A base colour texture with that sampler.
HostTexture texture_with(const json& sampler) {
    GltfFile file = textured_triangle();
    file.add_texture(png_uri(4, 2, 3, std::vector<uint8_t>(24, 100)));
    file.root["samplers"] = {sampler};
    file.root["textures"][0]["sampler"] = 0;
    file.root["meshes"][0]["primitives"][0]["material"] =
        file.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const HostScene scene = loaded(file);
    return scene.textures().empty() ? HostTexture() : scene.textures()[0];
}

TEST(LoaderMaterial, ReadsSamplers) {
    const HostTexture plain = texture_with(json::object());
    EXPECT_EQ(plain.wrap_s, TextureWrap::repeat);
    EXPECT_FALSE(plain.nearest);
    EXPECT_EQ(plain.levels, 3u);
    const HostTexture wrapped = texture_with({{"wrapS", 33071}, {"wrapT", 33648}});
    EXPECT_EQ(wrapped.wrap_s, TextureWrap::clamp_to_edge);
    EXPECT_EQ(wrapped.wrap_t, TextureWrap::mirrored_repeat);
    const HostTexture pixels = texture_with({{"magFilter", 9728}, {"minFilter", 9984}});
    EXPECT_TRUE(pixels.nearest);
    EXPECT_EQ(pixels.levels, 3u);
    EXPECT_TRUE(texture_with({{"magFilter", 9728}}).nearest);
    EXPECT_TRUE(texture_with({{"minFilter", 9728}}).nearest);
    EXPECT_FALSE(texture_with({{"minFilter", 9987}}).nearest);
    // Minification without mip maps.
    EXPECT_EQ(texture_with({{"magFilter", 9729}, {"minFilter", 9729}}).levels, 1u);
}

TEST(LoaderMaterial, KeepsTheBytesOfAnImage) {
    std::vector<uint8_t> pixels(16);
    for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<uint8_t>(i * 16 + 3);
    const json info = {{"index", 0}};
    const HostScene scene =
        scene_with({{"pbrMetallicRoughness", {{"baseColorTexture", info}}}}, nullptr, {png_uri(2, 2, 4, pixels)});
    const std::vector<uint32_t>& texels = scene.textures()[0].texels;
    ASSERT_EQ(texels.size(), 5u);
    EXPECT_EQ(std::vector<uint8_t>(reinterpret_cast<const uint8_t*>(texels.data()),
                                   reinterpret_cast<const uint8_t*>(texels.data()) + 16),
              pixels);
}

TEST(LoaderMaterial, ReadsImagesFromFilesViewsAndDataUris) {
    const TempFolder folder;
    const std::string image = png(1, 1, 3, {10, 20, 30});
    write_file(folder / "my image.png", image);
    GltfFile file = textured_triangle();
    file.add_texture("my%20image.png");
    file.add_texture("data:image/png;base64," + base64(image));
    file.root["images"].push_back({{"bufferView", file.add_view(image)}, {"mimeType", "image/png"}});
    file.root["textures"].push_back({{"source", 2}});
    for (int i = 0; i < 3; ++i) {
        file.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", i}}}}}});
        json primitive = file.root["meshes"][0]["primitives"][0];
        primitive["material"] = i;
        file.add_node({{"mesh", file.add_mesh(primitive)}});
    }
    const Result<LoadedScene> result = file.load(folder);
    ASSERT_TRUE(result.ok()) << result.status.message;
    EXPECT_TRUE(result->warnings.empty());
    ASSERT_EQ(result->scene.textures().size(), 3u);
    for (const HostTexture& texture : result->scene.textures()) EXPECT_EQ(texture.texels[0], 0xFF1E140Au);
}

bool is_checkerboard(const HostTexture& texture) {
    return texture.width == 8 && texture.texels[0] == 0xFFFF00FFu && texture.texels[1] == 0xFF000000u;
}

TEST(LoaderMaterial, ShowsAPlaceholderForAMissingImageAndWarnsOnce) {
    std::vector<std::string> warnings;
    const json info = {{"index", 0}};
    const HostScene scene = scene_with({{"pbrMetallicRoughness", {{"baseColorTexture", info}}},
                                        {"normalTexture", info},
                                        {"emissiveTexture", info},
                                        {"emissiveFactor", {1, 1, 1}}},
                                       &warnings, {"nowhere.png"});
    ASSERT_EQ(scene.textures().size(), 1u);
    EXPECT_TRUE(is_checkerboard(scene.textures()[0]));
    EXPECT_EQ(scene.materials()[0].core.normal_texture.texture, NONE);
    EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("/images/0"), HasSubstr("nowhere.png: there is no such file"),
                                            HasSubstr("placeholder"))));
    scene_with({{"pbrMetallicRoughness", {{"baseColorTexture", info}, {"metallicRoughnessTexture", {{"index", 2}}}}},
                {"normalTexture", {{"index", 1}}}},
               &warnings, {"nowhere.png", "b.png", "c.png"});
    EXPECT_THAT(warnings, ElementsAre(AllOf(HasSubstr("/images/0"), HasSubstr("nowhere.png: there is no such file"),
                                            HasSubstr("2 more cannot be read (/images/1, /images/2)"))));
}

TEST(LoaderMaterial, ShowsAPlaceholderForImagesThatCannotBeDecoded) {
    const std::string image = png(64, 64, 3, std::vector<uint8_t>(64 * 64 * 3, 77));
    const json material = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}};
    const std::string broken[] = {
        "data:image/png;base64," + base64(image.substr(0, image.size() / 2)),
        "data:image/png;base64," + base64("this is no image"),
        "data:image/png;base64,!!!!",
        "data:image/png;base64,",
        "https://example.com/image.png",
    };
    for (const std::string& uri : broken) {
        std::vector<std::string> warnings;
        const HostScene scene = scene_with(material, &warnings, {uri});
        ASSERT_EQ(scene.textures().size(), 1u) << uri;
        EXPECT_TRUE(is_checkerboard(scene.textures()[0])) << uri;
        EXPECT_EQ(warnings.size(), 1u) << uri;
    }
}

TEST(LoaderMaterial, ATextureWithoutASupportedImageGetsAPlaceholder) {
    GltfFile file = one_triangle();
    file.root["extensionsUsed"] = {"KHR_texture_basisu"};
    file.root["textures"] = {{{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}}};
    file.root["meshes"][0]["primitives"][0]["material"] =
        file.add_material({{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    std::vector<std::string> warnings;
    const HostScene scene = loaded(file, &warnings);
    EXPECT_TRUE(is_checkerboard(scene.textures()[0]));
    EXPECT_THAT(warnings, ElementsAre(HasSubstr("extension KHR_texture_basisu"), HasSubstr("/textures/0")));
}

// What is said of a textured material on a mesh with so many sets of coordinates, and with points that have none.
std::string said_of(int sets, const json& material, bool points = false) {
    GltfFile file = textured_triangle(sets);
    file.add_texture(png_uri(1, 1, 3, RED));
    json& primitive = file.root["meshes"][0]["primitives"][0];
    primitive["material"] = file.add_material(material);
    if (points) {
        json more = primitive;
        more["attributes"].erase("TEXCOORD_0");
        more["mode"] = 0;
        file.root["meshes"][0]["primitives"].push_back(more);
    }
    std::vector<std::string> warnings;
    loaded(file, &warnings);
    EXPECT_LE(warnings.size(), 1u);
    return warnings.empty() ? "" : warnings[0];
}

TEST(LoaderMaterial, NamesTexturesWhoseCoordinatesAMeshDoesNotHave) {
    const auto base = [](const json& info) { return json{{"pbrMetallicRoughness", {{"baseColorTexture", info}}}}; };
    const auto moved_to = [](int set) {
        return json{{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", set}}}}}};
    };
    const char* const told = "left out: textures whose coordinates a mesh does not have, but for one texel (/meshes/0)";
    EXPECT_THAT(said_of(0, base({{"index", 0}})), HasSubstr(told));
    EXPECT_THAT(said_of(1, base({{"index", 0}, {"texCoord", 1}})), HasSubstr(told));
    EXPECT_THAT(said_of(1, base(moved_to(1))), HasSubstr(told));
    EXPECT_THAT(said_of(0, {{"normalTexture", {{"index", 0}}}}), HasSubstr(told));
    EXPECT_THAT(said_of(4, {{"normalTexture", {{"index", 0}, {"texCoord", 3}}},
                            {"emissiveTexture", {{"index", 0}, {"texCoord", 4}}},
                            {"emissiveFactor", {1, 1, 1}}}),
                HasSubstr(told));
    EXPECT_EQ(said_of(1, base({{"index", 0}})), "");
    EXPECT_EQ(said_of(2, base({{"index", 0}, {"texCoord", 1}})), "");
    EXPECT_EQ(said_of(4, base(moved_to(3))), "");
    EXPECT_EQ(said_of(0, {{"emissiveTexture", {{"index", 0}}}}), "");  // of a factor of 0: it is not read
    EXPECT_EQ(said_of(0, {{"name", "plain"}}), "");
    EXPECT_THAT(said_of(1, base({{"index", 0}}), true), Not(HasSubstr("coordinates")));  // points are not shown
}

TEST(LoaderMaterial, ReadsOnlyTheTexturesOfMaterialsInUse) {
    GltfFile file = one_triangle();
    file.add_texture("nowhere.png");
    file.add_material({{"name", "unused"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
    const HostScene scene = loaded(file);
    EXPECT_TRUE(scene.textures().empty());
    EXPECT_EQ(scene.materials().size(), 2u);  // and the default one, which is in use
}

}  // namespace
}  // namespace render_system::testing::loader_material_test
