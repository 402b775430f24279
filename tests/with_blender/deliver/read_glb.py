"""Blender runs this: imports a .glb and writes the extent of each object's second UV layer.

    blender -b --factory-startup --python read_glb.py -- GLB JSON
"""
import builtins
import json
import sys

import bpy
import numpy

for name in ("bool", "int", "float", "object"):  # the importer of Blender 3.x uses what numpy 1.24 took away
    if not hasattr(numpy, name):
        setattr(numpy, name, getattr(builtins, name))
glb, listing = sys.argv[sys.argv.index("--") + 1:]
for ob in list(bpy.data.objects):
    bpy.data.objects.remove(ob)
bpy.ops.import_scene.gltf(filepath=glb)
found = {}
for ob in bpy.data.objects:
    if ob.type != "MESH":
        continue
    uv = numpy.empty(2 * len(ob.data.loops), dtype=numpy.float32)
    ob.data.uv_layers[1].data.foreach_get("uv", uv)
    uv = uv.reshape(-1, 2)
    uv[:, 1] = 1 - uv[:, 1]  # glTF's v runs downwards
    found[ob.name] = {"low": uv.min(0).tolist(), "high": uv.max(0).tolist()}
with open(listing, "w", encoding="utf-8") as stream:
    json.dump(found, stream)
