// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include <draco/compression/decode.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "render_system/importer/draco_exchange.h"
#include "render_system/importer/importer.h"

namespace importer {

namespace {

[[noreturn]] void refuse(const std::string& what) { throw ImportError{what + "; export the file again"}; }

std::string read_all(int file) {
    std::string all;
    char block[1 << 16];
    for (;;) {
        const ssize_t got = read(file, block, sizeof(block));
        if (got < 0) throw ImportError{"cannot be read"};
        if (got == 0) return all;
        all.append(block, static_cast<size_t>(got));
    }
}

uint32_t gltf_component_type(draco::DataType type) {
    switch (type) {
        case draco::DT_INT8:
            return 5120;
        case draco::DT_UINT8:
            return 5121;
        case draco::DT_INT16:
            return 5122;
        case draco::DT_UINT16:
            return 5123;
        case draco::DT_UINT32:
            return 5125;
        case draco::DT_FLOAT32:
            return 5126;
        default:
            refuse("has a Draco attribute of a type that glTF does not know");
    }
}

DracoAttribute description_of(const draco::PointAttribute& attribute) {
    DracoAttribute description;
    description.id = attribute.unique_id();
    description.component_type = gltf_component_type(attribute.data_type());
    description.components = static_cast<uint32_t>(attribute.num_components());
    description.component_size = static_cast<uint32_t>(draco::DataTypeLength(attribute.data_type()));
    return description;
}

void write_corners(const draco::Mesh& mesh) {
    std::vector<uint32_t> corners;
    corners.reserve(size_t{3} * mesh.num_faces());
    for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i) {
        for (const draco::PointIndex& point : mesh.face(i)) corners.push_back(point.value());
    }
    write_out(corners.data(), corners.size() * sizeof(uint32_t));
}

void write_values(const draco::Mesh& mesh, const draco::PointAttribute& attribute, size_t element_size) {
    std::vector<uint8_t> values(element_size * mesh.num_points());
    for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
        const draco::AttributeValueIndex value = attribute.mapped_index(i);
        if (value.value() >= attribute.size()) refuse("has a Draco point without a value");
        attribute.GetValue(value, &values[i.value() * element_size]);
    }
    write_out(values.data(), values.size());
}

void decode_stream(const char* data, size_t size) {
    draco::DecoderBuffer buffer;
    buffer.Init(data, size);
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&buffer);
    if (!decoded.ok()) refuse("its Draco data are damaged (" + decoded.status().error_msg_string() + ")");
    const std::unique_ptr<draco::Mesh> mesh = std::move(decoded).value();
    DracoMesh header;
    header.points = mesh->num_points();
    header.triangles = mesh->num_faces();
    header.attributes = static_cast<uint32_t>(mesh->num_attributes());
    std::vector<DracoAttribute> attributes;
    for (int i = 0; i < mesh->num_attributes(); ++i) attributes.push_back(description_of(*mesh->attribute(i)));
    write_out(&header, sizeof(header));
    write_out(attributes.data(), attributes.size() * sizeof(DracoAttribute));
    write_corners(*mesh);
    for (int i = 0; i < mesh->num_attributes(); ++i) {
        const DracoAttribute& description = attributes[static_cast<size_t>(i)];
        write_values(*mesh, *mesh->attribute(i), size_t{description.components} * description.component_size);
    }
}

}  // namespace

void decode_draco_streams() {
    const std::string input = read_all(STDIN_FILENO);
    for (size_t at = 0; at + sizeof(uint64_t) <= input.size();) {
        uint64_t size = 0;
        input.copy(reinterpret_cast<char*>(&size), sizeof(size), at);
        at += sizeof(size);
        if (size > input.size() - at) refuse("is cut off");
        decode_stream(input.data() + at, size);
        at += size;
    }
}

}  // namespace importer
