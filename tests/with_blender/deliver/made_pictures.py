"""Blender runs this: settles the open scene's materials as a delivery does, and lists the pictures that were made for it.

    blender -b --factory-startup SCENE --python made_pictures.py -- JSON
"""
import json
from pathlib import Path
import sys

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "blender_scripts"))
from deliver import materials  # noqa: E402

there = set(bpy.data.images)
materials.settle([ob for ob in bpy.data.objects if ob.type == "MESH"])
with open(sys.argv[-1], "w", encoding="utf-8") as stream:
    json.dump(sorted(image.name for image in set(bpy.data.images) - there), stream)
