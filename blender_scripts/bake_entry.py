"""Bake what the driver planned, with the recipe it asks for. Run by Blender:

    blender -b SCENE --python bake_entry.py -- request.json

Request: "scene" (see scene_ops/load.py), "cycles" (see scene_ops/cycles.py), "recipe", and either
"atlases" (receiver) or "targets" (flat-normal-map). Each bake is written as raw floats beside the request.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from core.stopwatch import Stopwatch  # noqa: E402
from scene_ops import cycles, flat_normal_map, glow, load, receivers  # noqa: E402


def main(task):
    task.progress("load")
    load.open_scene(task)
    scene = bpy.context.scene
    if task.request["recipe"] == "receiver":
        glow.leave_large_emitters_to_chance()
        return bake_receivers(task, scene)
    return flat_normal_map.bake_targets(task, scene)


def bake_receivers(task, scene):
    cycles.apply_settings(scene, task.request["cycles"])
    timings = []
    for index, atlas in enumerate(task.request["atlases"]):
        timings.append(bake_atlas(task, scene, atlas, index))
    return {"atlases": timings}


def bake_atlas(task, scene, atlas, index):
    """One image, filled by one bake call for each light-linking group among its receivers."""
    name, texels = f"atlas {index + 1}", atlas["covered_texels"]
    image = cycles.new_float_image(name, atlas["width"], atlas["height"])
    clock, prepare, bake = Stopwatch(), 0, 0
    with open(task.path(atlas["arrays"]), "rb") as stream:
        for number, group in enumerate(atlas["groups"]):
            task.progress("build", name, 0, texels)
            mesh = receivers.build_mesh("rnmbake receiver", stream, group["corners"])
            receiver = receivers.make_receiver(scene, mesh, receivers.make_material(image), group["like"])
            prepare += clock.lap()
            task.progress("bake", name, 0, texels)
            cycles.bake_diffuse(scene, receiver, clear=number == 0)
            bake += clock.lap()
            bpy.data.meshes.remove(mesh)  # and with it the receiver
    cycles.save_pixels(image, task.path(atlas["pixels"]))
    bpy.data.images.remove(image)
    task.progress("bake", name, texels, texels)
    return {"prepare_seconds": prepare, "bake_seconds": bake, "save_seconds": clock.lap()}


core_task.run(main)
