"""Tells what attic_check.py wants to know of a saved scene: blender -b FILE --python attic_saved.py -- ANSWER.json"""
import json
import os
import sys

import bpy

pictures = [image for image in bpy.data.images if image.source == "FILE" and image.users]
answer = {
    "pictures": [image.name for image in pictures],
    "missing_pictures": [image.name for image in pictures if not image.packed_file and not os.path.isfile(
        bpy.path.abspath(image.filepath, library=image.library))],
    "uv_layers": {ob.name: [layer.name for layer in ob.data.uv_layers] for ob in bpy.context.scene.objects
                  if ob.type == "MESH"},
}
with open(sys.argv[sys.argv.index("--") + 1], "w", encoding="utf-8") as stream:
    json.dump(answer, stream)
