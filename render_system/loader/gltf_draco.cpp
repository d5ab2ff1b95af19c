// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_draco.h"

#include <cstring>
#include <string>

#include "render_system/importer/draco_exchange.h"
#include "render_system/loader/import_process.h"
#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

using Bytes = std::span<const std::byte>;
using importer::DracoAttribute;
using importer::DracoMesh;

// A decoded stream; spans point into what the importer wrote.
struct DecodedMesh {
    DracoMesh header;
    std::vector<DracoAttribute> attributes;
    Bytes corners;
    std::vector<Bytes> values;
};

const tinygltf::Value* draco_part(const tinygltf::Primitive& primitive) {
    const auto found = primitive.extensions.find("KHR_draco_mesh_compression");
    return found == primitive.extensions.end() ? nullptr : &found->second;
}

// Whether all that the stream holds is in the file a second time, unpacked.
bool is_plain_as_well(const tinygltf::Model& model, const tinygltf::Primitive& primitive) {
    const auto is_plain = [&](int accessor) {
        return accessor < 0 || model.accessors[static_cast<size_t>(accessor)].bufferView >= 0;
    };
    for (const auto& [name, accessor] : primitive.attributes) {
        if (!is_plain(accessor)) return false;
    }
    return is_plain(primitive.indices);
}

// What the importer writes is checked as if it were a file: it read one.
class AnswerReader {
public:
    explicit AnswerReader(Bytes bytes) : left_(bytes) {}

    Bytes take(uint64_t size) {
        if (size > left_.size()) fail_at("", "its Draco data are damaged" + EXPORT_AGAIN);
        const Bytes taken = left_.first(size);
        left_ = left_.subspan(size);
        return taken;
    }

    template <class T>
    T take() {
        T value;
        std::memcpy(&value, take(sizeof(T)).data(), sizeof(T));
        return value;
    }

private:
    Bytes left_;
};

DecodedMesh read_mesh_answer(AnswerReader& answer) {
    DecodedMesh mesh;
    mesh.header = answer.take<DracoMesh>();
    for (uint32_t i = 0; i < mesh.header.attributes; ++i) mesh.attributes.push_back(answer.take<DracoAttribute>());
    mesh.corners = answer.take(uint64_t{mesh.header.triangles} * 3 * sizeof(uint32_t));
    for (const DracoAttribute& attribute : mesh.attributes) {
        mesh.values.push_back(
            answer.take(uint64_t{mesh.header.points} * attribute.components * attribute.component_size));
    }
    return mesh;
}

std::vector<std::byte> request_of(const GltfDocument& document, const std::map<int, size_t>& streams) {
    std::vector<const std::pair<const int, size_t>*> ordered(streams.size());
    for (const auto& entry : streams) ordered[entry.second] = &entry;
    std::vector<std::byte> request;
    for (const auto* entry : ordered) {
        const Bytes stream = document.view_bytes(entry->first);
        const uint64_t size = stream.size();
        const auto* head = reinterpret_cast<const std::byte*>(&size);
        request.insert(request.end(), head, head + sizeof(size));
        request.insert(request.end(), stream.begin(), stream.end());
    }
    return request;
}

class DracoDecoder {
public:
    explicit DracoDecoder(GltfDocument& document) : document_(document), model_(document.model) {}

    void decode() {
        std::map<int, size_t> streams;  // by buffer view, in order of appearance
        for (const tinygltf::Mesh& mesh : model_.meshes) {
            for (const tinygltf::Primitive& primitive : mesh.primitives) {
                const tinygltf::Value* part = draco_part(primitive);
                if (part && !is_plain_as_well(model_, primitive)) streams.emplace(view_of(*part), streams.size());
            }
        }
        if (streams.empty()) return;
        const std::vector<std::byte> request = request_of(document_, streams);
        const FileBytes file = run_importer({"draco", {}, request, request.size()});
        AnswerReader answer(file.bytes());
        for (size_t i = 0; i < streams.size(); ++i) decoded_.push_back(read_mesh_answer(answer));
        for (size_t i = 0; i < model_.meshes.size(); ++i) {
            for (size_t j = 0; j < model_.meshes[i].primitives.size(); ++j) {
                tinygltf::Primitive& primitive = model_.meshes[i].primitives[j];
                const tinygltf::Value* part = draco_part(primitive);
                if (!part || is_plain_as_well(model_, primitive)) continue;
                place_ = "/meshes/" + std::to_string(i) + "/primitives/" + std::to_string(j) +
                         "/extensions/KHR_draco_mesh_compression";
                replace(primitive, *part, streams.at(view_of(*part)));
            }
        }
    }

private:
    static int view_of(const tinygltf::Value& part) { return part.Get("bufferView").GetNumberAsInt(); }

    void replace(tinygltf::Primitive& primitive, const tinygltf::Value& part, size_t stream) {
        const DecodedMesh& mesh = decoded_[stream];
        const tinygltf::Value& ids = part.Get("attributes");
        for (auto& [name, accessor] : primitive.attributes) {
            if (!ids.Has(name)) continue;
            accessor = attribute_accessor(mesh, static_cast<uint32_t>(ids.Get(name).GetNumberAsInt()), accessor, name);
        }
        tinygltf::Accessor corners;
        corners.componentType = TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
        corners.type = TINYGLTF_TYPE_SCALAR;
        corners.count = size_t{3} * mesh.header.triangles;
        if (primitive.indices >= 0)
            check_count(model_.accessors[static_cast<size_t>(primitive.indices)].count, corners.count);
        primitive.indices = add_accessor(corners, mesh.corners);
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
    }

    // The stream's own numbers are the ones that fit its values.
    void check_count(uint64_t promised, uint64_t held) {
        if (promised == held) return;
        document_.omissions.add("counts of accessors, which their Draco streams contradict", place_);
    }

    int attribute_accessor(const DecodedMesh& mesh, uint32_t id, int accessor, const std::string& name) {
        for (size_t i = 0; i < mesh.attributes.size(); ++i) {
            const DracoAttribute& attribute = mesh.attributes[i];
            if (attribute.id != id) continue;
            tinygltf::Accessor own = model_.accessors[static_cast<size_t>(accessor)];
            if (tinygltf::GetNumComponentsInType(static_cast<uint32_t>(own.type)) !=
                static_cast<int32_t>(attribute.components)) {
                fail_at(place_, "its " + name + " has " + std::to_string(attribute.components) +
                                    " components, unlike the accessor" + EXPORT_AGAIN);
            }
            check_count(own.count, mesh.header.points);
            own.componentType = static_cast<int>(attribute.component_type);
            own.count = mesh.header.points;
            own.byteOffset = 0;
            own.sparse.isSparse = false;
            return add_accessor(own, mesh.values[i]);
        }
        fail_at(place_, "has no attribute " + std::to_string(id) + " for " + name + EXPORT_AGAIN);
    }

    int add_accessor(tinygltf::Accessor accessor, Bytes bytes) {
        tinygltf::BufferView view;
        view.buffer = 0;
        view.byteLength = bytes.size();
        accessor.bufferView = static_cast<int>(model_.bufferViews.size());
        model_.bufferViews.push_back(view);
        document_.decoded_views[accessor.bufferView].assign(bytes.begin(), bytes.end());
        model_.accessors.push_back(accessor);
        return static_cast<int>(model_.accessors.size()) - 1;
    }

    GltfDocument& document_;
    tinygltf::Model& model_;
    std::vector<DecodedMesh> decoded_;
    std::string place_;
};

}  // namespace

void decode_draco_primitives(GltfDocument& document) { DracoDecoder(document).decode(); }

}  // namespace render_system
