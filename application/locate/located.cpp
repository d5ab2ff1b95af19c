// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "application/locate/located.h"

#include <fmt/format.h>

#include <algorithm>

namespace application {

using render_system::HostScene;
using render_system::PathKernel;

namespace {

constexpr size_t kMostNames = 8;  // what a difference is on, the most frequent first

std::string material_name(const HostScene& scene, uint32_t material) {
    const auto& materials = scene.materials();
    if (material < materials.size() && !materials[material].name.empty()) return materials[material].name;
    return fmt::format("material {}", material);
}

std::string instance_name(const HostScene& scene, uint32_t instance) {
    for (const render_system::HostNode& node : scene.nodes())
        if (node.instance == instance && !node.name.empty()) return node.name;
    return fmt::format("instance {}", instance);
}

template <class Name>
Json names(const HostScene& scene, const std::map<uint32_t, uint64_t>& counts, Name name) {
    std::vector<std::pair<uint32_t, uint64_t>> sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    Json result = Json::array();
    for (const auto& [id, count] : sorted)
        if (result.size() < kMostNames) result.push_back(name(scene, id));
    return result;
}

/// Segments count from 1, the ray of the camera.
uint32_t shown_segment(const KernelDifference& difference, const Options& options) {
    if (difference.kernel == PathKernel::generate) return 1;
    return difference.kernel == PathKernel::finalize ? options.max_path_length : difference.segment;
}

std::string list_text(const Json& list) {
    std::string text;
    for (const Json& name : list) text += (text.empty() ? "" : ", ") + name.get<std::string>();
    return text.empty() ? "-" : text;
}

/// "; none ran through shade, connect", where the scene shows nothing of what these do; "" where all ran.
std::string kernels_without_paths(const Json& located) {
    std::string list;
    for (uint32_t i = 0; i < render_system::PATH_KERNELS; ++i) {
        const std::string name = kernel_name(static_cast<PathKernel>(i));
        if (located["compared"][name] == 0) list += (list.empty() ? "" : ", ") + name;
    }
    return list.empty() ? "" : "; none ran through " + list;
}

std::array<uint8_t, 3> colour_of(uint8_t parted_in) {
    constexpr std::array<std::array<uint8_t, 3>, render_system::PATH_KERNELS> COLOURS = {
        {{255, 0, 255}, {255, 0, 0}, {255, 255, 0}, {0, 255, 255}, {255, 255, 255}}};
    return parted_in == PathDifferences::TIE ? std::array<uint8_t, 3>{64, 64, 255} : COLOURS.at(parted_in - 1u);
}

}  // namespace

Json located_json(const PathDifferences& differences, const HostScene& scene, const Options& options) {
    Json compared = Json::object();
    for (uint32_t i = 0; i < render_system::PATH_KERNELS; ++i)
        compared[kernel_name(static_cast<PathKernel>(i))] = differences.compared.at(i);
    Json list = Json::array();
    for (const KernelDifference& difference : differences.kernels) {
        list.push_back({{"segment", shown_segment(difference, options)},
                        {"kernel", kernel_name(difference.kernel)},
                        {"field", field_name(difference.field())},
                        {"paths", difference.paths},
                        {"share", static_cast<double>(difference.paths) / static_cast<double>(differences.paths)},
                        {"materials", names(scene, difference.materials, material_name)},
                        {"instances", names(scene, difference.instances, instance_name)},
                        {"pixel", {difference.pixel % options.width, difference.pixel / options.width}}});
    }
    return {{"first", list.empty() ? Json(nullptr) : list.front()},
            {"mode", options.exact ? "exact" : "native"},
            {"tolerance", options.exact ? Json("bits") : Json(NATIVE_TOLERANCE)},
            {"compared", compared},
            {"explained_by_ties", differences.explained_by_ties},
            {"differences", list}};
}

std::string located_text(const Json& located) {
    const bool exact = located["mode"] == "exact";
    std::string text = exact ? "Paths held side by side after every kernel, to the bit: "
                             : fmt::format("Paths held side by side after every kernel, to {} of a number: ",
                                           located["tolerance"].get<float>());
    if (located["first"].is_null()) {
        text += "none part" + kernels_without_paths(located) + "\n";
    } else {
        const Json& first = located["first"];
        text += fmt::format("they first part in segment {}, kernel {}, at {}\n", first["segment"].get<uint32_t>(),
                            first["kernel"].get<std::string>(), first["field"].get<std::string>());
        for (const Json& one : located["differences"]) {
            text += fmt::format(
                "  {}: {} paths ({:.4g}%), first in segment {} at {}, pixel {},{}; materials: {}; instances: {}\n",
                one["kernel"].get<std::string>(), one["paths"].get<uint64_t>(), one["share"].get<double>() * 100.0,
                one["segment"].get<uint32_t>(), one["field"].get<std::string>(), one["pixel"][0].get<uint32_t>(),
                one["pixel"][1].get<uint32_t>(), list_text(one["materials"]), list_text(one["instances"]));
        }
    }
    const auto ties = located["explained_by_ties"].get<uint64_t>();
    if (ties > 0) text += fmt::format("  {} paths met another triangle at the same distance\n", ties);
    return text;
}

Channels<uint8_t> located_image(const PathDifferences& differences, const Picture& picture) {
    Channels<uint8_t> image = srgb_levels(picture);
    for (size_t pixel = 0; pixel < differences.parted_in.size(); ++pixel) {
        uint8_t* rgb = &image.rgb[pixel * 3];
        const int grey = (rgb[0] * 3 + rgb[1] * 6 + rgb[2]) / 10;
        const uint8_t parted_in = differences.parted_in[pixel];
        // What is in the picture stays to be seen below the colour.
        const auto colour = parted_in == 0 ? std::array<uint8_t, 3>{96, 96, 96} : colour_of(parted_in);
        const int light = parted_in == 0 ? grey : 96 + grey * 159 / 255;
        for (int i = 0; i < 3; ++i) rgb[i] = static_cast<uint8_t>(colour[i] * light / 255);
    }
    return image;
}

}  // namespace application
