#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Writes the models that docs/formats.md names, each of a few hundred bytes: ./make.py, in this folder.

The packed streams (Draco 1.5.5, meshoptimizer 0.18, libwebp) are kept as text, so that this needs no encoder.
"""

import base64
import copy
import json
import struct
import zlib

DRACO = (  # a sheet of 4 x 4 squares with normals, uv and colours, by edgebreaker
    "RFJBQ08CAgEBAAAAGSADIAMACu/T6lOt6lPVqhr/ARH/AsxC/wLMQv8CzEIE/wAAAAAAAQAAAgAAAQAJAwAAAgEBCQMAAQMBAwkCAAICAQICBAADAQEBAQAMAzEzIQUXkQKRApECBpiKI5cfg/8HIAD+BxAAAP8BAEAAAAAiAAAgAAAAAAD/BwAAAAAAAAAAAAAAAAAAAAAAQAsAAwEBAYABuT7/90kBAyLfnv8AAAB/AAAACAEBAQALAxUuPQoXIQWRAgaopnTq/6H////fP4D+ICQAkIAgAgAAAAD/AwAAAAAAAAAAAAAAAIA/CgEBAQECyQGFO6QvpP9PSQGk/4tJAQksXphw8Pzn/4MAAAAA/wAAAA=="
)
MESHOPT = {  # the same sheet: positions, triangles, normals for the filter OCTAHEDRAL
    "v": bytes.fromhex("a00000050fc3f0fcff8080ff8080ff80803f0fc000ff8080ff80800530bc2f0b7e7f7e7f7e7fc2f080007e7f7e00000500300c03ffff8000c000008001003008007c000000000000000000000000000000000000000000000000000000000000000000000000"),
    "t": bytes.fromhex("e1fe1e100e100e100ece1e160e150e140ece1e140e140e140ece1e140e140e140e0f0a007687566778a9866589689801690000"),
    "n": bytes.fromhex("a0000000000000000000000000000000000000000000000000000000000000000000007f00"),
}
WEBP = "UklGRiYAAABXRUJQVlA4IBoAAAAwAQCdASoCAAIAAAAAJaQAA3AA/v+13wAAAA=="

FLOAT, USHORT, UBYTE, SHORT, BYTE = 5126, 5123, 5121, 5122, 5120


def data_uri(kind, data):
    return f"data:{kind};base64," + base64.b64encode(data).decode()


def png(red, green, blue, alpha=255, bits=8):
    """One texel."""
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))

    header = struct.pack(">IIBBBBB", 1, 1, bits, 6, 0, 0, 0)
    texel = zlib.compress(struct.pack(">B4B" if bits == 8 else ">B4H", 0, red, green, blue, alpha))
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", texel) + chunk(b"IEND", b"")


class Model:
    """A glTF document with one buffer; starts with a triangle that has normals and two sets of coordinates."""

    def __init__(self):
        self.buffer = b""
        self.root = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                     "meshes": [], "accessors": [], "bufferViews": []}
        corners = self.floats("VEC3", [0, 0, 0, 1, 0, 0, 0, 1, 0])
        normals = self.floats("VEC3", [0, 0, 1] * 3)
        uv = self.floats("VEC2", [0, 1, 1, 1, 0, 0])
        self.primitive = {"attributes": {"POSITION": corners, "NORMAL": normals, "TEXCOORD_0": uv, "TEXCOORD_1": uv}}
        self.root["meshes"].append({"primitives": [self.primitive]})

    def view(self, data, **more):
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        view = {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(data), **more}
        self.buffer += data
        self.root["bufferViews"].append(view)
        return len(self.root["bufferViews"]) - 1

    def accessor(self, view, component, kind, count, **more):
        accessor = {"componentType": component, "type": kind, "count": count, **more}
        if view is not None:
            accessor["bufferView"] = view
        self.root["accessors"].append(accessor)
        return len(self.root["accessors"]) - 1

    def floats(self, kind, values):
        size = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}[kind]
        return self.accessor(self.view(struct.pack(f"<{len(values)}f", *values)), FLOAT, kind, len(values) // size)

    def material(self, **members):
        self.root.setdefault("materials", []).append(members)
        self.primitive["material"] = len(self.root["materials"]) - 1

    def texture(self, uri, **more):
        self.root.setdefault("images", []).append({"uri": uri})
        self.root.setdefault("textures", []).append({"source": len(self.root["images"]) - 1, **more})
        return len(self.root["textures"]) - 1

    def use(self, *names, required=True):
        self.root.setdefault("extensionsUsed", []).extend(names)
        if required:
            self.root.setdefault("extensionsRequired", []).extend(names)

    def write(self, name):
        root = copy.deepcopy(self.root)
        root["buffers"] = [{"byteLength": len(self.buffer), "uri": data_uri("application/octet-stream", self.buffer)}]
        root["buffers"] += self.root.get("buffers", [])
        with open(name + ".gltf", "w", encoding="utf-8") as file:
            json.dump(root, file)
            file.write("\n")


COLOR = data_uri("image/png", png(200, 100, 50))
LEFT_OUT = "dispersion", "diffuse_transmission"


def geometry():
    model = Model()
    attributes = model.primitive["attributes"]
    strip = {"attributes": attributes, "mode": 5}
    fan = {"attributes": {"POSITION": attributes["POSITION"]}, "mode": 6}
    model.root["meshes"][0]["primitives"] += [strip, fan]
    model.write("triangles")

    model = Model()
    where, what = model.view(b"\2"), model.view(struct.pack("<3f", 0, 2, 0))
    model.root["accessors"][0]["sparse"] = {"count": 1, "indices": {"bufferView": where, "componentType": UBYTE},
                                            "values": {"bufferView": what}}
    model.write("sparse")

    model = Model()
    view = model.view(struct.pack("<12h", 0, 0, 0, 0, 9, 0, 0, 0, 0, 9, 0, 0), byteStride=8)
    model.primitive["attributes"]["POSITION"] = model.accessor(view, SHORT, "VEC3", 3)
    model.use("KHR_mesh_quantization")
    model.write("quantized")

    model = Model()
    colors = model.view(bytes([255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255]))
    model.primitive["attributes"]["COLOR_0"] = model.accessor(colors, UBYTE, "VEC4", 3, normalized=True)
    model.write("vertex_colours")

    model = Model()
    model.root["meshes"][0]["primitives"].append({"attributes": {"POSITION": 0}, "mode": 0})
    model.write("points")

    model = Model()
    model.primitive["targets"] = [{"POSITION": 0}]
    model.root["meshes"][0]["weights"] = [0.5]
    model.write("morph_targets")


def packed():
    model = Model()
    view = model.view(base64.b64decode(DRACO))
    attributes = {"POSITION": model.accessor(None, FLOAT, "VEC3", 25), "NORMAL": model.accessor(None, FLOAT, "VEC3", 25),
                  "TEXCOORD_0": model.accessor(None, FLOAT, "VEC2", 25),
                  "COLOR_0": model.accessor(None, UBYTE, "VEC4", 25, normalized=True)}
    ids = {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2, "COLOR_0": 3}
    model.root["meshes"][0]["primitives"] = [
        {"attributes": attributes, "indices": model.accessor(None, USHORT, "SCALAR", 96),
         "extensions": {"KHR_draco_mesh_compression": {"bufferView": view, "attributes": ids}}}]
    model.use("KHR_draco_mesh_compression")
    model.write("draco")

    for name in ("EXT_meshopt_compression", "KHR_meshopt_compression"):
        model = Model()

        def add(key, mode, count, stride, **more):
            view = model.view(MESHOPT[key])
            entry = model.root["bufferViews"][view]
            part = {**entry, "mode": mode, "count": count, "byteStride": stride, **more}
            entry.update({"buffer": 1, "byteOffset": 0, "byteLength": count * stride, "extensions": {name: part}})
            return view

        corners = model.accessor(add("v", "ATTRIBUTES", 25, 12), FLOAT, "VEC3", 25)
        normals_view = add("n", "ATTRIBUTES", 25, 4, filter="OCTAHEDRAL")
        model.root["bufferViews"][normals_view]["byteStride"] = 4
        normals = model.accessor(normals_view, BYTE, "VEC3", 25, normalized=True)
        indices = model.accessor(add("t", "TRIANGLES", 96, 2), USHORT, "SCALAR", 96)
        model.root["meshes"][0]["primitives"] = [
            {"attributes": {"POSITION": corners, "NORMAL": normals}, "indices": indices}]
        model.root["buffers"] = [{"byteLength": 1000, "extensions": {name: {"fallback": True}}}]
        model.use(name, "KHR_mesh_quantization")
        model.write("meshopt" if name.startswith("EXT") else "meshopt_khr")


def nodes():
    model = Model()
    moves = model.floats("VEC3", [0, 0, 0, 2, 0, 0])
    model.root["nodes"][0]["extensions"] = {"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": moves}}}
    model.use("EXT_mesh_gpu_instancing")
    model.write("instancing")

    model = Model()
    model.root["nodes"].append({"mesh": 0, "extensions": {"KHR_node_visibility": {"visible": False}}})
    model.root["scenes"][0]["nodes"].append(1)
    model.use("KHR_node_visibility")
    model.write("visibility")

    model = Model()
    model.root["cameras"] = [{"type": "perspective", "perspective": {"yfov": 0.7, "znear": 0.1}}]
    model.root["nodes"].append({"camera": 0, "translation": [0, 0, 3]})
    model.root["scenes"][0]["nodes"].append(1)
    model.write("perspective")
    lens = {"xmag": 1, "ymag": 0.5, "znear": 0.1, "zfar": 9}
    model.root["cameras"] = [{"type": "orthographic", "orthographic": lens}]
    model.write("orthographic")

    model = Model()
    model.root["extensions"] = {"KHR_lights_punctual": {"lights": [
        {"type": "point"}, {"type": "spot", "spot": {"outerConeAngle": 0.5}}, {"type": "directional"}]}}
    for light in range(3):
        model.root["nodes"].append({"extensions": {"KHR_lights_punctual": {"light": light}}, "translation": [0, 0, 2]})
        model.root["scenes"][0]["nodes"].append(1 + light)
    model.use("KHR_lights_punctual")
    model.write("lights")

    model = Model()
    faces = [model.texture(data_uri("image/png", png(40 * face, 255, 0, 255 if face < 5 else 128))) for face in range(6)]
    light = {"intensity": 2, "rotation": [0, 0, 0, 1], "specularImageSize": 1, "specularImages": [faces],
             "irradianceCoefficients": [[1, 1, 1]] * 9}
    model.root["extensions"] = {"EXT_lights_image_based": {"lights": [light]}}
    model.root["scenes"][0]["extensions"] = {"EXT_lights_image_based": {"light": 0}}
    model.use("EXT_lights_image_based")
    model.write("image_light")

    model = Model()
    model.root["nodes"].append({"translation": [0, 0, 1]})
    model.root["nodes"].append({"rotation": [0, 0, 0.6, 0.8]})
    model.root["scenes"][0]["nodes"] += [1, 2]
    model.root["skins"] = [{"joints": [1, 2]}]
    model.root["nodes"][0]["skin"] = 0
    attributes = model.primitive["attributes"]
    for number in range(2):
        pulls = model.view(bytes([0, 1, 0, 0] * 3))
        attributes[f"JOINTS_{number}"] = model.accessor(pulls, UBYTE, "VEC4", 3)
        attributes[f"WEIGHTS_{number}"] = model.floats("VEC4", [0.25, 0.25, 0, 0] * 3)
    model.write("skin")

    model = Model()
    times = model.floats("SCALAR", [0, 1])
    places = model.floats("VEC3", [0, 0, 0, 1, 0, 0])
    model.root["animations"] = [{"samplers": [{"input": times, "output": places}],
                                 "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]
    model.write("animation")

    model = Model()
    model.material(pbrMetallicRoughness={"metallicFactor": 0})
    model.root["animations"] = [{"samplers": [], "channels": []}]

    def animate(pointer, kind, values):
        animation = model.root["animations"][0]
        animation["samplers"].append({"input": times, "output": model.floats(kind, values), "interpolation": "STEP"})
        target = {"path": "pointer", "extensions": {"KHR_animation_pointer": {"pointer": pointer}}}
        animation["channels"].append({"sampler": len(animation["samplers"]) - 1, "target": target})

    times = model.floats("SCALAR", [0, 1])
    animate("/materials/0/pbrMetallicRoughness/baseColorFactor", "VEC4", [1, 0, 0, 1, 0, 0, 1, 1])
    animate("/materials/0/pbrMetallicRoughness/roughnessFactor", "SCALAR", [0.1, 0.9])
    model.use("KHR_animation_pointer")
    model.write("animation_pointer")
    animate("/materials/0/occlusionTexture/strength", "SCALAR", [0, 1])
    model.write("animation_of_others")

    for name, list_name in (("metadata", ["KHR_xmp_json_ld", "EXT_mesh_features", "EXT_structural_metadata"]),
                            ("unknown", ["EXT_of_tomorrow"])):
        model = Model()
        model.use(*list_name)
        model.write(name)


def textures():
    model = Model()
    transform = {"offset": [0.5, 0], "rotation": 1, "scale": [2, 2]}
    info = {"index": model.texture(COLOR), "extensions": {"KHR_texture_transform": transform}}
    model.material(pbrMetallicRoughness={"baseColorTexture": info})
    model.use("KHR_texture_transform")
    model.write("texture_transform")

    model = Model()
    attributes = model.primitive["attributes"]
    attributes["TEXCOORD_2"] = model.floats("VEC2", [0, 2, 2, 2, 0, 0])
    attributes["TEXCOORD_3"] = model.floats("VEC2", [0, 3, 3, 3, 0, 0])
    texture = model.texture(COLOR)
    model.material(pbrMetallicRoughness={"baseColorTexture": {"index": texture, "texCoord": 3}},
                   emissiveFactor=[1, 1, 1], emissiveTexture={"index": texture, "texCoord": 2})
    coat = {"clearcoatFactor": 1, "clearcoatTexture": {"index": texture, "texCoord": 0}}
    model.root["materials"][0]["normalTexture"] = {"index": texture, "texCoord": 1}
    model.root["materials"][0]["extensions"] = {"KHR_materials_clearcoat": coat}
    model.write("uv_sets")
    attributes["TEXCOORD_4"] = attributes["TEXCOORD_0"]
    coat["clearcoatRoughnessTexture"] = {"index": texture, "texCoord": 4}
    model.write("fifth_uv_set")

    model = Model()
    model.material(pbrMetallicRoughness={"baseColorTexture": {"index": model.texture(COLOR), "texCoord": 2}})
    model.write("no_coordinates")

    model = Model()
    texture = model.texture(data_uri("image/png", png(0x1234, 0x0523, 0x8001, 0xFFFF, bits=16)))
    model.material(pbrMetallicRoughness={"baseColorTexture": {"index": texture}})
    model.write("sixteen_bits")

    model = Model()
    texture = model.texture("missing.png", extensions={"EXT_texture_webp": {"source": 1}})
    model.root["images"].append({"uri": "data:image/webp;base64," + WEBP})
    model.material(pbrMetallicRoughness={"baseColorTexture": {"index": texture}})
    model.use("EXT_texture_webp")
    model.write("webp")

    model = Model()
    texture = model.texture(COLOR, extensions={"KHR_texture_basisu": {"source": 1}})
    model.root["images"].append({"uri": "image.ktx2"})
    model.material(pbrMetallicRoughness={"baseColorTexture": {"index": texture}})
    model.use("KHR_texture_basisu", required=False)
    model.write("basisu_fallback")
    del model.root["textures"][0]["source"]
    model.root["extensionsRequired"] = ["KHR_texture_basisu"]
    model.write("basisu")


def materials():
    rows = {
        "emissive_strength": {"emissiveStrength": 5}, "ior": {"ior": 1.4}, "specular": {"specularFactor": 0.5},
        "sheen": {"sheenColorFactor": [1, 0.5, 0.5], "sheenRoughnessFactor": 0.5},
        "anisotropy": {"anisotropyStrength": 0.8, "anisotropyRotation": 0.5},
        "clearcoat": {"clearcoatFactor": 1, "clearcoatRoughnessFactor": 0.1},
        "iridescence": {"iridescenceFactor": 1, "iridescenceIor": 1.5},
        "transmission": {"transmissionFactor": 1}, "unlit": {}, "dispersion": {"dispersion": 0.1},
        "diffuse_transmission": {"diffuseTransmissionFactor": 1},
        "pbrSpecularGlossiness": {"specularFactor": [0.5, 0.4, 0.3], "glossinessFactor": 0.7},
    }
    for name, content in rows.items():
        model = Model()
        if name == "pbrSpecularGlossiness":
            content["specularGlossinessTexture"] = {"index": model.texture(COLOR)}
        model.material(emissiveFactor=[1, 1, 1], extensions={"KHR_materials_" + name: content})
        model.use("KHR_materials_" + name, required=name not in LEFT_OUT)
        model.write(name)
        if name in LEFT_OUT:
            model.root["extensionsRequired"] = ["KHR_materials_" + name]
            model.write(name + "_required")

    model = Model()
    model.material(extensions={"KHR_materials_volume": {"thicknessFactor": 1, "attenuationDistance": 2,
                                                        "attenuationColor": [1, 0.5, 0.5]},
                               "KHR_materials_transmission": {"transmissionFactor": 1}})
    model.use("KHR_materials_volume", "KHR_materials_transmission")
    model.write("volume")

    model = Model()
    model.material(name="blue")
    model.material(name="red")
    model.root["extensions"] = {"KHR_materials_variants": {"variants": [{"name": "blue"}, {"name": "red"}]}}
    mappings = [{"material": 0, "variants": [0]}, {"material": 1, "variants": [1]}]
    model.primitive["extensions"] = {"KHR_materials_variants": {"mappings": mappings}}
    model.use("KHR_materials_variants")
    model.write("variants")


def fbx_property(value):
    """An FBX property: text, an int of 32 bits, one of 64 (as a list of one), a float, or a tuple of a type and its array."""
    if isinstance(value, str):
        text = value.encode()
        return b"S" + struct.pack("<I", len(text)) + text
    if isinstance(value, tuple):
        kind, numbers, packed = value
        data = struct.pack(f"<{len(numbers)}{kind}", *numbers)
        data = zlib.compress(data) if packed else data
        return kind.encode() + struct.pack("<3I", len(numbers), packed, len(data)) + data
    if isinstance(value, list):
        return b"L" + struct.pack("<q", value[0])
    return b"I" + struct.pack("<i", value) if isinstance(value, int) else b"D" + struct.pack("<d", value)


def fbx_node(at, name, *properties, inner=()):
    """A node of the binary form of FBX 7.4 that begins at byte `at`; inner nodes are lists of these arguments after `at`."""
    data = b"".join(map(fbx_property, properties))
    end = at + 13 + len(name) + len(data)
    nodes = b""
    for part in inner:
        *arguments, more = part if isinstance(part[-1], dict) else (*part, {})
        nodes += fbx_node(end + len(nodes), *arguments, **more)
    nodes += b"\0" * 13 if inner else b""
    return struct.pack("<3IB", end + len(nodes), len(properties), len(data), len(name)) + name.encode() + data + nodes


def binary_fbx():
    """What sheet.fbx says, in FBX's binary form."""
    def block(name, *properties, inner):
        return (name, *properties, {"inner": inner})

    def named(name, kind):
        return f"{name}\0\1{kind}"

    def layer(kind):
        return block("LayerElement", inner=[("Type", kind), ("TypedIndex", 0)])

    def mapping(how):
        return [("Version", 101), ("Name", ""), ("MappingInformationType", how), ("ReferenceInformationType", "IndexToDirect")]

    geometry_node = block("Geometry", [10], named("sheet", "Geometry"), "Mesh", inner=[
        ("Vertices", ("d", [0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0], 1)), ("PolygonVertexIndex", ("i", [0, 1, 2, -4], 0)),
        ("GeometryVersion", 124),
        block("LayerElementUV", 0, inner=[*mapping("ByPolygonVertex"), ("UV", ("d", [0, 0, 1, 0, 1, 1, 0, 1], 1)),
                                          ("UVIndex", ("i", [0, 1, 2, 3], 0))]),
        block("LayerElementMaterial", 0, inner=[*mapping("AllSame"), ("Materials", ("i", [0], 0))]),
        block("Layer", 0, inner=[("Version", 100), layer("LayerElementUV"), layer("LayerElementMaterial")])])
    move = ("P", "Lcl Translation", "Lcl Translation", "", "A", 0.0, 0.0, 5.0)
    model = block("Model", [20], named("sheet", "Model"), "Mesh",
                  inner=[("Version", 232), block("Properties70", inner=[move])])
    paint = [("P", "DiffuseColor", "Color", "", "A", 0.5, 0.25, 0.125), ("P", "SpecularColor", "Color", "", "A", 1.0, 1.0, 1.0),
             ("P", "ShininessExponent", "Number", "", "A", 30.0), ("P", "EmissiveColor", "Color", "", "A", 0.0, 1.0, 0.0)]
    material = block("Material", [30], named("paint", "Material"), "",
                     inner=[("Version", 102), ("ShadingModel", "phong"), block("Properties70", inner=paint)])
    unit = ("P", "UnitScaleFactor", "double", "Number", "", 100.0)
    top = [block("FBXHeaderExtension", inner=[("FBXHeaderVersion", 1003), ("FBXVersion", 7400)]),
           block("GlobalSettings", inner=[("Version", 1000), block("Properties70", inner=[unit])]),
           block("Objects", inner=[geometry_node, model, material]),
           block("Connections", inner=[("C", "OO", [20], [0]), ("C", "OO", [10], [20]), ("C", "OO", [30], [20])])]
    data = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", 7400)
    for *arguments, more in top:
        data += fbx_node(len(data), *arguments, **more)
    with open("sheet_binary.fbx", "wb") as file:
        file.write(data + b"\0" * 13)


if __name__ == "__main__":
    for part in (geometry, packed, nodes, textures, materials, binary_fbx):
        part()
