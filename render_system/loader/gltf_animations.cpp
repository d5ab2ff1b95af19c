// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#include "render_system/loader/gltf_animations.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>

#include "render_system/host_scene.h"
#include "render_system/loader/gltf_accessors.h"
#include "render_system/loader/gltf_pointers.h"
#include "render_system/loader/load_error.h"

namespace render_system {

namespace {

using nlohmann::json;
using Numbers = std::span<const double>;

Interpolation interpolation_of(const json& sampler) {
    const std::string name = sampler.value("interpolation", "LINEAR");
    if (name == "STEP") return Interpolation::step;
    return name == "LINEAR" ? Interpolation::linear : Interpolation::cubic_spline;
}

GltfChannel channel_of(const json& channel, const json& samplers, const std::string& place) {
    const size_t sampler = channel["sampler"].get<size_t>();
    if (sampler >= samplers.size())
        fail_at(place + "/sampler", "is " + std::to_string(sampler) + ", but the animation has " +
                                        std::to_string(samplers.size()) + " samplers" + EXPORT_AGAIN);
    GltfChannel result;
    result.place = place;
    result.input = samplers[sampler]["input"].get<int>();
    result.output = samplers[sampler]["output"].get<int>();
    result.interpolation = interpolation_of(samplers[sampler]);
    const json& target = channel["target"];
    result.node = target.value("node", -1);
    result.path = target["path"].get<std::string>();
    const json extensions = target.value("extensions", json::object());
    if (result.path == "pointer" && extensions.contains("KHR_animation_pointer"))
        result.pointer = extensions["KHR_animation_pointer"]["pointer"].get<std::string>();
    else if (result.node >= 0)
        result.pointer = "/nodes/" + std::to_string(result.node) + "/" + result.path;
    return result;
}

// How many numbers a node's part has; 0: it is no such part.
uint32_t width_of_part(const std::string& part) {
    if (part == "translation" || part == "scale") return 3;
    return part == "rotation" ? 4 : 0;
}

class AnimationReader {
public:
    AnimationReader(GltfDocument& document, const SceneParts& parts, const HostScene& scene)
        : document_(document), parts_(parts), scene_(scene) {}

    Animation read() {
        for (const GltfChannel& channel : document_.channels) {
            const auto pointed = split_pointer(channel.pointer);
            if (!pointed) {
                // A channel without a target is to be passed over (glTF 2.0, 3.11).
                if (!channel.pointer.empty()) leave_out(channel);
                continue;
            }
            if (!takes(channel)) continue;
            if (pointed->list == "/nodes")
                read_node(channel, *pointed);
            else if (pointed->list == "/materials")
                read_material(channel, *pointed);
            else if (pointed->list == "/cameras")
                read_camera(channel, *pointed);
            else
                read_light(channel, *pointed);
        }
        return std::move(animation_);
    }

private:
    void leave_out(const GltfChannel& channel) {
        document_.omissions.add("animations of other properties", channel.pointer);
    }

    // Of two animations that move the same the first counts.
    bool takes(const GltfChannel& channel) {
        if (taken_.insert(channel.pointer).second) return true;
        document_.omissions.add("animations of what another moves already",
                                "/animations/" + std::to_string(channel.animation));
        return false;
    }

    void check_index(const GltfChannel& channel, const PointedProperty& pointed, size_t count) const {
        if (static_cast<size_t>(pointed.index) < count) return;
        fail_at(channel.place + "/target",
                "points at " + channel.pointer + ", but there are " + std::to_string(count) + EXPORT_AGAIN);
    }

    void read_node(const GltfChannel& channel, const PointedProperty& pointed) {
        check_index(channel, pointed, document_.model.nodes.size());
        const auto node = parts_.nodes.find(pointed.index);
        const uint32_t width = width_of_part(pointed.property);
        if (pointed.property == "weights") return read_weights(channel, pointed.index);
        if (width == 0) return leave_out(channel);
        if (node == parts_.nodes.end()) return;  // of another scene
        const tinygltf::Node& source = document_.model.nodes[static_cast<size_t>(pointed.index)];
        if (!source.matrix.empty())
            fail_at(channel.place + "/target/node",
                    "names node " + std::to_string(pointed.index) +
                        ", which has a matrix; give it translation, rotation and scale");
        Track<NodeState> track{state_of(animation_.nodes, node_states_, pointed.index,
                                        [&] {
                                            return NodeState{node->second, pose_of(source)};
                                        }),
                               read_curve(channel, width, width, pointed.property == "rotation"),
                               {}};
        if (pointed.property == "translation")
            track.put = [](NodeState& state, Numbers v) { state.pose.translation = {v[0], v[1], v[2]}; };
        else if (pointed.property == "rotation")
            track.put = [](NodeState& state, Numbers v) { state.pose.rotation = glm::dquat(v[3], v[0], v[1], v[2]); };
        else
            track.put = [](NodeState& state, Numbers v) { state.pose.scale = {v[0], v[1], v[2]}; };
        animation_.nodes.tracks.push_back(std::move(track));
    }

