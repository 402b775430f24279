"""Write the lightmap UVs of objects of a saved scene (saved/saved_scene.py), three for each triangle.

Request: "objects": names. Answer: "file": the UVs as pairs of float32, v upwards, one object after the other;
"triangles": of each object.
"""
import os
import sys
from array import array

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import bpy  # noqa: E402

from core import task as core_task  # noqa: E402
from opening import load  # noqa: E402
from saved import uv_order  # noqa: E402

FILE = "lightmap_uvs.f32"


def main(task):
    load.open_scene(task)
    triangles, known = [], {}
    with open(task.path(FILE), "wb") as stream:
        for name in task.request["objects"]:
            mesh = bpy.context.scene.objects[name].data
            if mesh not in known:
                known[mesh] = corner_uvs(mesh)
            known[mesh].tofile(stream)
            triangles.append(len(known[mesh]) // 6)
    return {"file": FILE, "triangles": triangles}


def corner_uvs(mesh):
    mesh.calc_loop_triangles()
    loops = array("i", bytes(12 * len(mesh.loop_triangles)))
    mesh.loop_triangles.foreach_get("loops", loops)
    uv = uv_order.read(mesh.uv_layers[uv_order.LIGHTMAP_INDEX])
    corners = array("f", bytes(8 * len(loops)))
    corners[0::2] = array("f", [uv[2 * loop] for loop in loops])
    corners[1::2] = array("f", [uv[2 * loop + 1] for loop in loops])
    return corners


core_task.run(main)
