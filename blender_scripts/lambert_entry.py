"""Blender runs this for --materials lambert: docs/lambert.md.

Answers with lambert.blend: the scene as plain mesh objects under their old names, each with its own baked albedo
and emission in place of its materials; lights and world as they were. The bake then goes on with that file.
"""
import json
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core.task import run  # noqa: E402
from lambert import albedo, collect, flat_scene, notes  # noqa: E402
from opening.inputs import scene_inputs  # noqa: E402
from opening.load import open_to_measure, refuse_blocked_scripts, scene_warnings  # noqa: E402
from scene_ops import displacement  # noqa: E402
from scene_ops.saving import save_copy  # noqa: E402
from survey.surveyor import DigestSurveyor, survey_scene  # noqa: E402

FILE = "lambert.blend"


def main(task):
    warnings = open_to_measure(task)
    warnings = scene_warnings() + warnings
    inputs = scene_inputs()
    notes.remember_camera(bpy.context.scene)
    notes.remember_probe_places(bpy.context.scene)
    warnings += displacement.settle()
    task.progress("evaluate")
    surveyor = DigestSurveyor(task)  # of the user's scene: baked colours are not the same to the bit in every run
    survey_scene(task, surveyor)
    shown = collect.Scene()
    refuse_blocked_scripts(task)  # drivers are found out only when they are evaluated
    flat_scene.rebuild(shown)
    warnings += shown.warnings + albedo.replace_materials(task, shown.surfaces)
    flat_scene.drop_originals(shown)
    bpy.context.scene[notes.OUTSIDE] = json.dumps(shown.outside)
    # Relative paths, such as those of sky pictures, must lead to the same files from the new place.
    save_copy(task.path(FILE), relative_remap=True, check_existing=False)
    return {"blend": FILE, "warnings": warnings, "inputs": inputs,
            "digest": surveyor.digest.entries()}


run(main)
