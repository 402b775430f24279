"""Save a copy of the scene in which every object that has lightmaps holds their UVs (saved/saved_scene.py).

Request: "objects": [{"key", "uv_layer", "faces" (file), "uv_array" (file, of what was unwrapped)}], "imported":
whether the user's scene is no .blend, "save_as": where to. That has to be the folder in which the file will stay:
relative paths lead from there.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from opening import load  # noqa: E402
from saved import saved_scene  # noqa: E402
from scene_ops import saving  # noqa: E402


def main(task):
    load.open_scene(task)
    objects = saved_scene.settle(task)
    if task.request["imported"] and bpy.data.filepath:
        bpy.ops.file.make_paths_relative()  # as in glTF and OBJ; an import makes whole ones of them
    bpy.context.preferences.filepaths.save_version = 0  # no backup of the file that is there to be written over
    saving.save_copy(task.request["save_as"], compress=True, relative_remap=True, check_existing=False)
    return {"objects": objects}


core_task.run(main)
