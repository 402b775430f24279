"""Blender runs this: a floor under a lamp, and in it a text that runs when the file is opened (prisoner.py).

    blender -b --factory-startup --python sandbox_scene.py -- FILE CASE PLACES

PLACES: JSON. CASE "" leaves the text out.
"""
import json
from pathlib import Path
import sys

import bpy

path, case, places = sys.argv[sys.argv.index("--") + 1:]
for ob in list(bpy.data.objects):
    if ob.type == "MESH":
        bpy.data.objects.remove(ob)
bpy.ops.mesh.primitive_plane_add(size=4)
bpy.context.object.name = "floor"
picture = bpy.data.images.new("wall", 4, 4)
picture.filepath_raw, picture.file_format = str(Path(path).with_name("wall.png")), "PNG"
picture.save()
material = bpy.data.materials.new("wall")
material.use_nodes = True
node = material.node_tree.nodes.new("ShaderNodeTexImage")
node.image = picture
material.node_tree.links.new(node.outputs["Color"], material.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
bpy.context.object.data.materials.append(material)
if case:
    text = bpy.data.texts.new("prisoner.py")
    bpy.data.texts.new("case").write(json.dumps([case, json.loads(places)]))
    text.write(Path(__file__).with_name("prisoner.py").read_text())
    text.use_module = True
bpy.ops.wm.save_as_mainfile(filepath=path, relative_remap=True)
