// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <fstream>
#include <string>

/// Writes a glTF file of one triangle that faces +z, with its 36 bytes of positions inside. No light, no camera.
inline std::filesystem::path write_small_scene(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "triangle.gltf";
    std::ofstream(file) << R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                       "min": [-1, -1, 0], "max": [1, 1, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36,
                     "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}]
    })";
    return file;
}

/// The same triangle, which goes to x = 1 within a second.
inline std::filesystem::path write_moving_scene(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / "moving.gltf";
    std::ofstream(file)
        << R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "animations": [{"channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}],
                        "samplers": [{"input": 1, "output": 2}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 2, "type": "SCALAR"},
                      {"bufferView": 0, "byteOffset": 44, "componentType": 5126, "count": 2, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 68}],
        "buffers": [{"byteLength": 68, "uri": "data:application/octet-stream;base64,)"
           R"(AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAA="}]
    })";
    return file;
}

/// The same triangle on the same way, by its node, by the joint of a skin, or by a morph target.
inline std::filesystem::path write_moving_scene_by(const std::string& what, const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / (what + ".gltf");
    const bool skin = what == "skin", morph = what == "morph";
    std::ofstream(file)
        << R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": [{"mesh": 0)"
        << (skin ? R"(, "skin": 0}, {}], "skins": [{"joints": [1]}],)" : "}, {}],")
        << R"("meshes": [{"primitives": [{"attributes": {"POSITION": 0)"
        << (skin    ? R"(, "JOINTS_0": 3, "WEIGHTS_0": 4}}]}],)"
            : morph ? R"(}, "targets": [{"POSITION": 5}]}], "weights": [0]}],)"
                    : "}}]}],")
        << R"("animations": [{"channels": [{"sampler": 0, "target": {"node": )" << (skin ? "1" : "0")
        << R"(, "path": ")" << (morph ? "weights" : "translation") << R"("}}], "samplers": [{"input": 1, "output": )"
        << (morph ? "1" : "2")
        << R"(}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 2, "type": "SCALAR"},
                      {"bufferView": 0, "byteOffset": 44, "componentType": 5126, "count": 2, "type": "VEC3"},
                      {"bufferView": 0, "byteOffset": 68, "componentType": 5121, "count": 3, "type": "VEC4"},
                      {"bufferView": 0, "byteOffset": 80, "componentType": 5126, "count": 3, "type": "VEC4"},
                      {"bufferView": 0, "byteOffset": 128, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 164}],
        "buffers": [{"byteLength": 164, "uri": "data:application/octet-stream;base64,)"
           R"(AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAA)"
           R"(AAAAAAAAAAAAAIA/AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAAAAAAAAAIA/)"
           R"(AAAAAAAAAAAAAIA/AAAAAAAAAAA="}]})";
    return file;
}
