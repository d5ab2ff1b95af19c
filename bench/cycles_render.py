# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Runs Cycles inside Blender, for bench/compare_renderers.py, bench/equal_time.py and bench/beside_blender.py, which
say how:

    blender -b --factory-startup --python-exit-code 2 --python bench/cycles_render.py -- '{"scene": "scene.gltf", ...}'

Prints one line, "CYCLES " and JSON: Blender's version and either the seconds that a sample per pixel takes, with and
without roulette (the difference of two renders over the difference of their samples, so that loading, building the tree
and starting up drop out), or, where the job names "pictures", the processor seconds of each, with roulette: it is written
as linear EXR.
"""
import json
import math
import sys
import time

import bpy
import numpy
from mathutils import Matrix, Vector


def to_blender(point):
    """glTF has y up, Blender z."""
    x, y, z = point
    return Vector((x, -z, y))


def placed(data, x, y, z, origin):
    """An object in the scene with these axes."""
    thing = bpy.data.objects.new(data.name, data)
    thing.matrix_world = Matrix.Translation(origin) @ Matrix((x, y, z)).transposed().to_4x4()
    bpy.context.scene.collection.objects.link(thing)
    return thing


def set_camera(view):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle = view["vfov"]
    camera.clip_start, camera.clip_end = 1e-3, 1e6
    eye = to_blender(view["position"])
    back = (eye - to_blender(view["target"])).normalized()
    right = to_blender(view["up"]).cross(back).normalized()
    bpy.context.scene.camera = placed(camera, right, back.cross(right), back, eye)


def set_sky(radiance):
    world = bpy.data.worlds.new("sky")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (*radiance, 1)
    bpy.context.scene.world = world


def add_light(corners, radiance):
    """A rectangle that emits along its -z. Blender's power is 4 times its area times the radiance."""
    a, b, c, d = map(to_blender, corners)
    x, y = b - a, d - a
    light = bpy.data.lights.new("light", "AREA")
    light.shape, light.size, light.size_y = "RECTANGLE", x.length, y.length
    brightest = max(radiance)
    light.energy = 4 * x.length * y.length * brightest
    light.color = [channel / brightest for channel in radiance] if brightest > 0 else (0, 0, 0)
    placed(light, x.normalized(), -y.normalized(), -x.cross(y).normalized(), (a + c) / 2)


def load(job):
    numpy.bool = bool  # Debian 12's Blender still asks for this name, which its numpy has dropped
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=job["scene"])
    set_camera(job["view"])
    set_sky(job["sky"])
    for light in job["area_lights"]:
        add_light(light["corners"], light["radiance"])


def set_options(job):
    """Cycles follows the camera ray, max_bounces more, and one that sees lights only: a path of max_bounces + 2 segments."""
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    render.engine = "CYCLES"
    render.resolution_x, render.resolution_y = job["size"]
    render.resolution_percentage = 100
    render.threads_mode, render.threads = "FIXED", job["threads"]
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = False
    cycles.use_denoising = False
    cycles.light_sampling_threshold = 0
    cycles.max_bounces = job["max_path_length"] - 2
    cycles.diffuse_bounces = cycles.glossy_bounces = cycles.transmission_bounces = cycles.max_bounces


def seconds(samples):
    bpy.context.scene.cycles.samples = samples
    start = time.perf_counter()
    bpy.ops.render.render()
    return time.perf_counter() - start


def seconds_per_sample(job, roulette):
    cycles = bpy.context.scene.cycles
    cycles.min_light_bounces = 0 if roulette else job["max_path_length"]
    cycles.min_transparent_bounces = 0 if roulette else cycles.transparent_max_bounces
    seconds(1)
    return (seconds(2 + job["frames"]) - seconds(2)) / job["frames"]


def write_pictures(job):
    """Nothing that a converged picture would lack or that mixes pixels: no clamping, sharp reflections, a box filter."""
    render, cycles = bpy.context.scene.render, bpy.context.scene.cycles
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    cycles.pixel_filter_type = "BOX"
    cycles.min_light_bounces = cycles.min_transparent_bounces = 0
    settings = render.image_settings
    settings.file_format, settings.color_depth, settings.color_mode = "OPEN_EXR", "32", "RGB"
    taken = []
    for picture in job["pictures"]:
        render.filepath, cycles.samples, cycles.seed = picture["file"], picture["samples"], picture["seed"]
        if "seconds" in picture:
            frame = picture["seconds"] * render.fps / render.fps_base
            bpy.context.scene.frame_set(math.floor(frame), subframe=frame - math.floor(frame))
        start = time.process_time()
        bpy.ops.render.render(write_still=True)
        taken.append(time.process_time() - start)
    return taken


def main():
    job = json.loads(sys.argv[-1])
    load(job)
    set_options(job)
    if "pictures" in job:
        print("CYCLES", json.dumps({"version": bpy.app.version_string, "processor_seconds": write_pictures(job)}))
        return
    print("CYCLES", json.dumps({"version": bpy.app.version_string, "no roulette": seconds_per_sample(job, False),
                                "roulette": seconds_per_sample(job, True)}))


main()
