// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_meshopt.h"

#include <meshoptimizer.h>

#include <algorithm>

#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

// No mode packs tighter: a stream of attributes takes at least 4 bytes for 256 of one byte each.
constexpr uint64_t kMostMeshoptPacking = 128;

struct PackedView {
    std::string place;
    std::string mode;
    std::string filter;
    uint64_t count = 0;
    uint64_t stride = 0;
    Bytes stream;
};

// What the extension's own text asks for under "For the extension object to be valid"; the decoders rely on it.
void check_layout(const PackedView& view) {
    const bool attributes = view.mode == "ATTRIBUTES";
    const bool known_stride = attributes ? view.stride % 4 == 0 && view.stride > 0 && view.stride <= 256
                                         : view.stride == 2 || view.stride == 4;
    const bool fits_filter = view.filter == "NONE" || (attributes && view.filter == "EXPONENTIAL") ||
                             (attributes && view.filter == "OCTAHEDRAL" && (view.stride == 4 || view.stride == 8)) ||
                             (attributes && view.filter == "QUATERNION" && view.stride == 8);
    if (!known_stride || !fits_filter) {
        fail_at(view.place, "a byteStride of " + std::to_string(view.stride) + " does not go with mode " + view.mode +
                                " and filter " + view.filter + EXPORT_AGAIN);
    }
    if (view.mode == "TRIANGLES" && view.count % 3 != 0) {
        fail_at(view.place, std::to_string(view.count) + " indices make no whole triangles" + EXPORT_AGAIN);
    }
    if (view.count > view.stream.size() * kMostMeshoptPacking / view.stride) {
        fail_at(view.place, "has " + std::to_string(view.stream.size()) + " bytes for " + std::to_string(view.count) +
                                " elements; it is cut off, copy or export the file again");
    }
}

PackedView packed_view(const json& part, const GltfDocument& document, const std::string& place) {
    PackedView view;
    view.place = place;
    view.mode = part["mode"];
    view.filter = part.value("filter", "NONE");
    view.count = part["count"].get<uint64_t>();
    view.stride = part["byteStride"].get<uint64_t>();
    const Bytes buffer = document.buffers[part["buffer"].get<size_t>()].bytes;
    const uint64_t offset = part.value("byteOffset", uint64_t{0}), length = part["byteLength"].get<uint64_t>();
    if (offset > buffer.size() || length > buffer.size() - offset) {
        fail_at(place, "reaches to byte " + std::to_string(offset + length) + ", but its buffer has " +
                           std::to_string(buffer.size()) + EXPORT_AGAIN);
    }
    view.stream = buffer.subspan(offset, length);
    check_layout(view);
    return view;
}

int run_decoder(const PackedView& view, std::vector<std::byte>& out) {
    const auto* stream = reinterpret_cast<const unsigned char*>(view.stream.data());
    if (view.mode == "TRIANGLES")
        return meshopt_decodeIndexBuffer(out.data(), view.count, view.stride, stream, view.stream.size());
    if (view.mode == "INDICES")
        return meshopt_decodeIndexSequence(out.data(), view.count, view.stride, stream, view.stream.size());
    return meshopt_decodeVertexBuffer(out.data(), view.count, view.stride, stream, view.stream.size());
}

std::vector<std::byte> unpacked(const PackedView& view) {
    // The filters go four elements at a time, past the last one.
    const uint64_t padded = (view.count + 3) / 4 * 4;
    std::vector<std::byte> out(padded * view.stride);
    if (view.count > 0 && run_decoder(view, out) != 0) {
        fail_at(view.place, "its packed data are damaged, or of a version later than 0; copy or export the file again");
    }
    if (view.filter == "OCTAHEDRAL") meshopt_decodeFilterOct(out.data(), padded, view.stride);
    if (view.filter == "QUATERNION") meshopt_decodeFilterQuat(out.data(), padded, view.stride);
    if (view.filter == "EXPONENTIAL") meshopt_decodeFilterExp(out.data(), padded, view.stride);
    out.resize(view.count * view.stride);
    return out;
}

uint64_t bytes_in_buffers(const GltfDocument& document) {
    uint64_t bytes = 0;
    for (const GltfBuffer& buffer : document.buffers) bytes += buffer.bytes.size();
    return bytes;
}

}  // namespace

const char* meshopt_name(const json& view) {
    if (!view.contains("extensions")) return nullptr;
    for (const char* name : {"EXT_meshopt_compression", "KHR_meshopt_compression"}) {
        if (view["extensions"].contains(name)) return name;
    }
    return nullptr;
}

const json* meshopt_part(const json& view) {
    const char* name = meshopt_name(view);
    return name ? &view["extensions"][name] : nullptr;
}

std::vector<bool> meshopt_fallback_buffers(const json& document) {
    std::vector<bool> fallback(document.contains("buffers") ? document["buffers"].size() : 0, false);
    const json views = document.value("bufferViews", json::array());
    for (const json& view : views) {
        if (meshopt_part(view)) fallback[view["buffer"].get<size_t>()] = true;
    }
    for (const json& view : views) {
        const json* part = meshopt_part(view);
        fallback[(part ? *part : view)["buffer"].get<size_t>()] = false;
    }
    return fallback;
}

void decode_meshopt_views(const json& root, GltfDocument& document) {
    if (!root.contains("bufferViews")) return;
    // Views may share one stream, so that a small file could ask for any amount.
    uint64_t left = kMostMeshoptPacking * bytes_in_buffers(document);
    int index = 0;
    for (const json& view : root["bufferViews"]) {
        const int number = index++;
        const json* part = meshopt_part(view);
        if (!part) continue;
        const std::string place = "/bufferViews/" + std::to_string(number) + "/extensions/" + meshopt_name(view);
        const PackedView packed = packed_view(*part, document, place);
        if (view["byteLength"].get<uint64_t>() > packed.count * packed.stride) {
            fail_at(place, "its " + std::to_string(packed.count) + " elements do not fill the view" + EXPORT_AGAIN);
        }
        if (packed.count * packed.stride > left) {
            fail_at(place, "the packed views hold far more than the file; each stream can be used once" + EXPORT_AGAIN);
        }
        left -= packed.count * packed.stride;
        document.decoded_views[number] = unpacked(packed);
    }
}

}  // namespace render_system
