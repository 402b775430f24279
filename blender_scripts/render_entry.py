"""Cycles or Eevee renders a camera's view, for `rnmbake render --with` (docs/render.md). Run by Blender:

    blender -b SCENE --python render_entry.py -- request.json

Request: "scene" (see opening/load.py), "engine" ("cycles" or "eevee"), "cycles" (see scene_ops/cycles.py), "camera"
(docs/rnmscene-format.md), "pixel_shape" (width of a pixel over its height), "width", "height", "normal_maps" (whether
lambert materials get theirs back) and "seeds". Answers with one linear EXR for each seed.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core.task import run  # noqa: E402
from opening.load import open_to_measure  # noqa: E402
from render import camera, normals  # noqa: E402
from scene_ops import cycles, eevee  # noqa: E402


def main(task):
    open_to_measure(task)
    scene, request = bpy.context.scene, task.request
    if request["normal_maps"]:
        normals.put_back()
    camera.look_through(scene, request["camera"])
    camera.size(scene, request["width"], request["height"], request["pixel_shape"])
    return {"pictures": [render(task, scene, number) for number in range(len(request["seeds"]))]}


def render(task, scene, number):
    seeds = task.request["seeds"]
    seed = seeds[number]
    settings = {**task.request["cycles"], "seed": seed}
    if task.request["engine"] == "eevee":
        eevee.apply_settings(scene, settings)
        samples = settings["samples"]
    else:
        cycles.apply_settings(scene, settings)
        samples = cycles.samples_of_picture(scene, task.request["width"], task.request["height"])
    task.progress("render", f"seed {seed}", number, len(seeds), number + 1, samples)
    camera.settle(scene)
    name = f"view{seed}.exr"
    scene.render.filepath = task.path(name)
    bpy.ops.render.render(write_still=True)
    return name


run(main)
