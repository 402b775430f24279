"""blender -b SAVED.blend --python saved_look.py -- ANSWER.json EXPORT.gltf: what the file holds, and exports."""
import json
import os
import sys

import bpy

ANSWER, EXPORT = sys.argv[sys.argv.index("--") + 1:]


def whole(image):
    return bpy.path.abspath(image.filepath, library=image.library).replace("<UDIM>", "1001")


def flags(ob):
    """What a render reads of an object beside its faces."""
    terminator = [round(getattr(owner, "shadow_terminator_geometry_offset"), 4) for owner in (ob, ob.cycles)
                  if hasattr(owner, "shadow_terminator_geometry_offset")]
    return {"glossy": ob.visible_glossy, "shadow": ob.visible_shadow, "diffuse": ob.visible_diffuse,
            "color": [round(value, 4) for value in ob.color], "terminator": terminator[0], "wear": ob.get("wear")}


def describe(ob):
    mesh = ob.data
    layers = {layer.name: [round(value, 5) for corner in layer.data for value in corner.uv] for layer in mesh.uv_layers}
    return {"layers": list(layers), "uvs": layers, "corners": len(mesh.loops),
            "render": next((layer.name for layer in mesh.uv_layers if layer.active_render), None),
            "modifiers": len(ob.modifiers), "parent": ob.parent.name if ob.parent else None,
            "pass_index": ob.pass_index, "kept": ob.get("kept"), "flags": flags(ob), "key": ob.get("rnmbake key", ob.name)}


shown = [ob for ob in bpy.context.scene.objects if ob.type in ("MESH", "CURVE") and not ob.hide_render]
bpy.context.view_layer.update()
render = bpy.context.scene.render
answer = {
    "render": [render.engine, render.resolution_x, bpy.context.scene.camera.name if bpy.context.scene.camera else None],
    "objects": {ob.name: describe(ob) for ob in shown if ob.type == "MESH"},
    "others": sorted(ob.name for ob in shown if ob.type != "MESH"),
    "places": {ob.name: [round(value, 4) for value in ob.matrix_world.translation] for ob in shown},
    "pictures": {image.filepath: os.path.isfile(whole(image)) for image in bpy.data.images if image.source != "VIEWER"},
    "libraries": {library.filepath: os.path.isfile(bpy.path.abspath(library.filepath))
                  for library in bpy.data.libraries},
}
for image in [image for image in bpy.data.images if image.source == "TILED"]:
    bpy.data.images.remove(image)  # glTF has no tiles
import numpy  # noqa: E402  what Blender 3.x's exporter misses of it
for name, builtin in (("bool", bool), ("int", int), ("float", float), ("object", object), ("str", str)):
    if name not in numpy.__dict__:
        setattr(numpy, name, builtin)
bpy.ops.export_scene.gltf(filepath=EXPORT, export_format="GLTF_SEPARATE", export_apply=True)
with open(ANSWER, "w", encoding="utf-8") as stream:
    json.dump(answer, stream)