    void read_weights(const GltfChannel& channel, int node) {
        const auto deformers = parts_.deformers.find(node);
        if (deformers == parts_.deformers.end()) return;  // of another scene, or without morph targets
        const size_t targets = scene_.deformers()[deformers->second.front()].rest->targets.size();
        if (targets == 0) return;
        const uint32_t state = state_of(animation_.weights, weight_states_, node, [&] {
            return WeightState{deformers->second, {}};
        });
        animation_.weights.tracks.push_back(
            {state, read_curve(channel, static_cast<uint32_t>(targets), 1, false),
             [](WeightState& weights, Numbers v) { weights.weights.assign(v.begin(), v.end()); }});
    }

    void read_material(const GltfChannel& channel, const PointedProperty& pointed) {
        check_index(channel, pointed, document_.model.materials.size());
        const tinygltf::Material& material = document_.model.materials[static_cast<size_t>(pointed.index)];
        const uint32_t id = static_cast<uint32_t>(pointed.index);
        add_property(channel, pointed, material_property(pointed.property, material), animation_.materials,
                     material_states_, [&] { return material_state(material, id, scene_.materials()[id].core); });
    }

    void read_light(const GltfChannel& channel, const PointedProperty& pointed) {
        check_index(channel, pointed, document_.model.lights.size());
        const auto lights = parts_.lights.find(pointed.index);
        if (lights == parts_.lights.end()) return;
        add_property(channel, pointed, light_property(pointed.property), animation_.lights, light_states_, [&] {
            const tinygltf::Light& source = document_.model.lights[static_cast<size_t>(pointed.index)];
            const PunctualLight& own = scene_.punctual_lights()[lights->second.front()];
            LightState state{lights->second, glm::dvec3(1.0), source.intensity, own.inner_cone, own.outer_cone};
            for (size_t i = 0; i < 3 && source.color.size() == 3; ++i)
                state.color[static_cast<int>(i)] = source.color[i];
            return state;
        });
    }

    void read_camera(const GltfChannel& channel, const PointedProperty& pointed) {
        check_index(channel, pointed, document_.model.cameras.size());
        const auto cameras = parts_.cameras.find(pointed.index);
        if (cameras == parts_.cameras.end()) return;
        const Camera& own = scene_.cameras()[cameras->second.front()].camera;
        const bool fits = (own.parallel_height > 0.0f) == (pointed.property == "orthographic/ymag");
        auto property = camera_property(pointed.property);
        add_property(channel, pointed, fits ? property : std::nullopt, animation_.cameras, camera_states_, [&] {
            return CameraState{cameras->second, own.vertical_fov, own.parallel_height};
        });
    }

    template <class State, class Make>
    void add_property(const GltfChannel& channel, const PointedProperty& pointed,
                      const std::optional<AnimatedProperty<State>>& property, Tracks<State>& tracks,
                      std::map<int, uint32_t>& known, Make make) {
        if (!property) return leave_out(channel);
        tracks.tracks.push_back({state_of(tracks, known, pointed.index, make),
                                 read_curve(channel, property->width, property->width, false), property->put});
    }

    // Where in `tracks.rest` the state of the file's element stands; made at its first track.
    template <class State, class Make>
    static uint32_t state_of(Tracks<State>& tracks, std::map<int, uint32_t>& known, int index, Make make) {
        const auto [entry, is_new] = known.try_emplace(index, static_cast<uint32_t>(tracks.rest.size()));
        if (is_new) tracks.rest.push_back(make());
        return entry->second;
    }

    // `width` numbers a key, in elements of `components`.
    Curve read_curve(const GltfChannel& channel, uint32_t width, int components, bool is_rotation) {
        Curve curve;
        curve.interpolation = channel.interpolation;
        curve.is_rotation = is_rotation;
        curve.width = width;
        curve.times = times_of(channel);
        curve.values = floats_of(channel.output, components);
        const uint64_t stride = uint64_t{width} * (channel.interpolation == Interpolation::cubic_spline ? 3 : 1);
        if (curve.values->size() != stride * curve.times->size())
            fail_at(channel.place, "its sampler has " + std::to_string(curve.times->size()) + " keys, which need " +
                                       std::to_string(stride * curve.times->size()) + " numbers, but " +
                                       accessor_place(channel.output) + " has " + std::to_string(curve.values->size()) +
                                       EXPORT_AGAIN);
        if (is_rotation && checked_rotations_.emplace(channel.output, curve.interpolation).second)
            name_rotations_of_nothing(curve, channel.place);
        return curve;
    }

    void name_rotations_of_nothing(const Curve& curve, const std::string& place) {
        const bool is_spline = curve.interpolation == Interpolation::cubic_spline;
        const size_t parts = is_spline ? 3 : 1;
        for (size_t key = 0; key < curve.times->size(); ++key) {
            const auto first = curve.values->begin() + static_cast<ptrdiff_t>((key * parts + (is_spline ? 1 : 0)) * 4);
            if (std::any_of(first, first + 4, [](float v) { return v != 0.0f; })) continue;
            document_.mended.add("rotations by 0, 0, 0, 0, which were made to turn nothing", place);
            return;
        }
    }

