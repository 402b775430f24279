"""Makes a .blend of a file that Blender has to import: glTF, OBJ."""
import json
import os

import bpy

from core.task import IO, UNSUPPORTED, Refusal
from importing.import_gltf import import_gltf
from importing.importers import run_importer
from opening.inputs import entry, scene_inputs
from opening.load import NOTES_PROPERTY
from scene_ops.saving import save_copy

BLEND = "imported.blend"


def import_scene(task):
    """The name of the .blend, in the task's folder, and the files that were read beside the user's own. What of the
    file nobody follows is noted in its scene."""
    path = task.request["scene"]
    load = {".glb": import_gltf, ".gltf": import_gltf, ".obj": import_obj}.get(os.path.splitext(path)[1].lower())
    if load is None:
        raise Refusal(f"{path}: not a .blend, .glb, .gltf or .obj file", UNSUPPORTED)
    if not os.path.isfile(path):
        raise Refusal(f"{path}: no such file", IO)
    task.progress("load", os.path.basename(path))
    bpy.ops.wm.read_factory_settings(use_empty=True)
    notes, inputs = load(task)
    inputs += scene_inputs()  # pictures; before the scene has a place of its own
    bpy.context.view_layer.update()
    bpy.context.scene[NOTES_PROPERTY] = json.dumps(notes)
    save_copy(task.path(BLEND), relative_remap=False, check_existing=False)
    return {"blend": BLEND, "inputs": inputs}


def import_obj(task):
    """By Blender's own importer (3.3 and later), which turns Y up into Z up."""
    path = task.request["scene"]
    run_importer("OBJ", path, lambda: bpy.ops.wm.obj_import(filepath=path))
    return [], [entry("material library", library) for library in material_libraries(path)]


def material_libraries(path):
    """The .mtl files that an OBJ names."""
    with open(path, "rb") as stream:
        lines = [line[6:].strip() for line in stream if line.startswith(b"mtllib")]
    folder = os.path.dirname(os.path.abspath(path))
    return [os.path.join(folder, os.fsdecode(line)) for line in lines]
