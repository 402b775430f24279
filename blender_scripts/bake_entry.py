"""Bake what the driver planned, with the recipe it asks for. Run by Blender:

    blender -b SCENE --python bake_entry.py -- request.json

Request: "scene" (see opening/load.py), "cycles" (see scene_ops/cycles.py), "recipe", and either
"atlases" (receiver) or "targets" (flat-normal-map). Each bake is written as raw floats beside the request.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from core.stopwatch import Stopwatch  # noqa: E402
from bake import fences, flat_normal_map, glow, own_shadow, receivers  # noqa: E402
from objects import realize  # noqa: E402
from opening import load  # noqa: E402
from scene_ops import cycles, displacement, lamps  # noqa: E402


def main(task):
    task.progress("load")
    load.open_to_measure(task)
    displacement.settle()
    scene = bpy.context.scene
    if not task.request["cycles"]["lamps"]:
        lamps.put_out()
    if task.request["recipe"] == "receiver":
        realize.remove(task.request["absent"])
        glow.leave_large_emitters_to_chance()
        guard_faces(task, scene, task.request.get("guards"))
        return bake_receivers(task, scene)
    return flat_normal_map.bake_targets(task, scene)


def guard_faces(task, scene, guards):
    """What keeps light from below a face from the receivers on it. Receivers in free space have no guards, and must not: a
    see-through or glowing face right beside them is another's, whose light is theirs."""
    if guards is None:
        return
    glow.hide_from_own_receivers(guards["glow_heights"])
    own_shadow.block_light_from_below(scene)
    fences.build(task, scene, guards["fences"])


def bake_receivers(task, scene):
    cycles.apply_settings(scene, task.request["cycles"])
    atlases = task.request["atlases"]
    total = sum(atlas["covered_texels"] for atlas in atlases)
    done, timings = 0, []
    for number, atlas in enumerate(atlases, 1):
        name = f"atlas {number} of {len(atlases)}"
        work = range(done, done + atlas["covered_texels"])
        timings.append(bake_atlas(task, scene, atlas, lambda *event: say(task, name, work, total, *event)))
        done = work.stop
    task.progress("bake", name, total, total)
    return {"atlases": timings}


def say(task, name, work, total, phase, begun, ended=0, samples=0):
    """`begun` and `ended`: shares of the atlas, whose covered texels are `work`."""
    task.progress(phase, name, work.start + begun * len(work), total, work.start + ended * len(work), samples)


def bake_atlas(task, scene, atlas, tell):
    """One image, filled by one bake call for each light-linking group among its receivers."""
    image = cycles.new_float_image("rnmbake atlas", atlas["width"], atlas["height"])
    samples = cycles.samples_of_picture(scene, atlas["width"], atlas["height"])
    clock, prepare, bake = Stopwatch(), 0, 0
    with open(task.path(atlas["arrays"]), "rb") as stream:
        for number, group in enumerate(atlas["groups"]):
            begun, ended = number / len(atlas["groups"]), (number + 1) / len(atlas["groups"])
            tell("build", begun)
            mesh = receivers.build_mesh("rnmbake receiver", stream, group["corners"])
            receiver = receivers.make_receiver(scene, mesh, receivers.make_material(image), group["light_group"])
            prepare += clock.lap()
            tell("bake", begun, ended, samples)
            cycles.bake_diffuse(scene, receiver, clear=number == 0)
            bake += clock.lap()
            bpy.data.meshes.remove(mesh)  # and with it the receiver
    cycles.save_pixels(image, task.path(atlas["pixels"]))
    bpy.data.images.remove(image)
    return {"prepare_seconds": prepare, "bake_seconds": bake, "save_seconds": clock.lap()}


core_task.run(main)
