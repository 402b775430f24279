"""A sheet of gentle, flat-shaded bumps with holes, of far more triangles than texels, under a hard sun.

    blender -b --factory-startup --python dense_cases.py -- OUTPUT.blend
"""
import math
import os
import random
import sys

import bpy

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

from squares import empty_dark_scene  # noqa: E402

CELLS = 120
HEIGHT = 0.004
SUN_ANGLES = (0.5, 0.2, 0)  # steep: no bump shades another


def sheet():
    """Triangles whose corners are moved about; a tenth of them is missing."""
    chance = random.Random(3)
    side = CELLS + 1
    places = [((column + chance.uniform(-0.3, 0.3)) / CELLS, (row + chance.uniform(-0.3, 0.3)) / CELLS)
              for row in range(side) for column in range(side)]
    triangles = [triangle for first in (row * side + column for row in range(CELLS) for column in range(CELLS))
                 for triangle in ((first, first + 1, first + side + 1), (first, first + side + 1, first + side))
                 if chance.random() > 0.1]
    mesh = bpy.data.meshes.new("sheet")
    mesh.from_pydata([(x, y, HEIGHT * math.sin(70 * x) * math.cos(50 * y)) for x, y in places], [], triangles)
    uvs = [value for triangle in triangles for corner in triangle for value in places[corner]]
    mesh.uv_layers.new(name="Lightmap").data.foreach_set("uv", uvs)
    return mesh


empty_dark_scene()
bpy.context.scene.collection.objects.link(bpy.data.objects.new("sheet", sheet()))
sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
sun.data.energy = math.pi
sun.data.angle = 0
sun.rotation_euler = SUN_ANGLES
bpy.context.scene.collection.objects.link(sun)
bpy.ops.wm.save_as_mainfile(filepath=sys.argv[sys.argv.index("--") + 1])
