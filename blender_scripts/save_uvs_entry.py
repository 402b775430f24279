"""Save a copy of the scene in which what was unwrapped has its lightmap UVs.

Request: "objects": [{"key", "name", "uv_array"}]. Objects whose mesh is evaluated by modifiers into another
one, curves and instances become plain meshes; what can keep its modifiers keeps them.
"""
import os
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from scene_ops import load, realize  # noqa: E402
from scene_ops.receivers import read_floats  # noqa: E402

LAYER = "Lightmap"


def main(task):
    load.open_scene(task)
    entries = task.request["objects"]
    loose = [entry for entry in entries if not fits(task, entry)]
    made = realize.realize({entry["key"] for entry in loose})
    for entry in entries:
        ob = made.get(entry["key"]) or bpy.data.objects[entry["name"]]
        write_layer(task, entry, ob.data)
    bpy.ops.wm.save_as_mainfile(filepath=task.path("with_uvs.blend"), copy=True, compress=True,
                                relative_remap=True)
    return {"blend": "with_uvs.blend", "realized": sorted(made)}


def loops_of(task, entry):
    return os.path.getsize(task.path(entry["uv_array"])) // 8


def fits(task, entry):
    """Whether the object's own mesh has the very corners that were unwrapped."""
    ob = bpy.data.objects.get(entry["name"])
    if ob is None or entry["key"] != ob.name or ob.type != "MESH" or ob.library or ob.data.library:
        return False
    changes = [m for m in ob.modifiers if m.show_render and m.type not in ("ARMATURE", "LATTICE", "CAST", "SMOOTH")]
    return not changes and len(ob.data.loops) == loops_of(task, entry)


def write_layer(task, entry, mesh):
    layer = mesh.uv_layers.get(LAYER) or mesh.uv_layers.new(name=LAYER, do_init=False)
    with open(task.path(entry["uv_array"]), "rb") as stream:
        layer.data.foreach_set("uv", read_floats(stream, 2 * len(mesh.loops)))


core_task.run(main)
