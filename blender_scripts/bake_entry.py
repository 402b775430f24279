"""Bake what the driver planned, with the recipe it asks for. Run by Blender:

    blender -b SCENE --python bake_entry.py -- request.json

Request: "scene" (see opening/load.py), "cycles" (see scene_ops/cycles.py), "recipe", and either
"atlases" with "passes" (receiver) or "targets" (flat-normal-map). Each bake is written as raw floats beside the request.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from bake import fences, flat_normal_map, glow, own_shadow, sheets  # noqa: E402
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
    kind = sheets.MirrorSheet if task.request["cycles"]["mirrors"] else sheets.Sheet
    sheets_ = [kind(task, scene, atlas) for atlas in task.request["atlases"]]
    texels = sum(sheet.texels for sheet in sheets_)
    total = sum(part["count"] for part in task.request["passes"]) * texels
    done = 0
    for part, left_out in passes(task):
        total = max(total, done + part["count"] * texels)
        cycles.take_pass(scene, part)
        for number, (sheet, file) in enumerate(zip(sheets_, part["pixels"]), 1):
            name = f"pass {part['number'] + 1}"
            if len(sheets_) > 1:
                name += f", atlas {number} of {len(sheets_)}"
            work = range(done, done + sheet.texels * part["count"])
            sheet.bake(part, file, left_out, lambda *event: say(task, name, work, total, *event))
            done = work.stop
    task.progress("bake", name, total, total)
    return {"atlases": [sheet.timings() for sheet in sheets_]}


def passes(task):
    """Passes to bake, with the receivers that each does without; by rounds: until the driver names no more."""
    known, left_out = task.request["passes"], task.request["left_out"]
    while known:
        for part in known:
            yield part, left_out
        if not task.request["by_rounds"]:
            return
        more = task.wait_for(f"go{known[-1]['number'] + 1}.json")
        known, left_out = more["passes"], more["left_out"]


def say(task, name, work, total, phase, begun, ended=0, samples=0):
    """`begun` and `ended`: shares of a pass over an atlas, whose texels x samples are `work`."""
    task.progress(phase, name, work.start + begun * len(work), total, work.start + ended * len(work), samples)


core_task.run(main)
