// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Importer.hpp>
#include <cmath>

#include "render_system/importer/fbx_materials.h"
#include "render_system/importer/glb_builder.h"
#include "render_system/importer/importer.h"
#include "render_system/loader/file_bytes.h"

namespace importer {

namespace {

using nlohmann::json;

json gltf_matrix(const aiMatrix4x4& m) {
    return {m.a1, m.b1, m.c1, 0.0f, m.a2, m.b2, m.c2, 0.0f, m.a3, m.b3, m.c3, 0.0f, m.a4, m.b4, m.c4, 1.0f};
}

class FbxConverter {
public:
    FbxConverter(const aiScene& scene, const std::filesystem::path& folder) : scene_(scene), folder_(folder) {}

    void write() {
        for (unsigned i = 0; i < scene_.mNumMaterials; ++i) {
            builder_.root["materials"].push_back(gltf_material(*scene_.mMaterials[i], scene_, folder_, builder_));
        }
        primitives_.resize(scene_.mNumMeshes);
        for (unsigned i = 0; i < scene_.mNumMeshes; ++i) add_primitive(i);
        add_nodes();
        note_left_out();
        builder_.write();
    }

private:
    void add_primitive(unsigned index) {
        const aiMesh& mesh = *scene_.mMeshes[index];
        if ((mesh.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) {
            builder_.leave_out("points and lines");
            return;
        }
        if (mesh.mNumAnimMeshes > 0) builder_.leave_out("blend shapes");
        std::vector<uint32_t> corners;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            if (mesh.mFaces[i].mNumIndices != 3) continue;
            corners.insert(corners.end(), mesh.mFaces[i].mIndices, mesh.mFaces[i].mIndices + 3);
        }
        if (corners.empty()) return;
        json attributes = {{"POSITION", vectors(mesh.mVertices, mesh.mNumVertices)}};
        if (mesh.HasNormals()) attributes["NORMAL"] = vectors(mesh.mNormals, mesh.mNumVertices);
        for (unsigned set = 0; set < AI_MAX_NUMBER_OF_TEXTURECOORDS && mesh.HasTextureCoords(set); ++set) {
            attributes["TEXCOORD_" + std::to_string(set)] = coordinates(mesh.mTextureCoords[set], mesh.mNumVertices);
        }
        if (mesh.HasVertexColors(0)) attributes["COLOR_0"] = colors(mesh.mColors[0], mesh.mNumVertices);
        primitives_[index] = {{"attributes", attributes}, {"indices", builder_.add_corners(corners)}};
        if (mesh.mMaterialIndex < scene_.mNumMaterials) primitives_[index]["material"] = mesh.mMaterialIndex;
    }

    size_t vectors(const aiVector3D* values, unsigned count) {
        std::vector<float> floats;
        floats.reserve(size_t{3} * count);
        for (unsigned i = 0; i < count; ++i) floats.insert(floats.end(), {values[i].x, values[i].y, values[i].z});
        return builder_.add_floats(floats, "VEC3", 3);
    }

    size_t coordinates(const aiVector3D* values, unsigned count) {
        std::vector<float> floats;
        floats.reserve(size_t{2} * count);
        for (unsigned i = 0; i < count; ++i) floats.insert(floats.end(), {values[i].x, 1.0f - values[i].y});
        return builder_.add_floats(floats, "VEC2", 2);
    }

    size_t colors(const aiColor4D* values, unsigned count) {
        std::vector<float> floats;
        floats.reserve(size_t{4} * count);
        for (unsigned i = 0; i < count; ++i) {
            floats.insert(floats.end(), {values[i].r, values[i].g, values[i].b, values[i].a});
        }
        return builder_.add_floats(floats, "VEC4", 4);
    }

    // Breadth first, however deep the file nests them.
    void add_nodes() {
        std::vector<const aiNode*> sources{scene_.mRootNode};
        json& nodes = builder_.root["nodes"];
        for (size_t i = 0; i < sources.size(); ++i) {
            const aiNode& source = *sources[i];
            json node = {{"name", source.mName.C_Str()}, {"matrix", gltf_matrix(source.mTransformation)}};
            add_mesh(source, node);
            for (unsigned c = 0; c < source.mNumChildren; ++c) {
                node["children"].push_back(sources.size());
                sources.push_back(source.mChildren[c]);
            }
            nodes.push_back(node);
        }
        builder_.root["scenes"][0]["nodes"] = {0};
        scale_to_meters();
    }

    void add_mesh(const aiNode& source, json& node) {
        json primitives = json::array();
        for (unsigned i = 0; i < source.mNumMeshes; ++i) {
            if (source.mMeshes[i] < primitives_.size() && !primitives_[source.mMeshes[i]].is_null()) {
                primitives.push_back(primitives_[source.mMeshes[i]]);
            }
        }
        if (primitives.empty()) return;
        const auto [entry, is_new] = meshes_.emplace(primitives.dump(), builder_.root["meshes"].size());
        if (is_new) builder_.root["meshes"].push_back({{"name", source.mName.C_Str()}, {"primitives", primitives}});
        node["mesh"] = entry->second;
    }

    // FBX counts in centimetres times a factor of its own, glTF in metres.
    void scale_to_meters() {
        double factor = 1.0;
        float single = 1.0f;
        if (!scene_.mMetaData || !scene_.mMetaData->Get("UnitScaleFactor", factor)) {
            if (scene_.mMetaData && scene_.mMetaData->Get("UnitScaleFactor", single))
                factor = static_cast<double>(single);
        }
        const double scale = 0.01 * factor;
        if (!(scale > 1e-6 && scale < 1e6)) return;
        json& nodes = builder_.root["nodes"];
        builder_.root["scenes"][0]["nodes"] = {nodes.size()};
        nodes.push_back({{"name", "metres"}, {"scale", {scale, scale, scale}}, {"children", {0}}});
    }

    void note_left_out() {
        const auto count = [](unsigned number) { return " (" + std::to_string(number) + ")"; };
        // Assimp turns a camera's post-rotation the wrong way round, which leaves it looking away.
        if (scene_.mNumCameras > 0) builder_.leave_out("cameras" + count(scene_.mNumCameras));
        if (scene_.mNumLights > 0) builder_.leave_out("lights, which FBX gives no unit" + count(scene_.mNumLights));
        if (scene_.mNumAnimations > 0) builder_.leave_out("animations" + count(scene_.mNumAnimations));
        unsigned skins = 0;
        for (unsigned i = 0; i < scene_.mNumMeshes; ++i) skins += scene_.mMeshes[i]->HasBones() ? 1 : 0;
        if (skins > 0) builder_.leave_out("skins" + count(skins));
    }

    const aiScene& scene_;
    const std::filesystem::path& folder_;
    GlbBuilder builder_;
    std::vector<json> primitives_;  // by mesh of the file
    std::map<std::string, size_t> meshes_;
};

std::string on_one_line(std::string text) {
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    return text;
}

}  // namespace

void import_fbx(const std::filesystem::path& path) {
    const render_system::FileBytes file(path);
    Assimp::Importer importer;
    importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
    importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
    // From memory: the library opens no file of its own.
    const aiScene* scene = importer.ReadFileFromMemory(file.bytes().data(), file.bytes().size(),
                                                       aiProcess_Triangulate | aiProcess_SortByPType, "fbx");
    if (!scene || !scene->mRootNode) {
        throw ImportError{"is no FBX that can be read (" + on_one_line(importer.GetErrorString()) +
                          "); export it again, as glTF if that can be"};
    }
    const std::filesystem::path folder = path.parent_path();
    FbxConverter(*scene, folder).write();
}

}  // namespace importer