    SharedFloats times_of(const GltfChannel& channel) {
        const SharedFloats times = floats_of(channel.input, 1);
        if (times->empty()) fail_at(channel.place, "its sampler has no keys" + EXPORT_AGAIN);
        for (size_t i = 1; i < times->size() && checked_.count(channel.input) == 0; ++i) {
            if ((*times)[i] >= (*times)[i - 1]) continue;
            fail_at(accessor_place(channel.input),
                    "key " + std::to_string(i) + " is at " + std::to_string((*times)[i]) +
                        " s, before the one before it; keys must be in order" + EXPORT_AGAIN);
        }
        checked_.insert(channel.input);
        return times;
    }

    // Each accessor once, whoever shares it.
    SharedFloats floats_of(int accessor, int components) {
        SharedFloats& floats = floats_[{accessor, components}];
        if (floats) return floats;
        const uint64_t count = accessor_count(document_, accessor);
        document_.take_memory(2 * count * static_cast<uint64_t>(components) * sizeof(float), accessor_place(accessor));
        floats = std::make_shared<const std::vector<float>>(read_floats(document_, accessor, components));
        return floats;
    }

    GltfDocument& document_;
    const SceneParts& parts_;
    const HostScene& scene_;
    Animation animation_;
    std::set<std::string> taken_;
    std::set<int> checked_;
    std::set<std::pair<int, Interpolation>> checked_rotations_;
    std::map<std::pair<int, int>, SharedFloats> floats_;
    std::map<int, uint32_t> node_states_, weight_states_, material_states_, light_states_, camera_states_;
};

}  // namespace

std::vector<GltfChannel> read_channels(const json& document, Omissions& omissions) {
    std::vector<GltfChannel> channels;
    if (!document.contains("animations")) return channels;
    size_t index = 0;
    for (const json& animation : document["animations"]) {
        const std::string place = "/animations/" + std::to_string(index);
        size_t number = 0;
        for (const json& channel : animation["channels"]) {
            channels.push_back(
                channel_of(channel, animation["samplers"], place + "/channels/" + std::to_string(number++)));
            channels.back().animation = static_cast<int>(index);
        }
        if (number == 0) omissions.add("animations without channels", place);
        ++index;
    }
    return channels;
}

std::vector<std::string> animation_names(const json& document) {
    std::vector<std::string> names;
    for (const json& animation : document.value("animations", json::array()))
        names.push_back(animation.value("name", ""));
    return names;
}

void choose_animation(GltfDocument& document, const std::string& wanted) {
    if (wanted.empty()) return;
    const std::vector<std::string>& names = document.animations;
    size_t chosen = static_cast<size_t>(std::find(names.begin(), names.end(), wanted) - names.begin());
    if (chosen == names.size()) {
        const auto [end, error] = std::from_chars(wanted.data(), wanted.data() + wanted.size(), chosen);
        if (error != std::errc{} || end != wanted.data() + wanted.size()) chosen = names.size();
    }
    if (chosen >= names.size()) {
        constexpr size_t kShown = 10;
        if (names.empty()) fail_at("", "--animation: the file has no animations; leave the option out");
        std::string list;
        for (size_t i = 0; i < std::min(names.size(), kShown); ++i)
            list += (i > 0 ? ", " : "") + std::to_string(i) + (names[i].empty() ? "" : " \"" + names[i] + "\"");
        if (names.size() > kShown) list += " and " + std::to_string(names.size() - kShown) + " more";
        fail_at("", "--animation: there is no animation \"" + wanted + "\"; the file has " + list +
                        "; give one of these, by number or name");
    }
    std::erase_if(document.channels,
                  [chosen](const GltfChannel& channel) { return static_cast<size_t>(channel.animation) != chosen; });
}

std::set<int> nodes_with_animated_weights(const GltfDocument& document) {
    std::set<int> nodes;
    for (const GltfChannel& channel : document.channels) {
        const auto pointed = split_pointer(channel.pointer);
        if (pointed && pointed->list == "/nodes" && pointed->property == "weights") nodes.insert(pointed->index);
    }
    return nodes;
}

std::set<int> animated_materials(const GltfDocument& document) {
    std::set<int> materials;
    for (const GltfChannel& channel : document.channels) {
        const auto pointed = split_pointer(channel.pointer);
        if (pointed && pointed->list == "/materials") materials.insert(pointed->index);
    }
    return materials;
}

NodePose pose_of(const tinygltf::Node& node) {
    NodePose pose;
    if (node.rotation.size() == 4)
        pose.rotation = glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    for (int i = 0; i < 3 && !node.scale.empty(); ++i) pose.scale[i] = node.scale[static_cast<size_t>(i)];
    for (int i = 0; i < 3 && !node.translation.empty(); ++i)
        pose.translation[i] = node.translation[static_cast<size_t>(i)];
    return pose;
}

Animation read_animation(GltfDocument& document, const SceneParts& parts, const HostScene& scene) {
    return AnimationReader(document, parts, scene).read();
}

}  // namespace render_system
